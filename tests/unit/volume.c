/* SPDX-License-Identifier: MIT */
/* The volume and its derivatives; fairing closed surfaces under a fixed volume or a fixed area, measured by the integrals of
   the surface's own measures, which subdivide until they are sure. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fair/volume.h"
#include "fairsurf/analyse.h"
#include "support.h"

static fs_mesh *refined_cube(int times, double stretch) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_cube();
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].x *= stretch;
  for (int i = 0; i < times; i++) {
    fs_refinement *step = NULL;
    assert_int_equal(fs_mesh_refine(&ctx, mesh, "averaging", NULL, &step), FS_OK);
    fs_mesh_free(&ctx, mesh);
    assert_int_equal(fs_mesh_copy(&ctx, step->mesh, &mesh), FS_OK);
    fs_refinement_free(&ctx, step);
  }
  return mesh;
}

static fs_shape shape_of(fs_context *ctx, const fs_space *space, const fs_vec3 *c) {
  fs_surface *surface = NULL;
  fs_shape shape;
  assert_int_equal(fs_surface_create(ctx, space, c, &surface), FS_OK);
  assert_int_equal(fs_shape_measure(ctx, surface, 1e-12, &shape), FS_OK);
  fs_surface_free(ctx, surface);
  return shape;
}

/* Against differences, and the value against the measure; the mesh has no boundary or one. */
static void check_derivatives(fs_mesh *mesh, fs_cap_inner caps) {
  static const fs_density *const term[1] = {&fs_density_area};
  fs_context ctx = test_context();
  fs_space *space = NULL;
  fs_problem *p = NULL;
  fs_volume *volume = NULL;
  uint64_t seed = 31;
  double value, largest = 0, error = 0, along = 0, plus, minus;
  test_mesh_disturb(mesh, 0.05, &seed);
  assert_int_equal(fs_space_create_with(&ctx, mesh, &(fs_space_options){.caps = caps}, &space), FS_OK);
  assert_int_equal(fs_problem_create(&ctx, space, 1, term, NULL, 2, 2, space->start, &p), FS_OK);
  assert_int_equal(fs_volume_create(p, &volume), FS_OK);
  size_t n = 3 * (size_t)p->n_free;
  double *x = calloc(n, sizeof *x), *d = calloc(n, sizeof *d), *y = calloc(n, sizeof *y), *g = calloc(n, sizeof *g);
  double *gp = calloc(n, sizeof *gp), *gm = calloc(n, sizeof *gm), *Hd = calloc(n, sizeof *Hd);
  fs_problem_get(p, x);
  assert_int_equal(fs_volume_evaluate(volume, FS_HESSIAN, 2, &value, g, p->pattern), FS_OK);
  assert_true(fabs(value - shape_of(&ctx, space, space->start).volume) <= 1e-11 * fabs(value));
  for (size_t i = 0; i < n; i++) {
    d[i] = test_random_real(&seed, -1, 1);
    along += d[i] * g[i];
  }
  fs_sparse_multiply(p->pattern, d, Hd);
  for (size_t i = 0; i < n; i++) y[i] = x[i] + 1e-3 * d[i];
  fs_problem_set(p, y);
  assert_int_equal(fs_volume_evaluate(volume, FS_GRADIENT, 2, &plus, gp, NULL), FS_OK);
  for (size_t i = 0; i < n; i++) y[i] = x[i] - 1e-3 * d[i];
  fs_problem_set(p, y);
  assert_int_equal(fs_volume_evaluate(volume, FS_GRADIENT, 2, &minus, gm, NULL), FS_OK);
  for (size_t i = 0; i < n; i++) { /* the gradient is quadratic: its difference is exact */
    largest = fmax(largest, fabs(Hd[i]));
    error = fmax(error, fabs((gp[i] - gm[i]) / 2e-3 - Hd[i]));
  }
  assert_true(error <= 1e-10 * largest);
  assert_true(fabs((plus - minus) / 1e-3 - along) <= 1e-5 * fabs(along)); /* 2 (V+ - V-) / 2e-3 */
  free(x), free(d), free(y), free(g), free(gp), free(gm), free(Hd);
  fs_volume_free(volume);
  fs_problem_free(&ctx, p);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  fs_mesh_free(&ctx, mesh);
}

static void test_derivatives(void **state) {
  (void)state;
  check_derivatives(test_torus(9, 7, 3, 1), FS_CAPS_LINEAR);
  check_derivatives(test_torus(4, 3, 3, 1), FS_CAPS_LINEAR); /* a vertex twice in one net */
  check_derivatives(test_star(5, 4), FS_CAPS_LINEAR);
  check_derivatives(test_star(3, 4), FS_CAPS_FULL);
  check_derivatives(refined_cube(2, 1), FS_CAPS_SMOOTH);
}

/* What is kept is kept to 1e-10, and the least S A is that of the sphere. */
static void check_kept(fs_keep keep, fs_cap_inner caps, const char *functional, const fs_vec3 *plane, double sign) {
  fs_context ctx = test_context();
  fs_mesh *mesh = refined_cube(2, 1.6);
  fs_space *space = NULL;
  fs_symmetry *symmetry = NULL;
  fs_fair_report report;
  double low = INFINITY, high = 0;
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].z = sign * mesh->position[v].z + 0.5 * (sign - 1);
  assert_int_equal(fs_space_create_with(&ctx, mesh, &(fs_space_options){.caps = caps}, &space), FS_OK);
  if (plane != NULL) assert_int_equal(fs_symmetry_create(&ctx, mesh, space, plane, 0, &symmetry), FS_OK);
  fs_constraints constraints = {.keep = keep, .symmetry = symmetry};
  fs_fair_options options = {.functional = fs_functional_find(functional), .constraints = &constraints};
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c), centre = {0, 0, 0};
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  fs_shape before = shape_of(&ctx, space, c), after;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &report), FS_OK);
  assert_int_not_equal(report.stop, FS_STOP_ITERATIONS);
  after = shape_of(&ctx, space, c);
  if (keep == FS_KEEP_VOLUME)
    assert_true(fabs(after.volume / before.volume - 1) <= 1e-10);
  else
    assert_true(fabs(after.area / before.area - 1) <= 1e-10);
  assert_true(fabs(report.kept) <= 1e-12);
  assert_true(fabs(36 * 3.14159265358979 * after.volume * after.volume / pow(after.area, 3) - 1) < 1e-3); /* a sphere */
  assert_true(after.area < before.area || keep == FS_KEEP_AREA);
  for (int32_t v = 0; v < space->n_vertices; v++)
    centre.x += c[v].x / space->n_vertices, centre.y += c[v].y / space->n_vertices,
        centre.z += c[v].z / space->n_vertices;
  for (int32_t v = 0; v < space->n_vertices; v++) {
    double r = hypot(hypot(c[v].x - centre.x, c[v].y - centre.y), c[v].z - centre.z);
    low = fmin(low, r), high = fmax(high, r);
    if (symmetry != NULL) assert_true(c[v].y == -c[symmetry->vertex[v]].y && c[v].x == c[symmetry->vertex[v]].x);
  }
  assert_true(high / low < 1.1);
  free(c);
  fs_symmetry_free(&ctx, symmetry);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  fs_mesh_free(&ctx, mesh);
}

static void test_kept(void **state) {
  (void)state;
  const fs_vec3 y = {0, 1, 0};
  check_kept(FS_KEEP_VOLUME, FS_CAPS_FULL, "curvature-variation", NULL, 1);
  if (TEST_IS_SANITIZED) return;
  check_kept(FS_KEEP_VOLUME, FS_CAPS_LINEAR, "penalised", NULL, 1);
  check_kept(FS_KEEP_AREA, FS_CAPS_LINEAR, "penalised", NULL, 1);
  check_kept(FS_KEEP_VOLUME, FS_CAPS_LINEAR, "penalised", &y, 1);
}

static void test_refusals(void **state) {
  (void)state;
  fs_context ctx = test_context();
  fs_mesh *torus = test_torus(8, 6, 3, 1), *grid = test_grid(8, 8, NULL);
  fs_space *space = NULL, *open = NULL;
  fs_constraints constraints = {.keep = FS_KEEP_VOLUME};
  fs_fair_options options = {.functional = fs_functional_find("area"), .constraints = &constraints};
  bool fixed[81] = {true};
  assert_int_equal(fs_space_create(&ctx, torus, &space), FS_OK);
  assert_int_equal(fs_space_create(&ctx, grid, &open), FS_OK);
  assert_int_equal(fs_fair(&ctx, space, &options, space->start, NULL), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "area depends on the size"));
  options.functional = NULL;
  options.fixed = fixed;
  assert_int_equal(fs_fair(&ctx, open, &options, open->start, NULL), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "the volume is kept where no places are given"));
  options.fixed = NULL;
  for (int32_t v = 0; v < torus->n_vertices; v++) space->start[v].z = 0; /* flat: nothing is enclosed */
  assert_int_equal(fs_fair(&ctx, space, &options, space->start, NULL), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "encloses"));
  fs_space_free(&ctx, space);
  fs_space_free(&ctx, open);
  fs_context_clear(&ctx);
  fs_mesh_free(&ctx, torus);
  fs_mesh_free(&ctx, grid);
}

static void test_memory(void **state) {
  (void)state;
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory), plain = test_context();
  fs_mesh *mesh = test_torus(8, 6, 3, 1);
  fs_space *space = NULL;
  fs_constraints constraints = {.keep = FS_KEEP_VOLUME};
  fs_fair_options options = {
      .functional = fs_functional_find("penalised"), .constraints = &constraints, .max_iterations = 1};
  fs_status status = FS_ERR_MEMORY;
  options.n_nodes_square = 2;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  for (int64_t n = 1; status == FS_ERR_MEMORY; n += 3) {
    int64_t live = memory.n_live;
    memory.fail_at = memory.n_allocations + n;
    status = fs_fair(&ctx, space, &options, c, NULL);
    assert_int_equal(memory.n_live, live);
    if (status != FS_OK) assert_memory_equal(c, space->start, (size_t)space->n_dofs * sizeof *c);
  }
  assert_int_equal(status, FS_OK);
  free(c);
  fs_space_free(&ctx, space);
  fs_mesh_free(&plain, mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_derivatives), cmocka_unit_test(test_kept),
                                     cmocka_unit_test(test_refusals), cmocka_unit_test(test_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
