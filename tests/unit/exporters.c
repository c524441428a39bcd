/* SPDX-License-Identifier: MIT */
/* Single role: tests of the exporters of nets and triangles: what is written reads back with the same bits, surfaces are
   closed and oriented, and outputs that fail are reported. */
#include "surface_samples.h"
#include "../support/support.h"

#include <fairsurf/export.h>

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <stdio.h>
#include <string.h>

/* One file in memory. refuse_at: the write, from 1, that fails; 0: none. refuse_open: the open fails. */
typedef struct memory_file {
  char *bytes, extension[8];
  size_t size;
  int32_t n_writes, refuse_at, n_opened;
  bool refuse_open;
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
  memory_file *file = user;
  if (file->refuse_open) return FS_ERR_IO;
  file->n_opened++;
  snprintf(file->extension, sizeof file->extension, "%s", extension);
  *sink = (fs_sink){memory_write, file};
  return FS_OK;
}

static fs_output memory_output(memory_file *file) { return (fs_output){memory_open, file}; }

/* Bits of a finite double, all exponents alike. */
static double random_bits(uint64_t *state) {
  double number;
  do {
    uint64_t bits = test_random(state);
    memcpy(&number, &bits, sizeof number);
  } while (!isfinite(number));
  return number;
}

static void check_round_trip(const fs_mesh *mesh, const char *extension, const double *param) {
  fs_context ctx = test_context();
  memory_file file = {0};
  fs_output output = memory_output(&file);
  fs_model model = {.name = "net", .control = mesh, .made_with = "two\nlines"};
  fs_mesh *back = NULL;
  const fs_exporter *exporter = fs_exporter_find(extension);
  assert_non_null(exporter);
  assert_int_equal(fs_export(&ctx, &model, exporter, param, &output), FS_OK);
  assert_int_equal(file.n_opened, 1);
  assert_string_equal(file.extension, extension);
  if (fs_mesh_parse(&ctx, extension, file.bytes, file.size, &back) != FS_OK) fail_msg("%s: %s", extension, ctx.message);
  assert_int_equal(back->n_vertices, mesh->n_vertices);
  assert_int_equal(back->n_faces, mesh->n_faces);
  assert_int_equal(back->n_halfedges, mesh->n_halfedges);
  assert_memory_equal(back->position, mesh->position, (size_t)mesh->n_vertices * sizeof(fs_vec3));
  assert_memory_equal(back->face_start, mesh->face_start, ((size_t)mesh->n_faces + 1) * sizeof(int32_t));
  assert_memory_equal(back->origin, mesh->origin, (size_t)mesh->n_halfedges * sizeof(int32_t));
  fs_mesh_free(&ctx, back);
  free(file.bytes);
}

static void check_round_trips(const fs_mesh *mesh) {
  static const double binary[] = {8, 0}, ascii[] = {8, 1};
  check_round_trip(mesh, "obj", NULL);
  check_round_trip(mesh, "off", NULL);
  check_round_trip(mesh, "ply", binary);
  check_round_trip(mesh, "ply", ascii);
}

static void test_nets_read_back_bit_by_bit(void **state) {
  uint64_t random = 11;
  (void)state;
  for (uint64_t seed = 1; seed <= 20; seed++) {
    fs_context ctx = test_context();
    fs_mesh *mesh = seed == 20 ? test_prism(300) : test_random_mesh(seed); /* 300 does not fit in a byte */
    check_round_trips(mesh);
    for (int32_t v = 0; v < mesh->n_vertices; v++)
      mesh->position[v] = (fs_vec3){random_bits(&random), random_bits(&random), random_bits(&random)};
    mesh->position[0] = (fs_vec3){5e-324, -DBL_MAX, -0.0};
    mesh->position[1] = (fs_vec3){0.1, DBL_MIN, 2.2250738585072011e-308};
    check_round_trips(mesh);
    fs_mesh_free(&ctx, mesh);
  }
}

static int every_fifth(int i, int j) { return (i + 2 * j) % 5 == 0; }

static fs_triangles *triangles_of(const fs_surface *surface, int32_t steps) {
  fs_context ctx = test_context();
  fs_triangles *t = NULL;
  assert_int_equal(fs_tessellate(&ctx, surface, steps, &t), FS_OK);
  return t;
}

static memory_file export_surface(const fs_surface *surface, const char *extension, const double *param) {
  fs_context ctx = test_context();
  memory_file file = {0};
  fs_output output = memory_output(&file);
  fs_model model = {.name = "bumpy", .surface = surface};
  assert_int_equal(fs_export(&ctx, &model, fs_exporter_find(extension), param, &output), FS_OK);
  return file;
}

/* The surface is closed, so the reader makes a closed mesh of it, with the vertices of the tessellation. */
static void check_triangles_read_back(const fs_surface *surface, const char *extension, const double *param) {
  fs_context ctx = test_context();
  memory_file file = export_surface(surface, extension, param);
  fs_triangles *t = triangles_of(surface, (int32_t)param[0]);
  fs_mesh *back = NULL;
  if (fs_mesh_parse(&ctx, extension, file.bytes, file.size, &back) != FS_OK) fail_msg("%s: %s", extension, ctx.message);
  assert_int_equal(back->n_vertices, t->n_vertices);
  assert_int_equal(back->n_faces, t->n_triangles);
  assert_memory_equal(back->position, t->position, (size_t)t->n_vertices * sizeof(fs_vec3));
  assert_memory_equal(back->origin, t->corner, 3 * (size_t)t->n_triangles * sizeof(int32_t));
  for (int32_t h = 0; h < back->n_halfedges; h++) assert_int_not_equal(back->twin[h], FS_NONE);
  fs_mesh_free(&ctx, back);
  fs_triangles_free(&ctx, t);
  free(file.bytes);
}

static void test_surfaces_read_back(void **state) {
  fs_surface *surface = sample_torus(6, 5, every_fifth, 0.01);
  (void)state;
  check_triangles_read_back(surface, "obj", (const double[]){3, 1});
  check_triangles_read_back(surface, "off", (const double[]){3, 1});
  check_triangles_read_back(surface, "ply", (const double[]){3, 0});
  check_triangles_read_back(surface, "ply", (const double[]){2, 1});
  sample_free(surface);
}

/* Normals of the binary PLY lie behind the 24 bytes of each position, those of the OBJ in the lines "vn". */
static void test_normals_are_written(void **state) {
  fs_surface *surface = sample_torus(4, 4, NULL, 0);
  memory_file ply = export_surface(surface, "ply", (const double[]){2, 0});
  memory_file obj = export_surface(surface, "obj", (const double[]){2, 1});
  fs_triangles *t = triangles_of(surface, 2);
  const char *at = strstr(ply.bytes, "end_header\n") + strlen("end_header\n");
  const char *line = strstr(obj.bytes, "vn ");
  (void)state;
  assert_int_equal(ply.bytes + ply.size - at, 36 * t->n_vertices + 13 * t->n_triangles);
  for (int32_t v = 0; v < t->n_vertices; v++, at += 36) {
    float n[3];
    double x, y, z;
    memcpy(n, at + 24, sizeof n);
    assert_true(n[0] == (float)t->normal[v].x && n[1] == (float)t->normal[v].y && n[2] == (float)t->normal[v].z);
    assert_non_null(line);
    assert_int_equal(sscanf(line, "vn %lf %lf %lf", &x, &y, &z), 3);
    assert_true(x == t->normal[v].x && y == t->normal[v].y && z == t->normal[v].z);
    line = strstr(line + 1, "vn ");
  }
  assert_null(line);
  assert_non_null(strstr(obj.bytes, "\nf 1//1 "));
  fs_triangles_free(&(fs_context){0}, t);
  sample_free(surface);
  free(ply.bytes);
  free(obj.bytes);
}

static fs_vec3 float3(const char *bytes) {
  float x[3];
  memcpy(x, bytes, sizeof x);
  return (fs_vec3){x[0], x[1], x[2]};
}

static fs_vec3 cross(fs_vec3 a, fs_vec3 b) {
  return (fs_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static fs_vec3 minus(fs_vec3 a, fs_vec3 b) { return (fs_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }

static double dot(fs_vec3 a, fs_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static int compare_sides(const void *a, const void *b) { return memcmp(a, b, 24); }

/* Every side of a facet, two points of three floats, is there the other way round too, bit by bit. */
static void check_stitched(const char *facets, uint32_t n) {
  char(*side)[24] = malloc(3 * (size_t)n * sizeof *side);
  for (uint32_t i = 0; i < 3 * n; i++) {
    const char *points = facets + 50 * (size_t)(i / 3) + 12;
    memcpy(side[i], points + 12 * (i % 3), 12);
    memcpy(side[i] + 12, points + 12 * ((i + 1) % 3), 12);
  }
  qsort(side, 3 * (size_t)n, sizeof *side, compare_sides);
  for (uint32_t i = 0; i < 3 * n; i++) {
    char back[24];
    memcpy(back, side[i] + 12, 12);
    memcpy(back + 12, side[i], 12);
    assert_non_null(bsearch(back, side, 3 * (size_t)n, sizeof *side, compare_sides));
  }
  free(side);
}

/* A round torus of radii R = 1.2 and about r = 0.45 has the volume 2 pi^2 R r^2 = 4.80; its spline with few segments
   lies inside. Facets agree with their normals; sums of area times normal vanish on a closed surface. */
static void test_stl_of_a_closed_surface(void **state) {
  fs_surface *surface = sample_torus(12, 9, every_fifth, 0);
  memory_file file = export_surface(surface, "stl", (const double[]){4, 0});
  uint32_t n;
  double volume = 0;
  fs_vec3 sum = {0, 0, 0};
  (void)state;
  memcpy(&n, file.bytes + 80, 4);
  assert_int_equal(n, 2 * 12 * 9 * 16);
  assert_int_equal(file.size, 84 + 50 * (size_t)n);
  assert_true(strncmp(file.bytes, "solid", 5) != 0);
  for (uint32_t i = 0; i < n; i++) {
    const char *facet = file.bytes + 84 + 50 * (size_t)i;
    fs_vec3 normal = float3(facet), a = float3(facet + 12), b = float3(facet + 24), c = float3(facet + 36);
    fs_vec3 area = cross(minus(b, a), minus(c, a));
    assert_true(fabs(dot(normal, normal) - 1) < 1e-6);
    assert_true(dot(normal, area) > 0.999 * sqrt(dot(area, area)));
    volume += dot(a, cross(b, c)) / 6;
    sum = minus(sum, area);
  }
  assert_true(sqrt(dot(sum, sum)) < 1e-5);
  check_stitched(file.bytes + 84, n);
  assert_true(volume > 2.5 && volume < 4.8);
  free(file.bytes);
  file = export_surface(surface, "stl", (const double[]){1, 1});
  assert_true(strncmp(file.bytes, "solid bumpy\n", 12) == 0);
  assert_non_null(strstr(file.bytes, "endsolid bumpy\n"));
  n = 0;
  for (const char *at = file.bytes; (at = strstr(at, "\n    vertex ")) != NULL; at++) n++;
  assert_int_equal(n, 3 * 2 * 12 * 9);
  free(file.bytes);
  sample_free(surface);
}

/* Every write of every exporter refused once: the status of the output comes back, with a sentence, and nothing leaks. */
static void test_outputs_that_fail(void **state) {
  fs_mesh *mesh = test_torus(60, 30, 2, 0.7);
  fs_surface *surface = sample_torus(4, 4, NULL, 0);
  (void)state;
  for (int32_t i = 0; fs_exporters[i] != NULL; i++) {
    bool is_net = fs_exporters[i]->what != FS_EXPORT_SURFACE;
    int32_t refuse_at = 0;
    for (bool more = true; more; refuse_at++) {
      struct test_memory memory = {0};
      fs_context ctx = test_memory_context(&memory);
      memory_file file = {.refuse_at = refuse_at, .refuse_open = refuse_at == 0};
      fs_output output = memory_output(&file);
      fs_model model = {.name = "m", .control = is_net ? mesh : NULL, .surface = is_net ? NULL : surface};
      fs_status status = fs_export(&ctx, &model, fs_exporters[i], NULL, &output);
      more = refuse_at == 0 || file.n_writes >= refuse_at;
      assert_int_equal(status, more ? FS_ERR_IO : FS_OK);
      assert_int_equal(memory.n_live, 0);
      if (more) assert_true(ctx.message[0] != '\0');
      if (more && refuse_at > 0) assert_int_equal(file.n_writes, refuse_at); /* nothing is written after a failure */
      free(file.bytes);
    }
    assert_true(refuse_at > 2);
  }
  fs_mesh_free(&(fs_context){0}, mesh);
  sample_free(surface);
}

static void test_every_allocation_may_fail(void **state) {
  fs_surface *surface = sample_torus(3, 3, every_fifth, 0);
  fs_mesh *mesh = test_torus(6, 5, 2, 0.7);
  (void)state;
  for (int32_t i = 0; fs_exporters[i] != NULL; i++)
    for (int64_t n = 1;; n++) {
      struct test_memory memory = {.fail_at = n};
      fs_context ctx = test_memory_context(&memory);
      memory_file file = {0};
      fs_output output = memory_output(&file);
      bool is_net = fs_exporters[i]->what == FS_EXPORT_NET;
      fs_model model = {.name = "m", .control = is_net ? mesh : NULL, .surface = is_net ? NULL : surface};
      fs_status status = fs_export(&ctx, &model, fs_exporters[i], NULL, &output);
      assert_int_equal(memory.n_live, 0);
      free(file.bytes);
      if (status == FS_OK) break;
      assert_int_equal(status, FS_ERR_MEMORY);
    }
  fs_mesh_free(&(fs_context){0}, mesh);
  sample_free(surface);
}

static void check_refused(const fs_model *model, const char *extension, const double *param, fs_status expected,
                          const char *word) {
  fs_context ctx = test_context();
  memory_file file = {0};
  fs_output output = memory_output(&file);
  assert_int_equal(fs_export(&ctx, model, fs_exporter_find(extension), param, &output), expected);
  if (strstr(ctx.message, word) == NULL) fail_msg("\"%s\" does not say \"%s\"", ctx.message, word);
  free(file.bytes);
}

static void test_refusals(void **state) {
  fs_mesh *mesh = test_cube();
  fs_surface *surface = sample_torus(3, 3, NULL, 0);
  fs_model net = {.control = mesh}, both = {.control = mesh, .surface = surface}, none = {0};
  (void)state;
  check_refused(&net, "stl", NULL, FS_ERR_ARGUMENT, "surface");
  check_refused(&net, "pov", NULL, FS_ERR_ARGUMENT, "surface");
  check_refused(&none, "obj", NULL, FS_ERR_ARGUMENT, "neither");
  check_refused(&both, "obj", (const double[]){0}, FS_ERR_ARGUMENT, "steps");
  check_refused(&both, "ply", (const double[]){8, 0.5}, FS_ERR_ARGUMENT, "format");
  check_refused(&both, "ply", (const double[]){8, 2}, FS_ERR_ARGUMENT, "format");
  check_refused(&both, "ply", (const double[]){NAN, 0}, FS_ERR_ARGUMENT, "steps");
  surface->data[0] = 1e39; /* fits in a double only */
  check_refused(&both, "stl", NULL, FS_ERR_NUMERIC, "single precision");
  check_refused(&both, "off", NULL, FS_OK, "");
  fs_mesh_free(&(fs_context){0}, mesh);
  sample_free(surface);
}

static void test_table(void **state) {
  (void)state;
  assert_string_equal(fs_exporters[0]->extension, "pov");
  assert_ptr_equal(fs_exporter_find("STL"), fs_exporter_find("stl"));
  assert_null(fs_exporter_find("st"));
  assert_null(fs_exporter_find("stlx"));
  assert_null(fs_exporter_find(""));
  for (int32_t i = 0; fs_exporters[i] != NULL; i++)
    assert_ptr_equal(fs_exporter_find(fs_exporters[i]->extension), fs_exporters[i]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_nets_read_back_bit_by_bit),
      cmocka_unit_test(test_surfaces_read_back),
      cmocka_unit_test(test_normals_are_written),
      cmocka_unit_test(test_stl_of_a_closed_surface),
      cmocka_unit_test(test_outputs_that_fail),
      cmocka_unit_test(test_every_allocation_may_fail),
      cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_table),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
