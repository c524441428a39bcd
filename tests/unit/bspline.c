/* SPDX-License-Identifier: MIT */
/* B-splines of one variable and polynomials over triangles, against what is known of them without computing them. */
#include "math/bspline.h"
#include "math/triangle.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <math.h>
#include <string.h>
#include <cmocka.h>

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

static const double U3[13] = {0, 0, 0, 0, 0.2, 0.5, 0.5, 0.8, 1.5, 2, 2, 2, 2};
static const fs_knots cubic = {3, 9, U3};

/* t^2 has the coefficients of its polar form, (U_i U_j + …) / 3 over the pairs of three knots [Marsden]; t those of Greville. */
static double square_coefficient(int i) {
  const double *u = U3 + i + 1;
  return (u[0] * u[1] + u[1] * u[2] + u[0] * u[2]) / 3;
}

static void test_marsden(void **state) {
  double c[9][3], value[3];
  (void)state;
  for (int i = 0; i < 9; i++) c[i][0] = 1, c[i][1] = fs_knots_greville(&cubic, i), c[i][2] = square_coefficient(i);
  for (int k = 0; k <= 40; k++) {
    double t = k / 20.0;
    fs_bspline_evaluate(&cubic, 3, c[0], t, 0, value);
    near(value[0], 1, 1e-15);
    near(value[1], t, 1e-15);
    near(value[2], t * t, 2e-15);
    fs_bspline_evaluate(&cubic, 3, c[0], t, 1, value);
    near(value[0], 0, 1e-13);
    near(value[1], 1, 1e-13);
    near(value[2], 2 * t, 1e-13);
    fs_bspline_evaluate(&cubic, 3, c[0], t, 2, value);
    near(value[2], 2, 1e-11);
    fs_bspline_evaluate(&cubic, 3, c[0], t, 3, value);
    near(value[2], 0, 1e-9);
    fs_bspline_evaluate(&cubic, 3, c[0], t, 4, value);
    near(value[2], 0, 0);
  }
}

static void random_coefficients(uint64_t seed, int n, double *c) {
  for (int i = 0; i < n; i++) c[i] = test_random_real(&seed, -1, 1);
}

static void test_refinement_keeps_the_curve(void **state) {
  static const double U[20] = {0, 0, 0, 0, 0.1, 0.2, 0.2, 0.2, 0.5, 0.5, 0.6, 0.8, 1.4, 1.5, 1.9, 1.9, 2, 2, 2, 2};
  const fs_knots fine = {3, 16, U};
  fs_context ctx = test_context();
  double c[18], refined[32], a[2], b[2];
  (void)state;
  random_coefficients(5, 18, c);
  assert_int_equal(fs_bspline_refine(&ctx, &cubic, 2, c, &fine, refined), FS_OK);
  for (int k = 0; k <= 50; k++)
    for (int order = 0; order < 3; order++) {
      double t = k / 25.0 - (k == 50 ? 1e-9 : 0);
      fs_bspline_evaluate(&cubic, 2, c, t, order, a);
      fs_bspline_evaluate(&fine, 2, refined, t, order, b);
      near(a[0], b[0], 1e-12 * pow(30, order));
      near(a[1], b[1], 1e-12 * pow(30, order));
    }
  assert_int_equal(fs_bspline_refine(&ctx, &fine, 2, refined, &cubic, c), FS_ERR_ARGUMENT);
}

static void test_bezier_pieces(void **state) {
  fs_context ctx = test_context();
  double c[9], pieces[5 * 4], ends[6];
  static const double expected[6] = {0, 0.2, 0.5, 0.8, 1.5, 2};
  (void)state;
  random_coefficients(7, 9, c);
  assert_int_equal(fs_knots_n_spans(&cubic), 5);
  assert_int_equal(fs_bspline_bezier(&ctx, &cubic, 1, c, pieces, ends), FS_OK);
  for (int p = 0; p < 5; p++) {
    const double *b = pieces + 4 * p;
    near(ends[p], expected[p], 0);
    for (int k = 0; k <= 4; k++) {
      double s = k / 4.0, r = 1 - s, value;
      fs_bspline_evaluate(&cubic, 1, c, ends[p] + s * (expected[p + 1] - expected[p]), 0, &value);
      near(r * r * r * b[0] + 3 * r * r * s * b[1] + 3 * r * s * s * b[2] + s * s * s * b[3], value, 1e-14);
    }
  }
  near(ends[5], 2, 0);
}

static void test_interpolation(void **state) {
  fs_context ctx = test_context();
  double c[9], values[9], x;
  (void)state;
  random_coefficients(8, 9, c);
  for (int i = 0; i < 9; i++) fs_bspline_evaluate(&cubic, 1, c, fs_knots_greville(&cubic, i), 0, &values[i]);
  assert_int_equal(fs_bspline_interpolate(&ctx, &cubic, 1, values), FS_OK);
  for (int i = 0; i < 9; i++) near(values[i], c[i], 1e-13);
  for (int i = 0; i < 9; i++) values[i] = pow(fs_knots_greville(&cubic, i), 3);
  assert_int_equal(fs_bspline_interpolate(&ctx, &cubic, 1, values), FS_OK);
  fs_bspline_evaluate(&cubic, 1, values, 1.3, 0, &x);
  near(x, 1.3 * 1.3 * 1.3, 1e-13);
}

static void test_union(void **state) {
  static const double V[10] = {0, 0, 0, 0, 0.5 + 1e-12, 0.9, 2, 2, 2, 2};
  static const double expected[14] = {0, 0, 0, 0, 0.2, 0.5, 0.5, 0.8, 0.9, 1.5, 2, 2, 2, 2};
  const fs_knots other = {3, 6, V};
  double joined[23];
  (void)state;
  assert_int_equal(fs_knots_unite(&cubic, &other, joined), 14);
  assert_memory_equal(joined, expected, sizeof expected);
  assert_int_equal(fs_knots_multiplicity(&cubic, 0.5), 2);
}

static void refuse(int32_t degree, int32_t n, const double *knot, const char *sentence) {
  fs_context ctx = test_context();
  const fs_knots knots = {degree, n, knot};
  assert_int_equal(fs_knots_check(&ctx, "the knots of 'c'", &knots), FS_ERR_ARGUMENT);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" lacks \"%s\"", ctx.message, sentence);
}

static void test_bad_knots(void **state) {
  fs_context ctx = test_context();
  (void)state;
  assert_int_equal(fs_knots_check(&ctx, "knots", &cubic), FS_OK);
  refuse(16, 17, U3, "degree 16");
  refuse(3, 3, U3, "degree 3 needs 4 control points or more, not 3");
  refuse(1, 3, (const double[]){0, 0, NAN, 1, 1}, "knot 2 is not finite");
  refuse(1, 4, (const double[]){0, 0, 0.6, 0.4, 1, 1}, "the knots of 'c' decrease: knot 3 is 0.4 after 0.6");
  refuse(2, 4, (const double[]){0, 0, 0.1, 0.5, 1, 1, 1}, "not clamped: the first and the last 3 must be equal");
  refuse(1, 2, (const double[]){1, 1, 1, 1}, "span no interval");
  refuse(1, 4, (const double[]){0, 0, 0.5, 0.5, 1, 1}, "knot 3, 0.5, occurs too often");
  refuse(1, 3, (const double[]){0, 0, 0, 1, 1}, "knot 2, 0, occurs too often");
  refuse(1, 3, (const double[]){0, 0, 1, 1, 1}, "knot 2, 1, occurs too often");
}

/* ---- triangles ---- */

static void test_triangle(void **state) {
  static const double l[3] = {0.2, 0.3, 0.5};
  static const int32_t none[3] = {0, 0, 0}, by_1[3] = {0, 1, 0}, by_02[3] = {1, 0, 1};
  double a[10], b[6], product[21] = {0}, raised[28], x, y, z;
  (void)state;
  assert_int_equal(fs_triangle_index(3, 0, 3), 9);
  assert_int_equal(fs_triangle_index(3, 1, 1), 5);
  random_coefficients(3, 10, a);
  random_coefficients(4, 6, b);
  fs_triangle_add_product(3, a, 2, 1, b, product);
  fs_triangle_evaluate(3, 1, a, l, none, &x);
  fs_triangle_evaluate(2, 1, b, l, none, &y);
  fs_triangle_evaluate(5, 1, product, l, none, &z);
  near(z, x * y, 1e-15);
  fs_triangle_elevate(5, 1, product, 6, raised);
  fs_triangle_evaluate(6, 1, raised, l, none, &z);
  near(z, x * y, 1e-15);
  /* l0^2 l1 and its partial derivatives: one coefficient, 2! 1! / 3! of the monomial */
  memset(a, 0, sizeof a);
  a[fs_triangle_index(3, 1, 0)] = 1.0 / 3;
  fs_triangle_evaluate(3, 1, a, l, none, &x);
  near(x, 0.2 * 0.2 * 0.3, 1e-17);
  fs_triangle_evaluate(3, 1, a, l, by_1, &x);
  near(x, 0.2 * 0.2, 1e-16);
  fs_triangle_evaluate(3, 1, a, l, by_02, &x);
  near(x, 0, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_marsden),       cmocka_unit_test(test_refinement_keeps_the_curve),
      cmocka_unit_test(test_bezier_pieces), cmocka_unit_test(test_interpolation),
      cmocka_unit_test(test_union),         cmocka_unit_test(test_bad_knots),
      cmocka_unit_test(test_triangle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
