/* SPDX-License-Identifier: MIT */
/* Numbers in single precision, for formats that keep no more. */
#ifndef FS_EXPORTERS_FLOATS_H
#define FS_EXPORTERS_FLOATS_H

#include <fairsurf/base.h>

/* x[n][3], rounded. FS_ERR_NUMERIC names the first vertex with a coordinate that is not finite or too large. */
fs_status fs_floats_from_vectors(fs_context *ctx, int32_t n, const fs_vec3 *vector, float *x);

/* x[n], rounded; 0 where a value is not finite or too large: measures have no value where a surface is not regular. */
void fs_floats_from_values(int32_t n, const double *value, float *x);

#endif
