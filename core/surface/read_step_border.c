/* SPDX-License-Identifier: MIT */
/* Single role: whether a face is its whole surface: one loop, whose vertices lie on the border of the surface and meet all
   its corners, and whose edges run along the border. Faces that are trimmed by other curves are refused. */
#include "surface/read_step.h"
#include "math/vec3.h"

enum { N_SAMPLES = 32, N_MARKS = 3 };
static const double near_part = 1e-3; /* of the diagonal of the box of the points: CAD programs leave gaps */

typedef struct border {
  const fs_step_model *model;
  const fs_step_record *face;
  const fs_spline *surface;
  double near;
  fs_vec3 corner[4];
  bool is_met[4];
} border;

static double ends_of(const fs_spline *s, int direction, int end) {
  return end == 0 ? s->knot[direction][0] : s->knot[direction][s->n[direction] + s->degree[direction]];
}

/* The point at part t of side s of the rectangle of parameters. */
static fs_vec3 at_side(const fs_spline *s, int side, double t) {
  int along = side % 2;
  double uv[2], value[3];
  uv[along] = ends_of(s, along, 0) + t * (ends_of(s, along, 1) - ends_of(s, along, 0));
  uv[1 - along] = ends_of(s, 1 - along, side / 2);
  fs_spline_evaluate(s, uv[0], uv[1], 0, 0, value);
  return (fs_vec3){value[0], value[1], value[2]};
}

static bool is_on_border(const border *b, fs_vec3 point) {
  for (int c = 0; c < 4; c++)
    if (fs_vec3_distance(b->corner[c], point) <= b->near) return true;
  for (int side = 0; side < 4; side++) {
    double best = INFINITY, from = 0, to = 1;
    for (int k = 0; k <= N_SAMPLES; k++) {
      double d = fs_vec3_distance(at_side(b->surface, side, (double)k / N_SAMPLES), point);
      if (d >= best) continue;
      best = d;
      from = fmax(0, (k - 1.0) / N_SAMPLES), to = fmin(1, (k + 1.0) / N_SAMPLES);
    }
    for (int step = 0; step < 40 && best > b->near; step++) { /* thirds: the distance has one minimum between samples */
      double s = from + (to - from) / 3, t = to - (to - from) / 3;
      double ds = fs_vec3_distance(at_side(b->surface, side, s), point);
      double dt = fs_vec3_distance(at_side(b->surface, side, t), point);
      best = fmin(best, fmin(ds, dt));
      if (ds < dt)
        to = t;
      else
        from = s;
    }
    if (best <= b->near) return true;
  }
  return false;
}

static fs_status refuse(const border *b, const char *why) {
  return fs_step_fail(b->model, b->face->at, FS_ERR_UNSUPPORTED,
                      "the face #%lld is trimmed (%s): only faces that are their whole surface are read",
                      (long long)b->face->id, why);
}

static fs_status read_vertex(const border *b, fs_step_cursor *edge, fs_vec3 *point) {
  const fs_step_record *vertex, *at;
  fs_step_cursor c;
  fs_status status = FS_OK;
  FS_TRY(fs_step_take_reference(edge, &vertex));
  FS_TRY(fs_step_open(b->model, vertex, "VERTEX_POINT", &c));
  FS_TRY(fs_step_skip(&c));
  FS_TRY(fs_step_take_reference(&c, &at));
  FS_TRY(fs_step_read_point(b->model, at, point));
done:
  return status;
}

/* The curve in space of an edge: itself, or that of a curve on surfaces. */
static fs_status find_curve(const border *b, const fs_step_record **curve) {
  static const char *const on_surfaces[] = {"SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE"};
  fs_status status = FS_OK;
  for (size_t k = 0; k < sizeof on_surfaces / sizeof *on_surfaces; k++) {
    fs_step_cursor c = {.model = b->model, .entity = *curve};
    if (!fs_step_has_type(b->model, *curve, on_surfaces[k], &c.at)) continue;
    FS_TRY(fs_step_skip(&c));
    FS_TRY(fs_step_take_reference(&c, curve));
    break;
  }
done:
  return status;
}

/* A B-spline curve between the two vertices has to stay on the border. Other curves are known by their ends only. */
static fs_status check_curve(border *b, const fs_step_record *curve, const fs_vec3 end[2]) {
  fs_spline *s = NULL;
  double value[2][3];
  fs_status status = FS_OK;
  FS_TRY(find_curve(b, &curve));
  if (!fs_step_is_curve(b->model, curve)) return FS_OK;
  FS_TRY(fs_step_read_curve(b->model, curve, &s));
  for (int k = 0; k < 2; k++) fs_spline_evaluate(s, ends_of(s, 0, k), 0, 0, 0, value[k]);
  fs_vec3 first = {value[0][0], value[0][1], value[0][2]}, last = {value[1][0], value[1][1], value[1][2]};
  bool is_whole = (fs_vec3_distance(first, end[0]) <= b->near && fs_vec3_distance(last, end[1]) <= b->near) ||
                  (fs_vec3_distance(first, end[1]) <= b->near && fs_vec3_distance(last, end[0]) <= b->near);
  for (int k = 1; k <= N_MARKS && is_whole; k++) {
    double t = ends_of(s, 0, 0) + (ends_of(s, 0, 1) - ends_of(s, 0, 0)) * k / (N_MARKS + 1), point[3];
    fs_spline_evaluate(s, t, 0, 0, 0, point);
    if (!is_on_border(b, (fs_vec3){point[0], point[1], point[2]})) {
      status = refuse(b, "an edge leaves the border");
      goto done;
    }
  }
done:
  fs_spline_free(b->model->ctx, s);
  return status;
}

static fs_status check_edge(border *b, fs_step_cursor *loop) {
  const fs_step_record *use, *edge, *curve;
  fs_step_cursor c;
  fs_vec3 end[2];
  fs_status status = FS_OK;
  FS_TRY(fs_step_take_reference(loop, &use));
  FS_TRY(fs_step_open(b->model, use, "ORIENTED_EDGE", &c));
  for (int k = 0; k < 3; k++) FS_TRY(fs_step_skip(&c)); /* name, and two vertices that follow from the edge */
  FS_TRY(fs_step_take_reference(&c, &edge));
  FS_TRY(fs_step_open(b->model, edge, "EDGE_CURVE", &c));
  FS_TRY(fs_step_skip(&c));
  for (int k = 0; k < 2; k++) {
    FS_TRY(read_vertex(b, &c, &end[k]));
    if (!is_on_border(b, end[k])) return refuse(b, "a vertex lies inside");
    for (int i = 0; i < 4; i++) b->is_met[i] = b->is_met[i] || fs_vec3_distance(b->corner[i], end[k]) <= b->near;
  }
  FS_TRY(fs_step_take_reference(&c, &curve));
  FS_TRY(check_curve(b, curve, end));
done:
  return status;
}

static fs_status check_loop(border *b, const fs_step_record *bound) {
  const fs_step_record *loop;
  fs_step_cursor c = {.model = b->model, .entity = bound};
  fs_status status = FS_OK;
  if (!fs_step_has_type(b->model, bound, "FACE_OUTER_BOUND", &c.at))
    FS_TRY(fs_step_open(b->model, bound, "FACE_BOUND", &c));
  FS_TRY(fs_step_skip(&c));
  FS_TRY(fs_step_take_reference(&c, &loop));
  FS_TRY(fs_step_open(b->model, loop, "EDGE_LOOP", &c));
  FS_TRY(fs_step_skip(&c));
  FS_TRY(fs_step_enter(&c));
  while (!fs_step_leave(&c)) FS_TRY(check_edge(b, &c));
done:
  return status;
}

fs_status fs_step_check_border(const fs_step_model *model, const fs_step_record *face, const fs_spline *surface) {
  border b = {.model = model, .face = face, .surface = surface};
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  const fs_step_record *bound;
  fs_step_cursor c;
  fs_status status = FS_OK;
  for (size_t i = 0; i < (size_t)surface->n[0] * (size_t)surface->n[1]; i++) {
    fs_vec3 p = {surface->c[3 * i], surface->c[3 * i + 1], surface->c[3 * i + 2]};
    low = fs_vec3_min(low, p), high = fs_vec3_max(high, p);
  }
  b.near = near_part * fs_vec3_distance(low, high);
  for (int k = 0; k < 4; k++) b.corner[k] = at_side(surface, k < 2 ? 0 : 2, k % 2);
  FS_TRY(fs_step_open(model, face, *face->at == 'A' ? "ADVANCED_FACE" : "FACE_SURFACE", &c));
  FS_TRY(fs_step_skip(&c));
  FS_TRY(fs_step_enter(&c));
  for (int32_t n = 0; !fs_step_leave(&c); n++) {
    FS_TRY(fs_step_take_reference(&c, &bound));
    if (n > 0) return refuse(&b, "it has holes");
    FS_TRY(check_loop(&b, bound));
  }
  for (int k = 0; k < 4; k++)
    if (!b.is_met[k]) return refuse(&b, "a corner of the surface is cut off");
done:
  return status;
}
