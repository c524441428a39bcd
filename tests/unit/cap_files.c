/* SPDX-License-Identifier: MIT */
/* Inner coefficients in files: what is written with a control net makes the same surface when it is read again. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include <fairsurf/fairsurf.h>
#include "memory_output.h"
#include "support.h"

/* A 6-prism refined twice, caps of valence 3 and 6, with random coefficients in two of three caps. */
typedef struct sample {
  fs_context ctx;
  fs_mesh *mesh;
  fs_space *space;
  fs_surface *surface;
  fs_vec3 *c;
  fs_cap_notes *notes;
} sample;

static void sample_open(sample *s) {
  uint64_t seed = 17;
  s->ctx = test_context();
  s->mesh = test_prism(6);
  for (int i = 0; i < 2; i++) {
    fs_refinement *step;
    assert_int_equal(fs_mesh_refine(&s->ctx, s->mesh, "averaging", NULL, &step), FS_OK);
    fs_mesh_free(&s->ctx, s->mesh);
    assert_int_equal(fs_mesh_copy(&s->ctx, step->mesh, &s->mesh), FS_OK);
    fs_refinement_free(&s->ctx, step);
  }
  test_mesh_disturb(s->mesh, 0.01, &seed);
  assert_int_equal(fs_space_create_with(&s->ctx, s->mesh, &(fs_space_options){.caps = FS_CAPS_FULL}, &s->space), FS_OK);
  s->c = calloc((size_t)s->space->n_dofs, sizeof *s->c);
  memcpy(s->c, s->space->start, (size_t)s->space->n_dofs * sizeof *s->c);
  for (int32_t i = 0; i < s->space->n_caps; i++) {
    const fs_cap *cap = &s->space->cap[i];
    for (int32_t d = cap->first_dof; i % 3 > 0 && d < cap->first_dof + cap->n_dofs; d++)
      s->c[d] = (fs_vec3){test_random_real(&seed, -0.1, 0.1), test_random_real(&seed, -0.1, 0.1),
                          test_random_real(&seed, -0.1, 0.1)};
  }
  assert_int_equal(fs_space_keep_caps(&s->ctx, s->mesh, s->space, s->c, &s->notes), FS_OK);
  assert_int_equal(fs_surface_create(&s->ctx, s->space, s->c, &s->surface), FS_OK);
}

static void sample_close(sample *s) {
  fs_cap_notes_free(&s->ctx, s->notes);
  fs_surface_free(&s->ctx, s->surface);
  fs_space_free(&s->ctx, s->space);
  fs_mesh_free(&s->ctx, s->mesh);
  free(s->c);
  fs_context_clear(&s->ctx);
}

/* The largest distance of the middle of a patch from the nearest one of the other surface, whatever their order. */
static double surface_distance(const fs_surface *a, const fs_surface *b) {
  double largest = 0;
  fs_vec3 p[FS_JET_SIZE], q[FS_JET_SIZE];
  assert_int_equal(a->n_patches, b->n_patches);
  for (int32_t i = 0; i < a->n_patches; i++) {
    double least = (double)INFINITY;
    fs_surface_evaluate(a, i, 0.5, 0.5, p);
    for (int32_t j = 0; j < b->n_patches; j++) {
      fs_surface_evaluate(b, j, 0.5, 0.5, q);
      least = fmin(least, hypot(hypot(p->x - q->x, p->y - q->y), p->z - q->z));
    }
    largest = fmax(largest, least);
  }
  return largest;
}

static fs_surface *surface_of(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes) {
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  fs_space_options options = {.caps = FS_CAPS_FULL, .kept = notes};
  assert_int_equal(fs_space_create_with(ctx, mesh, &options, &space), FS_OK);
  assert_int_equal(fs_surface_create(ctx, space, space->start, &surface), FS_OK);
  fs_space_free(ctx, space);
  return surface;
}

/* Writes the net, reads it again. parameter: of the exporter, or NULL. */
static void check_net(sample *s, const char *extension, const char *parameter, double value, double tolerance) {
  fs_model model = {.name = "prism", .control = s->mesh, .caps = s->notes};
  const fs_exporter *exporter = fs_exporter_find(extension);
  double param[32];
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  fs_mesh *mesh = NULL;
  fs_mesh_notes notes;
  fs_surface *surface;
  for (int k = 0; exporter->params[k].name != NULL; k++) param[k] = exporter->params[k].initial;
  if (parameter != NULL) memory_output_set(exporter, param, parameter, value);
  assert_int_equal(fs_export(&s->ctx, &model, exporter, param, &output), FS_OK);
  assert_int_equal(fs_mesh_parse_notes(&s->ctx, extension, file.bytes, file.size, &mesh, &notes), FS_OK);
  assert_non_null(notes.caps);
  assert_int_equal(notes.caps->n_caps, s->notes->n_caps);
  assert_int_equal(notes.caps->n_coefficients, s->notes->n_coefficients);
  assert_memory_equal(notes.caps->coefficient, s->notes->coefficient,
                      (size_t)s->notes->n_coefficients * sizeof *s->notes->coefficient);
  surface = surface_of(&s->ctx, mesh, notes.caps);
  assert_true(surface_distance(s->surface, surface) <= tolerance);
  assert_true(surface_distance(surface, s->surface) <= tolerance);
  fs_surface_free(&s->ctx, surface);
  fs_mesh_notes_clear(&s->ctx, &notes);
  fs_mesh_free(&s->ctx, mesh);
  free(file.bytes);
}

static void test_nets(void **state) {
  sample s;
  (void)state;
  sample_open(&s);
  fs_surface *linear = surface_of(&s.ctx, s.mesh, NULL);
  assert_true(surface_distance(s.surface, linear) > 1e-3); /* or else nothing is shown */
  fs_surface_free(&s.ctx, linear);
  check_net(&s, "ply", NULL, 0, 0);
  check_net(&s, "ply", "format", 1, 0);
  sample_close(&s);
}

/* Files without coefficients, and surfaces, are what they were. */
static void test_absent(void **state) {
  sample s;
  memory_output file = {0};
  fs_mesh *mesh = NULL;
  fs_mesh_notes notes;
  (void)state;
  sample_open(&s);
  fs_model model = {.name = "prism", .control = s.mesh};
  fs_output output = memory_output_of(&file);
  assert_int_equal(fs_export(&s.ctx, &model, fs_exporter_find("ply"), NULL, &output), FS_OK);
  assert_null(strstr(file.bytes, "fairsurf_cap"));
  assert_int_equal(fs_mesh_parse_notes(&s.ctx, "ply", file.bytes, file.size, &mesh, &notes), FS_OK);
  assert_null(notes.caps);
  fs_mesh_notes_clear(&s.ctx, &notes);
  fs_mesh_free(&s.ctx, mesh);
  free(file.bytes);
  file = (memory_output){0};
  model.surface = s.surface;
  model.caps = s.notes;
  assert_int_equal(fs_export(&s.ctx, &model, fs_exporter_find("ply"), NULL, &output), FS_OK);
  assert_null(strstr(file.bytes, "fairsurf_cap"));
  free(file.bytes);
  sample_close(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_nets), cmocka_unit_test(test_absent)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
