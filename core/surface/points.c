/* SPDX-License-Identifier: MIT */
/* Single role: a patch at many points: by the kernels of the best instruction set where they know its kind, else point by
   point. */
#include "surface/points.h"
#include "math/kernel_sets.h"
#include "surface/surface.h"

#define DECLARE(suffix)                                                                                                \
  void fs_points_quad##suffix(const double *, int, int32_t, size_t, const double *, const double *, size_t, double *); \
  void fs_points_grid##suffix(int32_t, int32_t, const double *, int32_t, const double *, const double *, double *);    \
  void fs_points_bend##suffix(size_t, size_t, const double *, size_t, double *);                                       \
  void fs_points_triangle##suffix(int32_t, const double *, int32_t, size_t, const double *, const double *, double *); \
  static const fs_points_kernels kernels##suffix = {.name = &#suffix[1],                                               \
                                                    .quad = fs_points_quad##suffix,                                    \
                                                    .grid = fs_points_grid##suffix,                                    \
                                                    .triangle = fs_points_triangle##suffix,                            \
                                                    .bend = fs_points_bend##suffix};

FS_DECLARE_SETS(DECLARE)

int32_t fs_points_kernels_all(const fs_points_kernels *all[3]) {
  int32_t n = 0;
  FS_LIST_SETS(all, n);
  return n;
}

static const fs_points_kernels *choose(void) {
  const fs_points_kernels *all[3];
  fs_points_kernels_all(all);
  return all[0];
}

static bool has_kernel(const fs_patch *patch, int32_t order) {
  return (patch->kind == FS_PATCH_TENSOR_BEZIER || patch->kind == FS_PATCH_GREGORY_QUAD) && patch->part == 0 &&
         patch->degree_u == 3 && patch->degree_v == 3 && order <= 2;
}

void fs_surface_evaluate_points(const fs_surface *surface, int32_t patch, int32_t order, size_t n, const double *u,
                                const double *v, double *out) {
  static const int n_derivatives[4] = {1, 3, 6, FS_JET_SIZE};
  const fs_patch *p = &surface->patch[patch];
  fs_vec3 x[FS_JET_SIZE];
  order = order < 0 ? 0 : order > 3 ? 3 : order;
  if (has_kernel(p, order)) {
    choose()->quad(surface->data + p->data_start, p->kind == FS_PATCH_GREGORY_QUAD, order, n, u, v, n, out);
    return;
  }
  if (p->kind == FS_PATCH_BEZIER_TRIANGLE && p->part == 0 && fs_bezier_triangle_numbers(p) > 0) {
    choose()->triangle(p->degree_u, surface->data + p->data_start, n_derivatives[order], n, u, v, out);
    return;
  }
  for (size_t i = 0; i < n; i++) {
    fs_surface_evaluate(surface, patch, u[i], v[i], x);
    for (int k = 0; k < n_derivatives[order]; k++) {
      double *to = out + 3 * (size_t)k * n + i;
      to[0] = x[k].x, to[n] = x[k].y, to[2 * n] = x[k].z;
    }
  }
}

void fs_surface_evaluate_grid(const fs_surface *surface, int32_t patch, int32_t n, const double *u, const double *v,
                              double *out) {
  const fs_patch *p = &surface->patch[patch];
  const size_t stride = (size_t)n * (size_t)n;
  fs_vec3 x[FS_JET_SIZE];
  if (fs_patch_is_tensor_bezier(p) && n % 8 == 0 && n <= FS_MAX_GRID && p->degree_u >= 0 && p->degree_v >= 0 &&
      p->degree_u <= FS_MAX_DEGREE && p->degree_v <= FS_MAX_DEGREE) {
    choose()->grid(p->degree_u, p->degree_v, surface->data + p->data_start, n, u, v, out);
    return;
  }
  for (size_t i = 0; i < stride; i++) {
    fs_surface_evaluate(surface, patch, u[i % (size_t)n], v[i / (size_t)n], x);
    for (int k = 0; k < FS_JET_SIZE; k++) {
      double *to = out + 3 * (size_t)k * stride + i;
      to[0] = x[k].x, to[stride] = x[k].y, to[2 * stride] = x[k].z;
    }
  }
}

void fs_surface_bend_points(const fs_surface *surface, int32_t patch, size_t n, const double *u, const double *v,
                            double *out) {
  enum { BLOCK = 64 };
  const fs_points_kernels *kernels = choose();
  double jets[18 * BLOCK];
  for (size_t i = 0; i < n; i += BLOCK) {
    size_t count = n - i < BLOCK ? n - i : BLOCK;
    fs_surface_evaluate_points(surface, patch, 2, count, u + i, v + i, jets);
    kernels->bend(count, count, jets, n, out + i);
  }
}
