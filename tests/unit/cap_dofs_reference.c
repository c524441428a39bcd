/* SPDX-License-Identifier: MIT */
/* Minima with inner coefficients of caps against those of an independent program: a closed cube, where they take most of
   the energy away, and a three-tube mesh (needs the shared folder). */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include <fairsurf/fairsurf.h>
#include "support.h"

/* Fairs with C = 0.01 and then a tenth of it each time, each run starting from the last result. */
static fs_energy fair_in_steps(const fs_mesh *mesh, fs_cap_inner caps, const char *functional, const bool *marks,
                               double last_C) {
  fs_context ctx = test_context();
  fs_space *space = NULL;
  fs_fair_report report;
  assert_int_equal(fs_space_create_with(&ctx, mesh, &(fs_space_options){.caps = caps}, &space), FS_OK);
  bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
  assert_int_equal(fs_space_rim(&ctx, mesh, space, fixed), FS_OK);
  for (int32_t v = 0; v < mesh->n_vertices && marks != NULL; v++) fixed[v] |= marks[v];
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  for (double C = 0.01; C > 0.9 * last_C; C /= 10) {
    fs_fair_options options = {
        .functional = fs_functional_find(functional), .param = &C, .fixed = fixed, .n_nodes_cap = 12};
    if (marks == NULL) options.fixed = NULL;
    assert_int_equal(fs_fair(&ctx, space, &options, c, &report), FS_OK);
    assert_true(report.end.gradient <= 1e-4 * report.start.gradient);
  }
  free(fixed);
  free(c);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  return report.end;
}

/* A cube refined twice, C = 1e-5: S times the area. */
static void test_closed(void **state) {
  static const double expected[3] = {[FS_CAPS_LINEAR] = 15.75, [FS_CAPS_SMOOTH] = 3.986, [FS_CAPS_FULL] = 2.048};
  fs_context ctx = test_context();
  fs_mesh *cube = test_cube();
  fs_refinement *once, *twice;
  (void)state;
  assert_int_equal(fs_mesh_refine(&ctx, cube, "averaging", NULL, &once), FS_OK);
  assert_int_equal(fs_mesh_refine(&ctx, once->mesh, "averaging", NULL, &twice), FS_OK);
  for (int caps = TEST_IS_SANITIZED ? FS_CAPS_SMOOTH : 0; caps < (TEST_IS_SANITIZED ? FS_CAPS_FULL : 3); caps++) {
    fs_energy e = fair_in_steps(twice->mesh, (fs_cap_inner)caps, "scale-free-penalised", NULL, 1e-5);
    double area = 0;
    const fs_functional *functional = fs_functional_find("scale-free-penalised");
    for (int32_t t = 0; t < functional->n_terms; t++)
      if (functional->term[t] == &fs_density_area) area = e.integral[t];
    print_message("cube, caps %d: S A = %.6f\n", caps, e.S * area);
    assert_true(fabs(e.S * area - expected[caps]) <= (caps == 0 ? 5e-3 : 6e-4)); /* the digits that are known */
  }
  fs_refinement_free(&ctx, once);
  fs_refinement_free(&ctx, twice);
  fs_mesh_free(&ctx, cube);
}

static void read_marks(const char *relative, bool *marks, int32_t n) {
  char line[256], word[16];
  int vertex;
  FILE *file = fopen(test_shared(relative), "r");
  assert_non_null(file);
  while (fgets(line, sizeof line, file) != NULL)
    if (line[0] != '#') {
      assert_int_equal(sscanf(line, "%d %15s", &vertex, word), 2);
      assert_true(vertex >= 0 && vertex < n);
      if (strcmp(word, "fixed") == 0) marks[vertex] = true;
    }
  fclose(file);
}

/* Three tubes that meet, two caps of valence 6, C = 1e-4: the functional. */
static void test_tubes(void **state) {
  static const double expected[3] = {3.17950, 2.98992, 2.95923};
  fs_context ctx = test_context();
  fs_mesh *mesh = test_shared_mesh("trojnik3");
  (void)state;
  assert_non_null(mesh);
  bool *marks = calloc((size_t)mesh->n_vertices, sizeof *marks);
  read_marks("meshes/trojnik3.fixed.txt", marks, mesh->n_vertices);
  for (int caps = TEST_IS_SANITIZED ? FS_CAPS_FULL : 0; caps < 3; caps++) {
    fs_energy e = fair_in_steps(mesh, (fs_cap_inner)caps, "penalised", marks, 1e-4);
    print_message("tubes, caps %d: F = %.6f\n", caps, e.F);
    assert_true(fabs(e.F - expected[caps]) <= 6e-6);
  }
  free(marks);
  fs_mesh_free(&ctx, mesh);
}

int main(void) {
  const struct CMUnitTest cube[] = {cmocka_unit_test(test_closed)}, tubes[] = {cmocka_unit_test(test_tubes)};
  int failed = cmocka_run_group_tests(cube, NULL, NULL);
  if (failed != 0) return failed;
  if (test_shared("meshes/trojnik3.obj") == NULL) return TEST_SKIPPED;
  return cmocka_run_group_tests(tubes, NULL, NULL);
}
