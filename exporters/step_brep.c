/* SPDX-License-Identifier: MIT */
/* Single role: vertices, edges and faces: all of a surface but its shells. */
#include "step.h"
#include "base/base.h"
#include "surface/surface.h"

typedef struct brep {
  fs_context *ctx;
  fs_step *step;
  const fs_surface *surface;
  const fs_step_layout *layout;
  double tolerance;
  fs_step_edges *edges;
  fs_step_points points;
  int64_t *vertex_entity; /* [n_corners] 0: not written */
  int64_t *edge_entity;   /* [n_edges] */
  fs_vec3 *point;         /* control points of one edge or face */
  int64_t *entity;        /* of these, or of the edges of a face */
} brep;

/* Room for the largest edge and the largest face. */
static fs_status make_room(brep *b) {
  fs_context *ctx = b->ctx;
  fs_status status = FS_OK;
  size_t room = 0;
  for (int32_t e = 0; e < b->edges->n_edges; e++) {
    size_t edge = fs_step_edge_room(&b->edges->edge[e]);
    if (edge > room) room = edge;
  }
  for (int32_t f = 0; f < b->layout->n_faces; f++) {
    const fs_step_face *face = &b->layout->face[f];
    const fs_patch *patch = &b->surface->patch[face->cell / 4];
    size_t n_cells = (size_t)face->n * (size_t)face->m, n_border = 2 * ((size_t)face->n + (size_t)face->m);
    size_t n_points = n_cells * (size_t)(patch->degree_u + 1) * (size_t)(patch->degree_v + 1);
    if (n_points > room) room = n_points;
    if (n_border > room) room = n_border;
  }
  FS_ALLOC(ctx, b->point, room);
  FS_ALLOC(ctx, b->entity, room);
  FS_ALLOC(ctx, b->vertex_entity, b->layout->n_corners);
  FS_ALLOC(ctx, b->edge_entity, b->edges->n_edges);
done:
  return status;
}

static fs_status write_points(brep *b, size_t n) {
  fs_status status = FS_OK;
  for (size_t k = 0; k < n; k++) FS_TRY(fs_step_point_entity(b->ctx, &b->points, b->step, b->point[k], &b->entity[k]));
done:
  return status;
}

/* Multiplicities of the knots, or their values. */
static void write_knots(brep *b, fs_step_curve curve, bool values) {
  for (int32_t k = 0; k <= curve.n_pieces; k++) {
    fs_writer_text(&b->step->writer, k == 0 ? "(" : ",");
    fs_writer_integer(&b->step->writer, values ? k : k == 0 || k == curve.n_pieces ? curve.degree + 1 : 1);
    if (values) fs_writer_text(&b->step->writer, ".");
  }
  fs_writer_text(&b->step->writer, ")");
}

static fs_status write_vertex(brep *b, int32_t corner, fs_vec3 point) {
  fs_status status = FS_OK;
  int64_t entity;
  if (b->vertex_entity[corner] != 0) return FS_OK;
  FS_TRY(fs_step_point_entity(b->ctx, &b->points, b->step, point, &entity));
  b->vertex_entity[corner] = fs_step_entity(b->step, "VERTEX_POINT('',%)", &entity);
done:
  return status;
}
