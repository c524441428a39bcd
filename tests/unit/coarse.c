/* SPDX-License-Identifier: MIT */
/* Displacements of coarse meshes: Hessians made element by element are the products T^T H T, rims stay, and minima found
   from coarse to fine are those found at once. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include <fairsurf/fairsurf.h>
#include "fair/coarse.h"
#include "fair/coarse_squares.h"
#include "support.h"

typedef struct fixture {
  fs_context ctx;
  fs_mesh *mesh; /* a star refined twice */
  fs_space *space;
  bool *fixed;
} fixture;

static void begin(fixture *f, int32_t valence, int32_t rings, int32_t n_threads) {
  fs_mesh *star = test_star(valence, rings);
  fs_refinement *r[2] = {NULL};
  uint64_t seed = 3;
  *f = (fixture){.ctx = test_context()};
  f->ctx.n_threads = n_threads;
  for (int i = 0; i < 2; i++)
    assert_int_equal(fs_mesh_refine(&f->ctx, i == 0 ? star : r[0]->mesh, "averaging", NULL, &r[i]), FS_OK);
  assert_int_equal(fs_mesh_copy(&f->ctx, r[1]->mesh, &f->mesh), FS_OK);
  test_mesh_disturb(f->mesh, 0.002, &seed);
  for (int i = 0; i < 2; i++) fs_refinement_free(&f->ctx, r[i]);
  fs_mesh_free(&f->ctx, star);
  assert_int_equal(fs_space_create(&f->ctx, f->mesh, &f->space), FS_OK);
  f->fixed = calloc((size_t)f->space->n_dofs, sizeof *f->fixed);
  assert_int_equal(fs_space_rim(&f->ctx, f->mesh, f->space, f->fixed), FS_OK);
}

static void end(fixture *f) {
  fs_space_free(&f->ctx, f->space);
  fs_mesh_free(&f->ctx, f->mesh);
  free(f->fixed);
  fs_context_clear(&f->ctx);
}

static fs_sparse *pattern_of(fixture *f, fs_problem *p, const fs_reduction *r) {
  int64_t *start = NULL;
  int32_t *member = NULL;
  fs_sparse *pattern = NULL;
  assert_int_equal(fs_problem_sets(p, &start, &member), FS_OK);
  assert_int_equal(fs_reduction_pattern(&f->ctx, r, f->space->n_elements, start, member, &pattern), FS_OK);
  fs_release(&f->ctx, start);
  fs_release(&f->ctx, member);
  return pattern;
}

static void check_hessians(int32_t valence, int32_t n_threads) {
  static const fs_density *const S_and_Q[] = {&fs_density_curvature_variation, &fs_density_tangential};
  fixture f;
  fs_problem *p = NULL;
  fs_reduction *r[FS_MAX_COARSE];
  int32_t n = 0;
  begin(&f, valence, 6, n_threads);
  assert_int_equal(fs_problem_create(&f.ctx, f.space, 2, S_and_Q, f.fixed, 3, 4, f.space->start, &p), FS_OK);
  p->weight[0] = 1;
  p->weight[1] = 0.01;
  assert_int_equal(fs_coarse_create(&f.ctx, p, f.mesh, 4, r, &n), FS_OK);
  assert_true(n >= 2);
  double largest = 0; /* of the fine Hessian: sums of its entries cancel */
  double *g = calloc(3 * (size_t)p->n_free, sizeof *g);
  assert_int_equal(fs_problem_evaluate(p, FS_HESSIAN, NULL, NULL, g, p->pattern), FS_OK);
  for (int64_t k = 0; k < 9 * (int64_t)p->pattern->col_start[p->n_free]; k++)
    largest = fmax(largest, fabs(p->pattern->value[k]));
  for (int32_t i = 0; i < n; i++) {
    fs_sparse *expected = pattern_of(&f, p, r[i]), *actual = pattern_of(&f, p, r[i]);
    assert_int_equal(fs_reduction_hessian(&f.ctx, r[i], p->pattern, expected), FS_OK);
    assert_int_equal(fs_problem_reduce(p, r[i]), FS_OK);
    assert_int_equal(fs_problem_evaluate(p, FS_HESSIAN, NULL, NULL, NULL, actual), FS_OK);
    assert_true(i > 1 || r[i]->squares->n > 0); /* else they would not be tested */
    assert_int_equal(r[i]->squares->n * r[i]->squares->n_side * r[i]->squares->n_side + r[i]->squares->n_loose,
                     f.space->n_elements);
    assert_int_equal(fs_problem_reduce(p, NULL), FS_OK);
    for (int32_t j = 0; j < actual->n_blocks; j++) {
      int32_t m = actual->col_start[j + 1] - actual->col_start[j];
      for (int32_t c = 0; c < 3; c++)
        for (int32_t k = c; k < 3 * m; k++) { /* on and below the diagonal */
          size_t at = 9 * (size_t)actual->col_start[j] + (size_t)(3 * m * c + k);
          assert_true(fabs(actual->value[at] - expected->value[at]) <= 1e-12 * largest);
        }
    }
    fs_sparse_free(&f.ctx, expected);
    fs_sparse_free(&f.ctx, actual);
    fs_reduction_free(&f.ctx, r[i]);
  }
  free(g);
  fs_problem_free(&f.ctx, p);
  end(&f);
}

static void test_hessians(void **state) {
  (void)state;
  check_hessians(5, 1);
  check_hessians(3, 2);
}

/* The minimum from coarse to fine, or at once; fixed vertices stay to the last bit. */
static fs_fair_report fair(bool from_coarse, int32_t n_threads, fs_vec3 **c) {
  fixture f;
  fs_fair_report report;
  begin(&f, 5, 6, n_threads);
  fs_fair_options options = {.functional = fs_functional_find("penalised"),
                             .mesh = from_coarse ? f.mesh : NULL,
                             .fixed = f.fixed,
                             .n_nodes_square = 3,
                             .n_nodes_cap = 5};
  *c = calloc((size_t)f.space->n_dofs, sizeof **c);
  memcpy(*c, f.space->start, (size_t)f.space->n_dofs * sizeof **c);
  assert_int_equal(fs_fair(&f.ctx, f.space, &options, *c, &report), FS_OK);
  for (int32_t d = 0; d < f.space->n_dofs; d++)
    if (f.fixed[d]) assert_memory_equal(&(*c)[d], &f.space->start[d], sizeof **c);
  assert_int_equal(report.n_coarse, from_coarse ? 2 : 0);
  end(&f);
  return report;
}

/* One run, for sanitizers. */
static void test_run(void **state) {
  fs_vec3 *c;
  fs_fair_report r = fair(true, 3, &c);
  (void)state;
  assert_true(r.end.F < 0.9 * r.start.F);
  free(c);
}

static void test_minimum(void **state) {
  fs_vec3 *at_once, *from_coarse, *two, *three;
  fs_fair_report a = fair(false, 1, &at_once), b = fair(true, 1, &from_coarse), c = fair(true, 2, &two),
                 d = fair(true, 3, &three);
  (void)state;
  assert_true(fabs(a.end.F - b.end.F) <= 1e-10 * a.end.F);
  assert_true(a.end.F < 0.9 * a.start.F);
  /* the same bits for any number of threads */
  assert_int_equal(b.n_steps, c.n_steps);
  assert_memory_equal(from_coarse, two, sizeof *two * 100);
  assert_true(b.end.F == c.end.F && b.end.F == d.end.F && b.end.gradient == c.end.gradient);
  assert_memory_equal(from_coarse, three, sizeof *two * 100);
  free(at_once);
  free(from_coarse);
  free(two);
  free(three);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_hessians),
      TEST_IS_SANITIZED ? (struct CMUnitTest)cmocka_unit_test(test_run)
                        : (struct CMUnitTest)cmocka_unit_test(test_minimum),
  };
  fs_blas_set_threads(1);
  return cmocka_run_group_tests(tests, NULL, NULL);
}
