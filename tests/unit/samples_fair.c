/* SPDX-License-Identifier: MIT */
/* Samples as the program fairs them by default: at once they converge, refined ones over coarse displacements, to the minimum found
   before, and what is fixed stays to the last bit. */
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

/* The faired pipe, refined once or as it is; *c receives its dofs. */
static fs_fair_report fair_pipe(bool is_refined, fs_cap_inner caps, int32_t n_threads,
                                bool (*monitor)(void *, const fs_step *), fs_vec3 **c) {
  fs_context ctx = test_context();
  char path[1024];
  fs_mesh *mesh;
  fs_refinement *refinement = NULL;
  const fs_mesh *net;
  fs_space *space;
  fs_fair_report report;
  bool *fixed;
  ctx.n_threads = n_threads;
  snprintf(path, sizeof path, "%s/pipe.obj", getenv("FAIRSURF_SAMPLES"));
  assert_int_equal(fs_mesh_read(&ctx, path, &mesh), FS_OK);
  if (is_refined) assert_int_equal(fs_mesh_refine(&ctx, mesh, "averaging", NULL, &refinement), FS_OK);
  net = is_refined ? refinement->mesh : mesh;
  assert_int_equal(fs_space_create_with(&ctx, net, &(fs_space_options){.caps = caps}, &space), FS_OK);
  fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  assert_int_equal(fs_space_rim(&ctx, net, space, fixed), FS_OK);
  *c = calloc((size_t)space->n_dofs, sizeof **c);
  memcpy(*c, space->start, (size_t)space->n_dofs * sizeof **c);
  fs_fair_options options = {
      .functional = fs_functional_find("curvature-variation"), .mesh = net, .fixed = fixed, .monitor = monitor};
  assert_int_equal(fs_fair(&ctx, space, &options, *c, &report), FS_OK);
  for (int32_t d = 0; d < space->n_dofs; d++)
    if (fixed[d]) assert_memory_equal(&(*c)[d], &space->start[d], sizeof **c);
  free(fixed);
  fs_space_free(&ctx, space);
  fs_refinement_free(&ctx, refinement);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
  return report;
}

static void test_full_caps(void **state) {
  fs_vec3 *c;
  fs_fair_report r;
  (void)state;
  if (TEST_IS_SANITIZED) skip(); /* other suites run the same code */
  r = fair_pipe(false, FS_CAPS_FULL, 1, NULL, &c);
  assert_int_equal(r.stop, FS_STOP_GRADIENT);
  assert_true(r.end.F <= 0.70313);
  assert_true(r.n_factorisations <= 2 * r.n_hessians);
  free(c);
}

static void test_refined(void **state) {
  fs_vec3 *c;
  fs_fair_report r;
  (void)state;
  if (TEST_IS_SANITIZED) skip(); /* test_cancel runs the same code */
  r = fair_pipe(true, FS_CAPS_LINEAR, 2, NULL, &c);
  assert_int_equal(r.n_coarse, 1);
  assert_int_equal(r.stop, FS_STOP_GRADIENT);
  assert_true(fabs(r.end.F - 0.5491211578) <= 1e-9);
  free(c);
}

static bool stop_at_3(void *user, const fs_step *step) {
  (void)user;
  return step->number < 3;
}

/* On a coarse mesh. */
static void test_cancel(void **state) {
  fs_vec3 *c;
  fs_fair_report r = fair_pipe(true, FS_CAPS_LINEAR, 2, stop_at_3, &c);
  (void)state;
  assert_int_equal(r.stop, FS_STOP_CANCELLED);
  assert_int_equal(r.n_steps, 3);
  assert_true(r.end.F < 0.5 * r.start.F); /* what was found there is kept */
  free(c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_full_caps),
      cmocka_unit_test(test_refined),
      cmocka_unit_test(test_cancel),
  };
  if (getenv("FAIRSURF_SAMPLES") == NULL) {
    print_message("skipped: FAIRSURF_SAMPLES does not say where the sample meshes are\n");
    return 77;
  }
  return cmocka_run_group_tests(tests, NULL, NULL);
}
