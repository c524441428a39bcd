/* SPDX-License-Identifier: MIT */
/* The inner loops of fairing, compiled once per instruction set; shapes as in fs_density (points innermost). */
#ifndef FS_FAIR_KERNELS_H
#define FS_FAIR_KERNELS_H

#include <fairsurf/fair.h>

/* What differs between instruction sets. m is the number of dofs of an element, m_padded a multiple of 8 not below it;
   block = FS_BLOCK points.
     jets      x[9][3][block] = sum over dofs of table[9][m][block] * c[m][3]
     gradient  g[m][3] += sum over derivatives and points of table[9][m][block] * df[9][3][block]
     hessian   h[6][m_padded][m_padded] += for the component pairs (a, b) = xx xy xz yy yz zz the sum over points and over
               pairs of derivatives of N_i[m] ddf_(ia,jb) N_j[m']; by_point[block][9][m_padded] is the table transposed.
               Where a == b only the part on and above the diagonal is meaningful
     hessian_tensor, hessian_tensor_finish
               the same for bicubic elements, block by block in order, then h[6][16][16] = the result
     congruence  out[6][n][n] = T^T h T for the six pairs of components, h[6][m_padded][m_padded] as hessian leaves it (both
               parts of the result are there), T[m][n], n a multiple of 8, work[m_padded][n]
     add_scaled  to[n][block] (+)= scale[block] * from[n][block]; the first time it is stored, not added
     to_chart  z[9][3][block] = derivatives by the coordinates of the chart
     add_from_chart  sum_df, sum_ddf += scale[block] * df, ddf by the chart, turned into derivatives by (u, v); ddf NULL: none */
/* Work space of one element; used is zero before the first block. */
typedef struct fs_tensor {
  int32_t n_nodes;
  const double *product; /* [4][4][n_nodes][4][4], as in fs_basis_table */
  uint32_t used;         /* bit g: part g of row holds something */
  double row[16 * 9 * 16], sum[9 * 16 * 16];
} fs_tensor;

typedef void fs_density_kernel(const double *x, double *f, double *df, double *ddf);
typedef struct fs_kernels {
  const char *name;
  fs_density_kernel *curvature_variation, *tangential, *triharmonic;
  void (*jets)(int32_t m, const double *table, const double *c, double *x);
  void (*gradient)(int32_t m, const double *table, const double *df, double *g);
  void (*hessian)(int32_t m_padded, const double *by_point, const double *ddf, double *h);
  void (*hessian_tensor)(fs_tensor *tensor, int32_t block, const double *ddf);
  void (*hessian_tensor_finish)(fs_tensor *tensor, double *h);
  void (*congruence)(int32_t m, int32_t m_padded, int32_t n, const double *T, double *h, double *work, double *out);
  void (*add_scaled)(int32_t n, const double *scale, const double *from, bool is_first, double *to);
  void (*to_chart)(const double *inverse, const double *y, double *z);
  void (*add_from_chart)(const double *inverse, const double *scale, const double *df, const double *ddf,
                         double *sum_df, double *sum_ddf);
} fs_kernels;

/* The best set for this processor. */
const fs_kernels *fs_kernels_choose(void);
/* All sets that this processor can run, the best first, for tests; ends with NULL. */
int32_t fs_kernels_all(const fs_kernels *all[4]);

#ifdef FS_FAIR_LANES_H
/* Runs a kernel for vectors of points over the block: moves the arrays of fs_density to vectors and back. */
typedef void fs_lanes_kernel(const lanes (*p)[3], lanes *f, lanes (*df)[3], lanes (*ddf)[9]);
static inline __attribute__((always_inline)) void fs_density_by_lanes(const double *x, double *f, double *df,
                                                                      double *ddf, fs_lanes_kernel *kernel) {
  lanes p[N_DERIVATIVES][3], value, first[N_DERIVATIVES][3], second[N_PAIRS][9];
  for (int l = 0; l < FS_BLOCK; l += FS_LANES) {
    for (int i = 0; i < 3 * N_DERIVATIVES; i++) p[i / 3][i % 3] = lanes_load(x + i * FS_BLOCK + l);
    kernel((const lanes(*)[3])p, &value, df != NULL ? first : NULL, ddf != NULL ? second : NULL);
    lanes_store(f + l, value);
    if (df != NULL)
      for (int i = 0; i < 3 * N_DERIVATIVES; i++) lanes_store(df + i * FS_BLOCK + l, first[i / 3][i % 3]);
    if (ddf != NULL)
      for (int i = 0; i < 9 * N_PAIRS; i++) lanes_store(ddf + i * FS_BLOCK + l, second[i / 9][i % 9]);
  }
}
#endif

#endif
