/* SPDX-License-Identifier: MIT */
/* Self-intersections: surfaces built to cross at known places, and surfaces that only come close or meet in edges. */
#include <fairsurf/analyse.h>
#include "math/vec3.h"
#include "analyse_samples.h"
#include "surface_samples.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

static fs_crossings *find(const fs_surface *s, int32_t n_steps) {
  fs_context ctx = test_context();
  fs_edges *e = NULL;
  fs_crossings *c = NULL;
  assert_int_equal(fs_edges_create(&ctx, s, 0, &e), FS_OK);
  assert_int_equal(fs_crossings_find(&ctx, s, e, n_steps, 10, &c), FS_OK);
  fs_edges_free(&ctx, e);
  /* both places are the point */
  for (int32_t i = 0; i < c->n_listed; i++)
    for (int k = 0; k < 2; k++) {
      fs_vec3 x[FS_JET_SIZE];
      fs_surface_evaluate(s, c->crossing[i].place[k].patch, c->crossing[i].place[k].u, c->crossing[i].place[k].v, x);
      near(fs_vec3_distance(x[FS_D], c->crossing[i].point), 0, 1e-9);
    }
  return c;
}

static int32_t count(const fs_surface *s, int32_t n_steps) {
  fs_context ctx = test_context();
  fs_crossings *c = find(s, n_steps);
  int32_t n = c->n;
  fs_crossings_free(&ctx, c);
  return n;
}

/* The cubic (t^2 - a^2, t (t^2 - a^2)), t = 2 u - 1, meets itself in its double point (0, 0) at t = a and t = -a. */
static void test_loop(void **state) {
  const double a = 0.6;
  fs_context ctx = test_context();
  fs_surface *s = sample_empty();
  (void)state;
  series x = {2, {1 - a * a, -4, 4}}, y = {3, {a * a - 1, 6 - 2 * a * a, -12, 8}};
  sample_add_product(s, (const series[3]){x, y, sample_constant(1)},
                     (const series[3]){sample_constant(1), sample_constant(1), sample_linear(0, 1)});
  fs_crossings *c = find(s, 0);
  assert_int_equal(c->n, 1);
  assert_int_equal(c->n_listed, 1);
  near(c->crossing[0].point.x, 0, 1e-9);
  near(c->crossing[0].point.y, 0, 1e-9);
  double u = c->crossing[0].place[0].u, v = c->crossing[0].place[1].u;
  near(fmin(u, v), 0.5 * (1 - a), 1e-9);
  near(fmax(u, v), 0.5 * (1 + a), 1e-9);
  fs_crossings_free(&ctx, c);
  sample_grown_free(s);
}

/* A plane through a paraboloid: the circle of radius 0.5, in all four quarters. */
static void test_plane_through_bowl(void **state) {
  double bowl[16] = {[2] = 1, [8] = 1}, plane[16] = {0.25};
  fs_context ctx = test_context();
  fs_surface *s = sample_empty();
  (void)state;
  for (int k = 0; k < 4; k++) sample_add_graph(s, 3, 3, bowl, k % 2 - 1, 1, k / 2 - 1, 1);
  sample_add_graph(s, 3, 3, plane, -0.9, 1.8, -0.9, 1.8);
  fs_crossings *c = find(s, 6);
  assert_int_equal(c->n, 4);
  for (int32_t i = 0; i < c->n_listed; i++) {
    near(hypot(c->crossing[i].point.x, c->crossing[i].point.y), 0.5, 1e-9);
    near(c->crossing[i].point.z, 0.25, 1e-9);
    assert_int_equal(c->crossing[i].place[1].patch, 4);
    assert_int_equal(c->crossing[i].place[0].patch, i);
  }
  fs_crossings_free(&ctx, c);
  sample_grown_free(s);
}

/* z = 2 x + 2 y - 1 over the triangle (0, 0), (1, 0), (0, 1), as a Bezier triangle, meets z = 0 on x + y = 0.5. */
static void test_triangle(void **state) {
  static const double tilted[18] = {0, 0, -1, 0.5, 0, 0, 1, 0, 1, 0, 0.5, 0, 0.5, 0.5, 1, 0, 1, 1};
  double plane[16] = {0};
  fs_context ctx = test_context();
  fs_surface *s = sample_empty();
  (void)state;
  sample_add_triangle(s, tilted);
  sample_add_graph(s, 3, 3, plane, -1.1, 3, -1.3, 3);
  fs_crossings *c = find(s, 0);
  assert_int_equal(c->n, 1);
  near(c->crossing[0].point.x + c->crossing[0].point.y, 0.5, 1e-9);
  assert_int_equal(c->crossing[0].place[0].patch, 0);
  near(c->crossing[0].place[0].u + c->crossing[0].place[0].v, 0.5, 1e-9);
  fs_crossings_free(&ctx, c);
  sample_grown_free(s);
}

/* Chords of a coarse bowl cut a plane that the bowl itself passes below: no crossing. */
static void test_coarse_triangles(void **state) {
  double bowl[16] = {[2] = 1, [8] = 1}, above[16] = {[0] = -0.01, [2] = 1, [8] = 1};
  fs_surface *s = sample_empty();
  (void)state;
  sample_add_graph(s, 3, 3, bowl, -1, 2, -1, 2);
  sample_add_graph(s, 3, 3, above, -1.37, 2.74, -1.21, 2.42);
  assert_int_equal(count(s, 2), 0);
  assert_int_equal(count(s, 8), 0);
  sample_grown_free(s);
}

/* Patches that meet in edges, named, unnamed and at T-junctions, do not cross; nor do closed surfaces. */
static void test_neighbours(void **state) {
  double c[16] = {[2] = 0.3, [5] = 0.8, [8] = -0.2};
  fs_surface *s = sample_empty();
  (void)state;
  sample_add_graph(s, 3, 3, c, -1, 1, 0, 1);
  sample_add_graph(s, 3, 3, c, 0, 1, 0, 0.4);
  sample_add_graph(s, 3, 3, c, 0, 1, 0.4, 0.6);
  assert_int_equal(count(s, 0), 0);
  assert_int_equal(count(s, 3), 0);
  sample_grown_free(s);
  s = sample_torus(8, 6, NULL, 0);
  assert_int_equal(count(s, 0), 0);
  for (int p = 0; p < s->n_patches; p++)
    for (int k = 0; k < 4; k++) s->patch[p].neighbour[k] = FS_NONE;
  assert_int_equal(count(s, 0), 0);
  sample_free(s);
}

/* The same surface moved by half its size crosses itself; the numbers do not depend on threads. */
static void test_two_tori(void **state) {
  fs_context one = {.n_threads = 1}, many = {.n_threads = 4};
  fs_crossings *c = NULL, *d = NULL;
  fs_edges *e = NULL;
  fs_surface *s = sample_empty();
  (void)state;
  for (int t = 0; t < 2; t++)
    for (int k = 0; k < 16; k++) {
      sample_add_torus(s, 2, 0.7, k % 4 * 1.5707963267948966, 1.5707963267948966, k / 4 * 1.5707963267948966,
                       1.5707963267948966);
      fs_patch *p = &s->patch[s->n_patches - 1];
      for (int i = 0; i < (p->degree_u + 1) * (p->degree_v + 1) && t == 1; i++)
        s->data[p->data_start + 3 * (size_t)i] += 3;
    }
  assert_int_equal(fs_edges_create(&one, s, 0, &e), FS_OK);
  assert_int_equal(fs_crossings_find(&one, s, e, 8, 100, &c), FS_OK);
  assert_int_equal(fs_crossings_find(&many, s, e, 8, 100, &d), FS_OK);
  assert_true(c->n > 4);
  assert_int_equal(c->n, d->n);
  for (int32_t i = 0; i < c->n; i++)
    for (int k = 0; k < 2; k++)
      assert_true(c->crossing[i].place[k].patch == d->crossing[i].place[k].patch &&
                  c->crossing[i].place[k].u == d->crossing[i].place[k].u &&
                  c->crossing[i].place[k].v == d->crossing[i].place[k].v);
  for (int32_t i = 0; i < c->n; i++) near(c->crossing[i].point.x, 1.5, 1.5);
  fs_crossings_free(&one, c);
  fs_crossings_free(&one, d);
  fs_edges_free(&one, e);
  sample_grown_free(s);
}

static void test_memory(void **state) {
  double bowl[16] = {[2] = 1, [8] = 1}, plane[16] = {0.25};
  fs_context none = test_context();
  fs_edges *e = NULL;
  fs_surface *s = sample_empty();
  (void)state;
  sample_add_graph(s, 3, 3, bowl, -1, 2, -1, 2);
  sample_add_graph(s, 3, 3, plane, -0.9, 1.8, -0.9, 1.8);
  assert_int_equal(fs_edges_create(&none, s, 0, &e), FS_OK);
  for (int64_t fail_at = 1;; fail_at++) {
    struct test_memory memory = {.fail_at = fail_at};
    fs_context ctx = test_memory_context(&memory);
    fs_crossings *c = NULL;
    fs_status status = fs_crossings_find(&ctx, s, e, 4, 3, &c);
    fs_crossings_free(&ctx, c);
    assert_int_equal(memory.n_live, 0);
    if (status == FS_OK) break;
    assert_int_equal(status, FS_ERR_MEMORY);
    assert_null(c);
  }
  fs_edges_free(&none, e);
  sample_grown_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_loop),
      cmocka_unit_test(test_plane_through_bowl),
      cmocka_unit_test(test_coarse_triangles),
      cmocka_unit_test(test_neighbours),
      cmocka_unit_test(test_two_tori),
      cmocka_unit_test(test_memory),
      cmocka_unit_test(test_triangle),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
