/* SPDX-License-Identifier: MIT */
/* Fewer unknowns: T^T H T, T^T g and x0 + T y against dense products. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fair/reduce.h"
#include "support.h"

enum { ROWS = 6, COLUMNS = 4, N = 3 * ROWS, M = 3 * COLUMNS };

static const int32_t row_start[ROWS + 1] = {0, 1, 3, 3, 4, 6, 7}, column[7] = {0, 1, 2, 0, 3, 2, 3};
static const int64_t set_start[4] = {0, 3, 6, 8};
static const int32_t member[8] = {0, 1, FS_NONE, 1, 2, 4, 5, 3};

/* T[N][M] dense, and as a reduction with blocks or weights. */
static void make(fs_reduction *r, double T[N][M], bool has_blocks, uint64_t *seed) {
  static int32_t start[ROWS + 1], columns[7];
  static double block[7 * 9], weight[7], x0[N];
  memcpy(start, row_start, sizeof start);
  memcpy(columns, column, sizeof columns);
  memset(T, 0, sizeof(double[N][M]));
  for (int i = 0; i < N; i++) x0[i] = test_random_real(seed, -1, 1);
  for (int i = 0; i < ROWS; i++)
    for (int e = row_start[i]; e < row_start[i + 1]; e++) {
      weight[e] = test_random_real(seed, -1, 1);
      for (int k = 0; k < 9; k++) {
        block[9 * e + k] = test_random_real(seed, -1, 1);
        T[3 * i + k / 3][3 * column[e] + k % 3] = has_blocks ? block[9 * e + k] : k / 3 == k % 3 ? weight[e] : 0;
      }
    }
  *r = (fs_reduction){.n_rows = ROWS,
                      .n_columns = COLUMNS,
                      .row_start = start,
                      .column = columns,
                      .block = has_blocks ? block : NULL,
                      .weight = has_blocks ? NULL : weight,
                      .x0 = x0};
}

static void check_products(bool has_blocks, uint64_t seed) {
  fs_context ctx = test_context();
  fs_reduction r;
  fs_sparse *full = NULL, *reduced = NULL;
  double T[N][M], H[N][N], expected, y[M], Hy[M], x[N], Hx[N], gathered[M];
  make(&r, T, has_blocks, &seed);
  assert_int_equal(fs_sparse_create(&ctx, ROWS, 3, set_start, member, &full), FS_OK);
  assert_int_equal(fs_reduction_pattern(&ctx, &r, 3, set_start, member, &reduced), FS_OK);
  for (int32_t i = 0; i < 9 * full->col_start[ROWS]; i++) full->value[i] = test_random_real(&seed, -1, 1);
  for (int j = 0; j < N; j++) { /* dense columns of H */
    double unit[N] = {0}, product[N];
    unit[j] = 1;
    fs_sparse_multiply(full, unit, product);
    for (int i = 0; i < N; i++) H[i][j] = product[i];
  }
  for (int i = 0; i < M; i++) y[i] = test_random_real(&seed, -1, 1);
  fs_reduction_apply(&r, y, x);
  for (int i = 0; i < N; i++) {
    expected = r.x0[i];
    for (int j = 0; j < M; j++) expected += T[i][j] * y[j];
    assert_true(fabs(x[i] - expected) <= 1e-14);
    x[i] -= r.x0[i];
  }
  for (int i = 0; i < N; i++) {
    Hx[i] = 0;
    for (int j = 0; j < N; j++) Hx[i] += H[i][j] * x[j];
  }
  fs_reduction_gather(&r, Hx, gathered);
  assert_int_equal(fs_reduction_hessian(&ctx, &r, full, reduced), FS_OK);
  fs_sparse_multiply(reduced, y, Hy);
  for (int i = 0; i < M; i++) {
    expected = 0;
    for (int j = 0; j < N; j++) expected += T[j][i] * Hx[j];
    assert_true(fabs(gathered[i] - expected) <= 1e-14);
    assert_true(fabs(Hy[i] - expected) <= 1e-13);
  }
  fs_sparse_free(&ctx, full);
  fs_sparse_free(&ctx, reduced);
}

static void test_products(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed < 6; seed++) {
    check_products(true, seed);
    check_products(false, seed);
  }
}

/* Idle numbers get the mean of their group on the diagonal, and 1 where a whole group is idle. */
static void test_idle(void **state) {
  (void)state;
  fs_context ctx = test_context();
  int32_t start[2] = {0, 1}, columns[1] = {0}, one[1] = {0};
  int64_t set[2] = {0, 1};
  double block[9] = {1, 0, 0, 0, 1, 0, 0, 0, 0}, x0[3] = {0};
  bool is_idle[6] = {false, false, true, true, true, true};
  fs_reduction r = {.n_rows = 1, .n_columns = 2, .row_start = start, .column = columns, .block = block, .x0 = x0};
  fs_sparse *full = NULL, *reduced = NULL;
  r.is_idle = is_idle;
  assert_int_equal(fs_sparse_create(&ctx, 1, 1, set, one, &full), FS_OK);
  assert_int_equal(fs_reduction_pattern(&ctx, &r, 1, set, one, &reduced), FS_OK);
  for (int k = 0; k < 9; k++) full->value[k] = 1 + k % 4 * 2;
  assert_int_equal(fs_reduction_hessian(&ctx, &r, full, reduced), FS_OK);
  double mean = (full->value[0] + full->value[4]) / 2;
  assert_true(reduced->value[8] == mean);
  assert_true(reduced->value[9] == 1 && reduced->value[13] == 1 && reduced->value[17] == 1);
  fs_sparse_free(&ctx, full);
  fs_sparse_free(&ctx, reduced);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_products), cmocka_unit_test(test_idle)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
