/* SPDX-License-Identifier: MIT */
/* Single role: tests of refinements against binomial masks of tensor B-splines, the formulas written out a second time
   over polygons, and known counts. */
#include "../support/support.h"

#include <fairsurf/refine.h>

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fs_refinement *refine(const fs_mesh *mesh, const char *name, double steps) {
  fs_context ctx = test_context();
  fs_refinement *refinement = NULL;
  fs_status status = fs_mesh_refine(&ctx, mesh, name, steps > 0 ? &steps : NULL, &refinement);
  if (status != FS_OK) fail_msg("%s", ctx.message);
  return refinement;
}

static void release(fs_mesh *mesh, fs_refinement *refinement) {
  fs_context ctx = test_context();
  fs_refinement_free(&ctx, refinement);
  fs_mesh_free(&ctx, mesh);
}

static double distance(fs_vec3 a, fs_vec3 b) { return fmax(fabs(a.x - b.x), fmax(fabs(a.y - b.y), fabs(a.z - b.z))); }

static int32_t euler(const fs_mesh *mesh) {
  int32_t n_edges = 0;
  for (int32_t h = 0; h < mesh->n_halfedges; h++) n_edges += mesh->twin[h] < h;
  return mesh->n_vertices - n_edges + mesh->n_faces;
}

/* The laws of every refinement: a valid mesh, rows that ascend and sum to 1, positions that are matrix times old ones. */
static void check_laws(const fs_mesh *mesh, const fs_refinement *r) {
  fs_context ctx = test_context();
  if (fs_mesh_validate(&ctx, r->mesh) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(r->n_coarse, mesh->n_vertices);
  assert_int_equal(r->row_start[0], 0);
  for (int32_t i = 0; i < r->mesh->n_vertices; i++) {
    double sum = 0;
    fs_vec3 p = {0, 0, 0};
    assert_true(r->row_start[i] < r->row_start[i + 1]);
    for (int32_t j = r->row_start[i]; j < r->row_start[i + 1]; j++) {
      fs_vec3 q = mesh->position[r->column[j]];
      assert_true(j == r->row_start[i] || r->column[j - 1] < r->column[j]);
      sum += r->weight[j];
      p = (fs_vec3){p.x + r->weight[j] * q.x, p.y + r->weight[j] * q.y, p.z + r->weight[j] * q.z};
    }
    assert_true(fabs(sum - 1) < 1e-14);
    assert_true(distance(p, r->mesh->position[i]) < 1e-13 * (1 + fabs(p.x) + fabs(p.y) + fabs(p.z)));
  }
}

static void test_laws_on_many_meshes(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 12; seed++)
    for (int32_t n = 0; n <= 16; n++) { /* 0: Catmull-Clark */
      fs_mesh *mesh = test_random_mesh(seed);
      fs_context ctx = test_context();
      double steps = n;
      fs_refinement *r = NULL;
      fs_status status = fs_mesh_refine(&ctx, mesh, n == 0 ? "catmull-clark" : "averaging", &steps, &r);
      bool closed = true;
      for (int32_t h = 0; h < mesh->n_halfedges; h++) closed = closed && mesh->twin[h] != FS_NONE;
      if (closed || n == 0) assert_int_equal(status, FS_OK);
      if (status == FS_OK) {
        check_laws(mesh, r);
        if (closed || n <= 1) assert_int_equal(euler(mesh), euler(r->mesh));
      } else {
        assert_int_equal(status, FS_ERR_UNSUPPORTED);
        assert_null(r);
      }
      release(mesh, r);
    }
}

static double binomial(int32_t n, int32_t k) {
  double b = 1;
  for (int32_t i = 0; i < k; i++) b = b * (n - i) / (i + 1);
  return b;
}

/* Weight of the old vertex at i in the new one at x: binomial(n + 1, k) / 2^n, k = 2 (x - i) + (n + 1) / 2. */
static double tensor_mask(int32_t n, double x, int32_t i) {
  double k = 2 * (x - i) + (n + 1) / 2.0;
  assert_true(fabs(k - round(k)) < 1e-9);
  return k < -0.5 || k > n + 1.5 ? 0 : binomial(n + 1, (int32_t)round(k)) / pow(2, n);
}

/* The grid lies at its own parameters, so the position of a new vertex says which mask it must have. */
static void test_masks_of_tensor_splines(void **state) {
  enum { NX = 9, NY = 8 };
  (void)state;
  for (int32_t n = 1; n <= 7; n++) {
    fs_mesh *mesh = test_grid(NX, NY, NULL);
    fs_refinement *r = refine(mesh, "averaging", n);
    int32_t lost = n / 2; /* layers of half width that are gone at each side */
    check_laws(mesh, r);
    assert_int_equal(r->mesh->n_faces, (2 * NX - (n - 1)) * (2 * NY - (n - 1)));
    assert_int_equal(r->mesh->n_vertices, (2 * NX + 2 - n) * (2 * NY + 2 - n));
    for (int32_t v = 0; v < r->mesh->n_vertices; v++) {
      fs_vec3 p = r->mesh->position[v];
      int32_t place = r->row_start[v];
      assert_true(p.x > lost / 2.0 - 0.3 && p.x < NX - lost / 2.0 + 0.3);
      for (int32_t j = 0; j <= NY; j++)
        for (int32_t i = 0; i <= NX; i++) {
          double expected = tensor_mask(n, p.x, i) * tensor_mask(n, p.y, j);
          if (expected == 0) continue;
          assert_true(place < r->row_start[v + 1]);
          assert_int_equal(r->column[place], i + (NX + 1) * j);
          assert_true(fabs(r->weight[place++] - expected) < 1e-14);
        }
      assert_int_equal(place, r->row_start[v + 1]);
    }
    release(mesh, r);
  }
}

/* The face behind edge (a, b), found by search: nothing of the half-edge structure is used here. */
static int32_t face_of(const fs_mesh *mesh, int32_t a, int32_t b) {
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    int32_t n = fs_mesh_face_size(mesh, f);
    const int32_t *corner = mesh->origin + mesh->face_start[f];
    for (int32_t j = 0; j < n; j++)
      if (corner[j] == a && corner[(j + 1) % n] == b) return f;
  }
  return FS_NONE;
}

static fs_vec3 combine(double s, fs_vec3 a, double t, fs_vec3 b) {
  return (fs_vec3){s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

static fs_vec3 centroid(const fs_mesh *mesh, int32_t f) {
  fs_vec3 sum = {0, 0, 0};
  int32_t n = fs_mesh_face_size(mesh, f);
  for (int32_t j = 0; j < n; j++) sum = combine(1, sum, 1.0 / n, mesh->position[mesh->origin[mesh->face_start[f] + j]]);
  return sum;
}

/* Sums over the faces around v: centroids, far ends of the edges that leave v; returns their number. */
static int32_t around(const fs_mesh *mesh, int32_t v, fs_vec3 *faces, fs_vec3 *ends) {
  int32_t count = 0;
  *faces = *ends = (fs_vec3){0, 0, 0};
  for (int32_t f = 0; f < mesh->n_faces; f++)
    for (int32_t j = 0, n = fs_mesh_face_size(mesh, f); j < n; j++) {
      const int32_t *corner = mesh->origin + mesh->face_start[f];
      if (corner[j] != v) continue;
      *faces = combine(1, *faces, 1, centroid(mesh, f));
      *ends = combine(1, *ends, 1, mesh->position[corner[(j + 1) % n]]);
      count++;
    }
  return count;
}

/* Three averagings on a closed mesh. Vertex: V / 2 + mean of neighbours / 4 + mean of centroids / 4. */
static fs_vec3 averaged_vertex(const fs_mesh *mesh, int32_t v) {
  fs_vec3 faces, ends;
  int32_t n = around(mesh, v, &faces, &ends);
  return combine(1, combine(0.5, mesh->position[v], 0.25 / n, ends), 0.25 / n, faces);
}

/* Mean of the four bilinear quadrilaterals around the middle of the edge, a corner each side of each end. */
static fs_vec3 averaged_edge(const fs_mesh *mesh, int32_t a, int32_t b) {
  fs_vec3 sum = {0, 0, 0}, middle = combine(0.5, mesh->position[a], 0.5, mesh->position[b]);
  for (int32_t side = 0; side < 2; side++) {
    int32_t p = side == 0 ? a : b, q = side == 0 ? b : a, f = face_of(mesh, p, q), n = fs_mesh_face_size(mesh, f);
    const int32_t *corner = mesh->origin + mesh->face_start[f];
    for (int32_t j = 0; j < n; j++) {
      if (corner[j] != p) continue;
      fs_vec3 before = combine(0.5, mesh->position[p], 0.5, mesh->position[corner[(j + n - 1) % n]]);
      fs_vec3 after = combine(0.5, mesh->position[q], 0.5, mesh->position[corner[(j + 2) % n]]);
      sum = combine(1, sum, 1,
                    combine(1, combine(1, mesh->position[p], 1, middle), 1, combine(1, centroid(mesh, f), 1, before)));
      sum = combine(1, sum, 1,
                    combine(1, combine(1, mesh->position[q], 1, middle), 1, combine(1, centroid(mesh, f), 1, after)));
    }
  }
  return combine(1.0 / 16, sum, 0, sum);
}

/* Mean over the corners of (v + midpoints before and after + centroid) / 4. */
static fs_vec3 averaged_face(const fs_mesh *mesh, int32_t f) {
  fs_vec3 sum = {0, 0, 0};
  int32_t n = fs_mesh_face_size(mesh, f);
  for (int32_t j = 0; j < n; j++) {
    const int32_t *corner = mesh->origin + mesh->face_start[f];
    fs_vec3 v = mesh->position[corner[j]], next = mesh->position[corner[(j + 1) % n]],
            previous = mesh->position[corner[(j + n - 1) % n]];
    fs_vec3 quad = combine(0.5, v, 0.125, next);
    quad = combine(1, combine(1, quad, 0.125, previous), 0.25, centroid(mesh, f));
    sum = combine(1, sum, 1.0 / n, quad);
  }
  return sum;
}

static fs_vec3 clark_vertex(const fs_mesh *mesh, int32_t v) {
  fs_vec3 faces, ends, middles;
  double n = around(mesh, v, &faces, &ends);
  middles = combine(n / 2, mesh->position[v], 0.5, ends);
  return combine(1, combine(1 / (n * n), faces, 2 / (n * n), middles), (n - 3) / n, mesh->position[v]);
}

static fs_vec3 clark_edge(const fs_mesh *mesh, int32_t a, int32_t b) {
  fs_vec3 faces = combine(1, centroid(mesh, face_of(mesh, a, b)), 1, centroid(mesh, face_of(mesh, b, a)));
  return combine(0.25, combine(1, mesh->position[a], 1, mesh->position[b]), 0.25, faces);
}

/* Vertices of the result are old vertices, edges by their first half-edge, faces. */
static void check_closed(const fs_mesh *mesh, bool is_clark) {
  fs_refinement *r = refine(mesh, is_clark ? "catmull-clark" : "averaging", 0);
  int32_t number = mesh->n_vertices;
  const fs_vec3 *p = r->mesh->position;
  check_laws(mesh, r);
  assert_int_equal(r->mesh->n_faces, mesh->n_halfedges);
  assert_int_equal(r->mesh->n_vertices, mesh->n_vertices + mesh->n_halfedges / 2 + mesh->n_faces);
  for (int32_t v = 0; v < mesh->n_vertices; v++)
    assert_true(distance(p[v], is_clark ? clark_vertex(mesh, v) : averaged_vertex(mesh, v)) < 1e-14);
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    int32_t a = mesh->origin[h], b = fs_mesh_target(mesh, h);
    if (mesh->twin[h] < h) continue;
    assert_true(distance(p[number++], is_clark ? clark_edge(mesh, a, b) : averaged_edge(mesh, a, b)) < 1e-14);
  }
  for (int32_t f = 0; f < mesh->n_faces; f++)
    assert_true(distance(p[number++], is_clark ? centroid(mesh, f) : averaged_face(mesh, f)) < 1e-14);
  release(NULL, r);
}

static void test_formulas_on_closed_meshes(void **state) {
  uint64_t random = 7;
  (void)state;
  for (int32_t k = 3; k <= 8; k++) {
    fs_mesh *mesh = k == 8 ? test_torus(7, 5, 2, 0.7) : k == 4 ? test_cube() : test_prism(k);
    test_mesh_disturb(mesh, 0.2, &random);
    check_closed(mesh, false);
    check_closed(mesh, true);
    release(mesh, NULL);
  }
}

static void test_cube_by_catmull_clark(void **state) {
  fs_mesh *mesh = test_cube();
  fs_refinement *r = refine(mesh, "catmull-clark", 0);
  (void)state;
  for (int32_t v = 0; v < 8; v++) {
    fs_vec3 p = mesh->position[v], q = r->mesh->position[v];
    assert_true(distance(q, combine(5.0 / 9, p, 0, p)) < 1e-15);
  }
  for (int32_t v = 8; v < 20; v++) { /* an edge of the cube keeps one coordinate 0, the others go to 3 / 4 */
    fs_vec3 q = r->mesh->position[v];
    assert_true(fabs(fabs(q.x) + fabs(q.y) + fabs(q.z) - 1.5) < 1e-15);
  }
  assert_int_equal(r->mesh->n_vertices, 26);
  assert_int_equal(r->mesh->n_faces, 24);
  release(mesh, r);
}

/* The row of a new vertex as a dense vector. */
static void dense_row(const fs_refinement *r, int32_t v, double *row) {
  memset(row, 0, (size_t)r->n_coarse * sizeof *row);
  for (int32_t j = r->row_start[v]; j < r->row_start[v + 1]; j++) row[r->column[j]] = r->weight[j];
}

/* Face h has the corners of half-edge h in both, from any of them on. */
static bool is_same_face(const fs_mesh *a, const fs_mesh *b, int32_t f) {
  const int32_t *p = a->origin + a->face_start[f], *q = b->origin + b->face_start[f];
  for (int32_t shift = 0; shift < 4; shift++)
    if (p[0] == q[shift] && p[1] == q[(shift + 1) % 4] && p[2] == q[(shift + 2) % 4] && p[3] == q[(shift + 3) % 4])
      return true;
  return false;
}

static void test_regular_mesh_is_refined_alike(void **state) {
  fs_mesh *mesh = test_torus(6, 5, 2, 0.5);
  fs_refinement *a = refine(mesh, "averaging", 3), *c = refine(mesh, "catmull-clark", 0);
  double p[30], q[30];
  (void)state;
  assert_int_equal(mesh->n_vertices, 30);
  assert_int_equal(a->mesh->n_vertices, c->mesh->n_vertices);
  for (int32_t v = 0; v < a->mesh->n_vertices; v++) {
    dense_row(a, v, p);
    dense_row(c, v, q);
    for (int32_t i = 0; i < 30; i++) assert_true(fabs(p[i] - q[i]) < 1e-15);
  }
  for (int32_t f = 0; f < a->mesh->n_faces; f++) assert_true(is_same_face(a->mesh, c->mesh, f));
  fs_refinement_free(&(fs_context){0}, a);
  release(mesh, c);
}

/* On the rim of the grid: midpoints, and 1/8, 3/4, 1/8 at every vertex, corners included. */
static void test_boundary_of_catmull_clark(void **state) {
  enum { NX = 3, NY = 2 };
  fs_mesh *mesh = test_grid(NX, NY, NULL);
  fs_refinement *r = refine(mesh, "catmull-clark", 0);
  double row[(NX + 1) * (NY + 1)];
  (void)state;
  check_laws(mesh, r);
  assert_int_equal(r->mesh->n_faces, 4 * NX * NY);
  dense_row(r, 1, row);
  assert_true(row[0] == 0.125 && row[1] == 0.75 && row[2] == 0.125);
  dense_row(r, 0, row); /* the corner has its neighbours on two sides */
  assert_true(row[0] == 0.75 && row[1] == 0.125 && row[NX + 1] == 0.125);
  for (int32_t v = mesh->n_vertices; v < r->mesh->n_vertices; v++) {
    fs_vec3 p = r->mesh->position[v];
    if (!fs_mesh_is_boundary(r->mesh, v)) continue;
    assert_int_equal(r->row_start[v + 1] - r->row_start[v], 2);
    assert_true(r->weight[r->row_start[v]] == 0.5);
    assert_true(p.x == 0 || p.x == NX || p.y == 0 || p.y == NY);
  }
  release(mesh, r);
}

/* 3 x 3 quadrilaterals without two opposite corners: the middle one has inner vertices at two opposite corners only, and
   three averagings would leave two blocks of 2 x 2 that touch in one vertex. */
static void test_bow_tie_is_split(void **state) {
  static const int32_t kept[7][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {2, 1}, {1, 2}, {2, 2}};
  fs_vec3 position[14];
  int32_t number[16], face_start[8], corner[28], n_vertices = 0;
  fs_mesh *mesh;
  fs_refinement *r;
  fs_mesh_summary summary;
  fs_context ctx = test_context();
  (void)state;
  for (int32_t i = 0; i < 16; i++) {
    number[i] = i == 3 || i == 12 ? FS_NONE : n_vertices;
    if (number[i] != FS_NONE) position[n_vertices++] = (fs_vec3){i % 4, i / 4, 0};
  }
  for (int32_t f = 0; f < 7; f++) {
    int32_t v = kept[f][0] + 4 * kept[f][1], of[4] = {v, v + 1, v + 5, v + 4};
    for (int32_t j = 0; j < 4; j++) corner[4 * f + j] = number[of[j]];
    face_start[f] = 4 * f;
  }
  face_start[7] = 28;
  mesh = test_mesh(n_vertices, position, 7, face_start, corner);
  r = refine(mesh, "averaging", 3);
  check_laws(mesh, r);
  assert_int_equal(r->mesh->n_vertices, 18);
  assert_int_equal(r->mesh->n_faces, 8);
  assert_int_equal(fs_mesh_summarise(&ctx, r->mesh, &summary), FS_OK);
  assert_int_equal(summary.n_components, 2);
  release(mesh, r);
}

static void test_trojnik3(void **state) {
  fs_mesh *mesh = test_shared_mesh("trojnik3");
  fs_refinement *r;
  (void)state;
  if (mesh == NULL) skip();
  assert_int_equal(mesh->n_vertices, 359);
  assert_int_equal(mesh->n_faces, 336);
  r = refine(mesh, "averaging", 3);
  check_laws(mesh, r);
  assert_int_equal(r->mesh->n_vertices, 1295);
  assert_int_equal(r->mesh->n_faces, 1248);
  release(mesh, r);
}

static void test_marks(void **state) {
  fs_mesh *mesh = test_grid(4, 4, NULL);
  fs_refinement *r = refine(mesh, "averaging", 1);
  bool coarse[25] = {0}, *fine = calloc((size_t)r->mesh->n_vertices, sizeof *fine);
  (void)state;
  for (int32_t v = 0; v < 25; v++) coarse[v] = v % 5 <= 2; /* x <= 2 */
  fs_refinement_marks(r, coarse, fine);
  for (int32_t v = 0; v < r->mesh->n_vertices; v++) assert_int_equal(fine[v], r->mesh->position[v].x <= 2);
  free(fine);
  release(mesh, r);
}

static void check_refused(const fs_mesh *mesh, const char *name, double steps, fs_status expected, const char *word) {
  fs_context ctx = test_context();
  fs_refinement *r = NULL;
  assert_int_equal(fs_mesh_refine(&ctx, mesh, name, &steps, &r), expected);
  if (strstr(ctx.message, word) == NULL) fail_msg("\"%s\" does not say \"%s\"", ctx.message, word);
  assert_null(r);
}

static void test_refusals(void **state) {
  static const int32_t start[] = {0, 3, 6}, corner[] = {0, 1, 2, 2, 1, 0};
  static const fs_vec3 position[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  fs_mesh *pillow = test_mesh(3, position, 2, start, corner), *quad = test_grid(1, 1, NULL);
  (void)state;
  check_refused(quad, "loop", 3, FS_ERR_UNSUPPORTED, "averaging, catmull-clark");
  check_refused(quad, "averaging", 0, FS_ERR_ARGUMENT, "averagings");
  check_refused(quad, "averaging", 17, FS_ERR_ARGUMENT, "averagings");
  check_refused(quad, "averaging", 2.5, FS_ERR_ARGUMENT, "whole");
  check_refused(quad, "averaging", NAN, FS_ERR_ARGUMENT, "averagings");
  check_refused(quad, "averaging", 3, FS_ERR_UNSUPPORTED, "no face");
  check_refused(pillow, "averaging", 3, FS_ERR_UNSUPPORTED, "vertex 0");
  release(NULL, refine(quad, "averaging", 2));
  release(pillow, refine(pillow, "catmull-clark", 0));
  release(quad, NULL);
}

static void test_every_allocation_may_fail(void **state) {
  fs_mesh *mesh = test_star(5, 3);
  double steps = 4;
  (void)state;
  for (int32_t which = 0; which < 2; which++)
    for (int64_t n = 1;; n++) {
      struct test_memory memory = {.fail_at = n};
      fs_context ctx = test_memory_context(&memory);
      fs_refinement *r = NULL;
      fs_status status = fs_mesh_refine(&ctx, mesh, which == 0 ? "averaging" : "catmull-clark", &steps, &r);
      if (status == FS_OK) fs_refinement_free(&ctx, r);
      assert_int_equal(memory.n_live, 0);
      if (status == FS_OK) {
        assert_true(n > 15);
        break;
      }
      assert_int_equal(status, FS_ERR_MEMORY);
      assert_null(r);
    }
  release(mesh, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_laws_on_many_meshes),
      cmocka_unit_test(test_masks_of_tensor_splines),
      cmocka_unit_test(test_formulas_on_closed_meshes),
      cmocka_unit_test(test_cube_by_catmull_clark),
      cmocka_unit_test(test_regular_mesh_is_refined_alike),
      cmocka_unit_test(test_boundary_of_catmull_clark),
      cmocka_unit_test(test_bow_tie_is_split),
      cmocka_unit_test(test_trojnik3),
      cmocka_unit_test(test_marks),
      cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_every_allocation_may_fail),
  };
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  if (failed == 0 && getenv("FAIRSURF_SHARED") == NULL) {
    fprintf(stderr, "FAIRSURF_SHARED is not set: trojnik3 was skipped\n");
    return TEST_SKIPPED;
  }
  return failed;
}
