/* SPDX-License-Identifier: MIT */
/* Single role: f = |grad_M H|^2 sqrt(det G), its gradient and its exact Hessian by the nine derivatives of the position.

   Division-free form [Kiciak 2013; docs/curvature-variation.md]:
     E F G    first fundamental form            E = p_u.p_u   F = p_u.p_v   G = p_v.p_v
     n        p_u x p_v, not normalised
     L M N    second fundamental form times |n| L = p_uu.n    M = p_uv.n    N = p_vv.n
     W        E G - F^2 = |n|^2
     A        E N - 2 F M + G L                 so that H = A / (2 W^(3/2))
     P        2 W A_u - 3 A W_u                 so that H_u = P / (4 W^(5/2)); Q likewise by v
     f        (G P^2 - 2 F P Q + E Q^2) / (16 W^(11/2))

   Derivatives go along the chain  y -> s -> r -> t -> f:
     y[19]    reduced variables: p_u p_v p_uu p_uv p_vv (15 numbers) and n.p_uuu n.p_uuv n.p_uvv n.p_vvv (4 numbers);
              third derivatives of the position enter f through their products with n only
     s[18]    E F G, their derivatives by u and v, L M N, theirs; each bilinear or trilinear in the position's derivatives
     r[9]     E F G W W_u W_v A A_u A_v, bilinear in s
     t[6]     E F G W P Q
   With J = ds/dy, R = dr/ds, and x1, x2 = gradient and Hessian of f by r:
     df/dy   = (R J)^T x1
     d2f/dy2 = J^T (R^T x2 R J + C J) + sum_k (R^T x1)_k d2 s_k/dy2,   C = sum_i x1_i d2 r_i/ds2.
   The last sum consists of identity blocks (dot products) and skew blocks (triple products). */
#include "fair/lanes.h"
#include "fair/kernels.h"

enum { S_E, S_F, S_G, S_EU, S_EV, S_FU, S_FV, S_GU, S_GV, S_L, S_M, S_N, S_LU, S_LV, S_MU, S_MV, S_NU, S_NV, N_S };
enum { R_E, R_F, R_G, R_W, R_WU, R_WV, R_A, R_AU, R_AV, N_R };
enum { T_E, T_F, T_G, T_W, T_P, T_Q, N_T };
enum { N_FULL = 15, N_REDUCED = 19 }; /* variables of y that are components of vectors; all of them */

/* ---- s and its Jacobian ------------------------------------------------------------------------------------------ */

/* s[18] from the derivatives p[9][3] and the normal n. */
static inline void forms(const lanes (*p)[3], const lanes *n, lanes *s) {
  lanes n_u[3], n_v[3];
  lanes_cross(n_u, p[D_UU], p[D_V]);
  lanes_add_cross(n_u, p[D_U], p[D_UV]);
  lanes_cross(n_v, p[D_UV], p[D_V]);
  lanes_add_cross(n_v, p[D_U], p[D_VV]);
  s[S_E] = lanes_dot(p[D_U], p[D_U]);
  s[S_F] = lanes_dot(p[D_U], p[D_V]);
  s[S_G] = lanes_dot(p[D_V], p[D_V]);
  s[S_EU] = 2.0 * lanes_dot(p[D_U], p[D_UU]);
  s[S_EV] = 2.0 * lanes_dot(p[D_U], p[D_UV]);
  s[S_FU] = lanes_dot(p[D_UU], p[D_V]) + lanes_dot(p[D_U], p[D_UV]);
  s[S_FV] = lanes_dot(p[D_UV], p[D_V]) + lanes_dot(p[D_U], p[D_VV]);
  s[S_GU] = 2.0 * lanes_dot(p[D_V], p[D_UV]);
  s[S_GV] = 2.0 * lanes_dot(p[D_V], p[D_VV]);
  s[S_L] = lanes_dot(p[D_UU], n);
  s[S_M] = lanes_dot(p[D_UV], n);
  s[S_N] = lanes_dot(p[D_VV], n);
  s[S_LU] = lanes_dot(p[D_UUU], n) + lanes_dot(p[D_UU], n_u);
  s[S_LV] = lanes_dot(p[D_UUV], n) + lanes_dot(p[D_UU], n_v);
  s[S_MU] = lanes_dot(p[D_UUV], n) + lanes_dot(p[D_UV], n_u);
  s[S_MV] = lanes_dot(p[D_UVV], n) + lanes_dot(p[D_UV], n_v);
  s[S_NU] = lanes_dot(p[D_UVV], n) + lanes_dot(p[D_VV], n_u);
  s[S_NV] = lanes_dot(p[D_VVV], n) + lanes_dot(p[D_VV], n_v);
}

/* s_k is a sum of triple products (x, y, z) = x . (y x z); each term once here. With x a third derivative the product is one of
   the last four variables of y, and differentiating y and z moves the normal only. */
typedef struct triple {
  signed char k, x, y, z;
} triple;
static const triple triples[] = {
    {S_L, D_UU, D_U, D_V},   {S_M, D_UV, D_U, D_V},   {S_N, D_VV, D_U, D_V},   {S_LU, D_UUU, D_U, D_V},
    {S_LU, D_UU, D_U, D_UV}, {S_LV, D_UUV, D_U, D_V}, {S_LV, D_UU, D_UV, D_V}, {S_LV, D_UU, D_U, D_VV},
    {S_MU, D_UUV, D_U, D_V}, {S_MU, D_UV, D_UU, D_V}, {S_MV, D_UVV, D_U, D_V}, {S_MV, D_UV, D_U, D_VV},
    {S_NU, D_UVV, D_U, D_V}, {S_NU, D_VV, D_UU, D_V}, {S_NU, D_VV, D_U, D_UV}, {S_NV, D_VVV, D_U, D_V},
    {S_NV, D_VV, D_UV, D_V},
};
enum { N_TRIPLES = sizeof triples / sizeof triples[0] };

/* Dot products: s_k contains weight * (x . y). */
typedef struct product {
  signed char k, x, y, weight;
} product;
static const product products[] = {
    {S_E, D_U, D_U, 1},   {S_F, D_U, D_V, 1},   {S_G, D_V, D_V, 1},   {S_EU, D_U, D_UU, 2},
    {S_EV, D_U, D_UV, 2}, {S_FU, D_UU, D_V, 1}, {S_FU, D_U, D_UV, 1}, {S_FV, D_UV, D_V, 1},
    {S_FV, D_U, D_VV, 1}, {S_GU, D_V, D_UV, 2}, {S_GV, D_V, D_VV, 2},
};
enum { N_PRODUCTS = sizeof products / sizeof products[0] };

/* J[y][s], y innermost dimension last: J[19][18] = ds/dy. */
static inline void jacobian(const lanes (*p)[3], const lanes *n, lanes (*J)[N_S]) {
  memset(J, 0, sizeof(lanes[N_REDUCED][N_S]));
  for (int t = 0; t < N_PRODUCTS; t++) {
    product q = products[t];
    for (int a = 0; a < 3; a++) {
      J[3 * q.x + a][q.k] += (double)q.weight * p[q.y][a];
      J[3 * q.y + a][q.k] += (double)q.weight * p[q.x][a];
    }
  }
  for (int t = 0; t < N_TRIPLES; t++) { /* d(x.(y x z)) = dx.(y x z) + dy.(z x x) + dz.(x x y) */
    triple q = triples[t];
    lanes by_y[3], by_z[3];
    lanes_cross(by_y, p[q.z], p[q.x]);
    lanes_cross(by_z, p[q.x], p[q.y]);
    for (int a = 0; a < 3; a++) {
      J[3 * q.y + a][q.k] += by_y[a];
      J[3 * q.z + a][q.k] += by_z[a];
    }
    if (q.x >= D_UUU) {
      J[N_FULL + q.x - D_UUU][q.k] += lanes_spread(1.0);
    } else {
      lanes by_x[3];
      if (q.y == D_U && q.z == D_V)
        memcpy(by_x, n, sizeof by_x);
      else
        lanes_cross(by_x, p[q.y], p[q.z]);
      for (int a = 0; a < 3; a++) J[3 * q.x + a][q.k] += by_x[a];
    }
  }
}

/* ---- r and products with its derivatives ------------------------------------------------------------------------- */

/* out[9] = R j for a column j[18] of J; with j = s / 2 it would be r itself, R being linear in s. */
static inline void r_times(const lanes *s, const lanes *j, lanes *out) {
  out[R_E] = j[S_E];
  out[R_F] = j[S_F];
  out[R_G] = j[S_G];
  out[R_W] = s[S_G] * j[S_E] - 2.0 * s[S_F] * j[S_F] + s[S_E] * j[S_G];
  out[R_WU] = s[S_G] * j[S_EU] + s[S_EU] * j[S_G] + s[S_GU] * j[S_E] + s[S_E] * j[S_GU] -
              2.0 * (s[S_FU] * j[S_F] + s[S_F] * j[S_FU]);
  out[R_WV] = s[S_G] * j[S_EV] + s[S_EV] * j[S_G] + s[S_GV] * j[S_E] + s[S_E] * j[S_GV] -
              2.0 * (s[S_FV] * j[S_F] + s[S_F] * j[S_FV]);
  out[R_A] =
      s[S_N] * j[S_E] + s[S_E] * j[S_N] - 2.0 * (s[S_M] * j[S_F] + s[S_F] * j[S_M]) + s[S_L] * j[S_G] + s[S_G] * j[S_L];
  out[R_AU] = s[S_N] * j[S_EU] + s[S_EU] * j[S_N] + s[S_NU] * j[S_E] + s[S_E] * j[S_NU] -
              2.0 * (s[S_M] * j[S_FU] + s[S_FU] * j[S_M] + s[S_MU] * j[S_F] + s[S_F] * j[S_MU]) + s[S_L] * j[S_GU] +
              s[S_GU] * j[S_L] + s[S_LU] * j[S_G] + s[S_G] * j[S_LU];
  out[R_AV] = s[S_N] * j[S_EV] + s[S_EV] * j[S_N] + s[S_NV] * j[S_E] + s[S_E] * j[S_NV] -
              2.0 * (s[S_M] * j[S_FV] + s[S_FV] * j[S_M] + s[S_MV] * j[S_F] + s[S_F] * j[S_MV]) + s[S_L] * j[S_GV] +
              s[S_GV] * j[S_L] + s[S_LV] * j[S_G] + s[S_G] * j[S_LV];
}

/* out[18] += R^T x without the rows E F G of r. The same sums, with s replaced by j, are C j: r being bilinear. */
static inline void add_bilinear(const lanes *s, const lanes *x, lanes *out) {
  lanes w = x[R_W], wu = x[R_WU], wv = x[R_WV], a = x[R_A], au = x[R_AU], av = x[R_AV];
  out[S_E] += w * s[S_G] + wu * s[S_GU] + wv * s[S_GV] + a * s[S_N] + au * s[S_NU] + av * s[S_NV];
  out[S_F] -= 2.0 * (w * s[S_F] + wu * s[S_FU] + wv * s[S_FV] + a * s[S_M] + au * s[S_MU] + av * s[S_MV]);
  out[S_G] += w * s[S_E] + wu * s[S_EU] + wv * s[S_EV] + a * s[S_L] + au * s[S_LU] + av * s[S_LV];
  out[S_EU] += wu * s[S_G] + au * s[S_N];
  out[S_FU] -= 2.0 * (wu * s[S_F] + au * s[S_M]);
  out[S_GU] += wu * s[S_E] + au * s[S_L];
  out[S_EV] += wv * s[S_G] + av * s[S_N];
  out[S_FV] -= 2.0 * (wv * s[S_F] + av * s[S_M]);
  out[S_GV] += wv * s[S_E] + av * s[S_L];
  out[S_L] += a * s[S_G] + au * s[S_GU] + av * s[S_GV];
  out[S_M] -= 2.0 * (a * s[S_F] + au * s[S_FU] + av * s[S_FV]);
  out[S_N] += a * s[S_E] + au * s[S_EU] + av * s[S_EV];
  out[S_LU] += au * s[S_G];
  out[S_MU] -= 2.0 * au * s[S_F];
  out[S_NU] += au * s[S_E];
  out[S_LV] += av * s[S_G];
  out[S_MV] -= 2.0 * av * s[S_F];
  out[S_NV] += av * s[S_E];
}

static inline void r_transposed_times(const lanes *s, const lanes *x, lanes *out) {
  memset(out, 0, sizeof(lanes[N_S]));
  for (int i = 0; i < 3; i++) out[i] = x[i]; /* S_E S_F S_G are R_E R_F R_G */
  add_bilinear(s, x, out);
}

/* ---- f as a function of r ---------------------------------------------------------------------------------------- */

typedef struct outer {
  lanes f, x1[N_R], x2[N_R][N_R];
} outer;

/* f by r = R s / 2 (E F G: s); x1 and x2 only where asked. */
static inline void outer_function(const lanes *s, int order, outer *o) {
  lanes half[N_S], r[N_R];
  for (int k = 0; k < N_S; k++) half[k] = 0.5 * s[k];
  r_times(s, half, r);
  for (int i = 0; i < 3; i++) r[i] = s[i];
  lanes E = r[R_E], F = r[R_F], G = r[R_G], W = r[R_W];
  lanes P = 2.0 * W * r[R_AU] - 3.0 * r[R_A] * r[R_WU], Q = 2.0 * W * r[R_AV] - 3.0 * r[R_A] * r[R_WV];
  lanes w = 1.0 / W, w2 = w * w, c = w2 * w2 * w * lanes_sqrt(w) * (1.0 / 16.0); /* W^(-11/2) / 16 */
  lanes D = G * P * P - 2.0 * F * P * Q + E * Q * Q;
  o->f = D * c;
  if (order < 1) return;

  lanes k = -5.5 * w, g[N_T], T[2][N_R]; /* g: df/dt; T: rows P and Q of dt/dr */
  g[T_E] = Q * Q * c;
  g[T_F] = -2.0 * P * Q * c;
  g[T_G] = P * P * c;
  g[T_W] = k * D * c;
  g[T_P] = 2.0 * c * (G * P - F * Q);
  g[T_Q] = 2.0 * c * (E * Q - F * P);
  memset(T, 0, sizeof T);
  T[0][R_W] = 2.0 * r[R_AU];
  T[0][R_WU] = -3.0 * r[R_A];
  T[0][R_A] = -3.0 * r[R_WU];
  T[0][R_AU] = 2.0 * W;
  T[1][R_W] = 2.0 * r[R_AV];
  T[1][R_WV] = -3.0 * r[R_A];
  T[1][R_A] = -3.0 * r[R_WV];
  T[1][R_AV] = 2.0 * W;
  for (int i = 0; i < N_R; i++) {
    o->x1[i] = g[T_P] * T[0][i] + g[T_Q] * T[1][i];
    if (i <= R_W) o->x1[i] += g[i];
  }
  if (order < 2) return;

  lanes h[N_T][N_T], U[N_T][N_R]; /* h: d2f/dt2; U = h dt/dr */
  memset(h, 0, sizeof h);
  h[T_E][T_W] = k * g[T_E];
  h[T_E][T_Q] = 2.0 * Q * c;
  h[T_F][T_W] = k * g[T_F];
  h[T_F][T_P] = -2.0 * Q * c;
  h[T_F][T_Q] = -2.0 * P * c;
  h[T_G][T_W] = k * g[T_G];
  h[T_G][T_P] = 2.0 * P * c;
  h[T_W][T_W] = -6.5 * w * g[T_W];
  h[T_W][T_P] = k * g[T_P];
  h[T_W][T_Q] = k * g[T_Q];
  h[T_P][T_P] = 2.0 * G * c;
  h[T_P][T_Q] = -2.0 * F * c;
  h[T_Q][T_Q] = 2.0 * E * c;
  for (int i = 0; i < N_T; i++)
    for (int j = 0; j < i; j++) h[i][j] = h[j][i];
  for (int i = 0; i < N_T; i++)
    for (int j = 0; j < N_R; j++) {
      U[i][j] = h[i][T_P] * T[0][j] + h[i][T_Q] * T[1][j];
      if (j <= R_W) U[i][j] += h[i][j];
    }
  for (int i = 0; i < N_R; i++)
    for (int j = 0; j < N_R; j++) {
      o->x2[i][j] = T[0][i] * U[T_P][j] + T[1][i] * U[T_Q][j];
      if (i <= R_W) o->x2[i][j] += U[i][j];
    }
  /* P and Q are bilinear in r */
  o->x2[R_W][R_AU] += 2.0 * g[T_P];
  o->x2[R_AU][R_W] += 2.0 * g[T_P];
  o->x2[R_A][R_WU] -= 3.0 * g[T_P];
  o->x2[R_WU][R_A] -= 3.0 * g[T_P];
  o->x2[R_W][R_AV] += 2.0 * g[T_Q];
  o->x2[R_AV][R_W] += 2.0 * g[T_Q];
  o->x2[R_A][R_WV] -= 3.0 * g[T_Q];
  o->x2[R_WV][R_A] -= 3.0 * g[T_Q];
}

/* ---- the whole --------------------------------------------------------------------------------------------------- */

/* Rows of s that the vectors p_u … p_vv act on, for the sparse product J^T K. */
static const signed char rows_u[] = {S_E, S_F,  S_EU, S_EV, S_FU, S_FV, S_L, S_M,
                                     S_N, S_LU, S_LV, S_MU, S_MV, S_NU, S_NV};
static const signed char rows_v[] = {S_F, S_G,  S_FU, S_FV, S_GU, S_GV, S_L, S_M,
                                     S_N, S_LU, S_LV, S_MU, S_MV, S_NU, S_NV};
static const signed char rows_uu[] = {S_EU, S_FU, S_L, S_LU, S_LV, S_MU, S_NU};
static const signed char rows_uv[] = {S_EV, S_FU, S_FV, S_GU, S_M, S_LU, S_LV, S_MU, S_MV, S_NU, S_NV};
static const signed char rows_vv[] = {S_FV, S_GV, S_N, S_LV, S_MV, S_NU, S_NV};
static const signed char *const rows_of[5] = {rows_u, rows_v, rows_uu, rows_uv, rows_vv};
static const int n_rows_of[5] = {15, 15, 7, 11, 7};
/* Rows of s that hold n . p_uuu …: one or two each; -1: none. */
static const signed char rows_third[4][2] = {{S_LU, -1}, {S_LV, S_MU}, {S_MV, S_NU}, {S_NV, -1}};

static inline void add_identity(lanes (*block)[9], int i, int j, lanes x) {
  lanes *b = block[i <= j ? pair_of(i, j) : pair_of(j, i)];
  b[0] += x;
  b[4] += x;
  b[8] += x;
}

/* Second derivative of x.(y x z) by x and y is the matrix a -> a x z of rows; written for the pair in ascending order. */
static inline void add_skew(lanes (*block)[9], int x, int y, const lanes *z, lanes scale) {
  lanes s = x <= y ? scale : -scale, *b = block[x <= y ? pair_of(x, y) : pair_of(y, x)];
  b[1] += s * z[2];
  b[2] -= s * z[1];
  b[3] -= s * z[2];
  b[5] += s * z[0];
  b[6] += s * z[1];
  b[7] -= s * z[0];
}

/* The 3x3 blocks of d2f/dy2 = J^T K, without the second derivatives of s. */
static inline void blocks_from_reduced(lanes (*J)[N_S], lanes (*K)[N_S], const lanes *n, lanes (*block)[9]) {
  for (int i = 0; i < 5; i++)
    for (int m = 3 * i; m < N_REDUCED; m++) {
      lanes q[3] = {{0}};
      for (int z = 0; z < n_rows_of[i]; z++) {
        int r = rows_of[i][z];
        for (int a = 0; a < 3; a++) q[a] += J[3 * i + a][r] * K[m][r];
      }
      if (m < N_FULL) {
        lanes *b = block[pair_of(i, m / 3)] + m % 3;
        for (int a = 0; a < 3; a++) b[3 * a] = q[a];
      } else {
        lanes *b = block[pair_of(i, D_UUU + m - N_FULL)];
        for (int a = 0; a < 3; a++)
          for (int c = 0; c < 3; c++) b[3 * a + c] = q[a] * n[c];
      }
    }
  for (int i = 0; i < 4; i++)
    for (int m = i; m < 4; m++) {
      lanes q = K[N_FULL + m][rows_third[i][0]], *b = block[pair_of(D_UUU + i, D_UUU + m)];
      if (rows_third[i][1] >= 0) q += K[N_FULL + m][rows_third[i][1]];
      for (int a = 0; a < 3; a++)
        for (int c = 0; c < 3; c++) b[3 * a + c] = q * n[a] * n[c];
    }
}

/* df = sum_k a_k ds_k/dp. The triple products with p_u and p_v share p_u x p_v: x . n has the derivatives n by x, p_v x x by
   p_u and x x p_u by p_v, and the last two are taken once, for the sum of all such x. */
static inline void gradient(const lanes (*p)[3], const lanes *n, const lanes *a, lanes (*df)[3]) {
  lanes x[3] = {{0}};
  memset(df, 0, sizeof(lanes[N_DERIVATIVES][3]));
  for (int t = 0; t < N_PRODUCTS; t++) {
    product q = products[t];
    lanes scale = (double)q.weight * a[q.k];
    for (int i = 0; i < 3; i++) {
      df[q.x][i] += scale * p[q.y][i];
      df[q.y][i] += scale * p[q.x][i];
    }
  }
  for (int t = 0; t < N_TRIPLES; t++) {
    triple q = triples[t];
    bool is_normal = q.y == D_U && q.z == D_V;
    lanes scaled[3], by_x[3];
    lanes_scale(scaled, a[q.k], p[q.x]);
    if (is_normal) {
      for (int i = 0; i < 3; i++) {
        x[i] += scaled[i];
        df[q.x][i] += a[q.k] * n[i];
      }
      continue;
    }
    lanes_cross(by_x, p[q.y], p[q.z]);
    for (int i = 0; i < 3; i++) df[q.x][i] += a[q.k] * by_x[i];
    lanes_add_cross(df[q.y], p[q.z], scaled);
    lanes_add_cross(df[q.z], scaled, p[q.y]);
  }
  lanes_add_cross(df[D_U], p[D_V], x);
  lanes_add_cross(df[D_V], x, p[D_U]);
}

static inline void evaluate(const lanes (*p)[3], lanes *f, lanes (*df)[3], lanes (*ddf)[9]) {
  lanes n[3], s[N_S], J[N_REDUCED][N_S], J9[N_REDUCED][N_R], X[N_R], K[N_REDUCED][N_S], x1s[N_S];
  int order = ddf != NULL ? 2 : df != NULL ? 1 : 0;
  outer o;
  lanes_cross(n, p[D_U], p[D_V]);
  forms(p, n, s);
  outer_function(s, order, &o);
  *f = o.f;
  if (order < 1) return;

  r_transposed_times(s, o.x1, x1s);
  gradient(p, n, x1s, df);
  if (order < 2) return;

  jacobian(p, n, J);
  for (int m = 0; m < N_REDUCED; m++) r_times(s, J[m], J9[m]);
  for (int m = 0; m < N_REDUCED; m++) {
    for (int i = 0; i < N_R; i++) {
      lanes x = o.x2[i][0] * J9[m][0];
      for (int j = 1; j < N_R; j++) x += o.x2[i][j] * J9[m][j];
      X[i] = x;
    }
    r_transposed_times(s, X, K[m]);
    add_bilinear(J[m], o.x1, K[m]);
  }
  blocks_from_reduced(J, K, n, ddf);
  for (int t = 0; t < N_PRODUCTS; t++) {
    product q = products[t];
    add_identity(ddf, q.x, q.y, (q.x == q.y ? 2.0 : 1.0) * (double)q.weight * x1s[q.k]);
  }
  for (int t = 0; t < N_TRIPLES; t++) {
    triple q = triples[t];
    add_skew(ddf, q.x, q.y, p[q.z], x1s[q.k]);
    add_skew(ddf, q.y, q.z, p[q.x], x1s[q.k]);
    add_skew(ddf, q.z, q.x, p[q.y], x1s[q.k]);
  }
}

FS_DENSITY_KERNELS(curvature_variation, 0, evaluate)
