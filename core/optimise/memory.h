/* SPDX-License-Identifier: MIT */
/* The last pairs (step, change of the gradient), which correct a factorisation that is no longer up to date. */
#ifndef FS_OPTIMISE_MEMORY_H
#define FS_OPTIMISE_MEMORY_H

#include "base/base.h"

enum { FS_MEMORY_PAIRS = 8 };

typedef struct fs_memory {
  size_t n;                                                /* numbers in a vector */
  int32_t n_pairs, newest;                                 /* pairs in use; where the last one lies */
  double *step[FS_MEMORY_PAIRS], *change[FS_MEMORY_PAIRS]; /* [n] each; allocated at first use */
  double product[FS_MEMORY_PAIRS];                         /* step . change > 0 */
} fs_memory;

void fs_memory_release(fs_context *ctx, fs_memory *memory);
void fs_memory_clear(fs_memory *memory); /* after a new factorisation */

/* Keeps a pair; one without positive curvature along the step is passed over. */
fs_status fs_memory_add(fs_context *ctx, fs_memory *memory, const double *step, const double *g_old,
                        const double *g_new);

/* The two halves of d = B g, B the inverse Hessian that the pairs make of K^-1:
     fs_memory_before(m, d, alpha);  d = K^-1 d;  fs_memory_after(m, d, alpha)       alpha[FS_MEMORY_PAIRS]: kept between */
void fs_memory_before(const fs_memory *memory, double *d, double *alpha);
void fs_memory_after(const fs_memory *memory, double *d, const double *alpha);

#endif
