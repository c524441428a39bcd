/* SPDX-License-Identifier: MIT */
/* A tolerance to the start or to a mesh is never exceeded, measured at 33 x 33 points of every patch; and what it allows is
   used. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fairsurf/fair.h"
#include "fairsurf/surface.h"
#include "support.h"

typedef struct fixture {
  fs_context ctx;
  struct test_memory memory;
  fs_mesh *mesh;
  fs_space *space;
  bool *fixed;
  fs_vec3 *c;
  fs_surface *start;
  fs_nearest *nearest;
  fs_target target;
  fs_constraints constraints;
  fs_fair_options options;
  fs_fair_report report;
} fixture;

static void set_up(fixture *f, fs_mesh *mesh, double noise) {
  uint64_t seed = 41;
  *f = (fixture){.mesh = mesh};
  f->ctx = test_memory_context(&f->memory);
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].z += test_random_real(&seed, -noise, noise);
  assert_int_equal(fs_space_create(&f->ctx, mesh, &f->space), FS_OK);
  f->fixed = calloc((size_t)f->space->n_dofs, sizeof *f->fixed);
  f->c = calloc((size_t)f->space->n_dofs, sizeof *f->c);
  assert_int_equal(fs_space_rim(&f->ctx, mesh, f->space, f->fixed), FS_OK);
  memcpy(f->c, f->space->start, (size_t)f->space->n_dofs * sizeof *f->c);
  assert_int_equal(fs_surface_create(&f->ctx, f->space, f->c, &f->start), FS_OK);
  assert_int_equal(fs_nearest_create(&f->ctx, f->start, &f->nearest), FS_OK);
  f->target = (fs_target){fs_nearest_distance, f->nearest};
  f->constraints = (fs_constraints){.target = &f->target};
  f->options = (fs_fair_options){
      .functional = fs_functional_find("penalised"), .fixed = f->fixed, .constraints = &f->constraints};
}

static void tear_down(fixture *f) {
  fs_context ctx = test_context();
  fs_nearest_free(&f->ctx, f->nearest);
  fs_surface_free(&f->ctx, f->start);
  fs_space_free(&f->ctx, f->space);
  fs_context_clear(&f->ctx);
  assert_int_equal(f->memory.n_live, 0);
  free(f->fixed), free(f->c);
  fs_mesh_free(&ctx, f->mesh);
}

static fs_status fair(fixture *f, double tolerance) {
  f->constraints.tolerance = tolerance;
  memcpy(f->c, f->space->start, (size_t)f->space->n_dofs * sizeof *f->c);
  return fs_fair(&f->ctx, f->space, &f->options, f->c, &f->report);
}

static double largest_distance(fixture *f) {
  fs_surface *surface = NULL;
  fs_vec3 x[FS_JET_SIZE], nearest;
  double largest = 0;
  assert_int_equal(fs_surface_create(&f->ctx, f->space, f->c, &surface), FS_OK);
  for (int32_t patch = 0; patch < surface->n_patches; patch++)
    for (int k = 0; k < 33 * 33; k++) {
      fs_surface_evaluate(surface, patch, (k % 33) / 32.0, (k / 33) / 32.0, x);
      largest = fmax(largest, f->target.distance(f->target.self, x[FS_D], &nearest));
    }
  fs_surface_free(&f->ctx, surface);
  return largest;
}

static void check_tolerances(fixture *f, int n, const double *tolerance) {
  double before = INFINITY;
  for (int i = 0; i < n; i++) {
    assert_int_equal(fair(f, tolerance[i]), FS_OK);
    double distance = largest_distance(f);
    assert_true(distance <= tolerance[i] && f->report.distance <= tolerance[i]);
    assert_true(f->report.distance >= distance * (1 - 1e-3));
    assert_true(distance >= 0.9 * tolerance[i]); /* as far as it may */
    assert_true(f->report.end.F < before);       /* more room, a fairer surface */
    before = f->report.end.F;
  }
  assert_int_equal(fair(f, 10), FS_OK); /* the wall is far away: the same as without */
  double F = f->report.end.F;
  f->options.constraints = NULL;
  assert_int_equal(fair(f, 0), FS_OK);
  f->options.constraints = &f->constraints;
  assert_true(fabs(F - f->report.end.F) <= 1e-6 * F && F < before);
}

static void test_tolerances(void **state) {
  (void)state;
  fixture f;
  static const double tolerance[4] = {1e-3, 0.01, 0.03, 0.06};
  set_up(&f, test_grid(9, 9, NULL), 0.15);
  check_tolerances(&f, TEST_IS_SANITIZED ? 1 : 4, tolerance + (TEST_IS_SANITIZED ? 1 : 0));
  tear_down(&f);
  set_up(&f, test_star(5, TEST_IS_SANITIZED ? 4 : 5), 0.1);
  check_tolerances(&f, TEST_IS_SANITIZED ? 1 : 2, tolerance + 1);
  tear_down(&f);
}

/* Whatever the functional, and with C lowered in steps. */
static void test_functionals(void **state) {
  (void)state;
  fixture f;
  int32_t n = TEST_IS_SANITIZED ? 6 : 8;
  set_up(&f, test_grid(n, n, NULL), 0.15);
  for (int k = 0; fs_functionals[k] != NULL; k++) {
    if (fs_functionals[k]->is_scale_free) continue;
    if (TEST_IS_SANITIZED && fs_functionals[k]->term[0] == &fs_density_area) continue;
    f.options.functional = fs_functionals[k];
    assert_int_equal(fair(&f, 0.02), FS_OK);
    assert_true(largest_distance(&f) <= 0.02 && f.report.end.F < f.report.start.F);
  }
  tear_down(&f);
}

/* Closed: nothing is fixed but the wall. */
static void test_closed(void **state) {
  (void)state;
  fixture f;
  set_up(&f, TEST_IS_SANITIZED ? test_torus(8, 6, 3, 1) : test_torus(10, 8, 3, 1), 0.1);
  f.options.fixed = NULL;
  assert_int_equal(fair(&f, 0.05), FS_OK);
  assert_true(largest_distance(&f) <= 0.05 && f.report.end.F < 0.9 * f.report.start.F);
  tear_down(&f);
}

/* A mesh as the target, from which the start has some distance; and one that is too far. */
static void test_mesh_target(void **state) {
  (void)state;
  fixture f;
  fs_nearest *nearest = NULL;
  fs_context ctx = test_context();
  fs_mesh *flat = test_grid(9, 9, NULL);
  set_up(&f, test_grid(9, 9, NULL), 0.15);
  assert_int_equal(fs_nearest_create_for_mesh(&f.ctx, flat, &nearest), FS_OK);
  f.target.self = nearest;
  double distance = largest_distance(&f);
  assert_int_equal(fair(&f, 1.1 * distance), FS_OK);
  assert_true(largest_distance(&f) <= 1.1 * distance);
  assert_int_equal(fair(&f, 0.5 * distance), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(f.ctx.message, "cannot be met"));
  assert_non_null(strstr(f.ctx.message, "face"));
  assert_memory_equal(f.c, f.space->start, (size_t)f.space->n_dofs * sizeof *f.c);
  fs_nearest_free(&f.ctx, nearest);
  fs_mesh_free(&ctx, flat);
  tear_down(&f);
}

/* With points that are held: near enough, and too far. */
static void test_holds(void **state) {
  (void)state;
  fixture f;
  fs_hold hold = {.element = 24, .u = 0.5, .v = 0.5, .has_position = true};
  fs_vec3 x[FS_JET_SIZE];
  set_up(&f, test_grid(9, 9, NULL), 0.1);
  fs_surface_evaluate(f.start, 24, 0.5, 0.5, x);
  hold.position = x[FS_D];
  hold.position.z += 0.04;
  f.constraints.hold = &hold;
  f.constraints.n_holds = 1;
  assert_int_equal(fair(&f, 0.06), FS_OK);
  assert_true(largest_distance(&f) <= 0.06);
  assert_int_equal(fair(&f, 0.03), FS_ERR_UNSUPPORTED);
  assert_int_equal(fair(&f, -1), FS_ERR_ARGUMENT);
  f.constraints.target = NULL;
  assert_int_equal(fair(&f, 0.1), FS_ERR_ARGUMENT);
  tear_down(&f);
}

static bool stop_early(void *user, const fs_step *step) {
  (void)user;
  return step->number < 3;
}

static void test_threads_and_cancel(void **state) {
  (void)state;
  fixture f;
  set_up(&f, test_star(3, TEST_IS_SANITIZED ? 4 : 5), 0.1);
  fs_vec3 *first = calloc((size_t)f.space->n_dofs, sizeof *first);
  assert_int_equal(fair(&f, 0.02), FS_OK);
  memcpy(first, f.c, (size_t)f.space->n_dofs * sizeof *first);
  f.ctx.n_threads = 3;
  assert_int_equal(fair(&f, 0.02), FS_OK);
  assert_memory_equal(first, f.c, (size_t)f.space->n_dofs * sizeof *first);
  f.options.monitor = stop_early;
  assert_int_equal(fair(&f, 0.02), FS_OK);
  assert_int_equal(f.report.stop, FS_STOP_CANCELLED);
  assert_true(largest_distance(&f) <= 0.02);
  free(first);
  tear_down(&f);
}

static void test_memory(void **state) {
  (void)state;
  fixture f;
  fs_status status = FS_ERR_MEMORY;
  int64_t n = 1;
  set_up(&f, test_grid(6, 6, NULL), 0.1);
  f.options.max_iterations = 2;
  f.options.n_nodes_square = 3;
  for (; status == FS_ERR_MEMORY; n += 9) {
    int64_t live = f.memory.n_live;
    f.memory.fail_at = f.memory.n_allocations + n;
    status = fair(&f, 0.01);
    assert_int_equal(f.memory.n_live, live);
    if (status != FS_OK) assert_memory_equal(f.c, f.space->start, (size_t)f.space->n_dofs * sizeof *f.c);
  }
  assert_int_equal(status, FS_OK);
  assert_true(n > 30);
  f.memory.fail_at = 0;
  assert_true(largest_distance(&f) <= 0.01);
  tear_down(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_tolerances), cmocka_unit_test(test_functionals),
                                     cmocka_unit_test(test_closed),     cmocka_unit_test(test_mesh_target),
                                     cmocka_unit_test(test_holds),      cmocka_unit_test(test_threads_and_cancel),
                                     cmocka_unit_test(test_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
