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

/* A patch that lies in the data as its control points: a tensor Bezier patch over all of its domain. */
static inline bool fs_patch_is_tensor_bezier(const fs_patch *patch) {
  return patch->kind == FS_PATCH_TENSOR_BEZIER && patch->part == 0;
}

/* Numbers the corners of the patches, corners that shared sides join counted once: corner[4 n_patches] at 4 patch +
   corner; FS_NONE at the fourth of a patch of three. Numbers appear in ascending order, each first at its lowest patch.
   Needs 4 n_patches to fit int32_t. */
fs_status fs_surface_corners(fs_context *ctx, const fs_surface *surface, int32_t *corner, int32_t *n_corners);

/* uv[2] of corner c (counted on beyond the last) and of the middle of the domain of a patch of 3 or 4 sides. */
void fs_domain_corner(int32_t n_sides, int32_t c, double *uv);
void fs_domain_centre(int32_t n_sides, double *uv);

/* The four points of a bicubic piece of width h that its corner (corner_u, corner_v), 0 or 1 each, determines by the jet x
   there; and a point of a bicubic piece. */
void fs_hermite_corner(const fs_vec3 *x, double h, int corner_u, int corner_v, fs_vec3 *piece);
fs_vec3 fs_bicubic_point(const fs_vec3 *piece, double u, double v);

/* All derivatives at all (u_i, v_j) of [0, 1]^2 of a patch with four sides: out[FS_JET_SIZE][3][n n], the point (u_i, v_j) at
   n j + i. Fast for tensor Bezier patches where n is 8, 16 or 24; values agree to rounding. */
void fs_surface_evaluate_grid(const fs_surface *surface, int32_t patch, int32_t n, const double *u, const double *v,
                              double *out);

/* The functions of the table of kinds. */
size_t fs_tensor_bezier_numbers(const fs_patch *patch);
void fs_tensor_bezier_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x);
size_t fs_bezier_triangle_numbers(const fs_patch *patch);
void fs_bezier_triangle_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x);
size_t fs_gregory_quad_numbers(const fs_patch *patch);
void fs_gregory_quad_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x);
size_t fs_gregory_triangle_numbers(const fs_patch *patch);
void fs_gregory_triangle_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x);
size_t fs_stacho_triangle_numbers(const fs_patch *patch);
void fs_stacho_triangle_jet(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x);

#endif
