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
#include "mesh/cap_json.h"
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
#ifdef FS_HAVE_DRACO
  check_net(&s, "drc", "net-bits", 0, 1e-6); /* positions in single precision */
  check_net(&s, "drc", "net-bits", 16, 1e-3);
#endif
  sample_close(&s);
}

/* ---- the file beside a net ---- */

static char folder[] = "/tmp/fairsurf-caps-XXXXXX";

static const char *path_of(const char *name) {
  static char path[64];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return path;
}

static void write_file(const char *name, const char *text, size_t size) {
  FILE *file = fopen(path_of(name), "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(text, 1, size, file), size);
  assert_int_equal(fclose(file), 0);
}

static bool has_file(const char *name) {
  FILE *file = fopen(path_of(name), "rb");
  if (file != NULL) fclose(file);
  return file != NULL;
}

static void check_beside(sample *s, const char *name) {
  fs_model model = {.control = s->mesh, .caps = s->notes};
  fs_mesh *mesh = NULL;
  fs_mesh_notes notes;
  fs_surface *surface;
  assert_int_equal(fs_export_file(&s->ctx, &model, NULL, path_of(name)), FS_OK);
  assert_true(has_file("net.caps.json"));
  assert_int_equal(fs_mesh_read_notes(&s->ctx, path_of(name), &mesh, &notes), FS_OK);
  assert_non_null(notes.caps);
  surface = surface_of(&s->ctx, mesh, notes.caps);
  assert_true(surface->n_data == s->surface->n_data);
  assert_memory_equal(surface->data, s->surface->data, surface->n_data * sizeof *surface->data);
  fs_surface_free(&s->ctx, surface);
  fs_mesh_notes_clear(&s->ctx, &notes);
  fs_mesh_free(&s->ctx, mesh);
  mesh = NULL;
  assert_int_equal(fs_mesh_read(&s->ctx, path_of(name), &mesh), FS_OK);
  fs_mesh_free(&s->ctx, mesh);
}

/* The same bits back; a file for another net is left out, with a note; one that is damaged is refused under its name. */
static void test_beside(void **state) {
  sample s;
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_mesh *mesh = NULL;
  fs_mesh_notes notes = {0};
  char *text;
  size_t size;
  (void)state;
  assert_non_null(mkdtemp(folder));
  sample_open(&s);
  check_beside(&s, "net.off");
  check_beside(&s, "net.obj");
  text = test_file(path_of("net.caps.json"), &size);
  s.mesh->position[5].x += 1e-9;
  fs_model moved = {.control = s.mesh};
  assert_int_equal(fs_export_file(&ctx, &moved, NULL, path_of("net.obj")), FS_OK);
  assert_int_equal(fs_mesh_read_notes(&ctx, path_of("net.obj"), &mesh, &notes), FS_OK);
  assert_null(notes.caps);
  assert_non_null(strstr(memory.note, "net.caps.json was written for another net than"));
  fs_mesh_notes_clear(&ctx, &notes);
  fs_mesh_free(&ctx, mesh);
  mesh = NULL;
  write_file("net.caps.json", text, size - 3);
  assert_int_equal(fs_mesh_read_notes(&ctx, path_of("net.obj"), &mesh, &notes), FS_ERR_FORMAT);
  assert_null(mesh);
  assert_non_null(strstr(ctx.message, "net.caps.json: line "));
  assert_non_null(strstr(ctx.message, "the file ends where"));
  free(text);
  for (int i = 0; i < 3; i++) remove(path_of((const char *const[]){"net.obj", "net.off", "net.caps.json"}[i]));
  fs_context_clear(&ctx);
  assert_int_equal(memory.n_live, 0);
  sample_close(&s);
}

/* Without that file the net says what it lacks. */
static void test_lost(void **state) {
  sample s;
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  (void)state;
  sample_open(&s);
  for (int i = 0; i < 2; i++) {
    const fs_exporter *exporter = fs_exporter_find((const char *const[]){"obj", "off"}[i]);
    fs_model model = {.name = "prism", .control = s.mesh, .caps = s.notes};
    double param[32] = {0};
    memory_output file = {0};
    fs_output output = memory_output_of(&file);
    memory_output_set(exporter, param, "steps", 1);
    memory_output_set(exporter, param, "caps-file", 0);
    assert_int_equal(fs_export(&ctx, &model, exporter, param, &output), FS_OK);
    assert_int_equal(file.n_opened, 1);
    assert_int_equal(memory.n_notes, i + 1);
    assert_string_equal(
        memory.note, "prism is written without the inner coefficients of its 9 caps: alone it makes another surface");
    assert_non_null(
        strstr(file.bytes, "\n# without the inner coefficients of 9 caps: alone it makes another surface\n"));
    free(file.bytes);
  }
  sample_close(&s);
}

typedef struct refusal {
  const char *text, *message;
} refusal;

#define HEAD "{\"basis\": 1, \"vertices\": 8,\n\"faces\": 6, \"checksum\": \"0123456789abcdef\", \"caps\": "
#define CAP "{\"vertex\": 0, \"spoke\": 1, \"valence\": 3, \"coefficients\": "

static const refusal refusals[] = {
    {"", "the file is empty"},
    {"\n\n[", "line 3: '{' is needed, not '['"},
    {"{", "line 1: the file ends where '\"' is needed"},
    {"{\"basis", "line 1: a string does not end, or has escapes"},
    {"{\"ba\\u0073is\": 1}", "line 1: a string does not end, or has escapes"},
    {"{\"basis\": 1.5}", "line 1: '1.5' is not an integer"},
    {"{\"basis\": 1}", "line 1: the file needs basis, vertices, faces, checksum and caps"},
    {"{\"basis\": 1, \"basis\": 1}", "line 1: 'basis' is no part of a file of inner coefficients, or is there twice"},
    {"{\"colour\": 1}", "line 1: 'colour' is no part of a file of inner coefficients, or is there twice"},
    {"{\"checksum\": \"12\"}", "line 1: the checksum has 2 digits instead of 16"},
    {"{\"checksum\": \"0123456789ABCDEF\"}", "line 1: the checksum has other than hexadecimal digits"},
    {HEAD "[]}", "line 2: '{' is needed, not ']'"},
    {HEAD "[{\"vertex\": 0}]}", "line 2: a cap needs vertex, spoke, valence and coefficients"},
    {HEAD "[{\"valence\": 0, \"valence\": 1}]}", "line 2: 'valence' is no part of a cap, or is there twice"},
    {HEAD "[" CAP "[]}]}", "line 2: '[' is needed, not ']'"},
    {HEAD "[" CAP "[[1, 2]]}]}", "line 2: ',' is needed, not ']'"},
    {HEAD "[" CAP "[[1, 2, 3, 4]]}]}", "line 2: ']' is needed, not ','"},
    {HEAD "[" CAP "[[1, 2, NaN]]}]}", "line 2: 'N' is not a number"},
    {HEAD "[" CAP "[[1, 2, 1e999]]}]}", "line 2: '1e999' is too large for a number"},
    {HEAD "[" CAP "[[1, 2, 3]]}]} x", "line 2: something follows the end"},
    {HEAD "[" CAP "[[1, 2, 3]]}", "line 2: the file ends where ']' is needed"},
};

static void test_refusals(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    fs_caps_file file = {0};
    size_t size = strlen(refusals[i].text);
    char *exact = malloc(size + 1); /* a sanitizer sees reads beyond it */
    memcpy(exact, refusals[i].text, size);
    exact = realloc(exact, size > 0 ? size : 1);
    assert_int_equal(fs_caps_file_parse(&ctx, exact, size, &file), FS_ERR_FORMAT);
    assert_string_equal(ctx.message, refusals[i].message);
    assert_null(file.notes);
    assert_int_equal(memory.n_live, 0);
    free(exact);
  }
}

/* Every beginning of a good file is refused, whatever the place of the cut. */
static void test_cut(void **state) {
  static const char text[] = HEAD "[" CAP "[[1, -2e-3, 3],[0, .5, 7]]},\n" CAP "[[0,0,0]]}]}";
  fs_context ctx = test_context();
  fs_caps_file file = {0};
  (void)state;
  for (size_t size = 0; size < sizeof text - 1; size++)
    assert_int_equal(fs_caps_file_parse(&ctx, text, size, &file), FS_ERR_FORMAT);
  assert_int_equal(fs_caps_file_parse(&ctx, text, sizeof text - 1, &file), FS_OK);
  assert_true(file.checksum == UINT64_C(0x0123456789abcdef) && file.n_vertices == 8 && file.n_faces == 6);
  assert_true(file.notes->n_caps == 2 && file.notes->n_coefficients == 3 && file.notes->basis == 1);
  assert_true(file.notes->coefficient[0].y == -2e-3 && file.notes->cap[1].first == 2 && file.notes->cap[1].n == 1);
  fs_cap_notes_free(&ctx, file.notes);
}

/* ---- what has none ---- */

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
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_nets),     cmocka_unit_test(test_absent),
                                     cmocka_unit_test(test_beside),   cmocka_unit_test(test_lost),
                                     cmocka_unit_test(test_refusals), cmocka_unit_test(test_cut)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
