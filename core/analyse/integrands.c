/* SPDX-License-Identifier: MIT */
/* Single role: the choice among the kernels of integrands.h. */
#include "analyse/integrands.h"

#define DECLARE(suffix)                                                                                       \
  void fs_integrands_at##suffix(size_t, const double *, double *);                                            \
  void fs_integrands_add_up##suffix(int32_t, const double *, const double *, const double *, fs_cell_sums *); \
  static const fs_integrand_kernels kernels##suffix = {&#suffix[1], fs_integrands_at##suffix,                 \
                                                       fs_integrands_add_up##suffix};

DECLARE(_base)
#ifdef FS_HAVE_X86_KERNELS
DECLARE(_avx2)
DECLARE(_avx512)
#endif

int32_t fs_integrand_kernels_all(const fs_integrand_kernels *all[3]) {
  int32_t n = 0;
#ifdef FS_HAVE_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) all[n++] = &kernels_avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all[n++] = &kernels_avx2;
#endif
  all[n++] = &kernels_base;
  return n;
}

const fs_integrand_kernels *fs_integrand_kernels_best(void) {
  const fs_integrand_kernels *all[3];
  fs_integrand_kernels_all(all);
  return all[0];
}
