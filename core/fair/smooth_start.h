/* SPDX-License-Identifier: MIT */
/* Rough starts, which Levenberg-Marquardt steps would work at for long, or end with folds. */
#ifndef FS_FAIR_SMOOTH_START_H
#define FS_FAIR_SMOOTH_START_H

#include "fair/setup.h"

/* Where the surface at the unknowns x[3 fs_setup_n] is rough, and one linear step makes the functional much less: x becomes
   what that leads to, *energy is measured there. Else both stay. options: of the setup. */
fs_status fs_smooth_start(fs_setup *setup, const fs_fair_options *options, double *x, fs_energy *energy);

#endif
