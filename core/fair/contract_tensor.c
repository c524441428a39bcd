/* SPDX-License-Identifier: MIT */
/* Single role: the Hessian of a bicubic element axis by axis (sum factorisation). With derivative i = (o_i by u, p_i by v) and
   basis function (x, y):

     X_(xy,a)(kl,b) = sum over points (q, r), i <= j of  N^o_i_x(q) N^p_i_y(r)  U_ia,jb(q, r)  N^o_j_k(q) N^p_j_l(r)

   U: the second derivatives with those on the diagonal i = j halved, so that the Hessian is X + X^T. First the sum over q, for
   each row r and each pair (p_i, p_j) of orders by v; then over those and r: half the work of the dense contraction. */
#include "fair/lanes.h"
#include "fair/kernels.h"

enum { SIDE = 16, N_LANES = SIDE / FS_LANES }; /* pairs of functions of one axis; vectors that hold them */
enum { Z_TILE = FS_LANES == 8 ? 9 : FS_LANES == 4 ? 3 : 1, ROW_TILE = FS_LANES == 8 ? 4 : FS_LANES == 4 ? 2 : 1 };

static const signed char order_u[N_DERIVATIVES] = {1, 0, 2, 1, 0, 3, 2, 1, 0};
static const signed char order_v[N_DERIVATIVES] = {0, 1, 0, 1, 2, 0, 1, 2, 3};

/* row[p_i, p_j][9][16] += over the points l = first .. last - 1 of the block, which are nodes q + l of one row. */
static inline void add_along_u(fs_tensor *t, int32_t q, int first, int last, const double *ddf, double *row) {
  for (int i = 0; i < N_DERIVATIVES; i++)
    for (int j = i; j < N_DERIVATIVES; j++) {
      const double *u = ddf + (size_t)pair_of(i, j) * 9 * FS_BLOCK, half = i == j ? 0.5 : 1.0;
      const double *product = t->product + (size_t)((4 * order_u[i] + order_u[j]) * t->n_nodes + q) * SIDE;
      int part = 4 * order_v[i] + order_v[j];
      double *out = row + (size_t)part * 9 * SIDE;
      bool is_new = !(t->used >> part & 1);
      t->used |= 1u << part;
      for (int z = 0; z < 9; z += Z_TILE) {
        lanes sum[Z_TILE][N_LANES];
        for (int k = 0; k < Z_TILE; k++)
          for (int w = 0; w < N_LANES; w++)
            sum[k][w] = is_new ? (lanes){0} : lanes_load(out + (z + k) * SIDE + w * FS_LANES);
        for (int l = first; l < last; l++) {
          lanes p[N_LANES];
          for (int w = 0; w < N_LANES; w++) p[w] = lanes_load(product + (l - first) * SIDE + w * FS_LANES);
          for (int k = 0; k < Z_TILE; k++) {
            double h = half * u[(z + k) * FS_BLOCK + l];
            for (int w = 0; w < N_LANES; w++) sum[k][w] += h * p[w];
          }
        }
        for (int k = 0; k < Z_TILE; k++)
          for (int w = 0; w < N_LANES; w++) lanes_store(out + (z + k) * SIDE + w * FS_LANES, sum[k][w]);
      }
    }
}

/* sum[9][16][16] += row[p_i, p_j][9][16] times the products of node r along v, where row holds something; empties the row. */
static inline void add_along_v(fs_tensor *t, int32_t r, const double *row, double *sum) {
  for (int z = 0; z < 9; z++)
    for (int x = 0; x < SIDE; x += ROW_TILE) {
      double *out = sum + ((size_t)z * SIDE + x) * SIDE;
      lanes s[ROW_TILE][N_LANES];
      for (int k = 0; k < ROW_TILE; k++)
        for (int w = 0; w < N_LANES; w++) s[k][w] = r == 0 ? (lanes){0} : lanes_load(out + k * SIDE + w * FS_LANES);
      for (int g = 0; g < 16; g++) {
        if (!(t->used >> g & 1)) continue;
        const double *product = t->product + (size_t)(g * t->n_nodes + r) * SIDE, *from = row + (g * 9 + z) * SIDE + x;
        for (int w = 0; w < N_LANES; w++) {
          lanes p = lanes_load(product + w * FS_LANES);
          for (int k = 0; k < ROW_TILE; k++) s[k][w] += from[k] * p;
        }
      }
      for (int k = 0; k < ROW_TILE; k++)
        for (int w = 0; w < N_LANES; w++) lanes_store(out + k * SIDE + w * FS_LANES, s[k][w]);
    }
  t->used = 0;
}

void FS_KERNEL(fs_hessian_tensor)(fs_tensor *t, int32_t block, const double *ddf) {
  int32_t n = t->n_nodes, point = block * FS_BLOCK, end = n * n < point + FS_BLOCK ? n * n : point + FS_BLOCK;
  while (point < end) { /* pieces of rows */
    int32_t q = point % n, r = point / n, stop = (r + 1) * n < end ? (r + 1) * n : end;
    add_along_u(t, q, point - block * FS_BLOCK, stop - block * FS_BLOCK, ddf, t->row);
    if (stop == (r + 1) * n) add_along_v(t, r, t->row, t->sum);
    point = stop;
  }
}

/* h[pair of components][dof][dof] = X + X^T, dof (x, y) being number x + 4 y. */
void FS_KERNEL(fs_hessian_tensor_finish)(fs_tensor *t, double *h) {
  static const signed char pairs[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  for (int pair = 0; pair < 6; pair++) {
    int a = pairs[pair][0], b = pairs[pair][1];
    const double *direct = t->sum + (3 * a + b) * SIDE * SIDE, *turned = t->sum + (3 * b + a) * SIDE * SIDE;
    for (int y = 0; y < 4; y++)
      for (int x = 0; x < 4; x++)
        for (int l = 0; l < 4; l++)
          for (int k = 0; k < 4; k++)
            h[(pair * SIDE + x + 4 * y) * SIDE + k + 4 * l] =
                direct[(4 * x + k) * SIDE + 4 * y + l] + turned[(4 * k + x) * SIDE + 4 * l + y];
  }
}
