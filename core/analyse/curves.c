/* SPDX-License-Identifier: MIT */
/* Single role: sets of curves: memory, and the small things that tracing shares. */
#include "analyse/curves.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

#include <string.h>

void fs_curves_free(fs_context *ctx, fs_curves *curves) {
  if (curves == NULL) return;
  fs_release(ctx, curves->curve);
  fs_release(ctx, curves->point);
  fs_release(ctx, curves->mark);
  fs_release(ctx, curves->fill);
  fs_release(ctx, curves);
}

fs_status fs_curve_list_start(fs_context *ctx, fs_curve_list *list) {
  fs_status status = FS_OK;
  *list = (fs_curve_list){0};
  FS_ALLOC(ctx, list->curves, 1);
done:
  return status;
}

/* block with room for one more than n elements of size bytes. */
static fs_status grow(fs_context *ctx, void **block, int32_t n, int32_t *room, size_t size) {
  int32_t more;
  void *larger;
  if (n < *room) return FS_OK;
  if (n >= INT32_MAX / 2) return fs_fail(ctx, FS_ERR_UNSUPPORTED, "the curves have more than 2^30 points");
  more = n < 32 ? 64 : 2 * n;
  larger = fs_allocate(ctx, (size_t)more, size);
  if (larger == NULL) return FS_ERR_MEMORY;
  if (n > 0) memcpy(larger, *block, (size_t)n * size);
  fs_release(ctx, *block);
  *block = larger;
  *room = more;
  return FS_OK;
}

fs_status fs_curve_list_begin(fs_context *ctx, fs_curve_list *list, double level) {
  fs_curves *c = list->curves;
  void *block = c->curve;
  fs_status status = grow(ctx, &block, c->n_curves, &list->curve_room, sizeof *c->curve);
  c->curve = block;
  if (status == FS_OK) c->curve[c->n_curves++] = (fs_surface_curve){.first = c->n_points, .level = level};
  return status;
}

fs_status fs_curve_list_add(fs_context *ctx, fs_curve_list *list, const fs_curve_point *point) {
  fs_curves *c = list->curves;
  void *block = c->point;
  fs_status status = grow(ctx, &block, c->n_points, &list->point_room, sizeof *c->point);
  c->point = block;
  if (status != FS_OK) return status;
  c->point[c->n_points++] = *point;
  c->curve[c->n_curves - 1].n_points++;
  return FS_OK;
}

void fs_curve_list_end(fs_curve_list *list, bool is_closed) {
  fs_curves *c = list->curves;
  fs_surface_curve *last = &c->curve[c->n_curves - 1];
  last->is_closed = is_closed;
  if (last->n_points >= 2) return;
  c->n_points = last->first;
  c->n_curves--;
}

fs_status fs_curve_list_mark(fs_context *ctx, fs_curve_list *list, const fs_mark *mark) {
  fs_curves *c = list->curves;
  void *block = c->mark;
  fs_status status = grow(ctx, &block, c->n_marks, &list->mark_room, sizeof *c->mark);
  c->mark = block;
  if (status == FS_OK) c->mark[c->n_marks++] = *mark;
  return status;
}

fs_status fs_curve_list_fill(fs_context *ctx, fs_curve_list *list, fs_vec3 fill[2][3]) {
  fs_curves *c = list->curves;
  void *block = c->fill;
  fs_status status = grow(ctx, &block, c->n_fill, &list->fill_room, sizeof *c->fill);
  c->fill = block;
  if (status == FS_OK) memcpy(c->fill[c->n_fill++], fill, sizeof *c->fill);
  return status;
}

double fs_surface_diagonal(const fs_surface *surface, fs_vec3 *centre) {
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY}, x[FS_JET_SIZE];
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      double u, v;
      fs_side_parameters(surface->patch[p].n_sides, s, 0, &u, &v);
      fs_surface_evaluate(surface, p, u, v, x);
      low = fs_vec3_min(low, x[FS_D]), high = fs_vec3_max(high, x[FS_D]);
    }
  if (centre != NULL) *centre = fs_vec3_scale(fs_vec3_add(low, high), 0.5);
  return surface->n_patches > 0 ? fs_vec3_distance(low, high) : 0;
}

fs_trace_options fs_trace_options_complete(const fs_surface *surface, const fs_trace_options *options) {
  fs_trace_options o = options != NULL ? *options : (fs_trace_options){0};
  if (!(o.tolerance > 0)) o.tolerance = 1e-5 * fs_surface_diagonal(surface, NULL);
  if (o.n_cells <= 0) o.n_cells = 8;
  if (o.n_cells > 256) o.n_cells = 256;
  return o;
}

double fs_field_at(const fs_surface *surface, const fs_field *field, int32_t patch, double u, double v) {
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(surface, patch, u, v, x);
  return field->value(field->user, x);
}

fs_curve_point fs_curve_point_at(const fs_surface *surface, int32_t patch, double u, double v) {
  fs_curve_point point = {.place = {patch, u, v}};
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(surface, patch, u, v, x);
  point.position = x[FS_D];
  fs_normal_compute(x, &point.normal);
  return point;
}

fs_vec3 fs_direction_of(double azimuth, double elevation) {
  const double degree = acos(-1.0) / 180;
  double a = azimuth * degree, e = elevation * degree;
  return (fs_vec3){cos(a) * cos(e), sin(a) * cos(e), sin(e)};
}
