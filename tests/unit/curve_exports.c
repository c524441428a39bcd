/* SPDX-License-Identifier: MIT */
/* Curves on a surface in the files that hold them: their points, what else the formats want of them, and in drawings which
   points are hidden. */
#include <fairsurf/analyse_curves.h>
#include "../support/support.h"
#include "analyse_samples.h"
#include "graph_samples.h"
#include "memory_output.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

/* z = (x^2 + y^2) / 2 with curves of a kind. */
typedef struct sample {
  fs_patch patch[4];
  double data[192];
  fs_surface surface;
  fs_curves *curves;
} sample;

static void make_sample(sample *s, const char *kind) {
  fs_context ctx = test_context();
  make_graph((graph){0}, s->patch, s->data, &s->surface);
  s->curves = NULL;
  assert_int_equal(fs_plot_trace(&ctx, fs_plot_find(kind), &s->surface, NULL, NULL, &s->curves), FS_OK);
}

static memory_output write_sample(sample *s, const char *extension, const char *name, double value) {
  const fs_exporter *exporter = fs_exporter_find(extension);
  fs_context ctx = test_context();
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  fs_model model = {.name = "bowl", .surface = &s->surface, .curves = s->curves};
  double param[32] = {0};
  for (int k = 0; exporter->params != NULL && exporter->params[k].name != NULL; k++)
    param[k] = exporter->params[k].initial;
  if (name != NULL) memory_output_set(exporter, param, name, value);
  if (fs_export(&ctx, &model, exporter, param, &output) != FS_OK) fail_msg("%s: %s", extension, ctx.message);
  return file;
}

static void free_sample(sample *s) {
  fs_context ctx = test_context();
  fs_curves_free(&ctx, s->curves);
}

/* Edges join points of one circle of H = (2 + r^2) / (2 (1 + r^2)^1.5), which is their level. */
static void test_ply(void **state) {
  sample s;
  memory_output file;
  double count[2] = {0, 0}, (*point)[6];
  const char *at;
  (void)state;
  make_sample(&s, "mean-curvature");
  file = write_sample(&s, "ply", "format", 1);
  assert_non_null(memory_output_numbers(file.bytes, "element vertex", 1, &count[0]));
  assert_non_null(memory_output_numbers(file.bytes, "element edge", 1, &count[1]));
  assert_true(count[1] > 100);
  point = malloc((size_t)count[0] * sizeof *point);
  at = strstr(file.bytes, "end_header\n") + 11;
  for (int i = 0; i < (int)count[0]; i++)
    for (int k = 0; k < 6; k++) point[i][k] = strtod(at, (char **)&at);
  for (int n = (int)(4 * 8 * 8 * 2), i = 0; i < n; i++) /* the triangles: four numbers each */
    for (int k = 0; k < 4; k++) strtod(at, (char **)&at);
  for (int i = 0; i < (int)count[1]; i++) {
    double edge[6]; /* two vertices, red, green, blue, level */
    for (int k = 0; k < 6; k++) edge[k] = strtod(at, (char **)&at);
    for (int k = 0; k < 2; k++) {
      assert_true(edge[k] >= 0 && edge[k] < count[0]);
      const double *p = point[(int)edge[k]];
      double square = p[0] * p[0] + p[1] * p[1];
      assert_true(fabs((2 + square) / (2 * pow(1 + square, 1.5)) - edge[5]) < 1e-6);
      assert_true(fabs(p[2] - square / 2) < 1e-10);
    }
  }
  assert_string_equal(at, "\n");
  free(point);
  free(file.bytes);
  free_sample(&s);
}

static void test_povray(void **state) {
  sample s;
  memory_output file;
  int n = 0;
  (void)state;
  make_sample(&s, "curvature-lines");
  file = write_sample(&s, "pov", NULL, 0);
  assert_int_equal(file.n_opened, 3);
  assert_non_null(strstr(file.bytes, "#declare bowl_Curves = union {"));
  assert_non_null(strstr(file.bytes, "#include \"bowl.curves.inc\""));
  assert_non_null(strstr(file.bytes, "object { bowl_Curves }"));
  for (const char *at = file.bytes; (at = strstr(at, "sphere_sweep {")) != NULL; at++) n++;
  assert_true(n > 50);
  free(file.bytes);
  free_sample(&s);
  make_sample(&s, "zebra");
  file = write_sample(&s, "pov", NULL, 0);
  assert_non_null(strstr(file.bytes, "triangle { <"));
  free(file.bytes);
  free_sample(&s);
}

static void test_glb(void **state) {
  sample s;
  memory_output file;
  double number[3];
  (void)state;
  make_sample(&s, "sections");
  file = write_sample(&s, "glb", "draco", 0);
  const char *json = file.bytes + 20;
  assert_non_null(memory_output_numbers(json, "\"mode\":1,\"material\":1,\"indices\":", 3, number));
  assert_true(number[1] == number[0] + 1);
  assert_non_null(strstr(json, "\"name\":\"curves\",\"mesh\":1"));
  assert_non_null(strstr(json, "KHR_materials_unlit"));
  free(file.bytes);
  free_sample(&s);
}

static void test_every_allocation_may_fail(void **state) {
  sample s;
  (void)state;
  make_sample(&s, "zebra");
  for (int32_t i = 0; fs_exporters[i] != NULL; i++)
    for (int64_t n = 1; fs_exporters[i]->has_curves && fs_exporters[i]->what != FS_EXPORT_NET; n++) {
      struct test_memory memory = {.fail_at = n};
      fs_context ctx = test_memory_context(&memory);
      memory_output file = {0};
      fs_output output = memory_output_of(&file);
      fs_model model = {.name = "bowl", .surface = &s.surface, .curves = s.curves};
      fs_status status = fs_export(&ctx, &model, fs_exporters[i], NULL, &output);
      assert_int_equal(memory.n_live, 0);
      free(file.bytes);
      if (status == FS_OK) break;
      assert_int_equal(status, FS_ERR_MEMORY);
    }
  free_sample(&s);
}

#ifdef FS_HAVE_CAIRO
#include "drawing.h"

static const double pi = 3.14159265358979323846;

/* Towards a viewer at elevation e in direction x the ray from (x, y) meets the paraboloid again at x' = 2 tan e - x: it hides
   the point where x < x' <= 1. */
static void test_hidden(void **state) {
  fs_context ctx = test_context();
  sample s;
  fs_triangles *triangles = NULL;
  uint64_t random = 7;
  int n_hidden = 0;
  (void)state;
  make_graph((graph){0}, s.patch, s.data, &s.surface);
  assert_int_equal(fs_tessellate(&ctx, &s.surface, 24, &triangles), FS_OK);
  for (int e = 5; e < 45; e += 10) {
    fs_view view;
    assert_int_equal(fs_view_create(&ctx, triangles, 0, e, &view), FS_OK);
    for (int k = 0; k < 2000; k++) {
      double x = test_random_real(&random, -1, 1), y = test_random_real(&random, -0.97, 0.97);
      double beyond = 2 * tan(e * pi / 180) - x;
      if (fabs(beyond - 1) < 0.05 || fabs(beyond - x) < 0.3) continue; /* too near to tell by cells */
      bool is_hidden = x < beyond && beyond <= 1;
      n_hidden += is_hidden;
      fs_vec3 p = {x, y, (x * x + y * y) / 2};
      assert_int_equal(fs_view_sees(&view, fs_view_project(&view, p)), !is_hidden);
    }
    fs_view_clear(&ctx, &view);
  }
  assert_true(n_hidden > 500);
  fs_triangles_free(&ctx, triangles);
}

/* A square beside two of half its side, z = slope x on the right: T-junctions are no borders, angles are drawn. */
static void test_drawn_edges(void **state) {
  static const double flat[4] = {0};
  (void)state;
  for (int slope = 0; slope < 2; slope++) {
    fs_surface *s = sample_empty();
    double tilted[4] = {0, slope, 0, 0};
    int n_lines = 0;
    sample_add_graph(s, 1, 1, flat, -1, 1, 0, 1);
    sample_add_graph(s, 1, 1, tilted, 0, 0.5, 0, 0.5);
    sample_add_graph(s, 1, 1, tilted, 0, 0.5, 0.5, 0.5);
    sample drawn = {.surface = *s, .curves = NULL};
    memory_output file = write_sample(&drawn, "svg", "view-elevation", 80);
    for (const char *at = file.bytes; (at = strstr(at, "stroke:rgb(0%,0%,0%)")) != NULL; at++) n_lines++;
    assert_int_equal(n_lines, 3 + 2 + 2 + 2 * slope);
    free(file.bytes);
    sample_grown_free(s);
  }
}

static void test_drawings(void **state) {
  sample s;
  (void)state;
  make_sample(&s, "isophotes");
  for (int k = 0; k < 2; k++) { /* equal models give equal files; cairo numbers SVG surfaces */
    memory_output a = write_sample(&s, k == 0 ? "svg" : "pdf", "views", 1);
    memory_output b = write_sample(&s, k == 0 ? "svg" : "pdf", "views", 1);
    if (k == 1) assert_true(a.size == b.size && memcmp(a.bytes, b.bytes, a.size) == 0);
    assert_memory_equal(a.bytes, k == 0 ? "<?xml" : "%PDF-", 5);
    assert_non_null(strstr(a.bytes + a.size - 10, k == 0 ? "</svg>" : "%%EOF"));
    free(a.bytes);
    free(b.bytes);
  }
  free_sample(&s);
}
#endif

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_ply),      cmocka_unit_test(test_povray),
      cmocka_unit_test(test_glb),      cmocka_unit_test(test_every_allocation_may_fail),
#ifdef FS_HAVE_CAIRO
      cmocka_unit_test(test_hidden),   cmocka_unit_test(test_drawn_edges),
      cmocka_unit_test(test_drawings),
#endif
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
