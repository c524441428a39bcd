/* SPDX-License-Identifier: MIT */
/* The inner loops of evaluation at many points, compiled once per instruction set. */
#ifndef FS_SURFACE_POINTS_H
#define FS_SURFACE_POINTS_H

#include <stddef.h>
#include <stdint.h>

enum { FS_MAX_GRID = 24 };

typedef struct fs_points_kernels {
  const char *name;
  /* Bicubic points [16][3] and, where is_gregory, four more; order 0 .. 2; out[1, 3 or 6][3][stride]. */
  void (*quad)(const double *point, int is_gregory, int32_t order, size_t n, const double *u, const double *v,
               size_t stride, double *out);
  /* Tensor Bezier points [degree_v + 1][degree_u + 1][3]; out[FS_JET_SIZE][3][n n], the point (u_i, v_j) at n j + i; n a
     multiple of 8, at most FS_MAX_GRID. */
  void (*grid)(int32_t degree_u, int32_t degree_v, const double *point, int32_t n, const double *u, const double *v,
               double *out);
  /* Bezier triangles of any degree, points as in kind_bezier_triangle.c; out[n_derivatives][3][n] */
  void (*triangle)(int32_t degree, const double *point, int32_t n_derivatives, size_t n, const double *u,
                   const double *v, double *out);
  /* jets[6][3][stride_in] of n points to out[8][stride], as fs_surface_bend_points. */
  void (*bend)(size_t n, size_t stride_in, const double *jets, size_t stride, double *out);
} fs_points_kernels;

/* Those that this processor can run, the best first; returns their number. */
int32_t fs_points_kernels_all(const fs_points_kernels *all[3]);

#endif
