/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the filter that lays smooth patches through the vertices of a mesh, as the command patch does. */
#include "build.h"
#include "filters.h"

enum { RULE, TOLERANCE, COLOUR, NEW_LAYER };

/* In the order of fs_edge_rule, from the parameters of the construction. */
static const char *rule_choice(int32_t number) {
  const fs_construction *gregory = fs_construction_find("gregory");
  return gregory->params[0].choices[number];
}

static fs_status run(fs_context *ctx, const layer *l, const double *param, outcome *o) {
  fs_status status = FS_OK;
  fs_mesh *mesh = NULL;
  fs_surface *surface = NULL;
  TRY(layer_to_mesh(ctx, l, &mesh));
  TRY(fs_gregory_create(ctx, mesh, NULL, (fs_edge_rule)param[RULE], &surface));
  TRY(outcome_take_surface(ctx, surface, param[TOLERANCE], (int32_t)param[COLOUR], o));
  o->in_new_layer = param[NEW_LAYER] != 0;
  o->suffix = "patches";
done:
  fs_surface_free(ctx, surface);
  fs_mesh_free(ctx, mesh);
  return status;
}

const filter filter_patches = {
    .name = "Fairsurf: Smooth patches (Gregory)",
    .python_name = "fairsurf_smooth_patches",
    .help =
        "A surface with one tangent plane everywhere (G1) through the vertices of any mesh: a Gregory patch for each "
        "triangle and quadrilateral, several for a larger polygon. Made directly, without fairing, and in no time.<br>"
        "Gregory: Smooth interpolation without twist constraints (1974).",
    .menu = MENU_FAIR,
    .params =
        (const filter_param[]){{"edge_rule", PARAM_CHOICE, 0, 0, 0, "Curves over edges",
                                "arc: as circular arcs; pn: as PN triangles; wm: Walton and Meek.", rule_choice, NULL},
                               PARAM_DENSITY,
                               PARAM_COLOUR,
                               PARAM_NEW_LAYER,
                               {.name = NULL}},
    .run = run,
};
