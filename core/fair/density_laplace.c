/* SPDX-License-Identifier: MIT */
/* Single role: the densities made of the gradient of the Laplacian, with a = p_uuu + p_uvv, b = p_uuv + p_vvv:

     triharmonic  |a|^2 + |b|^2
     tangential   |a|^2 + |b|^2 - ((n.a)^2 + (n.b)^2) / |n|^2,   n = p_u x p_v      [Kiciak 2013, the penalty Q]
     held         the same with n held: second derivatives are semidefinite

   With g(n, a) = (n.a)^2 / w, w = |n|^2, z = n.a:
     g_a  = 2 z n / w                    g_n  = 2 z a / w - 2 z^2 n / w^2
     g_aa = 2 n n^T / w                  g_an = 2 (n a^T + z I) / w - 4 z n n^T / w^2
     g_nn = 2 a a^T / w - 4 z (a n^T + n a^T) / w^2 - 2 z^2 I / w^2 + 8 z^2 n n^T / w^3
   and n depends on p_u by dn = -p_v x dp_u, on p_v by dn = p_u x dp_v. */
#include "fair/lanes.h"
#include "fair/kernels.h"

/* The two sums and the derivative vectors that each consists of. */
static const int parts[2][2] = {{D_UUU, D_UVV}, {D_UUV, D_VVV}};

static inline void sums(const lanes (*p)[3], lanes (*sum)[3]) {
  for (int k = 0; k < 2; k++)
    for (int a = 0; a < 3; a++) sum[k][a] = p[parts[k][0]][a] + p[parts[k][1]][a];
}

/* block(parts of k, parts of l) += matrix[9], for the pairs in ascending order. */
static inline void add_to_parts(lanes (*ddf)[9], int k, const lanes *matrix) {
  for (int i = 0; i < 2; i++)
    for (int j = i; j < 2; j++)
      for (int e = 0; e < 9; e++) ddf[pair_of(parts[k][i], parts[k][j])][e] += matrix[e];
}

static inline void harmonic(const lanes (*p)[3], lanes *f, lanes (*df)[3], lanes (*ddf)[9]) {
  lanes sum[2][3], identity[9];
  sums(p, sum);
  *f = lanes_dot(sum[0], sum[0]) + lanes_dot(sum[1], sum[1]);
  if (df != NULL) {
    memset(df, 0, sizeof(lanes[N_DERIVATIVES][3]));
    for (int k = 0; k < 2; k++)
      for (int i = 0; i < 2; i++) lanes_scale(df[parts[k][i]], lanes_spread(2.0), sum[k]);
  }
  if (ddf != NULL) {
    memset(ddf, 0, sizeof(lanes[N_PAIRS][9]));
    memset(identity, 0, sizeof identity);
    identity[0] = identity[4] = identity[8] = lanes_spread(2.0);
    for (int k = 0; k < 2; k++) add_to_parts(ddf, k, identity);
  }
}

static inline void held(const lanes (*p)[3], lanes *f, lanes (*df)[3], lanes (*ddf)[9]) {
  lanes sum[2][3], n[3], aa[9];
  harmonic(p, f, df, ddf);
  sums(p, sum);
  lanes_cross(n, p[D_U], p[D_V]);
  lanes w = 1.0 / lanes_dot(n, n);
  for (int k = 0; k < 2; k++) {
    lanes z = lanes_dot(n, sum[k]);
    *f -= z * z * w;
    for (int i = 0; i < 2 && df != NULL; i++)
      for (int a = 0; a < 3; a++) df[parts[k][i]][a] -= 2.0 * z * w * n[a];
  }
  if (ddf == NULL) return;
  for (int i = 0; i < 9; i++) aa[i] = -2.0 * w * n[i / 3] * n[i % 3];
  for (int k = 0; k < 2; k++) add_to_parts(ddf, k, aa);
}

/* out = A^T M B for the matrices A, B of v -> x x v, or the identity where x is NULL; sign by the caller. */
static inline void cross_columns(const lanes *M, const lanes *x, lanes *out) { /* out = M [x]: row r -> r x x */
  for (int i = 0; i < 3; i++) lanes_cross(out + 3 * i, M + 3 * i, x);
}
static inline void transpose(const lanes *M, lanes *out) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out[3 * i + j] = M[3 * j + i];
}

static inline void tangential(const lanes (*p)[3], lanes *f, lanes (*df)[3], lanes (*ddf)[9]) {
  lanes sum[2][3], n[3], z[2], by_n[3] = {{0}}, nn[9];
  harmonic(p, f, df, ddf);
  sums(p, sum);
  lanes_cross(n, p[D_U], p[D_V]);
  lanes w = 1.0 / lanes_dot(n, n);
  for (int k = 0; k < 2; k++) {
    z[k] = lanes_dot(n, sum[k]);
    *f -= z[k] * z[k] * w;
  }
  if (df == NULL) return;

  for (int k = 0; k < 2; k++)
    for (int a = 0; a < 3; a++) {
      lanes by_sum = 2.0 * z[k] * w * n[a];
      for (int i = 0; i < 2; i++) df[parts[k][i]][a] -= by_sum;
      by_n[a] -= 2.0 * z[k] * w * (sum[k][a] - z[k] * w * n[a]);
    }
  /* df/dp_u . dp_u = by_n . (dp_u x p_v) = dp_u . (p_v x by_n), df/dp_v . dp_v = by_n . (p_u x dp_v) = dp_v . (by_n x p_u) */
  lanes_cross(df[D_U], p[D_V], by_n);
  lanes_cross(df[D_V], by_n, p[D_U]);
  if (ddf == NULL) return;

  memset(nn, 0, sizeof nn);
  for (int k = 0; k < 2; k++) {
    lanes aa[9], an[9], t[9];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        lanes a_i = sum[k][i], a_j = sum[k][j], nn_w = n[i] * n[j] * w;
        aa[3 * i + j] = -2.0 * nn_w;
        an[3 * i + j] = -2.0 * w * (n[i] * a_j - 2.0 * z[k] * nn_w);
        nn[3 * i + j] -=
            2.0 * w * (a_i * a_j - 2.0 * z[k] * w * (a_i * n[j] + n[i] * a_j) + 4.0 * z[k] * z[k] * w * nn_w);
        if (i == j) {
          an[3 * i + j] -= 2.0 * w * z[k];
          nn[3 * i + j] += 2.0 * z[k] * z[k] * w * w;
        }
      }
    add_to_parts(ddf, k, aa);
    /* block (p_u, a) = (an . dn/dp_u)^T with r . (dp_u x p_v) = dp_u . (p_v x r): row r of an -> p_v x r */
    for (int side = 0; side < 2; side++) {
      lanes rows[9], negative[3];
      for (int i = 0; i < 3; i++) negative[i] = -p[D_V][i];
      cross_columns(an, side == 0 ? negative : p[D_U], rows);
      transpose(rows, t);
      for (int i = 0; i < 2; i++)
        for (int e = 0; e < 9; e++) ddf[pair_of(side == 0 ? D_U : D_V, parts[k][i])][e] += t[e];
    }
  }
  /* (p_u, p_u), (p_u, p_v), (p_v, p_v) = A^T nn B, and by_n . (dp_u x dp_v) */
  lanes minus_v[3], right_u[9], right_v[9], t[9], block[9];
  for (int i = 0; i < 3; i++) minus_v[i] = -p[D_V][i];
  cross_columns(nn, minus_v, right_u);
  cross_columns(nn, p[D_U], right_v);
  for (int pair = 0; pair < 3; pair++) {
    transpose(pair == 0 ? right_u : right_v, t);
    cross_columns(t, pair == 2 ? p[D_U] : minus_v, block); /* (A^T nn B)^T */
    transpose(block, t);
    lanes *out = ddf[pair_of(pair == 2 ? D_V : D_U, pair == 0 ? D_U : D_V)];
    for (int e = 0; e < 9; e++) out[e] += t[e];
  }
  lanes *out = ddf[pair_of(D_U, D_V)]; /* dp_u . (dp_v x by_n) */
  out[1] += by_n[2];
  out[2] -= by_n[1];
  out[3] -= by_n[2];
  out[5] += by_n[0];
  out[6] += by_n[1];
  out[7] -= by_n[0];
}

FS_DENSITY_KERNELS(triharmonic, ~(FS_PAIRS_TRIHARMONIC), harmonic)
FS_DENSITY_KERNELS(tangential_held, ~(FS_PAIRS_TRIHARMONIC), held)
FS_DENSITY_KERNELS(tangential, ~(FS_PAIRS_TANGENTIAL), tangential)
