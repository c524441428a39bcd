/* SPDX-License-Identifier: MIT */
/* Bernstein polynomials against powers of t, exact rational values and their defining data. */
#include "math/bernstein.h"
#include "../support/support.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

/* order-th derivative at t of the polynomial p [degree + 1][width], coordinate w */
static double evaluate(int degree, int width, const double *p, int w, double t, int order) {
  double basis[64], sum = 0;
  fs_bernstein_basis(degree, t, order, basis);
  for (int i = 0; i <= degree; i++) sum += basis[i] * p[i * width + w];
  return sum;
}

static void test_binomials(void **state) {
  (void)state;
  assert_true(fs_binomial(0, 0) == 1 && fs_binomial(9, 4) == 126 && fs_binomial(5, 6) == 0 && fs_binomial(5, -1) == 0);
  assert_true(fs_binomial(40, 20) == 137846528820.0);
  for (int n = 1; n <= 54; n++)
    for (int i = 1; i <= n; i++) assert_true(fs_binomial(n, i) == fs_binomial(n - 1, i) + fs_binomial(n - 1, i - 1));
}

/* B_i^n(t) = C(n,i) t^i (1-t)^(n-i); derivatives from those of lower degree by the formula for one basis function. */
static double basis_value(int n, int i, double t, int order) {
  if (i < 0 || i > n) return 0;
  if (order > 0) return n * (basis_value(n - 1, i - 1, t, order - 1) - basis_value(n - 1, i, t, order - 1));
  return fs_binomial(n, i) * pow(t, i) * pow(1 - t, n - i);
}

static void test_basis(void **state) {
  (void)state;
  for (int n = 0; n <= 12; n++)
    for (int order = 0; order <= 3; order++)
      for (int step = 0; step <= 16; step++) {
        double basis[13], t = step / 16.0;
        fs_bernstein_basis(n, t, order, basis);
        for (int i = 0; i <= n; i++) near(basis[i], basis_value(n, i, t, order), 1e-15 * pow(2 * n + 1, order));
      }
}

static void test_ends_are_exact(void **state) {
  (void)state;
  for (int n = 3; n <= 12; n++) {
    double basis[13];
    const double third[4] = {-1, 3, -3, 1};
    for (int order = 0; order <= 3; order++)
      for (int end = 0; end <= 1; end++) {
        double factor = 1;
        for (int i = 0; i < order; i++) factor *= n - i;
        fs_bernstein_basis(n, end, order, basis);
        for (int i = 0; i <= n; i++) {
          int from_end = end == 0 ? i : n - i; /* differences of the coefficients next to the end */
          double expected = from_end > order ? 0 : factor * fs_binomial(order, from_end);
          if (end == 0 && (order - from_end) % 2 != 0) expected = -expected;
          if (end == 1 && from_end % 2 != 0) expected = -expected;
          if (order == 3 && end == 0 && i < 4) assert_true(expected == factor * third[i]);
          assert_true(basis[i] == expected);
        }
      }
  }
}

static void test_arithmetic(void **state) {
  uint64_t random = 7;
  (void)state;
  for (int n = 0; n <= 6; n++)
    for (int m = 0; m <= 5; m++) {
      double a[7], b[18], product[36] = {0}, derivative[18], raised[36];
      for (int i = 0; i <= n; i++) a[i] = test_random_real(&random, -1, 1);
      for (int i = 0; i < 3 * m + 3; i++) b[i] = test_random_real(&random, -1, 1);
      fs_bernstein_add_product(n, a, m, 3, b, product);
      fs_bernstein_differentiate(m, 3, b, derivative);
      fs_bernstein_elevate(m, 3, b, m + n, raised);
      for (int w = 0; w < 3; w++)
        for (double t = 0; t <= 1; t += 0.125) {
          near(evaluate(n + m, 3, product, w, t, 0), evaluate(n, 1, a, 0, t, 0) * evaluate(m, 3, b, w, t, 0), 2e-15);
          near(evaluate(m > 0 ? m - 1 : 0, 3, derivative, w, t, 0), evaluate(m, 3, b, w, t, 1), 1e-14);
          near(evaluate(m + n, 3, raised, w, t, 0), evaluate(m, 3, b, w, t, 0), 1e-15);
        }
      fs_bernstein_differentiate(m, 3, b, b); /* in place */
      assert_memory_equal(b, derivative, (size_t)(m > 0 ? 3 * m : 3) * sizeof *b);
    }
}

static void test_hermite(void **state) {
  uint64_t random = 11;
  (void)state;
  for (int n0 = 1; n0 <= 5; n0++)
    for (int n1 = 0; n1 <= 3; n1++) {
      double at0[10], at1[6], p[16];
      for (int i = 0; i < 2 * n0; i++) at0[i] = test_random_real(&random, -1, 1);
      for (int i = 0; i < 2 * n1; i++) at1[i] = test_random_real(&random, -1, 1);
      fs_bernstein_hermite(2, n0, at0, n1, at1, p);
      for (int w = 0; w < 2; w++) {
        for (int d = 0; d < n0; d++) near(evaluate(n0 + n1 - 1, 2, p, w, 0, d), at0[2 * d + w], 1e-12);
        for (int d = 0; d < n1; d++) near(evaluate(n0 + n1 - 1, 2, p, w, 1, d), at1[2 * d + w], 1e-12);
      }
    }
  /* t^3 - 2 t: value 0, slope -2 at 0; value -1, slope 1 at 1 */
  const double at0[2] = {0, -2}, at1[2] = {-1, 1};
  double p[4];
  fs_bernstein_hermite(1, 2, at0, 2, at1, p);
  near(evaluate(3, 1, p, 0, 0.5, 0), -0.875, 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_binomials),  cmocka_unit_test(test_basis),   cmocka_unit_test(test_ends_are_exact),
      cmocka_unit_test(test_arithmetic), cmocka_unit_test(test_hermite),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
