/* SPDX-License-Identifier: MIT */
/* Single role: checks the invariants of a surface. */
#include "surface/surface.h"

#include <math.h>

static fs_status check_patch(fs_context *ctx, const fs_surface *surface, int32_t p) {
  const fs_patch *patch = &surface->patch[p];
  const fs_patch_kind_info *kind;
  size_t n;
  if (patch->kind < 0 || patch->kind >= FS_N_PATCH_KINDS)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "patch %d has the unknown kind %d", (int)p, (int)patch->kind);
  kind = &fs_patch_kinds[patch->kind];
  n = kind->n_numbers(patch);
  if (n == 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "patch %d, a %s, cannot have degree (%d, %d)", (int)p, kind->name,
                   (int)patch->degree_u, (int)patch->degree_v);
  if (patch->n_sides != (patch->part == 0 ? kind->n_sides : 4) || patch->part > kind->n_sides)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "patch %d, part %d of a %s, cannot have %d sides", (int)p, (int)patch->part,
                   kind->name, (int)patch->n_sides);
  if (n > surface->n_data || patch->data_start > surface->n_data - n)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the points of patch %d lie outside the data of the surface", (int)p);
  for (size_t i = 0; i < n; i++)
    if (!isfinite(surface->data[patch->data_start + i]))
      return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)p);
  return FS_OK;
}

static fs_status check_sides(fs_context *ctx, const fs_surface *surface, int32_t p) {
  const fs_patch *patch = &surface->patch[p];
  for (int32_t s = 0; s < 4; s++) {
    int32_t q = patch->neighbour[s], r = patch->neighbour_side[s];
    if (q == FS_NONE) continue;
    if (s >= patch->n_sides || q < 0 || q >= surface->n_patches || r >= surface->patch[q].n_sides)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "side %d of patch %d meets side %d of patch %d, which is not there", (int)s,
                     (int)p, (int)r, (int)q);
    if (surface->patch[q].neighbour[r] != p || surface->patch[q].neighbour_side[r] != s)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "side %d of patch %d meets side %d of patch %d, which meets another", (int)s,
                     (int)p, (int)r, (int)q);
  }
  return FS_OK;
}

fs_status fs_surface_validate(fs_context *ctx, const fs_surface *surface) {
  fs_status status = FS_OK;
  for (int32_t p = 0; p < surface->n_patches; p++) FS_TRY(check_patch(ctx, surface, p));
  for (int32_t p = 0; p < surface->n_patches; p++) FS_TRY(check_sides(ctx, surface, p));
done:
  return status;
}
