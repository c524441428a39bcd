/* SPDX-License-Identifier: MIT */
/* Curvature combs of plane sections against formulas, at every traced point: of a surface F = 0 the section by the plane of
   orthonormal a, b is the curve f(s, t) = F(p + s a + t b) = 0 with the curvature vector
   -(f_ss f_t^2 - 2 f_st f_s f_t + f_tt f_s^2) (f_s a + f_t b) / (f_s^2 + f_t^2)^2 [Goldman 2005]. The derivatives of F are
   formulas in x, y, z; nothing of the patches is used but the positions. */
#include <fairsurf/analyse_curves.h>
#include "math/vec3.h"
#include "analyse_samples.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static const double pi = 3.14159265358979323846;

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

/* Derivatives of F: g[3], and xx, xy, xz, yy, yz, zz. */
typedef struct derivatives {
  double value, g[3], h[6];
} derivatives;

/* A surface F = 0, and its patches. */
typedef struct sample {
  derivatives (*at)(fs_vec3 p);
  void (*add)(fs_surface *s);
} sample;

/* ---- surfaces ---------------------------------------------------------------------------------------------------- */

static const double R = 2, r = 0.7; /* of the torus; r of the cylinder and the sphere too */

static derivatives torus(fs_vec3 p) { /* (q - R)^2 + z^2 - r^2, q^2 = x^2 + y^2: q_x = x / q */
  double q = hypot(p.x, p.y), x = p.x / q, y = p.y / q, c = 2 * (1 - R / q), d = 2 * R / q;
  return (derivatives){(q - R) * (q - R) + p.z * p.z - r * r,
                       {2 * (q - R) * x, 2 * (q - R) * y, 2 * p.z},
                       {c + d * x * x, d * x * y, 0, c + d * y * y, 0, 2}};
}

static derivatives sphere(fs_vec3 p) {
  return (derivatives){fs_vec3_dot(p, p) - r * r, {2 * p.x, 2 * p.y, 2 * p.z}, {2, 0, 0, 2, 0, 2}};
}

static derivatives cylinder(fs_vec3 p) {
  return (derivatives){p.x * p.x + p.y * p.y - r * r, {2 * p.x, 2 * p.y, 0}, {2, 0, 0, 2, 0, 0}};
}

/* z = x^2 / 2 - 0.3 y^2 + 0.4 x y + 0.2 x^3 y^2 - 0.1 x y^3 + 0.05 x^3 y^3: a bicubic patch */
static derivatives graph(fs_vec3 p) {
  double x = p.x, y = p.y;
  double f = x * x / 2 - 0.3 * y * y + 0.4 * x * y + 0.2 * x * x * x * y * y - 0.1 * x * y * y * y +
             0.05 * x * x * x * y * y * y;
  double fx = x + 0.4 * y + 0.6 * x * x * y * y - 0.1 * y * y * y + 0.15 * x * x * y * y * y;
  double fy = -0.6 * y + 0.4 * x + 0.4 * x * x * x * y - 0.3 * x * y * y + 0.15 * x * x * x * y * y;
  double fxx = 1 + 1.2 * x * y * y + 0.3 * x * y * y * y;
  double fxy = 0.4 + 1.2 * x * x * y - 0.3 * y * y + 0.45 * x * x * y * y;
  double fyy = -0.6 + 0.4 * x * x * x - 0.6 * x * y + 0.3 * x * x * x * y;
  return (derivatives){p.z - f, {-fx, -fy, 1}, {-fxx, -fxy, 0, -fyy, 0, 0}};
}

static void add_torus(fs_surface *s) {
  for (int k = 0; k < 4; k++) sample_add_torus(s, R, r, 0.3 + k % 2 * pi / 2, pi / 2, k / 2 * pi / 2, pi / 2);
}
static void add_sphere(fs_surface *s) {
  for (int k = 0; k < 2; k++) sample_add_torus(s, 0, r, k * pi / 2, pi / 2, -1, 2);
}
static void add_cylinder(fs_surface *s) {
  for (int k = 0; k < 2; k++) sample_add_cylinder(s, r, k * pi / 2, pi / 2, -1, 2);
}
static void add_graph(fs_surface *s) {
  static const double c[16] = {[2] = 0.5, [5] = 0.4, [8] = -0.3, [11] = 0.2, [13] = -0.1, [15] = 0.05};
  for (int k = 0; k < 4; k++) sample_add_graph(s, 3, 3, c, k % 2 - 1, 1, k / 2 - 1, 1);
}

/* ---- combs ------------------------------------------------------------------------------------------------------- */

static fs_vec3 section_curvature(const derivatives *F, fs_vec3 a, fs_vec3 b) {
  double u[2][3] = {{a.x, a.y, a.z}, {b.x, b.y, b.z}}, g[2] = {0}, h[2][2] = {{0}};
  static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  for (int i = 0; i < 2; i++)
    for (int d = 0; d < 3; d++) {
      g[i] += F->g[d] * u[i][d];
      for (int j = 0; j < 2; j++)
        for (int e = 0; e < 3; e++) h[i][j] += F->h[at[d][e]] * u[i][d] * u[j][e];
    }
  double square = g[0] * g[0] + g[1] * g[1];
  double part = -(h[0][0] * g[1] * g[1] - 2 * h[0][1] * g[0] * g[1] + h[1][1] * g[0] * g[0]) / (square * square);
  return fs_vec3_add(fs_vec3_scale(a, part * g[0]), fs_vec3_scale(b, part * g[1]));
}

static double diagonal_of(const fs_surface *s) { /* of the box of the corners */
  fs_vec3 low = {1e9, 1e9, 1e9}, high = {-1e9, -1e9, -1e9}, x[FS_JET_SIZE];
  for (int k = 0; k < 4 * s->n_patches; k++) {
    fs_surface_evaluate(s, k / 4, k % 2, k / 2 % 2, x);
    low = fs_vec3_min(low, x[FS_D]), high = fs_vec3_max(high, x[FS_D]);
  }
  return fs_vec3_distance(low, high);
}

/* Cuts by planes of these angles. The longest tooth has a quarter of the diagonal, and every tooth is -curvature times one
   factor, to 1e-9 of the longest; along straight lines there are none. */
static void check_combs(const sample *sample, double azimuth, double elevation) {
  enum { N = 3 };
  const double param[4] = {N, azimuth, elevation, 0.25}, alpha = azimuth * pi / 180, beta = elevation * pi / 180;
  const fs_vec3 m = {cos(alpha) * cos(beta), sin(alpha) * cos(beta), sin(beta)};
  const fs_vec3 a = {-sin(alpha), cos(alpha), 0}, b = fs_vec3_cross(m, a);
  const fs_trace_options options = {.tolerance = 1e-2, .n_cells = 3};
  fs_context ctx = test_context();
  fs_surface *s = sample_empty();
  fs_curves *curves = NULL;
  double longest = 0, factor, diagonal;
  sample->add(s);
  diagonal = diagonal_of(s);
  assert_int_equal(fs_plot_trace(&ctx, fs_plot_find("sections"), s, param, &options, &curves), FS_OK);
  assert_true(curves->n_curves >= N);
  for (int32_t i = 0; i < curves->n_points; i++) {
    derivatives F = sample->at(curves->point[i].position);
    longest = fmax(longest, fs_vec3_length(section_curvature(&F, a, b)));
  }
  factor = longest > 1e-12 ? 0.25 * diagonal / longest : 0;
  for (int32_t c = 0; c < curves->n_curves; c++)
    for (int32_t i = 0; i < curves->curve[c].n_points; i++) {
      const fs_curve_point *p = &curves->point[curves->curve[c].first + i];
      derivatives F = sample->at(p->position);
      near(F.value, 0, 1e-12);
      near(fs_vec3_dot(p->position, m), curves->curve[c].level, 1e-10);
      fs_vec3 wrong = fs_vec3_add_scaled(p->tooth, section_curvature(&F, a, b), factor);
      near(fs_vec3_length(wrong), 0, 1e-9 * 0.25 * diagonal);
    }
  fs_curves_free(&ctx, curves);
  sample_grown_free(s);
}

static void test_combs(void **state) {
  static const sample samples[] = {
      {torus, add_torus}, {sphere, add_sphere}, {cylinder, add_cylinder}, {graph, add_graph}};
  static const double angles[][2] = {{90, 0}, {35, 50}, {-70, -25}};
  (void)state;
  for (size_t i = 0; i < sizeof samples / sizeof *samples; i++)
    for (size_t k = 0; k < sizeof angles / sizeof *angles; k++) check_combs(&samples[i], angles[k][0], angles[k][1]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_combs),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
