/* SPDX-License-Identifier: MIT */
/* Every line of the table of functionals: derivatives against differences, what rigid motions, scaling and changes of
   parameters do to it, and minima that are known. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fair/setup.h"
#include "support.h"

enum { B = FS_BLOCK, N = 9 };

/* ---- densities ---- */

static const fs_density *const densities[] = {
    &fs_density_curvature_variation, &fs_density_tangential, &fs_density_triharmonic,
    &fs_density_thin_plate,          &fs_density_willmore,   &fs_density_area};
enum { N_DENSITIES = sizeof densities / sizeof densities[0] };
static const int n_of_order[4] = {0, 2, 5, 9};

static void random_jets(uint64_t *seed, double *x) {
  for (int i = 0; i < N * 3 * B; i++) x[i] = test_random_real(seed, -0.5, 0.5);
  for (int l = 0; l < B; l++) {
    x[0 * B + l] += 1; /* p_u and p_v stay independent */
    x[4 * B + l] += 1;
  }
}

static void check_density(const fs_density *density) {
  static double x[N * 3 * B], f[B], df[N * 3 * B], ddf[45 * 9 * B], f0[B], f1[B], df0[N * 3 * B], df1[N * 3 * B];
  const double h = 1e-5;
  double largest = 1;
  int n = n_of_order[density->order];
  uint64_t seed = 29;
  random_jets(&seed, x);
  density->evaluate(x, f, df, ddf);
  for (int i = 0; i < n * (n + 1) / 2 * 9 * B; i++) largest = fmax(largest, fabs(ddf[i]));
  for (int i = 0; i < 3 * n; i++) {
    double keep[B];
    memcpy(keep, x + i * B, sizeof keep);
    for (int l = 0; l < B; l++) x[i * B + l] = keep[l] + h;
    density->evaluate(x, f1, df1, NULL);
    for (int l = 0; l < B; l++) x[i * B + l] = keep[l] - h;
    density->evaluate(x, f0, df0, NULL);
    memcpy(x + i * B, keep, sizeof keep);
    for (int l = 0; l < B; l++) {
      assert_true(fabs((f1[l] - f0[l]) / (2 * h) - df[i * B + l]) <= 1e-7 * largest);
      for (int j = 0; j < 3 * n; j++) {
        int a = i / 3 <= j / 3 ? i : j, b = i / 3 <= j / 3 ? j : i, p = a / 3, q = b / 3;
        double second = ddf[((p * n - p * (p - 1) / 2 + q - p) * 9 + 3 * (a % 3) + b % 3) * B + l];
        assert_true(fabs((df1[j * B + l] - df0[j * B + l]) / (2 * h) - second) <= 1e-7 * largest);
      }
    }
  }
}

static void test_density_derivatives(void **state) {
  (void)state;
  for (int d = 0; d < N_DENSITIES; d++) check_density(densities[d]);
}

/* Derivatives of p(u(s, t), v(s, t)) up to order 3 from those of p and of u, v, by the chain rule applied again and again to
   polynomials in three variables: a jet is a polynomial in (s, t) cut above degree 3. poly[i][j] multiplies s^i t^j. */
typedef struct polynomial {
  double at[4][4];
} polynomial;

static polynomial multiply(const polynomial *a, const polynomial *b) {
  polynomial c = {{{0}}};
  for (int i = 0; i < 4; i++)
    for (int j = 0; i + j < 4; j++)
      for (int k = 0; i + j + k < 4; k++)
        for (int l = 0; i + j + k + l < 4; l++) c.at[i + k][j + l] += a->at[i][j] * b->at[k][l];
  return c;
}

static const int order_u[N] = {1, 0, 2, 1, 0, 3, 2, 1, 0}, order_v[N] = {0, 1, 0, 1, 2, 0, 1, 2, 3};
static const double factorial[4] = {1, 1, 2, 6};

static void compose(const double *x, const polynomial *u, const polynomial *v, int component, int lane, double *y) {
  polynomial sum = {{{0}}};
  for (int d = 0; d < N; d++) {
    polynomial term = {{{1}}};
    for (int k = 0; k < order_u[d]; k++) term = multiply(&term, u);
    for (int k = 0; k < order_v[d]; k++) term = multiply(&term, v);
    double factor = x[(3 * d + component) * B + lane] / (factorial[order_u[d]] * factorial[order_v[d]]);
    for (int i = 0; i < 4; i++)
      for (int j = 0; i + j < 4; j++) sum.at[i][j] += factor * term.at[i][j];
  }
  for (int d = 0; d < N; d++)
    y[(3 * d + component) * B + lane] = sum.at[order_u[d]][order_v[d]] * factorial[order_u[d]] * factorial[order_v[d]];
}

/* Geometric densities times du dv do not change under a change of parameters. */
static void test_reparametrisation(void **state) {
  double x[N * 3 * B], y[N * 3 * B], f[B], g[B];
  uint64_t seed = 31;
  (void)state;
  random_jets(&seed, x);
  polynomial u = {{{0}}}, v = {{{0}}};
  for (int i = 0; i < 4; i++)
    for (int j = i == 0; i + j < 4; j++) {
      u.at[i][j] = test_random_real(&seed, -0.4, 0.4);
      v.at[i][j] = test_random_real(&seed, -0.4, 0.4);
    }
  u.at[1][0] += 1;
  v.at[0][1] += 1;
  double det = u.at[1][0] * v.at[0][1] - u.at[0][1] * v.at[1][0];
  for (int l = 0; l < B; l++)
    for (int c = 0; c < 3; c++) compose(x, &u, &v, c, l, y);
  for (int d = 0; d < N_DENSITIES; d++) {
    double worst = 0;
    densities[d]->evaluate(x, f, NULL, NULL);
    densities[d]->evaluate(y, g, NULL, NULL);
    for (int l = 0; l < B; l++) worst = fmax(worst, fabs(g[l] - fabs(det) * f[l]) / (1 + fabs(f[l])));
    assert_true(densities[d]->is_geometric ? worst <= 1e-12 : worst > 1e-3);
  }
}

/* ---- functionals ---- */

typedef struct fixture {
  fs_context ctx;
  fs_mesh *mesh;
  fs_space *space;
  bool *fixed; /* NULL: nothing */
  fs_setup setup;
  fs_objective objective;
  size_t n;
  double *x;
} fixture;

static void create(fixture *f, const fs_functional *functional, fs_mesh *mesh) {
  static const double weights[] = {0.01, 0.7, 0.3, 0.2, 0.1, 0.05}; /* of sums; C alone for the others */
  *f = (fixture){.ctx = test_context(), .mesh = mesh};
  assert_int_equal(fs_space_create(&f->ctx, mesh, &f->space), FS_OK);
  if (!functional->is_scale_free) {
    f->fixed = calloc((size_t)f->space->n_dofs, sizeof *f->fixed);
    for (int32_t v = 0; v < f->space->n_vertices; v += 5) f->fixed[v] = true;
  }
  fs_fair_options options = {.param = weights, .fixed = f->fixed, .n_nodes_square = 6, .n_nodes_cap = 6};
  assert_int_equal(fs_setup_create(&f->ctx, f->space, &options, functional, f->space->start, &f->setup), FS_OK);
  assert_ptr_equal(f->setup.functional, functional);
  f->objective = fs_setup_objective(&f->setup, NULL);
  f->n = 3 * (size_t)fs_setup_n(&f->setup);
  f->x = calloc(f->n, sizeof *f->x);
  fs_problem_get(f->setup.problem, f->x);
}

static void destroy(fixture *f) {
  fs_context mesh_ctx = test_context();
  fs_setup_free(&f->ctx, &f->setup);
  fs_space_free(&f->ctx, f->space);
  fs_context_clear(&f->ctx);
  fs_mesh_free(&mesh_ctx, f->mesh);
  free(f->fixed);
  free(f->x);
}

static fs_mesh *make_mesh(int kind) {
  uint64_t seed = 37;
  fs_mesh *mesh = kind == 0 ? test_torus(9, 7, 3, 1) : test_star(5, 4);
  test_mesh_disturb(mesh, 0.03, &seed);
  return mesh;
}

/* Gradients at x + h d and x - h d, and the difference quotient of the value. */
static double differences(fixture *f, const double *d, double h, double *y, double *gp, double *gm) {
  double plus, minus;
  for (size_t i = 0; i < f->n; i++) y[i] = f->x[i] + h * d[i];
  assert_int_equal(f->objective.gradient(f->objective.self, y, &plus, gp), FS_OK);
  for (size_t i = 0; i < f->n; i++) y[i] = f->x[i] - h * d[i];
  assert_int_equal(f->objective.gradient(f->objective.self, y, &minus, gm), FS_OK);
  return (plus - minus) / (2 * h);
}

static double dot(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

/* Gradient and Hessian along a direction; the Hessian of functionals that are free of scale along one on which the area does
   not change, up to a multiple of the normal, which is left out. */
static void check_functional(const fs_functional *functional, int kind) {
  fixture f;
  double value, largest = 0, error = 0;
  uint64_t seed = 41;
  create(&f, functional, make_mesh(kind));
  double *g = calloc(f.n, sizeof *g), *gp = calloc(f.n, sizeof *g), *gm = calloc(f.n, sizeof *g);
  double *d = calloc(f.n, sizeof *g), *y = calloc(f.n, sizeof *g), *Hd = calloc(f.n, sizeof *g);
  double *normal = calloc(f.n, sizeof *g);
  assert_int_equal(f.objective.hessian(f.objective.self, f.x, &value, g, f.setup.problem->pattern), FS_OK);
  assert_int_equal(f.objective.gradient(f.objective.self, f.x, &value, g), FS_OK);
  for (size_t i = 0; i < f.n; i++) d[i] = test_random_real(&seed, -1, 1) + f.x[i]; /* the size changes too */
  double wide = differences(&f, d, 2e-4, y, gp, gm), narrow = differences(&f, d, 1e-4, y, gp, gm);
  assert_true(fabs((4 * narrow - wide) / 3 - dot(d, g, f.n)) <= 1e-6 * fabs(dot(d, g, f.n)) + 1e-9 * fabs(value));
  if (f.objective.normal != NULL) {
    assert_int_equal(f.objective.normal(f.objective.self, f.x, normal), FS_OK);
    double along = dot(d, normal, f.n) / dot(normal, normal, f.n);
    for (size_t i = 0; i < f.n; i++) d[i] -= along * normal[i];
    differences(&f, d, 1e-4, y, gp, gm);
  }
  fs_sparse_multiply(f.setup.problem->pattern, d, Hd);
  for (size_t i = 0; i < f.n; i++) y[i] = (gp[i] - gm[i]) / 2e-4 - Hd[i];
  if (f.objective.normal != NULL) {
    double along = dot(y, normal, f.n) / dot(normal, normal, f.n);
    for (size_t i = 0; i < f.n; i++) y[i] -= along * normal[i];
  }
  for (size_t i = 0; i < f.n; i++) {
    largest = fmax(largest, fabs(Hd[i]));
    error = fmax(error, fabs(y[i]));
  }
  assert_true(error <= 1e-5 * largest);
  free(g), free(gp), free(gm), free(d), free(y), free(Hd), free(normal);
  destroy(&f);
}

static void test_derivatives(void **state) {
  (void)state;
  for (int i = 0; fs_functionals[i] != NULL; i++) {
    check_functional(fs_functionals[i], 0);
    if (!fs_functionals[i]->is_scale_free) check_functional(fs_functionals[i], 1);
  }
}

static double value_of(const fs_functional *functional, fs_mesh *mesh) {
  fixture f;
  double value;
  create(&f, functional, mesh);
  double *g = calloc(f.n, sizeof *g);
  assert_int_equal(f.objective.gradient(f.objective.self, f.x, &value, g), FS_OK);
  free(g);
  destroy(&f);
  return value;
}

/* Rotated by 1 about (1, 2, 2) / 3, scaled, moved. */
static fs_mesh *moved(int kind, double scale) {
  fs_mesh *mesh = make_mesh(kind);
  const double c = cos(1), s = sin(1), a[3] = {1 / 3.0, 2 / 3.0, 2 / 3.0};
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    double p[3] = {mesh->position[v].x, mesh->position[v].y, mesh->position[v].z}, q[3];
    double along = a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
    for (int i = 0; i < 3; i++) {
      double turned = a[(i + 1) % 3] * p[(i + 2) % 3] - a[(i + 2) % 3] * p[(i + 1) % 3];
      q[i] = scale * (c * p[i] + s * turned + (1 - c) * along * a[i]) + 5;
    }
    mesh->position[v] = (fs_vec3){q[0], q[1], q[2]};
  }
  return mesh;
}

static void test_motions(void **state) {
  static const struct {
    const char *name;
    int power; /* of length */
  } dimension[] = {{"curvature-variation", -2},
                   {"penalised", -2},
                   {"willmore", 0},
                   {"area", 2},
                   {"triharmonic", 2},
                   {"thin-plate", 2},
                   {"sum", 0},
                   {"scale-free", 0},
                   {"scale-free-penalised", 0},
                   {"scale-free-sum", 0},
                   {"scale-free-willmore", 0}};
  int n = 0;
  (void)state;
  for (int i = 0; fs_functionals[i] != NULL; i++)
    for (size_t k = 0; k < sizeof dimension / sizeof dimension[0]; k++) {
      if (strcmp(fs_functionals[i]->name, dimension[k].name) != 0) continue;
      n++;
      double F = value_of(fs_functionals[i], make_mesh(0)), G = value_of(fs_functionals[i], moved(0, 1000));
      assert_true(fabs(G / pow(1000, dimension[k].power) - F) <= 1e-9 * fabs(F));
    }
  assert_int_equal(n, sizeof dimension / sizeof dimension[0]); /* a new functional gets a line */
  for (n = 0; fs_functionals[n] != NULL; n++) {
  }
  assert_int_equal(n, sizeof dimension / sizeof dimension[0]);
}

/* ---- minima ---- */

static fs_fair_report fair(fs_mesh *mesh, const char *functional, const double *param, bool with_rim) {
  fs_context ctx = test_context(), mesh_ctx = test_context();
  fs_space *space = NULL;
  fs_fair_report report;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  assert_int_equal(fs_space_rim(&ctx, mesh, space, fixed), FS_OK);
  fs_fair_options options = {
      .functional = fs_functional_find(functional), .param = param, .fixed = with_rim ? fixed : NULL};
  assert_int_equal(fs_fair(&ctx, space, &options, c, &report), FS_OK);
  free(fixed), free(c);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  fs_mesh_free(&mesh_ctx, mesh);
  return report;
}

/* Of all tori the Clifford torus, R = sqrt(2) r, has the least integral of H^2: 2 pi^2 [Marques Neves 2014]. */
static void test_clifford(void **state) {
  const double pi = acos(-1.0), C = 1e-5;
  fs_fair_report r = fair(test_torus(16, 12, 3, 1), "willmore", &C, false);
  (void)state;
  assert_string_equal(r.functional->name, "scale-free-willmore");
  assert_true(r.start.integral[0] > 1.2 * 2 * pi * pi);
  assert_true(fabs(r.end.integral[0] - 2 * pi * pi) <= 2e-3 * 2 * pi * pi);
}

static double other_than_willmore(const fs_fair_report *r) {
  return r->end.weight[0] * r->end.integral[0] + r->end.weight[1] * r->end.integral[1];
}

/* One weight alone gives the minimum of that functional. More weight on one term makes this term less and the rest more. */
static void test_sums(void **state) {
  const double C = 1e-3, only_S[] = {1e-3, 1, 0, 0, 0, 0}, both[] = {1e-3, 1, 2, 0, 0, 0};
  const double only_W[] = {1e-3, 0, 1, 0, 0, 0}, nothing[] = {1e-3, 0, 0, 0, 0, 1};
  fs_fair_report variation = fair(test_star(5, 6), "penalised", &C, true);
  fs_fair_report willmore = fair(test_star(5, 6), "willmore", &C, true);
  fs_fair_report S = fair(test_star(5, 6), "sum", only_S, true), W = fair(test_star(5, 6), "sum", only_W, true);
  fs_fair_report sum = fair(test_star(5, 6), "sum", both, true), T = fair(test_star(5, 6), "sum", nothing, true);
  (void)state;
  assert_true(fabs(S.end.S - variation.end.S) <= 1e-7 * S.end.S);
  assert_true(fabs(W.end.integral[2] - willmore.end.integral[0]) <= 1e-7 * W.end.integral[2]);
  assert_true(sum.end.integral[2] < S.end.integral[2]);
  assert_true(other_than_willmore(&sum) > other_than_willmore(&S));
  assert_true(T.end.integral[4] < T.start.integral[4]);
}

/* ---- the metric ---- */

static double flat(double x, double y) { return (void)x, (void)y, 0; }

/* A flat net moved within its plane: normals stay as they are and S is 0, so that the metric at C = 0.01 is the Hessian of F. It is
   the same for any smaller C, and grows with larger ones. */
static void test_metric(void **state) {
  fixture f;
  double value, weight[2];
  uint64_t seed = 43;
  const fs_sparse *metric;
  fs_mesh *grid = test_grid(7, 8, flat);
  (void)state;
  test_mesh_disturb(grid, 0.1, &seed);
  for (int32_t v = 0; v < grid->n_vertices; v++) grid->position[v].z = 0;
  create(&f, fs_functional_find("penalised"), grid);
  assert_null(f.objective.metric);
  f.setup.has_metric = true;
  f.objective = fs_setup_objective(&f.setup, NULL);
  double *d = calloc(f.n, sizeof *d), *Hd = calloc(f.n, sizeof *d), *Md = calloc(f.n, sizeof *d);
  for (size_t i = 0; i < f.n; i++) d[i] = i % 3 == 2 ? 0 : test_random_real(&seed, -1, 1);
  assert_int_equal(f.objective.metric(f.objective.self, f.x, &metric), FS_OK);
  fs_sparse_multiply(metric, d, Md);
  assert_int_equal(f.objective.hessian(f.objective.self, f.x, &value, Hd, f.setup.problem->pattern), FS_OK);
  fs_sparse_multiply(f.setup.problem->pattern, d, Hd);
  for (size_t i = 0; i < f.n; i++)
    if (i % 3 < 2) assert_true(fabs(Md[i] - Hd[i]) <= 1e-10 * sqrt(dot(Hd, Hd, f.n)));
  assert_true(dot(Hd, Hd, f.n) > 0);
  weight[0] = fs_setup_metric_weight(&f.setup);
  f.setup.param[0] = 1e-4;
  assert_true(fs_setup_metric_weight(&f.setup) == weight[0]);
  f.setup.param[0] = 0.02;
  weight[1] = fs_setup_metric_weight(&f.setup);
  assert_true(fabs(weight[1] - 2 * weight[0]) <= 1e-15 * weight[1] && weight[0] > 0);
  free(d), free(Hd), free(Md);
  destroy(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_density_derivatives),
      cmocka_unit_test(test_reparametrisation),
      cmocka_unit_test(test_derivatives),
      cmocka_unit_test(test_motions),
      cmocka_unit_test(test_clifford),
      cmocka_unit_test(test_sums),
      cmocka_unit_test(test_metric),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
