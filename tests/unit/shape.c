/* SPDX-License-Identifier: MIT */
/* Areas, volumes, energies and extreme curvatures against formulas for tori, spheres, cylinders and graphs. */
#include <fairsurf/analyse.h>
#include "math/vec3.h"
#include "analyse_samples.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

static const double pi = 3.14159265358979323846;

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}
static void near_part(double a, double b, double tolerance) { near(a, b, tolerance * fabs(b)); }

static fs_shape measure(const fs_surface *s) {
  fs_context ctx = test_context();
  fs_shape shape;
  assert_int_equal(fs_shape_measure(&ctx, s, 0, &shape), FS_OK);
  return shape;
}

static fs_surface *whole_torus(double R, double r) {
  fs_surface *s = sample_empty();
  for (int j = 0; j < 4; j++)
    for (int i = 0; i < 4; i++) sample_add_torus(s, R, r, 0.3 + i * pi / 2, pi / 2, j * pi / 2, pi / 2);
  return s;
}

static fs_vec3 at(const fs_surface *s, fs_place place) {
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(s, place.patch, place.u, place.v, x);
  return x[FS_D];
}

static void test_whole_torus(void **state) {
  static const double radii[3][2] = {{1.4142135623730951, 1}, {2, 0.7}, {3, 1}};
  (void)state;
  for (int t = 0; t < (TEST_IS_SANITIZED ? 1 : 3); t++) {
    double R = radii[t][0], r = radii[t][1], most = 0;
    fs_surface *s = whole_torus(R, r);
    fs_shape shape = measure(s);
    near_part(shape.area, 4 * pi * pi * R * r, 1e-9);
    near_part(shape.volume, 2 * pi * pi * R * r * r, 1e-9);
    near_part(shape.willmore, pi * pi * R * R / (r * sqrt(R * R - r * r)), 1e-7);
    near_part(shape.S, pi * pi * R * R / (2 * r * pow(R * R - r * r, 1.5)), 1e-6);
    near(shape.H.min, -0.5 * (1 / r + 1 / (R + r)), 1e-9);
    near(shape.H.max, -0.5 * (1 / r - 1 / (R - r)), 1e-9);
    near(shape.K.max, 1 / (r * (R + r)), 1e-9);
    near(shape.K.min, -1 / (r * (R - r)), 1e-9);
    near(shape.hollow, 1 / (R - r), 1e-9);
    near(shape.ridge, -1 / r, 1e-9);
    near(shape.curvature, fmax(1 / r, 1 / (R - r)), 1e-9);
    fs_vec3 hollow = at(s, shape.at_hollow);
    near(hypot(hollow.x, hollow.y), R - r, 1e-6);
    for (int k = 0; k <= 100000; k++) {
      double v = pi * k / 100000;
      most = fmax(most, 0.5 * R * sin(v) / (r * pow(R + r * cos(v), 2)));
    }
    near(shape.gradient.max, most, 1e-8 * most);
    near(shape.gradient.min, 0, 1e-8);
    near(shape.diameter, 2 * (R + r), 1e-9);
    near(fs_vec3_distance(at(s, shape.diameter_end[0]), at(s, shape.diameter_end[1])), shape.diameter, 1e-12);
    assert_int_equal(shape.n_singular, 0);
    assert_true(shape.regularity > 0.1);
    sample_grown_free(s);
  }
}

/* On a torus the area where the angle around the tube is at most v is 4 pi r (R v + r sin v), and H grows with v. */
static void test_percentiles(void **state) {
  const double R = 2, r = 0.7;
  fs_surface *s = whole_torus(R, r);
  fs_shape shape = measure(s);
  (void)state;
  for (int k = 0; k < FS_N_PERCENTILES; k++) {
    double low = 0, high = pi;
    for (int step = 0; step < 60; step++) {
      double v = 0.5 * (low + high);
      if (R * v + r * sin(v) < fs_percentiles[k] / 100 * pi * R)
        low = v;
      else
        high = v;
    }
    near(shape.H.percentile[k], -0.5 * (1 / r + cos(low) / (R + r * cos(low))), 1e-2);
    near(shape.K.percentile[4 - k], cos(low) / (r * (R + r * cos(low))), 3e-2);
  }
  sample_grown_free(s);
}

/* So many patches that only some of their nodes are looked at: pieces t = shift + u of the graph of t^2 / 2, with
   H = (1 + t^2)^(-3/2) / 2 and dA = sqrt(1 + t^2); shifts go from 0 to 1, so t is met as often as min(t, 2 - t). */
static void test_percentiles_of_many(void **state) {
  enum { N_STEPS = 20000 };
  const int n_patches = TEST_IS_SANITIZED ? 2000 : 40000; /* sanitizers copy what grows */
  fs_surface *s = sample_empty();
  double total = 0;
  fs_shape shape;
  (void)state;
  for (int p = 0; p < n_patches; p++) {
    double shift = (p + 0.5) / n_patches;
    const double x[16] = {shift, 1}, y[16] = {0, 0, 0, 0, 1}, z[16] = {shift * shift / 2, shift, 0.5};
    sample_add_powers(s, 3, 3, (const double *[3]){x, y, z});
  }
  shape = measure(s);
  for (int i = 0; i < N_STEPS; i++) {
    double t = 2 * (i + 0.5) / N_STEPS;
    total += fmin(t, 2 - t) * sqrt(1 + t * t);
  }
  for (int k = 0; k < FS_N_PERCENTILES; k++) {
    double below = 0;
    for (int i = 0; i < N_STEPS; i++) {
      double t = 2 * (i + 0.5) / N_STEPS;
      if (0.5 * pow(1 + t * t, -1.5) < shape.H.percentile[k]) below += fmin(t, 2 - t) * sqrt(1 + t * t);
    }
    near(below / total, fs_percentiles[k] / 100, 2e-3);
  }
  sample_grown_free(s);
}

static void test_sphere_and_cylinder(void **state) {
  const double r = 1.7, b = 0.9;
  fs_surface *s = sample_empty();
  fs_shape shape;
  (void)state;
  for (int i = 0; i < 3; i++) sample_add_torus(s, 0, r, i * 2 * pi / 3, 2 * pi / 3, -b, 2 * b);
  shape = measure(s);
  near_part(shape.area, 4 * pi * r * r * sin(b), 1e-9);
  near_part(shape.volume, 4 * pi * r * r * r * sin(b) / 3, 1e-9);
  near_part(shape.willmore, 4 * pi * sin(b), 1e-9);
  near(shape.S, 0, 1e-20);
  near(shape.H.min, -1 / r, 1e-11);
  near(shape.H.max, -1 / r, 1e-11);
  near(shape.K.percentile[2], 1 / (r * r), 1e-11);
  near(shape.curvature, 1 / r, 1e-11);
  near(shape.diameter, 2 * r, 1e-9);
  sample_grown_free(s);
  s = sample_empty();
  for (int i = 0; i < 3; i++) sample_add_cylinder(s, r, i * 2 * pi / 3, 2 * pi / 3, -1, 3);
  shape = measure(s);
  near_part(shape.area, 6 * pi * r, 1e-9);
  near_part(shape.volume, 2 * pi * r * r,
            1e-9); /* of the cones over the wall: all of the cylinder but the two over its ends */
  near_part(shape.willmore, 6 * pi * r / (4 * r * r), 1e-9);
  near(shape.K.max, 0, 1e-10);
  near(shape.K.min, 0, 1e-10);
  near(shape.ridge, -1 / r, 1e-10);
  near(shape.diameter, sqrt(4 * r * r + 9), 1e-9);
  sample_grown_free(s);
}

/* Integrals over the unit square by quadrature of closed formulas with 80 nodes; as one patch, and cut in six. */
static void test_graphs(void **state) {
  static const struct {
    int i, j;
    double S, willmore, area;
  } cases[] = {
      {1, 1, 0.05818831883894, 0.01791716453044, 1.280789275273},
      {3, 0, 3.091739546388, 0.3623805127874, 1.547865654684},
      {2, 1, 0.8794643847793, 0.1208915667455, 1.249504263163},
      {3, 3, 2.945106176589, 0.1966479416254, 1.162040641819},
  };
  (void)state;
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
    for (int cut = 0; cut < 2; cut++) {
      double c[16] = {0};
      fs_surface *s = sample_empty();
      c[cases[k].i + 4 * cases[k].j] = 1;
      for (int p = 0; p < (cut ? 6 : 1); p++)
        sample_add_graph(s, 3, 3, c, cut ? p % 2 / 2. : 0, cut ? 0.5 : 1, cut ? p / 2 / 3. : 0, cut ? 1 / 3. : 1);
      fs_shape shape = measure(s);
      near_part(shape.area, cases[k].area, 1e-9);
      /* p . n / 3 of a graph is (z - x z_x - y z_y) / 3 = (1 - i - j) z / 3 of z = x^i y^j */
      near_part(shape.volume, (1 - cases[k].i - cases[k].j) / (3. * (cases[k].i + 1) * (cases[k].j + 1)), 1e-12);
      near_part(shape.willmore, cases[k].willmore, 1e-7);
      near_part(shape.S, cases[k].S, 1e-5);
      near(shape.area, cases[k].area, fmax(shape.area_error, 1e-11));
      sample_grown_free(s);
    }
}

/* The curvature of z = x^2 / 2 is (1 + x^2)^-1.5: largest at the border x = 0, which no node meets. */
static void test_extreme_at_border(void **state) {
  double c[16] = {[2] = 0.5};
  fs_surface *s = sample_empty();
  sample_add_graph(s, 3, 3, c, 0, 2, 0, 1);
  fs_shape shape = measure(s);
  (void)state;
  near(shape.hollow, 1, 1e-12);
  near(shape.ridge, 0, 1e-12);
  near(at(s, shape.at_hollow).x, 0, 1e-6);
  near(shape.H.min, 0.5 * pow(5, -1.5), 1e-10);
  sample_grown_free(s);
}

static void test_singular(void **state) {
  fs_surface *s = sample_empty();
  (void)state;
  sample_add_torus(s, 0, 1, 0, 1, 0.2, pi / 2 - 0.2); /* up to the pole */
  sample_add_torus(s, 0, 1, 1, 1, 0.2, 1);
  fs_shape shape = measure(s);
  assert_int_equal(shape.n_singular, 1);
  assert_int_equal(shape.at_regularity.patch, 0);
  near(shape.regularity, 0, 1e-8);
  near(shape.at_regularity.v, 1, 1e-6);
  near(shape.H.max, -1, 1e-4);
  sample_grown_free(s);
}

/* A Bezier triangle of degree 2: z = x^2 + y^2 over the triangle (0,0), (1,0), (0,1). p . n / 3 of a graph is
   (z - x z_x - y z_y) / 3, so that the volume is -1/18; the area comes from quadrature of sqrt(1 + 4 x^2 + 4 y^2) in polar
   coordinates. */
static void test_triangle(void **state) {
  double points[18] = {0, 0, 0, 0.5, 0, 0, 1, 0, 1, 0, 0.5, 0, 0.5, 0.5, 0, 0, 1, 1};
  fs_patch patch = {.kind = FS_PATCH_BEZIER_TRIANGLE,
                    .n_sides = 3,
                    .degree_u = 2,
                    .degree_v = 2,
                    .face = FS_NONE,
                    .valence = 4,
                    .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  fs_surface s = {.n_patches = 1, .n_data = 18, .patch = &patch, .data = points};
  fs_shape shape = measure(&s);
  double area = 0;
  enum { N = 4000 };
  (void)state;
  for (int k = 0; k < N; k++) { /* integral of r sqrt(1 + 4 r^2) dr = (1 + 4 r^2)^1.5 / 12 up to r = 1 / (cos + sin) */
    double angle = (k + 0.5) * pi / 2 / N, r = 1 / (cos(angle) + sin(angle));
    area += (pow(1 + 4 * r * r, 1.5) - 1) / 12 * pi / 2 / N;
  }
  near(shape.volume, -1 / 18., 1e-12);
  near_part(shape.area, area, 1e-6);
  near(shape.hollow, 2, 1e-9);
  near(shape.diameter, sqrt(2), 1e-9);
}

static void test_refusals(void **state) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_surface empty = {0}, *s = whole_torus(2, 1);
  fs_shape shape = {.area = 7};
  (void)state;
  assert_int_equal(fs_shape_measure(&ctx, &empty, 0, &shape), FS_ERR_ARGUMENT);
  s->data[5] = INFINITY;
  assert_int_equal(fs_shape_measure(&ctx, s, 0, &shape), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "patch 0"));
  assert_true(shape.area == 7);
  assert_int_equal(memory.n_live, 0);
  sample_grown_free(s);
}

static void test_memory_and_threads(void **state) {
  double c[16] = {[2] = 0.5, [5] = 1};
  fs_surface *s = sample_empty();
  fs_shape one, many;
  fs_context several = {.n_threads = 3};
  (void)state;
  for (int p = 0; p < 40; p++) sample_add_graph(s, 3, 3, c, p, 1, 0, 1);
  one = measure(s);
  assert_int_equal(fs_shape_measure(&several, s, 0, &many), FS_OK);
  assert_memory_equal(&one, &many, sizeof one);
  for (int64_t fail_at = 1;; fail_at++) {
    struct test_memory memory = {.fail_at = fail_at};
    fs_context ctx = test_memory_context(&memory);
    fs_status status = fs_shape_measure(&ctx, s, 1e-3, &many);
    assert_int_equal(memory.n_live, 0);
    if (status == FS_OK) break;
    assert_int_equal(status, FS_ERR_MEMORY);
  }
  sample_grown_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_whole_torus),
      cmocka_unit_test(test_percentiles),
      cmocka_unit_test(test_percentiles_of_many),
      cmocka_unit_test(test_sphere_and_cylinder),
      cmocka_unit_test(test_graphs),
      cmocka_unit_test(test_extreme_at_border),
      cmocka_unit_test(test_singular),
      cmocka_unit_test(test_triangle),
      cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_memory_and_threads),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
