/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the filter that makes a surface fair, as the command fair does. */
#include "build.h"
#include "filters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REFINE, FUNCTIONAL, WEIGHT, CAPS, SELECTION, RINGS, RESULT, TOLERANCE, COLOUR, NEW_LAYER };
enum { SELECTION_IGNORED, SELECTION_FIXED, SELECTION_MOVES };
enum { RESULT_SURFACE, RESULT_NET };
enum { LEAST_RINGS = 3 }; /* that fs_space_rim fixes: position, tangent planes, curvature */

static const char *functional_choice(int32_t number) {
  return fs_functionals[number] != NULL ? fs_functionals[number]->name : NULL;
}
static const char *caps_choice(int32_t number) {
  static const char *const names[] = {"as the result can show", "linear", "smooth", "full", NULL};
  return names[number];
}
static const char *selection_choice(int32_t number) {
  static const char *const names[] = {"nothing", "selected vertices stay", "only selected vertices move", NULL};
  return names[number];
}
static const char *result_choice(int32_t number) {
  static const char *const names[] = {"the surface as a mesh", "the control net", NULL};
  return names[number];
}

/* A layer holds no inner coefficients of caps: they pay where the surface itself is the result. */
static fs_cap_inner choose_caps(const double *param) {
  const fs_functional *f = fs_functionals[(int)param[FUNCTIONAL]];
  bool lowers_c = f->is_continued && f->term[0] == &fs_density_curvature_variation;
  if (param[CAPS] > 0) return (fs_cap_inner)(param[CAPS] - 1);
  return lowers_c && param[RESULT] == RESULT_SURFACE ? FS_CAPS_FULL : FS_CAPS_LINEAR;
}

/* fixed[n_dofs]: further rings of vertices at the boundary, ring by ring over faces. */
static fs_status fix_rings(fs_context *ctx, const fs_mesh *mesh, int32_t n_rings, bool *fixed) {
  fs_status status = FS_OK;
  bool *old = NULL;
  TAKE(ctx, old, mesh->n_vertices);
  for (int32_t ring = LEAST_RINGS; ring < n_rings; ring++) {
    memcpy(old, fixed, (size_t)mesh->n_vertices * sizeof *old);
    for (int32_t f = 0; f < mesh->n_faces; f++) {
      bool touches = false;
      for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; h++) touches |= old[mesh->origin[h]];
      for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1] && touches; h++) fixed[mesh->origin[h]] = true;
    }
  }
done:
  free(old);
  return status;
}

/* The vertices of the layer that stay by the selection, carried through the refinements, are added to fixed. */
static fs_status fix_selection(fs_context *ctx, const layer *l, const prepared *p, bool only_selected_move,
                               bool *fixed) {
  fs_status status = FS_OK;
  bool *mark = NULL, *fine = NULL;
  TAKE(ctx, mark, l->polygons.n_vertices);
  for (int32_t v = 0; v < l->polygons.n_vertices; v++) mark[v] = l->selected[v] != only_selected_move;
  for (int32_t s = 0; s < p->n_steps; s++) {
    TAKE(ctx, fine, p->step[s]->mesh->n_vertices);
    fs_refinement_marks(p->step[s], mark, fine);
    free(mark);
    mark = fine, fine = NULL;
  }
  for (int32_t v = 0; v < p->fine->n_vertices; v++) fixed[v] |= mark[v];
done:
  free(mark);
  return status;
}

static fs_status fix(fs_context *ctx, const layer *l, const double *param, const prepared *p, bool *fixed) {
  fs_status status = FS_OK;
  if (param[SELECTION] != SELECTION_IGNORED && l->n_selected == 0)
    return refuse(ctx, FS_ERR_ARGUMENT,
                  "nothing is selected: select vertices or faces, or let the selection mean nothing");
  TRY(fs_space_rim(ctx, p->fine, p->space, fixed));
  if (param[RINGS] > LEAST_RINGS) TRY(fix_rings(ctx, p->fine, (int32_t)param[RINGS], fixed));
  if (param[SELECTION] != SELECTION_IGNORED) TRY(fix_selection(ctx, l, p, param[SELECTION] == SELECTION_MOVES, fixed));
  fs_space_fix_caps(p->space, fixed);
done:
  return status;
}

static void say(const double *param, const prepared *p, const layer *l, const fs_fair_report *r, outcome *o) {
  static const char *const meaning[] = {"ignored", "fixed", "the only ones that move"};
  if (p->n_steps > 0)
    outcome_say(o, "refined %d times: %d -> %d vertices\n", p->n_steps, p->mesh->n_vertices, p->fine->n_vertices);
  if (l->n_selected > 0) outcome_say(o, "%d selected vertices: %s\n", l->n_selected, meaning[(int)param[SELECTION]]);
  if (r->n_free == 0) outcome_say(o, "no vertex is free: the surface stays as it is\n");
  outcome_say(o, "%s: %d free points, %d steps (%s)\n", r->functional->name, r->n_free, r->n_steps,
              fs_stop_text(r->stop));
  outcome_say(o, "curvature variation S: %.9g -> %.9g\n", r->start.S, r->quality.S);
  outcome_add(o, "S_before", r->start.S);
  outcome_add(o, "S_after", r->quality.S);
  outcome_add(o, "free_points", r->n_free);
}

/* The control net at its new positions; the layer's own faces where it was not refined. */
static fs_status take_net(fs_context *ctx, const prepared *p, const fs_vec3 *c, bool in_new_layer, outcome *o) {
  fs_status status = outcome_take_mesh(ctx, p->fine, o);
  if (status != FS_OK) return status;
  memcpy(o->polygons.position, c, (size_t)p->fine->n_vertices * sizeof *c);
  if (p->n_steps == 0 && !in_new_layer) o->polygons.n_faces = 0;
  return FS_OK;
}

static fs_status run(fs_context *ctx, const layer *l, const double *param, outcome *o) {
  fs_status status = FS_OK;
  const fs_functional *functional = fs_functionals[(int)param[FUNCTIONAL]];
  prepared p = {0};
  fs_surface *surface = NULL;
  fs_fair_report *report = NULL;
  fs_vec3 *c = NULL;
  bool *fixed = NULL;
  double value[16] = {0};
  for (int32_t i = 0; functional->params != NULL && functional->params[i].name != NULL && i < 16; i++) {
    value[i] = functional->params[i].initial;
    if (strcmp(functional->params[i].name, "C") == 0 && param[WEIGHT] > 0) value[i] = param[WEIGHT];
  }
  TRY(prepared_create(ctx, l, (int32_t)param[REFINE], choose_caps(param), &p));
  TAKE(ctx, report, 1);
  TAKE(ctx, c, p.space->n_dofs);
  TAKE(ctx, fixed, p.space->n_dofs);
  memcpy(c, p.space->start, (size_t)p.space->n_dofs * sizeof *c);
  TRY(fix(ctx, l, param, &p, fixed));
  TRY(fs_fair(ctx, p.space,
              &(fs_fair_options){.functional = functional, .param = value, .mesh = p.fine, .fixed = fixed}, c, report));
  if (report->stop == FS_STOP_CANCELLED) {
    status = refuse(ctx, FS_ERR_CANCELLED, "stopped; the layer is as it was");
    goto done;
  }
  say(param, &p, l, report, o);
  o->in_new_layer = param[NEW_LAYER] != 0;
  o->suffix = "fair";
  if (param[RESULT] == RESULT_NET) {
    TRY(take_net(ctx, &p, c, o->in_new_layer, o));
  } else {
    TRY(fs_surface_create(ctx, p.space, c, &surface));
    TRY(outcome_take_surface(ctx, surface, param[TOLERANCE], (int32_t)param[COLOUR], o));
  }
done:
  fs_surface_free(ctx, surface);
  prepared_clear(ctx, &p);
  free(report);
  free(c);
  free(fixed);
  return status;
}

const filter filter_fair = {
    .name = "Fairsurf: Fair surface (G2, minimal curvature variation)",
    .python_name = "fairsurf_fair_surface",
    .help = "Takes the mesh as the control net of a smooth surface whose curvature is continuous everywhere, at "
            "vertices where "
            "three, five or more faces meet too, and moves its vertices until the mean curvature varies as little as "
            "possible. "
            "The rim keeps its position, tangent planes and curvature. Use a coarse mesh of quadrilaterals: the smooth "
            "surface "
            "comes out of it as finely as the tolerance asks.<br>Kiciak: Shape optimisation of smooth surfaces with "
            "arbitrary "
            "topology (2013).",
    .menu = MENU_FAIR,
    .params =
        (const filter_param[]){
            {"refine", PARAM_INTEGER, 0, 0, FS_MAX_REFINEMENTS - 2, "Refinements",
             "The control net is refined so often at least; 0: only where its surface needs it.", NULL, NULL},
            {"functional", PARAM_CHOICE, 0, 0, 0, "What becomes least",
             "The integral over the surface that becomes least.", functional_choice, NULL},
            {"C", PARAM_NUMBER, 0, 0, 1e6, "C", "Weight of an even parametrisation; 0: that of the functional.", NULL,
             NULL},
            {"caps", PARAM_CHOICE, 0, 0, 0, "Coefficients inside caps",
             "Around vertices where not four faces meet the surface may also move by itself: more of it, fairer. A "
             "control "
             "net alone cannot show that.",
             caps_choice, NULL},
            {"selection", PARAM_CHOICE, 0, 0, 0, "The selection means", "Vertices of selected faces count as selected.",
             selection_choice, NULL},
            {"rings", PARAM_INTEGER, LEAST_RINGS, LEAST_RINGS, 1000, "Rings fixed at the rim",
             "Rings of vertices from the boundary inwards that stay; three hold position, tangent planes and "
             "curvature.",
             NULL, NULL},
            {"result", PARAM_CHOICE, 0, 0, 0, "Result",
             "The surface as a fine mesh, or its control net, from which exporters make exact patches.", result_choice,
             NULL},
            PARAM_DENSITY,
            PARAM_COLOUR,
            PARAM_NEW_LAYER,
            {.name = NULL}},
    .run = run,
};
