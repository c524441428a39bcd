/* SPDX-License-Identifier: MIT */
/* Kinds of patches: derivatives, domains of three sides, parts, tessellation and stand-ins of surfaces that mix them. */
#include <fairsurf/analyse.h>
#include "math/vec3.h"
#include "patch_samples.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

static void near_points(fs_vec3 a, fs_vec3 b, double tolerance) {
  if (!(fs_vec3_distance(a, b) <= tolerance))
    fail_msg("(%.12g %.12g %.12g) is not (%.12g %.12g %.12g)", a.x, a.y, a.z, b.x, b.y, b.z);
}

/* ---- derivatives ---- */

/* Central difference of fourth order of derivative k along u or v. */
static fs_vec3 difference(const fs_surface *s, int p, double u, double v, int k, bool is_v) {
  const double h = 1e-3, at[4] = {-2, -1, 1, 2}, weight[4] = {1, -8, 8, -1};
  fs_vec3 sum = {0, 0, 0}, x[FS_JET_SIZE];
  for (int i = 0; i < 4; i++) {
    fs_surface_evaluate(s, p, u + (is_v ? 0 : at[i] * h), v + (is_v ? at[i] * h : 0), x);
    sum = fs_vec3_add_scaled(sum, x[k], weight[i] / (12 * h));
  }
  return sum;
}

static void check_jet(const fs_surface *s, int p, double u, double v) {
  static const int by_u[6] = {FS_DU, FS_DUU, FS_DUV, FS_DUUU, FS_DUUV, FS_DUVV};
  static const int by_v[6] = {FS_DV, FS_DUV, FS_DVV, FS_DUUV, FS_DUVV, FS_DVVV};
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(s, p, u, v, x);
  for (int k = 0; k < 6; k++) {
    near_points(x[by_u[k]], difference(s, p, u, v, k, false), 2e-7);
    near_points(x[by_v[k]], difference(s, p, u, v, k, true), 2e-7);
  }
}

static void test_jets(void **state) {
  (void)state;
  for (int quad = 0; quad < 2; quad++) {
    fs_surface *s = sample_pyramid(quad == 0 ? FS_PATCH_GREGORY_QUAD : FS_PATCH_TENSOR_BEZIER), *parts = NULL;
    fs_context ctx = test_context();
    assert_int_equal(fs_surface_to_quads(&ctx, s, &parts), FS_OK);
    for (int p = 0; p < 5; p++) {
      check_jet(s, p, 0.31, 0.42);
      check_jet(s, p, 0.2, 0.15);
      if (s->patch[p].n_sides == 4) check_jet(s, p, 0.8, 0.7);
    }
    for (int p = 0; p < parts->n_patches; p++) check_jet(parts, p, 0.37, 0.61);
    fs_surface_free(&ctx, parts);
    sample_pyramid_free(s);
  }
}

/* Bezier triangles of all degrees have the value of the sum of Bernstein polynomials. */
static void test_bezier_triangle(void **state) {
  uint64_t seed = 3;
  (void)state;
  for (int n = 1; n <= FS_MAX_DEGREE; n += n < 6 ? 1 : 5) {
    fs_patch patch = {.kind = FS_PATCH_BEZIER_TRIANGLE, .n_sides = 3, .degree_u = n, .degree_v = n};
    const double u = 0.3, v = 0.25;
    double data[1600];
    fs_vec3 x[FS_JET_SIZE], sum = {0, 0, 0};
    for (int k = 0, i = 0; k <= n; k++)
      for (int j = 0; j <= n - k; j++, i++) {
        double w = exp(lgamma(n + 1) - lgamma(j + 1) - lgamma(k + 1) - lgamma(n - j - k + 1)) * pow(u, j) * pow(v, k) *
                   pow(1 - u - v, n - j - k);
        for (int d = 0; d < 3; d++) data[3 * i + d] = test_random_real(&seed, -1, 1);
        sum = fs_vec3_add_scaled(sum, (fs_vec3){data[3 * i], data[3 * i + 1], data[3 * i + 2]}, w);
      }
    assert_int_equal(fs_patch_kinds[patch.kind].n_numbers(&patch), 3 * (n + 1) * (n + 2) / 2);
    fs_patch_kinds[patch.kind].jet(&patch, data, u, v, x);
    near_points(x[FS_D], sum, 1e-13);
    for (int k = 0; k < FS_JET_SIZE; k++) assert_true(fs_vec3_is_finite(x[k]));
  }
}

/* At corners first derivatives are those of the boundary, second ones the limits along the middle line. */
static void test_corners(void **state) {
  fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD);
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  (void)state;
  for (int p = 0; p < 5; p++) {
    bool is_triangle = s->patch[p].n_sides == 3;
    const double corner[4][2] = {{0, 0}, {1, 0}, {is_triangle ? 0 : 1, 1}, {0, 1}};
    for (int c = 0; c < s->patch[p].n_sides; c++) {
      double u = corner[c][0], v = corner[c][1], h = 1e-7;
      /* equal distances from both sides at the corner */
      double du = is_triangle ? (c == 1 ? -2 : 1)
                  : u > 0     ? -1
                              : 1,
             dv = is_triangle ? (c == 2 ? -2 : 1)
                  : v > 0     ? -1
                              : 1;
      fs_surface_evaluate(s, p, u, v, x);
      fs_surface_evaluate(s, p, u + h * du, v + h * dv, y);
      for (int k = 0; k <= FS_DVV; k++) near_points(x[k], y[k], 1e-4);
      bool is_rational = fs_patch_kinds[s->patch[p].kind].corner_order < 2;
      assert_true(fs_vec3_is_finite(x[FS_DUUU]) != is_rational);
    }
  }
  sample_pyramid_free(s);
}

/* ---- domains and sides ---- */

static void test_sides(void **state) {
  double u, v;
  (void)state;
  for (int k = 0; k <= 4; k++) {
    double t = k / 4.0;
    fs_side_parameters(3, 0, t, &u, &v);
    assert_true(u == t && v == 0);
    fs_side_parameters(3, 1, t, &u, &v);
    assert_true(u == 1 - t && v == t);
    fs_side_parameters(3, 2, t, &u, &v);
    assert_true(u == 0 && v == 1 - t);
  }
  assert_true(fs_domain_holds(4, 1, 1) && fs_domain_holds(3, 0.5, 0.5) && !fs_domain_holds(3, 0.6, 0.5));
}

static void check_gap(const fs_surface *s, double tolerance) {
  fs_context ctx = test_context();
  fs_contact contact;
  assert_int_equal(fs_surface_validate(&ctx, s), FS_OK);
  assert_int_equal(fs_surface_contact(&ctx, s, 8, &contact), FS_OK);
  assert_int_not_equal(contact.patch[0], FS_NONE);
  near(contact.position, 0, tolerance);
}

static void test_quads(void **state) {
  (void)state;
  for (int quad = 0; quad < 2; quad++) {
    fs_surface *s = sample_pyramid(quad == 0 ? FS_PATCH_GREGORY_QUAD : FS_PATCH_TENSOR_BEZIER), *parts = NULL;
    fs_context ctx = test_context();
    fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
    check_gap(s, 1e-14);
    assert_int_equal(fs_surface_to_quads(&ctx, s, &parts), FS_OK);
    assert_int_equal(parts->n_patches, 16);
    check_gap(parts, 1e-14);
    for (int p = 0, part = 0; p < 5; p++)
      for (int c = 0; c < s->patch[p].n_sides; c++, part++) {
        double u, v, third = s->patch[p].n_sides == 3 ? 1.0 / 3 : 0.5;
        assert_int_equal(parts->patch[part].n_sides, 4);
        fs_surface_evaluate(s, p, third, third, x);
        fs_surface_evaluate(parts, part, 1, 1, y);
        near_points(x[FS_D], y[FS_D], 1e-15);
        fs_side_parameters(s->patch[p].n_sides, c, 0.3, &u, &v);
        fs_surface_evaluate(s, p, u, v, x);
        fs_surface_evaluate(parts, part, 0.6, 0, y);
        near_points(x[FS_D], y[FS_D], 1e-15);
      }
    fs_surface_free(&ctx, parts);
    sample_pyramid_free(s);
  }
}

/* ---- tessellation ---- */

static int count_edge(const fs_triangles *t, int32_t a, int32_t b) {
  int n = 0;
  for (int32_t i = 0; i < 3 * t->n_triangles; i++) n += t->corner[i] == a && t->corner[i % 3 == 2 ? i - 2 : i + 1] == b;
  return n;
}

static void test_tessellation(void **state) {
  (void)state;
  for (int n = 1; n <= 4; n++) {
    fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD);
    fs_context ctx = test_context();
    fs_triangles *t = NULL;
    fs_vec3 x[FS_JET_SIZE];
    assert_int_equal(fs_tessellate(&ctx, s, n, &t), FS_OK);
    assert_int_equal(t->n_triangles, 6 * n * n);
    assert_int_equal(t->n_vertices, 2 + t->n_triangles / 2); /* Euler's formula of a sphere */
    for (int32_t i = 0; i < 3 * t->n_triangles; i++)
      assert_int_equal(count_edge(t, t->corner[i % 3 == 2 ? i - 2 : i + 1], t->corner[i]), 1);
    for (int32_t k = 0; k < t->n_vertices; k++) {
      const double *uv = t->vertex_uv + 2 * k;
      assert_true(fs_domain_holds(s->patch[t->vertex_patch[k]].n_sides, uv[0], uv[1]));
      fs_surface_evaluate(s, t->vertex_patch[k], uv[0], uv[1], x);
      near_points(x[FS_D], t->position[k], 0);
      near(fs_vec3_length(t->normal[k]), 1, 1e-14);
    }
    fs_triangles_free(&ctx, t);
    sample_pyramid_free(s);
  }
}

/* ---- bicubic stand-ins ---- */

static void test_bicubics(void **state) {
  fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD), *rough = NULL, *fine = NULL;
  fs_context ctx = test_context();
  double rough_deviation, deviation;
  (void)state;
  assert_int_equal(fs_surface_to_bicubics(&ctx, s, 1, 0, &rough, &rough_deviation), FS_OK);
  assert_int_equal(rough->n_patches, 16);
  assert_int_equal(fs_surface_to_bicubics(&ctx, s, 1e-3, 6, &fine, &deviation), FS_OK);
  assert_true(deviation <= 1e-3 && rough_deviation > 1e-3);
  check_gap(rough, 1e-13);
  check_gap(fine, 1e-13);
  for (int32_t p = 0; p < fine->n_patches; p++) assert_int_equal(fine->patch[p].kind, FS_PATCH_TENSOR_BEZIER);
  fs_surface_free(&ctx, rough);
  fs_surface_free(&ctx, fine);
  sample_pyramid_free(s);
}

/* ---- refusals ---- */

static void refuse(const fs_surface *s, const char *part) {
  fs_context ctx = test_context();
  assert_int_not_equal(fs_surface_validate(&ctx, s), FS_OK);
  if (strstr(ctx.message, part) == NULL) fail_msg("\"%s\" does not hold \"%s\"", ctx.message, part);
}

static void test_validate(void **state) {
  fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD);
  fs_patch good = s->patch[1];
  double number = s->data[60];
  (void)state;
  s->patch[1].kind = 99, refuse(s, "patch 1 has the unknown kind 99"), s->patch[1] = good;
  s->patch[1].degree_u = 5, refuse(s, "patch 1, a gregory-triangle, cannot have degree (5, 4)"), s->patch[1] = good;
  s->patch[1].n_sides = 4, refuse(s, "cannot have 4 sides"), s->patch[1] = good;
  s->patch[1].part = 4, refuse(s, "part 4"), s->patch[1] = good;
  s->patch[1].data_start = s->n_data - 1, refuse(s, "outside the data"), s->patch[1] = good;
  s->patch[1].neighbour[3] = 0, refuse(s, "side 3 of patch 1"), s->patch[1] = good;
  s->patch[1].neighbour_side[0] ^= 1, refuse(s, "which meets another"), s->patch[1] = good;
  s->data[60] = NAN, refuse(s, "patch 1 has points that are not finite"), s->data[60] = number;
  assert_int_equal(fs_surface_validate(&(fs_context){0}, s), FS_OK);
  sample_pyramid_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_jets),     cmocka_unit_test(test_bezier_triangle), cmocka_unit_test(test_corners),
      cmocka_unit_test(test_sides),    cmocka_unit_test(test_quads),           cmocka_unit_test(test_tessellation),
      cmocka_unit_test(test_bicubics), cmocka_unit_test(test_validate),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
