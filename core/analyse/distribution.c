/* SPDX-License-Identifier: MIT */
/* Single role: percentiles by area: the value below which a part of the area of the samples lies. */
#include "analyse/analyse.h"

#include <math.h>
#include <stdlib.h>

const double fs_percentiles[FS_N_PERCENTILES] = {1, 5, 50, 95, 99};

static int compare(double a, double b) { return a < b ? -1 : a > b; }
static int by_H(const void *a, const void *b) { return compare(((const fs_sample *)a)->H, ((const fs_sample *)b)->H); }
static int by_K(const void *a, const void *b) { return compare(((const fs_sample *)a)->K, ((const fs_sample *)b)->K); }
static int by_gradient(const void *a, const void *b) {
  return compare(((const fs_sample *)a)->gradient, ((const fs_sample *)b)->gradient);
}

static double H_of(const fs_sample *s) { return s->H; }
static double K_of(const fs_sample *s) { return s->K; }
static double gradient_of(const fs_sample *s) { return s->gradient; }

/* Between two samples, each at the middle of its area, the value is interpolated. */
static void take(size_t n, const fs_sample *sample, double total, double (*value)(const fs_sample *),
                 double percentile[FS_N_PERCENTILES]) {
  double below = 0;
  size_t i = 0;
  for (int k = 0; k < FS_N_PERCENTILES; k++) {
    double wanted = fs_percentiles[k] / 100 * total;
    while (i < n && below + 0.5 * sample[i].area < wanted) below += sample[i++].area;
    if (i == 0 || i == n) {
      percentile[k] = value(&sample[i == 0 ? 0 : n - 1]);
      continue;
    }
    double from = below - 0.5 * sample[i - 1].area, to = below + 0.5 * sample[i].area;
    double part = to > from ? (wanted - from) / (to - from) : 0;
    percentile[k] = value(&sample[i - 1]) + part * (value(&sample[i]) - value(&sample[i - 1]));
  }
}

void fs_distribution_percentiles(size_t n, fs_sample *sample, fs_distribution *H, fs_distribution *K,
                                 fs_distribution *gradient) {
  const struct {
    int (*order)(const void *, const void *);
    double (*value)(const fs_sample *);
    double *percentile;
  } kinds[3] = {
      {by_H, H_of, H->percentile}, {by_K, K_of, K->percentile}, {by_gradient, gradient_of, gradient->percentile}};
  double total = 0;
  for (size_t i = 0; i < n; i++) total += sample[i].area;
  for (int k = 0; k < 3; k++) {
    for (int i = 0; i < FS_N_PERCENTILES; i++) kinds[k].percentile[i] = NAN;
    if (n == 0) continue;
    qsort(sample, n, sizeof *sample, kinds[k].order);
    take(n, sample, total, kinds[k].value, kinds[k].percentile);
  }
}
