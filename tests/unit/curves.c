/* SPDX-License-Identifier: MIT */
/* Curves on surfaces against what they are by formula: on z = (x^2 + y^2) / 2 isophotes and lines of equal mean curvature are
   circles, lines of curvature circles and parabolas, sections parabolas; umbilics of cubic perturbations have known indices. */
#include <fairsurf/analyse_curves.h>
#include <fairsurf/construct.h>
#include "math/vec3.h"
#include "graph_samples.h"
#include "../support/support.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

static double radius(fs_vec3 p) { return hypot(p.x, p.y); }

/* ---- tests ------------------------------------------------------------------------------------------------------- */

/* n . z = 1 / sqrt(1 + r^2): a circle for every angle up to 45 degrees, in one closed curve; arcs in the corners beyond. */
static void test_isophotes(void **state) {
  fs_context ctx = test_context();
  fs_patch patch[4];
  double data[192], param[3] = {20, 0, 90};
  fs_surface surface;
  fs_curves *curves = NULL;
  int32_t n_closed = 0;
  (void)state;
  make_graph((graph){0}, patch, data, &surface);
  assert_int_equal(fs_surface_validate(&ctx, &surface), FS_OK);
  assert_int_equal(fs_plot_trace(&ctx, fs_plot_find("isophotes"), &surface, param, NULL, &curves), FS_OK);
  for (int32_t i = 0; i < curves->n_curves; i++) {
    const fs_surface_curve *c = &curves->curve[i];
    double r = tan(c->level * acos(-1.0) / 180);
    n_closed += c->is_closed;
    assert_true(c->is_closed == (r < 1));
    for (int32_t k = 0; k < c->n_points; k++) {
      const fs_curve_point *p = &curves->point[c->first + k];
      assert_true(fabs(radius(p->position) - r) < 1e-10);
      assert_true(fabs(p->position.z - 0.5 * r * r) < 1e-10);
      if (k > 0) { /* the chord stays within 1e-5 of the diagonal 3 */
        double chord = hypot(p->position.x - p[-1].position.x, p->position.y - p[-1].position.y);
        assert_true(r - sqrt(fmax(0, r * r - chord * chord / 4)) < 1e-4);
      }
    }
  }
  assert_int_equal(n_closed, 5); /* 4.5, 13.5 .. 40.5 degrees */
  fs_curves_free(&ctx, curves);
}

/* H = (2 + r^2) / (2 (1 + r^2)^1.5) on circles. */
static void test_mean_curvature(void **state) {
  fs_context ctx = test_context();
  fs_patch patch[4];
  double data[192], param[2] = {10, 0.1};
  fs_surface surface;
  fs_curves *curves = NULL;
  (void)state;
  make_graph((graph){0}, patch, data, &surface);
  assert_int_equal(fs_plot_trace(&ctx, fs_plot_find("mean-curvature"), &surface, param, NULL, &curves), FS_OK);
  assert_true(curves->n_curves >= 4);
  for (int32_t i = 0; i < curves->n_curves; i++)
    for (int32_t k = 0; k < curves->curve[i].n_points; k++) {
      double r = radius(curves->point[curves->curve[i].first + k].position);
      assert_true(fabs((2 + r * r) / (2 * pow(1 + r * r, 1.5)) - curves->curve[i].level) < 1e-10);
    }
  fs_curves_free(&ctx, curves);
}

/* Every line is a circle around the axis or lies in a plane through it. */
static void test_curvature_lines(void **state) {
  fs_context ctx = test_context();
  fs_patch patch[4];
  double data[192];
  fs_surface surface;
  fs_curves *curves = NULL;
  int32_t n_circles = 0, n_meridians = 0;
  (void)state;
  make_graph((graph){0}, patch, data, &surface);
  for (int which = 1; which <= 2; which++) {
    assert_int_equal(fs_trace_curvature_lines(&ctx, &surface, which, 0.2, NULL, &curves), FS_OK);
    for (int32_t i = 0; i < curves->n_curves; i++) {
      const fs_curve_point *p = &curves->point[curves->curve[i].first];
      for (int32_t k = 0; k < curves->curve[i].n_points; k++) {
        if (which == 1) /* the larger curvature, 1 / sqrt(1 + r^2), goes around */
          assert_true(fabs(radius(p[k].position) - radius(p[0].position)) < 2e-4);
        else
          assert_true(fabs(p[k].position.x * p[0].position.y - p[k].position.y * p[0].position.x) < 2e-4);
      }
      n_circles += which == 1, n_meridians += which == 2;
    }
    fs_curves_free(&ctx, curves);
    curves = NULL;
  }
  assert_true(n_circles >= 5 && n_meridians >= 10);
}

/* The section y = const is the parabola z = x^2 / 2 + const: curvature (1 + x^2)^-1.5, teeth downwards, longest at x = 0. */
static void test_sections(void **state) {
  fs_context ctx = test_context();
  fs_patch patch[4];
  double data[192], param[4] = {5, 90, 0, 0.1}, longest = 0;
  fs_surface surface;
  fs_curves *curves = NULL;
  (void)state;
  make_graph((graph){0}, patch, data, &surface);
  assert_int_equal(fs_plot_trace(&ctx, fs_plot_find("sections"), &surface, param, NULL, &curves), FS_OK);
  assert_int_equal(curves->n_curves, 5);
  for (int32_t i = 0; i < curves->n_points; i++)
    longest = fmax(longest, hypot(curves->point[i].tooth.x, curves->point[i].tooth.z));
  for (int32_t i = 0; i < curves->n_points; i++) {
    const fs_curve_point *p = &curves->point[i];
    double k = pow(1 + p->position.x * p->position.x, -1.5);
    assert_true(fabs(p->tooth.y) < 1e-12);
    assert_true(p->tooth.z < 0);
    assert_true(fabs(hypot(p->tooth.x, p->tooth.z) - k * longest) < 1e-3 * longest);
    assert_true(fabs(p->tooth.x + p->position.x * p->tooth.z) < 1e-9); /* along the normal of the parabola */
  }
  fs_curves_free(&ctx, curves);
}

/* x^3 - 3 x y^2 makes a star, x^3 + x y^2 a lemon of the apex. */
static void test_umbilics(void **state) {
  static const graph cubic[2] = {{0.1, -0.3}, {0.1, 0.1}};
  fs_context ctx = test_context();
  fs_patch patch[4];
  double data[192];
  fs_surface surface;
  (void)state;
  for (int k = 0; k < 2; k++) {
    fs_curves *curves = NULL;
    int32_t n_apex = 0;
    make_graph(cubic[k], patch, data, &surface);
    assert_int_equal(fs_trace_umbilics(&ctx, &surface, NULL, &curves), FS_OK);
    for (int32_t i = 0; i < curves->n_marks; i++) {
      if (radius(curves->mark[i].point.position) > 1e-8) continue;
      n_apex++;
      assert_int_equal(curves->mark[i].index, k == 0 ? -1 : 1);
    }
    assert_int_equal(n_apex, 1);
    fs_curves_free(&ctx, curves);
  }
}

/* The halves x < 0 of z = (x^2 + y^2) / 2 and x > 0 of z = x^2 + y^2 / 2: the normals agree on x = 0, the curvatures across
   it are 1 and 2. */
static void make_join(fs_patch patch[4], double *data, fs_surface *surface) {
  make_graph((graph){0}, patch, data, surface);
  for (int k = 0; k < 64; k++)
    if (k / 16 % 2 == 1) data[3 * k + 2] += 0.5 * blossom(2, 0, 1, k % 4);
}

static void test_section_shows_jump(void **state) {
  fs_context ctx = test_context();
  fs_patch patch[4];
  double data[192], param[4] = {1, 90, 0, 0.1};
  fs_surface surface;
  fs_curves *curves = NULL;
  double before = 0, after = 0;
  (void)state;
  make_join(patch, data, &surface);
  assert_int_equal(fs_plot_trace(&ctx, fs_plot_find("sections"), &surface, param, NULL, &curves), FS_OK);
  assert_int_equal(curves->n_curves, 1);
  for (int32_t i = 0; i < curves->n_points; i++) {
    const fs_curve_point *p = &curves->point[i];
    double tooth = hypot(p->tooth.x, p->tooth.z), x = p->position.x;
    if (x > -0.05 && x < -1e-9) before = fmax(before, tooth);
    if (x < 0.05 && x > 1e-9) after = fmax(after, tooth);
  }
  assert_true(fabs(after / before - 2) < 0.02);
  fs_curves_free(&ctx, curves);
}

/* How often curves cross a side that two patches share, and how often they turn there by more than a degree between the
   chords before and after it. */
static void count_kinks(const fs_curves *curves, int32_t *n_sides, int32_t *n_kinks) {
  *n_sides = *n_kinks = 0;
  for (int32_t i = 0; i < curves->n_curves; i++) {
    const fs_surface_curve *c = &curves->curve[i];
    for (int32_t k = 1; k + 1 < c->n_points; k++) {
      const fs_curve_point *p = &curves->point[c->first + k];
      fs_vec3 a = fs_vec3_sub(p->position, p[-1].position), b = fs_vec3_sub(p[1].position, p->position);
      if (p->place.patch == p[1].place.patch) continue;
      ++*n_sides;
      *n_kinks += atan2(fs_vec3_length(fs_vec3_cross(a, b)), fs_vec3_dot(a, b)) > acos(-1.0) / 180;
    }
  }
}

/* n ~ (-k x, -y, 1), k the curvature across x = 0. On that line the derivative of n . l by x is -k l_x / sqrt(1 + y^2), that
   by y is the same on both sides: the slopes dy/dx of an isophote there have the ratio of the curvatures. */
static void test_isophotes_show_join(void **state) {
  fs_context ctx = test_context();
  fs_patch patch[4];
  double data[192], param[3] = {24, 30, 30};
  fs_surface surface;
  fs_curves *curves = NULL;
  int32_t n = 0;
  (void)state;
  make_join(patch, data, &surface);
  assert_int_equal(
      fs_plot_trace(&ctx, fs_plot_find("isophotes"), &surface, param, &(fs_trace_options){.tolerance = 1e-8}, &curves),
      FS_OK);
  for (int32_t i = 0; i < curves->n_points; i++) {
    const fs_curve_point *p = &curves->point[i];
    if (i == 0 || i + 1 == curves->n_points || fabs(p->position.x) > 1e-12) continue;
    if (!(p[-1].position.x * p[1].position.x < 0) || p->place.patch == p[1].place.patch) continue;
    double before = (p->position.y - p[-1].position.y) / (p->position.x - p[-1].position.x);
    double after = (p[1].position.y - p->position.y) / (p[1].position.x - p->position.x);
    double ratio = p[-1].position.x < 0 ? after / before : before / after;
    assert_true(fabs(ratio - 2) < 5e-3);
    n++;
  }
  assert_true(n >= 4);
  fs_curves_free(&ctx, curves);
}

/* The Gregory patches over a mesh are G1, our surface over it is G2: only the isophotes of the first have kinks. */
static void test_isophotes_of_caps(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(5, 3);
  fs_space *space = NULL;
  fs_surface *surface[2] = {NULL, NULL};
  double param[3] = {60, 30, 60};
  int32_t n_sides[2], n_kinks[2];
  (void)state;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, space, space->start, &surface[0]), FS_OK);
  assert_int_equal(
      fs_construct(&ctx, fs_construction_find("gregory"), &(fs_construction_input){.mesh = mesh}, NULL, &surface[1]),
      FS_OK);
  for (int k = 0; k < 2; k++) {
    fs_curves *curves = NULL;
    assert_int_equal(fs_plot_trace(&ctx, fs_plot_find("isophotes"), surface[k], param,
                                   &(fs_trace_options){.tolerance = 2e-6, .n_cells = 3}, &curves),
                     FS_OK);
    count_kinks(curves, &n_sides[k], &n_kinks[k]);
    assert_true(n_sides[k] > 10);
    fs_curves_free(&ctx, curves);
    fs_surface_free(&ctx, surface[k]);
  }
  print_message("isophotes with kinks: %d of %d on the G2 surface, %d of %d on the G1 surface\n", n_kinks[0],
                n_sides[0], n_kinks[1], n_sides[1]);
  assert_int_equal(n_kinks[0], 0);
  assert_true(n_kinks[1] > n_sides[1] / 2);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

static void test_every_allocation_may_fail(void **state) {
  fs_patch patch[4];
  double data[192];
  fs_surface surface;
  (void)state;
  make_graph((graph){0.1, -0.3}, patch, data, &surface);
  for (int32_t i = 0; fs_plots[i] != NULL; i++) {
    const fs_param *list = fs_plots[i]->params;
    double param[16]; /* as few lines as show everything */
    for (int32_t k = 0; list[k].name != NULL; k++)
      param[k] = strcmp(list[k].name, "count") == 0 ? 3 : strcmp(list[k].name, "spacing") == 0 ? 0.2 : list[k].initial;
    for (int64_t n = 1;; n++) {
      struct test_memory memory = {.fail_at = n};
      fs_context ctx = test_memory_context(&memory);
      fs_curves *curves = NULL;
      fs_status status = fs_plot_trace(&ctx, fs_plots[i], &surface, param,
                                       &(fs_trace_options){.tolerance = 0.1, .n_cells = 2}, &curves);
      if (status == FS_OK) fs_curves_free(&ctx, curves);
      assert_int_equal(memory.n_live, 0);
      if (status == FS_OK) break;
      assert_int_equal(status, FS_ERR_MEMORY);
      assert_null(curves);
    }
  }
}

static void test_refusals(void **state) {
  fs_context ctx = test_context();
  fs_patch patch[4];
  double data[192], param[3] = {0, 0, 90};
  fs_surface surface;
  fs_curves *curves = NULL;
  (void)state;
  make_graph((graph){0}, patch, data, &surface);
  assert_int_equal(fs_plot_trace(&ctx, fs_plot_find("isophotes"), &surface, param, NULL, &curves), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "count"));
  assert_null(curves);
  assert_null(fs_plot_find("nothing"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_isophotes),
      cmocka_unit_test(test_mean_curvature),
      cmocka_unit_test(test_curvature_lines),
      cmocka_unit_test(test_sections),
      cmocka_unit_test(test_umbilics),
      cmocka_unit_test(test_section_shows_jump),
      cmocka_unit_test(test_isophotes_show_join),
      cmocka_unit_test(test_isophotes_of_caps),
      cmocka_unit_test(test_every_allocation_may_fail),
      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
