/* SPDX-License-Identifier: MIT */
/* Single role: whole fairings of sheets by size, where their time goes, and how it grows: fair [--threads N] [SIDE…].
   Exponents are fitted by least squares to the logarithms: of the seconds of a Hessian, and of a factorisation. */
#include "fair_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { MAX_SIZES = 32 };

/* The slope of y over x. */
static double slope(int n, const double *x, const double *y) {
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (int i = 0; i < n; i++) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  for (int i = 0; i < n; i++) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  return xy / xx;
}

static double peak_megabytes(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1e-3 * (double)usage.ru_maxrss;
}

int main(int argc, char **argv) {
  int side[MAX_SIZES] = {32}, n = 0, first = 1, n_threads = 1;
  double size[MAX_SIZES], hessian[MAX_SIZES], factorisation[MAX_SIZES];
  if (argc > 2 && strcmp(argv[1], "--threads") == 0) {
    n_threads = atoi(argv[2]);
    first = 3;
  }
  for (int i = first; i < argc && n < MAX_SIZES; i++) side[n++] = atoi(argv[i]);
  if (n == 0) n = 1;
  for (int i = 0; i < n; i++) {
    fs_blas_set_threads(side[i] * side[i] < 5000 ? 1 : n_threads);
    fs_fair_report r = bench_fair_sheet(side[i], n_threads, (fs_fair_options){.decrease_tolerance = 1e-6});
    const fs_costs *c = &r.costs;
    size[i] = log((double)side[i] * side[i]);
    hessian[i] = log(c->hessians / c->points_of_hessians) + log((double)r.n_squares);
    factorisation[i] = log(c->factorisations / r.n_factorisations);
    printf(
        "%7d free  %6.2f s  %2d gradients %6.2f s  %2d Hessians %6.2f s %5.2f us per node  %2d factorisations %6.2f s"
        "  analysis %5.2f s  peak %6.0f MB  F %.6g\n",
        r.n_free, r.trace[r.n_trace - 1].seconds, c->n_gradients, c->gradients, r.n_hessians, c->hessians,
        1e6 * c->hessians / c->points_of_hessians, r.n_factorisations, c->factorisations, c->analysis, peak_megabytes(),
        r.end.F);
    fflush(stdout);
  }
  if (n > 1)
    printf("exponents: Hessian %.2f, factorisation %.2f\n", slope(n, size, hessian), slope(n, size, factorisation));
  return EXIT_SUCCESS;
}
