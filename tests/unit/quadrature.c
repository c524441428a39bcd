/* SPDX-License-Identifier: MIT */
/* Gauss-Legendre quadrature against closed forms, exact integrals of powers, and its error where it is not exact. */
#include "math/quadrature.h"
#include "../support/support.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

static void test_closed_forms(void **state) {
  fs_context ctx = test_context();
  double node[5], weight[5], inner, outer;
  (void)state;
  assert_int_equal(fs_gauss_legendre(&ctx, 1, node, weight), FS_OK);
  assert_true(node[0] == 0.5);
  near(weight[0], 1, 2e-16);
  fs_gauss_legendre(&ctx, 2, node, weight);
  near(node[0], 0.5 - sqrt(3) / 6, 1e-16);
  near(node[1], 0.5 + sqrt(3) / 6, 2e-16);
  near(weight[0], 0.5, 2e-16);
  fs_gauss_legendre(&ctx, 3, node, weight);
  near(node[0], 0.5 - sqrt(0.15), 1e-16);
  near(weight[0], 5.0 / 18, 2e-16);
  near(weight[1], 4.0 / 9, 2e-16);
  fs_gauss_legendre(&ctx, 5, node, weight);
  inner = sqrt(5 - 2 * sqrt(10.0 / 7)) / 3, outer = sqrt(5 + 2 * sqrt(10.0 / 7)) / 3;
  near(node[0], (1 - outer) / 2, 1e-16);
  near(node[1], (1 - inner) / 2, 1e-16);
  near(weight[0], (322 - 13 * sqrt(70)) / 1800, 2e-16);
  near(weight[1], (322 + 13 * sqrt(70)) / 1800, 2e-16);
  near(weight[2], 64.0 / 225, 2e-16);
}

static void test_powers(void **state) {
  fs_context ctx = test_context();
  double node[FS_GAUSS_MAX_NODES], weight[FS_GAUSS_MAX_NODES];
  (void)state;
  for (int n = 1; n <= FS_GAUSS_MAX_NODES; n++) {
    assert_int_equal(fs_gauss_legendre(&ctx, n, node, weight), FS_OK);
    for (int i = 0; i < n; i++) {
      assert_true(node[i] > (i == 0 ? 0 : node[i - 1]) && node[i] < 1 && weight[i] > 0);
      near(node[i] + node[n - 1 - i], 1, 3e-16);
    }
    for (int power = 0; power < 2 * n; power++) {
      double low = 0, high = 0; /* integrals of t^power and (1-t)^power */
      for (int i = 0; i < n; i++)
        low += weight[i] * pow(node[i], power), high += weight[i] * pow(node[n - 1 - i], power);
      near(low, 1.0 / (power + 1), 1e-15);
      near(high, 1.0 / (power + 1), 1e-15);
    }
  }
}

/* The error for t^(2n) is (n!)^4 / ((2n+1) ((2n)!)^2), so a node or weight that is slightly off shows there too. */
static void test_first_error(void **state) {
  fs_context ctx = test_context();
  (void)state;
  for (int n = 1; n <= 8; n++) {
    double node[8], weight[8], sum = 0, error = 1.0 / (2 * n + 1);
    fs_gauss_legendre(&ctx, n, node, weight);
    for (int i = 0; i < n; i++) sum += weight[i] * pow(node[i], 2 * n);
    for (int i = 1; i <= n; i++) error *= (double)(i * i) / ((n + i) * (n + i));
    near(1.0 / (2 * n + 1) - sum, error, 3e-16);
  }
}

static void test_refuses(void **state) {
  fs_context ctx = test_context();
  double node[1] = {7}, weight[1] = {7};
  (void)state;
  assert_int_equal(fs_gauss_legendre(&ctx, 0, node, weight), FS_ERR_ARGUMENT);
  assert_int_equal(fs_gauss_legendre(&ctx, 65, node, weight), FS_ERR_ARGUMENT);
  assert_true(node[0] == 7 && weight[0] == 7 && ctx.message[0] != 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_closed_forms), cmocka_unit_test(test_powers),
                                     cmocka_unit_test(test_first_error), cmocka_unit_test(test_refuses)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
