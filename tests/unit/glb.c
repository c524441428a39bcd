/* SPDX-License-Identifier: MIT */
/* Single role: GLB files taken apart by another reader of JSON: head and chunks, counts, boxes, numbers, parts on one grid. */
#include "draco_samples.h"
#include "surface_samples.h"

#include <fairsurf/analyse.h>

#include <cjson/cJSON.h>
#ifdef FS_HAVE_DRACO
#include "mesh/draco_bridge.h"
#endif

enum { STEPS = 8, N = 12, M = 9 };

typedef struct glb {
  memory_output file;
  cJSON *json;
  const char *bin;
  size_t bin_size;
} glb;

static uint32_t read32(const char *bytes) {
  const unsigned char *b = (const unsigned char *)bytes;
  return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static float read_float(const char *bytes) {
  uint32_t bits = read32(bytes);
  float x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

static glb open_glb(const fs_model *model, bool is_compressed) {
  fs_context ctx = test_context();
  glb g = {.file = draco_export(&ctx, model, "glb", "draco", is_compressed)};
  const char *b = g.file.bytes;
  assert_string_equal(g.file.extension, "glb");
  assert_int_equal(g.file.n_opened, 1);
  assert_memory_equal(b, "glTF\2\0\0\0", 8);
  assert_int_equal(read32(b + 8), g.file.size);
  size_t size = read32(b + 12);
  assert_int_equal(size % 4, 0);
  assert_memory_equal(b + 16, "JSON", 4);
  g.json = cJSON_ParseWithLength(b + 20, size);
  assert_non_null(g.json);
  g.bin = b + 28 + size;
  g.bin_size = read32(b + 20 + size);
  assert_int_equal(g.bin_size % 4, 0);
  assert_memory_equal(b + 24 + size, "BIN\0", 4);
  assert_int_equal(28 + size + g.bin_size, g.file.size);
  return g;
}

static void close_glb(glb *g) {
  cJSON_Delete(g->json);
  free(g->file.bytes);
}

static const cJSON *get(const cJSON *from, const char *key) {
  const cJSON *found = cJSON_GetObjectItemCaseSensitive(from, key);
  if (found == NULL) fail_msg("no %s", key);
  return found;
}
static const cJSON *at(const cJSON *from, int i) {
  const cJSON *found = cJSON_GetArrayItem(from, i);
  if (found == NULL) fail_msg("no item %d", i);
  return found;
}
static int integer(const cJSON *from, const char *key) { return (int)cJSON_GetNumberValue(get(from, key)); }

static const cJSON *primitive(const glb *g, int mesh) {
  return at(get(at(get(g->json, "meshes"), mesh), "primitives"), 0);
}

static const cJSON *accessor(const glb *g, int mesh, const char *attribute) {
  const cJSON *p = primitive(g, mesh);
  return at(get(g->json, "accessors"),
            integer(attribute == NULL ? p : get(p, "attributes"), attribute == NULL ? "indices" : attribute));
}

static const char *view(const glb *g, int number, size_t *size) {
  const cJSON *v = at(get(g->json, "bufferViews"), number);
  size_t start = (size_t)integer(v, "byteOffset");
  *size = (size_t)integer(v, "byteLength");
  assert_true(start % 4 == 0 && start + *size <= g->bin_size);
  return g->bin + start;
}

static void check_box(const glb *g, int mesh, int32_t n, const float *x) {
  const cJSON *a = accessor(g, mesh, "POSITION");
  for (int c = 0; c < 3; c++) {
    float min = x[c], max = x[c];
    for (int32_t i = 0; i < n; i++) min = fminf(min, x[3 * i + c]), max = fmaxf(max, x[3 * i + c]);
    assert_true(cJSON_GetNumberValue(at(get(a, "min"), c)) == (double)min);
    assert_true(cJSON_GetNumberValue(at(get(a, "max"), c)) == (double)max);
  }
}

static int every_third(int i, int j) { return (i + j) % 3 == 0; }

/* cut: no patch knows its neighbours across two lines, so there are two parts, whose borders lie on each other. */
static fs_surface *make_surface(bool cut) {
  fs_surface *s = sample_torus(N, M, every_third, 0.01);
  for (int j = 0; j < M && cut; j++) {
    s->patch[N * j].neighbour[3] = s->patch[N - 1 + N * j].neighbour[1] = FS_NONE;
    s->patch[N / 2 + N * j].neighbour[3] = s->patch[N / 2 - 1 + N * j].neighbour[1] = FS_NONE;
  }
  return s;
}

static void test_plain_numbers(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = make_surface(false);
  fs_model model = {.name = "a \"torus\" \\ \t\xC3\xA9\xFF", .surface = surface, .made_with = "fairsurf x"};
  fs_triangles *t = NULL;
  glb g = open_glb(&model, false);
  size_t size;
  (void)state;
  assert_int_equal(fs_tessellate(&ctx, surface, STEPS, &t), FS_OK);
  assert_null(cJSON_GetObjectItem(g.json, "extensionsUsed"));
  assert_string_equal(cJSON_GetStringValue(get(at(get(g.json, "nodes"), 0), "name")), "a \"torus\" \\  \xC3\xA9?");
  assert_string_equal(cJSON_GetStringValue(get(get(g.json, "asset"), "generator")), "fairsurf x");
  assert_false(cJSON_IsTrue(get(at(get(g.json, "materials"), 0), "doubleSided")));
  assert_int_equal(integer(accessor(&g, 0, "POSITION"), "count"), t->n_vertices);
  assert_int_equal(integer(accessor(&g, 0, "NORMAL"), "count"), t->n_vertices);
  assert_int_equal(integer(accessor(&g, 0, NULL), "count"), 3 * t->n_triangles);
  /* One part: nothing is renumbered. */
  const char *index = view(&g, integer(accessor(&g, 0, NULL), "bufferView"), &size);
  assert_int_equal(size, 12 * (size_t)t->n_triangles);
  for (int32_t i = 0; i < 3 * t->n_triangles; i++) assert_int_equal(read32(index + 4 * i), t->corner[i]);
  const char *position = view(&g, integer(accessor(&g, 0, "POSITION"), "bufferView"), &size);
  assert_int_equal(size, 12 * (size_t)t->n_vertices);
  const char *normal = view(&g, integer(accessor(&g, 0, "NORMAL"), "bufferView"), &size);
  float *x = malloc(12 * (size_t)t->n_vertices);
  for (int32_t v = 0; v < t->n_vertices; v++)
    for (int c = 0; c < 3; c++) {
      x[3 * v + c] = read_float(position + 4 * (3 * v + c));
      assert_true(x[3 * v + c] == (float)draco_coordinate(t->position[v], c));
      assert_true(read_float(normal + 4 * (3 * v + c)) == (float)draco_coordinate(t->normal[v], c));
    }
  check_box(&g, 0, t->n_vertices, x);
  free(x);
  fs_triangles_free(&ctx, t);
  close_glb(&g);
  sample_free(surface);
}

static void test_measure_and_ramp(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = make_surface(false);
  const fs_measure *measure = fs_measure_find("gaussian");
  fs_model model = {.name = "torus", .surface = surface, .colour = measure};
  fs_triangles *t = NULL;
  glb g = open_glb(&model, false);
  size_t size;
  (void)state;
  assert_int_equal(fs_tessellate(&ctx, surface, STEPS, &t), FS_OK);
  const char *value = view(&g, integer(accessor(&g, 0, "_CURVATURE"), "bufferView"), &size);
  assert_int_equal(size, 4 * (size_t)t->n_vertices);
  const char *place = view(&g, integer(accessor(&g, 0, "TEXCOORD_0"), "bufferView"), &size);
  assert_int_equal(size, 8 * (size_t)t->n_vertices);
  const cJSON *extras = get(at(get(g.json, "meshes"), 0), "extras");
  assert_string_equal(cJSON_GetStringValue(get(extras, "measure")), "gaussian");
  double low = cJSON_GetNumberValue(get(extras, "low")), high = cJSON_GetNumberValue(get(extras, "high"));
  assert_true(low < high);
  for (int32_t v = 0; v < t->n_vertices; v++) {
    fs_vec3 x[FS_JET_SIZE];
    fs_surface_evaluate(surface, t->vertex_patch[v], t->vertex_uv[2 * v], t->vertex_uv[2 * v + 1], x);
    double K = measure->value(NULL, x), s = fmin(fmax((K - low) / (high - low), 0), 1);
    assert_true(read_float(value + 4 * v) == (float)K);
    assert_float_equal(read_float(place + 8 * v), (0.5 + 255 * s) / 256, 1e-6);
  }
  const char *png = view(&g, integer(at(get(g.json, "images"), 0), "bufferView"), &size);
  assert_memory_equal(png, "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\1\0\0\0\0\1", 24);
  assert_memory_equal(png + size - 12, "\0\0\0\0IEND\xAE\x42\x60\x82", 12);
  fs_triangles_free(&ctx, t);
  close_glb(&g);
  sample_free(surface);
}

static void test_parts(void **state) {
  fs_surface *surface = make_surface(true);
  fs_model model = {.name = "torus", .surface = surface};
  glb g = open_glb(&model, false);
  (void)state;
  assert_int_equal(cJSON_GetArraySize(get(g.json, "meshes")), 2);
  assert_int_equal(cJSON_GetArraySize(get(g.json, "nodes")), 3);
  assert_int_equal(cJSON_GetArraySize(get(at(get(g.json, "nodes"), 0), "children")), 2);
  assert_true(cJSON_IsTrue(get(at(get(g.json, "materials"), 0), "doubleSided")));
  for (int p = 0; p < 2; p++) {
    /* Half of the torus, with a border on both sides. */
    assert_int_equal(integer(accessor(&g, p, "POSITION"), "count"), (N / 2 * STEPS + 1) * M * STEPS);
    assert_int_equal(integer(accessor(&g, p, NULL), "count"), 3 * N / 2 * M * STEPS * STEPS * 2);
  }
  close_glb(&g);
  sample_free(surface);
}

#ifdef FS_HAVE_DRACO
/* The positions of a part as a decoder gets them; *n of them. */
static float *decode_positions(const glb *g, int mesh, int32_t *n) {
  fs_context ctx = test_context();
  const cJSON *p = primitive(g, mesh), *extension = get(get(p, "extensions"), "KHR_draco_mesh_compression");
  fs_draco_mesh *draco = NULL;
  size_t size;
  const char *bytes = view(g, integer(extension, "bufferView"), &size);
  if (fs_draco_decode(&ctx, bytes, size, &draco) != FS_OK) fail_msg("%s", ctx.message);
  for (const cJSON *a = get(p, "attributes")->child; a != NULL; a = a->next) {
    int32_t attribute = fs_draco_find_id(draco, integer(get(extension, "attributes"), a->string));
    assert_int_not_equal(attribute, FS_NONE);
    assert_int_equal(integer(accessor(g, mesh, a->string), "count"), fs_draco_n_points(draco));
    assert_null(cJSON_GetObjectItem(accessor(g, mesh, a->string), "bufferView"));
    const char *type = cJSON_GetStringValue(get(accessor(g, mesh, a->string), "type"));
    assert_int_equal(fs_draco_n_components(draco, attribute), type[0] == 'S' ? 1 : type[3] - '0');
  }
  assert_int_equal(integer(accessor(g, mesh, NULL), "count"), 3 * fs_draco_n_triangles(draco));
  int32_t attribute = fs_draco_find_id(draco, integer(get(extension, "attributes"), "POSITION"));
  *n = fs_draco_n_values(draco, attribute);
  float *x = malloc(12 * (size_t)*n);
  fs_draco_values(draco, attribute, x);
  fs_draco_free(draco);
  check_box(g, mesh, *n, x);
  return x;
}

static void test_compressed(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = make_surface(false);
  fs_model model = {.name = "torus", .surface = surface, .colour = fs_measure_find("mean")};
  glb g = open_glb(&model, true), plain = open_glb(&model, false);
  fs_triangles *t = NULL;
  int32_t n;
  (void)state;
  assert_string_equal(cJSON_GetStringValue(at(get(g.json, "extensionsRequired"), 0)), "KHR_draco_mesh_compression");
  assert_string_equal(cJSON_GetStringValue(at(get(g.json, "extensionsUsed"), 0)), "KHR_draco_mesh_compression");
  float *x = decode_positions(&g, 0, &n);
  assert_int_equal(fs_tessellate(&ctx, surface, STEPS, &t), FS_OK);
  assert_int_equal(n, t->n_vertices);
  draco_cells cells = draco_cells_of(n, t->position, draco_tolerance(n, t->position, 14));
  for (int32_t v = 0; v < n; v++)
    assert_int_not_equal(draco_find_point(&cells, (fs_vec3){x[3 * v], x[3 * v + 1], x[3 * v + 2]}), FS_NONE);
  assert_true(plain.file.size > 8 * g.file.size);
  draco_cells_free(&cells);
  free(x);
  fs_triangles_free(&ctx, t);
  close_glb(&g);
  close_glb(&plain);
  sample_free(surface);
}

/* Every point of a border is, bit by bit, a point of the other part. */
static void test_parts_share_a_grid(void **state) {
  fs_surface *surface = make_surface(true);
  fs_model model = {.name = "torus", .surface = surface};
  glb g = open_glb(&model, true);
  float *x[2];
  int32_t n[2], n_shared = 0;
  (void)state;
  for (int p = 0; p < 2; p++) x[p] = decode_positions(&g, p, &n[p]);
  for (int32_t i = 0; i < n[0]; i++)
    for (int32_t j = 0; j < n[1]; j++) n_shared += memcmp(x[0] + 3 * i, x[1] + 3 * j, 12) == 0;
  assert_int_equal(n_shared, 2 * M * STEPS);
  free(x[0]);
  free(x[1]);
  close_glb(&g);
  sample_free(surface);
}
#endif

static void check_allocations(bool is_compressed) {
  fs_surface *surface = sample_torus(5, 5, NULL, 0);
  fs_model model = {.name = "torus", .surface = surface, .colour = fs_measures[0]};
  const fs_exporter *exporter = fs_exporter_find("glb");
  double param[32] = {0};
  fs_status status = FS_ERR_MEMORY;
  for (int k = 0; exporter->params[k].name != NULL; k++) param[k] = exporter->params[k].initial;
  memory_output_set(exporter, param, "draco", is_compressed);
  for (int64_t n = 1; status == FS_ERR_MEMORY; n++) {
    struct test_memory memory = {.fail_at = n};
    fs_context ctx = test_memory_context(&memory);
    memory_output file = {0};
    fs_output output = memory_output_of(&file);
    status = fs_export(&ctx, &model, exporter, param, &output);
    assert_int_equal(file.n_opened, status == FS_OK ? 1 : 0);
    assert_int_equal(memory.n_live, 0);
    free(file.bytes);
  }
  assert_int_equal(status, FS_OK);
  sample_free(surface);
}

static void test_every_allocation_fails_once(void **state) {
  (void)state;
  check_allocations(false);
#ifdef FS_HAVE_DRACO
  check_allocations(true);
#endif
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_plain_numbers),
      cmocka_unit_test(test_measure_and_ramp),
      cmocka_unit_test(test_parts),
#ifdef FS_HAVE_DRACO
      cmocka_unit_test(test_compressed),
      cmocka_unit_test(test_parts_share_a_grid),
#endif
      cmocka_unit_test(test_every_allocation_fails_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
