/* SPDX-License-Identifier: MIT */
/* Single role: what the readers make of good files: values to the last bit, bounded memory, failing allocations. */
#include "support.h"
#include "binary_ply.h"

#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static fs_mesh *parsed(const char *extension, const char *bytes, size_t size) {
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  if (test_parse(&ctx, extension, bytes, size, &mesh) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(fs_mesh_validate(&ctx, mesh), FS_OK);
  return mesh;
}

static fs_mesh *parsed_text(const char *extension, const char *text) { return parsed(extension, text, strlen(text)); }

static void assert_mesh(fs_mesh *mesh, int32_t n_vertices, const double *x, int32_t n_faces, const int32_t *face_start,
                        const int32_t *corner) {
  fs_context ctx = test_context();
  assert_int_equal(mesh->n_vertices, n_vertices);
  assert_int_equal(mesh->n_faces, n_faces);
  assert_memory_equal(mesh->position, x, 3 * (size_t)n_vertices * sizeof *x);
  assert_memory_equal(mesh->face_start, face_start, ((size_t)n_faces + 1) * sizeof *face_start);
  assert_memory_equal(mesh->origin, corner, (size_t)face_start[n_faces] * sizeof *corner);
  fs_mesh_free(&ctx, mesh);
}

/* A pentagon and a triangle that share an edge: what most texts below say. */
static const double house_x[] = {0, 0, 0, 2, 0, 0.5, 2, -2.25, 0, 1, 3e-3, 0, 0, 2, 0, 3, 1, 1e5};
static const int32_t house_start[] = {0, 5, 8}, house_corner[] = {0, 1, 2, 3, 4, 2, 1, 5};

static void assert_house(fs_mesh *mesh) { assert_mesh(mesh, 6, house_x, 2, house_start, house_corner); }

static void test_obj(void **state) {
  (void)state;
  assert_house(parsed_text("obj", "v 0 0 0\nv 2 0 .5\nv 2 -2.25 0\nv 1 3e-3 0\nv 0 2 0\nv 3 1 1e5\n"
                                  "f 1 2 3 4 5\nf 3 2 6\n"));
  /* comments, joined lines, CR LF, tabs, weights, colours, ignored statements, all forms of corners, no last line end */
  /* CR alone */
  assert_house(parsed_text("obj", "v 0 0 0\rv 2 0 .5\rv 2 -2.25 0\rv 1 3e-3 0\rv 0 2 0\rv 3 1 1e5\r"
                                  "f 1 2 3 4 5\rf 3 2 6\r"));
  /* comments, joined lines, CR LF, tabs, weights, colours, ignored statements, all forms of corners, no last line end */
  assert_house(parsed_text("OBJ",
                           "\xEF\xBB\xBF# a house \\\r\nmtllib a.mtl\r\no house\r\n\tv\t0 0 \\\r\n 0e0 # first\r\n"
                           "v 2 +0 0.5 1.0\r\nv 2 -2.25 0 1 0.5 0.25\r\nv 1 3e-3 0\r\ng roof\r\ns off\r\n"
                           "usemtl red\r\nvt 0 1\r\nvn 0 0 1\r\nvp 1\r\np 1\r\nl 1 2\r\n"
                           "f 1/1 2/1 -2/1 4 5\r\nv 0 2 0\r\nv 3 1 1E+5\r\n\r\n"
                           "f -4//1 \\\r\n2/1/1 -1/-1/-1"));
}

static void test_off(void **state) {
  (void)state;
  assert_house(
      parsed_text("off", "OFF\n6 2 0\n0 0 0\n2 0 .5\n2 -2.25 0\n1 3e-3 0\n0 2 0\n3 1 1e5\n5 0 1 2 3 4\n3 2 1 5\n"));
  assert_house(parsed_text("off", "# made by hand\r\nCOFF 6 2 7 # counts\r\n\r\n0 0 0 255 0 0 1\r\n2 0 .5 0 0 0 0\r\n"
                                  "2 -2.25 0\r\n# between\r\n1 3e-3 0\r\n0 2 0\r\n3 1 100000\r\n5 0 1 2 3 4 1 0 0\r\n"
                                  "3 2 1 5 0.5 # blue\r\n"));
  assert_house(
      parsed_text("off", "STCNOFF\n6 2\n0 0 0\n2 0 .5\n2 -2.25 0\n1 3e-3 0\n0 2 0\n3 1 1e5\n5 0 1 2 3 4\n3 2 1 5"));
}

#define PLY_HOUSE "0 0 0\n2 0 .5\n2 -2.25 0\n1 3e-3 0\n0 2 0\n3 1 1e5\n5 0 1 2 3 4\n3 2 1 5\n"

static void test_ply_ascii(void **state) {
  (void)state;
  assert_house(parsed_text("ply", "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                                  "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
                                  "end_header\n" PLY_HOUSE));
  /* faces first, other elements and properties before, between and behind */
  assert_house(parsed_text("ply", "ply\r\nformat ascii 1.0\r\ncomment odd\r\nelement none 4000\r\nelement cut 2\r\n"
                                  "property list int double a\r\nproperty short b\r\nelement face 2\r\nobj_info x\r\n"
                                  "property uchar red\r\nproperty list uint8 uint32 vertex_index\r\n"
                                  "property list uchar float w\r\nelement vertex 6\r\nproperty double z\r\n"
                                  "property float64 nx\r\nproperty int16 y\r\nproperty double x\r\nelement end 1\r\n"
                                  "property int last\r\nend_header\r\n0 7\r\n3 1 nan 3 8\r\n255 5 0 1 2 3 4 1 0.5\r\n"
                                  "0 3 2 1 5 0\r\n0 nan 0 0\r\n.5 9 0 2\r\n0 9 -2.25 2\r\n0 9 3e-3 1\r\n0 9 2 0\r\n"
                                  "1e5 9 1 3\r\n12"));
}

static void test_ply_binary(void **state) {
  struct bytes b = binary_ply();
  double x[15];
  (void)state;
  for (int v = 0; v < 5; v++) {
    x[3 * v] = (float)(0.1 * v);
    x[3 * v + 1] = v == 0 ? 0.0 : -300 * v;
    x[3 * v + 2] = v / 7.0;
  }
  assert_mesh(parsed("ply", b.at, b.size), 5, x, 2, (int32_t[]){0, 3, 7}, (int32_t[]){0, 1, 2, 2, 1, 3, 4});
}

/* The first coordinate of a triangle, read from the text of it. */
static double read_number(const char *number) {
  char text[1400];
  fs_context ctx = test_context();
  fs_mesh *mesh;
  double x;
  snprintf(text, sizeof text, "v %s 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", number);
  mesh = parsed_text("obj", text);
  x = mesh->position[0].x;
  fs_mesh_free(&ctx, mesh);
  return x;
}

static void assert_same_bits(double a, double b) { assert_memory_equal(&a, &b, sizeof a); }

static void test_numbers(void **state) {
  char many[1200] = "0.";
  (void)state;
  assert_same_bits(read_number("-0"), -0.0);
  assert_same_bits(read_number("+1."), 1);
  assert_same_bits(read_number("-.5E+1"), -5);
  assert_same_bits(read_number("9007199254740993"), 9007199254740992.0); /* halfway: to even */
  assert_same_bits(read_number("9007199254740993.00000000000000000001"), 0x1.0000000000001p53 + 0.0);
  assert_same_bits(read_number("0.1e23"), 1e22);
  assert_same_bits(read_number("1e23"), 0x1.52d02c7e14af6p76); /* the neighbour above is as near in decimals */
  assert_same_bits(read_number("123456789012345678901234567890"), 0x1.8ee90ff6c373ep96);
  assert_same_bits(read_number("1.7976931348623157e308"), 0x1.fffffffffffffp1023);
  assert_same_bits(read_number("4.9406564584124654e-324"), 0x1p-1074);
  assert_same_bits(read_number("2.2250738585072011e-308"), 0x0.fffffffffffffp-1022);
  assert_same_bits(read_number("1e-400"), 0);
  assert_same_bits(read_number("0e999999999999999999999"), 0);
  memset(many + 2, '3', 997);
  assert_same_bits(read_number(many), 1.0 / 3);
}

/* Around the exponents and mantissas where one exact operation no longer does, against strtod in the C locale. */
static void test_short_numbers(void **state) {
  uint64_t random = 2;
  (void)state;
  for (int i = 0; i < 20000; i++) {
    char number[64];
    long long mantissa = (long long)(test_random(&random) >> test_random_integer(&random, 8, 40));
    snprintf(number, sizeof number, "%llde%d", mantissa, test_random_integer(&random, -26, 26));
    assert_same_bits(read_number(number), strtod(number, NULL));
  }
}

/* 17 digits give the same double back, in any locale that the machine has. */
static void test_round_trip(void **state) {
  static const char *const locales[] = {"C", "de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8"};
  uint64_t random = 1;
  (void)state;
  for (size_t l = 0; l < sizeof locales / sizeof *locales; l++) {
    if (setlocale(LC_ALL, locales[l]) == NULL) continue;
    for (int i = 0; i < 5000; i++) {
      char number[64], *comma;
      uint64_t bits = test_random(&random);
      double x;
      memcpy(&x, &bits, sizeof x);
      if (i % 2 == 0) x = test_random_real(&random, -10, 10);
      if (!isfinite(x)) continue;
      snprintf(number, sizeof number, i % 3 == 0 ? "%.15g" : "%.17g", x);
      if (i % 3 == 0) x = strtod(number, NULL);
      comma = strchr(number, ',');
      if (comma != NULL) *comma = '.';
      assert_same_bits(read_number(number), x);
    }
  }
  setlocale(LC_ALL, "C");
}

/* The worst that a good file may cost, per byte: short indices of many small faces. */
static void test_memory_bound(void **state) {
  enum { N = 100 };
  char *text = calloc(N * N, 48);
  size_t size = 0;
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_mesh *mesh = NULL;
  (void)state;
  assert_non_null(text);
  for (int v = 0; v < N * N; v++) size += (size_t)sprintf(text + size, "v 0 0 0\n");
  for (int i = 0; i + 1 < N; i++)
    for (int j = 0; j + 1 < N; j++)
      size += (size_t)sprintf(text + size, "f -%d -%d -%d -%d\n", N * i + j + 1, N * i + j + 2, N * i + j + 2 + N,
                              N * i + j + 1 + N);
  assert_int_equal(test_parse(&ctx, "obj", text, size, &mesh), FS_OK);
  assert_true(memory.peak_bytes <= 16 * size);
  fs_mesh_free(&ctx, mesh);
  assert_int_equal(memory.n_live, 0);
  free(text);
}

static void test_notes(void **state) {
  static const char *const text[] = {TRIANGLE "f 1 2 3\nt crease 2/1/0 0 1 4.0\nt crease 2/1/0 1 2 4.0\n",
                                     TRIANGLE "t corner 1/1/0 0 2\nf 1 2 3\nt crease 2/1/0 0 1 4.0",
                                     TRIANGLE "f 1 2 3\nt interpolateboundary 1/0/0 1\nt\n", TRIANGLE "f 1 2 3\n"};
  static const char *const note[] = {"2 crease tags were ignored", "1 crease tags and 1 other tags were ignored",
                                     "2 tags were ignored", ""};
  (void)state;
  for (int i = 0; i < 4; i++) {
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    fs_mesh *mesh = NULL;
    assert_int_equal(test_parse(&ctx, "obj", text[i], strlen(text[i]), &mesh), FS_OK);
    assert_string_equal(memory.note, note[i]);
    assert_int_equal(memory.n_notes, i < 3);
    fs_mesh_free(&ctx, mesh);
  }
}

static void assert_survives(const char *extension, const char *bytes, size_t size) {
  fs_status status = FS_ERR_MEMORY;
  int64_t n = 0;
  while (status != FS_OK) {
    struct test_memory memory = {.fail_at = ++n};
    fs_context ctx = test_memory_context(&memory);
    fs_mesh marker, *mesh = &marker;
    status = test_parse(&ctx, extension, bytes, size, &mesh);
    if (status == FS_OK) {
      fs_mesh_free(&ctx, mesh);
    } else {
      assert_int_equal(status, FS_ERR_MEMORY);
      assert_ptr_equal(mesh, &marker);
    }
    assert_int_equal(memory.n_live, 0);
  }
  assert_true(n > 15);
}

static void test_failing_allocations(void **state) {
  static const char obj[] = TRIANGLE "f 1 2 3\n", off[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  static const char ply[] =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  struct bytes b = binary_ply();
  (void)state;
  assert_survives("obj", obj, strlen(obj));
  assert_survives("off", off, strlen(off));
  assert_survives("ply", ply, strlen(ply));
  assert_survives("ply", b.at, b.size);
}

static void test_table(void **state) {
  (void)state;
  for (const fs_reader *const *r = fs_readers; *r != NULL; r++) {
    assert_true(strlen((*r)->name) > 0 && strlen((*r)->extension) > 0 && strlen((*r)->summary) > 0);
    for (const fs_reader *const *other = fs_readers; other != r; other++)
      assert_string_not_equal((*other)->extension, (*r)->extension);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_obj),        cmocka_unit_test(test_off),
      cmocka_unit_test(test_ply_ascii),  cmocka_unit_test(test_ply_binary),
      cmocka_unit_test(test_numbers),    cmocka_unit_test(test_short_numbers),
      cmocka_unit_test(test_round_trip), cmocka_unit_test(test_memory_bound),
      cmocka_unit_test(test_notes),      cmocka_unit_test(test_failing_allocations),
      cmocka_unit_test(test_table),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
