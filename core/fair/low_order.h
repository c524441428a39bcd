/* SPDX-License-Identifier: MIT */
/* The densities of order 1 and 2; arguments as fs_density.evaluate has them. */
#ifndef FS_FAIR_LOW_ORDER_H
#define FS_FAIR_LOW_ORDER_H

#include <fairsurf/fair.h>

void fs_area(const double *x, double *f, double *df, double *ddf);
void fs_willmore(const double *x, double *f, double *df, double *ddf);
void fs_thin_plate(const double *x, double *f, double *df, double *ddf);

#endif
