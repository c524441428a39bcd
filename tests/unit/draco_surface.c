/* SPDX-License-Identifier: MIT */
/* Single role: surfaces in Draco files: positions to half a step of the grid, normals and measures of the patches to their
   bits; and a control net that is far smaller than its surface, and truer. */
#include "draco_samples.h"
#include "surface_samples.h"

#include <fairsurf/file.h>
#include "mesh/draco_bridge.h"

enum { STEPS = 8 };

static int every_third(int i, int j) { return (i + j) % 3 == 0; }

/* What a decoder gets: rows of an attribute at the points. */
typedef struct decoded {
  fs_draco_mesh *draco;
  int32_t n_points;
  fs_vec3 *position, *normal;
  float *measure;
} decoded;

static float *values_at_points(const fs_draco_mesh *draco, int32_t attribute, int n_components) {
  int32_t n = fs_draco_n_points(draco), *value = malloc((size_t)n * sizeof *value);
  assert_int_not_equal(attribute, FS_NONE);
  assert_int_equal(fs_draco_n_components(draco, attribute), n_components);
  float *x = malloc((size_t)(fs_draco_n_values(draco, attribute) * n_components) * sizeof *x);
  float *at = malloc((size_t)(n * n_components) * sizeof *at);
  fs_draco_values_of_points(draco, attribute, value);
  fs_draco_values(draco, attribute, x);
  for (int32_t p = 0; p < n; p++)
    memcpy(at + n_components * p, x + n_components * value[p], (size_t)n_components * sizeof *at);
  free(value);
  free(x);
  return at;
}

static fs_vec3 *vectors_at_points(const fs_draco_mesh *draco, fs_draco_kind kind) {
  int32_t n = fs_draco_n_points(draco);
  float *x = values_at_points(draco, fs_draco_find(draco, kind, NULL), 3);
  fs_vec3 *vector = malloc((size_t)n * sizeof *vector);
  for (int32_t p = 0; p < n; p++) vector[p] = (fs_vec3){x[3 * p], x[3 * p + 1], x[3 * p + 2]};
  free(x);
  return vector;
}

static decoded decode(const memory_output *file, const char *measure) {
  fs_context ctx = test_context();
  decoded d = {0};
  if (fs_draco_decode(&ctx, file->bytes, file->size, &d.draco) != FS_OK) fail_msg("%s", ctx.message);
  d.n_points = fs_draco_n_points(d.draco);
  d.position = vectors_at_points(d.draco, FS_DRACO_POSITION);
  d.normal = vectors_at_points(d.draco, FS_DRACO_NORMAL);
  if (measure != NULL) d.measure = values_at_points(d.draco, fs_draco_find(d.draco, FS_DRACO_GENERIC, measure), 1);
  return d;
}

static void decoded_free(decoded *d) {
  fs_draco_free(d->draco);
  free(d->position);
  free(d->normal);
  free(d->measure);
}

/* Degrees, precise near 0. */
static double angle(fs_vec3 a, fs_vec3 b) {
  fs_vec3 c = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return atan2(sqrt(c.x * c.x + c.y * c.y + c.z * c.z), a.x * b.x + a.y * b.y + a.z * b.z) * 57.29577951308232;
}

/* The normal from the derivatives of the patch. */
static fs_vec3 patch_normal(const fs_surface *surface, const fs_triangles *t, int32_t v) {
  fs_vec3 x[FS_JET_SIZE], a, b;
  fs_surface_evaluate(surface, t->vertex_patch[v], t->vertex_uv[2 * v], t->vertex_uv[2 * v + 1], x);
  a = x[FS_DU], b = x[FS_DV];
  fs_vec3 n = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  return n;
}

/* Largest angle between decoded normals and those of the patches; the positions are checked on the way. */
static double check_surface(const fs_surface *surface, const fs_triangles *t, const decoded *d, int bits) {
  double tolerance = draco_tolerance(t->n_vertices, t->position, bits), worst = 0;
  draco_cells cells = draco_cells_of(t->n_vertices, t->position, tolerance);
  bool *is_met = calloc((size_t)t->n_vertices, sizeof *is_met);
  assert_int_equal(d->n_points, t->n_vertices);
  assert_int_equal(fs_draco_n_triangles(d->draco), t->n_triangles);
  for (int32_t p = 0; p < d->n_points; p++) {
    int32_t v = draco_find_point(&cells, d->position[p]);
    assert_int_not_equal(v, FS_NONE);
    assert_false(is_met[v]);
    is_met[v] = true;
    worst = fmax(worst, angle(d->normal[p], patch_normal(surface, t, v)));
  }
  free(is_met);
  draco_cells_free(&cells);
  return worst;
}

static void test_surfaces_read_back(void **state) {
  static const int bits[] = {14, 16, 20, 0};
  fs_context ctx = test_context();
  fs_surface *surface = sample_torus(12, 9, every_third, 0.01);
  fs_triangles *t = NULL;
  (void)state;
  for (int pass = 0; pass < 2; pass++) {
    assert_int_equal(fs_tessellate(&ctx, surface, STEPS, &t), FS_OK);
    assert_true(t->n_vertices >= 1000);
    /* Shifted by 1000 sizes single precision alone is coarser than 20 bits, and points of the mesh stay apart. */
    for (int k = 0; k < 4; k++) {
      fs_model model = {.name = "torus", .surface = surface};
      memory_output file = draco_export(&ctx, &model, "drc", "position-bits", bits[k]);
      decoded d = decode(&file, NULL);
      double worst = check_surface(surface, t, &d, bits[k]);
      print_message("%d bits, pass %d: %zu bytes, normals off by %.4f degrees at most\n", bits[k], pass, file.size,
                    worst);
      assert_true(worst <= 0.06);
      decoded_free(&d);
      free(file.bytes);
    }
    fs_triangles_free(&ctx, t);
    for (size_t i = 0; i < surface->n_data; i += 3) surface->data[i] += 3000, surface->data[i + 2] -= 3000;
  }
  sample_free(surface);
}

static void test_measures(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = sample_torus(12, 9, every_third, 0.01);
  const fs_measure *measure = fs_measure_find("mean");
  fs_model model = {.name = "torus", .surface = surface, .colour = measure};
  memory_output file = draco_export(&ctx, &model, "drc", NULL, 0);
  decoded d = decode(&file, "mean");
  fs_triangles *t = NULL;
  double low = INFINITY, high = -INFINITY, worst = 0;
  (void)state;
  assert_int_equal(fs_tessellate(&ctx, surface, STEPS, &t), FS_OK);
  double tolerance = draco_tolerance(t->n_vertices, t->position, 14),
         *value = malloc((size_t)t->n_vertices * sizeof *value);
  draco_cells cells = draco_cells_of(t->n_vertices, t->position, tolerance);
  for (int32_t v = 0; v < t->n_vertices; v++) {
    fs_vec3 x[FS_JET_SIZE];
    fs_surface_evaluate(surface, t->vertex_patch[v], t->vertex_uv[2 * v], t->vertex_uv[2 * v + 1], x);
    value[v] = measure->value(NULL, x);
    low = fmin(low, value[v]), high = fmax(high, value[v]);
  }
  for (int32_t p = 0; p < d.n_points; p++)
    worst = fmax(worst, fabs(d.measure[p] - value[draco_find_point(&cells, d.position[p])]));
  assert_true(worst <= 0.5001 * (high - low) / 4095 + 1e-6 * fmax(fabs(low), fabs(high)));
  free(value);
  draco_cells_free(&cells);
  decoded_free(&d);
  fs_triangles_free(&ctx, t);
  free(file.bytes);
  sample_free(surface);
}

/* The surface of a net with given positions. */
static fs_surface *surface_of(const fs_space *space, const fs_vec3 *position) {
  fs_context ctx = test_context();
  fs_surface *surface = NULL;
  assert_int_equal(fs_surface_create(&ctx, space, position, &surface), FS_OK);
  return surface;
}

/* Largest angle between the normals of the surface of the net and of that which is made from the file again. */
static double net_error(const fs_mesh *net, const fs_space *space, const fs_triangles *t, const memory_output *file) {
  fs_context ctx = test_context();
  fs_mesh *back = NULL;
  fs_triangles *again = NULL;
  fs_vec3 *position = malloc((size_t)net->n_vertices * sizeof *position);
  double worst = 0;
  if (fs_mesh_parse(&ctx, "drc", file->bytes, file->size, &back) != FS_OK) fail_msg("%s", ctx.message);
  draco_cells cells =
      draco_cells_of(net->n_vertices, net->position, draco_tolerance(net->n_vertices, net->position, 16));
  for (int32_t v = 0; v < back->n_vertices; v++) {
    int32_t original = draco_find_point(&cells, back->position[v]);
    assert_int_not_equal(original, FS_NONE);
    position[original] = back->position[v];
  }
  fs_surface *surface = surface_of(space, position);
  assert_int_equal(fs_tessellate(&ctx, surface, STEPS, &again), FS_OK);
  for (int32_t v = 0; v < t->n_vertices; v++) worst = fmax(worst, angle(t->normal[v], again->normal[v]));
  fs_triangles_free(&ctx, again);
  fs_surface_free(&ctx, surface);
  fs_mesh_free(&ctx, back);
  draco_cells_free(&cells);
  free(position);
  return worst;
}

static void test_net_is_smaller_and_truer(void **state) {
  fs_context ctx = test_context();
  const char *folder = getenv("FAIRSURF_SAMPLES");
  char path[4096];
  fs_mesh *mesh = NULL;
  fs_refinement *fine = NULL;
  fs_space *space = NULL;
  fs_triangles *t = NULL;
  (void)state;
  if (folder == NULL) {
    print_message("skipped: FAIRSURF_SAMPLES does not say where the sample meshes are\n");
    skip();
  }
  snprintf(path, sizeof path, "%s/pipe.obj", folder);
  if (fs_mesh_read(&ctx, path, &mesh) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(fs_mesh_refine(&ctx, mesh, "averaging", NULL, &fine), FS_OK);
  assert_true(fine->mesh->n_faces >= 700);
  assert_int_equal(fs_space_create(&ctx, fine->mesh, &space), FS_OK);
  fs_surface *surface = surface_of(space, space->start);
  uint8_t *fixed = calloc((size_t)space->n_dofs, 1);
  assert_int_equal(fs_space_rim(&ctx, fine->mesh, space, (bool *)fixed), FS_OK);
  fs_model net = {.name = "pipe", .control = fine->mesh, .fixed = fixed, .made_with = "fairsurf", .n_refinements = 1};
  fs_model dense = {.name = "pipe", .surface = surface};
  memory_output small = draco_export(&ctx, &net, "drc", "net-bits", 16);
  memory_output large = draco_export(&ctx, &dense, "drc", "position-bits", 14);
  assert_int_equal(fs_tessellate(&ctx, surface, STEPS, &t), FS_OK);
  decoded d = decode(&large, NULL);
  double net_angle = net_error(fine->mesh, space, t, &small), dense_angle = check_surface(surface, t, &d, 14);
  print_message("%d quads: net %zu bytes, normals %.4f degrees; surface %zu bytes, normals %.4f degrees; ratio %.1f\n",
                fine->mesh->n_faces, small.size, net_angle, large.size, dense_angle,
                (double)large.size / (double)small.size);
  assert_true(large.size >= 20 * small.size);
  assert_true(net_angle < dense_angle);
  assert_true(dense_angle <= 0.06);
  decoded_free(&d);
  free(small.bytes);
  free(large.bytes);
  free(fixed);
  fs_triangles_free(&ctx, t);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  fs_refinement_free(&ctx, fine);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

/* A plane whose vertices lie on the grid takes next to nothing: the reader must not take it for damaged. */
static void test_flat_surface(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_grid(257, 257, NULL), *back = NULL;
  fs_space *space = NULL;
  const fs_exporter *exporter = fs_exporter_find("drc");
  double param[32] = {0};
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  (void)state;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  fs_surface *surface = surface_of(space, space->start);
  fs_model model = {.name = "plane", .surface = surface};
  for (int k = 0; exporter->params[k].name != NULL; k++) param[k] = exporter->params[k].initial;
  memory_output_set(exporter, param, "steps", 1);
  memory_output_set(exporter, param, "position-bits", 8);
  if (fs_export(&ctx, &model, exporter, param, &output) != FS_OK) fail_msg("%s", ctx.message);
  if (fs_mesh_parse(&ctx, "drc", file.bytes, file.size, &back) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(back->n_faces, 2 * 255 * 255);
  assert_true(file.size * FS_DRACO_MOST_PER_BYTE < 2 * 255 * 255 + 2 * FS_DRACO_MOST_PER_BYTE); /* it was that small */
  fs_mesh_free(&ctx, back);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  free(file.bytes);
}

static void test_every_allocation_fails_once(void **state) {
  fs_surface *surface = sample_torus(5, 5, NULL, 0);
  fs_model model = {.name = "torus", .surface = surface, .colour = fs_measures[0]};
  fs_status status = FS_ERR_MEMORY;
  (void)state;
  for (int64_t n = 1; status == FS_ERR_MEMORY; n++) {
    struct test_memory memory = {.fail_at = n};
    fs_context ctx = test_memory_context(&memory);
    memory_output file = {0};
    fs_output output = memory_output_of(&file);
    status = fs_export(&ctx, &model, fs_exporter_find("drc"), NULL, &output);
    assert_int_equal(file.n_opened, status == FS_OK ? 1 : 0);
    assert_int_equal(memory.n_live, 0);
    free(file.bytes);
  }
  assert_int_equal(status, FS_OK);
  sample_free(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_surfaces_read_back),          cmocka_unit_test(test_measures),
      cmocka_unit_test(test_net_is_smaller_and_truer),    cmocka_unit_test(test_flat_surface),
      cmocka_unit_test(test_every_allocation_fails_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
