/* SPDX-License-Identifier: MIT */
/* Single role: tests of STEP files as text: syntax, counts, bodies, tokens; failures are reported. Other people's reader
   takes the files in tests/step. */
#include "surface_samples.h"
#include "../support/support.h"
#include "step.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

#include <stdio.h>
#include <string.h>

/* ---- an output in memory ---- */

typedef struct memory_file {
  char *bytes;
  size_t size;
  int32_t n_writes, refuse_at; /* the write, from 1, that fails; 0: none */
} memory_file;

static fs_status memory_write(void *user, const void *bytes, size_t size) {
  memory_file *file = user;
  if (++file->n_writes == file->refuse_at) return FS_ERR_IO;
  file->bytes = realloc(file->bytes, file->size + size + 1);
  memcpy(file->bytes + file->size, bytes, size);
  file->size += size;
  file->bytes[file->size] = '\0';
  return FS_OK;
}

static fs_status memory_open(void *user, const char *extension, fs_sink *sink) {
  assert_string_equal(extension, "step");
  *sink = (fs_sink){memory_write, user};
  return FS_OK;
}

static fs_status export_to(fs_context *ctx, const fs_surface *surface, bool is_merging, memory_file *file) {
  fs_output output = {memory_open, file};
  fs_model model = {.name = "part", .surface = surface};
  const double param[] = {is_merging, FS_STEP_MM, 1e-4};
  return fs_export(ctx, &model, fs_exporter_find("step"), param, &output);
}

static memory_file export_surface(const fs_surface *surface, bool is_merging) {
  fs_context ctx = test_context();
  memory_file file = {0};
  if (export_to(&ctx, surface, is_merging, &file) != FS_OK) fail_msg("%s", ctx.message);
  return file;
}

static int32_t count(const char *text, const char *word) {
  int32_t n = 0;
  for (; (text = strstr(text, word)) != NULL; text++) n++;
  return n;
}

static int every_fifth(int i, int j) { return (i + 2 * j) % 5 == 0; }

/* Cuts a surface open along one side of a patch. */
static void cut(fs_surface *surface, int32_t p, int32_t s) {
  fs_patch *patch = &surface->patch[p];
  if (patch->neighbour[s] == FS_NONE) return;
  surface->patch[patch->neighbour[s]].neighbour[patch->neighbour_side[s]] = FS_NONE;
  patch->neighbour[s] = FS_NONE;
}

/* ---- the file ---- */

/* Entities are numbered 1, 2, .. and refer to earlier ones only; brackets and quotes close. */
static void check_syntax(const char *text) {
  const char *line = strstr(text, "DATA;\n") + strlen("DATA;\n");
  long expected = 1;
  while (*line == '#') {
    int depth = 0;
    char *end;
    bool in_string = false;
    assert_int_equal(strtol(line + 1, &end, 10), expected);
    assert_int_equal(*end, '=');
    for (line = end + 1; *line != ';' || in_string; line++) {
      assert_int_not_equal(*line, '\0');
      if (*line == '\'') in_string = !in_string;
      if (in_string) continue;
      depth += (*line == '(') - (*line == ')');
      assert_true(depth >= 0);
      if (*line == '#') assert_true(strtol(line + 1, NULL, 10) < expected && strtol(line + 1, NULL, 10) > 0);
    }
    assert_int_equal(depth, 0);
    line += 2;
    expected++;
  }
  assert_string_equal(line, "ENDSEC;\nEND-ISO-10303-21;\n");
}

static void test_closed_surfaces_are_solids(void **state) {
  fs_surface *surface = sample_torus(6, 5, every_fifth, 0.01);
  memory_file file = export_surface(surface, false), merged = export_surface(surface, true);
  (void)state;
  check_syntax(file.bytes);
  check_syntax(merged.bytes);
  assert_int_equal(strncmp(file.bytes, "ISO-10303-21;\nHEADER;\n", 22), 0);
  assert_int_equal(count(file.bytes, "=ADVANCED_FACE("), 30);
  assert_int_equal(count(file.bytes, "=VERTEX_POINT("), 30);
  assert_int_equal(count(file.bytes, "=EDGE_CURVE("), 60);
  assert_int_equal(count(file.bytes, ",.T.);\n") - count(file.bytes, "ED_FACE(") - count(file.bytes, "OUTER_BOUND("),
                   120);
  assert_int_equal(count(file.bytes, "=ORIENTED_EDGE('',*,*,#"), 120);
  assert_int_equal(count(file.bytes, ",.F.);\n"), 60);
  assert_int_equal(count(file.bytes, "=B_SPLINE_CURVE_WITH_KNOTS('',3,"), 60);
  assert_int_equal(count(file.bytes, "=B_SPLINE_SURFACE_WITH_KNOTS('',9,9,"), 6);
  assert_int_equal(count(file.bytes, "=MANIFOLD_SOLID_BREP("), 1);
  assert_int_equal(count(file.bytes, "=CLOSED_SHELL("), 1);
  assert_int_equal(count(file.bytes, "OPEN_SHELL"), 0);
  assert_true(merged.size < file.size);
  sample_free(surface);
  free(file.bytes);
  free(merged.bytes);
}

/* A torus of 4 x 4 patches and one of 3 x 4 cut open: a solid and a shell. */
static void test_components_are_bodies(void **state) {
  fs_surface *closed = sample_torus(4, 4, NULL, 0), *open = sample_torus(3, 4, NULL, 0), both = {0};
  memory_file file;
  (void)state;
  cut(open, 5, 2);
  both.n_patches = closed->n_patches + open->n_patches;
  both.patch = calloc((size_t)both.n_patches, sizeof *both.patch);
  both.data = calloc(closed->n_data + open->n_data, sizeof *both.data);
  memcpy(both.data, closed->data, closed->n_data * sizeof *both.data);
  memcpy(both.data + closed->n_data, open->data, open->n_data * sizeof *both.data);
  memcpy(both.patch, closed->patch, (size_t)closed->n_patches * sizeof *both.patch);
  for (int32_t p = 0; p < open->n_patches; p++) {
    fs_patch *patch = &both.patch[closed->n_patches + p];
    *patch = open->patch[p];
    patch->data_start += closed->n_data;
    for (int32_t s = 0; s < 4; s++)
      if (patch->neighbour[s] != FS_NONE) patch->neighbour[s] += closed->n_patches;
  }
  file = export_surface(&both, true);
  check_syntax(file.bytes);
  assert_int_equal(count(file.bytes, "=MANIFOLD_SOLID_BREP("), 1);
  assert_int_equal(count(file.bytes, "=SHELL_BASED_SURFACE_MODEL("), 1);
  assert_int_equal(count(file.bytes, "=OPEN_SHELL("), 1);
  assert_int_equal(count(file.bytes, "=SHAPE_REPRESENTATION_RELATIONSHIP("), 2);
  free(both.patch);
  free(both.data);
  free(file.bytes);
  sample_free(closed);
  sample_free(open);
}

static void test_faces_that_look_inwards_are_noted(void **state) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_surface *surface = sample_torus(4, 4, NULL, 0);
  memory_file file = {0};
  (void)state;
  assert_int_equal(export_to(&ctx, surface, true, &file), FS_OK);
  assert_int_equal(memory.n_notes, 0);
  for (size_t k = 0; k < surface->n_data; k += 3) surface->data[k] = -surface->data[k];
  assert_int_equal(export_to(&ctx, surface, true, &file), FS_OK);
  assert_int_equal(memory.n_notes, 1);
  assert_non_null(strstr(memory.note, "inside out"));
  free(file.bytes);
  sample_free(surface);
}

/* ---- tokens ---- */

static void check_token(void (*put)(fs_step_file *step, const void *value), const void *value, const char *expected) {
  fs_context ctx = test_context();
  memory_file file = {0};
  fs_output output = {memory_open, &file};
  fs_step_file step = {0};
  fs_writer_start(&step.writer, &ctx, &output, "step");
  put(&step, value);
  assert_int_equal(fs_writer_finish(&step.writer), FS_OK);
  assert_string_equal(file.bytes, expected);
  free(file.bytes);
}

static void put_real(fs_step_file *step, const void *value) { fs_step_real(step, *(const double *)value); }
static void put_string(fs_step_file *step, const void *value) { fs_step_string(step, value); }

static void test_reals_have_a_point(void **state) {
  static const struct {
    double number;
    const char *text;
  } known[] = {{0, "0."},        {-0., "0."},      {1, "1."},
               {-25.4, "-25.4"}, {1e-6, "1.E-06"}, {1.5e300, "1.5E+300"},
               {1e22, "1.E+22"}, {0.1, "0.1"},     {1. / 3, "0.3333333333333333"}};
  (void)state;
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) check_token(put_real, &known[k].number, known[k].text);
}

static void test_strings_are_plain_ascii(void **state) {
  (void)state;
  check_token(put_string, "a part", "'a part'");
  check_token(put_string, "it's a \\", "'it''s a \\\\'");
  check_token(put_string, "two\nlines\177", "'two lines '");
  check_token(put_string, "Gehäuse", "'Geh\\X2\\00E4\\X0\\use'");
  check_token(put_string, "\xe2\x82\xac \xf0\x9f\x9b\xa5", "'\\X2\\20AC\\X0\\ \\X4\\0001F6E5\\X0\\'");
  check_token(put_string, "\xff \xc3 \xed\xa0\x80. \xc0\xaf. \xe2 \x82.", "'? ? ???. ??. ? ?.'");
  check_token(put_string, "", "''");
}

/* ---- failures ---- */

static void test_every_failure_is_reported(void **state) {
  fs_surface *surface = sample_torus(4, 5, every_fifth, 0.01);
  (void)state;
  for (int64_t k = 1;; k++) {
    struct test_memory memory = {.fail_at = k};
    fs_context ctx = test_memory_context(&memory);
    memory_file file = {0};
    fs_status status = export_to(&ctx, surface, true, &file);
    free(file.bytes);
    assert_int_equal(memory.n_live, 0);
    if (status == FS_OK) {
      assert_true(k > 15);
      break;
    }
    assert_int_equal(status, FS_ERR_MEMORY);
  }
  for (int32_t k = 1;; k++) {
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    memory_file file = {.refuse_at = k};
    fs_status status = export_to(&ctx, surface, true, &file);
    free(file.bytes);
    assert_int_equal(memory.n_live, 0);
    if (file.n_writes < k) {
      assert_int_equal(status, FS_OK);
      break;
    }
    assert_int_equal(status, FS_ERR_IO);
  }
  sample_free(surface);
}

static void test_bad_surfaces_are_refused(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = sample_torus(4, 4, NULL, 0), empty = {0};
  memory_file file = {0};
  (void)state;
  assert_int_equal(export_to(&ctx, &empty, true, &file), FS_ERR_ARGUMENT);
  surface->data[surface->patch[7].data_start + 20] = NAN;
  assert_int_equal(export_to(&ctx, surface, true, &file), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "patch 7 "));
  surface->data[surface->patch[7].data_start + 20] = 0;
  surface->patch[3].degree_u = 0;
  assert_int_equal(export_to(&ctx, surface, true, &file), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "patch 3 "));
  assert_int_equal(file.n_writes, 0);
  sample_free(surface);
}

static bool stop(void *user, const char *stage, double fraction) { return (void)user, (void)stage, fraction < 0; }

static void test_cancelling(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = sample_torus(4, 4, NULL, 0);
  memory_file file = {0};
  (void)state;
  ctx.progress = stop;
  assert_int_equal(export_to(&ctx, surface, true, &file), FS_ERR_CANCELLED);
  free(file.bytes);
  sample_free(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_closed_surfaces_are_solids),        cmocka_unit_test(test_components_are_bodies),
      cmocka_unit_test(test_faces_that_look_inwards_are_noted), cmocka_unit_test(test_reals_have_a_point),
      cmocka_unit_test(test_strings_are_plain_ascii),           cmocka_unit_test(test_every_failure_is_reported),
      cmocka_unit_test(test_bad_surfaces_are_refused),          cmocka_unit_test(test_cancelling),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
