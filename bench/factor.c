/* SPDX-License-Identifier: MIT */
/* Single role: what the analysis and the factorisation of a Hessian cost, by size and number of BLAS threads:
   factor [--threads N] [SIDE…]. */
#include "fair_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void measure(int n) {
  fs_fair_report r = bench_fair_sheet(n, 1, (fs_fair_options){.max_iterations = 1});
  double seconds = r.costs.factorisations / r.n_factorisations;
  printf("%7d free  analysis %7.3f s  factorisation %7.3f s  %6.2f Gflop  %5.1f Gflop/s  factor %7.1f MB\n", n * n,
         r.costs.analysis, seconds, 1e-9 * r.costs.factor_flops, 1e-9 * r.costs.factor_flops / seconds,
         1e-6 * r.costs.factor_bytes);
  fflush(stdout);
}

int main(int argc, char **argv) {
  int first = 1, n_threads = 1;
  if (argc > 2 && strcmp(argv[1], "--threads") == 0) {
    n_threads = atoi(argv[2]);
    first = 3;
  }
  fs_blas_set_threads(n_threads);
  if (first == argc) measure(32);
  for (int i = first; i < argc; i++) measure(atoi(argv[i]));
  return EXIT_SUCCESS;
}
