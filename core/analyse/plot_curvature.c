/* SPDX-License-Identifier: MIT */
/* Plots of curvature: lines of equal mean and Gaussian curvature, at round levels or at given ones. */
#include "analyse/curves.h"
#include "math/vec3.h"

#include <stdlib.h>

static double measured(const void *user, const fs_vec3 x[FS_JET_SIZE]) {
  const fs_measure *measure = user;
  return measure->value(NULL, x);
}

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The values below which 2 % and 98 % of a grid of samples lie: levels are spread between them, for extremes are rare. */
static fs_status find_range(fs_context *ctx, const fs_surface *surface, const fs_field *field, double range[2]) {
  enum { N = 4 };
  fs_status status = FS_OK;
  double *sample = NULL;
  int32_t n = 0;
  FS_ALLOC(ctx, sample, (size_t)surface->n_patches * N * N);
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int k = 0; k < N * N; k++) {
      double f = fs_field_at(surface, field, p, (k % N + 0.5) / N, (double)(k / N + 0.5) / N);
      if (isfinite(f)) sample[n++] = f;
    }
  qsort(sample, (size_t)n, sizeof *sample, compare);
  range[0] = n > 0 ? sample[n / 50] : 0;
  range[1] = n > 0 ? sample[n - 1 - n / 50] : 0;
done:
  fs_release(ctx, sample);
  return status;
}

/* The smallest of 1, 2, 5 times a power of ten that is at least x. */
static double round_up(double x) {
  double power = pow(10, floor(log10(x)));
  for (int k = 0; k < 3; k++) {
    static const double digit[3] = {1, 2, 5};
    if (digit[k] * power >= x * (1 - 1e-12)) return digit[k] * power;
  }
  return 10 * power;
}

static const fs_param params[] = {
    {.name = "count", .summary = "about as many levels", .initial = 20, .min = 1, .max = 500},
    {.name = "interval", .summary = "between levels; 0: a round number by count", .initial = 0, .min = 0, .max = 1e9},
    {0}};

static fs_status trace(fs_context *ctx, const fs_surface *surface, const double *param, const fs_measure *measure,
                       const fs_trace_options *options, fs_curves **curves) {
  enum { MAX_LEVELS = 10000 };
  fs_status status = FS_OK;
  fs_field field = {measured, measure};
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  double range[2], interval = param[1], *values = NULL;
  FS_TRY(fs_surface_to_quads(ctx, surface, &quads));
  FS_TRY(fs_curve_list_start(ctx, &list));
  FS_TRY(find_range(ctx, quads, &field, range));
  /* a curvature that varies by rounding only has no lines */
  bool is_constant = range[1] - range[0] <= 1e-9 * fmax(fabs(range[0]), fabs(range[1]));
  if (!(interval > 0) && !is_constant) interval = round_up((range[1] - range[0]) / param[0]);
  if (interval > 0 && (range[1] - range[0]) / interval > MAX_LEVELS) {
    status = fs_fail(ctx, FS_ERR_ARGUMENT, "an interval of %g gives more than %d levels between %g and %g", interval,
                     MAX_LEVELS, range[0], range[1]);
    goto done;
  }
  FS_TRY(fs_field_values(ctx, quads, &field, fs_trace_options_complete(quads, options).n_cells, &values));
  for (double k = ceil(range[0] / interval); interval > 0 && k * interval <= range[1]; k++)
    FS_TRY(fs_levels_append(ctx, quads, &field, values, k * interval, k * interval, options, &list));
  list.curves->is_graded = true;
  *curves = list.curves;
  list.curves = NULL;
done:
  fs_release(ctx, values);
  fs_curves_free(ctx, list.curves);
  fs_surface_free(ctx, quads);
  return status;
}

static fs_status trace_mean(fs_context *ctx, const fs_surface *surface, const double *param,
                            const fs_trace_options *options, fs_curves **curves) {
  return trace(ctx, surface, param, fs_measure_find("mean"), options, curves);
}

static fs_status trace_gaussian(fs_context *ctx, const fs_surface *surface, const double *param,
                                const fs_trace_options *options, fs_curves **curves) {
  return trace(ctx, surface, param, fs_measure_find("gaussian"), options, curves);
}

const fs_plot fs_plot_mean = {"mean-curvature", "lines of equal mean curvature", params, trace_mean};
const fs_plot fs_plot_gaussian = {"gaussian-curvature", "lines of equal Gaussian curvature", params, trace_gaussian};
