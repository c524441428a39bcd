/* SPDX-License-Identifier: MIT */
/* Single role: memory for large arrays. Where pages of 4 kB are handed out and taken back again and again, a fifth of the time of
   fairing a mesh of some thousand vertices goes to page faults: large blocks ask for large pages, and what was freed is kept. */
#include "cli.h"

#include <malloc.h>
#include <stdint.h>
#include <stdlib.h>
#include <suitesparse/SuiteSparse_config.h>
#include <sys/mman.h>

enum { LARGE = 1 << 22, PAGE = 1 << 21, FIRST = 1 << 26 };

/* Free memory of this size is kept; larger blocks are returned, lest one of several GB be there twice. */
static const int kept = 1 << 30;

static void ask_for_large_pages(char *block, size_t bytes) {
#ifdef MADV_HUGEPAGE
  char *begin = block + (PAGE - (uintptr_t)block % PAGE) % PAGE;
  if (bytes >= LARGE)
    madvise(begin, (bytes - (size_t)(begin - block)) / PAGE * PAGE, MADV_HUGEPAGE); /* or not: advice */
#else
  (void)block, (void)bytes;
#endif
}

static void *allocate(size_t bytes) {
  void *block = malloc(bytes);
  if (block != NULL) ask_for_large_pages(block, bytes);
  return block;
}

static void *allocate_for(void *user, size_t bytes) {
  (void)user;
  return allocate(bytes);
}

static void release_for(void *user, void *block) {
  (void)user;
  free(block);
}

void use_large_pages(fs_context *ctx) {
  ctx->allocate = allocate_for;
  ctx->release = release_for;
  SuiteSparse_config.malloc_func = allocate;
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, kept);
  mallopt(M_TRIM_THRESHOLD, kept);
  mallopt(M_TOP_PAD, FIRST); /* one range, for all small blocks of small runs */
  char *first = malloc(LARGE);
  if (first != NULL) ask_for_large_pages(first, FIRST);
  free(first);
#endif
}
