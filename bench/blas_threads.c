/* SPDX-License-Identifier: MIT */
/* Single role: whole fairings of a sheet with 1, 2 and 3 threads of BLAS reach the same F: blas_threads [SIDE]. Sums of BLAS may
   differ in their last bits with the number of threads; exits with an error where F differs by more than 1e-12 of it. */
#include "fair_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 3 };
static const double TOLERANCE = 1e-12;

int main(int argc, char **argv) {
  int side = argc > 1 ? atoi(argv[1]) : 75, result = EXIT_SUCCESS;
  double F = 0;
  for (int n = 1; n <= MOST; n++) {
    fs_blas_set_threads(n);
    fs_fair_report r = bench_fair_sheet(side, 1, (fs_fair_options){0});
    double difference = n == 1 ? 0 : fabs(r.end.F - F) / F;
    if (n == 1) F = r.end.F;
    printf("%7d free  %d threads of BLAS  %2d factorisations  F %.17g  relative difference %.1e\n", r.n_free, n,
           r.n_factorisations, r.end.F, difference);
    fflush(stdout);
    if (!(difference <= TOLERANCE)) result = EXIT_FAILURE;
  }
  return result;
}
