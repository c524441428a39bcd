/* SPDX-License-Identifier: MIT */
/* What the files of the STEP exporter share.

   Patches are put together to faces: rectangles of n x m cells. A cell is a patch as its face sees it, the number
   4 patch + turn, where turn is the side of the patch that lies at the bottom of the face. Side s of a cell, counted as
   the face does (0 bottom, 1 right, 2 top, 3 left), is side (s + turn) % 4 of the patch. */
#ifndef FS_EXPORTERS_STEP_H
#define FS_EXPORTERS_STEP_H

#include <fairsurf/export.h>
#include "writer.h"

/* ---- which patches form a face (step_layout.c) ---- */

typedef struct fs_step_face {
  int32_t cell; /* at the left end of the bottom */
  int32_t n, m; /* cells along the bottom, and along the left */
} fs_step_face;

typedef struct fs_step_layout {
  int32_t n_faces, n_corners;
  fs_step_face *face;
  int32_t *face_of; /* [n_patches] */
  uint8_t *turn;    /* [n_patches] in its face */
  int32_t *corner;  /* [4 n_patches] number of the point at corner c of patch p: 4 p + c (fs_surface_corners) */
} fs_step_layout;

/* Without is_merging every patch is a face. With it bicubic patches that join C2, to the tolerance for points and their
   differences, become rectangles whose border does not touch itself. */
fs_status fs_step_layout_create(fs_context *ctx, const fs_surface *surface, bool is_merging, double tolerance,
                                fs_step_layout **layout);
void fs_step_layout_free(fs_context *ctx, fs_step_layout *layout); /* NULL is allowed */

/* The cell across side s of a cell, turned so that it belongs to the same face, or FS_NONE. */
int32_t fs_step_cross(const fs_surface *surface, int32_t cell, int32_t s);

static inline int32_t fs_step_side(int32_t cell, int32_t s) { return cell - cell % 4 + (cell + s) % 4; }

/* ---- which sides form an edge (step_edges.c) ---- */

typedef struct fs_step_edge {
  int32_t first;      /* 4 patch + side where it begins; the face of that patch runs it forwards */
  int32_t n_sides;    /* sides of patches in a row */
  int32_t start, end; /* corner numbers of the layout */
} fs_step_edge;

typedef struct fs_step_edges {
  int32_t n_edges;
  fs_step_edge *edge;
  int32_t *edge_of; /* [4 n_patches] of a side: 2 edge, + 1 where its face runs the edge backwards; FS_NONE in a face */
} fs_step_edges;

/* An edge is the longest row of sides between two faces, or at the border, that is straight in both. */
fs_status fs_step_edges_create(fs_context *ctx, const fs_surface *surface, const fs_step_layout *layout,
                               fs_step_edges **edges);
void fs_step_edges_free(fs_context *ctx, fs_step_edges *edges); /* NULL is allowed */

/* ---- which faces form a shell (step_shells.c) ---- */

typedef struct fs_step_shells {
  int32_t n_shells; /* components of the surface */
  int32_t *start;   /* [n_shells + 1] of the faces of each */
  int32_t *face;    /* [n_faces] by shell */
  bool *is_open;    /* [n_shells] */
} fs_step_shells;

/* Notes it where the faces of a closed shell look inwards. */
fs_status fs_step_shells_create(fs_context *ctx, const fs_surface *surface, const fs_step_layout *layout,
                                fs_step_shells **shells);
void fs_step_shells_free(fs_context *ctx, fs_step_shells *shells); /* NULL is allowed */

/* ---- control points (step_spline.c) ---- */

/* Point (i, j) of a cell, i along its bottom. */
fs_vec3 fs_step_point(const fs_surface *surface, int32_t cell, int32_t i, int32_t j);
void fs_step_degrees(const fs_surface *surface, int32_t cell, int32_t *degree_u, int32_t *degree_v);

/* A clamped spline: knots 0, 1, .., n_pieces, inner ones simple, outer ones degree + 1 times; degree + n_pieces points. */
typedef struct fs_step_curve {
  int32_t degree, n_pieces;
} fs_step_curve;

/* The curve of an edge, its ends at the given points. points: room for fs_step_edge_room. Of a single side the points of the
   patch of lower degree; a side that is cubic is written so whatever its degree, as those around caps are. */
fs_step_curve fs_step_edge_curve(const fs_surface *surface, const fs_step_edge *edge, double tolerance, fs_vec3 start,
                                 fs_vec3 end, fs_vec3 *points);
static inline size_t fs_step_edge_room(const fs_step_edge *edge) {
  return FS_MAX_DEGREE + 1 + 4 * (size_t)edge->n_sides;
}

/* Points of a face, first along its bottom. points: room for (degree_u + 1) n (degree_v + 1) m. */
void fs_step_face_surface(const fs_surface *surface, const fs_step_face *face, fs_step_curve *u, fs_step_curve *v,
                          fs_vec3 *points);

/* ---- text (step_text.c) ---- */

typedef struct fs_step_file {
  fs_writer writer;
  int64_t n_entities; /* written so far; their numbers start at 1 */
} fs_step_file;

/* Starts the next entity, "#N=text", and returns its number; fs_step_end closes its parenthesis and the line. */
int64_t fs_step_begin(fs_step_file *step, const char *text);
void fs_step_end(fs_step_file *step);
/* Both, with numbers of entities in place of each % of text. */
int64_t fs_step_entity(fs_step_file *step, const char *text, const int64_t *reference);
void fs_step_reference(fs_step_file *step, int64_t entity);
void fs_step_list(fs_step_file *step, int64_t n, const int64_t *entity); /* (#1,#2,..) */
void fs_step_real(fs_step_file *step, double number);      /* all its digits; FS_ERR_NUMERIC if it is not finite */
void fs_step_string(fs_step_file *step, const char *utf8); /* quoted; what is no UTF-8 becomes ? */

/* ---- points, each written once (step_points.c) ---- */

typedef struct fs_step_points {
  size_t n, n_slots; /* n_slots: a power of two */
  struct fs_step_slot {
    fs_vec3 point;
    int64_t entity; /* 0: empty */
  } * slot;
} fs_step_points;

/* The CARTESIAN_POINT of a point, written where it is new; equal means equal bits. */
fs_status fs_step_point_entity(fs_context *ctx, fs_step_points *points, fs_step_file *step, fs_vec3 point,
                               int64_t *entity);
void fs_step_points_clear(fs_context *ctx, fs_step_points *points);

/* ---- the file around the geometry (step_frame.c) ---- */

typedef enum fs_step_unit { FS_STEP_MM, FS_STEP_CM, FS_STEP_M, FS_STEP_IN } fs_step_unit;

typedef struct fs_step_frame {
  int64_t shape, context; /* PRODUCT_DEFINITION_SHAPE, and the context that says the units */
} fs_step_frame;

/* accuracy: the distance below which points count as one, in the unit. */
fs_step_frame fs_step_write_head(fs_step_file *step, const fs_model *model, fs_step_unit unit, double accuracy);
/* The solids and open shells (models of surfaces) of the product. */
void fs_step_write_foot(fs_step_file *step, const fs_step_frame *frame, int64_t n_solids, const int64_t *solid,
                        int64_t n_shells, const int64_t *shell);

/* ---- the boundary representation (step_brep.c) ---- */

/* Writes all of it: face_entity[n_faces]. */
fs_status fs_step_write_faces(fs_context *ctx, fs_step_file *step, const fs_surface *surface,
                              const fs_step_layout *layout, double tolerance, int64_t *face_entity);

extern const fs_exporter fs_exporter_step;

#endif
