/* SPDX-License-Identifier: MIT */
/* Curvatures against tori, spheres, graphs and differences. Exact integrals: torus S = pi^2 R^2 / (2 r (R^2 - r^2)^1.5);
   graphs by quadrature of closed formulas. */
#include "math/diffgeo.h"
#include "math/vec3.h"
#include <fairsurf/space.h>
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static const double pi = 3.14159265358979323846;
static const int order_u[FS_JET_SIZE] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0};
static const int order_v[FS_JET_SIZE] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

/* ((R + r cos v) cos u, (R + r cos v) sin u, r sin v); a sphere for R = 0. Outside is outside. */
static void torus(double R, double r, double u, double v, fs_vec3 *x) {
  for (int k = 0; k < FS_JET_SIZE; k++) {
    double a = u + order_u[k] * pi / 2, b = v + order_v[k] * pi / 2;
    double radius = (order_v[k] == 0 ? R : 0) + r * cos(b);
    x[k] = (fs_vec3){radius * cos(a), radius * sin(a), order_u[k] == 0 ? r * sin(b) : 0};
  }
}

/* The graph of a sum of four terms c u^i v^j. */
struct term {
  double c;
  int i, j;
};
static double power(double t, int n, int order) {
  double value = 1;
  for (int k = 0; k < order; k++) value *= n - k;
  for (int k = 0; k < n - order; k++) value *= t;
  return n < order ? 0 : value;
}
static void graph(const struct term *terms, double u, double v, fs_vec3 *x) {
  for (int k = 0; k < FS_JET_SIZE; k++) {
    x[k] = (fs_vec3){power(u, 1, order_u[k]) * power(v, 0, order_v[k]),
                     power(u, 0, order_u[k]) * power(v, 1, order_v[k]), 0};
    for (int t = 0; t < 4; t++)
      x[k].z += terms[t].c * power(u, terms[t].i, order_u[k]) * power(v, terms[t].j, order_v[k]);
  }
}

static void test_torus_point(void **state) {
  const double R = 2, r = 0.7, u = 0.4, v = 2.1;
  fs_vec3 x[FS_JET_SIZE];
  fs_geometry g;
  fs_principal k;
  (void)state;
  torus(R, r, u, v, x);
  assert_true(fs_geometry_compute(x, &g));
  double k1 = -1 / r, k2 = -cos(v) / (R + r * cos(v)), Hv = 0.5 * R * sin(v) / pow(R + r * cos(v), 2);
  near(g.normal.x, cos(u) * cos(v), 1e-15);
  near(g.normal.z, sin(v), 1e-15);
  near(g.H, 0.5 * (k1 + k2), 1e-14);
  near(g.K, k1 * k2, 1e-14);
  near(g.g11, pow(R + r * cos(v), 2), 1e-14);
  near(g.h22, -r, 1e-14);
  fs_geometry_principal(&g, &k);
  near(k.maximum, k2, 1e-14);
  near(k.minimum, k1, 1e-14);
  near(fabs(fs_vec3_dot(k.maximum_direction, x[FS_DU])), fs_vec3_length(x[FS_DU]), 1e-14);
  near(fabs(fs_vec3_dot(k.minimum_direction, x[FS_DV])), fs_vec3_length(x[FS_DV]), 1e-14);
  fs_vec3 gradient = fs_geometry_mean_gradient(x, &g);
  near(fs_vec3_dot(gradient, x[FS_DV]), Hv, 1e-14);
  near(fs_vec3_dot(gradient, x[FS_DU]), 0, 1e-14);
  near(fs_vec3_dot(gradient, g.normal), 0, 1e-14);
}

static void test_sphere(void **state) {
  fs_vec3 x[FS_JET_SIZE];
  fs_geometry g;
  fs_principal k;
  double W[3][3];
  (void)state;
  torus(0, 2.5, 1.1, 0.3, x);
  assert_true(fs_geometry_compute(x, &g));
  near(g.H, -0.4, 1e-15);
  near(g.K, 0.16, 1e-15);
  near(fs_vec3_length(fs_geometry_mean_gradient(x, &g)), 0, 1e-15);
  fs_geometry_principal(&g, &k);
  near(k.maximum, -0.4, 1e-15);
  near(k.minimum, -0.4, 1e-15);
  near(fs_vec3_length(k.maximum_direction), 1, 1e-15);
  /* W = -0.4 (I - n n^T) */
  fs_geometry_shape_tensor(&g, W);
  const double n[3] = {g.normal.x, g.normal.y, g.normal.z};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) near(W[i][j], -0.4 * ((i == j) - n[i] * n[j]), 1e-15);
}

static void test_torus_integrals(void **state) {
  static const double exact[3][3] = {
      {1.4142135623730951, 1, 9.869604401089358}, {2, 1, 3.798812505176}, {3, 1, 1.962805556148}};
  enum { N = 200 };
  (void)state;
  for (int t = 0; t < 3; t++) {
    double R = exact[t][0], r = exact[t][1], S = 0, willmore = 0;
    for (int i = 0; i < N; i++) {
      fs_vec3 x[FS_JET_SIZE];
      fs_geometry g;
      torus(R, r, 0.3, 2 * pi * i / N, x);
      assert_true(fs_geometry_compute(x, &g));
      fs_vec3 gradient = fs_geometry_mean_gradient(x, &g);
      S += fs_vec3_dot(gradient, gradient) * g.area * 4 * pi * pi / N;
      willmore += g.H * g.H * g.area * 4 * pi * pi / N;
    }
    near(S / exact[t][2], 1, 1e-12);
    if (t == 0) near(willmore / (2 * pi * pi), 1, 1e-13);
  }
}

/* Gauss-Legendre nodes and weights on [0, 1], by Newton's method for the Legendre polynomial of degree n. */
static void gauss(int n, double *node, double *weight) {
  for (int k = 0; k < n; k++) {
    double t = cos(pi * (k + 0.75) / (n + 0.5)), p1 = 0, dp = 1;
    for (int pass = 0; pass < 100; pass++) {
      double p0 = 1;
      p1 = t;
      for (int j = 2; j <= n; j++) {
        double p2 = ((2 * j - 1) * t * p1 - (j - 1) * p0) / j;
        p0 = p1, p1 = p2;
      }
      dp = n * (t * p1 - p0) / (t * t - 1);
      t -= p1 / dp;
    }
    node[k] = 0.5 * (1 - t);
    weight[k] = 1 / ((1 - t * t) * dp * dp);
  }
}

static void test_graph_integrals(void **state) {
  static const struct {
    struct term terms[4];
    double S, willmore, area;
  } cases[] = {
      {{{1, 1, 1}}, 0.05818831883894, 0.01791716453044, 1.280789275273},
      {{{0.5, 2, 0}, {0.5, 0, 2}}, 0.2075662456293, 0.5518849218631, 1.280789275273},
      {{{0.5, 2, 0}, {-0.5, 0, 2}}, 0.06765808515898, 0.01036898173436, 1.280789275273},
      {{{1, 3, 0}}, 3.091739546388, 0.3623805127874, 1.547865654684},
      {{{1, 2, 1}}, 0.8794643847793, 0.1208915667455, 1.249504263163},
      {{{1, 3, 3}}, 2.945106176589, 0.1966479416254, 1.162040641819},
  };
  enum { N = 60 };
  double node[N], weight[N];
  (void)state;
  gauss(N, node, weight);
  for (size_t t = 0; t < sizeof cases / sizeof *cases; t++) {
    double S = 0, willmore = 0, area = 0;
    for (int j = 0; j < N; j++)
      for (int i = 0; i < N; i++) {
        fs_vec3 x[FS_JET_SIZE];
        fs_geometry g;
        graph(cases[t].terms, node[i], node[j], x);
        assert_true(fs_geometry_compute(x, &g));
        fs_vec3 gradient = fs_geometry_mean_gradient(x, &g);
        double dM = weight[i] * weight[j] * g.area;
        S += fs_vec3_dot(gradient, gradient) * dM;
        willmore += g.H * g.H * dM;
        area += dM;
      }
    near(S / cases[t].S, 1, 1e-10);
    near(willmore / cases[t].willmore, 1, 1e-10);
    near(area / cases[t].area, 1, 1e-10);
  }
}

static double graph_mean(const struct term *terms, double u, double v) {
  fs_vec3 x[FS_JET_SIZE];
  fs_geometry g;
  graph(terms, u, v, x);
  assert_true(fs_geometry_compute(x, &g));
  return g.H;
}

/* grad H . p_u = H_u on random cubic graphs, fourth order differences. */
static void test_gradient_differences(void **state) {
  uint64_t seed = 11;
  (void)state;
  for (int trial = 0; trial < 50; trial++) {
    struct term terms[4];
    for (int t = 0; t < 4; t++)
      terms[t] = (struct term){test_random_real(&seed, -1, 1), test_random_integer(&seed, 0, 3),
                               test_random_integer(&seed, 0, 3)};
    double u = test_random_real(&seed, 0, 1), v = test_random_real(&seed, 0, 1), h = 1e-3;
    fs_vec3 x[FS_JET_SIZE];
    fs_geometry g;
    graph(terms, u, v, x);
    assert_true(fs_geometry_compute(x, &g));
    fs_vec3 gradient = fs_geometry_mean_gradient(x, &g);
    double Hu = (8 * (graph_mean(terms, u + h, v) - graph_mean(terms, u - h, v)) - graph_mean(terms, u + 2 * h, v) +
                 graph_mean(terms, u - 2 * h, v)) /
                (12 * h);
    double Hv = (8 * (graph_mean(terms, u, v + h) - graph_mean(terms, u, v - h)) - graph_mean(terms, u, v + 2 * h) +
                 graph_mean(terms, u, v - 2 * h)) /
                (12 * h);
    near(fs_vec3_dot(gradient, x[FS_DU]), Hu, 1e-8);
    near(fs_vec3_dot(gradient, x[FS_DV]), Hv, 1e-8);
  }
}

/* The same surface by s = (u, v) rotated and stretched: first, second order numbers with p_s = a p_u + b p_v, … */
static void test_parameters_do_not_matter(void **state) {
  const struct term terms[4] = {{0.7, 2, 0}, {-0.4, 1, 2}, {0.9, 1, 1}, {0.3, 0, 3}};
  const double a = 1.3, b = -0.4, c = 0.6, d = 2.1; /* u = a s + c t, v = b s + d t */
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE] = {{0, 0, 0}};
  fs_geometry g, h;
  double V[3][3], W[3][3];
  (void)state;
  graph(terms, 0.3, 0.8, x);
  y[FS_DU] = fs_vec3_add_scaled(fs_vec3_scale(x[FS_DU], a), x[FS_DV], b);
  y[FS_DV] = fs_vec3_add_scaled(fs_vec3_scale(x[FS_DU], c), x[FS_DV], d);
  const double weight[3][3] = {{a * a, 2 * a * b, b * b}, {a * c, a * d + b * c, b * d}, {c * c, 2 * c * d, d * d}};
  for (int k = 0; k < 3; k++)
    for (int l = 0; l < 3; l++) y[FS_DUU + k] = fs_vec3_add_scaled(y[FS_DUU + k], x[FS_DUU + l], weight[k][l]);
  assert_true(fs_geometry_compute(x, &g));
  assert_true(fs_geometry_compute(y, &h));
  near(g.H, h.H, 1e-14);
  near(g.K, h.K, 1e-14);
  fs_geometry_shape_tensor(&g, V);
  fs_geometry_shape_tensor(&h, W);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) near(V[i][j], W[i][j], 1e-14);
  /* eigenvectors of the tensor */
  fs_principal k;
  fs_geometry_principal(&g, &k);
  fs_vec3 e = k.maximum_direction;
  near(V[0][0] * e.x + V[0][1] * e.y + V[0][2] * e.z, k.maximum * e.x, 1e-14);
  near(V[2][0] * e.x + V[2][1] * e.y + V[2][2] * e.z, k.maximum * e.z, 1e-14);
}

static void test_singular(void **state) {
  fs_vec3 x[FS_JET_SIZE] = {{0, 0, 0}}, normal = {7, 8, 9};
  fs_geometry g = {.H = 5};
  (void)state;
  x[FS_DU] = (fs_vec3){1, 2, 3};
  assert_false(fs_normal_compute(x, &normal));
  x[FS_DV] = (fs_vec3){-2, -4, -6};
  assert_false(fs_geometry_compute(x, &g));
  assert_true(normal.x == 7 && g.H == 5);
  x[FS_DV].x = NAN;
  assert_false(fs_normal_compute(x, &normal));
  x[FS_DV] = (fs_vec3){-2, -4, -6.001};
  assert_true(fs_normal_compute(x, &normal));
  near(fs_vec3_length(normal), 1, 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_torus_point),
      cmocka_unit_test(test_sphere),
      cmocka_unit_test(test_torus_integrals),
      cmocka_unit_test(test_graph_integrals),
      cmocka_unit_test(test_gradient_differences),
      cmocka_unit_test(test_parameters_do_not_matter),
      cmocka_unit_test(test_singular),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
