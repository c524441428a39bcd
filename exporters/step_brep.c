/* SPDX-License-Identifier: MIT */
/* Single role: vertices, edges and faces: all of a surface but its shells. */
#include "step.h"
#include "base/base.h"
#include "surface/surface.h"

typedef struct brep {
  fs_context *ctx;
  fs_step_file *step;
  const fs_surface *surface;
  const fs_step_layout *layout;
  double tolerance;
  fs_step_edges *edges;
  fs_step_points points;
  fs_vec3 *position;      /* [n_corners] */
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
  FS_ALLOC(ctx, b->position, b->layout->n_corners);
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

/* The lowest patch at a corner says where it is. */
static void place_corners(brep *b) {
  int32_t n_seen = 0;
  for (int32_t c = 0; c < 4 * b->surface->n_patches; c++)
    if (b->layout->corner[c] == n_seen) b->position[n_seen++] = fs_step_point(b->surface, c, 0, 0);
}

static fs_status write_vertex(brep *b, int32_t corner) {
  fs_status status = FS_OK;
  int64_t entity;
  if (b->vertex_entity[corner] != 0) return FS_OK;
  FS_TRY(fs_step_point_entity(b->ctx, &b->points, b->step, b->position[corner], &entity));
  b->vertex_entity[corner] = fs_step_entity(b->step, "VERTEX_POINT('',%)", &entity);
done:
  return status;
}

static fs_status write_edge(brep *b, int32_t e) {
  fs_status status = FS_OK;
  fs_writer *writer = &b->step->writer;
  const fs_step_edge *edge = &b->edges->edge[e];
  fs_step_curve curve =
      fs_step_edge_curve(b->surface, edge, b->tolerance, b->position[edge->start], b->position[edge->end], b->point);
  int64_t of[3];
  FS_TRY(write_vertex(b, edge->start));
  FS_TRY(write_vertex(b, edge->end));
  FS_TRY(write_points(b, (size_t)curve.degree + (size_t)curve.n_pieces));
  of[0] = b->vertex_entity[edge->start], of[1] = b->vertex_entity[edge->end];
  of[2] = fs_step_begin(b->step, "B_SPLINE_CURVE_WITH_KNOTS('',");
  fs_writer_integer(writer, curve.degree);
  fs_writer_text(writer, ",");
  fs_step_list(b->step, curve.degree + curve.n_pieces, b->entity);
  fs_writer_text(writer, ",.UNSPECIFIED.,.F.,.F.,");
  write_knots(b, curve, false);
  fs_writer_text(writer, ",");
  write_knots(b, curve, true);
  fs_writer_text(writer, ",.UNSPECIFIED.");
  fs_step_end(b->step);
  b->edge_entity[e] = fs_step_entity(b->step, "EDGE_CURVE('',%,%,%,.T.)", of);
done:
  return status;
}

static fs_status write_surface(brep *b, const fs_step_face *face, int64_t *entity) {
  fs_status status = FS_OK;
  fs_writer *writer = &b->step->writer;
  fs_step_curve u, v;
  fs_step_face_surface(b->surface, face, &u, &v, b->point);
  int64_t n_u = u.degree + u.n_pieces, n_v = v.degree + v.n_pieces;
  FS_TRY(write_points(b, (size_t)(n_u * n_v)));
  *entity = fs_step_begin(b->step, "B_SPLINE_SURFACE_WITH_KNOTS('',");
  fs_writer_integer(writer, u.degree);
  fs_writer_text(writer, ",");
  fs_writer_integer(writer, v.degree);
  for (int64_t i = 0; i < n_u; i++) { /* a list for each row of points along v */
    fs_writer_text(writer, i == 0 ? ",(" : ",\n");
    for (int64_t j = 0; j < n_v; j++) {
      fs_writer_text(writer, j == 0 ? "(" : ",");
      fs_step_reference(b->step, b->entity[i + n_u * j]);
    }
    fs_writer_text(writer, ")");
  }
  fs_writer_text(writer, "),.UNSPECIFIED.,.F.,.F.,.F.,");
  write_knots(b, u, false);
  fs_writer_text(writer, ",");
  write_knots(b, v, false);
  fs_writer_text(writer, ",");
  write_knots(b, u, true);
  fs_writer_text(writer, ",");
  write_knots(b, v, true);
  fs_writer_text(writer, ",.UNSPECIFIED.");
  fs_step_end(b->step);
done:
  return status;
}

/* The border of a face anticlockwise: one use of an edge for all its sides. */
static int64_t write_loop(brep *b, const fs_step_face *face) {
  int32_t cell = face->cell, n_uses = 0;
  int64_t loop;
  for (int32_t s = 0; s < 4; s++)
    for (int32_t k = 0, left = 0, n = s % 2 == 0 ? face->n : face->m; k < n; k++, left--) {
      int32_t use = b->edges->edge_of[fs_step_side(cell, s)];
      if (left == 0) {
        left = b->edges->edge[use / 2].n_sides;
        b->entity[n_uses++] =
            fs_step_entity(b->step, use % 2 == 0 ? "ORIENTED_EDGE('',*,*,%,.T.)" : "ORIENTED_EDGE('',*,*,%,.F.)",
                           &b->edge_entity[use / 2]);
      }
      if (k + 1 < n) cell = fs_step_cross(b->surface, cell, (s + 1) % 4);
    }
  loop = fs_step_begin(b->step, "EDGE_LOOP('',");
  fs_step_list(b->step, n_uses, b->entity);
  fs_step_end(b->step);
  return loop;
}

static fs_status write_face(brep *b, const fs_step_face *face, int64_t *entity) {
  fs_status status = FS_OK;
  int64_t of[2], loop;
  FS_TRY(write_surface(b, face, &of[1]));
  loop = write_loop(b, face);
  of[0] = fs_step_entity(b->step, "FACE_OUTER_BOUND('',%,.T.)", &loop);
  *entity = fs_step_entity(b->step, "ADVANCED_FACE('',(%),%,.T.)", of);
done:
  return status;
}

fs_status fs_step_write_faces(fs_context *ctx, fs_step_file *step, const fs_surface *surface,
                              const fs_step_layout *layout, double tolerance, int64_t *face_entity) {
  fs_status status = FS_OK;
  brep b = {.ctx = ctx, .step = step, .surface = surface, .layout = layout, .tolerance = tolerance};
  FS_TRY(fs_step_edges_create(ctx, surface, layout, &b.edges));
  FS_TRY(make_room(&b));
  place_corners(&b);
  for (int32_t e = 0; e < b.edges->n_edges; e++) FS_TRY(write_edge(&b, e));
  for (int32_t f = 0; f < layout->n_faces; f++) {
    FS_TRY(write_face(&b, &layout->face[f], &face_entity[f]));
    if (step->writer.status != FS_OK) break;
    if (f % 256 == 0) FS_TRY(fs_progress(ctx, "export", (double)f / layout->n_faces));
  }
done:
  fs_step_points_clear(ctx, &b.points);
  fs_step_edges_free(ctx, b.edges);
  fs_release(ctx, b.position);
  fs_release(ctx, b.vertex_entity);
  fs_release(ctx, b.edge_entity);
  fs_release(ctx, b.point);
  fs_release(ctx, b.entity);
  return status;
}
