/* SPDX-License-Identifier: MIT */
/* Single role: two patches that continue one auxiliary patch to both sides, as a surface.

   Columns that the junction does not determine are, unless given, those of the polynomial of degree order by v raised to
   degree m:  R_k = R_0 + k (R_1 - R_0) + k (k - 1) / 2 (R_2 - 2 R_1 + R_0), the last term for order 2 only: with
   a = m (R_1 - R_0), b = m (m - 1) (R_2 - 2 R_1 + R_0) the coefficient of a v + b v^2 / 2 is k a / m + k (k - 1) b / (2 m (m - 1)). */
#include "construct/polynomial.h"
#include "math/vec3.h"

#include <fairsurf/construct_junction.h>
#include "base/base.h"

#include <string.h>

static int sign_of(const fs_junction *j) {
  double at;
  return j->function[FS_GAMMA_1] == NULL ? 0 : fs_polynomial_sign(j->degree[FS_GAMMA_1], j->function[FS_GAMMA_1], &at);
}

/* net[(degree_u + 1)(degree_v + 1)] from its first columns, which are there. */
static void fill_columns(int32_t order, int32_t degree_u, int32_t degree_v, const fs_bezier_patch *far, fs_vec3 *net) {
  int32_t n = degree_u + 1;
  for (int32_t k = order + 1; k <= degree_v; k++)
    for (int32_t i = 0; i < n; i++) {
      const fs_vec3 r0 = net[i], r1 = net[i + n], first = fs_vec3_sub(r1, r0);
      fs_vec3 r = fs_vec3_add_scaled(r0, first, k);
      if (order == 2) {
        const fs_vec3 second = fs_vec3_sub(fs_vec3_sub(net[i + 2 * n], r1), first);
        r = fs_vec3_add_scaled(r, second, 0.5 * k * (k - 1));
      }
      net[i + n * k] = far != NULL ? far->point[i + n * k] : r;
    }
}

static void turn_round(int32_t degree_u, int32_t degree_v, fs_vec3 *net) {
  for (int32_t j = 0; j <= degree_v; j++)
    for (int32_t i = 0; 2 * i < degree_u; i++) {
      fs_vec3 *a = &net[i + (degree_u + 1) * j], *b = &net[degree_u - i + (degree_u + 1) * j], kept = *a;
      *a = *b;
      *b = kept;
    }
}

static fs_status check(fs_context *ctx, const fs_junction junction[2], int32_t degree_u, int32_t degree_v,
                       const fs_bezier_patch *const far[2]) {
  int first = sign_of(&junction[0]), second = sign_of(&junction[1]);
  if (first != 0 && first == second)
    return fs_fail(ctx, FS_ERR_ARGUMENT,
                   "gamma1 of both patches is %s: they would lie on one side of the edge and meet in a cusp",
                   first > 0 ? "positive" : "negative");
  for (int k = 0; k < 2 && far != NULL; k++)
    if (far[k] != NULL && (far[k]->degree_u != degree_u || far[k]->degree_v != degree_v))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "patch %d has degree (%d, %d), not (%d, %d)", k, (int)far[k]->degree_u,
                     (int)far[k]->degree_v, (int)degree_u, (int)degree_v);
  return FS_OK;
}

fs_status fs_junction_pair(fs_context *ctx, const fs_bezier_patch *aux, const fs_junction junction[2], int32_t order,
                           int32_t degree_u, int32_t degree_v, const fs_bezier_patch *const far[2],
                           fs_surface **surface) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  size_t n_points = ((size_t)degree_u + 1) * ((size_t)degree_v + 1);
  int positive = sign_of(&junction[0]) >= 0 ? 0 : 1;
  FS_TRY(check(ctx, junction, degree_u, degree_v, far));
  if (degree_u < 1 || degree_v < 1 || degree_u > FS_MAX_DEGREE || degree_v > FS_MAX_DEGREE)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "degree (%d, %d) is not between 1 and %d", (int)degree_u, (int)degree_v,
                   FS_MAX_DEGREE);
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, made->patch, 2);
  FS_ALLOC(ctx, made->data, 6 * n_points);
  made->n_patches = 2;
  made->n_data = 6 * n_points;
  for (int k = 0; k < 2; k++) {
    int from = k == 0 ? positive : 1 - positive;
    fs_vec3 *net = (fs_vec3 *)(void *)(made->data + 3 * n_points * (size_t)k);
    made->patch[k] = (fs_patch){.kind = FS_PATCH_TENSOR_BEZIER,
                                .n_sides = 4,
                                .degree_u = degree_u,
                                .degree_v = degree_v,
                                .data_start = 3 * n_points * (size_t)k,
                                .face = FS_NONE,
                                .valence = 4,
                                .neighbour = {1 - k, FS_NONE, FS_NONE, FS_NONE}};
    FS_TRY(fs_junction_columns(ctx, aux, &junction[from], order, degree_u, degree_v, net));
    fill_columns(order, degree_u, degree_v, far != NULL ? far[from] : NULL, net);
    if (k == 1) turn_round(degree_u, degree_v, net);
  }
  *surface = made;
  made = NULL;
done:
  fs_surface_free(ctx, made);
  return status;
}
