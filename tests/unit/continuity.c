/* SPDX-License-Identifier: MIT */
/* Edges and their jumps: joins whose gap, angle, curvature and gradient are known; maxima that grids miss; edges that only
   geometry finds. */
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

static fs_continuity *measure(const fs_surface *s, double curvature_scale, fs_edges **edges) {
  fs_context ctx = test_context();
  fs_continuity *c = NULL;
  assert_int_equal(fs_edges_create(&ctx, s, 0, edges), FS_OK);
  assert_int_equal(
      fs_continuity_measure(&ctx, s, *edges, &(fs_continuity_options){.curvature_scale = curvature_scale}, &c), FS_OK);
  return c;
}

static void release(fs_surface *s, fs_edges *e, fs_continuity *c) {
  fs_context ctx = test_context();
  fs_continuity_free(&ctx, c);
  fs_edges_free(&ctx, e);
  sample_grown_free(s);
}

/* z = left x^2 + b (y - y0)^2 left of x = 0 and slope x + right x^2 + cubic x^3 + b (y - y0)^2 right of it, over
   y in [0, 1], as bicubics. */
enum { Y0_PERCENT = 37 };
static fs_surface *join(double left, double right, double slope, double cubic, double b, double gap) {
  const double y0 = Y0_PERCENT / 100.;
  double p[16] = {[0] = b * y0 * y0, [2] = left, [4] = -2 * b * y0, [8] = b};
  double q[16] = {[0] = b * y0 * y0 + gap, [1] = slope, [2] = right, [3] = cubic, [4] = -2 * b * y0, [8] = b};
  fs_surface *s = sample_empty();
  sample_add_graph(s, 3, 3, p, -1, 1, 0, 1);
  sample_add_graph(s, 3, 3, q, 0, 1, 0, 1);
  return s;
}

static void name_neighbours(fs_surface *s) {
  s->patch[0].neighbour[1] = 1, s->patch[0].neighbour_side[1] = 3;
  s->patch[1].neighbour[3] = 0, s->patch[1].neighbour_side[3] = 1;
}

/* At x = 0 the cross direction is (1, 0, 0) and h_xx = z_xx / sqrt(1 + z_y^2): the jump is largest where z_y = 0, at y0. */
static void test_curvature_jump(void **state) {
  (void)state;
  for (int is_named = 0; is_named < 2; is_named++) {
    fs_edges *e;
    fs_surface *s = join(0.7, -0.2, 0, 0, 0.5, 0);
    if (is_named) name_neighbours(s);
    fs_continuity *c = measure(s, 2, &e);
    assert_int_equal(e->n_edges, 1);
    assert_int_equal(e->n_found, !is_named);
    assert_int_equal(e->n_borders, 6);
    assert_int_equal(e->n_vertices, 6);
    near(c->max[FS_JUMP_POSITION], 0, 1e-15);
    near(c->max[FS_JUMP_NORMAL], 0, 1e-14);
    near(c->max[FS_JUMP_CURVATURE], 2 * 0.9 / 2, 1e-9);
    near(c->worst[FS_JUMP_CURVATURE][0].t, Y0_PERCENT / 100., 1e-4);
    near(c->worst[FS_JUMP_CURVATURE][0].point.y, Y0_PERCENT / 100., 1e-4);
    assert_int_equal(c->worst[FS_JUMP_CURVATURE][0].edge, 0);
    assert_true(fs_continuity_passes(c, 1, 1e-9));
    assert_false(fs_continuity_passes(c, 2, 0.8999));
    assert_true(fs_continuity_passes(c, 2, 0.9001));
    release(s, e, c);
  }
}

/* The normals (0, -z_y, 1) and (-slope, -z_y, 1) enclose atan(slope) where z_y = 0, and less elsewhere. */
static void test_angle(void **state) {
  fs_edges *e;
  (void)state;
  for (double slope = 1e-6; slope < 2; slope *= 17) {
    fs_surface *s = join(0.3, 0.3, slope, 0, 0.4, 0);
    fs_continuity *c = measure(s, 0, &e);
    near(c->max[FS_JUMP_NORMAL], atan(slope), 1e-12);
    near(c->worst[FS_JUMP_NORMAL][0].t, Y0_PERCENT / 100., 1e-3);
    assert_false(fs_continuity_passes(c, 1, 0.5 * slope));
    assert_true(fs_continuity_passes(c, 0, 1e-12));
    release(s, e, c);
  }
}

/* z = a x^2 + e x^3 has H_x = 3 e at x = 0. */
static void test_gradient_jump(void **state) {
  fs_edges *e;
  fs_surface *s = join(0.5, 0.5, 0, 0.25, 0, 0);
  fs_continuity *c = measure(s, 1, &e);
  (void)state;
  near(c->max[FS_JUMP_GRADIENT], 0.75, 1e-12);
  near(c->max[FS_JUMP_CURVATURE], 0, 1e-13);
  assert_true(fs_continuity_passes(c, 2, 1e-12));
  assert_false(fs_continuity_passes(c, 3, 0.7));
  release(s, e, c);
}

/* A gap is measured between closest points, with its part of the diameter sqrt(2^2 + 1 + …). */
static void test_gap(void **state) {
  fs_edges *e;
  fs_surface *s = join(0, 0, 0, 0, 0, 1e-5);
  fs_continuity *c = measure(s, 0, &e);
  (void)state;
  assert_int_equal(e->n_found, 1);
  near(c->max[FS_JUMP_POSITION], 1e-5, 1e-14);
  near(c->diameter, sqrt(5), 1e-9);
  assert_true(fs_continuity_passes(c, 0, 1.0001e-5 / sqrt(5)));
  assert_false(fs_continuity_passes(c, 0, 0.9999e-5 / sqrt(5)));
  assert_int_equal(c->histogram[FS_JUMP_POSITION][13], 1); /* 1e-5 rounds to one decade or the other */
  release(s, e, c);
  s = join(0, 0, 0, 0, 0, 0.1); /* too far to be one edge */
  c = measure(s, 0, &e);
  assert_int_equal(e->n_edges, 0);
  assert_int_equal(e->n_borders, 8);
  assert_true(isnan(c->max[FS_JUMP_POSITION]));
  assert_true(fs_continuity_passes(c, 3, 0));
  release(s, e, c);
}

/* Random degrees up to 31 along the edge: the largest of 2001 points is at most what is found, and hardly less. */
static void test_maximum_is_found(void **state) {
  enum { DEGREE = 31, GRID = 2000 };
  uint64_t random = 11;
  double worst_of_grid = 1;
  (void)state;
  for (int round = 0; round < 13; round++) {
    double p[3 * (DEGREE + 1)] = {0}, q[3 * (DEGREE + 1)] = {0}, largest = 0, on_grid = 0;
    fs_surface *s = sample_empty();
    fs_edges *e;
    sample_add_graph(s, 2, DEGREE, p, -1, 1, 0, 1);
    sample_add_graph(s, 2, DEGREE, q, 0, 1, 0, 1);
    /* z = x^2 sum c_j B_j(y): in the third column of Bezier points only */
    for (int j = 0; j <= DEGREE; j++)
      s->data[s->patch[1].data_start + 3 * (size_t)(2 + 3 * j) + 2] =
          round == 12      ? (j == 8) + 1.13 * (j == 25) /* the lower hill is on the grid, the higher one between */
          : round % 2 == 0 ? (j == 9 + round)
                           : test_random_real(&random, -1, 1);
    fs_continuity *c = measure(s, 1, &e);
    for (int k = 0; k <= GRID; k++) {
      fs_edge_point point;
      double jump[FS_N_JUMPS], curvature;
      fs_edge_evaluate(s, &e->edge[0], (double)k / GRID, &point);
      fs_jumps_between(point.jet[0], point.jet[1], false, jump, &curvature);
      largest = fmax(largest, jump[FS_JUMP_CURVATURE]);
      if (k % (GRID / 8) == 0) on_grid = fmax(on_grid, jump[FS_JUMP_CURVATURE]);
    }
    assert_true(c->max[FS_JUMP_CURVATURE] >= largest - 1e-12);
    near(c->max[FS_JUMP_CURVATURE], largest, 1e-4 * largest);
    worst_of_grid = fmin(worst_of_grid, on_grid / largest);
    release(s, e, c);
  }
  assert_true(worst_of_grid < 0.9); /* the start alone would not do */
}

/* Whatever way the patches lie, the same edge with the same jumps; only its sides turn. */
static void test_flipped(void **state) {
  (void)state;
  for (int flip = 0; flip < 4; flip++) {
    fs_edges *e;
    fs_surface *s = join(0.7, -0.2, 0.1, 0.3, 0.5, 0);
    for (int p = 0; p < 2; p++)
      if (flip >> p & 1) sample_flip(s, p);
    fs_continuity *c = measure(s, 1, &e);
    assert_int_equal(e->n_edges, 1);
    assert_int_equal(e->edge[0].is_flipped, flip == 1 || flip == 2);
    near(c->max[FS_JUMP_NORMAL], atan(0.1), 1e-12);
    release(s, e, c);
    s = join(0.7, -0.2, 0, 0, 0.5, 0);
    if (flip & 1) sample_flip(s, 0);
    c = measure(s, 1, &e);
    near(c->max[FS_JUMP_CURVATURE], 1.8, 1e-9);
    near(c->max[FS_JUMP_NORMAL], 0, 1e-13);
    release(s, e, c);
  }
}

/* One square beside two of half and one of a third of its side: each stretch is an edge, each T a vertex. */
static void test_t_junctions(void **state) {
  static const double flat[4] = {0};
  fs_edges *e;
  fs_surface *s = sample_empty();
  (void)state;
  sample_add_graph(s, 1, 1, flat, -1, 1, 0, 1);
  sample_add_graph(s, 1, 1, flat, 0, 0.5, 0, 0.5);
  sample_add_graph(s, 1, 1, flat, 0, 0.5, 0.5, 0.5);
  sample_add_graph(s, 1, 1, flat, -1, 1. / 3, -0.5, 0.5); /* below the left third: half of the side is border */
  fs_continuity *c = measure(s, 0, &e);
  assert_int_equal(e->n_edges, 4);
  assert_int_equal(e->n_found, 4);
  assert_int_equal(e->n_borders, 2 + 2 + 2 + 3 + 1);
  assert_int_equal(e->n_vertices, 4 + 3 + 1 + 1 + 2);
  near(c->max[FS_JUMP_POSITION], 0, 1e-15);
  for (int32_t v = 0; v < e->n_vertices; v++) {
    fs_vec3 x[FS_JET_SIZE], first = {0, 0, 0};
    for (int32_t k = e->place_start[v]; k < e->place_start[v + 1]; k++) {
      fs_surface_evaluate(s, e->place[k].patch, e->place[k].u, e->place[k].v, x);
      if (k == e->place_start[v]) first = x[FS_D];
      near(fs_vec3_distance(first, x[FS_D]), 0, 1e-12);
    }
  }
  release(s, e, c);
}

/* The same curve with other parameters: an edge of no gap, and jumps of the surfaces, not of the parameters. */
static void test_other_parameters(void **state) {
  fs_edges *e;
  fs_surface *s = join(0.7, -0.2, 0, 0, 0, 0);
  double moved[16];
  const double *b = s->data + s->patch[1].data_start;
  (void)state;
  /* y = v becomes the cubic with Bezier ordinates 0, 0.1, 0.5, 1; z does not depend on y */
  for (int j = 0; j < 4; j++)
    for (int i = 0; i < 4; i++) moved[i + 4 * j] = j == 1 ? 0.1 : j == 2 ? 0.5 : b[3 * (i + 4 * j) + 1];
  for (int k = 0; k < 16; k++) s->data[s->patch[1].data_start + 3 * (size_t)k + 1] = moved[k];
  fs_continuity *c = measure(s, 1, &e);
  assert_int_equal(e->n_edges, 1);
  near(c->max[FS_JUMP_POSITION], 0, 1e-12);
  near(c->max[FS_JUMP_NORMAL], 0, 1e-13);
  near(c->max[FS_JUMP_CURVATURE], 1.8, 1e-9);
  release(s, e, c);
}

/* A full turn of a tube in one patch meets itself; its ends are circles that begin anywhere. */
static void test_seams(void **state) {
  const double pi = 3.14159265358979323846;
  fs_edges *e;
  fs_surface *s = sample_empty();
  (void)state;
  sample_add_cylinder(s, 1, 0, pi, 0, 1);
  sample_add_cylinder(s, 1, pi, pi, 0, 1);
  sample_add_cylinder(s, 1, 0.4, pi, 1, 1);
  sample_add_cylinder(s, 1, 0.4 + pi, pi, 1, 1);
  fs_continuity *c = measure(s, 0, &e);
  assert_int_equal(e->n_edges, 2 + 2 + 4);
  assert_int_equal(e->n_borders, 4);
  near(c->curvature_scale, 1, 1e-9);
  for (int k = 0; k < FS_N_JUMPS; k++) near(c->max[k], 0, k < 2 ? 1e-10 : 1e-7);
  release(s, e, c);
}

/* All jumps of a surface that names its neighbours, and after it has forgotten them. */
static void test_geometry_finds_all(void **state) {
  fs_edges *e, *f;
  fs_surface *s = sample_torus(7, 5, NULL, 0);
  fs_continuity *c = measure(s, 0, &e), *d;
  fs_context ctx = test_context();
  (void)state;
  for (int p = 0; p < s->n_patches; p++)
    for (int k = 0; k < 4; k++) s->patch[p].neighbour[k] = FS_NONE;
  d = measure(s, 0, &f);
  assert_int_equal(e->n_edges, 70);
  assert_int_equal(f->n_edges, 70);
  assert_int_equal(f->n_found, 70);
  assert_int_equal(f->n_borders, 0);
  assert_int_equal(e->n_vertices, 35);
  assert_int_equal(f->n_vertices, 35);
  for (int k = 0; k < FS_N_JUMPS; k++) near(c->max[k], d->max[k], 1e-9 * (1 + c->max[k]));
  assert_true(fs_continuity_passes(c, 2, 1e-12));
  assert_false(fs_continuity_passes(c, 3, 1e-3));
  fs_continuity_free(&ctx, d);
  fs_edges_free(&ctx, f);
  release(s, e, c);
}

/* The curvatures that jump where two tori of different tubes share their outermost circle. */
static void test_tori(void **state) {
  fs_edges *e;
  fs_surface *s = sample_empty();
  (void)state;
  sample_add_torus(s, 2, 1, 0, 1, 0, 1);      /* tube of radius 1 above */
  sample_add_torus(s, 2.5, 0.5, 0, 1, -1, 1); /* of 0.5 below; both reach x^2 + y^2 = 9 at z = 0 */
  fs_continuity *c = measure(s, 2, &e);
  assert_int_equal(e->n_edges, 1);
  near(c->max[FS_JUMP_NORMAL], 0, 1e-11);
  near(c->max[FS_JUMP_CURVATURE], (1 / 0.5 - 1 / 1.) / 2, 1e-9);
  release(s, e, c);
}

/* A square cut along x + y = 1: z = (x - 0.4)^2 below, and a (x + y - 1)^2 more above. The second derivatives differ by
   2 a m m^T, m = (1, 1), so that the tensors differ by 2 a / w m^T G^-1 m, w^2 = 1 + z_x^2 and G = I + grad z grad z^T:
   4 a where z_x = 0, and less elsewhere. Bezier ordinates are blossoms: of x^2 at (p, q) x_p x_q. */
static void test_triangles(void **state) {
  static const double corner[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {0, 1}, {1, 0}}};
  const double a = 0.3;
  fs_edges *e;
  fs_surface *s = sample_empty();
  (void)state;
  for (int k = 0; k < 2; k++) {
    double points[18], *to = points;
    for (int row = 0; row < 3; row++)
      for (int i = 0; i < 3 - row; i++) {
        const double *p = corner[k][row == 2 || (row == 1 && i == 0) ? (row == 2 ? 2 : 0) : i == 0 ? 0 : 1];
        const double *q = corner[k][row > 0 ? 2 : i == 2 ? 1 : 0];
        double s_p = p[0] + p[1] - 1, s_q = q[0] + q[1] - 1;
        *to++ = 0.5 * (p[0] + q[0]);
        *to++ = 0.5 * (p[1] + q[1]);
        *to++ = (p[0] - 0.4) * (q[0] - 0.4) + (k == 1 ? a * s_p * s_q : 0);
      }
    sample_add_triangle(s, points);
  }
  fs_continuity *c = measure(s, 1, &e);
  assert_int_equal(e->n_edges, 1);
  assert_int_equal(e->n_borders, 4);
  assert_int_equal(e->n_vertices, 4);
  near(c->max[FS_JUMP_POSITION], 0, 1e-15);
  near(c->max[FS_JUMP_NORMAL], 0, 1e-14);
  near(c->max[FS_JUMP_CURVATURE], 4 * a, 1e-9);
  near(c->worst[FS_JUMP_CURVATURE][0].point.x, 0.4, 1e-4);
  release(s, e, c);
}

static void test_irregular_and_infinite(void **state) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_surface *s = join(0, 0, 0, 0, 0, 0);
  fs_edges *e = NULL;
  fs_continuity *c = NULL;
  (void)state;
  /* the second patch is a triangle with a point at a corner of the edge: p_v = 0 there */
  for (int i = 0; i < 4; i++) s->data[s->patch[1].data_start + 3 * (size_t)i] = 0;
  c = measure(s, 0, &e);
  assert_true(c->n_irregular >= 1);
  assert_true(fs_continuity_passes(c, 0, 1e-9));
  assert_false(fs_continuity_passes(c, 1, 1));
  fs_continuity_free(&(fs_context){0}, c);
  fs_edges_free(&(fs_context){0}, e);
  e = NULL;
  s->data[s->patch[1].data_start] = NAN;
  assert_int_equal(fs_edges_create(&ctx, s, 0, &e), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "patch 1"));
  assert_null(e);
  assert_int_equal(memory.n_live, 0);
  sample_grown_free(s);
}

static void test_memory(void **state) {
  fs_surface *s = join(0.7, -0.2, 0, 0.1, 0.5, 0);
  (void)state;
  for (int64_t fail_at = 1;; fail_at++) {
    struct test_memory memory = {.fail_at = fail_at};
    fs_context ctx = test_memory_context(&memory);
    fs_edges *e = NULL;
    fs_continuity *c = NULL;
    fs_status status = fs_edges_create(&ctx, s, 0, &e);
    if (status == FS_OK) status = fs_continuity_measure(&ctx, s, e, NULL, &c);
    if (status != FS_OK) {
      assert_int_equal(status, FS_ERR_MEMORY);
      assert_null(c);
    }
    fs_continuity_free(&ctx, c);
    fs_edges_free(&ctx, e);
    assert_int_equal(memory.n_live, 0);
    if (status == FS_OK) break;
  }
  sample_grown_free(s);
}

/* The same bits for any number of threads. */
static void test_threads(void **state) {
  fs_surface *s = sample_torus(9, 8, NULL, 0);
  fs_edges *e = NULL;
  fs_continuity *c = NULL, *d = NULL;
  fs_context one = {.n_threads = 1}, many = {.n_threads = 5};
  (void)state;
  assert_int_equal(fs_edges_create(&one, s, 0, &e), FS_OK);
  assert_int_equal(fs_continuity_measure(&one, s, e, NULL, &c), FS_OK);
  assert_int_equal(fs_continuity_measure(&many, s, e, NULL, &d), FS_OK);
  assert_memory_equal(c->edge, d->edge, (size_t)e->n_edges * sizeof *c->edge);
  assert_memory_equal(c->vertex, d->vertex, (size_t)e->n_vertices * sizeof *c->vertex);
  fs_continuity_free(&one, d);
  release(s, e, c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_curvature_jump),
      cmocka_unit_test(test_angle),
      cmocka_unit_test(test_gradient_jump),
      cmocka_unit_test(test_gap),
      cmocka_unit_test(test_maximum_is_found),
      cmocka_unit_test(test_flipped),
      cmocka_unit_test(test_t_junctions),
      cmocka_unit_test(test_other_parameters),
      cmocka_unit_test(test_seams),
      cmocka_unit_test(test_geometry_finds_all),
      cmocka_unit_test(test_tori),
      cmocka_unit_test(test_triangles),
      cmocka_unit_test(test_irregular_and_infinite),
      cmocka_unit_test(test_memory),
      cmocka_unit_test(test_threads),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
