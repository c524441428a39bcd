/* SPDX-License-Identifier: MIT */
/* Single role: the Hessian of a bicubic element axis by axis (sum factorisation). With derivative a = (o_a by u, p_a by v) and
   basis function (i, j), i along u:

     X_(ij,x)(kl,y) = sum over points (q, r), pairs (a, b) of  N^o_a_i(q) N^p_a_j(r)  U_ax,by(q, r)  N^o_b_k(q) N^p_b_l(r)

   U: the second derivatives, each pair once, those on the diagonal a = b halved: the Hessian is X + X^T. Pairs are turned such
   that p_a <= p_b, which leaves ten parts (p_a, p_b). First the sum over q and the orders by u, for each row r and each part;
   then over the parts and r. Both sums are factorised once more, one of the two functions after the other:

     T_b,i  = sum over a of N^o_a_i U_ab            part_ik += sum over b of N^o_b_k T_b,i
     V_p',j = sum over p of N^p_j part_(p,p')_ik    X       += sum over p' of N^p'_l V_p',j                                      */
#include "fair/lanes.h"
#include "fair/kernels.h"

#define ALWAYS_INLINE static inline __attribute__((always_inline))

enum { SIDE = FS_TENSOR_SIDE, N_PARTS = FS_TENSOR_PARTS, N_ORDERS = 4 };

/* Derivatives with order p by v, ascending by their order by u: the first of them has first_order[p]. */
static const int n_of[N_ORDERS] = {3, 3, 2, 1}, first_order[N_ORDERS] = {1, 0, 0, 0};
static const int number_of[N_ORDERS][3] = {{D_U, D_UU, D_UUU}, {D_V, D_UV, D_UUV}, {D_VV, D_UVV}, {D_VVV}};
static inline int part_of(int p, int q) { return q * (q + 1) / 2 + p; } /* p <= q */

/* The four functions of one axis, in as many vectors as they need. */
enum { FOUR_LANES = FS_LANES < 4 ? FS_LANES : 4, N_FOUR = 4 / FOUR_LANES };
typedef double four __attribute__((vector_size(8 * FOUR_LANES)));
static inline four four_load(const double *p) {
  four x;
  memcpy(&x, p, sizeof x);
  return x;
}
static inline void four_store(double *p, four x) { memcpy(p, &x, sizeof x); }

/* part[3][k][i] (+)= components (x, 0 … 2) of the pairs of part (p, p2) at n points, which are the nodes of axis[n][4][4];
   ddf: the component (0, 0) of the first pair at the first of the points. */
ALWAYS_INLINE void add_part(int p, int p2, int x, int n, const double *axis, const double *ddf, bool is_new,
                            double *part) {
  four sum[3][4][N_FOUR];
  for (int y = 0; y < 3; y++)
    for (int k = 0; k < 4; k++)
      for (int w = 0; w < N_FOUR; w++)
        sum[y][k][w] = is_new ? (four){0} : four_load(part + (size_t)(4 * y + k) * 4 + w * FOUR_LANES);
  for (int l = 0; l < n; l++) {
    const double *basis = axis + (size_t)l * 4 * N_ORDERS;
    for (int b = 0; b < n_of[p2]; b++) {
      four T[3][N_FOUR] = {{{0}}};
      for (int a = 0; a < n_of[p] && (p < p2 || a <= b); a++) {
        int i = number_of[p][a], j = number_of[p2][b];
        bool is_turned = i > j;
        const double *u = ddf + (size_t)(is_turned ? pair_of(j, i) * 9 + x : pair_of(i, j) * 9 + 3 * x) * FS_BLOCK + l;
        for (int w = 0; w < N_FOUR; w++) {
          four f = four_load(basis + 4 * (first_order[p] + a) + w * FOUR_LANES);
          if (i == j) f *= 0.5;
          for (int y = 0; y < 3; y++) T[y][w] += u[(is_turned ? 3 * y : y) * FS_BLOCK] * f;
        }
      }
      for (int k = 0; k < 4; k++) {
        double f = basis[4 * (first_order[p2] + b) + k];
        for (int y = 0; y < 3; y++)
          for (int w = 0; w < N_FOUR; w++) sum[y][k][w] += f * T[y][w];
      }
    }
  }
  for (int y = 0; y < 3; y++)
    for (int k = 0; k < 4; k++)
      for (int w = 0; w < N_FOUR; w++) four_store(part + (size_t)(4 * y + k) * 4 + w * FOUR_LANES, sum[y][k][w]);
}

/* part[10][9][k][i] (+)= over n points of the block, which are nodes q … of row r. */
static inline void add_along_u(fs_tensor *t, int32_t q, int32_t r, int n, const double *ddf) {
  const double *axis = t->axis_u + (size_t)q * 4 * N_ORDERS;
  bool is_new = q == 0 && t->is_first_u;
  for (int x = 0; x < 3; x++) {
    double *part = t->part + (size_t)(t->keeps_rows ? r : 0) * FS_TENSOR_ROW + (size_t)3 * x * SIDE;
#define ADD_PART(p, p2) add_part(p, p2, x, n, axis, ddf, is_new, part + (size_t)part_of(p, p2) * 9 * SIDE)
    ADD_PART(0, 0);
    ADD_PART(0, 1);
    ADD_PART(1, 1);
    ADD_PART(0, 2);
    ADD_PART(1, 2);
    ADD_PART(2, 2);
    ADD_PART(0, 3);
    ADD_PART(1, 3);
    ADD_PART(2, 3);
    ADD_PART(3, 3);
#undef ADD_PART
  }
}

/* sum[9][j][l][k][i] (+)= the parts of row r; stored, not added, in the first row. */
static inline void add_along_v(fs_tensor *t, int32_t r) {
  enum { TILE = 2 }; /* vectors of (k, i) */
  const double *part = t->part + (size_t)(t->keeps_rows ? r : 0) * FS_TENSOR_ROW;
  bool is_new = r == 0 && t->is_first_v;
  lanes basis[N_ORDERS][4];
  for (int p = 0; p < N_ORDERS; p++)
    for (int j = 0; j < 4; j++) basis[p][j] = lanes_spread(t->axis_v[((size_t)r * N_ORDERS + p) * 4 + j]);
  for (int z = 0; z < 9; z++)
    for (int first = 0; first < SIDE; first += TILE * FS_LANES) {
      const double *from = part + (size_t)z * SIDE + first;
      double *to = t->sum + (size_t)z * SIDE * SIDE + first;
      for (int j = 0; j < 4; j++, to += 4 * SIDE) {
        lanes V[N_ORDERS][TILE];
        for (int p2 = 0; p2 < N_ORDERS; p2++)
          for (int w = 0; w < TILE; w++) {
            V[p2][w] = (lanes){0};
            for (int p = 0; p <= p2; p++)
              V[p2][w] += basis[p][j] * lanes_load(from + (size_t)part_of(p, p2) * 9 * SIDE + w * FS_LANES);
          }
        for (int l = 0; l < 4; l++)
          for (int w = 0; w < TILE; w++) {
            double *at = to + l * SIDE + w * FS_LANES;
            lanes s = is_new ? (lanes){0} : lanes_load(at);
            for (int p2 = 0; p2 < N_ORDERS; p2++) s += basis[p2][l] * V[p2][w];
            lanes_store(at, s);
          }
      }
    }
}

void FS_KERNEL(fs_hessian_tensor)(fs_tensor *t, int32_t block, const double *ddf) {
  int32_t n = t->n_nodes, start = block * FS_BLOCK, end = n * n < start + FS_BLOCK ? n * n : start + FS_BLOCK;
  for (int32_t point = start, stop; point < end; point = stop) { /* pieces of rows */
    int32_t q = point % n, r = point / n;
    stop = (r + 1) * n < end ? (r + 1) * n : end;
    add_along_u(t, q, r, stop - point, ddf + point - start);
    if (stop == (r + 1) * n && t->is_last_u) add_along_v(t, r);
  }
}

/* h[pair of components][dof][dof] = X + X^T, dof (i, j) being number i + 4 j. */
void FS_KERNEL(fs_hessian_tensor_finish)(fs_tensor *t, double *h) {
  static const signed char pairs[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  for (int pair = 0; pair < 6; pair++) {
    int x = pairs[pair][0], y = pairs[pair][1];
    const double *direct = t->sum + (3 * x + y) * SIDE * SIDE, *turned = t->sum + (3 * y + x) * SIDE * SIDE;
    for (int j = 0; j < 4; j++)
      for (int l = x == y ? j : 0; l < 4; l++)
        for (int i = 0; i < 4; i++)
          for (int k = 0; k < 4; k++)
            h[(pair * SIDE + i + 4 * j) * SIDE + k + 4 * l] =
                direct[(4 * j + l) * SIDE + 4 * k + i] + turned[(4 * l + j) * SIDE + 4 * i + k];
  }
}
