/* SPDX-License-Identifier: MIT */
/* Single role: meshes from arrays: half-edges, every refusal, counts, failing allocations. */
#include "support.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

/* Polygons as {size, vertices …, size, vertices …, 0}, put into the arrays of fs_mesh_create. */
struct polygons {
  int32_t n_vertices, n_faces, face_start[32], corner[128];
  fs_vec3 position[64];
};

static struct polygons polygons(int32_t n_vertices, const int32_t *list) {
  struct polygons p = {.n_vertices = n_vertices};
  int32_t n = 0;
  while (*list > 0) {
    int32_t size = *list++;
    for (int32_t i = 0; i < size; i++) p.corner[n++] = *list++;
    p.face_start[++p.n_faces] = n;
  }
  for (int32_t v = 0; v < n_vertices; v++) p.position[v] = (fs_vec3){v, v * v, 1};
  return p;
}

static fs_status create(fs_context *ctx, const struct polygons *p, fs_mesh **mesh) {
  return fs_mesh_create(ctx, p->n_vertices, p->position, p->n_faces, p->face_start, p->corner, mesh);
}

static void assert_refused(const struct polygons *p, fs_status expected, const char *message) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_mesh marker, *mesh = &marker;
  assert_int_equal(create(&ctx, p, &mesh), expected);
  assert_string_equal(ctx.message, message);
  assert_ptr_equal(mesh, &marker);
  assert_int_equal(memory.n_live, 0);
}

static void test_half_edges(void **state) {
  /* two triangles: 0 1 2 and 2 1 3, so that the edge 1-2 is inside */
  static const int32_t twin[] = {FS_NONE, 3, FS_NONE, 1, FS_NONE, FS_NONE};
  static const int32_t face[] = {0, 0, 0, 1, 1, 1}, outgoing[] = {0, 4, 2, 5}, valence[] = {2, 3, 3, 2};
  struct polygons p = polygons(4, (int32_t[]){3, 0, 1, 2, 3, 2, 1, 3, 0});
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  (void)state;
  assert_int_equal(create(&ctx, &p, &mesh), FS_OK);
  assert_int_equal(mesh->n_vertices, 4);
  assert_int_equal(mesh->n_faces, 2);
  assert_int_equal(mesh->n_halfedges, 6);
  assert_memory_equal(mesh->twin, twin, sizeof twin);
  assert_memory_equal(mesh->face, face, sizeof face);
  assert_memory_equal(mesh->outgoing, outgoing, sizeof outgoing);
  assert_memory_equal(mesh->origin, p.corner, sizeof twin);
  assert_memory_equal(mesh->position, p.position, 4 * sizeof(fs_vec3));
  for (int32_t v = 0; v < 4; v++) assert_int_equal(fs_mesh_valence(mesh, v), valence[v]);
  assert_int_equal(fs_mesh_rotate(mesh, 4), 1); /* at vertex 1, anticlockwise from the boundary: 1-3, 1-2, 1-0 */
  assert_int_equal(fs_mesh_rotate(mesh, 1), FS_NONE);
  assert_int_equal(fs_mesh_validate(&ctx, mesh), FS_OK);
  fs_mesh_free(&ctx, mesh);
}

static void test_refusals(void **state) {
  static const struct {
    int32_t n_vertices, list[40];
    fs_status status;
    const char *message;
  } cases[] = {
      {3, {0}, FS_ERR_ARGUMENT, "a mesh of 3 vertices and 0 faces is none: it needs at least one face"},
      {0, {0}, FS_ERR_ARGUMENT, "a mesh of 0 vertices and 0 faces is none: it needs at least one face"},
      {2, {2, 0, 1, 0}, FS_ERR_TOPOLOGY, "face 0 has 2 vertices, but a face needs 3 or more"},
      {3, {3, 0, 1, 3, 0}, FS_ERR_ARGUMENT, "face 0 uses vertex 3, but there are only 3"},
      {3, {3, 0, 1, -1, 0}, FS_ERR_ARGUMENT, "face 0 uses vertex -1, but there are only 3"},
      {5, {3, 0, 1, 2, 4, 2, 3, 4, 2, 0}, FS_ERR_TOPOLOGY, "face 1 repeats vertex 2"},
      {4, {3, 0, 1, 3, 0}, FS_ERR_TOPOLOGY, "vertex 2 belongs to no face"},
      {5,
       {3, 0, 1, 2, 3, 1, 0, 3, 3, 0, 1, 4, 0},
       FS_ERR_TOPOLOGY,
       "non-manifold edge between vertices 0 and 1 (faces 0, 1, 2)"},
      {7,
       {3, 2, 6, 0, 3, 3, 0, 6, 3, 6, 0, 4, 3, 6, 0, 5, 3, 1, 6, 0, 0},
       FS_ERR_TOPOLOGY,
       "non-manifold edge between vertices 0 and 6 (faces 0, 1, 2 and 2 more)"},
      {4,
       {3, 0, 1, 2, 3, 0, 1, 3, 0},
       FS_ERR_TOPOLOGY,
       "faces 0 and 1 run along the edge between vertices 0 and 1 in the same direction: their orientations disagree"},
      {5, {3, 0, 1, 2, 3, 0, 3, 4, 0}, FS_ERR_TOPOLOGY, "vertex 0 is a bow-tie: 2 fans of faces meet there"},
      {7,
       {3, 1, 0, 2, 3, 0, 3, 4, 3, 5, 6, 0, 0},
       FS_ERR_TOPOLOGY,
       "vertex 0 is a bow-tie: 3 fans of faces meet there"},
      /* two closed tetrahedra with one vertex in common */
      {7,
       {3, 0, 1, 2, 3, 0, 2, 3, 3, 0, 3, 1, 3, 1, 3, 2, 3, 4, 5, 3, 3, 4, 3, 6, 3, 4, 6, 5, 3, 5, 6, 3, 0},
       FS_ERR_TOPOLOGY,
       "vertex 3 is a bow-tie: 2 fans of faces meet there"},
  };
  (void)state;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    struct polygons p = polygons(cases[i].n_vertices, cases[i].list);
    assert_refused(&p, cases[i].status, cases[i].message);
  }
}

static void test_refused_arrays(void **state) {
  struct polygons p = polygons(4, (int32_t[]){3, 0, 1, 2, 3, 2, 1, 3, 0});
  (void)state;
  p.position[2].y = NAN;
  assert_refused(&p, FS_ERR_ARGUMENT, "vertex 2 has a coordinate that is not finite");
  p.position[2].y = 1;
  p.position[3].z = -INFINITY;
  assert_refused(&p, FS_ERR_ARGUMENT, "vertex 3 has a coordinate that is not finite");
  p.position[3].z = 1;
  p.face_start[0] = 1;
  assert_refused(&p, FS_ERR_ARGUMENT, "the corners of face 0 start at 1 instead of 0");
  p.face_start[0] = 0;
  p.face_start[2] = 2;
  assert_refused(&p, FS_ERR_ARGUMENT, "the corners of face 1 end before they start");
}

/* Anything else than what fs_mesh_create made is found. */
static void test_validate(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_grid(2, 2, NULL);
  int32_t *arrays[] = {mesh->face, mesh->twin, mesh->outgoing, mesh->origin};
  int32_t sizes[] = {mesh->n_halfedges, mesh->n_halfedges, mesh->n_vertices, mesh->n_halfedges};
  (void)state;
  assert_int_equal(fs_mesh_validate(&ctx, mesh), FS_OK);
  for (int a = 0; a < 4; a++)
    for (int32_t i = 0; i < sizes[a]; i++) {
      int32_t kept = arrays[a][i];
      for (int32_t wrong = -2; wrong <= mesh->n_halfedges; wrong++) {
        if (wrong == kept) continue;
        if (a == 2 && wrong >= 0 && wrong < mesh->n_halfedges && mesh->origin[wrong] == i &&
            !fs_mesh_is_boundary(mesh, i))
          continue; /* an interior vertex may keep any of its half-edges */
        arrays[a][i] = wrong;
        assert_int_not_equal(fs_mesh_validate(&ctx, mesh), FS_OK);
        arrays[a][i] = kept;
      }
    }
  mesh->n_halfedges--;
  assert_int_equal(fs_mesh_validate(&ctx, mesh), FS_ERR_ARGUMENT);
  mesh->n_halfedges++;
  assert_int_equal(fs_mesh_validate(&ctx, mesh), FS_OK);
  fs_mesh_free(&ctx, mesh);
}

static fs_mesh_summary summarise(fs_mesh *mesh) {
  fs_context ctx = test_context();
  fs_mesh_summary s;
  assert_int_equal(fs_mesh_validate(&ctx, mesh), FS_OK);
  assert_int_equal(fs_mesh_summarise(&ctx, mesh, &s), FS_OK);
  fs_mesh_free(&ctx, mesh);
  return s;
}

static void test_summaries(void **state) {
  fs_mesh_summary s = summarise(test_cube());
  (void)state;
  assert_int_equal(s.n_vertices, 8);
  assert_int_equal(s.n_edges, 12);
  assert_int_equal(s.n_quads, 6);
  assert_int_equal(s.valence_interior[3], 8);
  assert_int_equal(s.n_boundary_loops, 0);
  assert_int_equal(s.genus, 0);
  assert_true(s.min.x == -1 && s.min.y == -1 && s.min.z == -1 && s.max.x == 1 && s.max.y == 1 && s.max.z == 1);

  s = summarise(test_torus(5, 7, 3, 1));
  assert_int_equal(s.n_edges, 70);
  assert_int_equal(s.valence_interior[4], 35);
  assert_int_equal(s.genus, 1);
  assert_int_equal(s.n_components, 1);

  s = summarise(test_grid(3, 5, NULL));
  assert_int_equal(s.n_edges, 3 * 6 + 4 * 5);
  assert_int_equal(s.n_boundary_loops, 1);
  assert_int_equal(s.n_boundary_vertices, 16);
  assert_int_equal(s.valence_boundary[2], 4);
  assert_int_equal(s.valence_boundary[3], 12);
  assert_int_equal(s.valence_interior[4], 8);
  assert_true(s.max.x == 3 && s.max.y == 5 && s.max.z == 0);

  s = summarise(test_star(30, 2));
  assert_int_equal(s.n_vertices, 181);
  assert_int_equal(s.valence_interior[25], 1); /* the last number takes all that are larger */
  assert_int_equal(s.valence_boundary[2], 30);

  s = summarise(test_prism(30));
  assert_int_equal(s.face_size[25], 2);
  assert_int_equal(s.n_quads, 30);
  assert_int_equal(s.valence_interior[3], 60);
}

/* A torus beside a band with two boundary loops: genus is summed over components. */
static void test_components(void **state) {
  fs_context ctx = test_context();
  fs_mesh *torus = test_torus(3, 3, 3, 1), *mesh = NULL;
  struct polygons p = {.n_vertices = 9 + 6, .n_faces = 9 + 3};
  fs_mesh_summary s;
  (void)state;
  memcpy(p.corner, torus->origin, 36 * sizeof *p.corner);
  for (int32_t i = 0; i < 3; i++)
    memcpy(p.corner + 36 + 4 * i, (int32_t[]){9 + i, 9 + (i + 1) % 3, 12 + (i + 1) % 3, 12 + i}, 4 * sizeof *p.corner);
  for (int32_t f = 0; f <= p.n_faces; f++) p.face_start[f] = 4 * f;
  assert_int_equal(create(&ctx, &p, &mesh), FS_OK);
  assert_int_equal(fs_mesh_summarise(&ctx, mesh, &s), FS_OK);
  assert_int_equal(s.n_components, 2);
  assert_int_equal(s.n_boundary_loops, 2);
  assert_int_equal(s.genus, 1);
  fs_mesh_free(&ctx, torus);
  fs_mesh_free(&ctx, mesh);
}

/* Two sides of one polygon are a closed manifold, with vertices of valence 2. */
static void test_pillow(void **state) {
  struct polygons p = polygons(3, (int32_t[]){3, 0, 1, 2, 3, 2, 1, 0, 0});
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  fs_mesh_summary s;
  (void)state;
  assert_int_equal(create(&ctx, &p, &mesh), FS_OK);
  s = summarise(mesh);
  assert_int_equal(s.valence_interior[2], 3);
  assert_int_equal(s.genus, 0);
}

/* The hub of a fan of many triangles: quick whatever the valence. */
static void test_large_valence(void **state) {
  enum { K = 200000 };
  fs_vec3 *position = test_calloc(K + 1, sizeof *position);
  int32_t *face_start = test_calloc(K + 1, sizeof *face_start), *corner = test_calloc(3 * K, sizeof *corner);
  fs_mesh *mesh;
  (void)state;
  for (int32_t i = 0; i < K; i++) {
    face_start[i + 1] = 3 * i + 3;
    corner[3 * i] = K;
    corner[3 * i + 1] = i;
    corner[3 * i + 2] = (i + 1) % K;
  }
  mesh = test_mesh(K + 1, position, K, face_start, corner);
  assert_int_equal(fs_mesh_valence(mesh, K), K);
  assert_int_equal(summarise(mesh).n_boundary_loops, 1);
  test_free(position);
  test_free(face_start);
  test_free(corner);
}

static void test_random_meshes(void **state) {
  (void)state;
  for (uint64_t seed = 0; seed < 200; seed++) {
    fs_context ctx = test_context();
    fs_mesh *mesh = test_random_mesh(seed), *copy = NULL;
    fs_mesh_summary s;
    int32_t sum = 0;
    assert_int_equal(fs_mesh_copy(&ctx, mesh, &copy), FS_OK);
    assert_int_equal(fs_mesh_validate(&ctx, copy), FS_OK);
    assert_memory_equal(copy->position, mesh->position, (size_t)mesh->n_vertices * sizeof *mesh->position);
    assert_memory_equal(copy->outgoing, mesh->outgoing, (size_t)mesh->n_vertices * sizeof *mesh->outgoing);
    for (int32_t v = 0; v < mesh->n_vertices; v++) sum += fs_mesh_valence(mesh, v);
    s = summarise(copy);
    assert_int_equal(sum, 2 * s.n_edges); /* every edge has two ends */
    assert_int_equal(s.n_vertices - s.n_edges + s.n_faces, 2 - 2 * s.genus - s.n_boundary_loops);
    fs_mesh_free(&ctx, mesh);
  }
}

static fs_status create_copy_validate(fs_context *ctx, const fs_mesh *source, fs_mesh **mesh,
                                      fs_mesh_summary *summary) {
  fs_mesh *first = NULL;
  fs_status status = fs_mesh_create(ctx, source->n_vertices, source->position, source->n_faces, source->face_start,
                                    source->origin, &first);
  if (status == FS_OK) status = fs_mesh_validate(ctx, first);
  if (status == FS_OK) status = fs_mesh_summarise(ctx, first, summary);
  if (status == FS_OK) status = fs_mesh_copy(ctx, first, mesh);
  fs_mesh_free(ctx, first);
  return status;
}

static void test_failing_allocations(void **state) {
  fs_context plain = test_context();
  fs_mesh *source = test_star(5, 2);
  fs_status status = FS_ERR_MEMORY;
  int64_t n = 0;
  (void)state;
  while (status != FS_OK) {
    struct test_memory memory = {.fail_at = ++n};
    fs_context ctx = test_memory_context(&memory);
    fs_mesh marker, *mesh = &marker;
    fs_mesh_summary summary = {.genus = -7};
    status = create_copy_validate(&ctx, source, &mesh, &summary);
    if (status == FS_OK) {
      fs_mesh_free(&ctx, mesh);
    } else {
      assert_int_equal(status, FS_ERR_MEMORY);
      assert_non_null(strstr(ctx.message, "out of memory"));
      assert_ptr_equal(mesh, &marker);
    }
    assert_int_equal(memory.n_live, 0);
  }
  assert_true(n > 30); /* each of some 35 allocations failed once */
  fs_mesh_free(&plain, source);
}

static void test_free_null(void **state) {
  fs_context ctx = test_context();
  (void)state;
  fs_mesh_free(&ctx, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_half_edges),     cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_refused_arrays), cmocka_unit_test(test_validate),
      cmocka_unit_test(test_summaries),      cmocka_unit_test(test_components),
      cmocka_unit_test(test_pillow),         cmocka_unit_test(test_large_valence),
      cmocka_unit_test(test_random_meshes),  cmocka_unit_test(test_failing_allocations),
      cmocka_unit_test(test_free_null),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
