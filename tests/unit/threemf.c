/* SPDX-License-Identifier: MIT */
/* Single role: tests of the 3MF exporter: the archive and what its model says. Another reader's opinion is in
   tests/threemf. */
#include "memory_output.h"
#include "surface_samples.h"
#include "../support/support.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

#include <zip.h>

static const double steps[] = {2};

static memory_output export(const fs_surface *surface, const char *name, const char *made_with) {
  fs_context ctx = test_context();
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  fs_model model = {.name = name, .surface = surface, .made_with = made_with};
  if (fs_export(&ctx, &model, fs_exporter_find("3mf"), steps, &output) != FS_OK) fail_msg("%s", ctx.message);
  assert_string_equal(file.extension, "3mf");
  assert_int_equal(file.n_opened, 1);
  return file;
}

/* The text of a part of the archive; the caller frees. */
static char *unpack(const memory_output *file, const char *part) {
  zip_source_t *source = zip_source_buffer_create(file->bytes, file->size, 0, NULL);
  zip_t *archive = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, NULL);
  zip_stat_t about;
  zip_file_t *reader;
  char *text;
  assert_non_null(archive);
  assert_int_equal(zip_get_num_entries(archive, 0), 3);
  assert_int_equal(zip_stat(archive, part, 0, &about), 0);
  text = calloc(about.size + 1, 1);
  reader = zip_fopen(archive, part, 0);
  assert_int_equal(zip_fread(reader, text, about.size), (zip_int64_t)about.size);
  assert_int_equal(zip_fclose(reader), 0);
  zip_discard(archive);
  return text;
}

static void test_model(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = sample_torus(5, 4, NULL, 0);
  fs_triangles *t = NULL;
  memory_output file = export(surface, "ring", "by hand");
  char *text = unpack(&file, "3D/3dmodel.model"), *types = unpack(&file, "[Content_Types].xml");
  char *relationships = unpack(&file, "_rels/.rels");
  const char *at = text;
  int32_t n = 0;
  (void)state;
  assert_non_null(strstr(types, "Extension=\"model\""));
  assert_non_null(strstr(relationships, "Target=\"/3D/3dmodel.model\""));
  assert_non_null(strstr(text, "<model unit=\"millimeter\""));
  assert_non_null(strstr(text, " type=\"model\">"));
  assert_non_null(strstr(text, "<metadata name=\"Title\">ring</metadata>"));
  assert_non_null(strstr(text, "<metadata name=\"Description\">by hand</metadata>"));
  assert_int_equal(fs_tessellate(&ctx, surface, 2, &t), FS_OK);
  for (; (at = strstr(at, "<vertex ")) != NULL; at++, n++) {
    double p[3];
    assert_int_equal(sscanf(at, "<vertex x=\"%lf\" y=\"%lf\" z=\"%lf\"/>", p, p + 1, p + 2), 3);
    assert_true(fabs(p[0] - t->position[n].x) < 5e-9 && fabs(p[1] - t->position[n].y) < 5e-9);
    assert_true(fabs(p[2] - t->position[n].z) < 5e-9);
  }
  assert_int_equal(n, t->n_vertices);
  for (n = 0, at = text; (at = strstr(at, "<triangle ")) != NULL; at++, n++) {
    int v[3];
    assert_int_equal(sscanf(at, "<triangle v1=\"%d\" v2=\"%d\" v3=\"%d\"/>", v, v + 1, v + 2), 3);
    assert_memory_equal(v, t->corner + 3 * n, sizeof v);
  }
  assert_int_equal(n, t->n_triangles);
  fs_triangles_free(&ctx, t);
  free(text);
  free(types);
  free(relationships);
  free(file.bytes);
  sample_free(surface);
}

static void test_equal_input_gives_equal_bytes(void **state) {
  fs_surface *surface = sample_torus(5, 4, NULL, 0);
  memory_output a = export(surface, "ring", NULL), b = export(surface, "ring", NULL);
  (void)state;
  assert_int_equal(a.size, b.size);
  assert_memory_equal(a.bytes, b.bytes, a.size);
  free(a.bytes);
  free(b.bytes);
  sample_free(surface);
}

/* Names become XML text whatever their bytes are. */
static void test_names(void **state) {
  static const char *const names[][2] = {
      {"a<b>&\"c\"", "a&lt;b&gt;&amp;&quot;c&quot;"},
      {"\xc3\xa9\xe2\x82\xac\xf0\x9f\x90\x8c", "\xc3\xa9\xe2\x82\xac\xf0\x9f\x90\x8c"},
      {"\xff|\xc3|\xed\xa0\x80|\xc0\xaf|\x01|\xef\xbf\xbf", "_|_|___|__|_|___"}};
  fs_surface *surface = sample_torus(3, 3, NULL, 0);
  (void)state;
  for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
    char expected[100];
    memory_output file = export(surface, names[k][0], NULL);
    char *text = unpack(&file, "3D/3dmodel.model");
    snprintf(expected, sizeof expected, "<metadata name=\"Title\">%s</metadata>", names[k][1]);
    assert_non_null(strstr(text, expected));
    free(text);
    free(file.bytes);
  }
  sample_free(surface);
}

static double volume_of(const char *text) {
  double point[1000][3], volume = 0;
  int n = 0, v[3];
  for (const char *at = text; (at = strstr(at, "<vertex ")) != NULL && n < 1000; at++, n++)
    sscanf(at, "<vertex x=\"%lf\" y=\"%lf\" z=\"%lf\"/>", point[n], point[n] + 1, point[n] + 2);
  for (const char *at = text; (at = strstr(at, "<triangle ")) != NULL; at++) {
    const double *a, *b, *c;
    sscanf(at, "<triangle v1=\"%d\" v2=\"%d\" v3=\"%d\"/>", v, v + 1, v + 2);
    a = point[v[0]], b = point[v[1]], c = point[v[2]];
    volume +=
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return volume / 6;
}

static void test_open_and_inside_out(void **state) {
  fs_surface *surface = sample_torus(4, 4, NULL, 0);
  memory_output file;
  char *text;
  (void)state;
  for (size_t k = 2; k < surface->n_data; k += 3) surface->data[k] *= -1; /* a mirror */
  file = export(surface, "m", NULL);
  text = unpack(&file, "3D/3dmodel.model");
  assert_true(volume_of(text) > 0.2);
  free(text);
  free(file.bytes);
  for (int j = 0; j < 4; j++) surface->patch[4 * j].neighbour[3] = surface->patch[3 + 4 * j].neighbour[1] = FS_NONE;
  file = export(surface, "m", NULL);
  text = unpack(&file, "3D/3dmodel.model");
  assert_non_null(strstr(text, " type=\"surface\">"));
  free(text);
  free(file.bytes);
  sample_free(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_model),
      cmocka_unit_test(test_equal_input_gives_equal_bytes),
      cmocka_unit_test(test_names),
      cmocka_unit_test(test_open_and_inside_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
