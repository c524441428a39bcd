/* SPDX-License-Identifier: MIT */
/* Plot of plane sections with curvature combs.

   The section of a surface with unit normal N by a plane with unit normal m has the tangent t = N x m / |N x m| and in the
   plane the curvature k = II(t, t) / (N . q), q = m x t [Meusnier]; its comb stands on the curve along -q k: teeth point to
   the outside of the bend. */
#include "analyse/curves.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

static double height(const void *user, const fs_vec3 x[FS_JET_SIZE]) {
  const fs_vec3 *m = user;
  return fs_vec3_dot(x[FS_D], *m);
}

/* Curvature of the section by the plane with normal m, as a vector in the plane; zero where it touches the surface. */
static fs_vec3 section_curvature(const fs_vec3 *x, fs_vec3 m) {
  fs_geometry g;
  fs_vec3 t, q;
  double length, p1, p2, along;
  if (!fs_geometry_compute(x, &g)) return (fs_vec3){0};
  t = fs_vec3_cross(g.normal, m);
  length = fs_vec3_length(t);
  if (!(length > 1e-8)) return (fs_vec3){0};
  t = fs_vec3_scale(t, 1 / length);
  q = fs_vec3_cross(m, t);
  p1 = fs_vec3_dot(t, g.e1), p2 = fs_vec3_dot(t, g.e2);
  along = g.a * p1 * p1 + 2 * g.b * p1 * p2 + g.c * p2 * p2;
  return fs_vec3_scale(q, along / fs_vec3_dot(g.normal, q));
}

static const fs_param params[] = {
    {.name = "count", .summary = "planes, equally apart", .initial = 9, .min = 1, .max = 500},
    {.name = "plane-azimuth", .summary = "normal of the planes, degrees from x towards y", .min = -360, .max = 360},
    {.name = "plane-elevation", .summary = "normal of the planes, degrees above the xy plane", .min = -90, .max = 90},
    {.name = "comb",
     .summary = "length of the longest tooth in diagonals of the surface; 0: no combs",
     .initial = 0.08,
     .min = 0,
     .max = 10},
    {0}};

/* Curvatures below this part of 1 / diagonal are rounding errors of straight lines: they get no teeth. */
static const double straight = 1e-9;

/* Teeth with length = curvature, then scaled so that the longest has `part` of the diagonal. */
static void add_teeth(const fs_surface *quads, fs_curves *curves, fs_vec3 m, double part) {
  double longest = 0, diagonal = fs_surface_diagonal(quads, NULL);
  for (int32_t i = 0; i < curves->n_points; i++) {
    fs_curve_point *p = &curves->point[i];
    fs_vec3 x[FS_JET_SIZE];
    fs_surface_evaluate(quads, p->place.patch, p->place.u, p->place.v, x);
    p->tooth = fs_vec3_scale(section_curvature(x, m), -1);
    longest = fmax(longest, fs_vec3_length(p->tooth));
  }
  double scale = longest * diagonal > straight ? part * diagonal / longest : 0;
  for (int32_t i = 0; i < curves->n_points; i++) curves->point[i].tooth = fs_vec3_scale(curves->point[i].tooth, scale);
}

static fs_status trace(fs_context *ctx, const fs_surface *surface, const double *param, const fs_trace_options *options,
                       fs_curves **curves) {
  fs_status status = FS_OK;
  fs_vec3 m = fs_direction_of(param[1], param[2]);
  fs_field field = {height, &m};
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  double low = INFINITY, high = -INFINITY, *values = NULL;
  int32_t count = (int32_t)param[0];
  FS_TRY(fs_surface_to_quads(ctx, surface, &quads));
  FS_TRY(fs_curve_list_start(ctx, &list));
  for (int32_t p = 0; p < quads->n_patches; p++)
    for (int k = 0; k < 9; k++) {
      double h = fs_field_at(quads, &field, p, k % 3 / 2.0, (double)(k / 3) / 2.0);
      low = fmin(low, h), high = fmax(high, h);
    }
  FS_TRY(fs_field_values(ctx, quads, &field, fs_trace_options_complete(quads, options).n_cells, &values));
  for (int32_t k = 0; k < count; k++) {
    double h = low + (high - low) * (k + 0.5) / count;
    FS_TRY(fs_levels_append(ctx, quads, &field, values, h, h, options, &list));
  }
  if (param[3] > 0) add_teeth(quads, list.curves, m, param[3]);
  *curves = list.curves;
  list.curves = NULL;
done:
  fs_release(ctx, values);
  fs_curves_free(ctx, list.curves);
  fs_surface_free(ctx, quads);
  return status;
}

const fs_plot fs_plot_sections = {"sections", "sections by parallel planes, with curvature combs", params, trace};
