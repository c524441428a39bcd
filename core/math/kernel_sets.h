/* SPDX-License-Identifier: MIT */
/* The instruction sets that kernels are compiled for (lanes.h), for the files that choose among them at run time. Each has a
   macro DECLARE(suffix), which declares the kernels of one set and their table kernels##suffix. */
#ifndef FS_MATH_KERNEL_SETS_H
#define FS_MATH_KERNEL_SETS_H

#ifdef FS_HAVE_X86_KERNELS
#define FS_DECLARE_SETS(DECLARE) DECLARE(_base) DECLARE(_avx2) DECLARE(_avx512)
/* list[n …]: the tables that this processor can run, the best first; n becomes their number. */
#define FS_LIST_SETS(list, n)                                                                                     \
  do {                                                                                                            \
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) (list)[(n)++] = &kernels_avx512; \
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) (list)[(n)++] = &kernels_avx2;           \
    (list)[(n)++] = &kernels_base;                                                                                \
  } while (0)
#else
#define FS_DECLARE_SETS(DECLARE) DECLARE(_base)
#define FS_LIST_SETS(list, n) (list)[(n)++] = &kernels_base
#endif

#endif
