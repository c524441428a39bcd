/* SPDX-License-Identifier: MIT */
/* Sparse block matrices, the solver behind its interface, and the minimiser on functions without geometry. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

#include "optimise/memory.h"
#include "optimise/minimise.h"
#include "support.h"

/* A band of n blocks coupled with the next two, as three-element sets. */
static fs_sparse *make_band(fs_context *ctx, int32_t n) {
  fs_sparse *a = NULL;
  int64_t start[64];
  int32_t member[3 * 64];
  for (int32_t i = 0; i <= n; i++) start[i] = 3 * i;
  for (int32_t i = 0; i < n; i++)
    for (int32_t k = 0; k < 3; k++) member[3 * i + k] = i + k < n ? i + k : FS_NONE;
  assert_int_equal(fs_sparse_create(ctx, n, n, start, member, &a), FS_OK);
  return a;
}

static void test_pattern(void **state) {
  fs_context ctx = test_context();
  fs_sparse *a = make_band(&ctx, 10);
  (void)state;
  for (int32_t j = 0; j < 10; j++) {
    int32_t n = a->col_start[j + 1] - a->col_start[j];
    assert_int_equal(n, j < 8 ? 3 : 10 - j);
    for (int32_t k = 0; k < n; k++) assert_int_equal(a->row[a->col_start[j] + k], j + k);
  }
  fs_sparse_free(&ctx, a);
}

static void fill_random(fs_sparse *a, uint64_t *seed, double diagonal) {
  fs_sparse_clear(a);
  for (int32_t j = 0; j < a->n_blocks; j++)
    for (int32_t k = a->col_start[j]; k < a->col_start[j + 1]; k++) {
      double block[9];
      for (int i = 0; i < 9; i++) block[i] = test_random_real(seed, -1, 1);
      if (a->row[k] == j)
        for (int i = 0; i < 3; i++)
          for (int c = 0; c <= i; c++) block[3 * i + c] = block[3 * c + i] = block[3 * i + c] + (i == c ? diagonal : 0);
      fs_sparse_add(a, a->row[k], j, block);
    }
}

static void test_solve(void **state) {
  fs_context ctx = test_context();
  fs_sparse *a = make_band(&ctx, 40);
  fs_solver *solver = NULL;
  double shift[40], x[120], b[120], y[120];
  uint64_t seed = 5;
  bool is_definite;
  (void)state;
  fill_random(a, &seed, 20);
  for (int i = 0; i < 40; i++) shift[i] = 0.1 * i;
  for (int i = 0; i < 120; i++) x[i] = test_random_real(&seed, -1, 1);
  fs_sparse_multiply(a, x, b);
  for (int i = 0; i < 120; i++) b[i] += shift[i / 3] * x[i];
  assert_int_equal(fs_solver_create(&ctx, a, &solver), FS_OK);
  for (int repeat = 0; repeat < 2; repeat++) {
    assert_int_equal(fs_solver_factor(&ctx, solver, a, shift, &is_definite), FS_OK);
    assert_true(is_definite);
    assert_int_equal(fs_solver_solve(&ctx, solver, b, y), FS_OK);
    for (int i = 0; i < 120; i++) assert_true(fabs(x[i] - y[i]) <= 1e-12);
    /* an indefinite matrix in between is said, and does no harm */
    shift[7] -= 100;
    assert_int_equal(fs_solver_factor(&ctx, solver, a, shift, &is_definite), FS_OK);
    assert_false(is_definite);
    shift[7] += 100;
  }
  fs_solver_free(&ctx, solver);
  fs_sparse_free(&ctx, a);
}

/* A + nu B + diag(shift) in one go against the sum made before. */
static void test_solve_sum(void **state) {
  fs_context ctx = test_context();
  fs_sparse *a = make_band(&ctx, 20), *b = make_band(&ctx, 20);
  fs_solver *solver = NULL;
  double shift[20], x[60], ax[60], bx[60], y[60];
  uint64_t seed = 8;
  bool is_definite;
  (void)state;
  fill_random(a, &seed, 20);
  fill_random(b, &seed, 30);
  for (int i = 0; i < 20; i++) shift[i] = 0.1 * i;
  for (int i = 0; i < 60; i++) x[i] = test_random_real(&seed, -1, 1);
  fs_sparse_multiply(a, x, ax);
  fs_sparse_multiply(b, x, bx);
  for (int i = 0; i < 60; i++) ax[i] += 0.7 * bx[i] + shift[i / 3] * x[i];
  assert_int_equal(fs_solver_create(&ctx, a, &solver), FS_OK);
  assert_int_equal(fs_solver_factor_sum(&ctx, solver, a, 0.7, b, shift, &is_definite), FS_OK);
  assert_true(is_definite);
  assert_int_equal(fs_solver_solve(&ctx, solver, ax, y), FS_OK);
  for (int i = 0; i < 60; i++) assert_true(fabs(x[i] - y[i]) <= 1e-12);
  assert_int_equal(fs_solver_factor_sum(&ctx, solver, a, -5, b, shift, &is_definite), FS_OK);
  assert_false(is_definite);
  fs_solver_free(&ctx, solver);
  fs_sparse_free(&ctx, a);
  fs_sparse_free(&ctx, b);
}

static void test_diagonal(void **state) {
  fs_context ctx = test_context();
  fs_sparse *a = make_band(&ctx, 3);
  double mean[3], block[9] = {1, 0, 0, 0, 2, 0, 0, 0, 6};
  (void)state;
  fs_sparse_add(a, 1, 1, block);
  fs_sparse_diagonal(a, mean);
  assert_true(mean[0] == 0 && mean[1] == 3 && mean[2] == 0);
  fs_sparse_free(&ctx, a);
}

/* Rosenbrock's function in three variables per group, chained: sum 100 (x_{i+1} - x_i^2)^2 + (1 - x_i)^2. */
static fs_status rosenbrock(const double *x, int32_t n, double *f, double *g, fs_sparse *h) {
  *f = 0;
  if (g != NULL) memset(g, 0, 3 * (size_t)n * sizeof *g);
  if (h != NULL) fs_sparse_clear(h);
  for (int32_t i = 0; i + 1 < 3 * n; i++) {
    double r = x[i + 1] - x[i] * x[i];
    *f += 100 * r * r + (1 - x[i]) * (1 - x[i]);
    if (g != NULL) {
      g[i] += -400 * r * x[i] - 2 * (1 - x[i]);
      g[i + 1] += 200 * r;
    }
    if (h == NULL) continue;
    double block[9] = {0};
    block[4 * (i % 3)] = -400 * r + 800 * x[i] * x[i] + 2;
    fs_sparse_add(h, i / 3, i / 3, block);
    memset(block, 0, sizeof block);
    block[4 * ((i + 1) % 3)] = 200;
    fs_sparse_add(h, (i + 1) / 3, (i + 1) / 3, block);
    memset(block, 0, sizeof block);
    block[3 * ((i + 1) % 3) + i % 3] = -400 * x[i];
    if (i / 3 == (i + 1) / 3) block[3 * (i % 3) + (i + 1) % 3] = -400 * x[i];
    fs_sparse_add(h, (i + 1) / 3, i / 3, block);
  }
  return FS_OK;
}
enum { GROUPS = 5 };
static fs_status r_gradient(void *self, const double *x, double *f, double *g) {
  return (void)self, rosenbrock(x, GROUPS, f, g, NULL);
}
static fs_status r_hessian(void *self, const double *x, double *f, double *g, fs_sparse *h) {
  return (void)self, rosenbrock(x, GROUPS, f, g, h);
}

static bool count_and_cancel(void *user, const fs_minimise_step *step) {
  int *left = user;
  (void)step;
  return --*left > 0;
}

/* A metric that is blind to the first group, where the function may be indefinite: the diagonal helps. */
static fs_status r_metric(void *self, const double *x, const fs_sparse **metric) {
  return (void)x, *metric = self, FS_OK;
}

static void test_metric(void **state) {
  fs_context ctx = test_context();
  fs_sparse *pattern = make_band(&ctx, GROUPS), *metric = make_band(&ctx, GROUPS);
  const double block[9] = {200, 0, 0, 0, 200, 0, 0, 0, 200};
  double x[3 * GROUPS];
  fs_objective objective = {.n = GROUPS,
                            .pattern = pattern,
                            .self = metric,
                            .gradient = r_gradient,
                            .hessian = r_hessian,
                            .metric = r_metric};
  fs_damping damping = {.nu = 1};
  fs_minimise_options options = {
      .max_iterations = 200, .gradient_tolerance = 1e-10, .decrease_tolerance = 1e-12, .damping = &damping};
  fs_minimise_report report;
  (void)state;
  for (int32_t i = 1; i < GROUPS; i++) fs_sparse_add(metric, i, i, block);
  assert_int_equal(fs_solver_create(&ctx, pattern, &objective.solver), FS_OK);
  for (int i = 0; i < 3 * GROUPS; i++) x[i] = i % 2 == 0 ? -1.2 : 1;
  assert_int_equal(fs_minimise(&ctx, &objective, &options, x, &report), FS_OK);
  assert_true(report.stop == FS_MINIMISE_GRADIENT || report.stop == FS_MINIMISE_DECREASE);
  assert_true(report.n_hessians < 100 && report.gradient < 1e-6);
  for (int i = 0; i < 3 * GROUPS; i++) assert_true(fabs(fabs(x[i]) - 1) < 1e-2);
  assert_true(damping.nu == 0); /* Newton steps in the end */
  fs_solver_free(&ctx, objective.solver);
  fs_sparse_free(&ctx, pattern);
  fs_sparse_free(&ctx, metric);
}

static void test_rosenbrock(void **state) {
  fs_context ctx = test_context();
  fs_sparse *pattern = make_band(&ctx, GROUPS);
  double x[3 * GROUPS], f_start, f_end;
  fs_objective objective = {.n = GROUPS, .pattern = pattern, .gradient = r_gradient, .hessian = r_hessian};
  fs_damping damping = {.nu = 1};
  fs_minimise_options options = {
      .max_iterations = 200, .gradient_tolerance = 1e-10, .decrease_tolerance = 1e-12, .damping = &damping};
  fs_minimise_report report;
  int left = 4;
  (void)state;
  assert_int_equal(fs_solver_create(&ctx, pattern, &objective.solver), FS_OK);
  for (int i = 0; i < 3 * GROUPS; i++) x[i] = i % 2 == 0 ? -1.2 : 1;
  assert_int_equal(fs_minimise(&ctx, &objective, &options, x, &report), FS_OK);
  assert_true(report.stop == FS_MINIMISE_GRADIENT || report.stop == FS_MINIMISE_DECREASE);
  assert_true(report.n_hessians < 100);
  rosenbrock(x, GROUPS, &f_end, NULL, NULL);
  assert_true(report.gradient < 1e-6);
  for (int i = 0; i < 3 * GROUPS; i++) assert_true(fabs(fabs(x[i]) - 1) < 1e-2); /* the minimum, or its one companion */

  /* cancelled: the best point so far */
  for (int i = 0; i < 3 * GROUPS; i++) x[i] = i % 2 == 0 ? -1.2 : 1;
  rosenbrock(x, GROUPS, &f_start, NULL, NULL);
  options.monitor = count_and_cancel;
  options.user = &left;
  assert_int_equal(fs_minimise(&ctx, &objective, &options, x, &report), FS_OK);
  assert_int_equal(report.stop, FS_MINIMISE_CANCELLED);
  rosenbrock(x, GROUPS, &f_end, NULL, NULL);
  assert_true(f_end < f_start && f_end == report.value);

  /* the limit of steps */
  options.monitor = NULL;
  options.max_iterations = 2;
  assert_int_equal(fs_minimise(&ctx, &objective, &options, x, &report), FS_OK);
  assert_int_equal(report.stop, FS_MINIMISE_ITERATIONS);
  assert_int_equal(report.n_steps, 2);
  fs_solver_free(&ctx, objective.solver);
  fs_sparse_free(&ctx, pattern);
}

/* On a quadratic function, steps with exact pairs make B exact on the newest pair, and exact everywhere in the end. */
static void test_memory(void **state) {
  enum { N = 5 };
  fs_context ctx = test_context();
  fs_memory memory = {.n = N};
  static const double H[N] = {1, 3, 10, 0.2, 30};
  double zero[N] = {0}, alpha[FS_MEMORY_PAIRS];
  (void)state;
  for (int i = 0; i < N + 6; i++) { /* more pairs than it holds */
    double s[N] = {0}, y[N], d[N];
    s[i % N] = 1 + 0.1 * i;
    for (int k = 0; k < N; k++) d[k] = y[k] = H[k] * s[k];
    assert_int_equal(fs_memory_add(&ctx, &memory, s, zero, y), FS_OK);
    fs_memory_before(&memory, d, alpha);
    fs_memory_after(&memory, d, alpha); /* K the unit matrix */
    for (int k = 0; k < N; k++) assert_true(fabs(d[k] - s[k]) <= 1e-14);
  }
  for (int k = 0; k < N; k++) {
    double d[N] = {0};
    d[k] = H[k];
    fs_memory_before(&memory, d, alpha);
    fs_memory_after(&memory, d, alpha);
    for (int j = 0; j < N; j++) assert_true(fabs(d[j] - (j == k)) <= 1e-14);
  }
  double s[N] = {1}, y[N] = {-1};
  int32_t n_pairs = memory.n_pairs;
  assert_int_equal(fs_memory_add(&ctx, &memory, s, zero, y), FS_OK); /* negative curvature */
  assert_true(memory.n_pairs < n_pairs || memory.n_pairs == FS_MEMORY_PAIRS - 1);
  fs_memory_release(&ctx, &memory);
}

/* f = sum of 1 + (x_0^2 + x_1^2) / 2 + x_2^4 / 4 - x_2^2 / 2 in every group, coupled by nothing: a saddle where all x_2 = 0, minima
   where all are -1 or 1, of value 3/4 a group. */
static fs_status double_well(const double *x, double *f, double *g, fs_sparse *h) {
  *f = 0;
  if (h != NULL) fs_sparse_clear(h);
  for (int32_t i = 0; i < GROUPS; i++) {
    const double *p = x + 3 * i;
    double block[9] = {1, 0, 0, 0, 1, 0, 0, 0, 3 * p[2] * p[2] - 1};
    *f += 1 + (p[0] * p[0] + p[1] * p[1]) / 2 + p[2] * p[2] * (p[2] * p[2] / 4 - 0.5);
    g[3 * i] = p[0];
    g[3 * i + 1] = p[1];
    g[3 * i + 2] = p[2] * (p[2] * p[2] - 1);
    if (h != NULL) fs_sparse_add(h, i, i, block);
  }
  return FS_OK;
}
static fs_status w_gradient(void *self, const double *x, double *f, double *g) {
  return (void)self, double_well(x, f, g, NULL);
}
static fs_status w_hessian(void *self, const double *x, double *f, double *g, fs_sparse *h) {
  return (void)self, double_well(x, f, g, h);
}

static void test_saddle(void **state) {
  fs_context ctx = test_context();
  fs_sparse *pattern = make_band(&ctx, GROUPS);
  fs_objective objective = {.n = GROUPS, .pattern = pattern, .gradient = w_gradient, .hessian = w_hessian};
  fs_damping damping = {.nu = 1};
  fs_minimise_options options = {.max_iterations = 100, .decrease_tolerance = 1e-14, .damping = &damping};
  fs_minimise_report report;
  fs_saddle_report saddle;
  double x[3 * GROUPS], kept[3 * GROUPS], f, g[3 * GROUPS];
  int n_left = 0;
  (void)state;
  for (int i = 0; i < 3 * GROUPS; i++) x[i] = i % 3 == 2 ? 0 : 0.5;
  assert_int_equal(fs_solver_create(&ctx, pattern, &objective.solver), FS_OK);
  while (true) { /* steps alone end at the saddle; each time some of the wells are found */
    damping.is_factored = false;
    assert_int_equal(fs_minimise(&ctx, &objective, &options, x, &report), FS_OK);
    memcpy(kept, x, sizeof kept);
    assert_int_equal(fs_leave_saddle(&ctx, &objective, &damping.nu, x, &saddle), FS_OK);
    if (!saddle.has_moved) break;
    assert_true(saddle.curvature < 0 && saddle.decrease > 0);
    n_left++;
    assert_true(n_left <= GROUPS);
  }
  assert_true(n_left >= 1);
  assert_memory_equal(x, kept, sizeof x);
  assert_int_equal(double_well(x, &f, g, NULL), FS_OK);
  assert_true(fabs(f - 0.75 * GROUPS) <= 1e-12);
  fs_solver_free(&ctx, objective.solver);
  fs_sparse_free(&ctx, pattern);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_pattern),    cmocka_unit_test(test_solve),  cmocka_unit_test(test_solve_sum),
      cmocka_unit_test(test_diagonal),   cmocka_unit_test(test_saddle), cmocka_unit_test(test_metric),
      cmocka_unit_test(test_rosenbrock), cmocka_unit_test(test_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
