/* SPDX-License-Identifier: MIT */
/* Gregory patches against numbers of an independent program (FAIRSURF_SHARED/math/patches-vectors.json): control points,
   factors of the fields across edges, derivatives, normals, curvatures, and the error of bicubic stand-ins. */
#include "vectors.h"
#include "construct/gregory.h"
#include "math/bernstein.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

static cJSON *vectors;

/* ---- control points ---- */

static void test_edges(void **state) {
  static const char *const rule[] = {"arc", "pn", "wm"};
  fs_vec3 P[4], N[4], point[4];
  const cJSON *inputs = vectors_item(vectors_item(vectors, "gregory_quad"), "inputs");
  (void)state;
  vectors_points(inputs, "P", 4, P);
  vectors_points(inputs, "N", 4, N);
  for (int r = 0; r < 3; r++) {
    assert_int_equal(fs_gregory_edge(P[0], P[1], N[0], N[1], (fs_edge_rule)r, point), FS_GREGORY_FINE);
    vectors_compare(vectors_item(vectors, "edge_cubic"), rule[r], 12, &point[0].x, 1e-12);
  }
}

/* k and h of every side, from the cubics. */
static void check_fields(const cJSON *object, int n, const fs_vec3 *P, const fs_vec3 *N) {
  fs_vec3 edge[4][4];
  const cJSON *kh = vectors_item(object, "kh");
  for (int e = 0; e < n; e++)
    assert_int_equal(fs_gregory_edge(P[e], P[(e + 1) % n], N[e], N[(e + 1) % n], FS_EDGE_ARC, edge[e]), 0);
  for (int e = 0; e < n; e++) {
    const fs_vec3 *previous = edge[(e + n - 1) % n], *next = edge[(e + 1) % n];
    fs_vec3 first = fs_vec3_sub(previous[2], previous[3]), last = fs_vec3_sub(next[1], next[0]);
    if (n == 3) last = fs_vec3_add(last, fs_vec3_sub(edge[e][3], edge[e][2]));
    fs_gregory_field field;
    assert_int_equal(fs_gregory_cross(edge[e], N[e], N[(e + 1) % n], first, last, &field), FS_GREGORY_FINE);
    const cJSON *side = cJSON_GetArrayItem(kh, e);
    vectors_compare(side, "k0", 1, &field.k[0], 1e-12);
    vectors_compare(side, "k1", 1, &field.k[1], 1e-12);
    vectors_compare(side, "h0", 1, &field.h[0], 1e-12);
    vectors_compare(side, "h1", 1, &field.h[1], 1e-12);
  }
}

static const int32_t numbers[4] = {0, 1, 2, 3};

/* A surface of one patch over points that the caller keeps. */
static fs_surface one_patch(fs_patch *patch, fs_vec3 *point) {
  return (fs_surface){.n_patches = 1, .n_data = 60, .patch = patch, .data = &point->x};
}

static fs_surface quad(const cJSON *object, fs_patch *patch, fs_vec3 *point) {
  fs_vec3 P[4], N[4];
  int32_t side;
  vectors_points(vectors_item(object, "inputs"), "P", 4, P);
  vectors_points(vectors_item(object, "inputs"), "N", 4, N);
  assert_int_equal(fs_gregory_quad(P, N, numbers, FS_EDGE_ARC, point, &side), FS_GREGORY_FINE);
  check_fields(object, 4, P, N);
  *patch = (fs_patch){.kind = FS_PATCH_GREGORY_QUAD, .n_sides = 4, .degree_u = 3, .degree_v = 3};
  for (int s = 0; s < 4; s++) patch->neighbour[s] = FS_NONE;
  return one_patch(patch, point);
}

static fs_surface triangle(const cJSON *object, fs_patch *patch, fs_vec3 *point) {
  fs_vec3 P[3], N[3];
  int32_t side;
  vectors_points(vectors_item(object, "inputs"), "P", 3, P);
  vectors_points(vectors_item(object, "inputs"), "N", 3, N);
  assert_int_equal(fs_gregory_triangle(P, N, numbers, FS_EDGE_ARC, point, &side), FS_GREGORY_FINE);
  check_fields(object, 3, P, N);
  *patch = (fs_patch){.kind = FS_PATCH_GREGORY_TRIANGLE, .n_sides = 3, .degree_u = 4, .degree_v = 4};
  for (int s = 0; s < 4; s++) patch->neighbour[s] = FS_NONE;
  return one_patch(patch, point);
}

/* ---- evaluation ---- */

static void check_geometry(const cJSON *eval, const char *jet, const fs_vec3 *x) {
  fs_geometry g;
  vectors_compare_jet(vectors_item(eval, jet), x);
  assert_true(fs_geometry_compute(x, &g));
  vectors_compare(eval, "normal", 3, &g.normal.x, 1e-12);
  vectors_compare(eval, "K", 1, &g.K, 1e-10);
  vectors_compare(eval, "H", 1, &g.H, 1e-10);
}

static void test_quad(void **state) {
  const cJSON *object = vectors_item(vectors, "gregory_quad"), *eval;
  fs_patch patch;
  fs_vec3 point[20], x[FS_JET_SIZE];
  fs_surface s = quad(object, &patch, point);
  double net[48];
  (void)state;
  vectors_numbers(object, "boundary_4x4", 48, net);
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++)
      if (i % 3 == 0 || j % 3 == 0)
        for (int d = 0; d < 3; d++) assert_true(fabs((&point[i + 4 * j].x)[d] - net[3 * (4 * i + j) + d]) <= 1e-12);
  for (int c = 0; c < 4; c++) {
    const char name[3] = {c % 2 ? '2' : '1', c / 2 ? '2' : '1', 0};
    vectors_compare(vectors_item(object, "fu"), name, 3, &point[(c % 2 ? 2 : 1) + (c / 2 ? 8 : 4)].x, 1e-12);
    vectors_compare(vectors_item(object, "fv"), name, 3, &point[16 + c].x, 1e-12);
  }
  cJSON_ArrayForEach(eval, vectors_item(object, "evals")) {
    fs_surface_evaluate(&s, 0, vectors_number(eval, "u"), vectors_number(eval, "v"), x);
    check_geometry(eval, "ders", x);
  }
}

static void test_triangle(void **state) {
  static const char *const boundary[] = {"400", "310", "220", "130", "040", "301", NULL, NULL,
                                         "031", "202", NULL,  "022", "103", "013", "004"};
  const cJSON *object = vectors_item(vectors, "gregory_tri"), *eval;
  fs_patch patch;
  fs_vec3 point[20], x[FS_JET_SIZE], p[3];
  fs_surface s = triangle(object, &patch, point);
  (void)state;
  for (int k = 0; k < 15; k++)
    if (boundary[k] != NULL) vectors_compare(vectors_item(object, "boundary"), boundary[k], 3, &point[k].x, 1e-12);
  p[0] = point[6], p[1] = point[7], p[2] = point[10];
  vectors_compare(object, "fa", 9, &point[15].x, 1e-12);
  vectors_compare(object, "fb", 9, &p[0].x, 1e-12);
  cJSON_ArrayForEach(eval, vectors_item(object, "evals")) {
    double lam[3];
    vectors_numbers(eval, "lam", 3, lam);
    fs_surface_evaluate(&s, 0, lam[1], lam[2], x);
    check_geometry(eval, "ders_st", x);
  }
}

/* ---- bicubic stand-ins ---- */

/* The largest distance at (n_points)^2 points of each piece of one patch, ends included. */
static double stand_in_error(const fs_surface *s, int32_t p, int m, int n_points) {
  int n = 1 << m;
  fs_vec3 *piece = calloc((size_t)(16 * n * n), sizeof *piece), x[FS_JET_SIZE];
  double largest = 0, B[4], C[4];
  fs_surface_hermite_bicubics(s, p, m, piece);
  for (int k = 0; k < n * n; k++)
    for (int q = 0; q < n_points * n_points; q++) {
      double u = (double)(q % n_points) / (n_points - 1), v = (double)(q / n_points) / (n_points - 1);
      fs_vec3 sum = {0, 0, 0};
      fs_bernstein_basis(3, u, 0, B);
      fs_bernstein_basis(3, v, 0, C);
      for (int i = 0; i < 16; i++) sum = fs_vec3_add_scaled(sum, piece[16 * k + i], B[i % 4] * C[i / 4]);
      fs_surface_evaluate(s, p, (k % n + u) / n, (k / n + v) / n, x);
      largest = fmax(largest, fs_vec3_distance(sum, x[FS_D]));
    }
  free(piece);
  return largest;
}

static void test_stand_ins(void **state) {
  fs_patch patch;
  fs_vec3 point[20];
  fs_context ctx = test_context();
  fs_surface s = quad(vectors_item(vectors, "gregory_quad"), &patch, point), *kites = NULL;
  (void)state;
  for (int m = 0; m < 5; m++) {
    double error = stand_in_error(&s, 0, m, 7);
    vectors_compare(cJSON_GetArrayItem(vectors_item(vectors, "gregory_quad_to_bicubics_error"), m), "dist", 1, &error,
                    1e-12);
  }
  s = triangle(vectors_item(vectors, "gregory_tri"), &patch, point);
  s.n_data = 54;
  assert_int_equal(fs_surface_to_quads(&ctx, &s, &kites), FS_OK);
  for (int m = 0; m < 4; m++) {
    double error = 0, row[5];
    for (int32_t p = 0; p < 3; p++) error = fmax(error, stand_in_error(kites, p, m, 5));
    vectors_flatten(cJSON_GetArrayItem(vectors_item(vectors, "gregory_tri_to_bicubics_error"), m), row);
    assert_true(fabs(error - row[1]) <= 1e-12);
  }
  fs_surface_free(&ctx, kites);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_edges), cmocka_unit_test(test_quad),
                                     cmocka_unit_test(test_triangle), cmocka_unit_test(test_stand_ins)};
  vectors = vectors_open("math/patches-vectors.json");
  if (vectors == NULL) return TEST_SKIPPED;
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  cJSON_Delete(vectors);
  return failed;
}
