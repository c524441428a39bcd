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
               the same for bicubic elements, block by block in order, then h[6][16][16] = the result. Elements side by side
               with the same 16 dofs can be added up: those of a row one after the other, then those of the next row
     congruence  out[6][n][n] = T^T h T for the six pairs of components, h[6][m_padded][m_padded] as hessian leaves it (both
               parts of the result are there), T[m][n], n a multiple of 8, work[m_padded][n]
     add_scaled  to[n][block] (+)= scale[block] * from[n][block]; the first time it is stored, not added
     to_chart  z[9][3][block] = derivatives by the coordinates of the chart
     add_from_chart  sum_df, sum_ddf += scale[block] * df, ddf by the chart, turned into derivatives by (u, v); ddf NULL: none */
/* Work space of one element, or of several that are added up. */
enum { FS_TENSOR_SIDE = 16, FS_TENSOR_PARTS = 10 }; /* pairs of functions of one axis; of orders by v, turned or not */
enum { FS_TENSOR_ROW = FS_TENSOR_PARTS * 9 * FS_TENSOR_SIDE, FS_TENSOR_KEPT_ROWS = 4 };
typedef struct fs_tensor {
  int32_t n_nodes;
  const double *axis_u, *axis_v;          /* [n_nodes][4][4] as in fs_basis_table, of this element */
  bool is_first_u, is_last_u, is_first_v; /* where it stands in the row of elements; in the first row */
  bool keeps_rows;                        /* of nodes, at most FS_TENSOR_KEPT_ROWS, until the last element of the row */
  double part[FS_TENSOR_KEPT_ROWS * FS_TENSOR_ROW], sum[9 * FS_TENSOR_SIDE * FS_TENSOR_SIDE];
} fs_tensor;

typedef void fs_density_kernel(const double *x, double *f, double *df, double *ddf);
/* A density added to a sum of densities: f[block] = its values, df and ddf (+)= scale[block] * its derivatives; is_first: they
   are stored, not added. Only the first n points of the block count: those beyond get 0, not computed where vectors allow. */
typedef void fs_sum_kernel(const double *x, const double *scale, int n, bool is_first, double *f, double *df,
                           double *ddf);
typedef struct fs_kernels {
  const char *name;
  fs_density_kernel *curvature_variation, *tangential, *tangential_held, *triharmonic;
  fs_sum_kernel *sum_curvature_variation, *sum_tangential, *sum_tangential_held, *sum_triharmonic;
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

/* fs_density_tangential with the normals held in its derivatives, the second of which are semidefinite. */
extern const fs_density fs_density_tangential_held;

/* Of the densities whose derivatives by (u, v) are added without further ado; NULL: has none. */
fs_sum_kernel *fs_kernels_sum_of(const fs_kernels *kernels, const fs_density *density);

/* Second derivatives that can differ from zero, as bits of pairs: those of p_uuu + p_uvv and p_uuv + p_vvv, and with the
   normal. */
#define FS_PAIR(i, j) (UINT64_C(1) << ((i)*9 - (i) * ((i)-1) / 2 + (j) - (i)))
#define FS_PAIRS_WITH(i) (FS_PAIR(i, 5) | FS_PAIR(i, 6) | FS_PAIR(i, 7) | FS_PAIR(i, 8))
#define FS_PAIRS_TRIHARMONIC \
  (FS_PAIR(5, 5) | FS_PAIR(5, 7) | FS_PAIR(7, 7) | FS_PAIR(6, 6) | FS_PAIR(6, 8) | FS_PAIR(8, 8))
#define FS_PAIRS_TANGENTIAL \
  (FS_PAIRS_TRIHARMONIC | FS_PAIR(0, 0) | FS_PAIR(0, 1) | FS_PAIR(1, 1) | FS_PAIRS_WITH(0) | FS_PAIRS_WITH(1))

/* The best set for this processor. */
const fs_kernels *fs_kernels_choose(void);
/* All sets that this processor can run, the best first, for tests; ends with NULL. */
int32_t fs_kernels_all(const fs_kernels *all[4]);

#ifdef FS_FAIR_LANES_H
/* What both kinds of kernels are made of: a function of vectors of points, run over the block. zero: bit (pair) says that these
   second derivatives always vanish. */
typedef void fs_lanes_kernel(const lanes (*p)[3], lanes *f, lanes (*df)[3], lanes (*ddf)[9]);
static inline __attribute__((always_inline)) void fs_sum_by_lanes(const double *x, const double *scale, int n,
                                                                  bool is_first, uint64_t zero, double *f, double *df,
                                                                  double *ddf, fs_lanes_kernel *kernel) {
  lanes p[N_DERIVATIVES][3], value, first[N_DERIVATIVES][3], second[N_PAIRS][9];
  for (int l = 0; l < FS_BLOCK; l += FS_LANES) {
    lanes factor = lanes_load(scale + l);
    if (l >= n) {
      lanes_store(f + l, (lanes){0});
      for (int i = 0; i < 3 * N_DERIVATIVES && df != NULL && is_first; i++)
        lanes_store(df + i * FS_BLOCK + l, (lanes){0});
      for (int i = 0; i < 9 * N_PAIRS && ddf != NULL && is_first; i++) lanes_store(ddf + i * FS_BLOCK + l, (lanes){0});
      continue;
    }
    for (int i = 0; i < 3 * N_DERIVATIVES; i++) p[i / 3][i % 3] = lanes_load(x + i * FS_BLOCK + l);
    kernel((const lanes(*)[3])p, &value, df != NULL ? first : NULL, ddf != NULL ? second : NULL);
    lanes_store(f + l, value);
    for (int i = 0; i < 3 * N_DERIVATIVES && df != NULL; i++) {
      double *to = df + i * FS_BLOCK + l;
      lanes_store(to, factor * first[i / 3][i % 3] + (is_first ? (lanes){0} : lanes_load(to)));
    }
    if (ddf == NULL) continue;
    for (int pair = 0; pair < N_PAIRS; pair++) {
      double *to = ddf + (size_t)pair * 9 * FS_BLOCK + l;
      if (!is_first && (zero >> pair & 1)) continue;
      for (int i = 0; i < 9; i++, to += FS_BLOCK)
        lanes_store(to, is_first ? factor * second[pair][i] : factor * second[pair][i] + lanes_load(to));
    }
  }
}

/* Defines the two kernels of a density. */
#define FS_DENSITY_KERNELS(name, zero, kernel)                                                                     \
  void FS_KERNEL(fs_sum_##name)(const double *x, const double *scale, int n, bool is_first, double *f, double *df, \
                                double *ddf) {                                                                     \
    fs_sum_by_lanes(x, scale, n, is_first, zero, f, df, ddf, kernel);                                              \
  }                                                                                                                \
  void FS_KERNEL(fs_##name)(const double *x, double *f, double *df, double *ddf) {                                 \
    static const double one[FS_BLOCK] = {1, 1, 1, 1, 1, 1, 1, 1};                                                  \
    FS_KERNEL(fs_sum_##name)(x, one, FS_BLOCK, true, f, df, ddf);                                                  \
  }
#endif

#endif
