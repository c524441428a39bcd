/* SPDX-License-Identifier: MIT */
/* Single role: tests of the OpenSCAD exporter: what the file says against the surface and the tessellation. Whether
   OpenSCAD itself takes the files is tested in tests/openscad. */
#include "memory_output.h"
#include "openscad.h"
#include "surface_samples.h"
#include "../support/support.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

static const double automatic[] = {0, 0, 0, 1e-3, 10000};

/* z = (x^2 + y^2) / (2 R) over [-1, 1]^2 as one bicubic patch, u along x. Outside is up, to which it bends. */
static fs_surface *paraboloid(double R) {
  fs_surface *s = calloc(1, sizeof *s);
  s->n_patches = 1;
  s->n_data = 48;
  s->patch = calloc(1, sizeof *s->patch);
  s->data = calloc(48, sizeof *s->data);
  s->patch[0] = (fs_patch){.n_sides = 4,
                           .degree_u = 3,
                           .degree_v = 3,
                           .face = 7,
                           .valence = 4,
                           .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  for (int k = 0; k < 16; k++) {
    /* the blossom of x^2 at (-1, -1, -1), (-1, -1, 1), (-1, 1, 1), (1, 1, 1): the mean of the products of pairs */
    static const double squares[] = {1, -1 / 3., -1 / 3., 1};
    s->data[3 * k] = -1 + 2 * (k % 4) / 3.;
    s->data[3 * k + 1] = -1 + 2 * (k / 4) / 3.;
    s->data[3 * k + 2] = (squares[k % 4] + squares[k / 4]) / (2 * R);
  }
  return s;
}

/* The torus cut along one ring of sides: a tube, bent round, with two rims. */
static fs_surface *cut_torus(int n, int m) {
  fs_surface *s = sample_torus(n, m, NULL, 0);
  for (int j = 0; j < m; j++) {
    s->patch[n * j].neighbour[3] = FS_NONE;
    s->patch[n - 1 + n * j].neighbour[1] = FS_NONE;
  }
  return s;
}

static memory_output export(fs_context *ctx, const fs_surface *surface, const char *name, const double *param) {
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  fs_model model = {.name = name, .surface = surface, .made_with = "line\nbreak"};
  if (fs_export(ctx, &model, fs_exporter_find("scad"), param, &output) != FS_OK) fail_msg("%s", ctx->message);
  assert_int_equal(file.n_opened, 1);
  assert_string_equal(file.extension, "scad");
  return file;
}

static int32_t n_steps_of(const char *bytes) {
  double steps[3];
  assert_non_null(memory_output_numbers(strstr(bytes, " patches as "), "as", 3, steps));
  return (int32_t)steps[1];
}

static void test_names(void **state) {
  static const char *const pairs[][2] = {{"pipe", "pipe"},
                                         {"3-way pipe", "_3_way_pipe"},
                                         {"cube", "cube_surface"},
                                         {"hull", "hull_surface"},
                                         {"Cube", "Cube"},
                                         {"each", "each_surface"},
                                         {"PI", "PI_surface"},
                                         {"", "_surface"},
                                         {"a.b", "a_b"},
                                         {"\xc3\xa9t\xc3\xa9", "__t__"},
                                         {"import_stl", "import_stl_surface"},
                                         {"cubes", "cubes"},
                                         {"$fn", "_fn"},
                                         {"is_undef", "is_undef_surface"}};
  char name[FS_OPENSCAD_NAME], longest[200];
  (void)state;
  for (size_t k = 0; k < sizeof pairs / sizeof *pairs; k++) {
    fs_openscad_name(pairs[k][0], name);
    assert_string_equal(name, pairs[k][1]);
  }
  memset(longest, '9', sizeof longest);
  longest[sizeof longest - 1] = '\0';
  fs_openscad_name(longest, name);
  assert_int_equal(strlen(name), FS_OPENSCAD_NAME - 1);
  assert_true(name[0] == '_' && name[1] == '9');
}

/* Points and normals are those of the tessellation, faces are turned round, the border is what has no other side. */
static void test_open_surface(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = cut_torus(12, 5);
  memory_output file = export(&ctx, surface, "bent tube", (const double[]){0.05, 1, 3, 1e-3, 10});
  fs_triangles *t = NULL;
  double *number;
  int32_t *n_sides, n_border = 0;
  (void)state;
  assert_int_equal(n_steps_of(file.bytes), 3);
  assert_int_equal(fs_tessellate(&ctx, surface, 3, &t), FS_OK);
  number = malloc((size_t)(3 * t->n_triangles + 3 * t->n_vertices) * sizeof *number);
  n_sides = calloc((size_t)t->n_vertices * (size_t)t->n_vertices, sizeof *n_sides);
  assert_non_null(memory_output_numbers(file.bytes, "bent_tube_points = [", 3 * (size_t)t->n_vertices, number));
  for (int32_t k = 0; k < t->n_vertices; k++) {
    fs_vec3 p = t->position[k];
    assert_true(fabs(number[3 * k] - p.x) < 5e-9 && fabs(number[3 * k + 1] - p.y) < 5e-9);
    assert_true(fabs(number[3 * k + 2] - p.z) < 5e-9);
  }
  assert_non_null(memory_output_numbers(file.bytes, "bent_tube_normals = [", 3 * (size_t)t->n_vertices, number));
  for (int32_t k = 0; k < t->n_vertices; k++) {
    fs_vec3 n = t->normal[k];
    assert_true(fabs(number[3 * k] - n.x) < 5e-7 && fabs(number[3 * k + 1] - n.y) < 5e-7);
    assert_true(fabs(number[3 * k + 2] - n.z) < 5e-7);
  }
  assert_non_null(memory_output_numbers(file.bytes, "bent_tube_faces = [", 3 * (size_t)t->n_triangles, number));
  for (int32_t k = 0; k < t->n_triangles; k++) {
    const int32_t *c = t->corner + 3 * k;
    assert_true(number[3 * k] == c[0] && number[3 * k + 1] == c[2] && number[3 * k + 2] == c[1]);
    for (int i = 0; i < 3; i++) n_sides[c[i] + t->n_vertices * c[(i + 1) % 3]]++;
  }
  for (const char *loop = strstr(strstr(file.bytes, "bent_tube_border"), "\n[") + 1; *loop == '[';) {
    const char *end = strchr(loop, ']');
    int32_t first = atoi(loop + 1), a = first;
    for (const char *at = loop; at < end; n_border++) {
      const char *comma = strchr(at + 1, ',');
      int32_t b = comma != NULL && comma < end ? atoi(comma + 1) : first;
      assert_int_equal(n_sides[a + t->n_vertices * b], 1);
      assert_int_equal(n_sides[b + t->n_vertices * a], 0);
      a = b;
      at = comma != NULL && comma < end ? comma : end;
    }
    loop = end + (end[1] == ',' ? 3 : 2);
  }
  assert_int_equal(n_border, 2 * 5 * 3);
  assert_non_null(strstr(file.bytes, "\nwall = 0.05; // [0.005:0.005:0.5]\n"));
  assert_non_null(strstr(file.bytes, "\nside = 0; // ["));
  assert_non_null(strstr(file.bytes, "\n// line break\n"));
  assert_non_null(strstr(file.bytes, "//   use <bent tube.scad>\n"));
  assert_non_null(strstr(file.bytes, "\nmodule bent_tube(wall = wall, side = side, size = size, "));
  assert_non_null(strstr(file.bytes, "\nfunction bent_tube_vnf("));
  fs_triangles_free(&ctx, t);
  free(number);
  free(n_sides);
  free(file.bytes);
  sample_free(surface);
}

/* A closed surface has neither wall nor normals nor border, and comes out right side out whatever it was. */
static void test_closed_surface(void **state) {
  (void)state;
  for (int is_reversed = 0; is_reversed < 2; is_reversed++) {
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    fs_surface *surface = sample_torus(8, 6, NULL, 0);
    memory_output file;
    double points[3 * 48 * 4], faces[3 * 2 * 48 * 4], volume = 0;
    for (size_t k = 2; is_reversed && k < surface->n_data; k += 3) surface->data[k] *= -1; /* a mirror */
    file = export(&ctx, surface, "ring", (const double[]){0, 0, 2, 1e-3, 10});
    assert_int_equal(memory.n_notes, is_reversed);
    assert_non_null(memory_output_numbers(file.bytes, "ring_points = [", 3 * 48 * 4, points));
    assert_non_null(memory_output_numbers(file.bytes, "ring_faces = [", 3 * 2 * 48 * 4, faces));
    for (int k = 0; k < 2 * 48 * 4; k++) {
      const double *a = points + 3 * (int)faces[3 * k], *b = points + 3 * (int)faces[3 * k + 1];
      const double *c = points + 3 * (int)faces[3 * k + 2];
      volume +=
          a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    assert_true(volume / 6 < -2.5 && volume / 6 > -4.8); /* clockwise from outside */
    assert_null(strstr(file.bytes, "wall"));
    assert_null(strstr(file.bytes, "normals"));
    assert_null(strstr(file.bytes, "border"));
    assert_non_null(strstr(file.bytes, "\nmodule ring(size = size, "));
    free(file.bytes);
    sample_free(surface);
    assert_int_equal(memory.n_live, 0);
  }
}

/* The paraboloid's curvature is largest in its vertex, 1 / R towards the outside; its distance from n x n cells is
   1 / (R n^2) along z, in the middle of the cut cell there. */
static void test_survey_of_a_paraboloid(void **state) {
  fs_context ctx = test_context();
  fs_surface *surface = paraboloid(3);
  fs_survey s;
  (void)state;
  assert_int_equal(fs_survey_surface(&ctx, surface, &s), FS_OK);
  assert_true(fabs(s.radius[FS_OUTWARDS] - 3) < 1e-12);
  assert_true(fabs(s.place[FS_OUTWARDS].x) < 1e-12 && fabs(s.place[FS_OUTWARDS].z) < 1e-12);
  assert_int_equal(s.patch[FS_OUTWARDS], 0);
  assert_int_equal(s.patch[FS_INWARDS], FS_NONE);
  assert_true(isinf(s.radius[FS_INWARDS]));
  assert_true(fabs(s.min.z) < 1e-12 && fabs(s.max.z - 1 / 3.) < 1e-12 && s.max.x == 1 && s.min.y == -1);
  assert_true(fabs(fs_survey_deviation(&s, 4) - 1 / (3. * 16)) < 1e-12);
  sample_free(surface);
}

static void test_steps_follow_the_tolerance(void **state) {
  fs_context ctx = test_context();
  struct test_memory memory = {0};
  fs_context counting = test_memory_context(&memory);
  fs_surface *surface = paraboloid(1), *many = sample_torus(80, 70, NULL, 0);
  const double diagonal = sqrt(4 + 4 + 1);
  memory_output file;
  (void)state;
  /* 1 / n^2 <= tolerance */
  file = export(&ctx, surface, "p", (const double[]){0, 0, 0, 1 / (6.5 * 6.5) / diagonal, 10000});
  assert_int_equal(n_steps_of(file.bytes), 7);
  free(file.bytes);
  file = export(&counting, surface, "p", (const double[]){0, 0, 0, 1e-9, 10000});
  assert_int_equal(n_steps_of(file.bytes), 70);
  assert_non_null(strstr(memory.note, "9800 triangles"));
  free(file.bytes);
  file = export(&counting, many, "p", automatic);
  assert_int_equal(n_steps_of(file.bytes), 1);
  assert_non_null(strstr(memory.note, "5600 patches"));
  free(file.bytes);
  sample_free(surface);
  sample_free(many);
}

/* Walls up to the radius of curvature of their side pass; thicker ones are told of, with the place. */
static void test_walls_that_fold(void **state) {
  fs_surface *surface = paraboloid(2);
  static const struct {
    double wall, side;
    int32_t n_notes;
  } cases[] = {{1.99, 2, 0}, {2, 2, 1}, {50, 0, 0}, {3.98, 1, 0}, {4, 1, 1}};
  (void)state;
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    memory_output file = export(&ctx, surface, "p", (const double[]){cases[k].wall, cases[k].side, 4, 1e-3, 10000});
    assert_int_equal(memory.n_notes, cases[k].n_notes);
    if (memory.n_notes > 0) {
      double place[3];
      assert_non_null(memory_output_numbers(memory.note, "outwards folds: the radius of curvature is 2 at", 3, place));
      assert_true(fabs(place[0]) < 1e-12 && fabs(place[1]) < 1e-12 && fabs(place[2]) < 1e-12);
      assert_non_null(strstr(memory.note, "patch 0, face 7"));
    }
    free(file.bytes);
  }
  /* chosen: a fiftieth of the box, at most half the radius; 1, 2 or 5 times a power of ten */
  for (int32_t side = 0; side < 3; side++) {
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    fs_surface *sharp = paraboloid(0.02);
    double param[] = {0, side, 4, 1e-3, 10000}, wall;
    memory_output file = export(&ctx, sharp, "p", param);
    assert_non_null(memory_output_numbers(file.bytes, "\nwall =", 1, &wall));
    assert_true(wall == (side == 0 ? 1 : side == 1 ? 0.02 : 0.01));
    assert_int_equal(memory.n_notes, 0);
    free(file.bytes);
    sample_free(sharp);
  }
  sample_free(surface);
}

static void test_refusals_and_notes(void **state) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  fs_surface *surface = paraboloid(2), none = {0};
  fs_model model = {.name = "p", .surface = &none};
  (void)state;
  assert_int_equal(fs_export(&ctx, &model, fs_exporter_find("scad"), NULL, &output), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "patch"));
  model.surface = surface;
  for (int k = 0; k < 4; k++) memcpy(surface->data + 12 * k, surface->data, 3 * sizeof(double)); /* a side is a point */
  assert_int_equal(fs_export(&ctx, &model, fs_exporter_find("scad"), NULL, &output), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "patch 0 has no area"));
  surface->data[0] = NAN;
  assert_int_equal(fs_export(&ctx, &model, fs_exporter_find("scad"), NULL, &output), FS_ERR_NUMERIC);
  assert_int_equal(file.n_opened, 0);
  sample_free(surface);
  surface = paraboloid(2);
  for (size_t k = 0; k < surface->n_data; k++) surface->data[k] *= 1e-6;
  file = export(&ctx, surface, "small", automatic);
  assert_non_null(strstr(memory.note, "joins points"));
  assert_int_equal(memory.n_live, 0);
  free(file.bytes);
  sample_free(surface);
}

static void test_every_allocation_may_fail(void **state) {
  fs_surface *surface = cut_torus(4, 3);
  (void)state;
  for (int64_t n = 1;; n++) {
    struct test_memory memory = {.fail_at = n};
    fs_context ctx = test_memory_context(&memory);
    memory_output file = {0};
    fs_output output = memory_output_of(&file);
    fs_model model = {.name = "m", .surface = surface};
    fs_status status = fs_export(&ctx, &model, fs_exporter_find("scad"), automatic, &output);
    assert_int_equal(memory.n_live, 0);
    free(file.bytes);
    if (status == FS_OK) break;
    assert_int_equal(status, FS_ERR_MEMORY);
    assert_int_equal(file.n_opened, 0);
  }
  sample_free(surface);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_names),
      cmocka_unit_test(test_open_surface),
      cmocka_unit_test(test_closed_surface),
      cmocka_unit_test(test_survey_of_a_paraboloid),
      cmocka_unit_test(test_steps_follow_the_tolerance),
      cmocka_unit_test(test_walls_that_fold),
      cmocka_unit_test(test_refusals_and_notes),
      cmocka_unit_test(test_every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
