/* SPDX-License-Identifier: MIT */
/* Noise is taken off rough starts: from each of them fairing finds the minimum that it finds from a smooth one. Smooth starts
   are left as they are. Every allocation may fail. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fair/smooth_start.h"
#include "support.h"

typedef struct fixture {
  fs_context ctx;
  struct test_memory memory;
  fs_mesh *mesh;
  fs_space *space;
  bool *fixed;
  fs_vec3 *c;
  fs_fair_options options;
} fixture;

static void set_up(fixture *f, fs_mesh *mesh) {
  *f = (fixture){.mesh = mesh};
  f->ctx = test_memory_context(&f->memory);
  assert_int_equal(fs_space_create(&f->ctx, f->mesh, &f->space), FS_OK);
  f->fixed = calloc((size_t)f->space->n_dofs, sizeof *f->fixed);
  f->c = calloc((size_t)f->space->n_dofs, sizeof *f->c);
  assert_int_equal(fs_space_rim(&f->ctx, f->mesh, f->space, f->fixed), FS_OK);
  f->options = (fs_fair_options){
      .functional = fs_functional_find("penalised"), .fixed = f->fixed, .n_nodes_square = 5, .n_nodes_cap = 8};
}

static void tear_down(fixture *f) {
  fs_context ctx = test_context();
  fs_space_free(&f->ctx, f->space);
  fs_context_clear(&f->ctx);
  assert_int_equal(f->memory.n_live, 0);
  free(f->fixed), free(f->c);
  fs_mesh_free(&ctx, f->mesh);
}

/* The start with free vertices moved by up to this; edges are about 1 long. */
static void disturb(fixture *f, double noise) {
  uint64_t seed = 17;
  memcpy(f->c, f->space->start, (size_t)f->space->n_dofs * sizeof *f->c);
  for (int32_t v = 0; v < f->space->n_vertices; v++) {
    if (f->fixed[v]) continue;
    f->c[v].x += test_random_real(&seed, -noise, noise);
    f->c[v].y += test_random_real(&seed, -noise, noise);
    f->c[v].z += test_random_real(&seed, -noise, noise);
  }
}

/* F at the start with so much noise, and after fs_smooth_start. */
static fs_status smooth(fixture *f, double noise, double *before, double *after) {
  fs_setup s = {0};
  fs_energy energy = {0};
  double *x = calloc(3 * (size_t)f->space->n_dofs, sizeof *x), *g = calloc(3 * (size_t)f->space->n_dofs, sizeof *g);
  fs_status status;
  disturb(f, noise);
  status = fs_setup_create(&f->ctx, f->space, &f->options, f->options.functional, f->c, &s);
  if (status == FS_OK) {
    fs_problem_get(s.problem, x);
    status = fs_setup_measure(&s, g, &energy);
    *before = energy.F;
  }
  if (status == FS_OK) status = fs_smooth_start(&s, &f->options, x, &energy);
  if (status == FS_OK) { /* the unknowns are those that were measured */
    fs_setup_place(&s, x);
    status = fs_setup_measure(&s, g, &energy);
    *after = energy.F;
  }
  fs_setup_free(&f->ctx, &s);
  free(x), free(g);
  return status;
}

static void test_noise(void **state) {
  (void)state;
  fixture f;
  double before = 0, after = 0, smoothest = 0;
  set_up(&f, test_star(5, 5));
  assert_int_equal(smooth(&f, 0, &before, &smoothest), FS_OK);
  assert_true(before == smoothest);
  assert_int_equal(smooth(&f, 0.4, &before, &after), FS_OK);
  assert_true(before > 1e3 * smoothest && after < 2 * smoothest);
  tear_down(&f);
}

/* Other starts, one minimum, in no more steps. */
static void test_minimum(void **state) {
  (void)state;
  fixture f;
  fs_fair_report report;
  double F;
  set_up(&f, test_star(5, 5));
  disturb(&f, 0);
  assert_int_equal(fs_fair(&f.ctx, f.space, &f.options, f.c, &report), FS_OK);
  F = report.end.F;
  for (int k = 1; k <= 2; k++) {
    disturb(&f, 0.2 * k);
    assert_int_equal(fs_fair(&f.ctx, f.space, &f.options, f.c, &report), FS_OK);
    assert_true(fabs(report.end.F - F) <= 1e-9 * F);
    assert_true(report.n_steps <= 20);
  }
  tear_down(&f);
}

static void test_memory_failures(void **state) {
  (void)state;
  fixture f;
  double before = 0, after = 0;
  int64_t n;
  set_up(&f, test_grid(8, 8, NULL));
  assert_int_equal(smooth(&f, 0.4, &before, &after), FS_OK);
  f.memory.n_allocations = 0;
  assert_int_equal(smooth(&f, 0.4, &before, &after), FS_OK);
  n = f.memory.n_allocations;
  for (int64_t k = 1; k <= n; k++) {
    f.memory.n_allocations = 0;
    f.memory.fail_at = k;
    int64_t live = f.memory.n_live;
    assert_int_equal(smooth(&f, 0.4, &before, &after), FS_ERR_MEMORY);
    assert_int_equal(f.memory.n_live, live);
  }
  f.memory.fail_at = 0;
  tear_down(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_noise), cmocka_unit_test(test_minimum),
                                     cmocka_unit_test(test_memory_failures)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
