/* SPDX-License-Identifier: MIT */
/* Fairing of the three-tube meshes against independently computed energies and minima (needs the shared folder). */
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

static void read_marks(const char *name, bool *fixed, int32_t n) {
  char relative[64], line[256];
  snprintf(relative, sizeof relative, "meshes/%s.fixed.txt", name);
  FILE *file = fopen(test_shared(relative), "r");
  assert_non_null(file);
  while (fgets(line, sizeof line, file) != NULL) {
    int vertex;
    char word[16];
    if (line[0] == '#') continue;
    assert_int_equal(sscanf(line, "%d %15s", &vertex, word), 2);
    assert_true(vertex >= 0 && vertex < n);
    if (strcmp(word, "fixed") == 0) fixed[vertex] = true;
  }
  fclose(file);
}

typedef struct expected_energy {
  double S_regular, S_caps, Q;
} expected_energy;

static fs_fair_report run_options(const char *name, bool with_marks, fs_fair_options options) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_shared_mesh(name);
  fs_space *space = NULL;
  fs_fair_report report;
  assert_non_null(mesh);
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
  assert_int_equal(fs_space_rim(&ctx, mesh, space, fixed), FS_OK);
  if (with_marks) read_marks(name, fixed, mesh->n_vertices);
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  options.fixed = fixed;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &report), FS_OK);
  free(fixed);
  free(c);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  fs_context mesh_ctx = test_context();
  fs_mesh_free(&mesh_ctx, mesh);
  return report;
}

static fs_fair_report run(const char *name, bool with_marks, int32_t nodes, int32_t max_iterations) {
  return run_options(name, with_marks,
                     (fs_fair_options){.functional = fs_functional_find("penalised"),
                                       .n_nodes_square = nodes,
                                       .n_nodes_cap = nodes,
                                       .max_iterations = max_iterations});
}

static void check_start(const char *name, int32_t nodes, expected_energy e) {
  fs_energy start = run(name, true, nodes, -1).start;
  assert_true(fabs(start.S - start.S_caps - e.S_regular) <= 1e-9 * e.S_regular);
  assert_true(fabs(start.S_caps - e.S_caps) <= 1e-8 * e.S_caps);
  assert_true(fabs(start.Q - e.Q) <= 1e-8 * e.Q);
}

static void test_start(void **state) {
  (void)state;
  check_start("trojnik3", 8, (expected_energy){458.241251513, 2.87569653739, 1.08768040282});
  check_start("trojnik3", 6, (expected_energy){458.241766105, 2.84524366545, 1.0880087151});
  check_start("trojnik4", 8, (expected_energy){3.34952210353, 0.652561051432, 0.152786551437});
  check_start("trojnik4", 6, (expected_energy){3.34952210927, 0.639302481391, 0.152870431176});
}

static void check_minimum(const char *name, bool with_marks, int32_t n_free, double F) {
  fs_fair_report r = run(name, with_marks, 8, 0);
  assert_int_equal(r.n_free, n_free);
  assert_true(fabs(r.end.F - F) <= 1e-7 * F);
  assert_true(r.end.gradient <= 1e-8 * r.start.gradient);
  assert_true(r.n_hessians <= 25);
  /* quadratic fall: the last gradients go down faster and faster */
  assert_true(r.n_trace >= 4);
  double a = r.trace[r.n_trace - 3].gradient, b = r.trace[r.n_trace - 2].gradient, c = r.trace[r.n_trace - 1].gradient;
  assert_true(c / b < 0.1 * (b / a) || c <= 1e-10 * r.start.gradient);
}

static void test_minimum(void **state) {
  (void)state;
  check_minimum("trojnik3", true, 189, 8.194950338);
  if (TEST_IS_SANITIZED) return;
  check_minimum("trojnik3", false, 215, 6.656088775);
  check_minimum("trojnik4", true, 945, 10.86828334);
}

/* The curvature variation itself. Independent values for C = 1e-4: 3.10357, 2.83924 (with 8 nodes in caps). Polished, trojnik3
   passes a saddle at S = 3.0724 that a symmetric start would stay at; an independent value at C = 1e-6: 2.99759. 0: not asked. */
static void check_fairest(const char *name, double S, double S_polished) {
  fs_fair_options options = {.n_nodes_square = 8, .n_nodes_cap = 8};
  fs_fair_report r = run_options(name, true, options);
  assert_true(fabs(r.end.S - S) <= 1e-5 * S);
  if (S_polished == 0) return;
  options.polish = true;
  r = run_options(name, true, options);
  assert_true(r.end.S <= S_polished);
  assert_true(r.n_saddles >= 1 && r.stop == FS_STOP_DECREASE);
}

static void test_fairest(void **state) {
  (void)state;
  check_fairest("trojnik3", 3.10357, 2.999);
  if (!TEST_IS_SANITIZED) check_fairest("trojnik4", 2.83924, 0);
}

static void test_sizes(void **state) {
  (void)state;
  fs_fair_report r = run("trojnik3", true, 4, -1);
  assert_int_equal(r.n_squares, 288);
  assert_int_equal(r.n_caps, 2);
  assert_true(fabs(r.c - 3.83982992572) <= 1e-10);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_sizes),
      cmocka_unit_test(test_start),
      cmocka_unit_test(test_minimum),
      cmocka_unit_test(test_fairest),
  };
  if (test_shared("meshes/trojnik3.obj") == NULL) return TEST_SKIPPED;
  return cmocka_run_group_tests(tests, NULL, NULL);
}
