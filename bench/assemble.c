/* SPDX-License-Identifier: MIT */
/* Single role: what the exact Hessian and the gradient cost per quadrature node, in microseconds of one core, by size:
   assemble [SIDE…]. Everything counts: jets, density, contraction, the sparse matrix. The least of three runs. These are the first
   steps of a fairing, whose squares have 4 x 4 nodes; tests/speed/hessian.c measures the others. */
#include "fair_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { N_REPEATS = 3, N_STEPS = 2 };

static void measure(int n) {
  double gradient = INFINITY, hessian = INFINITY;
  for (int i = 0; i < N_REPEATS; i++) {
    fs_costs c = bench_fair_sheet(n, 1, (fs_fair_options){.max_iterations = N_STEPS}).costs;
    gradient = fmin(gradient, 1e6 * c.gradients / c.points_of_gradients);
    hessian = fmin(hessian, 1e6 * c.hessians / c.points_of_hessians);
  }
  printf("%7d free  gradient %.3f us per node  Hessian %.3f us per node\n", n * n, gradient, hessian);
}

int main(int argc, char **argv) {
  fs_blas_set_threads(1); /* idle ones would be counted as they wait */
  if (argc == 1) measure(32);
  for (int i = 1; i < argc; i++) measure(atoi(argv[i]));
  return EXIT_SUCCESS;
}
