/* SPDX-License-Identifier: MIT */
/* Single role: Draco. The control net with its polygons, marks, caps and history, a few bytes per vertex, from which any
   resolution can be made again; or the surface as triangles with the exact normals at their corners and a measure. */
#include "draco_caps.h"
#include "draco_params.h"
#include "floats.h"
#include "measured.h"
#include "writer.h"
#include "base/base.h"
#include "mesh/draco_bridge.h"
#include "mesh/draco_polygons.h"

#include <stdio.h>
#include <string.h>

enum { STEPS, NET_BITS, POSITION_BITS, NORMAL_BITS, MEASURE_BITS };
enum { MAX_ENTRIES = 6, MAX_ATTRIBUTES = 4 };

/* Hands the bytes of a geometry to the file. net: what they must hold, or NULL for plain triangles. */
static fs_status write_geometry(fs_context *ctx, const fs_draco_geometry *geometry, const fs_mesh *net,
                                const fs_output *output) {
  int32_t id[MAX_ATTRIBUTES];
  char *bytes = NULL;
  size_t size = 0;
  fs_draco_mesh *draco = NULL;
  fs_mesh *mesh = NULL;
  fs_writer writer;
  bool is_same;
  fs_status status = FS_OK;
  FS_TRY(fs_draco_encode(ctx, geometry, id, &bytes, &size));
  /* Degenerate triangles and edges of more than two faces would get lost without a word: look at what was written. */
  if (net != NULL) {
    FS_TRY(fs_reader_drc.parse(ctx, bytes, size, &mesh));
    is_same =
        mesh->n_vertices == net->n_vertices && mesh->n_faces == net->n_faces && mesh->n_halfedges == net->n_halfedges;
  } else {
    FS_TRY(fs_draco_decode(ctx, bytes, size, &draco));
    is_same = fs_draco_n_triangles(draco) == geometry->n_triangles;
  }
  if (!is_same) {
    status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "Draco does not keep the faces of this mesh as they are");
    goto done;
  }
  fs_writer_start(&writer, ctx, output, "drc");
  fs_writer_bytes(&writer, bytes, size);
  FS_TRY(fs_writer_finish(&writer));
done:
  fs_release(ctx, bytes);
  fs_draco_free(draco);
  fs_mesh_free(ctx, mesh);
  return status;
}

/* entry[MAX_ENTRIES]; refinements[] is room for a number. Empty texts make files that the library does not read. */
static int32_t collect_entries(const fs_model *model, bool is_net, char refinements[12], fs_draco_entry *entry) {
  int32_t n = 0;
  entry[n++] = (fs_draco_entry){.key = "name", .text = model->name};
  if (model->made_with != NULL && *model->made_with != '\0')
    entry[n++] = (fs_draco_entry){.key = FS_DRACO_MADE_WITH, .text = model->made_with};
  if (model->functional != NULL && *model->functional != '\0')
    entry[n++] = (fs_draco_entry){.key = FS_DRACO_FUNCTIONAL, .text = model->functional};
  snprintf(refinements, 12, "%d", (int)model->n_refinements);
  if (is_net) entry[n++] = (fs_draco_entry){.key = FS_DRACO_REFINEMENTS, .text = refinements};
  if (!is_net && model->colour != NULL && *model->colour->name != '\0')
    entry[n++] = (fs_draco_entry){.key = "measure", .text = model->colour->name};
  return n;
}

/* ---- the control net ---- */

/* Points are a vertex, a mark and the number of a cap or 0, of which each vertex knows one. They are numbered as corners
   meet them: point[4 v + 2 (has a cap) + mark] is 1 + the number. vertex, mark and cap[n_points] take them apart; corner[n]
   goes from vertices to points. cap_of_corner[n]. */
static int32_t make_points(int32_t n, const uint8_t *is_added, const int32_t *cap_of_corner, int32_t *corner,
                           int32_t *point, int32_t *vertex, int32_t *mark, int32_t *cap) {
  int32_t n_points = 0;
  for (int32_t h = 0; h < n; h++) {
    int32_t *p = &point[4 * (size_t)corner[h] + 2 * (cap_of_corner[h] > 0) + is_added[h]];
    if (*p == 0) {
      vertex[n_points] = corner[h];
      mark[n_points] = is_added[h];
      cap[n_points] = cap_of_corner[h];
      *p = ++n_points;
    }
    corner[h] = *p - 1;
  }
  return n_points;
}

/* cap_of_corner[…] of the triangles of all faces: 1 + the number of a cap at the corners of its vertex in the face of its
   spoke. */
static fs_status mark_caps(fs_context *ctx, const fs_mesh *net, const fs_cap_notes *caps, const int32_t *corner,
                           int32_t *cap_of_corner) {
  fs_status status = FS_OK;
  int32_t *cap_of_halfedge = NULL;
  FS_ALLOC(ctx, cap_of_halfedge, net->n_halfedges);
  FS_TRY(fs_draco_caps_spokes(ctx, net, caps, cap_of_halfedge));
  for (int32_t h = 0; h < net->n_halfedges; h++) {
    int32_t face = net->face[h], first = 3 * (net->face_start[face] - 2 * face);
    int32_t n = 3 * (fs_mesh_face_size(net, face) - 2);
    for (int32_t i = first; i < first + n && cap_of_halfedge[h] > 0; i++)
      if (corner[i] == net->origin[h]) cap_of_corner[i] = cap_of_halfedge[h];
  }
done:
  fs_release(ctx, cap_of_halfedge);
  return status;
}

static fs_status write_net(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  static const uint8_t marks[2] = {0, 1};
  const fs_mesh *net = model->control;
  int64_t n_triangles = (int64_t)net->n_halfedges - 2 * (int64_t)net->n_faces, n = 3 * n_triangles;
  int32_t *corner = NULL, *point = NULL, *vertex = NULL, *mark = NULL, *cap_of_corner = NULL, *cap = NULL, n_points;
  int32_t n_caps = model->caps != NULL ? model->caps->n_caps : 0, n_attributes = 2, n_entries;
  fs_blob coefficients = {.ctx = ctx};
  uint8_t *is_added = NULL, *cap_values = NULL;
  float *position = NULL;
  char refinements[12];
  fs_draco_entry entry[MAX_ENTRIES];
  fs_status status = FS_OK;
  if (n > INT32_MAX)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "a net of %lld triangles is too large for Draco", (long long)n_triangles);
  FS_ALLOC(ctx, position, 3 * (size_t)net->n_vertices);
  FS_ALLOC(ctx, corner, n);
  FS_ALLOC(ctx, is_added, n);
  FS_ALLOC(ctx, point, 4 * (size_t)net->n_vertices);
  FS_ALLOC(ctx, vertex, 4 * (size_t)net->n_vertices);
  FS_ALLOC(ctx, mark, 4 * (size_t)net->n_vertices);
  FS_ALLOC(ctx, cap, 4 * (size_t)net->n_vertices);
  FS_ALLOC(ctx, cap_of_corner, n);
  FS_ALLOC(ctx, cap_values, FS_DRACO_CAP_BYTES * ((size_t)n_caps + 1));
  FS_TRY(fs_floats_from_vectors(ctx, net->n_vertices, net->position, position));
  FS_TRY(fs_mesh_split_polygons(ctx, net, corner, is_added));
  n_entries = collect_entries(model, true, refinements, entry);
  if (n_caps > 0) {
    FS_TRY(mark_caps(ctx, net, model->caps, corner, cap_of_corner));
    fs_draco_caps_values(n_caps, cap_values);
    FS_TRY(fs_draco_caps_append(model->caps, &coefficients));
    entry[n_entries++] = (fs_draco_entry){FS_DRACO_CAPS, coefficients.bytes, coefficients.size};
  }
  n_points = make_points((int32_t)n, is_added, cap_of_corner, corner, point, vertex, mark, cap);
  const fs_draco_attribute fixed = {.kind = FS_DRACO_GENERIC,
                                    .name = FS_DRACO_FIXED,
                                    .is_byte = true,
                                    .n_components = 1,
                                    .n_values = net->n_vertices,
                                    .values = model->fixed,
                                    .value_of_point = vertex};
  const fs_draco_attribute caps = {.kind = FS_DRACO_GENERIC,
                                   .name = FS_DRACO_CAP,
                                   .is_byte = true,
                                   .n_components = FS_DRACO_CAP_BYTES,
                                   .n_values = n_caps + 1,
                                   .values = cap_values,
                                   .value_of_point = cap};
  fs_draco_attribute attribute[MAX_ATTRIBUTES] = {{.kind = FS_DRACO_POSITION,
                                                   .n_components = 3,
                                                   .n_values = net->n_vertices,
                                                   .values = position,
                                                   .value_of_point = vertex,
                                                   .bits = (int32_t)param[NET_BITS]},
                                                  {.kind = FS_DRACO_GENERIC,
                                                   .name = FS_DRACO_ADDED_EDGES,
                                                   .is_byte = true,
                                                   .n_components = 1,
                                                   .n_values = 2,
                                                   .values = marks,
                                                   .value_of_point = mark}};
  if (model->fixed != NULL) attribute[n_attributes++] = fixed;
  if (n_caps > 0) attribute[n_attributes++] = caps;
  const fs_draco_geometry geometry = {.n_points = n_points,
                                      .n_triangles = (int32_t)n_triangles,
                                      .corner = corner,
                                      .n_attributes = n_attributes,
                                      .attribute = attribute,
                                      .n_entries = n_entries,
                                      .entry = entry};
  FS_TRY(write_geometry(ctx, &geometry, net, output));
done:
  fs_release(ctx, position);
  fs_release(ctx, corner);
  fs_release(ctx, is_added);
  fs_release(ctx, point);
  fs_release(ctx, vertex);
  fs_release(ctx, mark);
  fs_release(ctx, cap);
  fs_release(ctx, cap_of_corner);
  fs_release(ctx, cap_values);
  fs_blob_clear(&coefficients);
  return status;
}

/* ---- the surface ---- */

static fs_status write_surface(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_triangles *t = NULL;
  float *position = NULL, *normal = NULL, *measure = NULL;
  double *value = NULL;
  char refinements[12];
  fs_draco_entry entry[MAX_ENTRIES];
  fs_status status = FS_OK;
  FS_TRY(fs_tessellate(ctx, model->surface, (int32_t)param[STEPS], &t));
  FS_ALLOC(ctx, position, 3 * (size_t)t->n_vertices);
  FS_ALLOC(ctx, normal, 3 * (size_t)t->n_vertices);
  FS_TRY(fs_floats_from_vectors(ctx, t->n_vertices, t->position, position));
  FS_TRY(fs_floats_from_vectors(ctx, t->n_vertices, t->normal, normal));
  if (model->colour != NULL) {
    FS_ALLOC(ctx, value, t->n_vertices);
    FS_ALLOC(ctx, measure, t->n_vertices);
    FS_TRY(fs_measure_vertices(ctx, model->surface, model->colour, t, value));
    fs_floats_from_values(t->n_vertices, value, measure);
  }
  const fs_draco_attribute attribute[MAX_ATTRIBUTES] = {
      {.kind = FS_DRACO_POSITION,
       .n_components = 3,
       .n_values = t->n_vertices,
       .values = position,
       .bits = (int32_t)param[POSITION_BITS]},
      {.kind = FS_DRACO_NORMAL,
       .n_components = 3,
       .n_values = t->n_vertices,
       .values = normal,
       .bits = (int32_t)param[NORMAL_BITS]},
      {.kind = FS_DRACO_GENERIC,
       .name = model->colour != NULL && *model->colour->name != '\0' ? model->colour->name : NULL,
       .n_components = 1,
       .n_values = t->n_vertices,
       .values = measure,
       .bits = (int32_t)param[MEASURE_BITS]}};
  const fs_draco_geometry geometry = {.n_points = t->n_vertices,
                                      .n_triangles = t->n_triangles,
                                      .corner = t->corner,
                                      .n_attributes = measure != NULL ? 3 : 2,
                                      .attribute = attribute,
                                      .n_entries = collect_entries(model, false, refinements, entry),
                                      .entry = entry};
  FS_TRY(write_geometry(ctx, &geometry, NULL, output));
done:
  fs_release(ctx, value);
  fs_release(ctx, position);
  fs_release(ctx, normal);
  fs_release(ctx, measure);
  fs_triangles_free(ctx, t);
  return status;
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  if (model->surface != NULL) return write_surface(ctx, model, param, output);
  return write_net(ctx, model, param, output);
}

const fs_exporter fs_exporter_draco = {
    .name = "draco",
    .extension = "drc",
    .summary =
        "Draco: the control net with its polygons, fixed vertices and caps, or the surface as triangles with normals "
        "and a measure",
    .params = (const fs_param[]){FS_PARAM_STEPS,
                                 {.name = "net-bits",
                                  .summary = "bits per coordinate of a control net; 0: single precision",
                                  .initial = 16,
                                  .min = 0,
                                  .max = 30},
                                 FS_PARAM_POSITION_BITS,
                                 FS_PARAM_NORMAL_BITS,
                                 FS_PARAM_MEASURE_BITS,
                                 {.name = NULL}},
    .what = FS_EXPORT_BOTH,
    .write = write,
};
