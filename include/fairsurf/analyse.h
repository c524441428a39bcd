/* SPDX-License-Identifier: MIT */
/* Measures of a surface: numbers at a point, and how patches meet. */
#ifndef FAIRSURF_ANALYSE_H
#define FAIRSURF_ANALYSE_H

#include <fairsurf/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A scalar to look at; one point in, one number out. Lines of a table. NaN where p_u x p_v = 0. */
typedef struct fs_measure {
  const char *name, *summary;
  const fs_param *params;
  double (*value)(const double *param, const fs_vec3 x[FS_JET_SIZE]);
} fs_measure;
FS_API extern const fs_measure *const fs_measures[];        /* ends with NULL: mean, gaussian, gradient, … */
FS_API const fs_measure *fs_measure_find(const char *name); /* NULL: unknown */

/* Largest differences across all sides that two patches share. */
typedef struct fs_contact {
  double position;           /* distance */
  double normal;             /* angle, radians */
  double curvature;          /* Frobenius norm of the difference of the shape tensors J G^-1 B G^-1 J^T */
  double largest_curvature;  /* Frobenius norm of the largest shape tensor met, to judge the last by */
  int32_t patch[3], side[3]; /* where each of the first three was found; FS_NONE: no shared side */
} fs_contact;

/* n_samples + 1 equidistant points per side, ends included. */
FS_API fs_status fs_surface_contact(fs_context *ctx, const fs_surface *surface, int32_t n_samples, fs_contact *contact);

#ifdef __cplusplus
}
#endif
#endif
