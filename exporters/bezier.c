/* SPDX-License-Identifier: MIT */
/* Single role: a surface whose patches are Bezier patches, exactly or within a tolerance. */
#include "bezier.h"
#include "base/base.h"
#include "math/vec3.h"

enum { MAX_DEPTH = 6 };

static bool is_exact(const fs_patch *patch, bool has_triangles) {
  return patch->part == 0 &&
         (patch->kind == FS_PATCH_TENSOR_BEZIER || (has_triangles && patch->kind == FS_PATCH_BEZIER_TRIANGLE));
}

static double diagonal(const fs_surface *surface) {
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY}, x[FS_JET_SIZE];
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      double u, v;
      fs_side_parameters(surface->patch[p].n_sides, s, 0, &u, &v);
      fs_surface_evaluate(surface, p, u, v, x);
      low = fs_vec3_min(low, x[FS_D]), high = fs_vec3_max(high, x[FS_D]);
    }
  return surface->n_patches > 0 ? fs_vec3_distance(low, high) : 0;
}

fs_status fs_bezier_surface(fs_context *ctx, const fs_surface *surface, bool has_triangles, double tolerance,
                            const fs_surface **written, fs_surface **made) {
  double deviation = 0, allowed = tolerance * diagonal(surface);
  bool all_exact = true;
  fs_status status;
  for (int32_t p = 0; p < surface->n_patches; p++) all_exact &= is_exact(&surface->patch[p], has_triangles);
  *made = NULL;
  *written = surface;
  if (all_exact) return FS_OK;
  status = fs_surface_to_bicubics(ctx, surface, allowed, MAX_DEPTH, made, &deviation);
  if (status != FS_OK) return status;
  *written = *made;
  if (deviation > allowed)
    fs_note(ctx, "the bicubic pieces deviate by %.2g, more than the tolerance %.2g", deviation, allowed);
  return FS_OK;
}
