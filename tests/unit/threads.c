/* SPDX-License-Identifier: MIT */
/* The number of threads changes nothing: fairing, evaluation and export give the same bits for 1, 2 and 3. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include <fairsurf/fairsurf.h>
#include "memory_output.h"
#include "support.h"

enum { MOST = 3, STEPS = 3 };

static const char *const formats[] = {"pov", "stl", "ply", "step", "glb", "scad"};
enum { N_FORMATS = sizeof formats / sizeof formats[0] };

typedef struct outcome {
  fs_vec3 *c;
  int32_t n_dofs;
  fs_fair_report report;
  memory_output file[N_FORMATS];
} outcome;

/* From a rough mesh to files with so many threads. */
static outcome run(int32_t n_threads) {
  outcome o = {0};
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(5, 6);
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  uint64_t seed = 5;
  ctx.n_threads = n_threads;
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].z += test_random_real(&seed, -0.05, 0.05);
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  o.n_dofs = space->n_dofs;
  o.c = malloc((size_t)space->n_dofs * sizeof *o.c);
  memcpy(o.c, space->start, (size_t)space->n_dofs * sizeof *o.c);
  assert_int_equal(fs_space_rim(&ctx, mesh, space, fixed), FS_OK);
  fs_fair_options options = {.fixed = fixed, .n_nodes_square = 4, .n_nodes_cap = 6, .max_iterations = STEPS};
  assert_int_equal(fs_fair(&ctx, space, &options, o.c, &o.report), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, space, o.c, &surface), FS_OK);
  for (int i = 0; i < N_FORMATS; i++) {
    fs_output output = memory_output_of(&o.file[i]);
    fs_model model = {.name = "star", .control = mesh, .surface = surface};
    assert_int_equal(fs_export(&ctx, &model, fs_exporter_find(formats[i]), NULL, &output), FS_OK);
  }
  free(fixed);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
  return o;
}

static void test_same_bits(void **state) {
  outcome one = run(1);
  (void)state;
  assert_int_equal(one.report.n_steps, STEPS);
  for (int32_t n = 2; n <= MOST; n++) {
    outcome more = run(n);
    assert_int_equal(more.report.n_factorisations, one.report.n_factorisations);
    assert_memory_equal(&more.report.end, &one.report.end, sizeof one.report.end);
    assert_memory_equal(&more.report.quality, &one.report.quality, sizeof one.report.quality);
    assert_memory_equal(more.c, one.c, (size_t)one.n_dofs * sizeof *one.c);
    for (int i = 0; i < N_FORMATS; i++) {
      assert_int_equal(more.file[i].size, one.file[i].size);
      assert_memory_equal(more.file[i].bytes, one.file[i].bytes, one.file[i].size);
      free(more.file[i].bytes);
    }
    free(more.c);
  }
  for (int i = 0; i < N_FORMATS; i++) free(one.file[i].bytes);
  free(one.c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_same_bits)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
