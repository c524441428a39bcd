/* SPDX-License-Identifier: MIT */
/* What the files of this room, and those that write surfaces, share. */
#ifndef FS_SURFACE_SURFACE_H
#define FS_SURFACE_SURFACE_H

#include <fairsurf/surface.h>
#include "base/base.h"

/* The number 4 patch + side of the side across side s of patch p, or FS_NONE. */
static inline int32_t fs_side_across(const fs_surface *surface, int32_t p, int32_t s) {
  const fs_patch *patch = &surface->patch[p];
  return patch->neighbour[s] == FS_NONE ? FS_NONE : 4 * patch->neighbour[s] + patch->neighbour_side[s];
}

/* Numbers the corners of the patches, corners that shared sides join counted once: corner[4 n_patches] at 4 patch +
   corner. Numbers appear in ascending order, each first at its lowest patch. Needs 4 n_patches to fit int32_t. */
fs_status fs_surface_corners(fs_context *ctx, const fs_surface *surface, int32_t *corner, int32_t *n_corners);

#endif
