/* SPDX-License-Identifier: MIT */
/* Dense algebra against its definitions on random matrices, exact small cases, and every failure. */
#include "math/dense.h"
#include "../support/support.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

enum { SIZE = 130, WIDTH = 9, STRIDE = 137 };

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

static double A[SIZE * STRIDE], C[SIZE * STRIDE], R[SIZE * STRIDE], B[SIZE * STRIDE], X[SIZE * STRIDE];

static void fill(double *matrix, int n, uint64_t seed) {
  for (int i = 0; i < n; i++) matrix[i] = test_random_real(&seed, -1, 1);
}

static void test_gram(void **state) {
  static const int sizes[][2] = {{1, 1}, {3, 2}, {64, 8}, {65, 12}, {129, 37}, {130, 130}};
  (void)state;
  for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
    int rows = sizes[s][0], n = sizes[s][1];
    fill(A, SIZE * STRIDE, 1);
    fill(C, SIZE * STRIDE, 2);
    memcpy(X, C, sizeof C);
    fs_dense_add_gram(rows, n, A, STRIDE, -1, C, STRIDE);
    for (int i = 0; i < n; i++)
      for (int j = i; j < n; j++) {
        double sum = X[i * STRIDE + j];
        for (int r = 0; r < rows; r++) sum -= A[r * STRIDE + i] * A[r * STRIDE + j];
        near(C[i * STRIDE + j], sum, 1e-13);
      }
    for (int i = 0; i < SIZE; i++) assert_true(C[i * STRIDE + n] == X[i * STRIDE + n]); /* nothing beyond */
    fs_dense_mirror(n, C, STRIDE);
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++) assert_true(C[i * STRIDE + j] == C[j * STRIDE + i]);
  }
}

static void test_products(void **state) {
  enum { ROWS = 7, INNER = 5, COLUMNS = 11 };
  (void)state;
  fill(A, SIZE * STRIDE, 3);
  fill(B, SIZE * STRIDE, 4);
  memset(C, 0, sizeof C);
  memset(R, 0, sizeof R);
  fs_dense_add_product(ROWS, INNER, COLUMNS, 2, A, STRIDE, B, STRIDE, C, STRIDE);
  fs_dense_add_product_transposed(ROWS, INNER, COLUMNS, 2, A, STRIDE, B, STRIDE, R, STRIDE);
  for (int i = 0; i < ROWS; i++)
    for (int j = 0; j < COLUMNS; j++) {
      double plain = 0, transposed = 0;
      for (int l = 0; l < INNER; l++) {
        plain += 2 * A[i * STRIDE + l] * B[l * STRIDE + j];
        transposed += 2 * A[l * STRIDE + i] * B[l * STRIDE + j];
      }
      near(C[i * STRIDE + j], plain, 1e-14);
      near(R[i * STRIDE + j], transposed, 1e-14);
    }
}

/* A = Q^T Q + I with random Q; R^T R = A, and A X = B. */
static void test_cholesky(void **state) {
  static const int sizes[] = {1, 2, 5, 47, 48, 49, 97, 130};
  fs_context ctx = test_context();
  (void)state;
  for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
    int n = sizes[s];
    fill(C, SIZE * STRIDE, 5);
    memset(A, 0, sizeof A);
    for (int i = 0; i < n; i++) A[i * STRIDE + i] = 1;
    fs_dense_add_gram(n, n, C, STRIDE, 1, A, STRIDE);
    fs_dense_mirror(n, A, STRIDE);
    memcpy(R, A, sizeof A);
    for (int i = 0; i < n; i++)
      for (int j = 0; j < i; j++) R[i * STRIDE + j] = NAN; /* must not be read */
    assert_int_equal(fs_dense_cholesky(&ctx, n, R, STRIDE), FS_OK);
    for (int i = 0; i < n; i++)
      for (int j = i; j < n; j++) {
        double sum = 0;
        for (int l = 0; l <= i; l++) sum += R[l * STRIDE + i] * R[l * STRIDE + j];
        near(sum, A[i * STRIDE + j], 1e-13);
      }
    fill(B, SIZE * STRIDE, 6);
    memcpy(X, B, sizeof B);
    fs_dense_solve_transposed(n, R, STRIDE, WIDTH, X, STRIDE);
    fs_dense_solve_upper(n, R, STRIDE, WIDTH, X, STRIDE);
    fs_dense_add_product(n, n, WIDTH, -1, A, STRIDE, X, STRIDE, B, STRIDE);
    for (int i = 0; i < n; i++)
      for (int w = 0; w < WIDTH; w++) near(B[i * STRIDE + w], 0, 1e-12);
  }
}

static void test_cholesky_refuses(void **state) {
  fs_context ctx = test_context();
  double singular[4] = {1, 2, 2, 4}, indefinite[4] = {1, 2, 2, 3}, broken[4] = {1, 0, 0, NAN};
  (void)state;
  assert_int_equal(fs_dense_cholesky(&ctx, 2, singular, 2), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "row 1"));
  assert_int_equal(fs_dense_cholesky(&ctx, 2, indefinite, 2), FS_ERR_NUMERIC);
  assert_int_equal(fs_dense_cholesky(&ctx, 2, broken, 2), FS_ERR_NUMERIC);
}

/* Products of random factors have the rank of their inner size. */
static void test_null_space(void **state) {
  enum { ROWS = 5, COLUMNS = 12 };
  fs_context ctx = test_context();
  (void)state;
  for (int rank = 0; rank <= ROWS; rank++) {
    double left[ROWS * ROWS], right[ROWS * COLUMNS], matrix[ROWS * COLUMNS] = {0}, basis[COLUMNS * COLUMNS];
    int n = COLUMNS - rank;
    fill(left, ROWS * ROWS, 8);
    fill(right, ROWS * COLUMNS, 9);
    fs_dense_add_product(ROWS, rank, COLUMNS, 1, left, ROWS, right, COLUMNS, matrix, COLUMNS);
    assert_int_equal(fs_dense_null_space(&ctx, ROWS, COLUMNS, matrix, rank, basis), FS_OK);
    for (int i = 0; i < n; i++) {
      for (int j = 0; j < n; j++) {
        double sum = 0;
        for (int l = 0; l < COLUMNS; l++) sum += basis[i * COLUMNS + l] * basis[j * COLUMNS + l];
        near(sum, i == j, 2e-15);
      }
      for (int row = 0; row < ROWS; row++) {
        double sum = 0;
        for (int l = 0; l < COLUMNS; l++) sum += matrix[row * COLUMNS + l] * basis[i * COLUMNS + l];
        near(sum, 0, 3e-15);
      }
    }
    if (rank < ROWS)
      assert_int_equal(fs_dense_null_space(&ctx, ROWS, COLUMNS, matrix, rank + 1, basis), FS_ERR_NUMERIC);
    if (rank > 0) assert_int_equal(fs_dense_null_space(&ctx, ROWS, COLUMNS, matrix, rank - 1, basis), FS_ERR_NUMERIC);
  }
}

static void test_null_space_of_square(void **state) {
  fs_context ctx = test_context();
  double regular[4] = {1, 2, 3, 4}, tall[6] = {1, 1, 2, 2, 3, 3}, basis[4];
  (void)state;
  assert_int_equal(fs_dense_null_space(&ctx, 2, 2, regular, 2, basis), FS_OK); /* empty */
  assert_int_equal(fs_dense_null_space(&ctx, 3, 2, tall, 1, basis), FS_OK);
  near(basis[0] + basis[1], 0, 1e-15);
  near(fabs(basis[0]), sqrt(0.5), 1e-15);
  assert_int_equal(fs_dense_null_space(&ctx, 2, 2, regular, 3, basis), FS_ERR_ARGUMENT);
}

static void test_null_space_memory(void **state) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  double matrix[2] = {1, 1}, basis[2];
  (void)state;
  for (memory.fail_at = 1; memory.fail_at <= 2; memory.fail_at++) {
    memory.n_allocations = 0;
    assert_int_equal(fs_dense_null_space(&ctx, 1, 2, matrix, 1, basis), FS_ERR_MEMORY);
    assert_int_equal(memory.n_live, 0);
  }
  memory.n_allocations = 0;
  assert_int_equal(fs_dense_null_space(&ctx, 1, 2, matrix, 1, basis), FS_OK);
  assert_int_equal(memory.n_live, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_gram),
      cmocka_unit_test(test_products),
      cmocka_unit_test(test_cholesky),
      cmocka_unit_test(test_cholesky_refuses),
      cmocka_unit_test(test_null_space),
      cmocka_unit_test(test_null_space_of_square),
      cmocka_unit_test(test_null_space_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
