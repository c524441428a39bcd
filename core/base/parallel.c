/* SPDX-License-Identifier: MIT */
/* Single role: the one place that starts threads. Ranges of fixed length are handed to whoever is free, so which thread
   runs a range varies, but the ranges do not. Built with FS_THREADS=0 it is a plain loop and needs no thread library. */
#include "base/base.h"

#ifndef FS_THREADS
#define FS_THREADS 1
#endif

enum { RANGE = 16 };

#if !FS_THREADS

int32_t fs_n_workers(const fs_context *ctx) {
  (void)ctx;
  return 1;
}

fs_status fs_parallel_for(fs_context *ctx, int32_t n, fs_parallel_body body, void *user) {
  (void)ctx;
  for (int32_t begin = 0; begin < n; begin += RANGE) {
    fs_status status = body(user, begin, n - begin < RANGE ? n : begin + RANGE, 0);
    if (status != FS_OK) return status;
  }
  return FS_OK;
}

#else

#include <pthread.h>
#include <stdatomic.h>

enum { MAX_WORKERS = 64 };

typedef struct loop {
  fs_parallel_body body;
  void *user;
  int32_t n;
  atomic_int next;   /* range to hand out next */
  atomic_int status; /* first failure */
} loop;

typedef struct worker {
  loop *shared;
  int32_t number;
} worker;

static void *run(void *argument) {
  worker *w = argument;
  loop *l = w->shared;
  int32_t n_ranges = l->n / RANGE + (l->n % RANGE != 0);
  while (atomic_load(&l->status) == FS_OK) {
    int32_t range = atomic_fetch_add(&l->next, 1), begin;
    int expected = FS_OK;
    fs_status status;
    if (range >= n_ranges) break;
    begin = range * RANGE;
    status = l->body(l->user, begin, l->n - begin < RANGE ? l->n : begin + RANGE, w->number);
    if (status != FS_OK) atomic_compare_exchange_strong(&l->status, &expected, (int)status);
  }
  return NULL;
}

int32_t fs_n_workers(const fs_context *ctx) {
  if (ctx->n_threads < 1) return 1;
  return ctx->n_threads < MAX_WORKERS ? ctx->n_threads : MAX_WORKERS;
}

fs_status fs_parallel_for(fs_context *ctx, int32_t n, fs_parallel_body body, void *user) {
  pthread_t thread[MAX_WORKERS];
  worker w[MAX_WORKERS];
  loop l = {.body = body, .user = user, .n = n};
  int32_t n_workers = fs_n_workers(ctx), n_started = 1;
  if (n_workers > n / RANGE + 1) n_workers = n / RANGE + 1;
  for (int32_t i = 0; i < n_workers; i++) w[i] = (worker){&l, i};
  while (n_started < n_workers && pthread_create(&thread[n_started], NULL, run, &w[n_started]) == 0) n_started++;
  run(&w[0]); /* a thread that could not be started only costs time */
  for (int32_t i = 1; i < n_started; i++) pthread_join(thread[i], NULL);
  return (fs_status)atomic_load(&l.status);
}

#endif
