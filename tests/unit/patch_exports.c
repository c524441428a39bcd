/* SPDX-License-Identifier: MIT */
/* Every exporter takes a closed surface of patches of three and four sides of all kinds, or says what it needs. */
#include "memory_output.h"
#include "patch_samples.h"

#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static int count(const char *text, const char *word) {
  int n = 0;
  for (; (text = strstr(text, word)) != NULL; text++) n++;
  return n;
}

/* Writes with one parameter changed; NULL: none. */
static memory_output export(const char *extension, const char *name, double value) {
  fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD);
  const fs_exporter *exporter = fs_exporter_find(extension);
  fs_context ctx = test_context();
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  fs_model model = {.name = "pyramid", .surface = s, .colour = fs_measures[0]};
  double param[32] = {0};
  for (int k = 0; exporter->params != NULL && exporter->params[k].name != NULL; k++)
    param[k] = exporter->params[k].initial;
  if (name != NULL) memory_output_set(exporter, param, name, value);
  if (fs_export(&ctx, &model, exporter, param, &output) != FS_OK) fail_msg("%s: %s", extension, ctx.message);
  sample_pyramid_free(s);
  return file;
}

static void test_all(void **state) {
  fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD);
  (void)state;
  for (int k = 0; fs_exporters[k] != NULL; k++) {
    if (fs_exporters[k]->what != FS_EXPORT_NET) {
      memory_output file = export(fs_exporters[k]->extension, NULL, 0);
      assert_true(file.size > 500);
      free(file.bytes);
      continue;
    }
    fs_context ctx = test_context();
    memory_output file = {0};
    fs_output output = memory_output_of(&file);
    fs_model model = {.name = "pyramid", .surface = s};
    assert_int_not_equal(fs_export(&ctx, &model, fs_exporters[k], NULL, &output), FS_OK);
    assert_true(strlen(ctx.message) > 10);
    assert_int_equal(file.size, 0);
  }
  sample_pyramid_free(s);
}

static void test_povray(void **state) {
  memory_output bicubic = export("pov", "tolerance", 1e-2), mesh = export("pov", "pov", 1);
  double n = 0;
  (void)state;
  assert_non_null(strstr(bicubic.bytes, "// 16 patches: 0 of degree 3 or less, exact; 16 of other kinds,"));
  assert_int_equal(count(bicubic.bytes, "bicubic_patch {") % 16, 0);
  assert_non_null(memory_output_numbers(bicubic.bytes, "largest deviation", 1, &n));
  if (!(n > 0 && n < 0.05)) fail_msg("%g in %.900s", n, bicubic.bytes);
  assert_non_null(strstr(mesh.bytes, "inside_vector")); /* closed */
  free(bicubic.bytes);
  free(mesh.bytes);
}

/* One closed shell, bicubic faces within the tolerance. */
static void test_step(void **state) {
  memory_output rough = export("step", "tolerance", 1e-1), fine = export("step", "tolerance", 1e-3);
  (void)state;
  assert_int_equal(count(rough.bytes, "=MANIFOLD_SOLID_BREP("), 1);
  assert_int_equal(count(fine.bytes, "=MANIFOLD_SOLID_BREP("), 1);
  assert_int_equal(count(rough.bytes, "=OPEN_SHELL("), 0);
  assert_true(count(rough.bytes, "=ADVANCED_FACE(") < count(fine.bytes, "=ADVANCED_FACE("));
  free(rough.bytes);
  free(fine.bytes);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_all), cmocka_unit_test(test_povray),
                                     cmocka_unit_test(test_step)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
