/* SPDX-License-Identifier: MIT */
/* Functionals whose terms are weighted by the user; functional_sum.c. */
#ifndef FS_FAIR_FUNCTIONAL_SUM_H
#define FS_FAIR_FUNCTIONAL_SUM_H

#include <fairsurf/fair.h>

extern const fs_functional fs_functional_sum, fs_functional_scale_free_sum;

#endif
