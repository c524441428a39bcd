/* SPDX-License-Identifier: MIT */
/* Single role: what the readers refuse, and in which words: every sentence once, in little memory, without a leak. */
#include "support.h"
#include "binary_ply.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <cmocka.h>

struct refusal {
  const char *extension, *text, *message;
  fs_status status; /* 0: FS_ERR_FORMAT */
};

#ifdef FS_HAVE_DRACO
#define DRC " .drc"
#else
#define DRC ""
#endif

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define PLY_START "ply\nformat ascii 1.0\n"
#define PLY_XYZ "property float x\nproperty float y\nproperty float z\n"
#define PLY_LIST "property list uchar int vertex_indices\nend_header\n"
#define PLY_CAP_INTS "property int vertex\nproperty int spoke\nproperty int valence\nproperty int basis\n"
#define PLY_CAPS                                                                                          \
  PLY_START "element vertex 3\n" PLY_XYZ "element face 1\nproperty list uchar int vertex_indices\n"       \
            "element fairsurf_cap 2\n" PLY_CAP_INTS "property list int double coefficients\nend_header\n" \
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
#define PLY_3_1 PLY_START "element vertex 3\n" PLY_XYZ "element face 1\n" PLY_LIST

static const struct refusal refusals[] = {
    {"obj", "", "the file is empty", 0},
    {"off", "", "the file is empty", 0},
    {"ply", "", "the file is empty", 0},
    {"stl", "solid", "no reader for '.stl'; there are readers for .obj .off .ply .xyz" DRC, FS_ERR_UNSUPPORTED},
    {"", "", "no reader for '.'; there are readers for .obj .off .ply .xyz" DRC, FS_ERR_UNSUPPORTED},

    {"obj", "\n", "the file has no vertices (lines that start with v)", 0},
    {"obj", "v 0 0 0\n", "the file has no faces (lines that start with f)", 0},
    {"obj", "f 1 2 3\n", "the file has no vertices (lines that start with v)", 0},
    {"obj", TRIANGLE "# \\\nv 1 2\nf 1 2 3", "line 5: the vertex has 2 coordinates instead of 3", 0},
    {"obj", "v 0 0 1x\nf 1 2 3", "line 1: '1x' is not a number", 0},
    {"obj", "v 0 0 0x10\nf 1 2 3", "line 1: '0x10' is not a number", 0},
    {"obj", "v 0 0 -nan\nf 1 2 3", "line 1: '-nan' is not a finite number", 0},
    {"obj", "v 0 0 Infinity\nf 1 2 3", "line 1: 'Infinity' is not a finite number", 0},
    {"obj", "v 0 1e999 0\nf 1 2 3", "line 1: '1e999' is too large for a number", 0},
    {"obj", "v 0 -1e99999999999999999999 0\nf 1 2 3", "line 1: '-1e9999999999999999999...' is too large for a number",
     0},
    {"obj", "v 0 . 0\nf 1 2 3", "line 1: '.' is not a number", 0},
    {"obj", "v 0 1e 0\nf 1 2 3", "line 1: '1e' is not a number", 0},
    {"obj", "v 0 1e+ 0\nf 1 2 3", "line 1: '1e+' is not a number", 0},
    {"obj", "v 0 1.2.3 0\nf 1 2 3", "line 1: '1.2.3' is not a number", 0},
    {"obj", "v 0 0 0 red\nf 1 2 3", "line 1: 'red' is not a number", 0},
    {"obj", TRIANGLE "\\\n\nf 1 2\n", "line 6: the face has 2 vertices, but a face needs 3 or more", 0},
    {"obj", TRIANGLE "f\n", "line 4: the face has 0 vertices, but a face needs 3 or more", 0},
    {"obj", TRIANGLE "f 0 1 2\n", "line 4: the face uses vertex 0, but vertices count from 1", 0},
    {"obj", TRIANGLE "f 1 2 4\n", "line 4: the face uses vertex 4, but there are only 3", 0},
    {"obj", "v 0 0 0\nf 1 -2 3\nv 1 0 0\nv 0 1 0", "line 2: the face uses vertex -2, but there are only 1 before it",
     0},
    {"obj", TRIANGLE "f 1 2 2147483648\n", "line 4: the integer '2147483648' needs more than 32 bits", 0},
    {"obj", TRIANGLE "f 1 2 -99999999999999999999999999\n",
     "line 4: the integer '-999999999999999999999...' needs more than 32 bits", 0},
    {"obj", TRIANGLE "f 1 2 3.5\n", "line 4: '3.5' is not an integer", 0},
    {"obj", TRIANGLE "f 1 2 /3\n", "line 4: '' is not an integer", 0},
    {"obj", TRIANGLE "f 1 2 -\n", "line 4: '-' is not an integer", 0},
    {"obj", TRIANGLE "f 1 2 3/a\n", "line 4: '3/a' is not a corner of a face", 0},
    {"obj", TRIANGLE "f 1 2 3/1/1/1\n", "line 4: '3/1/1/1' is not a corner of a face", 0},
    {"obj", TRIANGLE "f 1 2 3\nsurf 0 1 0 1\n", "line 5: 'surf' is no statement of a polygon file", 0},
    {"obj", TRIANGLE "f 1 2 3\n\xff\x01\n", "line 5: '\?\?' is no statement of a polygon file", 0},
    {"obj", TRIANGLE "v 2 2 2\nf 1 2 3\n", "vertex 3 belongs to no face", FS_ERR_TOPOLOGY},
    {"obj", TRIANGLE "f 1 2 3\nf 1 2 3\n",
     "faces 0 and 1 run along the edge between vertices 0 and 1 in the same direction: their orientations disagree",
     FS_ERR_TOPOLOGY},

    {"off", "\n#\n", "line 3: the file has no keyword OFF", 0},
    {"off", "4OFF\n3 1 0\n", "line 1: '4OFF' stands where OFF, COFF, NOFF or STOFF is needed", 0},
    {"off", "OFF BINARY\n", "line 1: binary OFF files are not read", 0},
    {"off", "OFF\n", "line 2: the file ends where the number of vertices is needed", 0},
    {"off", "OFF\n3", "line 2: the file ends where the number of faces is needed", 0},
    {"off", "OFF\n3 x", "line 2: 'x' is not an integer", 0},
    {"off", "OFF\n3 0 0\n0 0 0\n", "line 2: 3 vertices and 0 faces are not a mesh", 0},
    {"off", "OFF\n-3 1 0\n0 0 0\n", "line 2: -3 vertices and 1 faces are not a mesh", 0},
    {"off", "OFF\n3 4000000000 0\n", "line 2: the integer '4000000000' needs more than 32 bits", 0},
    {"off", "OFF\n3 2000000000 0\n0 0 0\n",
     "line 3: 3 vertices and 2000000000 faces do not fit into the 6 bytes that follow", 0},
    {"off", "OFF\n1 1 0\n0 0        0 #x\n#\n", "line 5: the file ends where a face is needed", 0},
    {"off", "OFF\n2 1 0\n0 0 0\n0          0 #\n", "line 5: the file ends within vertex 1", 0},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "line 4: 'nan' is not a finite number", 0},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1   \n", "line 6: face 0 has 2 vertices, but a face needs 3 or more",
     0},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9 0 1 2\n", "line 6: face 0 has 9 vertices, but only 7 bytes follow", 0},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: face 0 uses vertex 3, but there are only 3", 0},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6: face 0 uses vertex -1, but there are only 3", 0},
    {"off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1    \n", "line 7: the file ends where a vertex of a face is needed",
     0},

    {"ply", "plx\n", "line 1: the file does not start with ply", 0},
    {"ply", "ply\ncomment", "line 2: the header has no line format", 0},
    {"ply", "ply\nelement vertex 3\n", "line 2: 'element' stands where format is needed", 0},
    {"ply", "ply\nformat binary_big_endian 1.0\n",
     "line 2: the format is 'binary_big_endian', but only ascii and binary_little_endian are read", 0},
    {"ply", "ply\nformat ascii 2\n", "line 2: the version of the format is '2' instead of 1.0", 0},
    {"ply", PLY_START "element vertex 3\n", "line 4: the header has no end (end_header)", 0},
    {"ply", PLY_START "element vertex\nend_header\n", "line 3: '' is not an integer", 0},
    {"ply", PLY_START "element vertex -1\nend_header\n", "line 3: there are -1 of 'vertex'", 0},
    {"ply", PLY_START "element face 4000000000\nend_header\n",
     "line 3: the integer '4000000000' needs more than 32 bits", 0},
    {"ply", PLY_START "element vertex 3\nelement vertex 3\nend_header\n", "line 4: the element 'vertex' is there twice",
     0},
    {"ply", PLY_START "property int x\nend_header\n", "line 3: a property stands before the first element", 0},
    {"ply", PLY_START "element vertex 3\nproperty real x\nend_header\n", "line 4: 'real' is no type of a property", 0},
    {"ply", PLY_START "element vertex 3\nproperty list x\nend_header\n", "line 4: 'x' is no type of a property", 0},
    {"ply", PLY_START "element vertex 3\nproperty list int\nend_header\n", "line 4: '' is no type of a property", 0},
    {"ply", PLY_START "element vertex 3\nproperty int\nend_header\n", "line 4: a property has no name", 0},
    {"ply", PLY_START "element vertex 3\nproperty int x\nproperty int x\nend_header\n",
     "line 5: the property 'x' is there twice", 0},
    {"ply", PLY_START "elements vertex 3\nend_header\n", "line 3: 'elements' is no line of a header", 0},
    {"ply", PLY_START "element vertex 3\nproperty int x\nproperty int y\nend_header\n",
     "the file has no element vertex with x, y and z", 0},
    {"ply", PLY_START "element vertex 3\n" PLY_XYZ "end_header\n",
     "the file has no element face with a list vertex_indices", 0},
    {"ply", PLY_START "element vertex 3\n" PLY_XYZ "element face 0\n" PLY_LIST, "3 vertices and 0 faces are not a mesh",
     0},
    {"ply", PLY_START "element vertex 2000000000\n" PLY_XYZ "element face 1\n" PLY_LIST "0 0 0\n",
     "line 10: 2000000000 elements of 6 bytes or more do not fit into the 6 that follow", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0\n0 1 0\n", "line 13: the file ends too early", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0       \n", "line 12: the file ends too early", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n", "line 11: the line has more values than the header says", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 inf\n0 1 0\n3 0 1 2\n", "line 11: 'inf' is not a finite number", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "line 13: face 0 has 2 vertices, but a face needs 3 or more", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0\n0 1 0\n9 0 1 2\n",
     "line 13: a list of 9 values does not fit into the 7 bytes that follow", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0\n0 1 0\n-1 0 1 2\n",
     "line 13: a list of -1 values does not fit into the 7 bytes that follow", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0\n0 1 0\n3.5 0 1 2\n",
     "line 13: a list of 3.5 values does not fit into the 7 bytes that follow", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 13: face 0 uses vertex 3, but there are only 3", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 13: face 0 uses vertex -1, but there are only 3", 0},
    {"ply", PLY_3_1 "0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n", "face 0 repeats vertex 1", FS_ERR_TOPOLOGY},
    {"ply", PLY_START "element vertex 3\n" PLY_XYZ "element fairsurf_cap 1\n" PLY_CAP_INTS "element face 1\n" PLY_LIST,
     "the element fairsurf_cap needs vertex, spoke, valence, basis and a list coefficients", 0},
    {"ply", PLY_CAPS "0 1 3 1 3 0 0 0\n0 1 3 2 3 0 0 0\n",
     "line 21: cap 1 belongs to version 2 of the functions, those before to 1", 0},
    {"ply", PLY_CAPS "0 1 3 1 4 0 0 0 0\n0 1 3 1 0\n",
     "line 20: cap 0 has 4 numbers, but its coefficients take three each", 0},
    {"ply", PLY_CAPS "0 1 3 1 3 0 nan 0\n0 1 3 1 0\n", "line 20: 'nan' is not a finite number", 0},
    {"ply", PLY_CAPS "0 1.5 3 1 3 0 1 0\n0 1 3 1 0\n", "line 20: 1.5 of cap 0 is no whole number of 32 bits", 0},
    {"ply", PLY_CAPS "0 1 3e10 1 3 0 1 0\n0 1 3 1 0\n", "line 20: 3e+10 of cap 0 is no whole number of 32 bits", 0},
    {"ply", PLY_CAPS "0 1 3 1 300 0 0 0\n0 1 3 1 0\n",
     "line 20: a list of 300 values does not fit into the 17 bytes that follow", 0},
    {"ply", PLY_CAPS "0 1 3 1 6 0 0 0 0 0 0\n", "line 21: the file ends too early", 0},
};

static void assert_refused(const char *extension, const char *bytes, size_t size, fs_status status,
                           const char *message) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_mesh marker, *mesh = &marker;
  fs_status got = test_parse(&ctx, extension, bytes, size, &mesh);
  assert_string_equal(ctx.message, message);
  assert_int_equal(got, status);
  assert_ptr_equal(mesh, &marker);
  assert_int_equal(memory.n_live, 0);
  assert_int_equal(memory.n_notes, 0);
  assert_true(memory.peak_bytes <= 32 * size + 4096);
}

static void test_refusals(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof refusals / sizeof *refusals; i++) {
    const struct refusal *r = &refusals[i];
    assert_refused(r->extension, r->text, strlen(r->text), r->status == FS_OK ? FS_ERR_FORMAT : r->status, r->message);
  }
}

/* Messages of binary files name the byte. */
static void test_binary_refusals(void **state) {
  struct bytes good = binary_ply(), b = good;
  size_t second_face = good.size - 22; /* where it starts: 2 bytes of length, 4 indices and a number of 4 bytes */
  char message[128];
  (void)state;
  b.at[second_face + 2] = 5;
  snprintf(message, sizeof message, "byte %zu: face 1 uses vertex 5, but there are only 5", second_face + 6);
  assert_refused("ply", b.at, b.size, FS_ERR_FORMAT, message);
  b = good;
  b.at[second_face + 5] = (char)0x80;
  snprintf(message, sizeof message, "byte %zu: face 1 uses vertex -2147483646, but there are only 5", second_face + 6);
  assert_refused("ply", b.at, b.size, FS_ERR_FORMAT, message);
  b = good;
  b.at[second_face] = 6;
  snprintf(message, sizeof message, "byte %zu: a list of 6 values does not fit into the 20 bytes that follow",
           second_face + 2);
  assert_refused("ply", b.at, b.size, FS_ERR_FORMAT, message);
}

/* Counts beyond the file and a coordinate of nan, in binary. */
static void test_binary_sizes(void **state) {
  static const char vertices[] = "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\n"
                                 "property float y\nproperty float z\nelement face 1\n" PLY_LIST "0123456789ab";
  static const char nan[] = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
                            "property float y\nproperty float z\nelement face 1\n" PLY_LIST "0123"
                            "\xff\xff\xff\xff"
                            "89ab";
  (void)state;
  assert_refused("ply", vertices, sizeof vertices - 1, FS_ERR_FORMAT,
                 "byte 178: 2000000000 elements of 12 bytes or more do not fit into the 12 that follow");
  assert_refused("ply", nan, sizeof nan - 1, FS_ERR_FORMAT, "byte 177: vertex 0 has a coordinate that is not finite");
}

/* Every file that ends too early is refused. */
static void test_truncated(void **state) {
  static const char off[] = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3";
  struct bytes b = binary_ply();
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  (void)state;
  for (size_t size = 0; size < b.size; size++)
    assert_int_equal(test_parse(&ctx, "ply", b.at, size, &mesh), FS_ERR_FORMAT);
  for (size_t size = 0; size < strlen(off); size++)
    assert_int_equal(test_parse(&ctx, "off", off, size, &mesh), FS_ERR_FORMAT);
  assert_null(mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_binary_refusals),
      cmocka_unit_test(test_binary_sizes),
      cmocka_unit_test(test_truncated),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
