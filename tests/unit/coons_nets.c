/* SPDX-License-Identifier: MIT */
/* Coons patches as nets: exact Bezier patches and Gregory quads, bicubics, sides that are splines, the construction, refusals. */
#include "coons_checks.h"
#include "math/bernstein.h"

typedef struct bezier_sides {
  fs_vec3 point[8][8];
  fs_bezier_curve curve[8]; /* at_u[0 .. 3], at_v[0 .. 3] */
} bezier_sides;

/* Cubic sides of the surface's corners with Adini's twists, or with others for the sides of v. */
static void make_sides(bool is_torn, bezier_sides *s, fs_coons_data *data) {
  uint64_t seed = 4;
  fs_vec3 twist[2][2], across_u[2][4], across_v[2][4];
  *data = (fs_coons_data){.n_data = 4, .is_gregory = is_torn};
  for (int k = 0; k < 8; k++) {
    s->curve[k] = (fs_bezier_curve){3, s->point[k]};
    (k < 4 ? data->at_u : data->at_v)[k % 4] = (fs_curve){fs_bezier_evaluate, &s->curve[k]};
  }
  for (int side = 0; side < 2; side++)
    for (int i = 0; i < 4; i++) {
      s->point[side][i] = (fs_vec3){side, i / 3.0, test_random_real(&seed, 0, 1)};
      s->point[4 + side][i] = (fs_vec3){i / 3.0, side, test_random_real(&seed, 0, 1)};
    }
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) s->point[4 + j][3 * i] = s->point[i][3 * j];
  fs_adini_twists(data->at_u, data->at_v, twist);
  fs_coons_cross(data->at_u, data->at_v, (const fs_vec3(*)[2])twist, across_u, across_v);
  for (int side = 0; side < 2; side++)
    for (int i = 0; i < 4; i++) s->point[2 + side][i] = across_u[side][i], s->point[6 + side][i] = across_v[side][i];
  for (int side = 0; side < 2 && is_torn; side++) s->point[6 + side][1].z += 0.4, s->point[6 + side][2].x -= 0.2 * side;
}

/* The exact patch, tensor Bezier or Gregory quad, has the derivatives of the Boolean sum. */
static void test_bezier(void **state) {
  (void)state;
  for (int is_torn = 0; is_torn < 2; is_torn++)
    for (int degree = 3; degree <= 5; degree += 2) {
      bezier_sides s;
      fs_coons_data data;
      fs_context ctx = test_context();
      fs_surface *surface = NULL;
      fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE], raised[6];
      make_sides(is_torn, &s, &data);
      if (degree > 3) { /* a side of higher degree */
        fs_bernstein_elevate(3, 3, &s.point[5][0].x, degree, &raised[0].x);
        raised[2].z += 0.3, raised[3].x += 0.1;
        s.curve[5] = (fs_bezier_curve){degree, raised};
      }
      fs_coons coons = prepare(&data);
      assert_int_equal(fs_coons_to_bezier(&ctx, &coons, &surface), FS_OK);
      assert_int_equal(surface->patch->kind, is_torn ? FS_PATCH_GREGORY_QUAD : FS_PATCH_TENSOR_BEZIER);
      assert_int_equal(fs_surface_validate(&ctx, surface), FS_OK);
      assert_int_equal(surface->patch->degree_u, degree);
      for (int k = 0; k < 25; k++) {
        double u = k % 5 / 4.0, v = k / 5 / 4.0;
        bool is_corner = fmin(u, 1 - u) + fmin(v, 1 - v) == 0;
        fs_coons_evaluate(&coons, u, v, x);
        fs_surface_evaluate(surface, 0, u, v, y);
        for (int i = 0; i < FS_JET_SIZE && !(is_corner && is_torn && i > FS_DVV); i++) near_points(x[i], y[i], 1e-11);
      }
      fs_surface_free(&ctx, surface);
    }
}

/* Neighbours that share a side, its end tangents and twists join C1. */
static void test_cross(void **state) {
  bezier_sides s;
  fs_coons_data data;
  fs_vec3 x[FS_JET_SIZE];
  (void)state;
  make_sides(false, &s, &data);
  fs_coons coons = prepare(&data);
  fs_coons_evaluate(&coons, 0, 0, x);
  near_points(x[FS_DU], fs_vec3_scale(fs_vec3_sub(s.point[4][1], s.point[4][0]), 3), 1e-13);
  fs_coons_evaluate(&coons, 1, 0.3, x);
  fs_vec3 curve[4];
  fs_bezier_evaluate(&s.curve[3], 0.3, curve);
  near_points(x[FS_DU], curve[0], 1e-13);
}

/* de Boor's algorithm at t < last knot. */
static fs_vec3 spline_point(int degree, int n, const double *knot, const fs_vec3 *point, double t) {
  fs_vec3 d[8];
  int k = degree;
  while (k + 1 < n && knot[k + 1] <= t) k++;
  for (int i = 0; i <= degree; i++) d[i] = point[k - degree + i];
  for (int r = 1; r <= degree; r++)
    for (int i = degree; i >= r; i--) {
      double low = knot[k - degree + i], high = knot[k + 1 + i - r], a = (t - low) / (high - low);
      d[i] = fs_vec3_add_scaled(fs_vec3_scale(d[i - 1], 1 - a), d[i], a);
    }
  return d[degree];
}

static void test_spline(void **state) {
  const double U[10] = {0, 0, 0, 0, .3, .6, 1, 1, 1, 1}, V[7] = {2, 2, 2, 3, 4, 4, 4};
  fs_vec3 c[2][6], d[2][4], net[24];
  const fs_vec3 *const at_v[2] = {c[0], c[1]}, *const at_u[2] = {d[0], d[1]};
  fs_context ctx = test_context();
  uint64_t seed = 8;
  (void)state;
  for (int k = 0; k < 12; k++) c[k / 6][k % 6] = (fs_vec3){k % 6, k / 6, test_random_real(&seed, 0, 1)};
  for (int k = 0; k < 8; k++) d[k / 4][k % 4] = (fs_vec3){5 * (k / 4), k % 4 / 3.0, test_random_real(&seed, 0, 1)};
  for (int k = 0; k < 4; k++) d[k / 2][3 * (k % 2)] = c[k % 2][5 * (k / 2)];
  assert_int_equal(fs_coons_spline_net(&ctx, 3, 6, U, at_v, 2, 4, V, at_u, 1e-12, net), FS_OK);
  for (int k = 0; k < 16; k++) {
    double u = 0.05 + 0.3 * (k % 4), v = 0.1 + 0.25 * (k / 4);
    fs_vec3 row[4], sum;
    for (int j = 0; j < 4; j++) row[j] = spline_point(3, 6, U, net + 6 * j, u);
    sum = fs_vec3_scale(spline_point(3, 6, U, c[0], u), 1 - v);
    sum = fs_vec3_add_scaled(sum, spline_point(3, 6, U, c[1], u), v);
    sum = fs_vec3_add_scaled(sum, spline_point(2, 4, V, d[0], 2 + 2 * v), 1 - u);
    sum = fs_vec3_add_scaled(sum, spline_point(2, 4, V, d[1], 2 + 2 * v), u);
    for (int i = 0; i < 4; i++)
      sum = fs_vec3_add_scaled(sum, c[i / 2][5 * (i % 2)], -(i % 2 ? u : 1 - u) * (i / 2 ? v : 1 - v));
    near_points(spline_point(2, 4, V, row, 2 + 2 * v), sum, 1e-13);
  }
  d[1][3].z += 0.1;
  assert_int_equal(fs_coons_spline_net(&ctx, 3, 6, U, at_v, 2, 4, V, at_u, 1e-12, net), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "the sides u = 1 and v = 1 differ at (1, 1) by 0.1 in S"));
  const double bad[7] = {2, 2, 2, 5, 4, 4, 4};
  assert_int_equal(fs_coons_spline_net(&ctx, 3, 6, U, at_v, 2, 4, bad, at_u, 1e-12, net), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "knot 4 along v is 4 and below knot 3, 5"));
}

static void test_bicubics(void **state) {
  sample_line line[2][6];
  fs_coons_data data = sample_coons(&unit_square, 6, line);
  fs_coons coons = prepare(&data);
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  double deviation;
  (void)state;
  assert_int_equal(fs_coons_to_bicubics(&ctx, &coons, 1e-5, 6, &s, &deviation), FS_OK);
  assert_true(deviation <= 1e-5);
  assert_int_equal(fs_surface_validate(&ctx, s), FS_OK);
  int n = (int)(sqrt(s->n_patches) + 0.5);
  for (int k = 0; k < s->n_patches; k++) {
    fs_surface_evaluate(s, k, 0.4, 0.7, x);
    fs_coons_evaluate(&coons, (k % n + 0.4) / n, (k / n + 0.7) / n, y);
    near_points(x[FS_D], y[FS_D], 1e-5);
  }
  fs_surface_free(&ctx, s);
}

/* ---- the construction ---- */

static const char sides_text[] = "fairsurf-splines 1\n"
                                 "curve v0\ndegree 3\nknots 0 0 0 0 0.4 1 1 1 1\npoints\n"
                                 "0 0 0  0.9 -0.6 0.5  2 -0.7 0.9  3.1 -0.2 0.9  4 0.3 0.4\n"
                                 "curve v1\ndegree 3\nknots 2 2 2 2 5 5 5 5\npoints\n"
                                 "0.6 3.2 1.6  1.4 3.9 1.9  2.4 4 0.9  3.1 3.6 0.2\n"
                                 "curve u0\ndegree 3\npoints\n0 0 0  -0.5 1 1.2  -0.1 2.4 1.9  0.6 3.2 1.6\n"
                                 "curve u1\ndegree 2\npoints\n4 0.3 0.4  4.4 1.9 1.4  3.1 3.6 0.2\n";

static fs_vec3 curve_point(const fs_splines *splines, const char *name, double t) {
  const fs_spline *s = fs_splines_find(splines, name);
  const double *knot = s->knot[0];
  fs_vec3 x;
  fs_spline_evaluate(s, knot[0] + t * (knot[s->n[0] + s->degree[0]] - knot[0]), 0, 0, 0, &x.x);
  return x;
}

/* Sides of different degrees, knots and domains: the patches are the Boolean sum. */
static void test_construction(void **state) {
  const fs_construction *coons = fs_construction_find("coons");
  fs_context ctx = test_context();
  fs_splines *splines = NULL;
  fs_surface *s = NULL;
  (void)state;
  assert_int_equal(fs_splines_parse(&ctx, sides_text, strlen(sides_text), &splines), FS_OK);
  fs_construction_input input = {.splines = splines};
  if (fs_construct(&ctx, coons, &input, NULL, &s) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(s->n_patches, 2);
  for (int p = 0; p < 2; p++)
    for (int k = 0; k < 25; k++) {
      double a = k % 5 / 4.0, v = k / 5 / 4.0, u = p == 0 ? 0.4 * a : 0.4 + 0.6 * a;
      fs_vec3 x[FS_JET_SIZE], sum = fs_vec3_scale(curve_point(splines, "v0", u), 1 - v);
      sum = fs_vec3_add_scaled(sum, curve_point(splines, "v1", u), v);
      sum = fs_vec3_add_scaled(sum, curve_point(splines, "u0", v), 1 - u);
      sum = fs_vec3_add_scaled(sum, curve_point(splines, "u1", v), u);
      for (int c = 0; c < 4; c++)
        sum = fs_vec3_add_scaled(sum, curve_point(splines, c / 2 ? "v1" : "v0", c % 2),
                                 -(c % 2 ? u : 1 - u) * (c / 2 ? v : 1 - v));
      fs_surface_evaluate(s, p, a, v, x);
      near_points(x[FS_D], sum, 1e-13);
    }
  fs_surface_free(&ctx, s);
  s = NULL;
  const double smooth[] = {1};
  assert_int_equal(fs_construct(&ctx, coons, &input, smooth, &s), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "without inner knots"));
  splines->spline[3].c[0] += 0.25;
  assert_int_equal(fs_construct(&ctx, coons, &input, NULL, &s), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "the sides u = 1 and v = 0 differ at (1, 0) by 0.25 in S"));
  splines->spline[3].name[1] = 'x';
  assert_int_equal(fs_construct(&ctx, coons, &input, NULL, &s), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "needs a curve 'u1'; there is none"));
  fs_splines_free(&ctx, splines);
}

/* One piece for each blend, which meets the sides. */
static void test_blends(void **state) {
  const fs_construction *coons = fs_construction_find("coons");
  static const char text[] = "fairsurf-splines 1\n"
                             "curve v0\ndegree 4\npoints\n0 0 0 1 -0.3 1 1.5 0 1 2 -0.3 1 3 0 0\n"
                             "curve v1\ndegree 3\npoints\n0 3 0 1 3.3 1 2 3.3 1 3 3 0\n"
                             "curve u0\ndegree 2\npoints\n0 0 0 -0.3 1 -1 0 3 0\n"
                             "curve u1\ndegree 3\npoints\n3 0 0 3.3 1 -1 3.3 2 -1 3 3 0\n";
  fs_context ctx = test_context();
  fs_splines *splines = NULL;
  (void)state;
  assert_int_equal(fs_splines_parse(&ctx, text, strlen(text), &splines), FS_OK);
  fs_construction_input input = {.splines = splines};
  for (double blend = 0; blend < 3; blend++) {
    fs_surface *s = NULL;
    fs_vec3 x[FS_JET_SIZE];
    if (fs_construct(&ctx, coons, &input, &blend, &s) != FS_OK) fail_msg("%s", ctx.message);
    assert_int_equal(s->n_patches, 1);
    for (int k = 0; k <= 8; k++) {
      double t = k / 8.0;
      fs_surface_evaluate(s, 0, t, 0, x), near_points(x[FS_D], curve_point(splines, "v0", t), 1e-13);
      fs_surface_evaluate(s, 0, t, 1, x), near_points(x[FS_D], curve_point(splines, "v1", t), 1e-13);
      fs_surface_evaluate(s, 0, 0, t, x), near_points(x[FS_D], curve_point(splines, "u0", t), 1e-13);
      fs_surface_evaluate(s, 0, 1, t, x), near_points(x[FS_D], curve_point(splines, "u1", t), 1e-13);
    }
    fs_surface_free(&ctx, s);
  }
  fs_splines_free(&ctx, splines);
}

/* Every allocation fails once. */
static void test_memory(void **state) {
  struct test_memory memory = {0};
  fs_status status = FS_ERR_MEMORY;
  fs_context plain = test_context();
  fs_splines *splines = NULL;
  (void)state;
  assert_int_equal(fs_splines_parse(&plain, sides_text, strlen(sides_text), &splines), FS_OK);
  fs_construction_input input = {.splines = splines};
  for (int64_t n = 1; status != FS_OK; n++) {
    fs_context ctx = test_memory_context(&memory);
    fs_surface *s = NULL;
    memory.n_allocations = 0, memory.fail_at = n;
    status = fs_construct(&ctx, fs_construction_find("coons"), &input, NULL, &s);
    assert_true(status == FS_OK || (status == FS_ERR_MEMORY && s == NULL));
    fs_surface_free(&ctx, s);
    assert_int_equal(memory.n_live, 0);
  }
  fs_splines_free(&plain, splines);
}

/* ---- refusals ---- */

static void refuse(const fs_coons_data *data, fs_status due, const char *part) {
  fs_context ctx = test_context();
  fs_coons coons;
  assert_int_equal(fs_coons_prepare(&ctx, data, 1e-9, &coons), due);
  if (strstr(ctx.message, part) == NULL) fail_msg("\"%s\" does not hold \"%s\"", ctx.message, part);
}

static void test_refusals(void **state) {
  const double square0[3] = {1, 0, 0}, square1[3] = {0, 0, 1}, wrong[3] = {1, 0, 0.5};
  sample_line line[2][6];
  bezier_sides s;
  fs_context ctx = test_context();
  fs_surface *surface = NULL;
  fs_coons coons;
  fs_coons_data data = sample_coons(&unit_square, 2, line);
  (void)state;
  data.n_data = 3, refuse(&data, FS_ERR_ARGUMENT, "2, 4 or 6 data per direction, not 3"), data.n_data = 2;
  data.is_gregory = true, refuse(&data, FS_ERR_ARGUMENT, "Gregory's square"), data.is_gregory = false;
  data.blend_degree = 2, data.blend[0] = square0, data.blend[1] = square1;
  refuse(&data, FS_ERR_ARGUMENT, "do not sum to 1: coefficients 1 sum to 0");
  data.blend[0] = wrong, refuse(&data, FS_ERR_ARGUMENT, "blending function 0 is 0.5 at 1, not 0");
  data.blend_degree = 0;
  coons = prepare(&data);
  assert_int_equal(fs_coons_to_bezier(&ctx, &coons, &surface), FS_ERR_UNSUPPORTED);
  make_sides(false, &s, &data);
  s.point[5][3].x += 1e-3;
  refuse(&data, FS_ERR_NUMERIC, "the sides u = 1 and v = 1 differ at (1, 1) by 0.001 in S");
  s.point[5][3].x -= 1e-3, s.point[2][0].z += 1e-3;
  refuse(&data, FS_ERR_NUMERIC, "the sides u = 0 and v = 0 differ at (0, 0) by 0.001 in S_u");
  s.point[2][0].z -= 1e-3, s.point[0][0].x = NAN;
  refuse(&data, FS_ERR_NUMERIC, "the sides u = 0 and v = 0 differ at (0, 0) by nan in S");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_bezier),   cmocka_unit_test(test_cross),        cmocka_unit_test(test_spline),
      cmocka_unit_test(test_bicubics), cmocka_unit_test(test_construction), cmocka_unit_test(test_blends),
      cmocka_unit_test(test_memory),   cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
