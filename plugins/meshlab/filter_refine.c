/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the filter that refines a control mesh, as the command refine does. */
#include "build.h"
#include "filters.h"

enum { SCHEME, LEVELS, NEW_LAYER };

static const char *scheme_choice(int32_t number) {
  return fs_refiners[number] != NULL ? fs_refiners[number]->name : NULL;
}

static fs_status run(fs_context *ctx, const layer *l, const double *param, outcome *o) {
  fs_status status = FS_OK;
  fs_mesh *mesh = NULL;
  fs_refinement *fine = NULL, *finer;
  TRY(layer_to_mesh(ctx, l, &mesh));
  for (int32_t i = 0; i < (int32_t)param[LEVELS]; i++) {
    TRY(fs_mesh_refine(ctx, fine != NULL ? fine->mesh : mesh, fs_refiners[(int)param[SCHEME]]->name, NULL, &finer));
    fs_refinement_free(ctx, fine);
    fine = finer;
  }
  TRY(outcome_take_mesh(ctx, fine->mesh, o));
  o->in_new_layer = param[NEW_LAYER] != 0;
  o->suffix = "refined";
  outcome_say(o, "%d -> %d vertices, %d -> %d faces\n", mesh->n_vertices, o->polygons.n_vertices, mesh->n_faces,
              o->polygons.n_faces);
  outcome_add(o, "vertices", o->polygons.n_vertices);
  outcome_add(o, "faces", o->polygons.n_faces);
done:
  fs_refinement_free(ctx, fine);
  fs_mesh_free(ctx, mesh);
  return status;
}

const filter filter_refine = {
    .name = "Fairsurf: Refine control mesh",
    .python_name = "fairsurf_refine_control_mesh",
    .help =
        "Refines a mesh of polygons: <b>averaging</b> makes the control net of the same B-spline surface and gives up "
        "the "
        "outermost ring of faces, <b>catmull-clark</b> keeps the boundary. Polygons are kept: diagonals that MeshLab "
        "adds for drawing are no edges.<br>Lane, Riesenfeld: A theoretical development for the computer generation and "
        "display of piecewise polynomial surfaces (1980). Catmull, Clark: Recursively generated B-spline surfaces on "
        "arbitrary topological meshes (1978).",
    .menu = MENU_REFINE,
    .params = (const filter_param[]){{"scheme", PARAM_CHOICE, 0, 0, 0, "Scheme", "How new vertices come about.",
                                      scheme_choice, NULL},
                                     {"levels", PARAM_INTEGER, 1, 1, 6, "Levels",
                                      "Each makes about four times as many faces; 1 to 6.", NULL, NULL},
                                     PARAM_NEW_LAYER,
                                     {.name = NULL}},
    .run = run,
};
