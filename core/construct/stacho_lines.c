/* SPDX-License-Identifier: MIT */
/* Single role: Stacho's constructions as lines of the table. */
#include "construct/construct.h"

#include <fairsurf/construct_stacho.h>

static const char *const variants[] = {"second-order", "first-order", "quintic", NULL};
static const char *const tangents[] = {"projection", "chord", "arc", NULL};
static const char *const corrections[] = {"shortest", "fixed", NULL};
static const char *const directions[] = {"perpendicular", "opposite", NULL};

#define VARIANT \
  { "variant", "what triangles take from their corners", FS_STACHO_SECOND_ORDER, 0, 2, variants }

enum { VARIANT_PARAM, TANGENT, CORRECTION };

static fs_status build_surface(fs_context *ctx, const fs_construction_input *input, const double *param,
                               fs_surface **surface) {
  const fs_stacho_options options = {.variant = (fs_stacho_variant)param[VARIANT_PARAM],
                                     .tangent = (fs_stacho_tangent)param[TANGENT],
                                     .is_fixed_direction = param[CORRECTION] != 0};
  return fs_stacho_surface(ctx, input->mesh, input->normal, NULL, &options, surface);
}

const fs_construction fs_construction_stacho = {
    .name = "stacho",
    .summary = "G1 surface through vertices and normals of a triangle mesh",
    .takes = FS_TAKES_MESH,
    .params = (const fs_param[]){VARIANT,
                                 {"tangent", "length of tangents along edges", FS_STACHO_PROJECTION, 0, 2, tangents},
                                 {"correction", "direction of corrections at edges", 0, 0, 1, corrections},
                                 {.name = NULL}},
    .build = build_surface,
};

enum { DIRECTION = 1 };

static fs_status build_graph(fs_context *ctx, const fs_construction_input *input, const double *param,
                             fs_surface **surface) {
  const fs_stacho_graph_options options = {.variant = (fs_stacho_variant)param[VARIANT_PARAM],
                                           .direction = (fs_stacho_direction)param[DIRECTION]};
  return fs_stacho_graph(ctx, input->mesh, NULL, NULL, &options, surface);
}

const fs_construction fs_construction_stacho_graph = {
    .name = "stacho-graph",
    .summary = "C1 graph z(x, y) through the vertices of a triangle mesh, derivatives estimated",
    .takes = FS_TAKES_MESH,
    .params = (const fs_param[]){VARIANT,
                                 {"across", "direction in which derivatives across edges are prescribed",
                                  FS_STACHO_PERPENDICULAR, 0, 1, directions},
                                 {.name = NULL}},
    .build = build_graph,
};
