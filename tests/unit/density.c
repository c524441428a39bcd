/* SPDX-License-Identifier: MIT */
/* The integrands: exact integrals, derivatives against differences, agreement of all kernel sets. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

#include "fair/kernels.h"
#include "math/quadrature.h"
#include "support.h"

enum { N = 9, B = FS_BLOCK, NODES = 40 };

typedef void jet_function(const double *shape, double u, double v, double jet[N][3]);

/* Integral of f over a rectangle by NODES x NODES Gauss nodes, from analytic jets. */
static double integrate(const fs_density *density, jet_function *jet, const double *shape, double u1, double v1) {
  fs_context ctx = test_context();
  double node[NODES], weight[NODES], x[N * 3 * B], f[B], point[N][3], sum = 0;
  assert_int_equal(fs_gauss_legendre(&ctx, NODES, node, weight), FS_OK);
  for (int i = 0; i < NODES; i++)
    for (int j = 0; j < NODES; j += B) {
      for (int l = 0; l < B; l++) {
        jet(shape, u1 * node[i], v1 * node[j + l], point);
        for (int d = 0; d < N; d++)
          for (int a = 0; a < 3; a++) x[(3 * d + a) * B + l] = point[d][a];
      }
      density->evaluate(x, f, NULL, NULL);
      for (int l = 0; l < B; l++) sum += u1 * v1 * weight[i] * weight[j + l] * f[l];
    }
  return sum;
}

/* z = sum of c_ij x^i y^j as a graph; shape[4][4] = c. */
static double monomial(int power, int order, double x) {
  double factor = 1;
  for (int k = 0; k < order; k++) factor *= power - k;
  return power < order ? 0 : factor * pow(x, power - order);
}
static void graph_jet(const double *shape, double u, double v, double jet[N][3]) {
  static const int order_u[N] = {1, 0, 2, 1, 0, 3, 2, 1, 0}, order_v[N] = {0, 1, 0, 1, 2, 0, 1, 2, 3};
  memset(jet, 0, sizeof(double[N][3]));
  jet[0][0] = jet[1][1] = 1;
  for (int d = 0; d < N; d++)
    for (int i = 0; i < 4; i++)
      for (int j = 0; j < 4; j++)
        jet[d][2] += shape[4 * i + j] * monomial(i, order_u[d], u) * monomial(j, order_v[d], v);
}

/* Torus with radii shape[0] > shape[1], u around the axis. */
static void torus_jet(const double *shape, double u, double v, double jet[N][3]) {
  double R = shape[0], r = shape[1], q = R + r * cos(v), q1 = -r * sin(v), q2 = -r * cos(v), q3 = r * sin(v);
  double c = cos(u), s = sin(u);
  double value[N][3] = {{-q * s, q * c, 0},    {q1 * c, q1 * s, r * cos(v)},  {-q * c, -q * s, 0},
                        {-q1 * s, q1 * c, 0},  {q2 * c, q2 * s, -r * sin(v)}, {q * s, -q * c, 0},
                        {-q1 * c, -q1 * s, 0}, {-q2 * s, q2 * c, 0},          {q3 * c, q3 * s, -r * cos(v)}};
  memcpy(jet, value, sizeof value);
}

/* Values of S by 60 to 80 point quadrature of exact derivatives, independent of this library. */
static void test_graphs(void **state) {
  (void)state;
  static const struct {
    double shape[16], S;
  } graph[] = {
      {{[5] = 1}, 0.05818831883894},               /* x y */
      {{[2] = 0.5, [8] = 0.5}, 0.2075662456293},   /* (x^2 + y^2) / 2 */
      {{[2] = -0.5, [8] = 0.5}, 0.06765808515898}, /* (x^2 - y^2) / 2 */
      {{[12] = 1}, 3.091739546388},                /* x^3 */
      {{[9] = 1}, 0.8794643847793},                /* x^2 y */
      {{[15] = 1}, 2.945106176589},                /* x^3 y^3 */
  };
  for (size_t i = 0; i < sizeof graph / sizeof graph[0]; i++) {
    double S = integrate(&fs_density_curvature_variation, graph_jet, graph[i].shape, 1, 1);
    assert_true(fabs(S - graph[i].S) <= 1e-10 * graph[i].S);
  }
}

/* S = pi^2 R^2 / (2 r (R^2 - r^2)^(3/2)) */
static void test_tori(void **state) {
  (void)state;
  const double pi = acos(-1.0), R[3] = {sqrt(2.0), 2, 3};
  for (int i = 0; i < 3; i++) {
    double shape[2] = {R[i], 1}, exact = pi * pi * R[i] * R[i] / (2 * pow(R[i] * R[i] - 1, 1.5)), S;
    S = 2 * integrate(&fs_density_curvature_variation, torus_jet, shape, 2 * pi, pi);
    assert_true(fabs(S - exact) <= 1e-10 * exact);
  }
}

static void random_jets(uint64_t *seed, double *x) {
  for (int i = 0; i < N * 3 * B; i++) x[i] = test_random_real(seed, -0.5, 0.5);
  for (int l = 0; l < B; l++) {
    x[0 * B + l] += 1; /* p_u and p_v stay independent */
    x[4 * B + l] += 1;
  }
}

static int pair(int i, int j) { return i * N - i * (i - 1) / 2 + j - i; }

static void check_derivatives(fs_density_kernel *evaluate) {
  static double x[N * 3 * B], f[B], df[N * 3 * B], ddf[45 * 9 * B], f0[B], f1[B], df0[N * 3 * B], df1[N * 3 * B];
  uint64_t seed = 7;
  const double h = 1e-5;
  random_jets(&seed, x);
  evaluate(x, f, df, ddf);
  evaluate(x, f0, NULL, NULL);
  assert_memory_equal(f, f0, sizeof f);
  for (int i = 0; i < 3 * N; i++) {
    double keep[B];
    memcpy(keep, x + i * B, sizeof keep);
    for (int l = 0; l < B; l++) x[i * B + l] = keep[l] + h;
    evaluate(x, f1, df1, NULL);
    for (int l = 0; l < B; l++) x[i * B + l] = keep[l] - h;
    evaluate(x, f0, df0, NULL);
    memcpy(x + i * B, keep, sizeof keep);
    for (int l = 0; l < B; l++) {
      assert_true(fabs((f1[l] - f0[l]) / (2 * h) - df[i * B + l]) <= 1e-7 * 6);
      for (int j = 0; j < 3 * N; j++) {
        int a = i / 3 <= j / 3 ? i : j, b = i / 3 <= j / 3 ? j : i;
        double second = ddf[(pair(a / 3, b / 3) * 9 + 3 * (a % 3) + b % 3) * B + l];
        assert_true(fabs((df1[j * B + l] - df0[j * B + l]) / (2 * h) - second) <= 1e-7 * 30);
      }
    }
  }
}

static void test_derivatives(void **state) {
  const fs_kernels *all[4];
  int32_t n = fs_kernels_all(all);
  (void)state;
  for (int32_t i = 0; i < n; i++) {
    check_derivatives(all[i]->curvature_variation);
    check_derivatives(all[i]->tangential);
    check_derivatives(all[i]->triharmonic);
  }
}

/* With normals held Q is a quadratic form in the third derivatives: x H x / 2 = g x / 2 = Q, H nowhere negative, and g that part of
   the gradient of Q. */
static void check_held(const fs_kernels *k) {
  static double x[N * 3 * B], f[2][B], df[2][N * 3 * B], ddf[45 * 9 * B];
  uint64_t seed = 17;
  random_jets(&seed, x);
  k->tangential(x, f[0], df[0], NULL);
  k->tangential_held(x, f[1], df[1], ddf);
  for (int l = 0; l < B; l++) {
    double y[3 * N], Hx = 0, yHy = 0;
    for (int i = 0; i < 3 * N; i++) {
      bool is_third = i / 3 >= 5;
      double expected = is_third ? df[0][i * B + l] : 0;
      assert_true(fabs(df[1][i * B + l] - expected) <= 1e-12 * (1 + fabs(expected)));
      y[i] = test_random_real(&seed, -1, 1);
    }
    for (int i = 0; i < 3 * N; i++) {
      Hx = 0;
      for (int j = 0; j < 3 * N; j++) {
        int a = i / 3 <= j / 3 ? i : j, b = i / 3 <= j / 3 ? j : i;
        double second = ddf[(pair(a / 3, b / 3) * 9 + 3 * (a % 3) + b % 3) * B + l];
        Hx += second * x[j * B + l];
        yHy += y[i] * second * y[j];
      }
      assert_true(fabs(Hx - df[1][i * B + l]) <= 1e-12 * (1 + fabs(Hx)));
    }
    assert_true(yHy >= 0);
    assert_true(fabs(f[1][l] - f[0][l]) <= 1e-13 * (1 + f[0][l]));
  }
}

static void test_held(void **state) {
  const fs_kernels *all[4];
  int32_t n = fs_kernels_all(all);
  (void)state;
  for (int32_t i = 0; i < n; i++) check_held(all[i]);
}

/* Sums of densities against the densities, with fewer points than a block holds too. */
static void check_sum(fs_sum_kernel *first, fs_density_kernel *a, fs_sum_kernel *second, fs_density_kernel *b, int n) {
  static double x[N * 3 * B], f[3][B], df[3][N * 3 * B], ddf[3][45 * 9 * B];
  const double scale[B] = {1, 0.5, 2, 3, 0.25, 7, 1.5, 0.1};
  uint64_t seed = 11;
  random_jets(&seed, x);
  memset(df[0], 255, sizeof df[0]); /* not numbers */
  memset(ddf[0], 255, sizeof ddf[0]);
  a(x, f[1], df[1], ddf[1]);
  b(x, f[2], df[2], ddf[2]);
  first(x, scale, n, true, f[0], df[0], ddf[0]);
  for (int l = 0; l < n; l++) assert_true(f[0][l] == f[1][l]);
  second(x, scale, n, false, f[0], df[0], ddf[0]);
  for (int l = 0; l < n; l++) assert_true(f[0][l] == f[2][l]);
  for (int i = 0; i < N * 3 * B; i++) {
    double expected = scale[i % B] * (df[1][i] + df[2][i]);
    assert_true(i % B >= n ? isfinite(df[0][i]) : fabs(df[0][i] - expected) <= 1e-13 * (1 + fabs(expected)));
  }
  for (int i = 0; i < 45 * 9 * B; i++) {
    double expected = scale[i % B] * (ddf[1][i] + ddf[2][i]);
    assert_true(i % B >= n ? isfinite(ddf[0][i]) : fabs(ddf[0][i] - expected) <= 1e-13 * (1 + fabs(expected)));
  }
}

static void test_sums(void **state) {
  const fs_kernels *all[4];
  int32_t n_sets = fs_kernels_all(all);
  (void)state;
  for (int32_t i = 0; i < n_sets; i++)
    for (int n = 1; n <= B; n++) {
      const fs_kernels *k = all[i];
      check_sum(k->sum_curvature_variation, k->curvature_variation, k->sum_tangential, k->tangential, n);
      check_sum(k->sum_tangential, k->tangential, k->sum_triharmonic, k->triharmonic, n);
      check_sum(k->sum_triharmonic, k->triharmonic, k->sum_curvature_variation, k->curvature_variation, n);
      check_sum(k->sum_tangential_held, k->tangential_held, k->sum_triharmonic, k->triharmonic, n);
    }
}

/* Q by its definition: |a|^2 + |b|^2 - (n.a)^2 - (n.b)^2 with the unit normal. */
static void test_tangential_definition(void **state) {
  double x[N * 3 * B], f[B];
  uint64_t seed = 3;
  (void)state;
  random_jets(&seed, x);
  fs_density_tangential.evaluate(x, f, NULL, NULL);
  for (int l = 0; l < B; l++) {
    double u[3], v[3], n[3], q = 0, length, along[2] = {0, 0};
    for (int c = 0; c < 3; c++) {
      u[c] = x[c * B + l];
      v[c] = x[(3 + c) * B + l];
    }
    for (int c = 0; c < 3; c++) n[c] = u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3];
    length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int c = 0; c < 3; c++) {
      double a = x[(3 * 5 + c) * B + l] + x[(3 * 7 + c) * B + l], b = x[(3 * 6 + c) * B + l] + x[(3 * 8 + c) * B + l];
      q += a * a + b * b;
      along[0] += a * n[c] / length;
      along[1] += b * n[c] / length;
    }
    assert_true(fabs(f[l] - (q - along[0] * along[0] - along[1] * along[1])) <= 1e-14 * 10);
  }
}

/* The contractions against plain loops, for every kernel set; n_dofs functions in rows of padded numbers. */
static void check_contractions(int n_dofs, int padded) {
  enum { MOST = 32 };
  static double by_dof[N * MOST * B], by_point[B * N * MOST], c[3 * MOST], x[N * 3 * B], df[N * 3 * B], ddf[45 * 9 * B],
      g[3 * MOST];
  static double h[6 * MOST * MOST];
  static const int pairs[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  const fs_kernels *all[4];
  int32_t n_sets = fs_kernels_all(all);
  uint64_t seed = 11;
  memset(by_point, 0, sizeof by_point);
  for (int d = 0; d < N; d++)
    for (int m = 0; m < n_dofs; m++)
      for (int q = 0; q < B; q++)
        by_dof[(d * n_dofs + m) * B + q] = by_point[(q * N + d) * padded + m] = test_random_real(&seed, -1, 1);
  for (int i = 0; i < 3 * n_dofs; i++) c[i] = test_random_real(&seed, -1, 1);
  for (int i = 0; i < N * 3 * B; i++) df[i] = test_random_real(&seed, -1, 1);
  for (int i = 0; i < 45 * 9 * B; i++) ddf[i] = test_random_real(&seed, -1, 1);
  for (int i = 0; i < N; i++) /* blocks of equal derivatives are symmetric */
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < a; b++)
        memcpy(ddf + (pair(i, i) * 9 + 3 * a + b) * B, ddf + (pair(i, i) * 9 + 3 * b + a) * B, B * sizeof *ddf);
  for (int32_t s = 0; s < n_sets; s++) {
    memset(g, 0, sizeof g);
    memset(h, 0, sizeof h);
    all[s]->jets(n_dofs, by_dof, c, x);
    all[s]->gradient(n_dofs, by_dof, df, g);
    all[s]->hessian(padded, by_point, ddf, h);
    for (int d = 0; d < N; d++)
      for (int a = 0; a < 3; a++)
        for (int q = 0; q < B; q++) {
          double sum = 0;
          for (int m = 0; m < n_dofs; m++) sum += by_dof[(d * n_dofs + m) * B + q] * c[3 * m + a];
          assert_true(fabs(sum - x[(3 * d + a) * B + q]) <= 1e-13);
        }
    for (int m = 0; m < n_dofs; m++)
      for (int a = 0; a < 3; a++) {
        double sum = 0;
        for (int d = 0; d < N; d++)
          for (int q = 0; q < B; q++) sum += by_dof[(d * n_dofs + m) * B + q] * df[(3 * d + a) * B + q];
        assert_true(fabs(sum - g[3 * m + a]) <= 1e-12);
      }
    for (int p = 0; p < 6; p++)
      for (int m = 0; m < n_dofs; m++)
        for (int k = pairs[p][0] == pairs[p][1] ? m : 0; k < n_dofs; k++) {
          double sum = 0;
          int a = pairs[p][0], b = pairs[p][1];
          for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++)
              for (int q = 0; q < B; q++) {
                double second =
                    i <= j ? ddf[(pair(i, j) * 9 + 3 * a + b) * B + q] : ddf[(pair(j, i) * 9 + 3 * b + a) * B + q];
                sum += by_dof[(i * n_dofs + m) * B + q] * second * by_dof[(j * n_dofs + k) * B + q];
              }
          assert_true(fabs(sum - h[(p * padded + m) * padded + k]) <= 1e-11);
        }
  }
}

/* Rows of an odd and of an even number of the widest vectors. */
static void test_contractions(void **state) {
  (void)state;
  check_contractions(19, 24);
  check_contractions(30, 32);
  check_contractions(7, 8);
}

/* The contraction axis by axis against plain loops: rows of three nodes, one of which continues in the next block. */
static void test_tensor(void **state) {
  enum { NODES_OF_AXIS = 3, POINTS = NODES_OF_AXIS * NODES_OF_AXIS, M = 16, SIZE = 45 * 9 * B };
  static const int order_u[N] = {1, 0, 2, 1, 0, 3, 2, 1, 0}, order_v[N] = {0, 1, 0, 1, 2, 0, 1, 2, 3};
  static const int pairs[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  static double axis[NODES_OF_AXIS * 16], ddf[2 * SIZE], h[6 * M * M];
  const fs_kernels *all[4];
  int32_t n_sets = fs_kernels_all(all);
  uint64_t seed = 5;
  (void)state;
  for (int i = 0; i < NODES_OF_AXIS * 16; i++) axis[i] = test_random_real(&seed, -1, 1);
  for (int i = 0; i < 2 * SIZE; i++) ddf[i] = test_random_real(&seed, -1, 1);
  for (int block = 0; block < 2; block++)
    for (int i = 0; i < N; i++) /* blocks of equal derivatives are symmetric */
      for (int a = 0; a < 3; a++)
        for (int b = 0; b < a; b++)
          memcpy(ddf + block * SIZE + (pair(i, i) * 9 + 3 * a + b) * B,
                 ddf + block * SIZE + (pair(i, i) * 9 + 3 * b + a) * B, B * sizeof *ddf);
  for (int32_t s = 0; s < n_sets; s++) {
    fs_tensor tensor;
    memset(&tensor, 255, sizeof tensor); /* not numbers */
    memset(h, 255, sizeof h);
    tensor.n_nodes = NODES_OF_AXIS;
    tensor.axis_u = tensor.axis_v = axis;
    tensor.is_first_u = tensor.is_last_u = tensor.is_first_v = true;
    tensor.keeps_rows = false;
    for (int block = 0; block < 2; block++) all[s]->hessian_tensor(&tensor, block, ddf + block * SIZE);
    all[s]->hessian_tensor_finish(&tensor, h);
    for (int p = 0; p < 6; p++)
      for (int m = 0; m < M; m++)
        for (int k = pairs[p][0] == pairs[p][1] ? m : 0; k < M; k++) {
          double sum = 0;
          int a = pairs[p][0], b = pairs[p][1];
          for (int q = 0; q < POINTS; q++)
            for (int i = 0; i < N; i++)
              for (int j = 0; j < N; j++) {
                const double *u = axis + q % NODES_OF_AXIS * 16, *v = axis + q / NODES_OF_AXIS * 16;
                int at = i <= j ? pair(i, j) * 9 + 3 * a + b : pair(j, i) * 9 + 3 * b + a;
                sum += u[4 * order_u[i] + m % 4] * v[4 * order_v[i] + m / 4] * ddf[q / B * SIZE + at * B + q % B] *
                       u[4 * order_u[j] + k % 4] * v[4 * order_v[j] + k / 4];
              }
          assert_true(fabs(sum - h[(p * M + m) * M + k]) <= 1e-11);
        }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_graphs),       cmocka_unit_test(test_tori),   cmocka_unit_test(test_derivatives),
      cmocka_unit_test(test_sums),         cmocka_unit_test(test_held),   cmocka_unit_test(test_tangential_definition),
      cmocka_unit_test(test_contractions), cmocka_unit_test(test_tensor),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
