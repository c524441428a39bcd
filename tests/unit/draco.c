/* SPDX-License-Identifier: MIT */
/* Single role: control nets through Draco files and back: polygons, marks and texts exactly, positions to half a step of
   the grid; and bytes that are no such files. */
#include "draco_samples.h"

/* A renumbered net is the same net: every face has the same cycle of vertices, and no face is missing. */
static void check_same_faces(const fs_mesh *a, const fs_mesh *b, const int32_t *b_to_a) {
  int32_t *is_met = calloc((size_t)a->n_faces, sizeof *is_met);
  assert_int_equal(a->n_faces, b->n_faces);
  for (int32_t f = 0; f < b->n_faces; f++) {
    int32_t n = fs_mesh_face_size(b, f), h = b->face_start[f], from = b_to_a[b->origin[h]], found = FS_NONE;
    int32_t to = b_to_a[fs_mesh_target(b, h)], start = a->outgoing[from], g = start;
    do {
      if (fs_mesh_target(a, g) == to) found = g;
      g = fs_mesh_rotate(a, g);
    } while (g != start && g != FS_NONE);
    assert_int_not_equal(found, FS_NONE);
    assert_int_equal(fs_mesh_face_size(a, a->face[found]), n);
    for (int32_t i = 0; i < n; i++, h = fs_mesh_next(b, h), found = fs_mesh_next(a, found))
      assert_int_equal(b_to_a[b->origin[h]], a->origin[found]);
    assert_int_equal(is_met[a->face[found]]++, 0);
  }
  free(is_met);
}

static void check_net(const fs_mesh *mesh, int bits, uint64_t *random) {
  fs_context ctx = test_context();
  uint8_t *fixed = malloc((size_t)mesh->n_vertices);
  int32_t *original = malloc((size_t)mesh->n_vertices * sizeof *original);
  bool *is_met = calloc((size_t)mesh->n_vertices, sizeof *is_met);
  fs_model model = {.name = "net",
                    .control = mesh,
                    .fixed = fixed,
                    .made_with = "two\nlines",
                    .functional = "least c=1",
                    .n_refinements = 3};
  fs_mesh *back = NULL;
  fs_mesh_notes notes;
  double tolerance = draco_tolerance(mesh->n_vertices, mesh->position, bits);
  draco_cells cells = draco_cells_of(mesh->n_vertices, mesh->position, tolerance);
  for (int32_t v = 0; v < mesh->n_vertices; v++) fixed[v] = test_random_integer(random, 0, 3) == 0;
  memory_output file = draco_export(&ctx, &model, "drc", "net-bits", bits);
  assert_int_equal(file.n_opened, 1);
  assert_string_equal(file.extension, "drc");
  if (fs_mesh_parse_notes(&ctx, "drc", file.bytes, file.size, &back, &notes) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(back->n_vertices, mesh->n_vertices);
  assert_non_null(notes.fixed);
  for (int32_t v = 0; v < back->n_vertices; v++) {
    original[v] = draco_find_point(&cells, back->position[v]);
    assert_int_not_equal(original[v], FS_NONE); /* none within the tolerance */
    assert_false(is_met[original[v]]);
    is_met[original[v]] = true;
    assert_int_equal(notes.fixed[v], fixed[original[v]]);
  }
  check_same_faces(mesh, back, original);
  assert_string_equal(notes.made_with, "two lines");
  assert_string_equal(notes.functional, "least c=1");
  assert_int_equal(notes.n_refinements, 3);
  fs_mesh_notes_clear(&ctx, &notes);
  fs_mesh_free(&ctx, back);
  draco_cells_free(&cells);
  free(file.bytes);
  free(fixed);
  free(original);
  free(is_met);
}

static void test_nets_read_back(void **state) {
  static const int bits[] = {14, 16, 20, 0};
  uint64_t random = 5;
  (void)state;
  for (uint64_t seed = 0; seed < 24; seed++) {
    fs_context ctx = test_context();
    fs_mesh *mesh = seed == 0 ? test_prism(300) : seed == 1 ? test_prism(5) : test_random_mesh(seed);
    fs_mesh_summary s;
    for (int k = 0; k < 4; k++) check_net(mesh, bits[k], &random);
    assert_int_equal(fs_mesh_summarise(&ctx, mesh, &s), FS_OK);
    double size = fmax(fmax(s.max.x - s.min.x, s.max.y - s.min.y), s.max.z - s.min.z);
    for (int32_t v = 0; v < mesh->n_vertices; v++)
      mesh->position[v].x += 1000 * size, mesh->position[v].z -= 1000 * size;
    for (int k = 0; k < 4; k++) check_net(mesh, bits[k], &random);
    fs_mesh_free(&ctx, mesh);
  }
}

/* Faces whose first diagonal would meet an edge or another diagonal. */
static void test_diagonals_that_are_taken(void **state) {
  static const fs_vec3 five[] = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}, {1, 1, 2}};
  static const int32_t pillow_start[] = {0, 4, 8}, pillow[] = {0, 1, 2, 3, 0, 3, 2, 1};
  static const int32_t wedge_start[] = {0, 4, 7, 11}, wedge[] = {0, 1, 2, 3, 0, 2, 1, 0, 3, 2, 4};
  uint64_t random = 7;
  fs_context ctx = test_context();
  fs_mesh *mesh = test_mesh(4, five, 2, pillow_start, pillow);
  (void)state;
  check_net(mesh, 16, &random);
  fs_mesh_free(&ctx, mesh);
  mesh = test_mesh(5, five, 3, wedge_start, wedge);
  check_net(mesh, 16, &random);
  fs_mesh_free(&ctx, mesh);
}

/* The seven vertices of a torus on which each joins each [Csaszar 1949], with four triangles made a hexagon, such that every
   fan of it needs an edge that is there: it cannot be kept, and a sentence says so. */
static void test_a_face_that_cannot_be_split(void **state) {
  static const int32_t hexagon[] = {0, 5, 1, 4, 3, 2}, gone[4][3] = {{0, 1, 3}, {5, 1, 0}, {1, 4, 3}, {0, 3, 2}};
  fs_context ctx = test_context();
  fs_vec3 p[7];
  int32_t start[12] = {0, 6}, corner[6 + 30], n_faces = 1, n = 6;
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  (void)state;
  for (int i = 0; i < 7; i++) p[i] = (fs_vec3){i, i * i, i * i * i};
  memcpy(corner, hexagon, sizeof hexagon);
  for (int i = 0; i < 14; i++) {
    int32_t k = i / 2, triangle[2][3] = {{k, (k + 1) % 7, (k + 3) % 7}, {k, (k + 3) % 7, (k + 2) % 7}};
    bool is_gone = false;
    for (int g = 0; g < 4; g++) is_gone |= memcmp(triangle[i % 2], gone[g], sizeof gone[g]) == 0;
    if (is_gone) continue;
    memcpy(corner + n, triangle[i % 2], sizeof triangle[0]);
    start[++n_faces] = n += 3;
  }
  assert_int_equal(n_faces, 11);
  fs_mesh *mesh = test_mesh(7, p, n_faces, start, corner);
  fs_model model = {.name = "net", .control = mesh};
  assert_int_equal(fs_export(&ctx, &model, fs_exporter_find("drc"), NULL, &output), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "face 0"));
  assert_int_equal(file.n_opened, 0);
  fs_mesh_free(&ctx, mesh);
}

static void test_parts_and_nothing_said(void **state) {
  fs_context ctx = test_context();
  static const fs_vec3 p[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  static const int32_t start[] = {0, 4, 7}, corner[] = {0, 1, 2, 3, 4, 5, 6};
  fs_mesh *mesh = test_mesh(7, p, 2, start, corner), *back = NULL;
  fs_model model = {.name = "net", .control = mesh};
  fs_mesh_notes notes;
  memory_output file = draco_export(&ctx, &model, "drc", NULL, 0);
  (void)state;
  assert_int_equal(fs_mesh_parse_notes(&ctx, "DRC", file.bytes, file.size, &back, &notes), FS_OK);
  assert_int_equal(back->n_vertices, 7);
  assert_int_equal(back->n_faces, 2);
  assert_null(notes.fixed);
  assert_null(notes.made_with);
  assert_null(notes.functional);
  assert_int_equal(notes.n_refinements, 0);
  fs_mesh_notes_clear(&ctx, &notes);
  fs_mesh_free(&ctx, back);
  free(file.bytes);
  /* Formats without notes leave none. */
  file = draco_export(&ctx, &model, "obj", NULL, 0);
  notes.n_refinements = 9;
  assert_int_equal(fs_mesh_parse_notes(&ctx, "obj", file.bytes, file.size, &back, &notes), FS_OK);
  assert_int_equal(notes.n_refinements, 0);
  assert_null(notes.fixed);
  fs_mesh_free(&ctx, back);
  free(file.bytes);
  fs_mesh_free(&ctx, mesh);
}

static void refuse(const char *bytes, size_t size, const char *sentence) {
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  assert_int_equal(test_parse(&ctx, "drc", bytes, size, &mesh), FS_ERR_FORMAT);
  assert_null(mesh);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" instead of \"%s\"", ctx.message, sentence);
}

static void test_no_draco_files(void **state) {
  (void)state;
  refuse("", 0, "empty");
  refuse("DRACO", 5, "does not start with a Draco head");
  refuse("o net\nv 0 0 0\nv 1 0 0\n", 22, "does not start with a Draco head");
  refuse("DRACO\1\1\1\1\0\0abcdef", 17, "bitstream version 1.1");
  refuse("DRACO\2\2\0\1\0\0abcdef", 17, "points, no mesh");
  refuse("DRACO\2\2\1\7\0\0abcdef", 17, "unknown method 7");
  refuse("DRACO\2\2\1\1\0\200\1\377\377", 14, "cut or damaged");
  refuse("DRACO\2\2\1\1\0\0\0\377\377\377\377\17\377\377\377\377\17", 22, "claims 4294967295 vertices");
  refuse("DRACO\2\2\1\0\0\0\377\377\377\7\377\377\377\7", 19, "triangles");
  refuse("DRACO\2\2\1\1\0\0\0\4\4\0\0\0", 17, "cannot read this");
}

/* Bytes of a file changed, cut or added at random: a status, a sentence, nothing leaks, little memory. */
static void test_changed_files(void **state) {
  fs_mesh *mesh = test_star(5, 3);
  fs_context plain = test_context();
  uint8_t *fixed = calloc((size_t)mesh->n_vertices, 1);
  fs_model model = {.name = "net", .control = mesh, .fixed = fixed, .made_with = "test", .functional = "least"};
  memory_output file = draco_export(&plain, &model, "drc", NULL, 0);
  uint64_t random = 99;
  int32_t n_read = 0;
  (void)state;
  for (int32_t round = 0; round < 20000; round++) {
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    size_t size = file.size;
    char *bytes = malloc(size);
    fs_mesh *back = NULL;
    fs_mesh_notes notes = {0};
    memcpy(bytes, file.bytes, size);
    if (round % 4 == 0) size = (size_t)test_random_integer(&random, 0, (int32_t)size);
    for (int32_t k = test_random_integer(&random, 0, 4); k > 0 && size > 0; k--)
      bytes[test_random_integer(&random, 0, (int32_t)size - 1)] =
          (char)(k % 2 == 0 ? test_random_integer(&random, 0, 255) : 1 << test_random_integer(&random, 0, 7));
    fs_status status = fs_mesh_parse_notes(&ctx, "drc", bytes, size, &back, &notes);
    if (status == FS_OK) {
      n_read++;
      assert_int_equal(fs_mesh_validate(&ctx, back), FS_OK);
      fs_mesh_notes_clear(&ctx, &notes);
      fs_mesh_free(&ctx, back);
    } else {
      assert_true(status == FS_ERR_FORMAT || status == FS_ERR_TOPOLOGY || status == FS_ERR_MEMORY);
      assert_true(ctx.message[0] != '\0');
      assert_null(back);
      assert_null(notes.fixed);
    }
    assert_int_equal(memory.n_live, 0);
    free(bytes);
  }
  print_message("%d of 20000 changed files were read\n", n_read);
  free(file.bytes);
  free(fixed);
  fs_mesh_free(&plain, mesh);
}

static void test_every_allocation_fails_once(void **state) {
  fs_mesh *mesh = test_prism(6);
  fs_context plain = test_context();
  uint8_t *fixed = calloc((size_t)mesh->n_vertices, 1);
  fs_model model = {.name = "net", .control = mesh, .fixed = fixed, .made_with = "test", .functional = "least"};
  memory_output file = draco_export(&plain, &model, "drc", NULL, 0);
  fs_status status = FS_ERR_MEMORY;
  (void)state;
  for (int64_t n = 1; status == FS_ERR_MEMORY; n++) {
    struct test_memory memory = {.fail_at = n};
    fs_context ctx = test_memory_context(&memory);
    fs_mesh *back = NULL;
    fs_mesh_notes notes = {.n_refinements = -5};
    status = fs_mesh_parse_notes(&ctx, "drc", file.bytes, file.size, &back, &notes);
    if (status == FS_OK) {
      assert_true(n > 10);
      fs_mesh_notes_clear(&ctx, &notes);
      fs_mesh_free(&ctx, back);
    } else {
      assert_int_equal(status, FS_ERR_MEMORY);
      assert_null(back);
      assert_int_equal(notes.n_refinements, -5);
    }
    assert_int_equal(memory.n_live, 0);
  }
  status = FS_ERR_MEMORY;
  for (int64_t n = 1; status == FS_ERR_MEMORY; n++) {
    struct test_memory memory = {.fail_at = n};
    fs_context ctx = test_memory_context(&memory);
    memory_output other = {0};
    fs_output output = memory_output_of(&other);
    status = fs_export(&ctx, &model, fs_exporter_find("drc"), NULL, &output);
    assert_int_equal(other.n_opened, status == FS_OK ? 1 : 0);
    assert_int_equal(memory.n_live, 0);
    free(other.bytes);
  }
  assert_int_equal(status, FS_OK);
  free(file.bytes);
  free(fixed);
  fs_mesh_free(&plain, mesh);
}

static void test_numbers_too_large(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_cube();
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  fs_model model = {.name = "net", .control = mesh};
  (void)state;
  mesh->position[3].y = 1e39;
  assert_int_equal(fs_export(&ctx, &model, fs_exporter_find("drc"), NULL, &output), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "vertex 3"));
  assert_int_equal(file.n_opened, 0);
  fs_mesh_free(&ctx, mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_nets_read_back),
      cmocka_unit_test(test_diagonals_that_are_taken),
      cmocka_unit_test(test_a_face_that_cannot_be_split),
      cmocka_unit_test(test_parts_and_nothing_said),
      cmocka_unit_test(test_no_draco_files),
      cmocka_unit_test(test_changed_files),
      cmocka_unit_test(test_every_allocation_fails_once),
      cmocka_unit_test(test_numbers_too_large),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
