/* SPDX-License-Identifier: MIT */
/* Single role: the values of a measure at the vertices of triangles, from the patches, not from the triangles, and the range
   of values that colours show. */
#include "measured.h"
#include "base/base.h"

#include <math.h>

fs_status fs_measure_vertices(fs_context *ctx, const fs_surface *surface, const fs_measure *measure,
                              const fs_triangles *t, double *value) {
  fs_status status = FS_OK;
  fs_vec3 x[FS_JET_SIZE];
  double *param = NULL;
  size_t n_params = 0;
  while (measure->params != NULL && measure->params[n_params].name != NULL) n_params++;
  FS_ALLOC(ctx, param, n_params);
  for (size_t k = 0; k < n_params; k++) param[k] = measure->params[k].initial;
  for (int32_t k = 0; k < t->n_vertices; k++) {
    const double *uv = t->vertex_uv + 2 * (size_t)k;
    if (measure->at != NULL) {
      value[k] = measure->at(measure->user, t->vertex_patch[k], uv[0], uv[1]);
      continue;
    }
    fs_surface_evaluate(surface, t->vertex_patch[k], uv[0], uv[1], x);
    value[k] = measure->value(param, x);
  }
done:
  fs_release(ctx, param);
  return status;
}

/* The value number k (from 0) in ascending order of value[n]; reorders value. Hoare's selection [Hoare 1961]. */
static double select_value(double *value, size_t n, size_t k) {
  size_t low = 0, high = n - 1;
  while (low < high) {
    double pivot = value[low + (high - low) / 2];
    size_t i = low, j = high;
    for (;;) {
      while (value[i] < pivot) i++;
      while (value[j] > pivot) j--;
      if (i >= j) break;
      double swapped = value[i];
      value[i++] = value[j], value[j--] = swapped;
    }
    /* now value[low .. j] <= pivot <= value[j + 1 .. high] */
    if (k <= j)
      high = j;
    else
      low = j + 1;
  }
  return value[k];
}

fs_status fs_measure_range(fs_context *ctx, const double *value, size_t n, double *low, double *high) {
  fs_status status = FS_OK;
  double *sorted = NULL;
  size_t n_finite = 0;
  *low = 0, *high = 1;
  FS_ALLOC(ctx, sorted, n);
  for (size_t k = 0; k < n; k++)
    if (isfinite(value[k])) sorted[n_finite++] = value[k];
  if (n_finite == 0) goto done;
  *low = select_value(sorted, n_finite, (n_finite - 1) / 50);
  *high = select_value(sorted, n_finite, n_finite - 1 - (n_finite - 1) / 50);
  /* a constant measure, but for rounding, is shown in the colour of the middle */
  double least = 1e-9 * fmax(fabs(*low), fabs(*high)) + 1e-300;
  if (*high - *low < least) {
    double middle = 0.5 * (*low + *high), half = 1e-6 * fabs(middle) + 1e-300;
    *low = middle - half, *high = middle + half;
  }
done:
  fs_release(ctx, sorted);
  return status;
}
