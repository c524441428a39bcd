/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: a layer as a model of the library's exporters: as the control net of a smooth surface, or with its polygons as
   they are, each a bilinear patch or a flat triangle. */
#include "formats.h"
#include "build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { AS_WHAT, COLOUR, N_COMMON };
enum { AS_SURFACE, AS_POLYGONS };

static const char *what_choice(int32_t number) {
  static const char *const names[] = {"the smooth surface of this control net", "the polygons as they are", NULL};
  return names[number];
}

static const filter_param common[] = {
    {.name = "what",
     .kind = PARAM_CHOICE,
     .label = "What is written",
     .help =
         "A control net becomes a smooth surface, curvature continuous, refined where it must be; a mesh that is fine "
         "already is written as it is.",
     .choice = what_choice},
    {.name = "colour",
     .kind = PARAM_CHOICE,
     .label = "Colour",
     .help = "A measure of the surface as colours, in formats that have them.",
     .choice = colour_choice}};

/* A switch has the choices no and yes. */
static filter_param_kind kind_of(const fs_param *p) {
  if (p->choices == NULL) return PARAM_NUMBER;
  return strcmp(p->choices[0], "no") == 0 && strcmp(p->choices[1], "yes") == 0 ? PARAM_SWITCH : PARAM_CHOICE;
}

void format_list_params(const fs_exporter *exporter, filter_param params[MAX_FORMAT_PARAMS]) {
  int32_t n = 0;
  while (n < N_COMMON) params[n] = common[n], n++;
  for (const fs_param *p = exporter->params; p != NULL && p->name != NULL && n + 1 < MAX_FORMAT_PARAMS; p++)
    params[n++] = (filter_param){.name = p->name,
                                 .kind = kind_of(p),
                                 .initial = p->initial,
                                 .min = p->min,
                                 .max = p->max,
                                 .label = p->name,
                                 .help = p->summary,
                                 .choices = p->choices};
  params[n] = (filter_param){.name = NULL};
}

const fs_exporter *format_exporter(int32_t number) {
  static const char *const extensions[] = {"pov", "scad", "drc", "glb", "step", NULL};
  for (int32_t i = 0; extensions[i] != NULL; i++) {
    const fs_exporter *e = fs_exporter_find(extensions[i]);
    if (e != NULL && number-- == 0) return e;
  }
  return NULL;
}

const fs_exporter *format_find(const char *extension) {
  const fs_exporter *e;
  for (int32_t i = 0; (e = format_exporter(i)) != NULL; i++)
    if (strcasecmp(e->extension, extension) == 0) return e;
  return NULL;
}

/* ---- polygons as patches -------------------------------------------------------------------------------------------- */

/* Faces of more than four corners are cut into a fan, so that every patch has three or four sides. */
static fs_status cut_large_faces(fs_context *ctx, const polygon_list *p, polygon_list *cut) {
  fs_status status = FS_OK;
  int32_t n = p->face_start[p->n_faces];
  cut->n_vertices = p->n_vertices;
  TAKE(ctx, cut->position, p->n_vertices);
  TAKE(ctx, cut->face_start, (size_t)n + 1);
  TAKE(ctx, cut->corner, 3 * (size_t)n);
  memcpy(cut->position, p->position, (size_t)p->n_vertices * sizeof *cut->position);
  for (int32_t f = 0; f < p->n_faces; f++) {
    const int32_t *c = p->corner + p->face_start[f];
    int32_t size = p->face_start[f + 1] - p->face_start[f];
    for (int32_t k = 1; k + 1 < size; k++) {
      int32_t *to = cut->corner + cut->face_start[cut->n_faces], part = size == 4 ? 4 : 3;
      to[0] = c[0], to[1] = c[k], to[2] = c[k + 1];
      if (part == 4) to[3] = c[3];
      cut->face_start[cut->n_faces + 1] = cut->face_start[cut->n_faces] + part;
      cut->n_faces++;
      if (part == 4) break;
    }
  }
done:
  return status;
}

/* Points of degree 1: u fastest, so that corner 3 of a quadrilateral comes before corner 2. */
static void write_points(const fs_mesh *mesh, int32_t f, double *at) {
  static const int quad[] = {0, 1, 3, 2};
  int32_t n = fs_mesh_face_size(mesh, f);
  for (int32_t k = 0; k < n; k++) {
    fs_vec3 p = mesh->position[mesh->origin[mesh->face_start[f] + (n == 4 ? quad[k] : k)]];
    at[3 * k] = p.x, at[3 * k + 1] = p.y, at[3 * k + 2] = p.z;
  }
}

/* NULL is allowed. The library frees what the library has made, and nothing else. */
static void flat_surface_free(fs_surface *s) {
  if (s == NULL) return;
  free(s->patch);
  free(s->data);
  free(s);
}

/* The surface of a mesh of triangles and quadrilaterals. */
static fs_status flat_surface(fs_context *ctx, const fs_mesh *mesh, fs_surface **surface) {
  fs_status status = FS_OK;
  fs_surface *s = NULL;
  size_t at = 0;
  TAKE(ctx, s, 1);
  TAKE(ctx, s->patch, mesh->n_faces);
  TAKE(ctx, s->data, 3 * (size_t)mesh->n_halfedges);
  s->n_patches = mesh->n_faces;
  s->n_data = 3 * (size_t)mesh->n_halfedges;
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    fs_patch *p = &s->patch[f];
    int32_t n = fs_mesh_face_size(mesh, f);
    *p = (fs_patch){.kind = n == 4 ? FS_PATCH_TENSOR_BEZIER : FS_PATCH_BEZIER_TRIANGLE,
                    .n_sides = n,
                    .degree_u = 1,
                    .degree_v = 1,
                    .data_start = at,
                    .face = f,
                    .valence = 4,
                    .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
    write_points(mesh, f, s->data + at);
    at += 3 * (size_t)n;
    for (int32_t k = 0; k < n; k++) {
      int32_t twin = mesh->twin[mesh->face_start[f] + k];
      if (twin == FS_NONE) continue;
      p->neighbour[k] = mesh->face[twin];
      p->neighbour_side[k] = (uint8_t)(twin - mesh->face_start[mesh->face[twin]]);
    }
  }
  TRY(fs_surface_validate(ctx, s));
  *surface = s;
  s = NULL;
done:
  flat_surface_free(s);
  return status;
}

/* ---- writing ---------------------------------------------------------------------------------------------------------- */

/* The layer as a surface or, of formats that hold nets, as the net itself: mesh, surface and p are for the caller to free. */
static fs_status make_model(fs_context *ctx, const fs_exporter *exporter, const layer *l, bool as_polygons, prepared *p,
                            fs_mesh **mesh, fs_surface **surface) {
  fs_status status = FS_OK;
  polygon_list cut = {0};
  if (as_polygons && exporter->what != FS_EXPORT_SURFACE) {
    TRY(layer_to_mesh(ctx, l, mesh));
  } else if (as_polygons) {
    TRY(cut_large_faces(ctx, &l->polygons, &cut));
    TRY(fs_mesh_create(ctx, cut.n_vertices, cut.position, cut.n_faces, cut.face_start, cut.corner, mesh));
    TRY(flat_surface(ctx, *mesh, surface));
  } else {
    TRY(prepared_create(ctx, l, 0, FS_CAPS_LINEAR, p));
    TRY(fs_surface_create(ctx, p->space, p->space->start, surface));
  }
done:
  polygons_clear(&cut);
  return status;
}

fs_status format_write(fs_context *ctx, const fs_exporter *exporter, const layer *l, const double *param,
                       const char *path) {
  fs_status status = FS_OK;
  prepared p = {0};
  fs_mesh *mesh = NULL;
  fs_surface *surface = NULL;
  filter_param params[MAX_FORMAT_PARAMS];
  char made_with[64];
  fs_model model = {.made_with = made_with};
  snprintf(made_with, sizeof made_with, "fairsurf %s", fs_version());
  format_list_params(exporter, params);
  TRY(params_check(ctx, params, param));
  TRY(make_model(ctx, exporter, l, param[AS_WHAT] == AS_POLYGONS, &p, &mesh, &surface));
  model.control = mesh != NULL ? mesh : p.fine;
  model.surface = surface;
  model.n_refinements = p.n_steps;
  if (param[COLOUR] > 0) model.colour = fs_measures[(int)param[COLOUR] - 1];
  TRY(fs_export_file(ctx, &model, param + N_COMMON, path));
done:
  if (mesh != NULL)
    flat_surface_free(surface);
  else
    fs_surface_free(ctx, surface);
  fs_mesh_free(ctx, mesh);
  prepared_clear(ctx, &p);
  return status;
}
