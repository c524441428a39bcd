/* SPDX-License-Identifier: MIT */
/* Single role: how fast Gregory surfaces are made and evaluated on one core: a mesh of 99 840 quads, and 100 points on each;
   beside peers/osd_gregory.cpp, which has the same mesh. The least processor time of five runs. The first argument, in
   millions of points per second, makes the program fail where positions with first derivatives are slower. */
#include <fairsurf/fairsurf.h>
#include "gregory_mesh.h"

#include <stdio.h>
#include <time.h>

enum { N_REPEATS = 5 };

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static fs_mesh *make_mesh(fs_context *ctx) {
  bench_mesh m = bench_make_mesh();
  fs_vec3 *position = malloc((size_t)m.n_vertices * sizeof *position);
  int32_t *start = malloc(((size_t)m.n_quads + 1) * sizeof *start);
  fs_mesh *mesh = NULL;
  if (position == NULL || start == NULL) exit(EXIT_FAILURE);
  for (int v = 0; v < m.n_vertices; v++) position[v] = (fs_vec3){m.position[v][0], m.position[v][1], m.position[v][2]};
  for (int f = 0; f <= m.n_quads; f++) start[f] = 4 * f;
  if (fs_mesh_create(ctx, m.n_vertices, position, m.n_quads, start, &m.corner[0][0], &mesh) != FS_OK) {
    fprintf(stderr, "%s\n", ctx->message);
    exit(EXIT_FAILURE);
  }
  free(position);
  free(start);
  free(m.position);
  free(m.corner);
  return mesh;
}

static void report(const char *title, double n_points, double seconds) {
  printf("%-42s %7.1f Mpoints/s %7.1f ns\n", title, 1e-6 * n_points / seconds, 1e9 * seconds / n_points);
}

typedef enum what { POSITION, FIRST, SECOND, BEND, JETS } what;

/* Seconds for all points of all patches; sum keeps the work from being left out. */
static double evaluate(const fs_surface *s, what what, double *sum) {
  double u[BENCH_POINTS], v[BENCH_POINTS], out[18 * BENCH_POINTS], start = now();
  fs_vec3 x[FS_JET_SIZE];
  for (int k = 0; k < BENCH_POINTS; k++) bench_parameters(k, &u[k], &v[k]);
  for (int32_t p = 0; p < s->n_patches; p++) {
    if (what == BEND)
      fs_surface_bend_points(s, p, BENCH_POINTS, u, v, out);
    else if (what != JETS)
      fs_surface_evaluate_points(s, p, (int32_t)what, BENCH_POINTS, u, v, out);
    for (int k = 0; k < BENCH_POINTS && what == JETS; k++) {
      fs_surface_evaluate(s, p, u[k], v[k], x);
      out[k] = x[FS_D].x;
    }
    *sum += out[p % BENCH_POINTS];
  }
  return now() - start;
}

int main(int argc, char **argv) {
  static const char *const title[] = {"positions", "positions, first derivatives",
                                      "positions, first and second derivatives", "positions, normals, curvatures",
                                      "derivatives to order 3, one by one"};
  double least = argc > 1 ? atof(argv[1]) : 0, best = INFINITY, sum = 0, speed = 0;
  fs_context ctx = {0};
  fs_mesh *mesh = make_mesh(&ctx);
  fs_surface *s = NULL;
  for (int i = 0; i < N_REPEATS; i++) {
    double start = now();
    fs_surface_free(&ctx, s);
    s = NULL;
    if (fs_gregory_create(&ctx, mesh, NULL, FS_EDGE_ARC, &s) != FS_OK) {
      fprintf(stderr, "%s\n", ctx.message);
      return EXIT_FAILURE;
    }
    best = fmin(best, now() - start);
  }
  printf("construction of %d quads %26.0f ms\n", (int)mesh->n_faces, 1e3 * best);
  for (int w = POSITION; w <= JETS; w++) {
    double seconds = INFINITY, n_points = (double)BENCH_POINTS * s->n_patches;
    for (int i = 0; i < (w == JETS ? 1 : N_REPEATS); i++) seconds = fmin(seconds, evaluate(s, (what)w, &sum));
    report(title[w], n_points, seconds);
    if (w == FIRST) speed = 1e-6 * n_points / seconds;
  }
  if (!isfinite(sum)) printf("not finite\n");
  fs_surface_free(&ctx, s);
  fs_mesh_free(&ctx, mesh);
  return speed < least ? EXIT_FAILURE : EXIT_SUCCESS;
}
