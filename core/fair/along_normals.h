/* SPDX-License-Identifier: MIT */
/* Free dofs that move along normals only: one number each. */
#ifndef FS_FAIR_ALONG_NORMALS_H
#define FS_FAIR_ALONG_NORMALS_H

#include "fair/setup.h"

/* The map of the numbers to the free dofs, with directions to be turned to before use. */
fs_status fs_along_normals_create(fs_setup *setup, fs_reduction **reduction);

/* The reduction of the setup begins at x[3 n_free], with the normals there. */
fs_status fs_along_normals_turn(fs_setup *setup, const double *x);

#endif
