/* SPDX-License-Identifier: MIT */
/* Delaunay triangulations: empty circumcircles, the convex hull is filled, points on lattices and lines; files of points. */
#include "mesh/delaunay.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static long double cross(const fs_vec3 *a, const fs_vec3 *b, const fs_vec3 *c) {
  return ((long double)b->x - a->x) * ((long double)c->y - a->y) -
         ((long double)b->y - a->y) * ((long double)c->x - a->x);
}

/* Area of the convex hull by gift wrapping over points in any order. */
static long double hull_area(int n, const fs_vec3 *p) {
  long double area = 0;
  int first = 0, at;
  for (int i = 1; i < n; i++)
    if (p[i].x < p[first].x || (p[i].x == p[first].x && p[i].y < p[first].y)) first = i;
  at = first;
  do {
    int next = at == 0 ? 1 : 0;
    for (int i = 0; i < n; i++) {
      long double side = cross(&p[at], &p[next], &p[i]);
      double far = hypot(p[i].x - p[at].x, p[i].y - p[at].y), near = hypot(p[next].x - p[at].x, p[next].y - p[at].y);
      if (i != at && (side < 0 || (side == 0 && far > near))) next = i;
    }
    area += cross(&p[first], &p[at], &p[next]) / 2;
    at = next;
  } while (at != first);
  return area;
}

/* > 0 where d lies inside the circle of the anticlockwise triangle a, b, c; in units of length^4 */
static long double in_circle(const fs_vec3 *a, const fs_vec3 *b, const fs_vec3 *c, const fs_vec3 *d) {
  const long double ax = a->x - d->x, ay = a->y - d->y, bx = b->x - d->x, by = b->y - d->y, cx = c->x - d->x,
                    cy = c->y - d->y;
  return (ax * ax + ay * ay) * (bx * cy - by * cx) - (bx * bx + by * by) * (ax * cy - ay * cx) +
         (cx * cx + cy * cy) * (ax * by - ay * bx);
}

static void check(int n, const fs_vec3 *p, double tolerance) {
  fs_context ctx = test_context();
  int32_t *corner = calloc(6 * (size_t)n, sizeof *corner), *start = calloc(2 * (size_t)n + 1, sizeof *start),
          n_triangles;
  long double area = 0;
  fs_mesh *mesh;
  if (fs_delaunay(&ctx, n, p, corner, &n_triangles) != FS_OK) fail_msg("%s", ctx.message);
  for (int t = 0; t < n_triangles; t++) {
    const int32_t *v = corner + 3 * t;
    long double twice = cross(&p[v[0]], &p[v[1]], &p[v[2]]);
    assert_true(twice > 0);
    area += twice / 2;
    for (int i = 0; i < n; i++) assert_true(in_circle(&p[v[0]], &p[v[1]], &p[v[2]], &p[i]) <= tolerance);
    start[t + 1] = 3 * (t + 1);
  }
  assert_true(fabsl(area - hull_area(n, p)) <= 1e-7L * area);
  mesh = test_mesh(n, p, n_triangles, start, corner); /* every point is used, and the triangles fit together */
  fs_mesh_free(&ctx, mesh);
  free(corner), free(start);
}

static void test_random_points(void **state) {
  fs_vec3 p[200];
  uint64_t seed = 3;
  (void)state;
  for (int n = 3; n <= 200; n += n < 20 ? 1 : 60)
    for (int repeat = 0; repeat < 4; repeat++) {
      for (int i = 0; i < n; i++) p[i] = (fs_vec3){test_random_real(&seed, 0, 1), test_random_real(&seed, 0, 2), 0};
      check(n, p, 1e-7);
    }
}

/* Whole numbers up to 32 are exact on the grid: many points on lines and circles, nothing may fail. */
static void test_lattices(void **state) {
  fs_vec3 p[400];
  uint64_t seed = 4;
  (void)state;
  for (int n = 2; n <= 16; n += 7) {
    for (int i = 0; i <= n; i++)
      for (int j = 0; j <= n; j++) p[i * (n + 1) + j] = (fs_vec3){i, j, 0};
    check((n + 1) * (n + 1), p, 0);
  }
  for (int i = 0; i < 12; i++) p[i] = (fs_vec3){i < 11 ? i : 5, i < 11 ? 0 : 3, 0}; /* a line and a point above it */
  check(12, p, 0);
  p[11].y = -3;
  check(12, p, 0);
  for (int i = 0; i < 12; i++) p[i] = (fs_vec3){i < 11 ? 0 : 3, i < 11 ? i : 5, 0}; /* beside it */
  check(12, p, 0);
  for (int repeat = 0; repeat < 30; repeat++) { /* points of a lattice at random */
    bool taken[33][33] = {{false}};
    int n = 0;
    while (n < 60) {
      int x = n == 0   ? 0
              : n == 1 ? 32
                       : test_random_integer(&seed, 0, 32),
          y = test_random_integer(&seed, 0, repeat % 2 ? 3 : 32);
      if (taken[x][y]) continue;
      taken[x][y] = true;
      p[n++] = (fs_vec3){x, y, 0};
    }
    check(n, p, 0);
  }
}

static void refuse(const char *text, const char *sentence) {
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  assert_int_equal(test_parse(&ctx, "xyz", text, strlen(text), &mesh), FS_ERR_FORMAT);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" lacks \"%s\"", ctx.message, sentence);
  assert_null(mesh);
}

static void test_files(void **state) {
  static const char text[] = "# heights\n0 0 1\n1 0 2.5\n\n0 1 3 # a corner\n1 1e0 -4\n0.5 0.4 0\n";
  fs_context ctx = test_context();
  fs_mesh *mesh;
  (void)state;
  assert_int_equal(test_parse(&ctx, "xyz", text, strlen(text), &mesh), FS_OK);
  assert_int_equal(mesh->n_vertices, 5);
  assert_int_equal(mesh->n_faces, 4);
  assert_true(mesh->position[3].z == -4);
  fs_mesh_free(&ctx, mesh);
  refuse("0 0 1\n1 0\n", "line 2: a point needs x, y and z");
  refuse("0 0 1\n1 0 1 1\n", "line 2: '1' stands behind x, y and z");
  refuse("0 0 1\n1 zero 1\n", "line 2:");
  refuse("0 0 1\n1 0 1\n", "2 points make no triangle");
  refuse("0 0 1\n1 1 1\n2 2 1\n3 3 0\n", "all points lie on one line");
  refuse("0 0 1\n1 1 1\n2 5 1\n1 1 0\n", "points 1 and 3 have the same x and y");
  refuse("7 7 1\n7 7 2\n7 7 3\n", "span no finite rectangle");
  refuse("# nothing\n", "0 points make no triangle");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_random_points), cmocka_unit_test(test_lattices),
                                     cmocka_unit_test(test_files)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
