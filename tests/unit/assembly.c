/* SPDX-License-Identifier: MIT */
/* Assembly: derivatives of functionals by the dofs against differences, and the same bits for any number of threads. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <cmocka.h>

#include "fair/problem.h"
#include "support.h"

/* ---- derivatives ---- */

static const fs_density *const S_and_Q[2] = {&fs_density_curvature_variation, &fs_density_tangential};

typedef struct fixture {
  fs_context ctx;
  fs_space *space;
  fs_problem *problem;
  int32_t n;
  double *x, *g;
} fixture;

static void fixture_create(fixture *f, fs_mesh *mesh, const bool *fixed, double weight_S, double weight_Q,
                           int32_t nodes) {
  *f = (fixture){.ctx = test_context()};
  assert_int_equal(fs_space_create(&f->ctx, mesh, &f->space), FS_OK);
  assert_int_equal(fs_space_validate(&f->ctx, f->space), FS_OK);
  assert_int_equal(fs_problem_create(&f->ctx, f->space, 2, S_and_Q, fixed, nodes, nodes, f->space->start, &f->problem),
                   FS_OK);
  f->problem->weight[0] = weight_S;
  f->problem->weight[1] = weight_Q;
  f->n = 3 * f->problem->n_free;
  f->x = calloc((size_t)f->n, sizeof *f->x);
  f->g = calloc((size_t)f->n, sizeof *f->g);
  fs_problem_get(f->problem, f->x);
}

static void fixture_free(fixture *f) {
  free(f->x);
  free(f->g);
  fs_problem_free(&f->ctx, f->problem);
  fs_space_free(&f->ctx, f->space);
  fs_context_clear(&f->ctx);
}

static double value_at(fixture *f, const double *x, double *g) {
  double integral[2];
  fs_problem_set(f->problem, x);
  assert_int_equal(fs_problem_evaluate(f->problem, g != NULL ? FS_GRADIENT : FS_VALUE, integral, NULL, g, NULL), FS_OK);
  return f->problem->weight[0] * integral[0] + f->problem->weight[1] * integral[1];
}

/* Directional derivatives of F and of its gradient, central differences with one extrapolation. */
static void check_derivatives(fixture *f, double gradient_tolerance, double hessian_tolerance) {
  size_t n = (size_t)f->n;
  double *d = calloc(n, sizeof *d), *y = calloc(n, sizeof *y), *Hd = calloc(n, sizeof *Hd), *gp = calloc(n, sizeof *gp);
  double *gm = calloc(n, sizeof *gm), integral[2];
  uint64_t seed = 17;
  assert_int_equal(fs_problem_evaluate(f->problem, FS_HESSIAN, integral, NULL, f->g, f->problem->pattern), FS_OK);
  for (int trial = 0; trial < 3; trial++) {
    double along = 0, difference[2], largest = 0, error = 0;
    for (size_t i = 0; i < n; i++) {
      d[i] = test_random_real(&seed, -1, 1);
      along += d[i] * f->g[i];
    }
    for (int k = 0; k < 2; k++) {
      double h = k == 0 ? 2e-4 : 1e-4, plus, minus;
      for (size_t i = 0; i < n; i++) y[i] = f->x[i] + h * d[i];
      plus = value_at(f, y, gp);
      for (size_t i = 0; i < n; i++) y[i] = f->x[i] - h * d[i];
      minus = value_at(f, y, gm);
      difference[k] = (plus - minus) / (2 * h);
    }
    assert_true(fabs((4 * difference[1] - difference[0]) / 3 - along) <= gradient_tolerance * fabs(along));
    fs_sparse_multiply(f->problem->pattern, d, Hd);
    for (size_t i = 0; i < n; i++) {
      largest = fmax(largest, fabs(Hd[i]));
      error = fmax(error, fabs((gp[i] - gm[i]) / 2e-4 - Hd[i]));
    }
    assert_true(error <= hessian_tolerance * largest);
  }
  free(d), free(y), free(Hd), free(gp), free(gm);
}

static void derivatives_on(fs_mesh *mesh, double weight_S, double weight_Q) {
  fixture f;
  fs_context ctx = test_context();
  uint64_t seed = 23;
  test_mesh_disturb(mesh, 0.03, &seed);
  fixture_create(&f, mesh, NULL, weight_S, weight_Q, 6);
  check_derivatives(&f, 1e-7, 1e-5);
  fixture_free(&f);
  fs_mesh_free(&ctx, mesh);
}

static void test_derivatives_squares(void **state) {
  (void)state;
  derivatives_on(test_torus(9, 7, 3, 1), 1, 0);
  derivatives_on(test_torus(9, 7, 3, 1), 1, 0.2);
  derivatives_on(test_torus(9, 7, 3, 1), 0, 1);
}

static void test_derivatives_caps(void **state) {
  (void)state;
  derivatives_on(test_star(3, 4), 1, 0);
  derivatives_on(test_star(5, 4), 1, 0.2);
  derivatives_on(test_star(6, 4), 0, 1);
}

/* Nets so small that a vertex occurs twice in the net of one element. */
static void test_derivatives_repeated_dofs(void **state) {
  (void)state;
  derivatives_on(test_torus(4, 3, 3, 1), 1, 0.1);
}

/* ---- threads ---- */

static void test_threads(void **state) {
  fs_mesh *mesh = test_star(5, 7);
  fixture f[3];
  static const int32_t n_threads[3] = {1, 2, 7};
  double F[3];
  (void)state;
  for (int i = 0; i < 3; i++) {
    fs_context ctx = test_context();
    f[i] = (fixture){.ctx = ctx};
    f[i].ctx.n_threads = n_threads[i];
    assert_int_equal(fs_space_create(&f[i].ctx, mesh, &f[i].space), FS_OK);
    assert_int_equal(fs_problem_create(&f[i].ctx, f[i].space, 2, S_and_Q, NULL, 5, 5, f[i].space->start, &f[i].problem),
                     FS_OK);
    f[i].problem->weight[0] = f[i].problem->weight[1] = 1;
    f[i].n = 3 * f[i].problem->n_free;
    f[i].x = calloc((size_t)f[i].n, sizeof(double));
    f[i].g = calloc((size_t)f[i].n, sizeof(double));
    double integral[2];
    assert_int_equal(fs_problem_evaluate(f[i].problem, FS_HESSIAN, integral, NULL, f[i].g, f[i].problem->pattern),
                     FS_OK);
    F[i] = integral[0] + integral[1];
    assert_true(F[i] == F[0]);
    assert_memory_equal(f[i].g, f[0].g, (size_t)f[0].n * sizeof(double));
    assert_memory_equal(f[i].problem->pattern->value, f[0].problem->pattern->value,
                        9 * (size_t)f[0].problem->pattern->col_start[f[0].problem->pattern->n_blocks] * sizeof(double));
  }
  for (int i = 0; i < 3; i++) fixture_free(&f[i]);
  fs_context ctx = test_context();
  fs_mesh_free(&ctx, mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_derivatives_squares),
      cmocka_unit_test(test_derivatives_caps),
      cmocka_unit_test(test_derivatives_repeated_dofs),
      cmocka_unit_test(test_threads),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
