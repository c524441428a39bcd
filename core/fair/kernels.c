/* SPDX-License-Identifier: MIT */
/* Single role: the sets of kernels that were built, and the choice among them at run time. */
#include "fair/kernels.h"
#include "math/kernel_sets.h"

#define DECLARE(suffix)                                                                                               \
  void fs_curvature_variation##suffix(const double *, double *, double *, double *);                                  \
  void fs_tangential##suffix(const double *, double *, double *, double *);                                           \
  void fs_triharmonic##suffix(const double *, double *, double *, double *);                                          \
  void fs_tangential_held##suffix(const double *, double *, double *, double *);                                      \
  fs_sum_kernel fs_sum_curvature_variation##suffix, fs_sum_tangential##suffix, fs_sum_triharmonic##suffix,            \
      fs_sum_tangential_held##suffix;                                                                                 \
  void fs_jets##suffix(int32_t, const double *, const double *, double *);                                            \
  void fs_gradient##suffix(int32_t, const double *, const double *, double *);                                        \
  void fs_hessian##suffix(int32_t, const double *, const double *, double *);                                         \
  void fs_hessian_tensor##suffix(fs_tensor *, int32_t, const double *);                                               \
  void fs_hessian_tensor_finish##suffix(fs_tensor *, double *);                                                       \
  void fs_congruence##suffix(int32_t, int32_t, int32_t, const double *, double *, double *, double *);                \
  void fs_add_scaled##suffix(int32_t, const double *, const double *, bool, double *);                                \
  void fs_to_chart##suffix(const double *, const double *, double *);                                                 \
  void fs_add_from_chart##suffix(const double *, const double *, const double *, const double *, double *, double *); \
  static const fs_kernels kernels##suffix = {.name = &#suffix[1],                                                     \
                                             .curvature_variation = fs_curvature_variation##suffix,                   \
                                             .tangential = fs_tangential##suffix,                                     \
                                             .triharmonic = fs_triharmonic##suffix,                                   \
                                             .tangential_held = fs_tangential_held##suffix,                           \
                                             .sum_tangential_held = fs_sum_tangential_held##suffix,                   \
                                             .sum_curvature_variation = fs_sum_curvature_variation##suffix,           \
                                             .sum_tangential = fs_sum_tangential##suffix,                             \
                                             .sum_triharmonic = fs_sum_triharmonic##suffix,                           \
                                             .jets = fs_jets##suffix,                                                 \
                                             .gradient = fs_gradient##suffix,                                         \
                                             .hessian = fs_hessian##suffix,                                           \
                                             .hessian_tensor = fs_hessian_tensor##suffix,                             \
                                             .hessian_tensor_finish = fs_hessian_tensor_finish##suffix,               \
                                             .congruence = fs_congruence##suffix,                                     \
                                             .add_scaled = fs_add_scaled##suffix,                                     \
                                             .to_chart = fs_to_chart##suffix,                                         \
                                             .add_from_chart = fs_add_from_chart##suffix};

FS_DECLARE_SETS(DECLARE)

int32_t fs_kernels_all(const fs_kernels *all[4]) {
  int32_t n = 0;
  FS_LIST_SETS(all, n);
  all[n] = NULL;
  return n;
}

fs_sum_kernel *fs_kernels_sum_of(const fs_kernels *kernels, const fs_density *density) {
  if (density == &fs_density_curvature_variation) return kernels->sum_curvature_variation;
  if (density == &fs_density_tangential) return kernels->sum_tangential;
  if (density == &fs_density_tangential_held) return kernels->sum_tangential_held;
  if (density == &fs_density_triharmonic) return kernels->sum_triharmonic;
  return NULL;
}

const fs_kernels *fs_kernels_choose(void) {
  const fs_kernels *all[4];
  fs_kernels_all(all);
  return all[0];
}
