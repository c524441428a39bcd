/* SPDX-License-Identifier: MIT */
/* Fairing along normals: a disturbed plane becomes flat and its vertices hardly move in it; at the end the functional has no
   slope along normals, though it has one along the surface. What it cannot keep is refused; every allocation may fail. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fairsurf/fair.h"
#include "support.h"

typedef struct fixture {
  fs_context ctx;
  struct test_memory memory;
  fs_mesh *mesh;
  fs_space *space;
  bool *fixed;
  fs_vec3 *c;
  fs_fair_options options;
  fs_fair_report report;
} fixture;

static void set_up(fixture *f, fs_mesh *mesh, double noise, double C[1]) {
  uint64_t seed = 5;
  *f = (fixture){.mesh = mesh};
  f->ctx = test_memory_context(&f->memory);
  assert_int_equal(fs_space_create(&f->ctx, mesh, &f->space), FS_OK);
  f->fixed = calloc((size_t)f->space->n_dofs, sizeof *f->fixed);
  f->c = calloc((size_t)f->space->n_dofs, sizeof *f->c);
  assert_int_equal(fs_space_rim(&f->ctx, mesh, f->space, f->fixed), FS_OK);
  memcpy(f->c, f->space->start, (size_t)f->space->n_dofs * sizeof *f->c);
  for (int32_t v = 0; v < f->space->n_vertices; v++)
    if (!f->fixed[v]) f->c[v].z += test_random_real(&seed, -noise, noise);
  f->options = (fs_fair_options){.functional = fs_functional_find("penalised"),
                                 .param = C,
                                 .fixed = f->fixed,
                                 .along_normals = true,
                                 .n_nodes_square = 6,
                                 .n_nodes_cap = 10};
}

static void tear_down(fixture *f) {
  fs_context ctx = test_context();
  fs_space_free(&f->ctx, f->space);
  fs_context_clear(&f->ctx);
  assert_int_equal(f->memory.n_live, 0);
  free(f->fixed), free(f->c);
  fs_mesh_free(&ctx, f->mesh);
}

static void test_plane(void **state) {
  (void)state;
  fixture f;
  double C[1] = {0}, along = 0;
  set_up(&f, test_grid(9, 9, NULL), 0.1, C);
  assert_int_equal(fs_fair(&f.ctx, f.space, &f.options, f.c, &f.report), FS_OK);
  assert_true(f.report.end.S < 1e-6 * f.report.start.S);
  for (int32_t v = 0; v < f.space->n_vertices; v++) {
    fs_vec3 p = f.space->start[v];
    assert_true(fabs(f.c[v].z) < 1e-4);
    along = fmax(along, hypot(f.c[v].x - p.x, f.c[v].y - p.y));
  }
  assert_true(along > 0 && along < 0.03);
  tear_down(&f);
}

static double slope(fixture *f, int32_t v, fs_vec3 d) {
  const double h = 1e-5;
  fs_energy e[2];
  fs_vec3 p = f->c[v];
  for (int k = 0; k < 2; k++) {
    double t = k == 0 ? -h : h;
    f->c[v] = (fs_vec3){p.x + t * d.x, p.y + t * d.y, p.z + t * d.z};
    assert_int_equal(fs_fair_energy(&f->ctx, f->space, &f->options, f->c, &e[k]), FS_OK);
  }
  f->c[v] = p;
  return fabs(e[1].F - e[0].F) / (2 * h);
}

static void test_slopes(void **state) {
  (void)state;
  fixture f;
  double C[1] = {1e-3}, across = 0, along = 0;
  set_up(&f, test_star(5, 4), 0.2, C);
  assert_int_equal(fs_fair(&f.ctx, f.space, &f.options, f.c, &f.report), FS_OK);
  assert_true(f.report.stop == FS_STOP_DECREASE && f.report.end.F < f.report.start.F);
  for (int32_t v = 0; v < f.space->n_vertices; v++) {
    double k = -2 / (5 * 4.0);
    fs_vec3 p = f.c[v], n = {k * p.x, -k * p.y, 1}; /* of the saddle, which is near */
    double length = sqrt(n.x * n.x + n.y * n.y + 1);
    if (f.fixed[v]) continue;
    across = fmax(across, slope(&f, v, (fs_vec3){n.x / length, n.y / length, 1 / length}));
    along = fmax(along, slope(&f, v, (fs_vec3){1 / hypot(1, n.x), 0, -n.x / hypot(1, n.x)}));
  }
  assert_true(along > 0 && across < 0.05 * along);
  tear_down(&f);
}

static void test_refusals(void **state) {
  (void)state;
  fixture f;
  double C[1] = {1e-3};
  fs_hold hold = {.element = 0, .u = 0.5, .v = 0.5, .has_normal = true, .normal = {0, 0, 1}};
  fs_constraints constraints = {.n_holds = 1, .hold = &hold};
  set_up(&f, test_grid(9, 9, NULL), 0.1, C);
  f.options.constraints = &constraints;
  assert_int_equal(fs_fair(&f.ctx, f.space, &f.options, f.c, &f.report), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(f.ctx.message, "along normals"));
  tear_down(&f);
}

static void test_memory_failures(void **state) {
  (void)state;
  fixture f;
  double C[1] = {1e-3};
  set_up(&f, test_grid(8, 8, NULL), 0.1, C);
  f.options.max_iterations = 2;
  for (int64_t k = 1;; k++) {
    int64_t live = f.memory.n_live;
    f.memory.n_allocations = 0;
    f.memory.fail_at = k;
    fs_status status = fs_fair(&f.ctx, f.space, &f.options, f.c, &f.report);
    assert_int_equal(f.memory.n_live, live);
    if (status == FS_OK) break;
    assert_int_equal(status, FS_ERR_MEMORY);
    assert_true(k < 400);
  }
  tear_down(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_plane), cmocka_unit_test(test_slopes),
                                     cmocka_unit_test(test_refusals), cmocka_unit_test(test_memory_failures)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
