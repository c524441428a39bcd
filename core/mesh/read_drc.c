/* SPDX-License-Identifier: MIT */
/* Single role: Draco files as control meshes: triangles, joined to polygons where a corner attribute keeps them, and the
   marks, texts and inner coefficients of caps that a control net brings along. */
#include "mesh/draco_bridge.h"
#include "mesh/draco_polygons.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is read, on its way to a mesh. */
typedef struct drc {
  fs_context *ctx;
  fs_draco_mesh *draco;
  int32_t position, n_points, n_triangles;
  int32_t *value;    /* [n_points] number of the position of a point */
  int32_t *vertex;   /* [n_values] vertex of a position, or FS_NONE: no triangle uses it */
  int32_t *point;    /* [3 n_triangles] the corners as points, */
  int32_t *corner;   /* and as vertices */
  uint8_t *is_added; /* [3 n_triangles], or NULL: triangles are all there is */
  fs_polygons polygons;
} drc;

static void drc_clear(drc *d) {
  fs_draco_free(d->draco);
  fs_release(d->ctx, d->value);
  fs_release(d->ctx, d->vertex);
  fs_release(d->ctx, d->point);
  fs_release(d->ctx, d->corner);
  fs_release(d->ctx, d->is_added);
  fs_polygons_clear(d->ctx, &d->polygons);
}

/* Points with the same position value are one vertex. */
static fs_status read_corners(drc *d) {
  fs_context *ctx = d->ctx;
  int32_t n_values;
  fs_status status = FS_OK;
  d->position = fs_draco_find(d->draco, FS_DRACO_POSITION, NULL);
  if (d->position == FS_NONE || fs_draco_n_components(d->draco, d->position) != 3)
    return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file has no positions of three coordinates");
  n_values = fs_draco_n_values(d->draco, d->position);
  FS_ALLOC(ctx, d->value, d->n_points);
  FS_ALLOC(ctx, d->vertex, n_values);
  FS_ALLOC(ctx, d->point, 3 * (size_t)d->n_triangles);
  FS_ALLOC(ctx, d->corner, 3 * (size_t)d->n_triangles);
  fs_draco_values_of_points(d->draco, d->position, d->value);
  fs_draco_corners(d->draco, d->point);
  for (int32_t i = 0; i < n_values; i++) d->vertex[i] = FS_NONE;
  for (int32_t h = 0; h < 3 * d->n_triangles; h++) d->vertex[d->value[d->point[h]]] = 0;
  for (int32_t i = 0; i < n_values; i++)
    if (d->vertex[i] != FS_NONE) d->vertex[i] = d->polygons.n_vertices++;
  for (int32_t h = 0; h < 3 * d->n_triangles; h++) d->corner[h] = d->vertex[d->value[d->point[h]]];
done:
  return status;
}

static fs_status read_positions(drc *d) {
  fs_context *ctx = d->ctx;
  int32_t n_values = fs_draco_n_values(d->draco, d->position);
  float *x = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, x, 3 * (size_t)n_values);
  FS_ALLOC(ctx, d->polygons.position, d->polygons.n_vertices);
  fs_draco_values(d->draco, d->position, x);
  for (int32_t i = 0; i < n_values; i++) {
    const float *p = x + 3 * (size_t)i;
    if (d->vertex[i] == FS_NONE) continue;
    if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) {
      status = fs_fail(ctx, FS_ERR_FORMAT, "vertex %d has a coordinate that is not finite", d->vertex[i]);
      goto done;
    }
    d->polygons.position[d->vertex[i]] = (fs_vec3){p[0], p[1], p[2]};
  }
done:
  fs_release(ctx, x);
  return status;
}

/* of_point[n_points], 1 where the generic attribute of that name is not zero; NULL where there is none. */
static fs_status read_marks(drc *d, const char *name, uint8_t **of_point) {
  fs_context *ctx = d->ctx;
  int32_t attribute = fs_draco_find(d->draco, FS_DRACO_GENERIC, name);
  int32_t *value = NULL;
  float *x = NULL;
  uint8_t *mark = NULL;
  fs_status status = FS_OK;
  *of_point = NULL;
  if (attribute == FS_NONE || fs_draco_n_components(d->draco, attribute) != 1) return FS_OK;
  FS_ALLOC(ctx, value, d->n_points);
  FS_ALLOC(ctx, x, fs_draco_n_values(d->draco, attribute));
  FS_ALLOC(ctx, mark, d->n_points);
  fs_draco_values_of_points(d->draco, attribute, value);
  fs_draco_values(d->draco, attribute, x);
  for (int32_t p = 0; p < d->n_points; p++) mark[p] = x[value[p]] != 0;
  *of_point = mark;
  mark = NULL;
done:
  fs_release(ctx, value);
  fs_release(ctx, x);
  fs_release(ctx, mark);
  return status;
}

/* The polygons; without marks every triangle is one. */
static fs_status read_faces(drc *d) {
  fs_context *ctx = d->ctx;
  uint8_t *of_point = NULL;
  fs_status status = FS_OK;
  FS_TRY(read_marks(d, FS_DRACO_ADDED_EDGES, &of_point));
  FS_ALLOC(ctx, d->is_added, 3 * (size_t)d->n_triangles);
  if (of_point != NULL)
    for (int32_t h = 0; h < 3 * d->n_triangles; h++) d->is_added[h] = of_point[d->point[h]];
  FS_TRY(fs_mesh_join_triangles(ctx, d->n_triangles, d->corner, d->is_added, &d->polygons));
done:
  fs_release(ctx, of_point);
  return status;
}

/* A copy as one line of text, or NULL where there is none. */
static fs_status read_text(drc *d, const char *key, char **text) {
  fs_context *ctx = d->ctx;
  size_t size = 0;
  const char *bytes = fs_draco_entry_find(d->draco, key, &size);
  fs_status status = FS_OK;
  if (bytes == NULL) return FS_OK;
  FS_ALLOC(ctx, *text, size + 1);
  for (size_t i = 0; i < size; i++) (*text)[i] = (unsigned char)bytes[i] < 32 || bytes[i] == 127 ? ' ' : bytes[i];
done:
  return status;
}

static fs_status read_notes(drc *d, fs_mesh_notes *notes) {
  fs_context *ctx = d->ctx;
  uint8_t *of_point = NULL;
  char *refinements = NULL;
  fs_status status = FS_OK;
  FS_TRY(read_text(d, FS_DRACO_MADE_WITH, &notes->made_with));
  FS_TRY(read_text(d, FS_DRACO_FUNCTIONAL, &notes->functional));
  FS_TRY(read_text(d, FS_DRACO_REFINEMENTS, &refinements));
  if (refinements != NULL) {
    long n = strtol(refinements, NULL, 10);
    notes->n_refinements = n > 0 && n < INT16_MAX ? (int32_t)n : 0;
  }
  FS_TRY(fs_draco_read_caps(
      ctx, &(fs_draco_triangles){d->draco, d->n_points, d->n_triangles, d->point, d->corner, d->is_added},
      &notes->caps));
  FS_TRY(read_marks(d, FS_DRACO_FIXED, &of_point));
  if (of_point == NULL) goto done;
  FS_ALLOC(ctx, notes->fixed, d->polygons.n_vertices);
  for (int32_t h = 0; h < 3 * d->n_triangles; h++) notes->fixed[d->corner[h]] |= of_point[d->point[h]];
done:
  fs_release(ctx, of_point);
  fs_release(ctx, refinements);
  return status;
}

static fs_status parse_notes(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh, fs_mesh_notes *notes) {
  drc d = {.ctx = ctx};
  fs_polygons *p = &d.polygons;
  fs_mesh_notes found = {0};
  fs_status status = FS_OK;
  FS_TRY(fs_draco_decode(ctx, bytes, size, &d.draco));
  d.n_points = fs_draco_n_points(d.draco);
  d.n_triangles = fs_draco_n_triangles(d.draco);
  FS_TRY(read_corners(&d));
  FS_TRY(read_positions(&d));
  FS_TRY(read_faces(&d));
  if (notes != NULL) FS_TRY(read_notes(&d, &found));
  FS_TRY(fs_mesh_create(ctx, p->n_vertices, p->position, p->n_faces, p->face_start, p->corner, mesh));
  if (notes != NULL) *notes = found;
  found = (fs_mesh_notes){0};
done:
  fs_mesh_notes_clear(ctx, &found);
  drc_clear(&d);
  return status;
}

static fs_status parse(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh) {
  return parse_notes(ctx, bytes, size, mesh, NULL);
}

const fs_reader fs_reader_drc = {"drc", "drc", "Draco: control nets with their polygons, marks and caps, or triangles",
                                 parse, parse_notes};
