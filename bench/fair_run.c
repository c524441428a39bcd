/* SPDX-License-Identifier: MIT */
/* Single role: the sheet of fair_run.h, and its fairing. */
#include "fair_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double NOISE = 0.05;

static void check(const fs_context *ctx, fs_status status) {
  if (status == FS_OK) return;
  fprintf(stderr, "%s\n", ctx->message);
  exit(EXIT_FAILURE);
}

static void *allocate(size_t count, size_t size) {
  void *block = calloc(count, size);
  if (block != NULL) return block;
  fprintf(stderr, "out of memory\n");
  exit(EXIT_FAILURE);
}

/* In [-1, 1), the same on every run. */
static double next_random(uint32_t *state) {
  *state = *state * 1664525u + 1013904223u; /* [Knuth, vol. 2, 3.3.4] */
  return *state / 2147483648.0 - 1;
}

fs_mesh *bench_make_sheet(fs_context *ctx, int n) {
  int side = n + 2 * BENCH_RIM, n_faces = (side - 1) * (side - 1);
  fs_vec3 *position = allocate((size_t)side * (size_t)side, sizeof *position);
  int32_t *start = allocate((size_t)n_faces + 1, sizeof *start),
          *corner = allocate(4 * (size_t)n_faces, sizeof *corner);
  uint32_t seed = 1;
  double edge = 1.0 / (side - 1);
  fs_mesh *mesh = NULL;
  for (int j = 0; j < side; j++)
    for (int i = 0; i < side; i++) {
      fs_vec3 *p = &position[j * side + i];
      bool is_free = i >= BENCH_RIM && i < side - BENCH_RIM && j >= BENCH_RIM && j < side - BENCH_RIM;
      double noise = is_free ? NOISE * edge : 0;
      *p = (fs_vec3){i * edge, j * edge, 0.1 * sin(5 * i * edge) * cos(4 * j * edge)};
      p->x += noise * next_random(&seed);
      p->y += noise * next_random(&seed);
      p->z += noise * next_random(&seed);
    }
  for (int f = 0; f < n_faces; f++) {
    int v = f / (side - 1) * side + f % (side - 1);
    const int32_t corners[4] = {v, v + 1, v + 1 + side, v + side};
    memcpy(corner + 4 * (size_t)f, corners, sizeof corners);
    start[f + 1] = 4 * (f + 1);
  }
  check(ctx, fs_mesh_create(ctx, side * side, position, n_faces, start, corner, &mesh));
  free(position);
  free(start);
  free(corner);
  return mesh;
}

fs_fair_report bench_fair_sheet(int n, int n_threads, fs_fair_options options) {
  fs_context ctx = {.n_threads = n_threads};
  fs_mesh *mesh = bench_make_sheet(&ctx, n);
  fs_space *space = NULL;
  fs_fair_report report;
  fs_vec3 *c;
  bool *fixed;
  check(&ctx, fs_space_create(&ctx, mesh, &space));
  fixed = allocate((size_t)space->n_dofs, sizeof *fixed);
  c = allocate((size_t)space->n_dofs, sizeof *c);
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  check(&ctx, fs_space_rim(&ctx, mesh, space, fixed));
  options.functional = fs_functional_find("penalised");
  options.fixed = fixed;
  check(&ctx, fs_fair(&ctx, space, &options, c, &report));
  free(fixed);
  free(c);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
  return report;
}
