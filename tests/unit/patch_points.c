/* SPDX-License-Identifier: MIT */
/* Patches at many points have the numbers of patches at one, for every instruction set, number of points and kind. */
#include "math/diffgeo.h"
#include "patch_samples.h"
#include "surface/points.h"
#include "surface/surface.h"
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

enum { MOST = 37 };

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

/* Corners and sides first, then points inside; of three sides those of the triangle. */
static void make_parameters(int n_sides, double *u, double *v) {
  uint64_t seed = 9;
  for (int k = 0; k < MOST; k++) {
    u[k] = k < 4 ? k % 2 : test_random_real(&seed, 0, 1);
    v[k] = k < 4 ? k / 2 : k < 8 ? k % 2 : test_random_real(&seed, 0, 1);
    if (n_sides == 3 && u[k] + v[k] > 1) u[k] = 1 - u[k], v[k] = 1 - v[k];
  }
}

static void check(const fs_surface *s, int32_t p, int32_t order, size_t n, const double *u, const double *v,
                  const double *out) {
  static const int n_derivatives[4] = {1, 3, 6, 10};
  fs_vec3 x[FS_JET_SIZE];
  for (size_t i = 0; i < n; i++) {
    fs_surface_evaluate(s, p, u[i], v[i], x);
    for (int k = 0; k < n_derivatives[order]; k++)
      for (int d = 0; d < 3; d++) {
        double due = (&x[k].x)[d], found = out[(size_t)(3 * k + d) * n + i];
        if (isnan(due))
          assert_true(isnan(found));
        else
          near(found, due, 1e-13 * (k < FS_DUU ? 1 : 10));
      }
  }
}

static void test_points(void **state) {
  (void)state;
  for (int quad = 0; quad < 2; quad++) {
    fs_surface *s = sample_pyramid(quad == 0 ? FS_PATCH_GREGORY_QUAD : FS_PATCH_TENSOR_BEZIER);
    double u[MOST], v[MOST], out[3 * FS_JET_SIZE * MOST];
    for (int32_t p = 0; p < s->n_patches; p++)
      for (int32_t order = 0; order <= 3; order++)
        for (size_t n = 0; n <= MOST; n += n < 9 ? 1 : 14) {
          make_parameters(s->patch[p].n_sides, u, v);
          fs_surface_evaluate_points(s, p, order, n, u, v, out);
          check(s, p, order, n, u, v, out);
        }
    sample_pyramid_free(s);
  }
}

static void test_kernels(void **state) {
  fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD);
  const fs_points_kernels *all[3];
  double u[MOST], v[MOST], out[18 * MOST];
  int32_t n_kernels = fs_points_kernels_all(all);
  (void)state;
  make_parameters(4, u, v);
  assert_true(n_kernels >= 1);
  for (int32_t i = 0; i < n_kernels; i++)
    for (int32_t order = 0; order <= 2; order++) {
      all[i]->quad(s->data, 1, order, MOST, u, v, MOST, out);
      check(s, 0, order, MOST, u, v, out);
    }
  sample_pyramid_free(s);
}

/* All points of a grid, for every kernel set and degrees that are not the same. */
static void test_all_of_a_grid(void **state) {
  enum { N = 16, DEGREE_U = 5, DEGREE_V = 9, N_POINTS = (DEGREE_U + 1) * (DEGREE_V + 1) };
  static double data[3 * N_POINTS], out[3 * FS_JET_SIZE * N * N], all_u[N * N], all_v[N * N];
  fs_patch patch = {.kind = FS_PATCH_TENSOR_BEZIER, .n_sides = 4, .degree_u = DEGREE_U, .degree_v = DEGREE_V};
  fs_surface s = {1, 3 * N_POINTS, &patch, data};
  const fs_points_kernels *all[3];
  double u[N], v[N];
  int32_t n_kernels = fs_points_kernels_all(all);
  uint64_t seed = 3;
  (void)state;
  for (int i = 0; i < N; i++) u[i] = i / (N - 1.), v[i] = test_random_real(&seed, 0, 1);
  for (int i = 0; i < 3 * N_POINTS; i++) data[i] = test_random_real(&seed, -1, 1);
  for (int i = 0; i < N * N; i++) all_u[i] = u[i % N], all_v[i] = v[i / N];
  for (int32_t k = 0; k < n_kernels; k++)
    for (int turn = 0; turn < 2; turn++) {
      patch.degree_u = turn == 0 ? DEGREE_U : 3, patch.degree_v = turn == 0 ? DEGREE_V : 3;
      all[k]->grid(patch.degree_u, patch.degree_v, data, N, u, v, out);
      check(&s, 0, 3, N * N, all_u, all_v, out);
    }
  fs_surface_evaluate_grid(&s, 0, N, u, v, out);
  check(&s, 0, 3, N * N, all_u, all_v, out);
  fs_surface_evaluate_grid(&s, 0, 3, u, v, out); /* no kernel */
  for (int i = 0; i < 9; i++) all_u[i] = u[i % 3], all_v[i] = v[i / 3];
  check(&s, 0, 3, 9, all_u, all_v, out);
}

/* Bezier triangles of every low degree and a high one, for every kernel set. */
static void test_triangles(void **state) {
  static const int degree[6] = {1, 2, 3, 4, 7, FS_MAX_DEGREE};
  static double data[3 * (FS_MAX_DEGREE + 1) * (FS_MAX_DEGREE + 2) / 2];
  fs_patch patch = {.kind = FS_PATCH_BEZIER_TRIANGLE, .n_sides = 3};
  fs_surface s = {1, sizeof data / sizeof *data, &patch, data};
  const fs_points_kernels *all[3];
  double u[MOST], v[MOST], out[3 * FS_JET_SIZE * MOST];
  int32_t n_kernels = fs_points_kernels_all(all);
  (void)state;
  make_parameters(3, u, v);
  for (int d = 0; d < 6; d++) {
    uint64_t seed = 17;
    double steep = fmax(1, pow(degree[d] / 4., 3)); /* third derivatives grow with the cube of the degree */
    for (size_t i = 0; i < s.n_data; i++) data[i] = test_random_real(&seed, -1, 1) / steep;
    patch.degree_u = patch.degree_v = degree[d];
    for (int32_t k = 0; k < n_kernels; k++) {
      all[k]->triangle(degree[d], data, FS_JET_SIZE, MOST, u, v, out);
      check(&s, 0, 3, MOST, u, v, out);
    }
  }
}

static void test_bend(void **state) {
  fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD);
  double u[MOST], v[MOST], out[8 * MOST];
  (void)state;
  for (int32_t p = 0; p < s->n_patches; p++) {
    make_parameters(s->patch[p].n_sides, u, v);
    fs_surface_bend_points(s, p, MOST, u, v, out);
    for (size_t i = 0; i < MOST; i++) {
      fs_vec3 x[FS_JET_SIZE];
      fs_geometry g;
      fs_surface_evaluate(s, p, u[i], v[i], x);
      assert_true(fs_geometry_compute(x, &g));
      for (size_t d = 0; d < 3; d++) {
        near(out[d * MOST + i], (&x[FS_D].x)[d], 1e-14);
        near(out[(3 + d) * MOST + i], (&g.normal.x)[d], 1e-12);
      }
      near(out[6 * MOST + i], g.H, 1e-9 * (1 + fabs(g.H)));
      near(out[7 * MOST + i], g.K, 1e-9 * (1 + g.H * g.H + fabs(g.K)));
    }
  }
  sample_pyramid_free(s);
}

/* A patch that is a line has no normal. */
static void test_line(void **state) {
  double data[48], u[3] = {0, 0.3, 1}, v[3] = {0.5, 0.2, 1}, out[24];
  fs_patch patch = {.kind = FS_PATCH_TENSOR_BEZIER, .n_sides = 4, .degree_u = 3, .degree_v = 3};
  fs_surface s = {1, 48, &patch, data};
  (void)state;
  for (int k = 0; k < 16; k++) data[3 * k] = k % 4, data[3 * k + 1] = data[3 * k + 2] = 0;
  fs_surface_bend_points(&s, 0, 3, u, v, out);
  near(out[1], 0.9, 1e-15);
  for (int k = 9; k < 24; k++) assert_true(isnan(out[k]));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_points),        cmocka_unit_test(test_kernels),
                                     cmocka_unit_test(test_all_of_a_grid), cmocka_unit_test(test_triangles),
                                     cmocka_unit_test(test_bend),          cmocka_unit_test(test_line)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
