/* SPDX-License-Identifier: MIT */
/* Stacho's G1 surfaces: derivatives against differences, tangent planes along all edges of closed and open meshes, what is
   interpolated, spheres, flat data, refusals. */
#include <fairsurf/construct.h>
#include "math/bernstein.h"
#include "math/triangle.h"
#include "surface/stacho.h"
#include "stacho_samples.h"
#include <string.h>

/* Differences of order 4 of each derivative against the next. */
static void test_derivatives(void **state) {
  static const int8_t below[FS_JET_SIZE] = {-1, 0, 0, 1, 1, 2, 3, 3, 4, 5}; /* differentiated by u, or v where … */
  static const bool is_v[FS_JET_SIZE] = {0, 0, 1, 0, 1, 1, 0, 1, 1, 1};     /* … this says so */
  fs_context ctx = test_context();
  fs_mesh *mesh = icosahedron();
  fs_vec3 *normal = random_normals(mesh, 0.2, 4);
  const double h = 1e-3;
  (void)state;
  for (int variant = 0; variant < 6; variant++) {
    fs_surface *s =
        build(mesh, normal, NULL,
              (fs_stacho_options){.variant = (fs_stacho_variant)(variant % 3), .is_fixed_direction = variant >= 3});
    fs_vec3 x[FS_JET_SIZE], y[4][FS_JET_SIZE];
    fs_surface_evaluate(s, 3, 0.3, 0.45, x);
    for (int k = 1; k < FS_JET_SIZE; k++) {
      static const double step[4] = {-2, -1, 1, 2}, weight[4] = {1, -8, 8, -1};
      fs_vec3 sum = {0, 0, 0};
      for (int i = 0; i < 4; i++) {
        fs_surface_evaluate(s, 3, 0.3 + !is_v[k] * step[i] * h, 0.45 + is_v[k] * step[i] * h, y[i]);
        sum = fs_vec3_add_scaled(sum, y[i][below[k]], weight[i] / (12 * h));
      }
      if (!(fs_vec3_distance(sum, x[k]) <= 1e-7 * (1 + fs_vec3_length(x[k]))))
        fail_msg("derivative %d of variant %d: %g", k, variant, fs_vec3_distance(sum, x[k]));
    }
    fs_surface_free(&ctx, s);
  }
  free(normal);
  fs_mesh_free(&ctx, mesh);
}

static void check_mesh(const fs_mesh *mesh, const fs_vec3 *normal, double size) {
  fs_context ctx = test_context();
  for (int variant = 0; variant < 3; variant++)
    for (int tangent = 0; tangent < 3; tangent++)
      for (int fixed = 0; fixed < 2; fixed++) {
        fs_surface *s = build(mesh, normal, NULL,
                              (fs_stacho_options){(fs_stacho_variant)variant, (fs_stacho_tangent)tangent, fixed == 1});
        assert_smooth(s, size);
        for (int32_t h = 0; h < mesh->n_halfedges; h++) {
          fs_vec3 x[FS_JET_SIZE], n;
          side_point(s, h / 3, h % 3, 0, x, &n);
          assert_true(fs_vec3_distance(x[FS_D], mesh->position[mesh->origin[h]]) <= 1e-13 * size);
          assert_true(fs_vec3_distance(n, normal[mesh->origin[h]]) <= 1e-12);
        }
        fs_surface_free(&ctx, s);
      }
}

static void test_meshes(void **state) {
  fs_context ctx = test_context();
  uint64_t seed = 9;
  (void)state;
  for (int k = 0; k < 4; k++) {
    fs_mesh *mesh = k < 2 ? icosahedron() : triangulated(k == 2 ? test_torus(9, 7, 3, 1) : test_grid(3, 3, NULL));
    fs_vec3 *normal;
    if (k > 0) test_mesh_disturb(mesh, 0.1, &seed);
    normal = random_normals(mesh, 0.15, 5);
    check_mesh(mesh, normal, 4);
    free(normal);
    fs_mesh_free(&ctx, mesh);
  }
}

static void test_sphere(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = icosahedron();
  double shape[72], low = 2, high = 0;
  fs_vec3 x[FS_JET_SIZE], n;
  fs_geometry g;
  (void)state;
  assert_int_equal(fs_mesh_shape_tensors(&ctx, mesh, mesh->position, shape), FS_OK);
  for (int v = 0; v < 12; v++) { /* II = -(1 - n n^T) on the unit sphere */
    fs_vec3 p = mesh->position[v];
    const double exact[6] = {p.x * p.x - 1, p.x * p.y, p.x * p.z, p.y * p.y - 1, p.y * p.z, p.z * p.z - 1};
    vectors_agree("tensor on the sphere", 6, shape + 6 * v, exact, 1e-13);
  }
  fs_surface *s = build(mesh, NULL, NULL, (fs_stacho_options){.variant = FS_STACHO_SECOND_ORDER});
  for (int i = 0; i <= 20; i++)
    for (int j = 0; i + j <= 20; j++) {
      fs_surface_evaluate(s, 4, i / 20.0, j / 20.0, x);
      low = fmin(low, fs_vec3_length(x[FS_D])), high = fmax(high, fs_vec3_length(x[FS_D]));
    }
  assert_true(low > 0.9995 && low < 1 && high > 1 &&
              high < 1.0018); /* .9996 and 1.0017 in the table of docs/stacho.md */
  side_point(s, 4, 0, 0, x, &n);
  assert_true(fs_geometry_compute(x, &g));
  assert_true(fabs(g.K - 1) <= 1e-12 && fabs(g.H + 1) <= 1e-12);
  fs_surface_free(&ctx, s);
  s = build(mesh, NULL, NULL, (fs_stacho_options){.variant = FS_STACHO_FIRST_ORDER}); /* flat at the vertices */
  side_point(s, 4, 0, 0, x, &n);
  assert_true(fs_geometry_compute(x, &g));
  assert_true(fabs(g.K) <= 1e-12 && fabs(g.H) <= 1e-12);
  fs_surface_free(&ctx, s);
  fs_mesh_free(&ctx, mesh);
}

static void test_flat(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = triangulated(test_grid(3, 3, NULL));
  uint64_t seed = 2;
  (void)state;
  test_mesh_disturb(mesh, 0.2, &seed);
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].z = 0;
  for (int variant = 0; variant < 3; variant++) {
    fs_surface *s = build(mesh, NULL, NULL, (fs_stacho_options){.variant = (fs_stacho_variant)variant});
    double largest = 0;
    for (int32_t p = 0; p < s->n_patches; p++) {
      const int32_t *v = mesh->origin + 3 * p;
      fs_vec3 x[FS_JET_SIZE], linear = fs_vec3_scale(mesh->position[v[0]], 0.4);
      linear = fs_vec3_add_scaled(linear, mesh->position[v[1]], 0.25);
      linear = fs_vec3_add_scaled(linear, mesh->position[v[2]], 0.35);
      fs_surface_evaluate(s, p, 0.25, 0.35, x);
      assert_true(fabs(x[FS_D].z) <= 1e-14);
      largest = fmax(largest, fs_vec3_distance(x[FS_D], linear));
    }
    if (variant == FS_STACHO_QUINTIC)
      assert_true(largest > 1e-3);
    else
      assert_true(largest <= 1e-12);
    fs_surface_free(&ctx, s);
  }
  fs_mesh_free(&ctx, mesh);
}

static void test_similarity(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = icosahedron(), *moved;
  uint64_t seed = 12;
  (void)state;
  test_mesh_disturb(mesh, 0.15, &seed);
  assert_int_equal(fs_mesh_copy(&ctx, mesh, &moved), FS_OK);
  const double c = 0.6, s = 0.8, scale = 1.7;
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    fs_vec3 p = mesh->position[v];
    moved->position[v] = (fs_vec3){scale * (c * p.x - s * p.y) + 1, scale * p.z - 2, -scale * (s * p.x + c * p.y) + 3};
  }
  fs_surface *a = build(mesh, NULL, NULL, (fs_stacho_options){0}),
             *b = build(moved, NULL, NULL, (fs_stacho_options){0});
  for (int32_t p = 0; p < a->n_patches; p++) {
    fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE], q;
    fs_surface_evaluate(a, p, 0.3, 0.6, x);
    fs_surface_evaluate(b, p, 0.3, 0.6, y);
    q = x[FS_D];
    q = (fs_vec3){scale * (c * q.x - s * q.y) + 1, scale * q.z - 2, -scale * (s * q.x + c * q.y) + 3};
    assert_true(fs_vec3_distance(q, y[FS_D]) <= 1e-12);
  }
  fs_surface_free(&ctx, a);
  fs_surface_free(&ctx, b);
  fs_mesh_free(&ctx, mesh);
  fs_mesh_free(&ctx, moved);
}

static void test_threads(void **state) {
  fs_context one = test_context(), three = test_context();
  fs_mesh *mesh = triangulated(test_torus(24, 16, 3, 1));
  fs_surface *a, *b;
  (void)state;
  three.n_threads = 3;
  assert_int_equal(fs_stacho_surface(&one, mesh, NULL, NULL, NULL, &a), FS_OK);
  assert_int_equal(fs_stacho_surface(&three, mesh, NULL, NULL, NULL, &b), FS_OK);
  assert_memory_equal(a->data, b->data, a->n_data * sizeof *a->data);
  fs_surface_free(&one, a);
  fs_surface_free(&one, b);
  fs_mesh_free(&one, mesh);
}

/* ---- bad input ---- */

static void refuse(const fs_mesh *mesh, const fs_vec3 *normal, fs_status expected, const char *sentence) {
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  assert_int_equal(fs_stacho_surface(&ctx, mesh, normal, NULL, NULL, &s), expected);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" lacks \"%s\"", ctx.message, sentence);
  assert_null(s);
}

/* Curvatures as no surface of this size has, at random: two triangles come to lie on one side of their edge. */
static void test_folded_edges(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = icosahedron();
  fs_surface *s = NULL;
  double shape[72];
  uint64_t seed = 1;
  int n_folded = 0;
  (void)state;
  for (int repeat = 0; repeat < 20; repeat++) {
    for (int v = 0; v < 12; v++) { /* a w w^T with tangent w */
      fs_vec3 n = mesh->position[v], w = {test_random_real(&seed, -1, 1), test_random_real(&seed, -1, 1), 0};
      double a = test_random_real(&seed, -60, 60);
      w = fs_vec3_add_scaled(w, n, -fs_vec3_dot(w, n));
      const double tensor[6] = {a * w.x * w.x, a * w.x * w.y, a * w.x * w.z,
                                a * w.y * w.y, a * w.y * w.z, a * w.z * w.z};
      memcpy(shape + 6 * v, tensor, sizeof tensor);
    }
    fs_status status = fs_stacho_surface(&ctx, mesh, NULL, shape, NULL, &s);
    if (status == FS_OK) {
      fs_surface_free(&ctx, s);
      s = NULL;
      continue;
    }
    assert_int_equal(status, FS_ERR_NUMERIC);
    assert_non_null(strstr(ctx.message, "do not lie on opposite sides of the edge between vertices"));
    assert_null(s);
    n_folded++;
  }
  assert_true(n_folded > 0);
  fs_mesh_free(&ctx, mesh);
}

static void test_bad_input(void **state) {
  fs_context ctx = test_context();
  fs_mesh *cube = test_cube(), *mesh = icosahedron();
  fs_vec3 *normal = random_normals(mesh, 0, 0), kept, d;
  (void)state;
  refuse(cube, NULL, FS_ERR_UNSUPPORTED, "face 0 has 4 vertices");
  kept = normal[3];
  normal[3] = fs_vec3_scale(kept, 1.1);
  refuse(mesh, normal, FS_ERR_ARGUMENT, "the normal of vertex 3 has length 1.1 instead of 1");
  d = fs_vec3_sub(mesh->position[9], mesh->position[3]);
  normal[3] = fs_vec3_scale(d, 1 / fs_vec3_length(d));
  refuse(mesh, normal, FS_ERR_ARGUMENT, "is parallel to the normal at vertex 3");
  normal[3] = fs_vec3_scale(kept, -1);
  refuse(mesh, normal, FS_ERR_ARGUMENT, "at vertex 3 has no area, or shows its back");
  normal[3] = kept;
  mesh->position[3] = mesh->position[9];
  refuse(mesh, normal, FS_ERR_ARGUMENT, "has no length");
  fs_mesh_free(&ctx, cube);
  fs_mesh_free(&ctx, mesh);
  free(normal);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_derivatives), cmocka_unit_test(test_meshes),       cmocka_unit_test(test_sphere),
      cmocka_unit_test(test_flat),        cmocka_unit_test(test_similarity),   cmocka_unit_test(test_threads),
      cmocka_unit_test(test_bad_input),   cmocka_unit_test(test_folded_edges),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
