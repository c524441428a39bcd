/* SPDX-License-Identifier: MIT */
/* Surfaces for formats that hold control points of Bezier patches. */
#ifndef FS_EXPORTERS_BEZIER_H
#define FS_EXPORTERS_BEZIER_H

#include "writer.h"

/* The parameter "tolerance" of such exporters. */
#define FS_PARAM_BEZIER_TOLERANCE                                                                                     \
  {                                                                                                                   \
    .name = "tolerance",                                                                                              \
    .summary = "largest distance of bicubic pieces from other patches, as part of the box diagonal", .initial = 1e-4, \
    .min = 1e-9, .max = 1                                                                                             \
  }

/* Where all patches are tensor Bezier patches or, if those may be, Bezier triangles, *written is the surface and *made is
   NULL. Else both are its bicubic pieces within tolerance times the diagonal of its corners, to be freed by the caller; a
   note says where these deviate by more. */
fs_status fs_bezier_surface(fs_context *ctx, const fs_surface *surface, bool has_triangles, double tolerance,
                            const fs_surface **written, fs_surface **made);

#endif
