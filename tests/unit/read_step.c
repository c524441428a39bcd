/* SPDX-License-Identifier: MIT */
/* STEP files into surfaces: what is read, to the number, what is refused, with a sentence, and files with random damage. */
#include <fairsurf/surface_splines.h>
#include "math/vec3.h"
#include "../support/support.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define HEAD "ISO-10303-21;\nHEADER;\nFILE_NAME('it''s #9=(;','');\nENDSEC;\nDATA;\n"
#define TAIL "ENDSEC;\nEND-ISO-10303-21;\n"

/* The six points of a surface of degree (2, 1): z = x^2 over [0, 1] x [0, 1]. */
#define POINTS                                                                        \
  "#1=CARTESIAN_POINT('',(0.,0.,0.));\n#2=CARTESIAN_POINT('',(0.,1.,0.));\n"          \
  "#3=CARTESIAN_POINT('a ; (',(0.5,0.,0.));\n#4=CARTESIAN_POINT('',(5.E-1,1.,0.));\n" \
  "#5=CARTESIAN_POINT('',(1.,0.,1.));\n#6 = CARTESIAN_POINT ( '' , ( 1. ,1., /* ; */ 1.0E0 ) ) ;\n"
#define ROWS "((#1,#2),(#3,#4),(#5,#6))"
#define SURFACE                                  \
  "#10=B_SPLINE_SURFACE_WITH_KNOTS('',2,1," ROWS \
  ",.UNSPECIFIED.,.F.,.F.,.F.,(3,3),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.);\n"

/* A loop once around: vertices at the corners, lines between them. */
#define LOOP                                                                                                 \
  "#20=VERTEX_POINT('',#1);\n#21=VERTEX_POINT('',#5);\n#22=VERTEX_POINT('',#6);\n#23=VERTEX_POINT('',#2);\n" \
  "#30=EDGE_CURVE('',#20,#21,#15,.T.);\n#31=EDGE_CURVE('',#21,#22,#16,.T.);\n"                               \
  "#32=EDGE_CURVE('',#23,#22,#16,.T.);\n#33=EDGE_CURVE('',#20,#23,#16,.T.);\n"                               \
  "#15=B_SPLINE_CURVE_WITH_KNOTS('',2,(#1,#3,#5),.UNSPECIFIED.,.F.,.F.,(3,3),(0.,1.),.UNSPECIFIED.);\n"      \
  "#16=LINE('',#1,#17);\n#17=VECTOR('',#18,1.);\n#18=DIRECTION('',(0.,1.,0.));\n"                            \
  "#40=ORIENTED_EDGE('',*,*,#30,.T.);\n#41=ORIENTED_EDGE('',*,*,#31,.T.);\n"                                 \
  "#42=ORIENTED_EDGE('',*,*,#32,.F.);\n#43=ORIENTED_EDGE('',*,*,#33,.F.);\n"                                 \
  "#50=EDGE_LOOP('',(#40,#41,#42,#43));\n#51=FACE_OUTER_BOUND('',#50,.T.);\n"

static fs_surface *read(const char *text) {
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  fs_status status = fs_surface_parse(&ctx, "step", text, strlen(text), &s);
  if (status != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(fs_surface_validate(&ctx, s), FS_OK);
  return s;
}

static void release(fs_surface *s) {
  fs_context ctx = test_context();
  fs_surface_free(&ctx, s);
}

static void refuse(const char *text, fs_status expected, const char *part) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_surface *s = NULL;
  fs_status status = fs_surface_parse(&ctx, "stp", text, strlen(text), &s);
  if (status != expected || strstr(ctx.message, part) == NULL)
    fail_msg("status %d and \"%s\" instead of %d and \"%s\"", (int)status, ctx.message, (int)expected, part);
  assert_null(s);
  assert_int_equal(memory.n_live, 0);
}

static void near_point(const fs_surface *s, int32_t patch, double u, double v, double x, double y, double z) {
  fs_vec3 jet[FS_JET_SIZE];
  fs_surface_evaluate(s, patch, u, v, jet);
  if (!(fs_vec3_distance(jet[FS_D], (fs_vec3){x, y, z}) < 1e-14))
    fail_msg("<%g, %g, %g> is not <%g, %g, %g>", jet[FS_D].x, jet[FS_D].y, jet[FS_D].z, x, y, z);
}

static void test_surface_alone(void **state) {
  fs_surface *s = read(HEAD POINTS SURFACE TAIL);
  (void)state;
  assert_int_equal(s->n_patches, 1);
  near_point(s, 0, 0.3, 0.6, 0.3, 0.6, 0.09);
  release(s);
}

static void test_faces(void **state) {
  fs_vec3 x[FS_JET_SIZE], n;
  fs_surface *s = read(HEAD POINTS SURFACE LOOP "#60=ADVANCED_FACE('',(#51),#10,.T.);\n" TAIL);
  (void)state;
  assert_int_equal(s->n_patches, 1);
  fs_surface_evaluate(s, 0, 0.5, 0.5, x);
  n = fs_vec3_cross(x[FS_DU], x[FS_DV]);
  assert_true(n.z > 0);
  release(s);
  s = read(HEAD POINTS SURFACE LOOP "#60=FACE_SURFACE('',(#51),#10,.F.);\n" TAIL); /* the other way round */
  near_point(s, 0, 0.6, 0.3, 0.3, 0.6, 0.09);
  fs_surface_evaluate(s, 0, 0.5, 0.5, x);
  n = fs_vec3_cross(x[FS_DU], x[FS_DV]);
  assert_true(n.z < 0);
  release(s);
}

/* z = x^2 in two pieces, from the blossom, and in several types with weights that are all 2. */
static void test_knots_and_types(void **state) {
  fs_surface *s = read(
      HEAD
      "#1=CARTESIAN_POINT('',(0.,0.,0.));#2=CARTESIAN_POINT('',(0.,1.,0.));"
      "#3=CARTESIAN_POINT('',(.2,0.,0.));#4=CARTESIAN_POINT('',(.2,1.,0.));"
      "#5=CARTESIAN_POINT('',(.7,0.,.4));#6=CARTESIAN_POINT('',(.7,1.,.4));"
      "#7=CARTESIAN_POINT('',(1.,0.,1.));#8=CARTESIAN_POINT('',(1.,1.,1.));\n"
      "#10=(BOUNDED_SURFACE()B_SPLINE_SURFACE(2,1,((#1,#2),(#3,#4),(#5,#6),(#7,#8)),.UNSPECIFIED.,.F.,.F.,.F.)\n"
      "B_SPLINE_SURFACE_WITH_KNOTS((3,1,3),(2,2),(0.,.4,1.),(0.,1.),.UNSPECIFIED.)GEOMETRIC_REPRESENTATION_ITEM()\n"
      "RATIONAL_B_SPLINE_SURFACE(((2.,2.),(2.,2.),(2.,2.),(2.,2.)))REPRESENTATION_ITEM('')SURFACE());\n" TAIL);
  (void)state;
  assert_int_equal(s->n_patches, 2);
  near_point(s, 0, 0.5, 0.25, 0.2, 0.25, 0.04);
  near_point(s, 1, 0.5, 0.25, 0.7, 0.25, 0.49);
  assert_int_equal(s->patch[0].neighbour[1], 1);
  release(s);
  s = read(HEAD POINTS "#10=BEZIER_SURFACE('',2,1," ROWS ",.UNSPECIFIED.,.F.,.F.,.F.);" TAIL);
  near_point(s, 0, 0.3, 0.6, 0.3, 0.6, 0.09);
  release(s);
  s = read(HEAD POINTS "#10=QUASI_UNIFORM_SURFACE('',1,1," ROWS ",.UNSPECIFIED.,.F.,.F.,.F.);" TAIL);
  assert_int_equal(s->n_patches, 2);
  near_point(s, 1, 0.5, 0, 0.75, 0, 0.5);
  release(s);
}

static void test_refusals(void **state) {
  (void)state;
  refuse("", FS_ERR_FORMAT, "ISO-10303-21");
  refuse("solid cube\n", FS_ERR_FORMAT, "ISO-10303-21");
  refuse(HEAD TAIL, FS_ERR_UNSUPPORTED, "no B-spline surface");
  refuse(HEAD POINTS "#1=CARTESIAN_POINT('',(0.,0.,0.));" TAIL, FS_ERR_FORMAT, "a second entity #1");
  refuse(HEAD POINTS "#10=BEZIER_SURFACE('',2,1,((#1,#2),(#3,#4),(#5)),.U.,.F.,.F.,.F.);" TAIL, FS_ERR_FORMAT,
         "rows of 2 and of 1");
  refuse(HEAD POINTS "#10=BEZIER_SURFACE('',2,1,((#1,#2),(#3,#4),(#5,#77)),.U.,.F.,.F.,.F.);" TAIL, FS_ERR_FORMAT,
         "#77, which is not there");
  refuse(HEAD POINTS "#10=BEZIER_SURFACE('',2,1,((#1,#2),(#3,#4),(#5,#10)),.U.,.F.,.F.,.F.);" TAIL, FS_ERR_FORMAT,
         "#10 is BEZIER_SURFACE where CARTESIAN_POINT is needed");
  refuse(HEAD POINTS "#10=BEZIER_SURFACE('',16,1," ROWS ",.U.,.F.,.F.,.F.);" TAIL, FS_ERR_UNSUPPORTED, "degree 16");
  refuse(HEAD POINTS "#10=B_SPLINE_SURFACE_WITH_KNOTS('',2,1," ROWS
                     ",.U.,.F.,.F.,.F.,(3,2),(2,2),(0.,1.),(0.,1.),.U.);" TAIL,
         FS_ERR_FORMAT, "knots of #10");
  refuse(HEAD POINTS "#10=B_SPLINE_SURFACE_WITH_KNOTS('',2,1," ROWS
                     ",.U.,.F.,.F.,.F.,(1,1,1,1,1,1),(2,2),(0.,1.,2.,3.,4.,5.),(0.,1.),.U.);" TAIL,
         FS_ERR_UNSUPPORTED, "line 12");
  refuse(HEAD POINTS "#10=(B_SPLINE_SURFACE(2,1," ROWS ",.U.,.F.,.F.,.F.)"
                     "B_SPLINE_SURFACE_WITH_KNOTS((3,3),(2,2),(0.,1.),(0.,1.),.U.)"
                     "RATIONAL_B_SPLINE_SURFACE(((1.,1.),(0.7,1.),(1.,1.))));" TAIL,
         FS_ERR_UNSUPPORTED, "rational");
  refuse(HEAD POINTS SURFACE LOOP "#9=CYLINDRICAL_SURFACE('',#8,1.);#8=X();#60=ADVANCED_FACE('',(#51),#9,.T.);" TAIL,
         FS_ERR_UNSUPPORTED, "CYLINDRICAL_SURFACE");
  refuse(HEAD POINTS SURFACE LOOP "#60=ADVANCED_FACE('',(#51,#51),#10,.T.);" TAIL, FS_ERR_UNSUPPORTED, "holes");
  refuse(HEAD POINTS SURFACE "#61=MAPPED_ITEM('',#10,#10);" TAIL, FS_ERR_UNSUPPORTED, "assemblies");
}

/* The loop above with a vertex, a curve or an edge that is not as it should be. */
static void refuse_loop(const char *from, const char *to, const char *part) {
  const char *whole = HEAD POINTS SURFACE LOOP "#60=ADVANCED_FACE('',(#51),#10,.T.);\n" TAIL, *at = strstr(whole, from);
  char text[8192];
  assert_non_null(at);
  snprintf(text, sizeof text, "%.*s%s%s", (int)(at - whole), whole, to, at + strlen(from));
  refuse(text, FS_ERR_UNSUPPORTED, part);
}

static void test_trimmed(void **state) {
  (void)state;
  refuse_loop("#21=VERTEX_POINT('',#5);", "#21=VERTEX_POINT('',#9);#9=CARTESIAN_POINT('',(.5,.5,.25));", "inside");
  refuse_loop("#22=VERTEX_POINT('',#6);", "#22=VERTEX_POINT('',#9);#9=CARTESIAN_POINT('',(1.,.5,1.));", "cut off");
  refuse_loop("(#1,#3,#5),.UNSPECIFIED.", "(#1,#4,#5),.UNSPECIFIED.", "leaves the border");
}

/* Random damage: a surface, or a sentence and nothing kept. */
static void test_damage(void **state) {
  const char *whole = HEAD POINTS SURFACE LOOP "#60=ADVANCED_FACE('',(#51),#10,.T.);\n" TAIL;
  static const char junk[] = "#(),'.;=0123456789/*EF T-";
  uint64_t random = 3;
  size_t size = strlen(whole);
  int n_read = 0;
  (void)state;
  for (int round = 0; round < 3000; round++) {
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    fs_surface *s = NULL;
    char *text = malloc(size);
    size_t used = size;
    memcpy(text, whole, size);
    for (int k = test_random_integer(&random, 1, 3); k > 0; k--)
      text[test_random_integer(&random, 0, (int32_t)size - 1)] = junk[test_random_integer(&random, 0, sizeof junk - 2)];
    if (round % 10 == 0) used = (size_t)test_random_integer(&random, 0, (int32_t)size);
    text = realloc(text, used > 0 ? used : 1); /* so that a sanitizer sees what is read beyond */
    fs_status status = fs_surface_parse(&ctx, "step", text, used, &s);
    if (status != FS_OK) {
      assert_null(s);
      assert_true(ctx.message[0] != '\0');
    } else {
      n_read++;
    }
    fs_surface_free(&ctx, s);
    assert_int_equal(memory.n_live, 0);
    assert_true(memory.peak_bytes < 64 * size + 65536);
    free(text);
  }
  assert_true(n_read > 300 && n_read < 2700);
}

static void test_memory(void **state) {
  const char *whole = HEAD POINTS SURFACE LOOP "#60=ADVANCED_FACE('',(#51),#10,.F.);\n" TAIL;
  (void)state;
  for (int64_t fail_at = 1;; fail_at++) {
    struct test_memory memory = {.fail_at = fail_at};
    fs_context ctx = test_memory_context(&memory);
    fs_surface *s = NULL;
    fs_status status = fs_surface_parse(&ctx, "step", whole, strlen(whole), &s);
    fs_surface_free(&ctx, s);
    assert_int_equal(memory.n_live, 0);
    if (status == FS_OK) break;
    assert_int_equal(status, FS_ERR_MEMORY);
    assert_null(s);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_surface_alone), cmocka_unit_test(test_faces),   cmocka_unit_test(test_knots_and_types),
      cmocka_unit_test(test_refusals),      cmocka_unit_test(test_trimmed), cmocka_unit_test(test_damage),
      cmocka_unit_test(test_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
