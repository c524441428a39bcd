/* SPDX-License-Identifier: MIT */
/* Derivatives of a number f(u, v), f[FS_JET_SIZE], along directions of the parameter plane: f is contracted with vectors
   (du, dv). With w(s, t) the position in the plane these are the terms of the chain rule. */
#ifndef FS_SURFACE_JET_H
#define FS_SURFACE_JET_H

#include <fairsurf/surface.h>

/* Number of the derivative of order [by u][by v]. */
static const signed char fs_jet_number[4][4] = {
    {FS_D, FS_DV, FS_DVV, FS_DVVV}, {FS_DU, FS_DUV, FS_DUVV}, {FS_DUU, FS_DUUV}, {FS_DUUU}};

static inline double fs_jet_along(const double *f, const double *a) { return f[FS_DU] * a[0] + f[FS_DV] * a[1]; }

static inline double fs_jet_along_two(const double *f, const double *a, const double *b) {
  return f[FS_DUU] * a[0] * b[0] + f[FS_DUV] * (a[0] * b[1] + a[1] * b[0]) + f[FS_DVV] * a[1] * b[1];
}

static inline double fs_jet_along_three(const double *f, const double *a, const double *b, const double *c) {
  return f[FS_DUUU] * a[0] * b[0] * c[0] + f[FS_DUUV] * (a[0] * b[0] * c[1] + a[0] * b[1] * c[0] + a[1] * b[0] * c[0]) +
         f[FS_DUVV] * (a[0] * b[1] * c[1] + a[1] * b[0] * c[1] + a[1] * b[1] * c[0]) + f[FS_DVVV] * a[1] * b[1] * c[1];
}

/* g(s, t) = f(w(s, t)) for w with the first derivatives ws, wt, the mixed derivative wst and no others. g may be f. */
static inline void fs_jet_compose(const double *f, const double *ws, const double *wt, const double *wst, double *g) {
  const double h[FS_JET_SIZE] = {
      [FS_D] = f[FS_D],
      [FS_DU] = fs_jet_along(f, ws),
      [FS_DV] = fs_jet_along(f, wt),
      [FS_DUU] = fs_jet_along_two(f, ws, ws),
      [FS_DUV] = fs_jet_along_two(f, ws, wt) + fs_jet_along(f, wst),
      [FS_DVV] = fs_jet_along_two(f, wt, wt),
      [FS_DUUU] = fs_jet_along_three(f, ws, ws, ws),
      [FS_DUUV] = fs_jet_along_three(f, ws, ws, wt) + 2 * fs_jet_along_two(f, ws, wst),
      [FS_DUVV] = fs_jet_along_three(f, ws, wt, wt) + 2 * fs_jet_along_two(f, wt, wst),
      [FS_DVVV] = fs_jet_along_three(f, wt, wt, wt),
  };
  for (int k = 0; k < FS_JET_SIZE; k++) g[k] = h[k];
}

#endif
