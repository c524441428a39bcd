/* SPDX-License-Identifier: MIT */
/* Files of patches: BezierView and splines read, refused with a sentence that names the line, and written so that they read
   back to the last bit; sides that are found to meet. */
#include <fairsurf/export.h>
#include <fairsurf/surface_splines.h>
#include "math/vec3.h"
#include "memory_output.h"
#include "patch_samples.h"
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>

static fs_surface *read_text(const char *extension, const char *text) {
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  if (fs_surface_parse(&ctx, extension, text, strlen(text), &s) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(fs_surface_validate(&ctx, s), FS_OK);
  return s;
}

static void release(fs_surface *s) {
  fs_context ctx = test_context();
  fs_surface_free(&ctx, s);
}

static void near(fs_vec3 a, fs_vec3 b) { assert_true(fs_vec3_distance(a, b) <= 1e-14); }

static fs_vec3 at(const fs_surface *s, int32_t p, double u, double v) {
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(s, p, u, v, x);
  return x[FS_D];
}

/* ---- BezierView ---- */

/* The examples of the format's page: row-major points, so that v runs first; u x v shows the outside. */
static const char kinds[] = "Group 1 deg2x3 #4\n"
                            "5\n2 3\n"
                            "-1.5 1 0  -0.5 1 0   0.5 1 0   1.5 1 0\n"
                            "-1.5 0 0  -0.5 0 0.5 0.5 0 0.5 1.5 0 0\n"
                            "-1.5 -1 0 -0.5 -1 0  0.5 -1 0  1.5 -1 0\n"
                            "group 2 more\n"
                            "4\n1\n10 0 0\n10 1 0\n11 0 0\n11 1 0\n"
                            "3\n1\n20 0 0  21 0 0  20 1 0\n"
                            "8\n1 1\n60 0 0 2\n60 2 0 2\n62 0 0 2\n62 2 0 2\n"
                            "1\n5 2\n40 0 0\n41 0 0\n41 1 0\n40 1 0\n42 0.5 0\n"
                            "4 0 1 2 3\n3 1 4 2\n";

static void test_bezierview(void **state) {
  fs_surface *s = read_text("BV", kinds);
  fs_vec3 x[FS_JET_SIZE];
  (void)state;
  assert_int_equal(s->n_patches, 6);
  assert_int_equal(s->patch[0].degree_u, 2);
  assert_int_equal(s->patch[0].degree_v, 3);
  near(at(s, 0, 0, 0), (fs_vec3){-1.5, 1, 0});
  near(at(s, 0, 0, 1), (fs_vec3){1.5, 1, 0});
  near(at(s, 0, 1, 0), (fs_vec3){-1.5, -1, 0});
  fs_surface_evaluate(s, 0, 0.5, 0.5, x);
  assert_true(fs_vec3_cross(x[FS_DU], x[FS_DV]).z > 0 && x[FS_D].z > 0.1);
  near(at(s, 1, 0.5, 1), (fs_vec3){10.5, 1, 0});
  assert_int_equal(s->patch[2].n_sides, 3);
  near(at(s, 2, 1, 0), (fs_vec3){21, 0, 0});
  near(at(s, 2, 0, 1), (fs_vec3){20, 1, 0});
  near(at(s, 3, 0, 1), (fs_vec3){30, 1, 0}); /* homogeneous: divided by the weight */
  near(at(s, 4, 1, 1), (fs_vec3){41, 1, 0});
  assert_int_equal(s->patch[4].neighbour[1], 5); /* the quadrilateral and the triangle of the polyhedron meet */
  assert_int_equal(s->patch[5].neighbour[s->patch[4].neighbour_side[1]], 4);
  assert_int_equal(s->patch[0].neighbour[0], FS_NONE);
  release(s);
}

static void refuse(const char *extension, const char *text, fs_status expected, const char *sentence) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_surface marker, *s = &marker;
  assert_int_equal(fs_surface_parse(&ctx, extension, text, strlen(text), &s), expected);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" lacks \"%s\"", ctx.message, sentence);
  assert_ptr_equal(s, &marker);
  assert_int_equal(memory.n_live, 0);
}

static void test_bad_bezierview(void **state) {
  (void)state;
  refuse("bv", "", FS_ERR_FORMAT, "the file is empty");
  refuse("bv", "Group 1 nothing\n", FS_ERR_FORMAT, "the file has no patch");
  refuse("bv", "7\n", FS_ERR_FORMAT, "line 1: patch 0 is of kind 7; 1, 3, 4, 5 and 8 can be read");
  refuse("bv", "9\n3 2\n", FS_ERR_FORMAT, "kind 9");
  refuse("bv", "4\n32\n", FS_ERR_FORMAT, "line 2: patch 0 has degree 32");
  refuse("bv", "5\n3 0\n", FS_ERR_FORMAT, "has degree 0, which is not between 1 and 31");
  refuse("bv", "4\n1\n0 0 0\n1 0 0\n0 1 0\n", FS_ERR_FORMAT, "patch 0 has 4 control points, more than the 19 bytes");
  refuse("bv", "3\n1\n0 0 0\n1 0 0\n0 nan 0\n", FS_ERR_FORMAT, "line 5:");
  refuse("bv", "8\n1 1\n0 0 0 1\n0 1 0 1\n1 0 0 2\n1 1 0 1\n", FS_ERR_FORMAT, "rational with different weights");
  refuse("bv", "1\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", FS_ERR_FORMAT, "uses vertex 3, but there are only 3");
  refuse("bv", "1\n3 1\n0 0 0\n1 0 0\n0 1 0\n5 0 1 2 0 1\n", FS_ERR_FORMAT, "face 0 of the polyhedron has 5 vertices");
  refuse("bv", "1\n2000000000 1\n0 0 0\n", FS_ERR_FORMAT, "more than the");
  refuse("iges", "", FS_ERR_UNSUPPORTED,
         "no reader of surfaces for '.iges'; there are readers for .bv .spl .step .stp");
}

/* ---- splines ---- */

static const char splines_text[] = "fairsurf-splines 1   # a comment\n"
                                   "patch q\n"
                                   "degree 2 1\n"
                                   "knots 0 0 0 0.5 1 1 1\n"
                                   "knots 0 0 1 1\n"
                                   "points\n"
                                   "0 0 0  1 0 1  2 0 1  3 0 0\n"
                                   "0 1 0  1 1 1  2 1 1  3 1 0\n"
                                   "curve c\ndegree 1\npoints\n5 6 7\n8 9 10\n"
                                   "function gamma1\ndegree 2\nvalues 1 2 4\n";

static void test_splines(void **state) {
  fs_context ctx = test_context();
  fs_splines *list;
  fs_surface *s;
  double x[3];
  (void)state;
  assert_int_equal(fs_splines_parse(&ctx, splines_text, strlen(splines_text), &list), FS_OK);
  assert_int_equal(list->n, 3);
  assert_null(fs_splines_find(list, "r"));
  const fs_spline *q = fs_splines_find(list, "q"), *gamma = fs_splines_find(list, "gamma1");
  assert_int_equal(q->n[0], 4);
  assert_int_equal(q->n[1], 2);
  fs_spline_evaluate(q, 0.5, 0.25, 0, 0, x); /* (1 + 2) / 2 between the middle points */
  near((fs_vec3){x[0], x[1], x[2]}, (fs_vec3){1.5, 0.25, 1});
  fs_spline_evaluate(q, 0, 0.25, 1, 0, x); /* 2 (b1 - b0) / 0.5 */
  near((fs_vec3){x[0], x[1], x[2]}, (fs_vec3){4, 0, 4});
  fs_spline_evaluate(fs_splines_find(list, "c"), 0.5, 0, 0, 0, x);
  near((fs_vec3){x[0], x[1], x[2]}, (fs_vec3){6.5, 7.5, 8.5});
  assert_int_equal(gamma->width, 1);
  fs_spline_evaluate(gamma, 0.5, 0, 0, 0, x);
  assert_true(x[0] == 2.25);
  fs_splines_free(&ctx, list);
  s = read_text("spl", splines_text);
  assert_int_equal(s->n_patches, 2);
  assert_int_equal(s->patch[0].neighbour[1], 1);
  near(at(s, 1, 0, 0.25), (fs_vec3){1.5, 0.25, 1});
  release(s);
}

static void test_bad_splines(void **state) {
  (void)state;
#define START "fairsurf-splines 1\npatch q\ndegree 1 1\n"
  refuse("spl", "patch q\n", FS_ERR_FORMAT, "line 1: the file does not start with 'fairsurf-splines 1'");
  refuse("spl", "fairsurf-splines 2\n", FS_ERR_FORMAT, "version 2");
  refuse("spl", "fairsurf-splines 1\n", FS_ERR_FORMAT, "the file has no splines");
  refuse("spl", "fairsurf-splines 1\nsurface q\n", FS_ERR_FORMAT, "line 2: 'surface' stands where");
  refuse("spl", "fairsurf-splines 1\npatch q/r\n", FS_ERR_FORMAT, "characters other than");
  refuse("spl", "fairsurf-splines 1\npatch q\ndegree 1\npoints 1", FS_ERR_FORMAT, "line 3: 'q' needs 2 degrees");
  refuse("spl", "fairsurf-splines 1\npatch q\ndegree 1 16\n", FS_ERR_FORMAT, "'q' has degree 16");
  refuse("spl", START "knots 0 0 1 1\npoints 0", FS_ERR_FORMAT, "'q' has knots for u but not for v");
  refuse("spl", START "knots 0 0 1\n", FS_ERR_FORMAT, "'q' has 3 knots here: degree 1 needs 4 or more");
  refuse("spl", START "knots 0 0 0.7 0.3 1 1\nknots 0 0 1 1\npoints 0", FS_ERR_FORMAT,
         "line 4: the knots of 'q' decrease: knot 3 is 0.3 after 0.7");
  refuse("spl", START "knots 0 0 0.3 1 2\nknots 0 0 1 1\npoints\n0 0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0 0\n", FS_ERR_FORMAT,
         "line 2: the u knots of 'q' are not clamped");
  refuse("spl",
         START "knots 0 0 0.5 0.5 1 1\nknots 0 0 1 1\npoints\n0 0 0 0 0 0 0 0 0 0 0 0\n0 0 0 0 0 0 0 0 0 0 0 0\n",
         FS_ERR_FORMAT, "occurs too often for a continuous spline of degree 1");
  refuse("spl", START "points\n0 0 0 1 0 0 0 1 0\n", FS_ERR_FORMAT, "'q' needs 12 numbers, more than");
  refuse("spl", START "points\n0 0 0 1 0 0 0 1 0 1 1           \n", FS_ERR_FORMAT,
         "the file ends within point 3 of 'q'");
  refuse("spl", START "points\n0 0 0 1 0 0 0 1 0 1 1 x", FS_ERR_FORMAT, "line 5:");
  refuse("spl", START "points\n0 0 0 1 0 0 0 1 0 1 1 0\npatch q\n", FS_ERR_FORMAT, "line 6: a second 'q'");
  refuse("spl", "fairsurf-splines 1\ncurve c\ndegree 1\npoints\n0 0 0 1 1 1\n", FS_ERR_FORMAT, "but no patch");
#undef START
}

/* ---- written and read back ---- */

static fs_surface *round_trip(const fs_surface *s, const char *extension) {
  fs_context ctx = test_context();
  memory_output memory = {0};
  fs_output output = memory_output_of(&memory);
  fs_model model = {.name = "a surface", .surface = s};
  fs_surface *back = NULL;
  if (fs_export(&ctx, &model, fs_exporter_find(extension), NULL, &output) != FS_OK) fail_msg("%s", ctx.message);
  if (fs_surface_parse(&ctx, extension, memory.bytes, memory.size, &back) != FS_OK) fail_msg("%s", ctx.message);
  free(memory.bytes);
  return back;
}

static void test_round_trips(void **state) {
  static const char text[] = "fairsurf-splines 1\npatch q\ndegree 3 2\npoints\n"
                             "0 0 0.1  1 0 0.2  2 0 -0.3  3 0 0\n0 1 0.7  1 1 0.123456789012345678  2 1 1  3 1 0\n"
                             "0 2 0  1 2 1e-300  2 2 1  3 2 0.3333333333333333\n"
                             "patch r\ndegree 1 2\npoints\n3 0 0  4 0 0\n3 1 0  4 1 0\n3 2 0.3333333333333333  4 2 0\n";
  (void)state;
  for (int k = 0; k < 3; k++) {
    fs_surface *s = k < 2 ? read_text("spl", text) : read_text("bv", kinds);
    fs_surface *back = round_trip(s, k == 0 ? "spl" : "bv");
    assert_int_equal(back->n_patches, s->n_patches);
    assert_int_equal(back->n_data, s->n_data);
    assert_memory_equal(back->data, s->data, s->n_data * sizeof *s->data);
    assert_memory_equal(back->patch, s->patch, (size_t)s->n_patches * sizeof *s->patch);
    if (k < 2) assert_int_equal(s->patch[0].neighbour[1], 1);
    release(s);
    release(back);
  }
}

/* Kinds that these formats do not have are approximated, closed surfaces stay closed. */
static void test_other_kinds(void **state) {
  static const char *const extension[2] = {"bv", "spl"};
  (void)state;
  for (int k = 0; k < 2; k++) {
    fs_surface *s = sample_pyramid(FS_PATCH_GREGORY_QUAD), *back = round_trip(s, extension[k]);
    assert_true(back->n_patches > s->n_patches);
    for (int32_t p = 0; p < back->n_patches; p++) {
      assert_int_equal(back->patch[p].degree_u, 3);
      for (int side = 0; side < 4; side++) assert_true(back->patch[p].neighbour[side] != FS_NONE);
    }
    sample_pyramid_free(s);
    release(back);
  }
}

/* ---- stitching ---- */

static void test_stitching(void **state) {
  /* p1 meets p0; p2 lies over the side of both, so that nobody knows; p3 and p4 coincide along a side but run the same way */
  static const char three[] = "4\n1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n4\n1\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
  static const char more[] = "4\n1\n1 0 0\n1 1 0\n1 0 1\n1 1 1\n";
  static const char turned[] = "4\n1\n0 0 0\n0 1 0\n1 0 0\n1 1 0\n4\n1\n1 1 0\n1 0 0\n2 1 0\n2 0 0\n";
  char text[300];
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_surface *s = read_text("bv", three);
  (void)state;
  assert_int_equal(s->patch[0].neighbour[1], 1);
  assert_int_equal(s->patch[0].neighbour_side[1], 3);
  assert_int_equal(s->patch[1].neighbour[3], 0);
  release(s);
  snprintf(text, sizeof text, "%s%s", three, more);
  s = read_text("bv", text);
  assert_int_equal(s->patch[0].neighbour[1], FS_NONE);
  release(s);
  assert_int_equal(fs_surface_parse(&ctx, "bv", turned, strlen(turned), &s), FS_OK);
  assert_int_equal(s->patch[0].neighbour[1], FS_NONE);
  assert_non_null(strstr(memory.note, "1 pairs of sides coincide but are not joined"));
  fs_surface_free(&ctx, s);
}

/* Any prefix of a file is a file or refused, and never read beyond its end. */
static void test_cut_files(void **state) {
  static const char *const text[2] = {kinds, splines_text}, *const extension[2] = {"bv", "spl"};
  (void)state;
  for (int k = 0; k < 2; k++)
    for (size_t size = 0; size < strlen(text[k]); size++) {
      struct test_memory memory = {0};
      fs_context ctx = test_memory_context(&memory);
      char *copy = malloc(size + (size == 0));
      fs_surface *s;
      memcpy(copy, text[k], size);
      fs_status status = fs_surface_parse(&ctx, extension[k], copy, size, &s);
      if (status == FS_OK)
        fs_surface_free(&ctx, s);
      else
        assert_true(status == FS_ERR_FORMAT && ctx.message[0] != '\0');
      assert_int_equal(memory.n_live, 0);
      free(copy);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_bezierview),  cmocka_unit_test(test_bad_bezierview), cmocka_unit_test(test_splines),
      cmocka_unit_test(test_bad_splines), cmocka_unit_test(test_round_trips),    cmocka_unit_test(test_other_kinds),
      cmocka_unit_test(test_stitching),   cmocka_unit_test(test_cut_files),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
