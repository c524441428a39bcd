/* SPDX-License-Identifier: MIT */
/* What is integrated over surfaces, against the geometry of one point and plain sums, for every instruction set. */
#include "analyse/analyse.h"
#include "math/diffgeo.h"
#include "math/vec3.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

enum { N = 8, N_POINTS = N * N, SINGULAR = 13 };

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

/* jets[10][3][N_POINTS]; of one point p_u and p_v are parallel, all others are far from it. */
static void make_jets(double *jets) {
  uint64_t seed = 21;
  for (int k = 0; k < 3 * FS_JET_SIZE * N_POINTS; k++) jets[k] = test_random_real(&seed, -1, 1);
  for (int i = 0; i < N_POINTS; i++) {
    double *u = jets + 3 * FS_DU * N_POINTS + i, *v = jets + 3 * FS_DV * N_POINTS + i;
    u[0] += 3, v[N_POINTS] += 3;
    for (int c = 0; c < 3 && i == SINGULAR; c++) v[c * N_POINTS] = 2 * u[c * N_POINTS];
  }
}

static void test_points(void **state) {
  static double jets[3 * FS_JET_SIZE * N_POINTS], at[FS_AT_N * N_POINTS];
  const fs_integrand_kernels *all[3];
  int32_t n_kernels = fs_integrand_kernels_all(all);
  (void)state;
  make_jets(jets);
  assert_true(n_kernels >= 1);
  for (int32_t set = 0; set < n_kernels; set++) {
    all[set]->at_points(N_POINTS, jets, at);
    for (int i = 0; i < N_POINTS; i++) {
      fs_vec3 x[FS_JET_SIZE];
      fs_geometry g;
      fs_principal principal;
      for (int k = 0; k < 3 * FS_JET_SIZE; k++) (&x[k / 3].x)[k % 3] = jets[k * N_POINTS + i];
      near(at[FS_AT_AREA * N_POINTS + i], fs_vec3_length(fs_vec3_cross(x[FS_DU], x[FS_DV])), 1e-14);
      near(at[FS_AT_VOLUME * N_POINTS + i], fs_vec3_dot(x[FS_D], fs_vec3_cross(x[FS_DU], x[FS_DV])) / 3, 1e-14 * 10);
      if (i == SINGULAR) {
        for (int k = FS_AT_H; k < FS_AT_N; k++) assert_true(isnan(at[k * N_POINTS + i]));
        continue;
      }
      assert_true(fs_geometry_compute(x, &g));
      fs_geometry_principal(&g, &principal);
      near(at[FS_AT_H * N_POINTS + i], g.H, 1e-14);
      near(at[FS_AT_K * N_POINTS + i], g.K, 1e-14);
      near(at[FS_AT_GRADIENT * N_POINTS + i], fs_vec3_length(fs_geometry_mean_gradient(x, &g)), 1e-14);
      near(at[FS_AT_MAXIMUM * N_POINTS + i], principal.maximum, 1e-14);
      near(at[FS_AT_MINIMUM * N_POINTS + i], principal.minimum, 1e-14);
    }
  }
}

static void test_sums(void **state) {
  static double jets[3 * FS_JET_SIZE * N_POINTS], at[FS_AT_N * N_POINTS];
  const fs_integrand_kernels *all[3];
  int32_t n_kernels = fs_integrand_kernels_all(all);
  double weight[N], scale[N];
  (void)state;
  make_jets(jets);
  for (int i = 0; i < N; i++) weight[i] = 0.1 + 0.01 * i, scale[i] = 1 - 0.05 * i;
  for (int32_t set = 0; set < n_kernels; set++) {
    double integral[FS_N_INTEGRALS] = {0}, size[FS_N_INTEGRALS] = {0}, by_a[FS_N_INTEGRALS][N] = {{0}},
           by_b[FS_N_INTEGRALS][N] = {{0}};
    fs_cell_sums sums;
    all[set]->at_points(N_POINTS, jets, at);
    all[set]->add_up(N, weight, scale, at, &sums);
    for (int p = 0; p < N_POINTS; p++) {
      double H = at[FS_AT_H * N_POINTS + p], gradient = at[FS_AT_GRADIENT * N_POINTS + p];
      double area = at[FS_AT_AREA * N_POINTS + p] * scale[p % N];
      double f[FS_N_INTEGRALS] = {[FS_AREA] = area,
                                  [FS_VOLUME] = at[FS_AT_VOLUME * N_POINTS + p] * scale[p % N],
                                  [FS_WILLMORE] = p == SINGULAR ? 0 : H * H * area,
                                  [FS_S] = p == SINGULAR ? 0 : gradient * gradient * area};
      for (int k = 0; k < FS_N_INTEGRALS; k++) {
        integral[k] += weight[p % N] * weight[p / N] * f[k];
        size[k] += weight[p % N] * weight[p / N] * fabs(f[k]);
        by_a[k][p % N] += weight[p / N] * f[k];
        by_b[k][p / N] += weight[p % N] * f[k];
      }
    }
    for (int k = 0; k < FS_N_INTEGRALS; k++) {
      near(sums.integral[k], integral[k], 1e-12);
      near(sums.size[k], size[k], 1e-12);
      for (int i = 0; i < N; i++) near(sums.by_a[k][i], by_a[k][i], 1e-12), near(sums.by_b[k][i], by_b[k][i], 1e-12);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_points), cmocka_unit_test(test_sums)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
