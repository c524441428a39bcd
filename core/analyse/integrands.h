/* SPDX-License-Identifier: MIT */
/* What is integrated over a surface, at many points at once; compiled once per instruction set. */
#ifndef FS_ANALYSE_INTEGRANDS_H
#define FS_ANALYSE_INTEGRANDS_H

#include <stddef.h>
#include <stdint.h>

/* Numbers of a point; curvatures are NAN where there is no normal: |p_u x p_v| at most 1e-14 |p_u| |p_v|. */
enum {
  FS_AT_AREA,   /* |p_u x p_v| */
  FS_AT_VOLUME, /* p . (p_u x p_v) / 3 */
  FS_AT_H,
  FS_AT_K,
  FS_AT_GRADIENT, /* |grad H| */
  FS_AT_MAXIMUM,  /* principal curvatures */
  FS_AT_MINIMUM,
  FS_AT_N
};

/* Integrals over a cell with nodes (i, j), of f and |f|, and their parts of each column i and each row j. */
enum { FS_MAX_PATCH_NODES = 24 };
typedef enum fs_integral { FS_AREA, FS_VOLUME, FS_WILLMORE, FS_S, FS_N_INTEGRALS } fs_integral;
typedef struct fs_cell_sums {
  double integral[FS_N_INTEGRALS], size[FS_N_INTEGRALS];
  double by_a[FS_N_INTEGRALS][FS_MAX_PATCH_NODES], by_b[FS_N_INTEGRALS][FS_MAX_PATCH_NODES];
} fs_cell_sums;

typedef struct fs_integrand_kernels {
  const char *name;
  /* jets[10][3][n_points] to at[FS_AT_N][n_points]; n_points is a multiple of 8 */
  void (*at_points)(size_t n_points, const double *jets, double *at);
  /* Of at[FS_AT_N][n n] at the nodes of a cell, n j + i; scale[i]: the derivative of the area of the domain by that of the cell;
     curvatures that are not finite count as zero. */
  void (*add_up)(int32_t n, const double *weight, const double *scale, const double *at, fs_cell_sums *sums);
} fs_integrand_kernels;

const fs_integrand_kernels *fs_integrand_kernels_best(void);

/* Those that this processor can run, the best first; returns their number. */
int32_t fs_integrand_kernels_all(const fs_integrand_kernels *all[3]);

#endif
