/* SPDX-License-Identifier: MIT */
/* Single role: the sets of kernels that were built, and the choice among them at run time. */
#include "fair/kernels.h"

#define DECLARE(suffix)                                                                                                \
  void fs_curvature_variation##suffix(const double *, double *, double *, double *);                                   \
  void fs_tangential##suffix(const double *, double *, double *, double *);                                            \
  void fs_triharmonic##suffix(const double *, double *, double *, double *);                                           \
  void fs_jets##suffix(int32_t, const double *, const double *, double *);                                             \
  void fs_gradient##suffix(int32_t, const double *, const double *, double *);                                         \
  void fs_hessian##suffix(int32_t, const double *, const double *, double *);                                          \
  static const fs_kernels kernels##suffix = {&#suffix[1],                                                              \
                                             fs_curvature_variation##suffix,                                           \
                                             fs_tangential##suffix,                                                    \
                                             fs_triharmonic##suffix,                                                   \
                                             fs_jets##suffix,                                                          \
                                             fs_gradient##suffix,                                                      \
                                             fs_hessian##suffix};

DECLARE(_base)
#ifdef FS_HAVE_X86_KERNELS
DECLARE(_avx2)
DECLARE(_avx512)
#endif

int32_t fs_kernels_all(const fs_kernels *all[4]) {
  int32_t n = 0;
#ifdef FS_HAVE_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) all[n++] = &kernels_avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all[n++] = &kernels_avx2;
#endif
  all[n++] = &kernels_base;
  all[n] = NULL;
  return n;
}

const fs_kernels *fs_kernels_choose(void) {
  const fs_kernels *all[4];
  fs_kernels_all(all);
  return all[0];
}
