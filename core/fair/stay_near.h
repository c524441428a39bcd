/* SPDX-License-Identifier: MIT */
/* Staying near a target from a start that does: the wall of a setup, and the proof at the end. */
#ifndef FS_FAIR_STAY_NEAR_H
#define FS_FAIR_STAY_NEAR_H

#include "fair/setup.h"

/* Gives the setup a wall at the tolerance, less a little for what lies between its samples. FS_ERR_UNSUPPORTED where the
   surface at the unknowns y is itself farther from the target than the tolerance, with the face. */
fs_status fs_stay_near_begin(fs_setup *setup, const fs_constraints *constraints, const double *y);

/* Measures the surface at y; where it is farther than limit, y moves back towards start until it is not. */
fs_status fs_stay_near_retract(fs_setup *setup, double limit, const double *start, double *y, double *distance);

#endif
