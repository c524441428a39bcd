/* SPDX-License-Identifier: MIT */
/* Filled gaps between B-spline patches: numbers of an independent program (FAIRSURF_SHARED/math/patches-vectors.json), its
   tables of errors, tolerances, smoothness across knots, invariance, and what is refused. */
#include <fairsurf/analyse.h>
#include <fairsurf/construct_gap.h>
#include "math/diffgeo.h"
#include "math/vec3.h"
#include "vectors.h"
#include <stdio.h>
#include <string.h>

static cJSON *vectors;

/* The file has nets [i][j]. */
static fs_spline *read_patch(const cJSON *from, const char *name) {
  fs_context ctx = test_context();
  double U[32], V[32], net[600], c[600];
  int n = vectors_flatten(vectors_item(from, "U"), U) - 4, m = vectors_flatten(vectors_item(from, "V"), V) - 4;
  fs_spline like = {.n_parameters = 2, .width = 3, .degree = {3, 3}, .n = {n, m}}, *made;
  vectors_numbers(from, "C", 3 * n * m, net);
  for (int i = 0; i < n; i++)
    for (int j = 0; j < m; j++) memcpy(c + 3 * (i + n * j), net + 3 * (i * m + j), 3 * sizeof *c);
  snprintf(like.name, sizeof like.name, "%s", name);
  like.knot[0] = U, like.knot[1] = V, like.c = c;
  if (fs_spline_create(&ctx, &like, &made) != FS_OK) fail_msg("%s", ctx.message);
  return made;
}

static fs_spline *q, *r;

static int setup(void **state) {
  const cJSON *gap = vectors_item(vectors, "gap");
  (void)state;
  q = read_patch(vectors_item(gap, "q"), "q");
  r = read_patch(vectors_item(gap, "r"), "r");
  return 0;
}

static int teardown(void **state) {
  fs_context ctx = test_context();
  (void)state;
  fs_spline_free(&ctx, q);
  fs_spline_free(&ctx, r);
  return 0;
}

static fs_spline *fill(fs_gap_options options, fs_gap_report *report) {
  fs_context ctx = test_context();
  fs_spline *s = NULL;
  if (fs_gap_fill(&ctx, q, r, &options, &s, report) != FS_OK) fail_msg("%s", ctx.message);
  return s;
}

static void release(fs_spline *s) {
  fs_context ctx = test_context();
  fs_spline_free(&ctx, s);
}

static void jet(const fs_spline *s, double u, double v, fs_vec3 *x) {
  static const int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
  for (int k = 0; k < 6; k++) fs_spline_evaluate(s, u, v, order[k][0], order[k][1], &x[k].x);
}

/* ---- numbers of another program ---- */

static void compare_jet(const cJSON *from, const fs_spline *s) {
  double at[2];
  fs_vec3 x[6];
  vectors_numbers(from, "s_at", 2, at);
  jet(s, at[0], at[1], x);
  vectors_compare_jet(vectors_item(from, "ders"), x);
}

static void compare_way2(const char *name, int32_t order) {
  const cJSON *from = vectors_item(vectors_item(vectors, "gap"), name);
  fs_gap_report report;
  fs_spline *s = fill((fs_gap_options){.order = order, .n_parts = 1}, &report);
  int n = s->n[0], m = s->n[1];
  double *net = calloc((size_t)(3 * n * m), sizeof *net);
  vectors_compare(from, "U", 2 * n, s->knot[0], 1e-15);
  vectors_compare(from, "V", m + 4, s->knot[1], 1e-15);
  for (int i = 0; i < n; i++)
    for (int j = 0; j < m; j++) memcpy(net + 3 * (i * m + j), s->c + 3 * (i + n * j), 3 * sizeof *net);
  vectors_compare(from, "C", 3 * n * m, net, 1e-12);
  compare_jet(from, s);
  free(net);
  release(s);
}

static void compare_way1(const char *name, int32_t order, int32_t degree) {
  const cJSON *from = vectors_item(vectors_item(vectors, "gap"), name), *piece = vectors_item(from, "first_piece");
  fs_gap_report report;
  fs_spline *s =
      fill((fs_gap_options){.order = order, .is_exact = true, .scalar_degree = degree, .n_parts = 1}, &report);
  int n = s->n[0], p = s->degree[1];
  double net[3 * 60], ends[2] = {s->knot[1][0], s->knot[1][p + 1]};
  assert_int_equal(p, 3 + order * degree);
  vectors_compare(piece, "v", 2, ends, 1e-15);
  for (int i = 0; i < n; i++)
    for (int j = 0; j <= p; j++) memcpy(net + 3 * (i * (p + 1) + j), s->c + 3 * (i + n * j), 3 * sizeof *net);
  vectors_compare(piece, "net", 3 * n * (p + 1), net, 1e-12);
  compare_jet(from, s);
  release(s);
}

static void test_vectors(void **state) {
  fs_spline *s;
  fs_gap_report report;
  fs_vec3 x[6], y[6], z[6], d;
  double both[2];
  (void)state;
  compare_way2("way2_G1_k1", 1);
  compare_way2("way2_G2_k1", 2);
  compare_way1("way1_G1_deg2_k1", 1, 2);
  compare_way1("way1_G1_deg3_k1", 1, 3);
  compare_way1("way1_G2_deg2_k1", 2, 2);
  compare_way1("way1_G2_deg3_k1", 2, 3);
  /* c1 and g1 at 0.37 from a filling so fine that s_u is theirs to nine digits */
  s = fill((fs_gap_options){.n_parts = 64}, &report);
  jet(q, q->knot[0][q->n[0]], 0.37, x);
  jet(r, r->knot[0][0], 0.37, y);
  d = fs_vec3_sub(x[0], y[0]);
  both[0] = fs_vec3_length(d) / fs_vec3_length(x[1]), both[1] = fs_vec3_length(d) / fs_vec3_length(y[1]);
  vectors_compare(vectors_item(vectors, "gap"), "c1_g1_at_0.37", 2, both, 1e-12);
  jet(s, 0, 0.37, z);
  assert_true(fabs(fs_vec3_length(z[1]) / fs_vec3_length(x[1]) / both[0] - 1) <= 1e-7);
  jet(s, 1, 0.37, z);
  assert_true(fabs(fs_vec3_length(z[1]) / fs_vec3_length(y[1]) / both[1] - 1) <= 1e-7);
  release(s);
}

static double line_angle(fs_vec3 a, fs_vec3 b) {
  return atan2(fs_vec3_length(fs_vec3_cross(a, b)), fabs(fs_vec3_dot(a, b)));
}

/* The largest differences at 83 equidistant points, as the tables have them: position, angle, curvature, length. */
static void measure(const fs_spline *s, double error[4]) {
  memset(error, 0, 4 * sizeof *error);
  for (int i = 0; i < 83; i++) {
    double v = i / 82.0, A[3][3], B[3][3];
    fs_vec3 seam[2][6], x[6];
    jet(q, q->knot[0][q->n[0]], v, seam[0]);
    jet(r, r->knot[0][0], v, seam[1]);
    for (int side = 0; side < 2; side++) {
      fs_geometry g, h;
      jet(s, side, v, x);
      assert_true(fs_geometry_compute(seam[side], &g) && fs_geometry_compute(x, &h));
      error[0] = fmax(error[0], fs_vec3_distance(seam[side][0], x[0]));
      error[1] = fmax(error[1], line_angle(g.normal, h.normal));
      fs_geometry_shape_tensor(&g, A);
      fs_geometry_shape_tensor(&h, B);
      for (int k = 0; k < 9; k++) {
        double sign = fs_vec3_dot(g.normal, h.normal) < 0 ? -1 : 1;
        error[2] = fmax(error[2], fabs(A[k / 3][k % 3] - sign * B[k / 3][k % 3]));
      }
      double wanted = fs_vec3_distance(seam[0][0], seam[1][0]);
      error[3] = fmax(error[3], fabs(fs_vec3_length(x[1]) / wanted - 1));
    }
  }
}

/* Rows k, spans, and the four errors: those above rounding within a millionth of theirs, rounding as rounding. */
static void check_table(const char *name, fs_gap_options options) {
  const cJSON *row;
  int n = 0;
  cJSON_ArrayForEach(row, vectors_item(vectors_item(vectors_item(vectors, "gap"), "tables"), name)) {
    double theirs[6], ours[4];
    fs_gap_report report;
    vectors_flatten(row, theirs);
    options.n_parts = (int32_t)theirs[0];
    fs_spline *s = fill(options, &report);
    measure(s, ours);
    assert_int_equal(report.n_spans, (int)theirs[1]);
    for (int i = 0; i < 4; i++) {
      double expected = theirs[2 + i];
      bool is_rounding = expected < 1e-8;
      if (is_rounding ? ours[i] > 1e-8 : fabs(ours[i] - expected) > 1e-5 * expected)
        fail_msg("%s, k = %d, error %d: %g is not %g", name, (int)theirs[0], i, ours[i], expected);
    }
    if (options.is_exact) assert_true(ours[1] <= 1e-11 && (options.order == 1 || ours[2] <= 1e-9));
    assert_true(ours[0] <= 1e-12);
    release(s);
    n++;
  }
  assert_int_equal(n, options.is_exact ? 4 : 6);
}

static void test_tables(void **state) {
  (void)state;
  check_table("way2_G1", (fs_gap_options){.order = 1});
  check_table("way2_G2", (fs_gap_options){.order = 2});
  check_table("way1_G1_deg2", (fs_gap_options){.order = 1, .is_exact = true, .scalar_degree = 2});
  check_table("way1_G1_deg3", (fs_gap_options){.order = 1, .is_exact = true, .scalar_degree = 3});
  check_table("way1_G2_deg2", (fs_gap_options){.order = 2, .is_exact = true, .scalar_degree = 2});
  check_table("way1_G2_deg3", (fs_gap_options){.order = 2, .is_exact = true, .scalar_degree = 3});
}

/* r without its double knot: the fourth column of points and one knot 0.7 are left out. */
static fs_spline *simple_knots(void) {
  static double V[10] = {0, 0, 0, 0, 0.45, 0.7, 1, 1, 1, 1};
  fs_context ctx = test_context();
  fs_spline like = *r, *made;
  double *c = calloc((size_t)(3 * r->n[0] * r->n[1]), sizeof *c);
  int k = 0;
  for (int j = 0; j < r->n[1]; j++)
    if (j != 3) memcpy(c + 3 * r->n[0] * k++, r->c + 3 * r->n[0] * j, 3 * (size_t)r->n[0] * sizeof *c);
  like.n[1]--;
  like.knot[1] = V;
  like.c = c;
  assert_int_equal(fs_spline_create(&ctx, &like, &made), FS_OK);
  free(c);
  return made;
}

static void test_simple_knots(void **state) {
  const cJSON *row;
  fs_spline *kept = r;
  (void)state;
  r = simple_knots();
  cJSON_ArrayForEach(row, vectors_item(vectors, "gap_way2_simple_knots_table")) {
    double theirs[3], ours[4];
    fs_gap_report report;
    vectors_flatten(row, theirs);
    fs_spline *s = fill((fs_gap_options){.order = 2, .n_parts = (int32_t)theirs[0]}, &report);
    measure(s, ours);
    assert_true(fabs(ours[1] - theirs[1]) <= 1e-5 * theirs[1] && fabs(ours[2] - theirs[2]) <= 1e-5 * theirs[2]);
    release(s);
  }
  /* exact, cubic scalars and simple knots: second derivatives by v agree across the knots */
  fs_gap_report report;
  fs_spline *s = fill((fs_gap_options){.order = 2, .is_exact = true, .n_parts = 2}, &report);
  for (int i = s->degree[1] + 1; i < s->n[1]; i++)
    for (int d = 0; d < 3; d++) {
      double v = s->knot[1][i], scale;
      fs_vec3 left, right;
      if (v == s->knot[1][i - 1]) continue;
      fs_spline_evaluate(s, 0.3, v - 1e-9, 0, d, &left.x);
      fs_spline_evaluate(s, 0.3, v + 1e-9, 0, d, &right.x);
      scale = 1 + fs_vec3_length(left);
      assert_true(fs_vec3_distance(left, right) <= (d < 2 ? 1e-6 : 1e-5) * scale);
    }
  release(s);
  release(r);
  r = kept;
}

/* ---- tolerances ---- */

static void test_angle_is_met(void **state) {
  (void)state;
  for (int order = 1; order <= 2; order++)
    for (double angle = 1e-2; angle > 1e-7; angle /= 10) {
      fs_gap_report report;
      double error[4];
      fs_spline *s = fill((fs_gap_options){.order = order, .angle = angle}, &report);
      measure(s, error);
      assert_true(error[1] <= angle && report.angle <= angle && report.angle >= error[1] * 0.5);
      print_message("order %d, angle %.0e: %d spans, angle %.3g, curvature %.3g, length %.3g\n", order, angle,
                    (int)report.n_spans, report.angle, report.curvature, report.length);
      release(s);
    }
}

static void test_factors(void **state) {
  fs_gap_report report;
  fs_vec3 a, b;
  (void)state;
  fs_spline *one = fill((fs_gap_options){.n_parts = 2}, &report);
  fs_spline *s = fill((fs_gap_options){.n_parts = 2, .factor = {0.5, 2}}, &report);
  for (int side = 0; side < 2; side++) {
    fs_spline_evaluate(one, side, 0.2, 1, 0, &a.x);
    fs_spline_evaluate(s, side, 0.2, 1, 0, &b.x);
    assert_true(fs_vec3_distance(fs_vec3_scale(a, side == 0 ? 0.5 : 2), b) <= 1e-12);
  }
  assert_true(report.angle <= 2e-3);
  release(one);
  release(s);
}

/* q, filling and r: no T-junction, no crack, one tangent plane or curvature. */
static void test_surface(void **state) {
  fs_context ctx = test_context();
  (void)state;
  for (int order = 1; order <= 2; order++) {
    fs_gap_report report;
    fs_surface *surface;
    fs_contact contact;
    fs_spline *s = fill((fs_gap_options){.order = order, .is_exact = true}, &report);
    assert_int_equal(fs_gap_surface(&ctx, q, s, r, &surface), FS_OK);
    assert_int_equal(fs_surface_validate(&ctx, surface), FS_OK);
    assert_int_equal(surface->n_patches, report.n_spans * (2 + 1 + 2));
    int n_open = 0;
    for (int32_t p = 0; p < surface->n_patches; p++)
      for (int side = 0; side < 4; side++) n_open += surface->patch[p].neighbour[side] == FS_NONE;
    assert_int_equal(n_open, 2 * report.n_spans + 2 * 5); /* the rim alone: left and right, below and above */
    assert_int_equal(fs_surface_contact(&ctx, surface, 8, &contact), FS_OK);
    assert_true(contact.position <= 1e-12 && contact.normal <= 1e-10);
    fs_surface_free(&ctx, surface);
    release(s);
  }
}

/* ---- laws ---- */

static fs_spline *moved(const fs_spline *s, double scale, bool is_flat) {
  fs_context ctx = test_context();
  fs_spline *made;
  assert_int_equal(fs_spline_create(&ctx, s, &made), FS_OK);
  for (int i = 0; i < s->n[0] * s->n[1]; i++) {
    const double *p = s->c + 3 * i;
    double *to = made->c + 3 * i;
    if (is_flat) {
      to[2] = 0;
      continue;
    }
    to[0] = scale * (0.6 * p[0] - 0.8 * p[1]) + 1, to[1] = scale * p[2] - 2, to[2] = -scale * (0.8 * p[0] + 0.6 * p[1]);
  }
  return made;
}

static void test_invariance(void **state) {
  fs_spline *kept[2] = {q, r}, *a, *b;
  fs_gap_report report;
  (void)state;
  a = fill((fs_gap_options){.order = 2, .n_parts = 1}, &report);
  q = moved(kept[0], 1.6, false), r = moved(kept[1], 1.6, false);
  b = fill((fs_gap_options){.order = 2, .n_parts = 1}, &report);
  fs_spline *expected = moved(a, 1.6, false);
  vectors_agree("points", 3 * a->n[0] * a->n[1], b->c, expected->c, 1e-12);
  release(a), release(b), release(expected), release(q), release(r);
  q = moved(kept[0], 1, true), r = moved(kept[1], 1, true);
  b = fill((fs_gap_options){.order = 2, .n_parts = 2}, &report);
  for (int i = 0; i < b->n[0] * b->n[1]; i++) assert_true(fabs(b->c[3 * i + 2]) <= 1e-14);
  release(b), release(q), release(r);
  q = kept[0], r = kept[1];
}

/* The source divides by |q_u| on both sides: the length of s_u at r is then wrong. */
static void test_misprint(void **state) {
  fs_vec3 a[6], b[6];
  (void)state;
  jet(q, q->knot[0][q->n[0]], 0.37, a);
  jet(r, r->knot[0][0], 0.37, b);
  double theirs[2], printed = fs_vec3_distance(a[0], b[0]) / fs_vec3_length(a[1]);
  vectors_numbers(vectors_item(vectors, "gap"), "c1_g1_at_0.37", 2, theirs);
  assert_true(fabs(printed - theirs[1]) > 0.05);
}

/* ---- bad input ---- */

static void refuse(const fs_spline *first, const fs_spline *second, fs_gap_options options, fs_status expected,
                   const char *sentence) {
  fs_context ctx = test_context();
  fs_spline *s = NULL;
  assert_int_equal(fs_gap_fill(&ctx, first, second, &options, &s, NULL), expected);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" lacks \"%s\"", ctx.message, sentence);
  assert_null(s);
}

static void test_bad_input(void **state) {
  const fs_gap_options none = {0};
  fs_context ctx = test_context();
  fs_spline *other = moved(r, 1, false), *curve, like = *q;
  (void)state;
  refuse(r, q, none, FS_ERR_ARGUMENT, "points away from the gap at most points of its seam");
  refuse(q, r, (fs_gap_options){.order = 3}, FS_ERR_ARGUMENT, "order 1 or 2, not 3");
  refuse(q, r, (fs_gap_options){.scalar_degree = 4}, FS_ERR_ARGUMENT, "degree 2 or 3, not 4");
  refuse(q, r, (fs_gap_options){.factor = {1, -1}}, FS_ERR_ARGUMENT, "the factor of side 1 is -1");
  refuse(q, r, (fs_gap_options){.angle = 1e-13}, FS_ERR_NUMERIC, "needs more than 4096 spans");
  for (int i = 0; i < 11; i++) other->knot[1][i] *= 2;
  refuse(q, other, none, FS_ERR_ARGUMENT, "'q' has v from 0 to 1, but 'r' from 0 to 2");
  release(other);
  other = moved(r, 1, false);
  for (int j = 0; j < r->n[1]; j++)
    memcpy(other->c + 3 * r->n[0] * j, r->c + 3 * r->n[0] * j, 3 * (size_t)r->n[0] * sizeof(double));
  for (int j = 0; j < r->n[1]; j++)
    memcpy(other->c + 3 * r->n[0] * j + 3, other->c + 3 * r->n[0] * j, 3 * sizeof(double));
  refuse(q, other, none, FS_ERR_NUMERIC, "the derivative of 'r' across its seam vanishes at v = 0");
  release(other);
  other = moved(q, 1, false);
  memcpy(other->c, q->c, 3 * (size_t)(q->n[0] * q->n[1]) * sizeof(double));
  for (int j = 0; j < q->n[1]; j++) /* starts where q ends */
    memcpy(other->c + 3 * q->n[0] * j, q->c + 3 * (q->n[0] * j + q->n[0] - 1), 3 * sizeof(double));
  refuse(q, other, none, FS_ERR_NUMERIC, "touch at v = 0: there is no gap to fill");
  release(other);
  like.n_parameters = 1, like.n[1] = 1, like.degree[1] = 0;
  assert_int_equal(fs_spline_create(&ctx, &like, &curve), FS_OK);
  refuse(curve, r, none, FS_ERR_ARGUMENT, "'q' is no patch");
  release(curve);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_vectors),      cmocka_unit_test(test_tables),   cmocka_unit_test(test_simple_knots),
      cmocka_unit_test(test_angle_is_met), cmocka_unit_test(test_factors),  cmocka_unit_test(test_surface),
      cmocka_unit_test(test_invariance),   cmocka_unit_test(test_misprint), cmocka_unit_test(test_bad_input),
  };
  int failures;
  vectors = vectors_open("math/patches-vectors.json");
  if (vectors == NULL) return TEST_SKIPPED;
  failures = cmocka_run_group_tests(tests, setup, teardown);
  cJSON_Delete(vectors);
  return failures;
}
