/* SPDX-License-Identifier: MIT */
/* Single role: the choice among the kernels of integrands.h. */
#include "analyse/integrands.h"
#include "math/kernel_sets.h"

#define DECLARE(suffix)                                                                                       \
  void fs_integrands_at##suffix(size_t, const double *, double *);                                            \
  void fs_integrands_add_up##suffix(int32_t, const double *, const double *, const double *, fs_cell_sums *); \
  static const fs_integrand_kernels kernels##suffix = {&#suffix[1], fs_integrands_at##suffix,                 \
                                                       fs_integrands_add_up##suffix};

FS_DECLARE_SETS(DECLARE)

int32_t fs_integrand_kernels_all(const fs_integrand_kernels *all[3]) {
  int32_t n = 0;
  FS_LIST_SETS(all, n);
  return n;
}

const fs_integrand_kernels *fs_integrand_kernels_best(void) {
  const fs_integrand_kernels *all[3];
  fs_integrand_kernels_all(all);
  return all[0];
}
