/* SPDX-License-Identifier: MIT */
/* What files that make splines share. */
#ifndef FS_SURFACE_SPLINE_H
#define FS_SURFACE_SPLINE_H

#include <fairsurf/surface_splines.h>
#include "math/bspline.h"

/* The knots in u (0) or v (1), borrowed. */
fs_knots fs_spline_knots(const fs_spline *spline, int direction);

/* *spline becomes a copy of a valid one, for fs_spline_free of a whole or fs_splines_free of a list; see fs_spline_create. */
fs_status fs_spline_copy(fs_context *ctx, const fs_spline *like, fs_spline *spline);

extern const fs_surface_reader fs_surface_reader_bv, fs_surface_reader_spl, fs_surface_reader_step,
    fs_surface_reader_stp;

#endif
