/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What filters share on their way from a layer to a surface and from a surface to a mesh. */
#ifndef FS_MESHLAB_BUILD_H
#define FS_MESHLAB_BUILD_H

#include "layer.h"

#ifdef __cplusplus
extern "C" {
#endif

fs_status layer_to_mesh(fs_context *ctx, const layer *l, fs_mesh **mesh);

/* A mesh, refined as often as its space needs. All zero at first. */
typedef struct prepared {
  fs_mesh *mesh;
  fs_refinement *step[FS_MAX_REFINEMENTS];
  int32_t n_steps;
  const fs_mesh *fine; /* of the last step, or mesh */
  fs_space *space;
} prepared;
fs_status prepared_create(fs_context *ctx, const layer *l, int32_t at_least, fs_cap_inner caps, prepared *p);
void prepared_clear(fs_context *ctx, prepared *p);

/* The surface as a mesh with exact normals, within tolerance (per cent of the diagonal of its box); colour: 0, or the number
   of a measure, counted from 1. Cells of four-sided patches become quadrilaterals. */
fs_status outcome_take_surface(fs_context *ctx, const fs_surface *surface, double tolerance, int32_t colour,
                               outcome *o);

/* The ends of a ramp over value[n]: the 2nd and the 98th of 100, since a few wild points must not take all colours. What is
   not finite becomes the middle. value is the outcome's from then on, even on failure. */
fs_status outcome_take_quality(fs_context *ctx, double *value, int32_t n, outcome *o);

#ifdef __cplusplus
}
#endif
#endif
