/* SPDX-License-Identifier: MIT */
/* Single role: normals in the files of meshes are those of the patch at the vertex, to the precision of the format; they are
   computed here from the Bezier points alone, by de Casteljau's algorithm. Values of measures in PLY likewise. */
#include "memory_output.h"
#include "surface_samples.h"
#include "../support/support.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

static int every_third(int i, int j) { return (i + j) % 3 == 0; }

/* Point and derivative by the parameter of a Bezier curve of degree n, in place of point[n + 1]. */
static fs_vec3 casteljau(int n, fs_vec3 *point, double t, fs_vec3 *derivative) {
  for (int k = n; k > 0; k--) {
    if (k == 1)
      *derivative =
          (fs_vec3){n * (point[1].x - point[0].x), n * (point[1].y - point[0].y), n * (point[1].z - point[0].z)};
    for (int i = 0; i < k; i++)
      point[i] = (fs_vec3){(1 - t) * point[i].x + t * point[i + 1].x, (1 - t) * point[i].y + t * point[i + 1].y,
                           (1 - t) * point[i].z + t * point[i + 1].z};
  }
  return point[0];
}

static fs_vec3 normal_of(const fs_surface *s, int32_t patch, double u, double v) {
  const fs_patch *p = &s->patch[patch];
  const double *data = s->data + p->data_start;
  fs_vec3 row[FS_MAX_DEGREE + 1], along[FS_MAX_DEGREE + 1], across[FS_MAX_DEGREE + 1], du, dv, unused, n;
  double length;
  for (int j = 0; j <= p->degree_v; j++) {
    for (int i = 0; i <= p->degree_u; i++) {
      const double *b = data + 3 * (i + (p->degree_u + 1) * j);
      row[i] = (fs_vec3){b[0], b[1], b[2]};
    }
    across[j] = casteljau(p->degree_u, row, u, &along[j]);
  }
  casteljau(p->degree_v, across, v, &dv);
  du = casteljau(p->degree_v, along, v, &unused);
  n = (fs_vec3){du.y * dv.z - du.z * dv.y, du.z * dv.x - du.x * dv.z, du.x * dv.y - du.y * dv.x};
  length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  return (fs_vec3){n.x / length, n.y / length, n.z / length};
}

typedef struct sample {
  fs_surface *surface;
  fs_triangles *t;
  fs_vec3 *normal; /* [t->n_vertices] */
} sample;

enum { N_STEPS = 4 }; /* also 2^2, as the scene format counts */

static sample make_sample(void) {
  fs_context ctx = test_context();
  sample s = {.surface = sample_torus(12, 9, every_third, 0.01)};
  for (int j = 0; j < 9; j++)
    s.surface->patch[12 * j].neighbour[3] = s.surface->patch[11 + 12 * j].neighbour[1] = FS_NONE;
  assert_int_equal(fs_tessellate(&ctx, s.surface, N_STEPS, &s.t), FS_OK);
  assert_true(s.t->n_vertices >= 1000);
  s.normal = malloc((size_t)s.t->n_vertices * sizeof *s.normal);
  for (int32_t k = 0; k < s.t->n_vertices; k++)
    s.normal[k] = normal_of(s.surface, s.t->vertex_patch[k], s.t->vertex_uv[2 * k], s.t->vertex_uv[2 * k + 1]);
  return s;
}

static void free_sample(sample *s) {
  fs_triangles_free(&(fs_context){0}, s->t);
  sample_free(s->surface);
  free(s->normal);
}

/* choice: a parameter that says which form the format takes; NULL: none */
static memory_output export(const sample *s, const char *extension, int steps, const char *choice, int value,
                            const fs_measure *colour) {
  fs_context ctx = test_context();
  const fs_exporter *exporter = fs_exporter_find(extension);
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  fs_model model = {.name = "m", .surface = s->surface, .colour = colour};
  double param[32];
  for (int k = 0; exporter->params[k].name != NULL; k++) param[k] = exporter->params[k].initial;
  memory_output_set(exporter, param, strcmp(extension, "pov") == 0 ? "pov-steps" : "steps", steps);
  if (choice != NULL) memory_output_set(exporter, param, choice, value);
  if (fs_export(&ctx, &model, exporter, param, &output) != FS_OK) fail_msg("%s", ctx.message);
  return file;
}

static void check_normal(fs_vec3 expected, const double *n, double tolerance) {
  double x = n[0] - expected.x, y = n[1] - expected.y, z = n[2] - expected.z;
  if (!(fabs(x) <= tolerance && fabs(y) <= tolerance && fabs(z) <= tolerance))
    fail_msg("normal (%g %g %g) instead of (%g %g %g)", n[0], n[1], n[2], expected.x, expected.y, expected.z);
}

/* n lines of numbers behind a text, each beginning with `skip` numbers and then a normal. */
static void check_text(const sample *s, memory_output file, const char *behind, size_t skip, size_t n_numbers,
                       double tolerance) {
  const char *at = strstr(file.bytes, behind);
  assert_non_null(at);
  at += strlen(behind);
  for (int32_t k = 0; k < s->t->n_vertices; k++) {
    double number[16];
    at = memory_output_numbers(at, "", n_numbers, number);
    assert_non_null(at);
    check_normal(s->normal[k], number + skip, tolerance);
  }
  free(file.bytes);
}

static void test_text_formats(void **state) {
  sample s = make_sample();
  char normal_vectors[40];
  (void)state;
  snprintf(normal_vectors, sizeof normal_vectors, "normal_vectors { %d,", (int)s.t->n_vertices);
  check_text(&s, export(&s, "obj", N_STEPS, NULL, 0, NULL), "\nvn ", 0, 3, 1e-13);
  check_text(&s, export(&s, "ply", N_STEPS, "format", 1, NULL), "end_header\n", 3, 6, 1e-9);
  check_text(&s, export(&s, "scad", N_STEPS, NULL, 0, NULL), "m_normals = [", 0, 3, 1e-7);
  check_text(&s, export(&s, "pov", 2, "pov", 1, NULL), normal_vectors, 0, 3, 1e-7); /* 2^2 steps, as mesh2 */
  free_sample(&s);
}

static void test_binary_ply(void **state) {
  sample s = make_sample();
  memory_output file = export(&s, "ply", N_STEPS, "format", 0, NULL);
  const char *at = strstr(file.bytes, "end_header\n") + strlen("end_header\n");
  (void)state;
  for (int32_t k = 0; k < s.t->n_vertices; k++, at += 36) {
    float n[3];
    memcpy(n, at + 24, sizeof n);
    check_normal(s.normal[k], (const double[]){n[0], n[1], n[2]}, 6e-8);
  }
  free(file.bytes);
  free_sample(&s);
}

/* Facets of STL have the normal of their plane: within the angle that a facet turns, here 0.2. */
static void test_stl(void **state) {
  sample s = make_sample();
  memory_output file = export(&s, "stl", N_STEPS, "format", 0, NULL);
  (void)state;
  for (int32_t k = 0; k < s.t->n_triangles; k++) {
    float n[3];
    memcpy(n, file.bytes + 84 + 50 * k, sizeof n);
    for (int i = 0; i < 3; i++) {
      fs_vec3 m = s.normal[s.t->corner[3 * k + i]];
      assert_true(n[0] * m.x + n[1] * m.y + n[2] * m.z > cos(0.2));
    }
  }
  free(file.bytes);
  free_sample(&s);
}

/* Of a measure of the caller's: the height, and no number on one half. */
static double height(const double *param, const fs_vec3 x[FS_JET_SIZE]) {
  (void)param;
  return x[FS_D].x < 0 ? (double)NAN : x[FS_D].z;
}
static const fs_measure measure = {"height", "z, where x is positive", NULL, height, NULL, NULL};

static void test_measure_in_ply(void **state) {
  sample s = make_sample();
  memory_output text = export(&s, "ply", N_STEPS, "format", 1, &measure);
  memory_output binary = export(&s, "ply", N_STEPS, "format", 0, &measure);
  const char *at = strstr(text.bytes, "end_header\n") + strlen("end_header\n");
  const char *from = strstr(binary.bytes, "end_header\n") + strlen("end_header\n");
  (void)state;
  assert_non_null(
      strstr(text.bytes, "\nproperty float nz\nproperty float height\nproperty float quality\nelement face"));
  assert_non_null(strstr(text.bytes, "\ncomment height and quality: z, where x is positive\n"));
  for (int32_t k = 0; k < s.t->n_vertices; k++, from += 44) {
    fs_vec3 p = s.t->position[k];
    double number[8], expected = p.x < 0 ? 0 : p.z;
    float value[2];
    at = memory_output_numbers(at, "", 8, number);
    assert_true(fabs(number[6] - expected) < 1e-9 && number[7] == number[6]);
    check_normal(s.normal[k], number + 3, 1e-9);
    memcpy(value, from + 36, sizeof value);
    assert_true(value[0] == (float)expected && value[1] == value[0]);
  }
  free(text.bytes);
  text = export(&s, "ply", N_STEPS, "format", 1, fs_measure_find("gaussian"));
  assert_non_null(strstr(text.bytes, "\nproperty float gaussian\n"));
  free(text.bytes);
  free(binary.bytes);
  free_sample(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_text_formats),
      cmocka_unit_test(test_binary_ply),
      cmocka_unit_test(test_stl),
      cmocka_unit_test(test_measure_in_ply),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
