/* SPDX-License-Identifier: MIT */
/* Single role: drawings: the pages, and what is drawn in each view: dark areas, borders, contours, curves, combs, umbilics.
   Contours are the isophotes of the direction of view: n . towards = 0. */
#include "drawing.h"
#include "strokes.h"
#include "writer.h"
#include "base/base.h"
#include "analyse/curves.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

#include <stdlib.h>

static const char *const views_choices[] = {"one", "four", NULL};
static const char *const hidden_choices[] = {"no", "dashed", NULL};

const fs_param fs_drawing_params[] = {
    [FS_DRAWING_VIEWS] = {"views", "one, or four: front, side, top and that one", 0, 0, 1, views_choices},
    [FS_DRAWING_AZIMUTH] = {"view-azimuth", "direction to the viewer, degrees from x towards y", -60, -360, 360, NULL},
    [FS_DRAWING_ELEVATION] = {"view-elevation", "direction to the viewer, degrees above the xy plane", 30, -90, 90,
                              NULL},
    [FS_DRAWING_HIDDEN] = {"hidden", "whether hidden lines are drawn", 0, 0, 1, hidden_choices},
    [FS_DRAWING_WIDTH] = {"width", "of the drawing in millimetres", 180, 10, 5000, NULL},
    [FS_N_DRAWING_PARAMS] = {0},
};

static const double point_per_mm = 72 / 25.4;

/* A drawing at work. */
typedef struct sheet {
  fs_context *ctx;
  const fs_model *model;
  const double *param;
  fs_triangles *triangles;
  fs_edges *edges; /* geometry says where patches meet that do not name each other */
  cairo_t *cairo;
  const fs_view *view;
  double scale; /* points per unit of length */
  fs_stroke_colours colours;
} sheet;

/* ---- lines ------------------------------------------------------------------------------------------------------- */

typedef struct pen {
  double width, red, green, blue; /* width in mm */
} pen;
static const pen contour_pen = {0.35, 0, 0, 0}, curve_pen = {0.2, 0.05, 0.15, 0.5}, tooth_pen = {0.08, 0.55, 0.1, 0.1},
                 edge_pen = {0.05, 0.12, 0.12, 0.14};

static pen graded(const sheet *s, double level) {
  double rgb[3];
  fs_stroke_colour(&s->colours, level, rgb);
  return (pen){0.25, rgb[0], rgb[1], rgb[2]};
}

static void take_pen(const sheet *s, const pen *pen, bool is_seen) {
  static const double dash[2] = {1.2, 1.6};
  cairo_set_line_width(s->cairo, pen->width * point_per_mm * (is_seen ? 1 : 0.5));
  cairo_set_dash(s->cairo, dash, is_seen ? 0 : 2, 0);
  cairo_set_source_rgb(s->cairo, pen->red, pen->green, pen->blue);
}

static void line_to(const sheet *s, fs_vec3 q, bool is_first) {
  double x = (q.x - s->view->low[0]) * s->scale, y = (s->view->high[1] - q.y) * s->scale;
  if (is_first)
    cairo_move_to(s->cairo, x, y);
  else
    cairo_line_to(s->cairo, x, y);
}

/* A polyline on the surface; the parts that are hidden dashed or not at all. Points closer than 0.1 mm to the last one are
   left out. */
static void draw_line(const sheet *s, const fs_curve_point *point, int32_t n, const pen *pen) {
  bool was_seen = false;
  fs_vec3 before = {0};
  double least = 0.1 * point_per_mm / s->scale;
  for (int32_t i = 0; i < n; i++) {
    fs_vec3 q = fs_view_project(s->view, point[i].position);
    bool is_seen = fs_view_sees(s->view, q);
    if (i > 0 && is_seen != was_seen) {
      if (was_seen || s->param[FS_DRAWING_HIDDEN] > 0) {
        line_to(s, q, false);
        cairo_stroke(s->cairo);
      } else {
        cairo_new_path(s->cairo);
      }
      take_pen(s, pen, is_seen);
      line_to(s, was_seen ? q : before, true);
      if (!was_seen) line_to(s, q, false);
    } else if (i == 0) {
      take_pen(s, pen, is_seen);
      line_to(s, q, true);
    } else if (i < n - 1 && hypot(q.x - before.x, q.y - before.y) < least) {
      continue;
    } else {
      line_to(s, q, false);
    }
    was_seen = is_seen, before = q;
  }
  if (was_seen || s->param[FS_DRAWING_HIDDEN] > 0) cairo_stroke(s->cairo);
  cairo_new_path(s->cairo);
}

static void draw_teeth(const sheet *s, const fs_curve_point *point, int32_t n) {
  take_pen(s, &tooth_pen, true);
  for (int pass = 0; pass < 2; pass++) { /* teeth, then the line along their tips */
    bool is_first = true;
    for (int32_t i = 0; i < n; i++) {
      fs_vec3 q = fs_view_project(s->view, point[i].position), tip;
      if (!fs_view_sees(s->view, q)) {
        is_first = true;
        continue;
      }
      tip = fs_view_project(s->view, fs_vec3_add(point[i].position, point[i].tooth));
      if (pass == 0) line_to(s, q, true);
      line_to(s, tip, pass == 1 && is_first);
      is_first = false;
    }
    cairo_stroke(s->cairo);
  }
}

static void draw_curves(const sheet *s) {
  const fs_curves *curves = s->model->curves;
  for (int32_t i = 0; i < curves->n_curves; i++) {
    const fs_surface_curve *c = &curves->curve[i];
    const pen p = curves->is_graded ? graded(s, c->level) : curves->n_fill > 0 ? edge_pen : curve_pen;
    const fs_curve_point *point = &curves->point[c->first];
    if (fs_vec3_length(point[c->n_points / 2].tooth) > 0) draw_teeth(s, point, c->n_points);
    draw_line(s, point, c->n_points, &p);
  }
  cairo_set_dash(s->cairo, NULL, 0, 0);
  for (int32_t i = 0; i < curves->n_marks; i++) {
    const fs_mark *m = &curves->mark[i];
    fs_vec3 q = fs_view_project(s->view, m->point.position);
    if (!fs_view_sees(s->view, q)) continue;
    cairo_arc(s->cairo, (q.x - s->view->low[0]) * s->scale, (s->view->high[1] - q.y) * s->scale, 1.1 * point_per_mm, 0,
              2 * acos(-1.0));
    cairo_set_source_rgb(s->cairo, 0.8, 0.1, 0.1);
    cairo_set_line_width(s->cairo, 0.4 * point_per_mm);
    if (m->index > 0) /* full: lemon or monstar; ring: star */
      cairo_fill(s->cairo);
    else
      cairo_stroke(s->cairo);
  }
}

/* ---- areas ------------------------------------------------------------------------------------------------------- */

/* One path for all of them: neighbours that are filled one by one would leave seams. */
static void draw_fill(const sheet *s) {
  const fs_curves *curves = s->model->curves;
  cairo_set_source_rgb(s->cairo, 0.12, 0.12, 0.14);
  cairo_set_fill_rule(s->cairo, CAIRO_FILL_RULE_WINDING);
  for (int32_t i = 0; i < curves->n_fill; i++) {
    fs_vec3 q[3], middle = {0};
    bool is_turned;
    for (int k = 0; k < 3; k++) {
      q[k] = fs_view_project(s->view, curves->fill[i][0][k]);
      middle = fs_vec3_add_scaled(middle, q[k], 1.0 / 3);
    }
    if (!fs_view_sees(s->view, middle)) continue;
    is_turned = (q[1].x - q[0].x) * (q[2].y - q[0].y) < (q[2].x - q[0].x) * (q[1].y - q[0].y);
    for (int k = 0; k < 3; k++) line_to(s, q[is_turned ? 2 - k : k], k == 0);
    cairo_close_path(s->cairo);
  }
  cairo_fill(s->cairo);
}

/* ---- contours and borders ---------------------------------------------------------------------------------------- */

static double facing(const void *user, const fs_vec3 x[FS_JET_SIZE]) {
  fs_vec3 n;
  const fs_view *view = user;
  return fs_normal_compute(x, &n) ? fs_vec3_dot(n, view->towards) : (double)NAN;
}

static fs_status draw_contours(const sheet *s) {
  fs_status status = FS_OK;
  fs_curves *contours = NULL;
  fs_field field = {facing, s->view};
  const double level = 0;
  FS_TRY(fs_trace_levels(s->ctx, s->model->surface, &field, 1, &level, NULL, &contours));
  for (int32_t i = 0; i < contours->n_curves; i++)
    draw_line(s, &contours->point[contours->curve[i].first], contours->curve[i].n_points, &contour_pen);
done:
  fs_curves_free(s->ctx, contours);
  return status;
}

/* Whether the patches of an edge meet at an angle. */
static bool is_sharp(const fs_surface *surface, const fs_edge *edge) {
  const double least = acos(-1.0) / 36; /* 5 degrees */
  for (int k = 0; k <= 4; k++) {
    fs_edge_point point;
    double jump[FS_N_JUMPS], curvature;
    fs_edge_evaluate(surface, edge, k / 4.0, &point);
    fs_jumps_between(point.jet[0], point.jet[1], edge->is_flipped, jump, &curvature);
    if (jump[FS_JUMP_NORMAL] > least) return true;
  }
  return false;
}

/* Borders, and edges with an angle. */
static void draw_edges(const sheet *s) {
  enum { N = 24 };
  const fs_surface *surface = s->model->surface;
  for (int32_t i = 0; i < s->edges->n_edges + s->edges->n_borders; i++) {
    const fs_edge *e = &s->edges->edge[i];
    fs_curve_point point[N + 1];
    if (i < s->edges->n_edges && !is_sharp(surface, e)) continue;
    for (int k = 0; k <= N; k++) {
      double u, v, t = e->begin[0] + (e->end[0] - e->begin[0]) * k / N;
      fs_side_parameters(surface->patch[e->patch[0]].n_sides, e->side[0], t, &u, &v);
      point[k] = fs_curve_point_at(surface, e->patch[0], u, v);
    }
    draw_line(s, point, N + 1, &contour_pen);
  }
}

/* ---- views and pages --------------------------------------------------------------------------------------------- */

static fs_status draw_view(sheet *s, const fs_view *view) {
  fs_status status = FS_OK;
  s->view = view;
  if (s->model->curves != NULL) draw_fill(s);
  draw_edges(s);
  FS_TRY(draw_contours(s));
  if (s->model->curves != NULL) draw_curves(s);
done:
  return status;
}

static cairo_status_t write_bytes(void *closure, const unsigned char *bytes, unsigned int size) {
  fs_writer *writer = closure;
  fs_writer_bytes(writer, bytes, size);
  return writer->status == FS_OK ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

/* The views of a page: one, or two rows of two. Those beside each other are as high as the higher one, those below each
   other as wide as the wider one. */
typedef struct layout {
  int32_t n_views, n_columns;
  fs_view view[4];
  double width[2], height[2], margin, scale; /* mm: of columns and rows; mm per unit of length */
} layout;

static void make_room_for_teeth(const fs_curves *curves, fs_view *view) {
  for (int32_t i = 0; i < curves->n_points; i++) {
    const fs_curve_point *p = &curves->point[i];
    fs_vec3 q = fs_view_project(view, fs_vec3_add(p->position, p->tooth));
    view->low[0] = fmin(view->low[0], q.x), view->high[0] = fmax(view->high[0], q.x);
    view->low[1] = fmin(view->low[1], q.y), view->high[1] = fmax(view->high[1], q.y);
  }
}

static fs_status make_layout(fs_context *ctx, const fs_triangles *triangles, const fs_curves *curves,
                             const double *param, layout *l) {
  fs_status status = FS_OK;
  const double angle[4][2] = {{-90, 0}, {0, 0}, {-90, 90}, {param[FS_DRAWING_AZIMUTH], param[FS_DRAWING_ELEVATION]}};
  double size;
  *l = (layout){.n_views = param[FS_DRAWING_VIEWS] > 0 ? 4 : 1, .margin = 0.03 * param[FS_DRAWING_WIDTH]};
  l->n_columns = l->n_views == 4 ? 2 : 1;
  for (int32_t i = 0; i < l->n_views; i++) {
    const double *a = angle[l->n_views == 4 ? i : 3];
    double *width = &l->width[i % l->n_columns], *height = &l->height[i / l->n_columns];
    FS_TRY(fs_view_create(ctx, triangles, a[0], a[1], &l->view[i]));
    if (curves != NULL) make_room_for_teeth(curves, &l->view[i]);
    *width = fmax(*width, l->view[i].high[0] - l->view[i].low[0]);
    *height = fmax(*height, l->view[i].high[1] - l->view[i].low[1]);
  }
  size = l->width[0] + l->width[1];
  l->scale = size > 0 ? (param[FS_DRAWING_WIDTH] - 2 * l->margin * l->n_columns) / size : 1;
  for (int32_t k = 0; k < l->n_columns; k++) {
    l->width[k] = l->width[k] * l->scale + 2 * l->margin;
    l->height[k] = l->height[k] * l->scale + 2 * l->margin;
  }
done:
  return status;
}

static fs_status draw_page(sheet *s, layout *l) {
  fs_status status = FS_OK;
  s->scale = l->scale * point_per_mm;
  cairo_set_line_cap(s->cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(s->cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_source_rgb(s->cairo, 1, 1, 1);
  cairo_paint(s->cairo);
  for (int32_t i = 0; i < l->n_views; i++) {
    cairo_save(s->cairo);
    cairo_translate(s->cairo, ((i % l->n_columns > 0 ? l->width[0] : 0) + l->margin) * point_per_mm,
                    ((i / l->n_columns > 0 ? l->height[0] : 0) + l->margin) * point_per_mm);
    status = draw_view(s, &l->view[i]);
    cairo_restore(s->cairo);
    if (status != FS_OK) return status;
    FS_TRY(fs_progress(s->ctx, "draw", (double)(i + 1) / l->n_views));
  }
done:
  return status;
}

/* Enough triangles per patch for the hidden lines: about 200 000 in all. */
static int32_t choose_steps(const fs_surface *surface) {
  int32_t steps = 24;
  while (steps > 2 && (double)surface->n_patches * steps * steps > 1e5) steps--;
  return steps;
}

static fs_status draw(sheet *s, layout *l, fs_writer *writer, fs_drawing_open open) {
  cairo_surface_t *paper = open(write_bytes, writer, s->param[FS_DRAWING_WIDTH] * point_per_mm,
                                (l->height[0] + l->height[1]) * point_per_mm);
  cairo_status_t drawn;
  fs_status status;
  s->cairo = cairo_create(paper);
  status = draw_page(s, l);
  drawn = cairo_status(s->cairo);
  cairo_destroy(s->cairo);
  cairo_surface_finish(paper);
  if (drawn == CAIRO_STATUS_SUCCESS) drawn = cairo_surface_status(paper);
  cairo_surface_destroy(paper);
  if (status != FS_OK) return status;
  status = fs_writer_finish(writer);
  if (status != FS_OK || drawn == CAIRO_STATUS_SUCCESS) return status;
  return fs_fail(s->ctx, drawn == CAIRO_STATUS_NO_MEMORY ? FS_ERR_MEMORY : FS_ERR_IO, "cairo could not draw: %s",
                 cairo_status_to_string(drawn));
}

fs_status fs_drawing_write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output,
                           const char *extension, fs_drawing_open open) {
  fs_status status = FS_OK;
  sheet s = {.ctx = ctx, .model = model, .param = param, .colours = fs_stroke_colours_of(model->curves)};
  layout l = {0};
  fs_writer writer;
  FS_TRY(fs_tessellate(ctx, model->surface, choose_steps(model->surface), &s.triangles));
  FS_TRY(fs_edges_create(ctx, model->surface, 0, &s.edges));
  FS_TRY(make_layout(ctx, s.triangles, model->curves, param, &l));
  fs_writer_start(&writer, ctx, output, extension);
  FS_TRY(draw(&s, &l, &writer, open));
done:
  for (int32_t i = 0; i < 4; i++) fs_view_clear(ctx, &l.view[i]);
  fs_edges_free(ctx, s.edges);
  fs_triangles_free(ctx, s.triangles);
  return status;
}
