/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the filter that colours the vertices of a control net by the curvature of its surface, or by how smoothly the
   patches meet, and logs the numbers of the command check. A vertex shows the surface at the corner of the patches that belongs
   to it; at the rim, which has no patches, at the nearest point. */
#include "build.h"
#include "filters.h"

#include <math.h>
#include <stdlib.h>

enum { MEASURE };
enum { CONTINUITY = 0 }; /* the first choice; then the measures of the library */

static const char *measure_choice(int32_t number) {
  if (number == CONTINUITY) return "G2 deviation";
  return fs_measures[number - 1] != NULL ? fs_measures[number - 1]->name : NULL;
}

/* coarse[v]: the vertex of the mesh after one refinement that comes from v, the one that follows it most closely. */
static fs_status follow(fs_context *ctx, const fs_refinement *r, int32_t *child) {
  fs_status status = FS_OK;
  double *largest = NULL;
  TAKE(ctx, largest, r->n_coarse);
  for (int32_t v = 0; v < r->n_coarse; v++) child[v] = FS_NONE;
  for (int32_t i = 0; i < r->mesh->n_vertices; i++)
    for (int32_t j = r->row_start[i]; j < r->row_start[i + 1]; j++)
      if (r->weight[j] > largest[r->column[j]] + 1e-9) {
        largest[r->column[j]] = r->weight[j];
        child[r->column[j]] = i;
      }
done:
  free(largest);
  return status;
}

/* descendant[n_vertices of the layer]: its vertex of the finest mesh. */
static fs_status descend(fs_context *ctx, const prepared *p, int32_t *descendant) {
  fs_status status = FS_OK;
  int32_t *child = NULL;
  for (int32_t v = 0; v < p->mesh->n_vertices; v++) descendant[v] = v;
  for (int32_t s = 0; s < p->n_steps; s++) {
    TAKE(ctx, child, p->step[s]->n_coarse);
    TRY(follow(ctx, p->step[s], child));
    for (int32_t v = 0; v < p->mesh->n_vertices; v++)
      if (descendant[v] != FS_NONE) descendant[v] = child[descendant[v]];
    free(child);
    child = NULL;
  }
done:
  free(child);
  return status;
}

/* place[n_vertices of the finest mesh]: a corner of a patch at the vertex; patch FS_NONE where there is none. Corner s of an
   element lies on corner s of its face, counted from the half-edge of the element. */
static void find_corners(const prepared *p, fs_place *place) {
  static const double at_u[] = {0, 1, 1, 0}, at_v[] = {0, 0, 1, 1};
  for (int32_t v = 0; v < p->fine->n_vertices; v++) place[v].patch = FS_NONE;
  for (int32_t e = 0; e < p->space->n_elements; e++) {
    int32_t h = p->space->element[e].halfedge;
    for (int32_t s = 0; s < 4; s++, h = fs_mesh_next(p->fine, h))
      if (place[p->fine->origin[h]].patch == FS_NONE) place[p->fine->origin[h]] = (fs_place){e, at_u[s], at_v[s]};
  }
}

/* place[n_vertices of the layer] on the surface. */
static fs_status find_places(fs_context *ctx, const prepared *p, const fs_surface *surface, fs_place *place) {
  fs_status status = FS_OK;
  fs_nearest *nearest = NULL;
  fs_place *corner = NULL;
  int32_t *descendant = NULL;
  TAKE(ctx, corner, p->fine->n_vertices);
  TAKE(ctx, descendant, p->mesh->n_vertices);
  TRY(descend(ctx, p, descendant));
  find_corners(p, corner);
  for (int32_t v = 0; v < p->mesh->n_vertices; v++) {
    fs_near near;
    place[v].patch = FS_NONE;
    if (descendant[v] != FS_NONE) place[v] = corner[descendant[v]];
    if (place[v].patch != FS_NONE) continue;
    if (nearest == NULL) TRY(fs_nearest_create(ctx, surface, &nearest));
    fs_nearest_find(nearest, p->mesh->position[v], &near);
    place[v] = (fs_place){near.patch, near.u, near.v};
  }
done:
  fs_nearest_free(ctx, nearest);
  free(corner);
  free(descendant);
  return status;
}

static void measure_places(const fs_surface *surface, const fs_measure *measure, const fs_place *place, int32_t n,
                           double *value) {
  double param[16] = {0};
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t k = 0; measure->params != NULL && measure->params[k].name != NULL && k < 16; k++)
    param[k] = measure->params[k].initial;
  for (int32_t v = 0; v < n; v++) {
    fs_surface_evaluate(surface, place[v].patch, place[v].u, place[v].v, x);
    value[v] = measure->value(param, x);
  }
}

/* corner[n_patches][4]: the largest jump of curvature at that corner and along the edges that meet there. */
static void spread_jumps(const fs_edges *edges, const fs_continuity *c, double (*corner)[4]) {
  for (int32_t k = 0; k < edges->n_vertices; k++) {
    double jump = isnan(c->vertex[k][FS_JUMP_CURVATURE]) ? 0 : c->vertex[k][FS_JUMP_CURVATURE];
    for (int32_t i = edges->place_start[k]; i < edges->place_start[k + 1]; i++) {
      const fs_place *at = &edges->place[i];
      int s = at->v < 0.5 ? at->u < 0.5 ? 0 : 1 : at->u < 0.5 ? 3 : 2;
      corner[at->patch][s] = fmax(corner[at->patch][s], jump);
    }
  }
  for (int32_t e = 0; e < edges->n_edges; e++)
    for (int i = 0; i < 2; i++) {
      double *at = corner[edges->edge[e].patch[i]];
      int s = edges->edge[e].side[i];
      at[s] = fmax(at[s], c->edge[e][FS_JUMP_CURVATURE]);
      at[(s + 1) % 4] = fmax(at[(s + 1) % 4], c->edge[e][FS_JUMP_CURVATURE]);
    }
}

static fs_status jumps_at_places(fs_context *ctx, const fs_surface *surface, const fs_edges *edges,
                                 const fs_continuity *continuity, const fs_place *place, int32_t n, double *value) {
  fs_status status = FS_OK;
  double(*corner)[4] = NULL;
  TAKE(ctx, corner, surface->n_patches);
  spread_jumps(edges, continuity, corner);
  for (int32_t v = 0; v < n; v++) {
    int s = place[v].v < 0.5 ? place[v].u < 0.5 ? 0 : 1 : place[v].u < 0.5 ? 3 : 2;
    value[v] = corner[place[v].patch][s];
  }
done:
  free(corner);
  return status;
}

static void say(const fs_shape *shape, const fs_continuity *c, outcome *o) {
  outcome_say(o, "area %.9g, curvature variation S %.9g\n", shape->area, shape->S);
  outcome_say(o, "mean curvature H: %.9g .. %.9g\n", shape->H.min, shape->H.max);
  outcome_say(o, "Gaussian curvature K: %.9g .. %.9g\n", shape->K.min, shape->K.max);
  outcome_say(o, "gradient of H: at most %.9g\n", shape->gradient.max);
  outcome_say(o, "where patches meet: angle at most %.3g, relative jump of curvature (G2 deviation) at most %.3g\n",
              c->max[FS_JUMP_NORMAL], c->max[FS_JUMP_CURVATURE]);
  outcome_add(o, "area", shape->area);
  outcome_add(o, "S", shape->S);
  outcome_add(o, "H_min", shape->H.min);
  outcome_add(o, "H_max", shape->H.max);
  outcome_add(o, "K_min", shape->K.min);
  outcome_add(o, "K_max", shape->K.max);
  outcome_add(o, "gradient_max", shape->gradient.max);
  outcome_add(o, "G1_deviation", c->max[FS_JUMP_NORMAL]);
  outcome_add(o, "G2_deviation", c->max[FS_JUMP_CURVATURE]);
}

static fs_status run(fs_context *ctx, const layer *l, const double *param, outcome *o) {
  fs_status status = FS_OK;
  int32_t n = l->polygons.n_vertices;
  prepared p = {0};
  fs_surface *surface = NULL;
  fs_edges *edges = NULL;
  fs_continuity *continuity = NULL;
  fs_continuity_options options = {0};
  fs_place *place = NULL;
  fs_shape shape;
  double *value = NULL;
  TRY(prepared_create(ctx, l, 0, FS_CAPS_LINEAR, &p));
  TRY(fs_surface_create(ctx, p.space, p.space->start, &surface));
  TRY(fs_shape_measure(ctx, surface, 0, &shape));
  options.curvature_scale = shape.curvature, options.diameter = shape.diameter;
  TRY(fs_edges_create(ctx, surface, 0, &edges));
  TRY(fs_continuity_measure(ctx, surface, edges, &options, &continuity));
  TAKE(ctx, place, n);
  TAKE(ctx, value, n);
  TRY(find_places(ctx, &p, surface, place));
  if (param[MEASURE] == CONTINUITY)
    TRY(jumps_at_places(ctx, surface, edges, continuity, place, n, value));
  else
    measure_places(surface, fs_measures[(int)param[MEASURE] - 1], place, n, value);
  status = outcome_take_quality(ctx, value, n, o);
  value = NULL; /* it is the outcome's now */
  if (status != FS_OK) goto done;
  say(&shape, continuity, o);
done:
  free(value);
  free(place);
  fs_continuity_free(ctx, continuity);
  fs_edges_free(ctx, edges);
  fs_surface_free(ctx, surface);
  prepared_clear(ctx, &p);
  return status;
}

const filter filter_curvature = {
    .name = "Fairsurf: Curvature and continuity",
    .python_name = "fairsurf_curvature_and_continuity",
    .help =
        "Takes the mesh as the control net of a smooth surface and stores a measure of that surface as quality and "
        "colours of the vertices: its mean curvature H, Gaussian curvature K, principal curvatures, the length of the "
        "gradient of H, or the relative jump of curvature where patches meet. The extremes are logged. Nothing but "
        "quality and colours changes.",
    .menu = MENU_CURVATURE,
    .only_colours = true,
    .params = (const filter_param[]){{"measure", PARAM_CHOICE, 1, 0, 0, "Measure",
                                      "mean is positive where the surface bends to its outside.", measure_choice, NULL},
                                     {.name = NULL}},
    .run = run,
};
