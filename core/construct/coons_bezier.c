/* SPDX-License-Identifier: MIT */
/* Single role: Coons patches of Bezier curves as Bezier patches. With all functions raised to degree m in u, n in v,
     C_ij = sum_a beta_a,i L_a,j + sum_b M_b,i beta_b,j - sum_ab beta_a,i beta_b,j Q_ab.
   Gregory's square is the patch whose twists are those e' of the sides v = j, and for each corner
   +-(1 - x)^2 (1 - y)^2 phi(x, y) (e' - g'), as phi(y, x) = x y - phi(x, y): a Gregory quad. */
#include "construct/coons.h"
#include "math/bernstein.h"
#include "math/vec3.h"

typedef struct raised {
  double blend[FS_COONS_MOST][FS_MAX_DEGREE + 1];
  fs_vec3 curve[FS_COONS_MOST][FS_MAX_DEGREE + 1];
} raised;

void fs_bezier_evaluate(const void *curve, double t, fs_vec3 x[4]) {
  const fs_bezier_curve *c = curve;
  double basis[FS_MAX_DEGREE + 1];
  for (int32_t order = 0; order < 4; order++) {
    x[order] = (fs_vec3){0, 0, 0};
    fs_bernstein_basis(c->degree, t, order, basis);
    for (int32_t i = 0; i <= c->degree; i++) x[order] = fs_vec3_add_scaled(x[order], c->point[i], basis[i]);
  }
}

/* The degree of curves and blending functions in one direction. */
static fs_status find_degree(fs_context *ctx, const fs_coons_data *data, const fs_curve *curve, int32_t *degree) {
  *degree = fs_coons_blend_degree(data);
  for (int32_t a = 0; a < data->n_data; a++) {
    const fs_bezier_curve *c = curve[a].user;
    if (curve[a].evaluate != fs_bezier_evaluate)
      return fs_fail(ctx, FS_ERR_UNSUPPORTED, "the exact patch of a Coons surface needs Bezier curves");
    if (c->degree < 0 || c->degree > FS_MAX_DEGREE)
      return fs_fail(ctx, FS_ERR_UNSUPPORTED, "a side has degree %d, which is not between 0 and %d", (int)c->degree,
                     FS_MAX_DEGREE);
    if (c->degree > *degree) *degree = c->degree;
  }
  return FS_OK;
}

static void raise(const fs_coons_data *data, const fs_curve *curve, int32_t degree, raised *out) {
  for (int32_t a = 0; a < data->n_data; a++) {
    const fs_bezier_curve *c = curve[a].user;
    fs_bernstein_elevate(fs_coons_blend_degree(data), 1, fs_coons_blend(data, a), degree, out->blend[a]);
    fs_bernstein_elevate(c->degree, 3, &c->point[0].x, degree, &out->curve[a][0].x);
  }
}

/* Points of the patch; twists are those of the sides v = j. */
static void set_points(const fs_coons *coons, const raised *in_u, const raised *in_v, int32_t m, int32_t n,
                       double *out) {
  int32_t n_data = coons->data.n_data;
  for (int32_t j = 0; j <= n; j++)
    for (int32_t i = 0; i <= m; i++, out += 3) {
      fs_vec3 sum = {0, 0, 0};
      for (int32_t a = 0; a < n_data; a++) {
        fs_vec3 inner = in_v->curve[a][j];
        for (int32_t b = 0; b < n_data; b++) {
          fs_vec3 Q = coons->corner[a][b];
          if (coons->data.is_gregory && a >= 2 && b >= 2) Q = fs_vec3_add(Q, coons->twist_gap[a - 2][b - 2]);
          inner = fs_vec3_add_scaled(inner, Q, -in_v->blend[b][j]);
        }
        sum = fs_vec3_add_scaled(sum, inner, in_u->blend[a][i]);
        sum = fs_vec3_add_scaled(sum, in_u->curve[a][i], in_v->blend[a][j]);
      }
      out[0] = sum.x, out[1] = sum.y, out[2] = sum.z;
    }
}

/* The points q of a Gregory quad, behind its others. */
static void set_square(const fs_coons *coons, int32_t m, int32_t n, double *point) {
  for (int32_t c = 0; c < 4; c++) {
    int32_t i = c % 2, j = c / 2;
    const double *p = point + 3 * ((i ? m - 1 : 1) + (m + 1) * (j ? n - 1 : 1));
    double *q = point + 3 * ((m + 1) * (n + 1) + c);
    fs_vec3 gap = fs_vec3_scale(coons->twist_gap[i][j], (i == j ? 1 : -1) / 9.0);
    q[0] = p[0] + gap.x, q[1] = p[1] + gap.y, q[2] = p[2] + gap.z;
  }
}

fs_status fs_coons_to_bezier(fs_context *ctx, const fs_coons *coons, fs_surface **surface) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  raised *in = NULL; /* [2] of u, of v */
  int32_t m = 0, n = 0;
  FS_TRY(find_degree(ctx, &coons->data, coons->data.at_v, &m));
  FS_TRY(find_degree(ctx, &coons->data, coons->data.at_u, &n));
  FS_ALLOC(ctx, in, 2);
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, made->patch, 1);
  made->n_patches = 1;
  *made->patch = (fs_patch){.kind = coons->data.is_gregory ? FS_PATCH_GREGORY_QUAD : FS_PATCH_TENSOR_BEZIER,
                            .n_sides = 4,
                            .degree_u = m,
                            .degree_v = n,
                            .face = FS_NONE,
                            .valence = 4,
                            .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  made->n_data = fs_patch_kinds[made->patch->kind].n_numbers(made->patch);
  FS_ALLOC(ctx, made->data, made->n_data);
  raise(&coons->data, coons->data.at_v, m, &in[0]);
  raise(&coons->data, coons->data.at_u, n, &in[1]);
  set_points(coons, &in[0], &in[1], m, n, made->data);
  if (coons->data.is_gregory) set_square(coons, m, n, made->data);
  *surface = made;
  made = NULL;
done:
  fs_release(ctx, in);
  fs_surface_free(ctx, made);
  return status;
}
