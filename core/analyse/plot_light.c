/* SPDX-License-Identifier: MIT */
/* Plots of lines that light draws on a surface with normal n, position x.

   isophotes    n . l = cos(angle), l the direction to the light, for angles (k + 1/2) 180 / count degrees
   reflection   the viewer in direction e sees, by r = 2 (n . e) n - e, a line of lights that are planes through d at
                infinity: r . m_k = 0, m_k = cos(k 180 / count) a + sin(k 180 / count) b, with a, b, d orthonormal
   highlight    the line of the normal meets the light line through a_k along d: (d x n) . (a_k - x) = 0
                [Beier and Chen 1994]
   zebra        the reflection of stripes of equal width in angle: cos(count arg(r . a, r . b)) > 0 is dark */
#include "analyse/curves.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

#define PARAM_COUNT(text, number) \
  { .name = "count", .summary = text, .initial = number, .min = 1, .max = 500 }
#define PARAM_AZIMUTH(text, number) \
  { .name = "light-azimuth", .summary = text, .initial = number, .min = -360, .max = 360 }
#define PARAM_ELEVATION(text, number) \
  { .name = "light-elevation", .summary = text, .initial = number, .min = -90, .max = 90 }

/* ---- from fields to curves ---- */

typedef struct line_field {
  fs_vec3 eye, axis, at; /* what each field needs of directions and points */
  fs_vec3 a, b;
  double count;
} line_field;

/* Quads of the surface, an empty list. */
static fs_status start(fs_context *ctx, const fs_surface *surface, fs_surface **quads, fs_curve_list *list) {
  fs_status status = fs_surface_to_quads(ctx, surface, quads);
  return status == FS_OK ? fs_curve_list_start(ctx, list) : status;
}

static fs_status finish(fs_context *ctx, fs_status status, fs_surface *quads, fs_curve_list *list, fs_curves **curves) {
  fs_surface_free(ctx, quads);
  if (status == FS_OK)
    *curves = list->curves;
  else
    fs_curves_free(ctx, list->curves);
  return status;
}

/* a, b complete a unit vector to a right-handed frame a, b, axis. */
static void complete_frame(fs_vec3 axis, fs_vec3 *a, fs_vec3 *b) {
  fs_vec3 other = fabs(axis.z) < 0.9 ? (fs_vec3){0, 0, 1} : (fs_vec3){1, 0, 0};
  *a = fs_vec3_cross(other, axis);
  *a = fs_vec3_scale(*a, 1 / fs_vec3_length(*a));
  *b = fs_vec3_cross(axis, *a);
}

/* ---- isophotes ---- */

static double lambert(const void *user, const fs_vec3 x[FS_JET_SIZE]) {
  const line_field *f = user;
  fs_vec3 n;
  return fs_normal_compute(x, &n) ? fs_vec3_dot(n, f->axis) : (double)NAN;
}

static const fs_param isophote_params[] = {PARAM_COUNT("angles between the normal and the light, over 180 degrees", 36),
                                           PARAM_AZIMUTH("direction to the light, degrees from x towards y", -60),
                                           PARAM_ELEVATION("direction to the light, degrees above the xy plane", 40),
                                           {0}};

static fs_status trace_isophotes(fs_context *ctx, const fs_surface *surface, const double *param,
                                 const fs_trace_options *options, fs_curves **curves) {
  line_field f = {.axis = fs_direction_of(param[1], param[2])};
  fs_field field = {lambert, &f};
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  int32_t count = (int32_t)param[0];
  double *values = NULL;
  fs_status status = start(ctx, surface, &quads, &list);
  if (status == FS_OK)
    status = fs_field_values(ctx, quads, &field, fs_trace_options_complete(quads, options).n_cells, &values);
  for (int32_t k = 0; k < count && status == FS_OK; k++) {
    double angle = (k + 0.5) * 180 / count;
    status = fs_levels_append(ctx, quads, &field, values, cos(angle * acos(-1.0) / 180), angle, options, &list);
  }
  fs_release(ctx, values);
  return finish(ctx, status, quads, &list, curves);
}

const fs_plot fs_plot_isophotes = {"isophotes", "lines of equal angle between the normal and a direction of light",
                                   isophote_params, trace_isophotes};

/* ---- reflection lines and zebra ---- */

static bool reflect(const line_field *f, const fs_vec3 *x, fs_vec3 *r) {
  fs_vec3 n;
  if (!fs_normal_compute(x, &n)) return false;
  *r = fs_vec3_sub(fs_vec3_scale(n, 2 * fs_vec3_dot(n, f->eye)), f->eye);
  return true;
}

static double reflection(const void *user, const fs_vec3 x[FS_JET_SIZE]) {
  const line_field *f = user;
  fs_vec3 r;
  return reflect(f, x, &r) ? fs_vec3_dot(r, f->at) : (double)NAN;
}

static double stripes(const void *user, const fs_vec3 x[FS_JET_SIZE]) {
  const line_field *f = user;
  fs_vec3 r;
  if (!reflect(f, x, &r)) return NAN;
  return cos(f->count * atan2(fs_vec3_dot(r, f->b), fs_vec3_dot(r, f->a)));
}

#define REFLECTION_PARAMS(text, number)                                                                        \
  PARAM_COUNT(text, number), PARAM_AZIMUTH("direction of the lines of light, degrees from x towards y", 0),    \
      PARAM_ELEVATION("direction of the lines of light, degrees above the xy plane", 0),                       \
      {.name = "eye-azimuth", .summary = "direction to the viewer", .initial = -60, .min = -360, .max = 360},  \
      {.name = "eye-elevation", .summary = "direction to the viewer", .initial = 30, .min = -90, .max = 90}, { \
    0                                                                                                          \
  }

static const fs_param reflection_params[] = {REFLECTION_PARAMS("lines of light, over 180 degrees", 24)};
static const fs_param zebra_params[] = {REFLECTION_PARAMS("dark stripes, over 360 degrees", 12)};

static line_field mirror_of(const double *param) {
  line_field f = {.axis = fs_direction_of(param[1], param[2]), .eye = fs_direction_of(param[3], param[4])};
  complete_frame(f.axis, &f.a, &f.b);
  f.count = floor(param[0]);
  return f;
}

/* The plane number k of count through the lines of light. */
static fs_vec3 light_plane(const line_field *f, double angle) {
  double radians = angle * acos(-1.0) / 180;
  return fs_vec3_add_scaled(fs_vec3_scale(f->a, cos(radians)), f->b, sin(radians));
}

static fs_status trace_reflection(fs_context *ctx, const fs_surface *surface, const double *param,
                                  const fs_trace_options *options, fs_curves **curves) {
  line_field f = mirror_of(param);
  fs_field field = {reflection, &f};
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  fs_status status = start(ctx, surface, &quads, &list);
  for (int32_t k = 0; k < (int32_t)f.count && status == FS_OK; k++) {
    double angle = k * 180 / f.count;
    f.at = light_plane(&f, angle);
    status = fs_levels_append(ctx, quads, &field, NULL, 0, angle, options, &list);
  }
  return finish(ctx, status, quads, &list, curves);
}

const fs_plot fs_plot_reflection = {"reflection", "reflections of parallel lines of light, far away", reflection_params,
                                    trace_reflection};

/* Triangles are many: about 2^16 cells in all, but at least a quarter of those that curves are searched with. */
static int32_t choose_cells(int32_t n_patches, int32_t n_cells) {
  int32_t n = 2 * n_cells;
  while (n > 2 && 4 * n > n_cells && (double)n_patches * n * n > 65536) n--;
  return n;
}

static fs_status trace_zebra(fs_context *ctx, const fs_surface *surface, const double *param,
                             const fs_trace_options *options, fs_curves **curves) {
  line_field f = mirror_of(param);
  fs_field edge = {reflection, &f}, inside = {stripes, &f};
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  fs_trace_options o = fs_trace_options_complete(surface, options);
  fs_status status = start(ctx, surface, &quads, &list);
  /* cos(count phi) = 0 for phi = (k + 1/2) 180 / count, and there 180 degrees further too: one plane for both */
  for (int32_t k = 0; k < (int32_t)f.count && status == FS_OK; k++) {
    double angle = (k + 0.5) * 180 / f.count + 90;
    f.at = light_plane(&f, angle);
    status = fs_levels_append(ctx, quads, &edge, NULL, 0, angle - 90, options, &list);
  }
  if (status == FS_OK)
    status = fs_bands_append(ctx, quads, &inside, 0, choose_cells(quads->n_patches, o.n_cells), &list);
  return finish(ctx, status, quads, &list, curves);
}

const fs_plot fs_plot_zebra = {"zebra", "reflections of dark and bright stripes: the edges, and the dark parts",
                               zebra_params, trace_zebra};

/* ---- highlight lines ---- */

static double highlight(const void *user, const fs_vec3 x[FS_JET_SIZE]) {
  const line_field *f = user;
  fs_vec3 n;
  if (!fs_normal_compute(x, &n)) return NAN;
  return fs_vec3_dot(fs_vec3_cross(f->axis, n), fs_vec3_sub(f->at, x[FS_D]));
}

static const fs_param highlight_params[] = {
    PARAM_COUNT("lines of light", 24),
    PARAM_AZIMUTH("direction of the lines of light, degrees from x towards y", 0),
    PARAM_ELEVATION("direction of the lines of light, degrees above the xy plane", 0),
    {.name = "height",
     .summary = "distance of the lines from the middle of the surface, upwards, in diagonals",
     .initial = 2,
     .min = 0.6,
     .max = 1000},
    {0}};

static fs_status trace_highlight(fs_context *ctx, const fs_surface *surface, const double *param,
                                 const fs_trace_options *options, fs_curves **curves) {
  line_field f = {.axis = fs_direction_of(param[1], param[2])};
  fs_field field = {highlight, &f};
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  int32_t count = (int32_t)param[0];
  fs_vec3 centre;
  double diagonal = fs_surface_diagonal(surface, &centre);
  fs_status status = start(ctx, surface, &quads, &list);
  complete_frame(f.axis, &f.a, &f.b); /* b is upwards, a sideways */
  for (int32_t k = 0; k < count && status == FS_OK; k++) {
    double aside = ((k + 0.5) / count - 0.5) * 2 * diagonal * (1 + param[3]);
    f.at = fs_vec3_add_scaled(fs_vec3_add_scaled(centre, f.b, param[3] * diagonal), f.a, aside);
    status = fs_levels_append(ctx, quads, &field, NULL, 0, aside, options, &list);
  }
  return finish(ctx, status, quads, &list, curves);
}

const fs_plot fs_plot_highlight = {"highlight", "points whose normals meet one of many parallel lines of light",
                                   highlight_params, trace_highlight};
