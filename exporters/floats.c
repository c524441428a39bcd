/* SPDX-License-Identifier: MIT */
/* Single role: doubles as numbers of single precision. */
#include "floats.h"
#include "base/base.h"

#include <float.h>
#include <math.h>

fs_status fs_floats_from_vectors(fs_context *ctx, int32_t n, const fs_vec3 *vector, float *x) {
  for (int32_t i = 0; i < n; i++) {
    fs_vec3 v = vector[i];
    if (!(fabs(v.x) <= FLT_MAX && fabs(v.y) <= FLT_MAX && fabs(v.z) <= FLT_MAX))
      return fs_fail(ctx, FS_ERR_NUMERIC,
                     "vertex %d has a coordinate that is not finite or too large for single precision", i);
    x[3 * (size_t)i] = (float)v.x;
    x[3 * (size_t)i + 1] = (float)v.y;
    x[3 * (size_t)i + 2] = (float)v.z;
  }
  return FS_OK;
}

void fs_floats_from_values(int32_t n, const double *value, float *x) {
  for (int32_t i = 0; i < n; i++) x[i] = fabs(value[i]) <= FLT_MAX ? (float)value[i] : 0;
}
