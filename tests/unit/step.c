/* SPDX-License-Identifier: MIT */
/* Single role: tests of what the STEP exporter makes of patches: its splines are the patches they are made of, faces cover
   the surface once, edges lie between two of them. */
#include "surface_samples.h"
#include "../support/support.h"
#include "step.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

#include <string.h>

/* ---- surfaces ---- */

static int two_columns(int i, int j) { return (void)j, i < 2; }

static uint64_t mask;
static int masked(int i, int j) { return (int)(mask >> ((i + 7 * j) % 64) & 1); }

/* Patches turned by random numbers of quarters: the same surface. */
static void turn_patches(fs_surface *surface, uint64_t *random) {
  int32_t turn[400];
  assert_true(surface->n_patches <= 400);
  for (int32_t p = 0; p < surface->n_patches; p++) {
    turn[p] = test_random_integer(random, 0, 3);
    fs_patch *patch = &surface->patch[p], old = *patch;
    int32_t n = patch->degree_u;
    double b[300], *data = surface->data + patch->data_start;
    assert_int_equal(n, patch->degree_v);
    memcpy(b, data, 3 * (size_t)((n + 1) * (n + 1)) * sizeof *b);
    for (int32_t j = 0; j <= n; j++)
      for (int32_t i = 0; i <= n; i++) {
        int32_t k = i, l = j;
        for (int32_t q = 0; q < turn[p]; q++) {
          int32_t swap = k;
          k = n - l, l = swap;
        }
        memcpy(data + 3 * (i + (n + 1) * j), b + 3 * (k + (n + 1) * l), 3 * sizeof *b);
      }
    for (int32_t s = 0; s < 4; s++) {
      patch->neighbour[s] = old.neighbour[(s + turn[p]) % 4];
      patch->neighbour_side[s] = old.neighbour_side[(s + turn[p]) % 4];
    }
  }
  for (int32_t side = 0; side < 4 * surface->n_patches; side++) {
    fs_patch *patch = &surface->patch[side / 4];
    int32_t q = patch->neighbour[side % 4];
    if (q != FS_NONE) patch->neighbour_side[side % 4] = (uint8_t)((patch->neighbour_side[side % 4] + 4 - turn[q]) % 4);
  }
}

/* Cuts a surface open along one side of a patch. */
static void cut(fs_surface *surface, int32_t p, int32_t s) {
  fs_patch *patch = &surface->patch[p];
  if (patch->neighbour[s] == FS_NONE) return;
  surface->patch[patch->neighbour[s]].neighbour[patch->neighbour_side[s]] = FS_NONE;
  patch->neighbour[s] = FS_NONE;
}

/* ---- splines, evaluated from their knots by de Boor's recursion ---- */

static double knot_of(fs_step_curve curve, int32_t k) {
  int32_t inner = k - curve.degree;
  return inner < 0 ? 0 : inner > curve.n_pieces ? curve.n_pieces : inner;
}

static fs_vec3 spline_point(fs_step_curve curve, const fs_vec3 *points, double t) {
  fs_vec3 d[FS_MAX_DEGREE + 1];
  int32_t n = curve.degree, span = (int32_t)t < curve.n_pieces ? (int32_t)t : curve.n_pieces - 1;
  for (int32_t i = 0; i <= n; i++) d[i] = points[span + i];
  for (int32_t r = 1; r <= n; r++)
    for (int32_t i = n; i >= r; i--) {
      double low = knot_of(curve, span + i), high = knot_of(curve, span + i + n + 1 - r), a = (t - low) / (high - low);
      d[i].x = (1 - a) * d[i - 1].x + a * d[i].x;
      d[i].y = (1 - a) * d[i - 1].y + a * d[i].y;
      d[i].z = (1 - a) * d[i - 1].z + a * d[i].z;
    }
  return d[n];
}

static double distance(fs_vec3 a, fs_vec3 b) { return hypot(hypot(a.x - b.x, a.y - b.y), a.z - b.z); }

/* Where a point of a cell lies in its patch. */
static fs_vec3 cell_point(const fs_surface *surface, int32_t cell, double u, double v) {
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t k = 0; k < cell % 4; k++) {
    double swap = u;
    u = 1 - v, v = swap;
  }
  fs_surface_evaluate(surface, cell / 4, u, v, x);
  return x[FS_D];
}

static void check_face(const fs_surface *surface, const fs_step_face *face) {
  fs_step_curve u, v;
  fs_vec3 *points = malloc((size_t)(face->n * face->m) * 100 * sizeof *points), column[100];
  fs_step_face_surface(surface, face, &u, &v, points);
  size_t n_u = (size_t)(u.degree + u.n_pieces);
  int32_t row = face->cell;
  for (int32_t b = 0; b < face->m; b++, row = fs_step_cross(surface, row, 2))
    for (int32_t a = 0, cell = row; a < face->n; a++, cell = fs_step_cross(surface, cell, 1))
      for (int32_t k = 0; k < 9; k++) {
        double s = k % 3 * 0.45, t = k / 3 * 0.37;
        for (size_t j = 0; j < (size_t)(v.degree + v.n_pieces); j++)
          column[j] = spline_point(u, points + n_u * j, a + s);
        assert_true(distance(spline_point(v, column, b + t), cell_point(surface, cell, s, t)) < 2e-15);
      }
  free(points);
}

static void check_edge(const fs_surface *surface, const fs_step_layout *layout, const fs_step_edge *edge,
                       const fs_vec3 *corner) {
  fs_vec3 points[200];
  fs_step_curve curve = fs_step_edge_curve(surface, edge, 1e-12, corner[edge->start], corner[edge->end], points);
  int32_t side = edge->first;
  assert_int_equal(curve.n_pieces, edge->n_sides);
  assert_int_equal(curve.degree, 3);
  assert_int_equal(layout->corner[edge->first], edge->start);
  for (int32_t k = 0; k < edge->n_sides; k++, side = fs_step_cross(surface, side, 1)) {
    for (int32_t i = 0; i <= 4; i++)
      assert_true(distance(spline_point(curve, points, k + i / 4.), cell_point(surface, side, i / 4., 0)) < 2e-15);
    if (k + 1 == edge->n_sides) assert_int_equal(layout->corner[side - side % 4 + (side + 1) % 4], edge->end);
  }
}

/* Faces are rectangles that cover each patch once; the border of each is closed and passes no corner twice; both faces of
   an edge run it whole, in opposite directions. Returns how many faces and, where asked for, edges there are. */
static int32_t check_layout(const fs_surface *surface, bool is_merging, int32_t *n_edges) {
  fs_context ctx = test_context();
  fs_step_layout *layout = NULL;
  fs_step_edges *edges = NULL;
  assert_int_equal(fs_step_layout_create(&ctx, surface, is_merging, 1e-12, &layout), FS_OK);
  assert_int_equal(fs_step_edges_create(&ctx, surface, layout, &edges), FS_OK);
  int32_t *seen = calloc((size_t)surface->n_patches, sizeof *seen), n_faces = layout->n_faces;
  int32_t *visit = calloc((size_t)layout->n_corners, sizeof *visit);
  int32_t *uses = calloc(2 * (size_t)edges->n_edges, sizeof *uses);
  fs_vec3 *corner = calloc((size_t)layout->n_corners, sizeof *corner);
  for (int32_t c = 0; c < 4 * surface->n_patches; c++) corner[layout->corner[c]] = fs_step_point(surface, c, 0, 0);
  for (int32_t f = 0; f < n_faces; f++) {
    const fs_step_face *face = &layout->face[f];
    int32_t row = face->cell, cell;
    for (int32_t b = 0; b < face->m; b++, row = fs_step_cross(surface, row, 2))
      for (int32_t a = 0, at = row; a < face->n; a++, at = fs_step_cross(surface, at, 1)) {
        seen[at / 4]++;
        assert_int_equal(layout->face_of[at / 4], f);
        assert_int_equal(layout->turn[at / 4], at % 4);
      }
    cell = face->cell;
    for (int32_t s = 0; s < 4; s++)
      for (int32_t k = 0, n = s % 2 == 0 ? face->n : face->m; k < n; k++) {
        int32_t side = fs_step_side(cell, s), use = edges->edge_of[side], at = layout->corner[side];
        assert_int_not_equal(use, FS_NONE);
        assert_int_not_equal(visit[at], f + 1);
        visit[at] = f + 1;
        uses[use]++;
        /* an edge goes around no corner of either face */
        if (k == 0) assert_int_equal(at, use % 2 == 0 ? edges->edge[use / 2].start : edges->edge[use / 2].end);
        if (k + 1 < n) cell = fs_step_cross(surface, cell, (s + 1) % 4);
      }
    assert_int_equal(cell, face->cell);
    check_face(surface, face);
  }
  for (int32_t p = 0; p < surface->n_patches; p++) assert_int_equal(seen[p], 1);
  for (int32_t e = 0; e < edges->n_edges; e++) {
    int32_t first = edges->edge[e].first;
    bool is_border = surface->patch[first / 4].neighbour[first % 4] == FS_NONE;
    assert_int_equal(uses[2 * e], edges->edge[e].n_sides);
    assert_int_equal(uses[2 * e + 1], is_border ? 0 : edges->edge[e].n_sides);
    check_edge(surface, layout, &edges->edge[e], corner);
  }
  if (n_edges != NULL) *n_edges = edges->n_edges;
  free(seen);
  free(visit);
  free(uses);
  free(corner);
  fs_step_edges_free(&ctx, edges);
  fs_step_layout_free(&ctx, layout);
  return n_faces;
}

static void test_a_torus_becomes_four_faces(void **state) {
  fs_surface *surface = sample_torus(12, 9, NULL, 0);
  uint64_t random = 5;
  (void)state;
  assert_int_equal(check_layout(surface, false, NULL), 108);
  assert_int_equal(check_layout(surface, true, NULL), 4);
  turn_patches(surface, &random);
  assert_int_equal(check_layout(surface, true, NULL), 4);
  sample_free(surface);
}

/* Cut open, the torus is a tube of two faces: four edges around, two along. */
static void test_borders_are_edges(void **state) {
  fs_surface *surface = sample_torus(12, 9, NULL, 0);
  int32_t n_edges = 0;
  (void)state;
  assert_int_equal(check_layout(surface, true, &n_edges), 4);
  assert_int_equal(n_edges, 8);
  for (int32_t i = 0; i < 12; i++) cut(surface, i, 0);
  assert_int_equal(check_layout(surface, true, &n_edges), 2);
  assert_int_equal(n_edges, 6);
  assert_int_equal(check_layout(surface, false, &n_edges), 108);
  assert_int_equal(n_edges, 2 * 108 + 12);
  sample_free(surface);
}

/* On a torus cut open to a square, 1e-3 max(0, U - 5)^2 max(0, V - 4)^3 is added to z: C2 in V, C1 in U where V > 4. */
static void test_rows_are_smooth_along_too(void **state) {
  enum { N = 12, M = 9, C = 5, R = 4 };
  fs_surface *surface = sample_torus(N, M, NULL, 0);
  (void)state;
  for (int32_t i = 0; i < N; i++) cut(surface, i, 0);
  for (int32_t j = 0; j < M; j++) cut(surface, N * j, 3);
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t k = 0; k < 16; k++) {
      int32_t i = k % 4, j = k / 4;
      double s = p % N - C, t = p / N - R, a, b = 1;
      if (s < 0 || t < 0) continue;
      /* blossoms: of (s + u)^2 seen as a cubic, and of (t + v)^3 */
      a = i == 0 ? s * s : i == 3 ? (s + 1) * (s + 1) : (2 * s * (s + 1) + (i == 1 ? s * s : (s + 1) * (s + 1))) / 3;
      for (int32_t l = 0; l < 3; l++) b *= l < j ? t + 1 : t;
      surface->data[surface->patch[p].data_start + 3 * (size_t)k + 2] += 1e-3 * a * b;
    }
  assert_in_range(check_layout(surface, true, NULL), 3, 4);
  sample_free(surface);
}

static void test_caps_stay_faces_of_their_own(void **state) {
  fs_surface *surface = sample_torus(12, 9, two_columns, 0.01);
  (void)state;
  assert_int_equal(check_layout(surface, true, NULL), 18 + 2);
  sample_free(surface);
}

static void test_patches_that_join_less_smoothly_stay_apart(void **state) {
  fs_surface *surface = sample_torus(12, 9, NULL, 0);
  (void)state;
  /* an inner point: patch 40 still meets its neighbours C0 everywhere; a face with it would not be exact */
  surface->data[surface->patch[40].data_start + 3 * 5] += 1e-9;
  assert_true(check_layout(surface, true, NULL) > 4);
  sample_free(surface);
}

/* Patches over the faces of a mesh of quads, all points at the origin: only their neighbourhood counts. */
static fs_surface *flat_surface(const fs_mesh *mesh) {
  fs_surface *surface = calloc(1, sizeof *surface);
  surface->n_patches = mesh->n_faces;
  surface->n_data = 48;
  surface->patch = calloc((size_t)mesh->n_faces, sizeof *surface->patch);
  surface->data = calloc(surface->n_data, sizeof *surface->data);
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    fs_patch *patch = &surface->patch[f];
    *patch = (fs_patch){.n_sides = 4, .degree_u = 3, .degree_v = 3, .face = f, .valence = 4};
    for (int32_t s = 0; s < 4; s++) {
      int32_t twin = mesh->twin[mesh->face_start[f] + s];
      patch->neighbour[s] = twin == FS_NONE ? FS_NONE : mesh->face[twin];
      if (twin != FS_NONE) patch->neighbour_side[s] = (uint8_t)(twin - mesh->face_start[mesh->face[twin]]);
    }
  }
  return surface;
}

/* Faces stay rectangles where 3, 5, 6 or 7 patches meet. */
static void test_irregular_points_end_rectangles(void **state) {
  (void)state;
  for (int32_t k = 3; k <= 8; k++) {
    fs_context ctx = test_context();
    fs_mesh *mesh = k == 8 ? test_cube() : test_star(k, 4);
    fs_surface *surface = flat_surface(mesh);
    uint64_t random = 3;
    for (int32_t trial = 0; trial < 5; trial++) {
      assert_true(check_layout(surface, true, NULL) < mesh->n_faces);
      if (trial % 2 == 0) cut(surface, test_random_integer(&random, 0, mesh->n_faces - 1), trial / 2);
    }
    sample_free(surface);
    fs_mesh_free(&ctx, mesh);
  }
}

/* Raised patches at random places, sides cut open, patches turned. */
static void test_random_layouts(void **state) {
  uint64_t random = 21;
  (void)state;
  for (int32_t trial = 0; trial < 60; trial++) {
    mask = test_random(&random) & test_random(&random) & test_random(&random);
    if (trial % 3 == 0) mask &= test_random(&random) & test_random(&random);
    int32_t n = test_random_integer(&random, 3, 14), m = test_random_integer(&random, 3, 11);
    fs_surface *surface = sample_torus(n, m, masked, 0.01);
    for (int32_t k = test_random_integer(&random, 0, 5) - 2; k > 0; k--)
      cut(surface, test_random_integer(&random, 0, n * m - 1), test_random_integer(&random, 0, 3));
    turn_patches(surface, &random);
    check_layout(surface, false, NULL);
    check_layout(surface, true, NULL);
    sample_free(surface);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_a_torus_becomes_four_faces),
      cmocka_unit_test(test_borders_are_edges),
      cmocka_unit_test(test_rows_are_smooth_along_too),
      cmocka_unit_test(test_caps_stay_faces_of_their_own),
      cmocka_unit_test(test_patches_that_join_less_smoothly_stay_apart),
      cmocka_unit_test(test_irregular_points_end_rectangles),
      cmocka_unit_test(test_random_layouts),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
