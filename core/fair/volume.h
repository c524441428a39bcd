/* SPDX-License-Identifier: MIT */
/* The volume between a surface and the origin, which of a closed surface is what it encloses, and its derivatives. */
#ifndef FS_FAIR_VOLUME_H
#define FS_FAIR_VOLUME_H

#include "fair/problem.h"

typedef struct fs_volume fs_volume;

/* The problem is borrowed. */
fs_status fs_volume_create(fs_problem *problem, fs_volume **volume);
void fs_volume_free(fs_volume *volume); /* NULL is allowed */

/* The volume at problem->c, exact but for rounding. With order above FS_VALUE adds factor times its derivatives by the free
   dofs to g[3 n_free], and above FS_GRADIENT to the Hessian. */
fs_status fs_volume_evaluate(fs_volume *volume, fs_order order, double factor, double *value, double *g,
                             fs_sparse *hessian);

#endif
