/* SPDX-License-Identifier: MIT */
/* Coons patches: interpolation, continuity, reproduction, order of approximation, invariance. */
#include "coons_checks.h"

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

static int jet_number(int p, int q) {
  static const int number[4][4] = {
      {FS_D, FS_DV, FS_DVV, FS_DVVV}, {FS_DU, FS_DUV, FS_DUVV}, {FS_DUU, FS_DUUV}, {FS_DUUU}};
  return number[p][q];
}

/* ---- what is interpolated ---- */

static void test_interpolation(void **state) {
  (void)state;
  for (int n_data = 2; n_data <= 6; n_data += 2) {
    sample_line line[2][6];
    fs_coons_data data = sample_coons(&unit_square, n_data, line);
    fs_coons coons = prepare(&data);
    fs_vec3 x[FS_JET_SIZE];
    for (int k = 0; k <= 8; k++)
      for (int side = 0; side < 2; side++)
        for (int across = 0; across < n_data / 2; across++)
          for (int along = 0; along + across <= 3; along++) {
            double t = k / 8.0;
            fs_coons_evaluate(&coons, side, t, x);
            near_points(x[jet_number(across, along)], sample_F(side, t, across, along), 1e-12);
            fs_coons_evaluate(&coons, t, side, x);
            near_points(x[jet_number(along, across)], sample_F(t, side, along, across), 1e-12);
          }
  }
}

static void check_differences(const fs_coons *coons, double u, double v) {
  const double h = 1e-3, at[4] = {-2, -1, 1, 2}, weight[4] = {1, -8, 8, -1};
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  fs_coons_evaluate(coons, u, v, x);
  for (int p = 0; p < 3; p++)
    for (int q = 0; p + q < 3; q++) {
      fs_vec3 by_u = {0, 0, 0}, by_v = {0, 0, 0};
      for (int i = 0; i < 4; i++) {
        fs_coons_evaluate(coons, u + at[i] * h, v, y);
        by_u = fs_vec3_add_scaled(by_u, y[jet_number(p, q)], weight[i] / (12 * h));
        fs_coons_evaluate(coons, u, v + at[i] * h, y);
        by_v = fs_vec3_add_scaled(by_v, y[jet_number(p, q)], weight[i] / (12 * h));
      }
      near_points(by_u, x[jet_number(p + 1, q)], 2e-7);
      near_points(by_v, x[jet_number(p, q + 1)], 2e-7);
    }
}

static void test_derivatives(void **state) {
  (void)state;
  for (int n_data = 2; n_data <= 6; n_data += 2) {
    sample_line line[2][6];
    fs_coons_data data = sample_coons(&unit_square, n_data, line);
    data.is_gregory = n_data == 4;
    for (int b = 2; b < 4 && n_data == 4; b++) line[1][b].bump = (fs_vec3){0.3, -0.2, 0.5};
    fs_coons coons = prepare(&data);
    check_differences(&coons, 0.37, 0.61);
    check_differences(&coons, 0.9, 0.2);
  }
}

/* Different twists from each side: all sides and derivatives across are met nevertheless. */
static void test_square(void **state) {
  sample_line line[2][6];
  fs_coons_data data = sample_coons(&unit_square, 4, line);
  fs_context ctx = test_context();
  fs_coons coons;
  fs_vec3 x[FS_JET_SIZE], curve[4];
  (void)state;
  for (int b = 2; b < 4; b++)
    line[1][b].bump = (fs_vec3){0.3, -0.2 * b, 0.5}, line[0][b].bump = (fs_vec3){0.1 * b, 0, 1};
  assert_int_equal(fs_coons_prepare(&ctx, &data, 1e-9, &coons), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "the sides u = 0 and v = 0 differ at (0, 0) by"));
  assert_non_null(strstr(ctx.message, "in S_uv"));
  data.is_gregory = true;
  coons = prepare(&data);
  for (int k = 1; k <= 8; k++)
    for (int side = 0; side < 2; side++)
      for (int across = 0; across < 2; across++) {
        double t = k / 9.0;
        fs_coons_evaluate(&coons, side, t, x);
        data.at_u[2 * across + side].evaluate(data.at_u[2 * across + side].user, t, curve);
        near_points(x[jet_number(across, 0)], curve[0], 1e-12);
        fs_coons_evaluate(&coons, t, side, x);
        data.at_v[2 * across + side].evaluate(data.at_v[2 * across + side].user, t, curve);
        near_points(x[jet_number(0, across)], curve[0], 1e-12);
      }
}

/* ---- neighbours ---- */

static void test_continuity(void **state) {
  const sample_square next = {sample_F, 1, 0, 1, {{0, 0, 0}}, {0, 0, 0}};
  (void)state;
  for (int n_data = 2; n_data <= 6; n_data += 2) {
    sample_line line[2][6], other[2][6];
    fs_coons_data data = sample_coons(&unit_square, n_data, line), data2 = sample_coons(&next, n_data, other);
    fs_coons a = prepare(&data), b = prepare(&data2);
    fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
    for (int k = 0; k <= 6; k++) {
      fs_coons_evaluate(&a, 1, k / 6.0, x);
      fs_coons_evaluate(&b, 0, k / 6.0, y);
      near_points(x[FS_D], y[FS_D], 1e-12);
      if (n_data >= 4) near_points(x[FS_DU], y[FS_DU], 1e-12);
      if (n_data >= 4) near_points(x[FS_DUV], y[FS_DUV], 1e-12);
      if (n_data >= 6) near_points(x[FS_DUU], y[FS_DUU], 1e-11);
    }
  }
}

/* With smooth blending two patches join C1 where their sides do; with linear blending they do not. */
static void test_blending(void **state) {
  const double b0[4] = {1, 1, 0, 0}, b1[4] = {0, 0, 1, 1};
  const sample_square next = {sample_F, 1, 0, 1, {{0, 0, 0}}, {0, 0, 0}};
  (void)state;
  for (int is_smooth = 0; is_smooth < 2; is_smooth++) {
    sample_line line[2][6], other[2][6];
    fs_coons_data data = sample_coons(&unit_square, 2, line), data2 = sample_coons(&next, 2, other);
    if (is_smooth) {
      data.blend_degree = data2.blend_degree = 3;
      data.blend[0] = data2.blend[0] = b0, data.blend[1] = data2.blend[1] = b1;
    }
    fs_coons a = prepare(&data), b = prepare(&data2);
    fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
    double gap = 0;
    for (int k = 0; k <= 6; k++) {
      fs_coons_evaluate(&a, 1, k / 6.0, x);
      fs_coons_evaluate(&b, 0, k / 6.0, y);
      gap = fmax(gap, fs_vec3_distance(x[FS_DU], y[FS_DU]));
    }
    assert_true(is_smooth ? gap < 1e-12 : gap > 1e-3);
  }
}

/* ---- what is reproduced ---- */

/* Of degree 3 in u, anything in v. */
static fs_vec3 cubic_in_u(double u, double v, int p, int q) {
  const double power[4] = {u * u * u - u, 3 * u * u - 1, 6 * u, 6};
  return (fs_vec3){power[p] * sample_sin(2, v, q), (power[p] + 2 * sample_linear(u, p)) * sample_exp(0.5, v, q),
                   (p == 0) * sample_exp(-1, v, q)};
}

static fs_vec3 plane(double u, double v, int p, int q) {
  fs_vec3 x = sample_F(u, v, p, q);
  return (fs_vec3){x.x, x.y, 2 * (p + q == 0)};
}

static void test_reproduction(void **state) {
  const sample_square cubic = {cubic_in_u, 0, 0, 1, {{0, 0, 0}}, {0, 0, 0}},
                      flat = {plane, 0, 0, 1, {{0, 0, 0}}, {0, 0, 0}};
  (void)state;
  for (int n_data = 2; n_data <= 6; n_data += 2) {
    sample_line line[2][6], other[2][6];
    fs_coons_data data = sample_coons(&cubic, n_data, line), data2 = sample_coons(&flat, n_data, other);
    fs_coons a = prepare(&data), b = prepare(&data2);
    fs_vec3 x[FS_JET_SIZE];
    for (int k = 0; k < 9; k++) {
      double u = 0.1 + 0.4 * (k % 3), v = 0.15 + 0.35 * (k / 3);
      fs_coons_evaluate(&b, u, v, x);
      near(x[FS_D].z, 2, 1e-13);
      if (n_data == 2) continue;
      fs_coons_evaluate(&a, u, v, x);
      near_points(x[FS_D], cubic_in_u(u, v, 0, 0), 1e-13);
      near_points(x[FS_DUUV], cubic_in_u(u, v, 2, 1), 1e-11);
    }
  }
}

/* Error on squares of half the size: orders 4, 8, 12. */
static double error_of(int n_data, double size) {
  const sample_square square = {sample_F, 0.5 - size / 2, 0.5 - size / 2, size, {{0, 0, 0}}, {0, 0, 0}};
  sample_line line[2][6];
  fs_coons_data data = sample_coons(&square, n_data, line);
  fs_coons coons = prepare(&data);
  fs_vec3 x[FS_JET_SIZE];
  double largest = 0;
  for (int k = 0; k < 49; k++) {
    double u = k % 7 / 6.0, v = k / 7 / 6.0;
    fs_coons_evaluate(&coons, u, v, x);
    largest = fmax(largest, fs_vec3_distance(x[FS_D], sample_value(&square, u, v, 0, 0)));
  }
  return largest;
}

static void test_order(void **state) {
  (void)state;
  near(log2(error_of(2, 0.2) / error_of(2, 0.1)), 4, 0.1);
  near(log2(error_of(4, 0.8) / error_of(4, 0.4)), 8, 0.2);
  near(log2(error_of(6, 1.6) / error_of(6, 0.8)), 12, 0.4);
}

static void test_affine(void **state) {
  const sample_square moved = {sample_F, 0, 0, 1, {{1, .2, -.3}, {.4, -.8, .1}, {.7, .5, 1.3}}, {3, -2, 1}};
  (void)state;
  for (int n_data = 2; n_data <= 6; n_data += 2) {
    sample_line line[2][6], other[2][6];
    fs_coons_data data = sample_coons(&unit_square, n_data, line), data2 = sample_coons(&moved, n_data, other);
    fs_coons a = prepare(&data), b = prepare(&data2);
    fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE], z;
    fs_coons_evaluate(&a, 0.3, 0.7, x);
    fs_coons_evaluate(&b, 0.3, 0.7, y);
    z = fs_vec3_add_scaled(fs_vec3_scale(moved.column[0], x[FS_D].x), moved.column[1], x[FS_D].y);
    z = fs_vec3_add(fs_vec3_add_scaled(z, moved.column[2], x[FS_D].z), moved.shift);
    near_points(y[FS_D], z, 1e-12);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_interpolation), cmocka_unit_test(test_derivatives), cmocka_unit_test(test_square),
      cmocka_unit_test(test_continuity),    cmocka_unit_test(test_blending),    cmocka_unit_test(test_reproduction),
      cmocka_unit_test(test_order),         cmocka_unit_test(test_affine),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
