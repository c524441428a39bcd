/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What passes between MeshLab and the filters, free of MeshLab's types: a layer as polygons in double precision, and what a
   filter made of it. Filters never change the layer; what they made is written back as a whole, after they succeeded. */
#ifndef FS_MESHLAB_LAYER_H
#define FS_MESHLAB_LAYER_H

#include <fairsurf/fairsurf.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Polygons as fs_mesh_create takes them. All arrays come from malloc. */
typedef struct polygon_list {
  int32_t n_vertices, n_faces;
  fs_vec3 *position;   /* [n_vertices] */
  int32_t *face_start; /* [n_faces + 1] */
  int32_t *corner;     /* [face_start[n_faces]] */
} polygon_list;
void polygons_clear(polygon_list *p);

/* A layer. selected: vertices that are selected, or that belong to a selected face. */
typedef struct layer {
  polygon_list polygons;
  bool *selected; /* [n_vertices] */
  int32_t n_selected;
} layer;
void layer_clear(layer *l);

/* A number that the filter reports; MeshLab from 2022.02 on returns it to scripts. */
typedef struct named_value {
  const char *name;
  double value;
} named_value;

enum { MAX_VALUES = 16 };

/* What a filter made. All zero: nothing. */
typedef struct outcome {
  /* n_faces 0: the faces of the layer stay, and position replaces its own; n_vertices 0: the positions stay too */
  polygon_list polygons;
  bool in_new_layer;
  const char *suffix; /* of the name of the new layer */
  fs_vec3 *normal;    /* [n_vertices of the result] unit normals, or NULL: those of the polygons */
  double *quality;    /* [n_vertices of the result] shown as colours, or NULL */
  double low, high;   /* values at the two ends of the colours */
  int32_t n_values;
  named_value value[MAX_VALUES];
  char log[1600]; /* lines for the user */
} outcome;
void outcome_clear(outcome *o);
void outcome_add(outcome *o, const char *name, double value);
void outcome_say(outcome *o, const char *format, ...) FS_PRINTF(2, 3);

/* Sets the message of the context and returns the status. */
fs_status refuse(fs_context *ctx, fs_status status, const char *format, ...) FS_PRINTF(3, 4);

/* calloc, at least one byte, with the message of the context where there is no memory. */
void *take(fs_context *ctx, size_t n, size_t size);

/* Leaves to done: where a call fails, and where memory is missing. */
#define TRY(call)                   \
  do {                              \
    status = (call);                \
    if (status != FS_OK) goto done; \
  } while (0)
#define TAKE(ctx, array, n)                            \
  do {                                                 \
    (array) = take(ctx, (size_t)(n), sizeof *(array)); \
    if ((array) == NULL) {                             \
      status = FS_ERR_MEMORY;                          \
      goto done;                                       \
    }                                                  \
  } while (0)

/* Copies a mesh into the polygons of an outcome. */
fs_status outcome_take_mesh(fs_context *ctx, const fs_mesh *mesh, outcome *o);

/* ---- triangles with faux edges: how MeshLab keeps polygons ---- */

/* Joins triangles[n][3] whose inner edges are marked: bit k of faux[t] marks the edge from corner k to corner k + 1. Needs no
   adjacency and takes any bits: an edge is inner where exactly two marked sides of different triangles run opposite ways.
   Triangles that so become one disc without a vertex inside and without a repeated vertex are a polygon; all others stay
   triangles. Fills n_faces, face_start and corner. The vertices of polygons start at the first border edge of their first
   triangle; their order follows those of the triangles. */
fs_status polygons_join(fs_context *ctx, int32_t n, const int32_t *triangle, const uint8_t *faux, polygon_list *p);

/* The other way: triangle[n][3] and their marks; quadrilaterals are cut along the shorter diagonal, others into fans. */
fs_status polygons_split(fs_context *ctx, const polygon_list *p, int32_t *n, int32_t **triangle, uint8_t **faux);

#ifdef __cplusplus
}
#endif
#endif
