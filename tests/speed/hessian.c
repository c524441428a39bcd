/* SPDX-License-Identifier: MIT */
/* Single role: what value, gradient and exact Hessian of the curvature variation cost per quadrature node on squares, in
   microseconds of one core, by the nodes per direction: hessian [NODES…]. As fairing computes them: jets, density, contraction, and
   the sparse matrix; for the curvature variation alone, and with the tangential part Q beside it. The least of some runs. */
#include <fairsurf/fairsurf.h>

#include "base/base.h"
#include "base/clock.h"
#include "fair/problem.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 40, N_RUNS = 7 };

static void check(const fs_context *ctx, fs_status status) {
  if (status == FS_OK) return;
  fprintf(stderr, "%s\n", ctx->message);
  exit(EXIT_FAILURE);
}

static fs_space *make_sheet(fs_context *ctx) {
  static fs_vec3 position[SIDE * SIDE];
  static int32_t start[(SIDE - 1) * (SIDE - 1) + 1], corner[4 * (SIDE - 1) * (SIDE - 1)];
  fs_mesh *mesh = NULL;
  fs_space *space = NULL;
  for (int v = 0; v < SIDE * SIDE; v++) {
    int i = v % SIDE, j = v / SIDE;
    double x = i / (SIDE - 1.0), y = j / (SIDE - 1.0);
    position[v] = (fs_vec3){x, y, 0.1 * sin(5 * x) * cos(4 * y)};
  }
  for (int f = 0; f < (SIDE - 1) * (SIDE - 1); f++) {
    int v = f / (SIDE - 1) * SIDE + f % (SIDE - 1);
    int32_t *at = corner + 4 * (size_t)f;
    at[0] = v;
    at[1] = v + 1;
    at[2] = v + 1 + SIDE;
    at[3] = v + SIDE;
    start[f + 1] = 4 * (f + 1);
  }
  check(ctx, fs_mesh_create(ctx, SIDE * SIDE, position, (SIDE - 1) * (SIDE - 1), start, corner, &mesh));
  check(ctx, fs_space_create(ctx, mesh, &space));
  fs_mesh_free(ctx, mesh);
  return space;
}

/* Microseconds per node. */
static double measure(fs_context *ctx, const fs_space *space, int32_t n_terms, int32_t n_nodes, fs_order order) {
  static const fs_density *const term[] = {&fs_density_curvature_variation, &fs_density_tangential};
  fs_problem *p = NULL;
  double integral[2], least = INFINITY, *g;
  check(ctx, fs_problem_create(ctx, space, n_terms, term, NULL, n_nodes, n_nodes, space->start, &p));
  p->weight[0] = 1;
  p->weight[1] = 1e-2;
  g = malloc(3 * (size_t)p->n_free * sizeof *g);
  for (int i = 0; g != NULL && i < N_RUNS; i++) {
    double begin = fs_clock_processor_seconds();
    check(ctx, fs_problem_evaluate(p, order, integral, NULL, g, p->pattern));
    least = fmin(least, fs_clock_processor_seconds() - begin);
  }
  free(g);
  fs_problem_free(ctx, p);
  return 1e6 * least / ((double)space->n_elements * n_nodes * n_nodes);
}

static void report(fs_context *ctx, const fs_space *space, int32_t n_nodes) {
  for (int32_t n_terms = 1; n_terms <= 2; n_terms++)
    printf("%d x %d nodes, %s  value %.4f  gradient %.3f  Hessian %.3f us per node\n", n_nodes, n_nodes,
           n_terms == 1 ? "S      " : "S + C Q", measure(ctx, space, n_terms, n_nodes, FS_VALUE),
           measure(ctx, space, n_terms, n_nodes, FS_GRADIENT), measure(ctx, space, n_terms, n_nodes, FS_HESSIAN));
}

int main(int argc, char **argv) {
  static const int32_t usual[] = {8, 6, 4};
  fs_context ctx = {.n_threads = 1};
  fs_space *space = make_sheet(&ctx);
  for (int i = 1; i < argc; i++) report(&ctx, space, atoi(argv[i]));
  for (int i = 0; argc == 1 && i < 3; i++) report(&ctx, space, usual[i]);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  return EXIT_SUCCESS;
}
