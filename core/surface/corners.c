/* SPDX-License-Identifier: MIT */
/* Which corners of patches are one point: union-find over the corners 4 patch + corner, joined across shared sides. */
#include "surface/surface.h"
#include "math/union_find.h"

fs_status fs_surface_corners(fs_context *ctx, const fs_surface *surface, int32_t *corner, int32_t *n_corners) {
  fs_status status = FS_OK;
  int32_t *parent = NULL, n = 0;
  FS_ALLOC(ctx, parent, 4 * (size_t)surface->n_patches);
  for (int32_t i = 0; i < 4 * surface->n_patches; i++) parent[i] = i;
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      int32_t other = fs_side_across(surface, p, s);
      if (other == FS_NONE) continue;
      /* our corner s is where the side that meets ours ends, our corner s + 1 where it starts */
      int32_t q = other / 4, r = other % 4;
      fs_union_join(parent, 4 * p + s, 4 * q + (r + 1) % surface->patch[q].n_sides);
      fs_union_join(parent, 4 * p + (s + 1) % surface->patch[p].n_sides, 4 * q + r);
    }
  for (int32_t i = 0; i < 4 * surface->n_patches; i++) {
    corner[i] = FS_NONE;
    if (i % 4 >= surface->patch[i / 4].n_sides) continue;
    int32_t root = fs_union_find(parent, i);
    corner[i] = root == i ? n++ : corner[root];
  }
  *n_corners = n;
done:
  fs_release(ctx, parent);
  return status;
}
