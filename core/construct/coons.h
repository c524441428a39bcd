/* SPDX-License-Identifier: MIT */
/* What the files of Coons patches share. */
#ifndef FS_CONSTRUCT_COONS_H
#define FS_CONSTRUCT_COONS_H

#include <fairsurf/construct.h>
#include "base/base.h"

/* Side and order of data number a. */
static inline int32_t fs_coons_side(int32_t a) { return a % 2; }
static inline int32_t fs_coons_order(int32_t a) { return a / 2; }

/* Degree and Bernstein coefficients of the blending function of data number a: its derivative of the order of a is 1 on the
   side of a, all others up to the highest order of the data are 0 on both sides. */
int32_t fs_coons_blend_degree(const fs_coons_data *data);
const double *fs_coons_blend(const fs_coons_data *data, int32_t a);

#endif
