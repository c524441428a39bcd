/* SPDX-License-Identifier: MIT */
/* Mirror symmetries: planes that are given or found, meshes that have none, and the images of caps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fairsurf/surface.h"
#include "space/symmetry.h"
#include "support.h"

static double saddle(double x, double y) { return 0.1 * (x - 3) * (x - 3) - 0.05 * y * y; }

/* Moves a mesh by a rotation and a translation. */
static void move(fs_mesh *mesh) {
  double a = 0.7, b = 1.1;
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    fs_vec3 p = mesh->position[v], q = {cos(a) * p.x - sin(a) * p.y, sin(a) * p.x + cos(a) * p.y, p.z};
    mesh->position[v] = (fs_vec3){q.x + 0.3, cos(b) * q.y - sin(b) * q.z - 2, sin(b) * q.y + cos(b) * q.z + 5};
  }
}

/* Bezier points of images must be images, whatever the dofs are, to within tolerance. */
static void check_images(const fs_space *space, const fs_symmetry *s, const fs_vec3 *c, double tolerance) {
  fs_context ctx = test_context();
  fs_surface *surface = NULL;
  assert_int_equal(fs_surface_create(&ctx, space, c, &surface), FS_OK);
  for (int32_t e = 0; e < space->n_elements; e++) {
    assert_int_equal(s->element[s->element[e]], e);
    for (int k = 0; k < 9; k++) {
      double u = 0.125 + 0.25 * (k % 3), v = 0.25 * (k / 3), image_u, image_v;
      fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE], expected;
      fs_symmetry_parameters(s, e, u, v, &image_u, &image_v);
      fs_surface_evaluate(surface, e, u, v, x);
      fs_surface_evaluate(surface, s->element[e], image_u, image_v, y);
      expected = fs_symmetry_reflect(s, x[FS_D]);
      assert_true(fabs(expected.x - y[FS_D].x) <= tolerance && fabs(expected.y - y[FS_D].y) <= tolerance &&
                  fabs(expected.z - y[FS_D].z) <= tolerance);
    }
  }
  fs_surface_free(&ctx, surface);
}

/* After fs_surface_mirror the same to the last bit, derivatives included, for a coordinate plane through the origin. */
static void check_bits(const fs_space *space, const fs_symmetry *s, const fs_vec3 *c) {
  fs_context ctx = test_context();
  fs_surface *surface = NULL;
  int32_t n_rounded = 0;
  assert_int_equal(fs_surface_create(&ctx, space, c, &surface), FS_OK);
  for (int pass = 0; pass < 2; pass++) {
    if (pass == 1) assert_int_equal(fs_surface_mirror(&ctx, s, surface), FS_OK);
    for (int32_t e = 0; e < space->n_elements; e++)
      for (int k = 0; k < 81; k++) {
        double u = 0.125 * (k % 9), v = 0.125 * (k / 9), image_u, image_v;
        fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE], expected;
        fs_symmetry_parameters(s, e, u, v, &image_u, &image_v);
        fs_surface_evaluate(surface, e, u, v, x);
        fs_surface_evaluate(surface, s->element[e], image_u, image_v, y);
        expected = fs_symmetry_reflect(s, x[FS_D]);
        bool is_exact = expected.x == y[FS_D].x && expected.y == y[FS_D].y && expected.z == y[FS_D].z;
        if (pass == 1) assert_true(is_exact);
        n_rounded += !is_exact;
      }
  }
  assert_true(n_rounded > 0); /* without it the bits differ */
  fs_surface_free(&ctx, surface);
}

static void test_bits(void **state) {
  (void)state;
  static const fs_vec3 axis[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  fs_mesh *mesh[4] = {test_torus(10, 8, 3, 1), test_torus(9, 7, 3, 1), test_star(5, 4), test_star(3, 4)};
  for (int i = 0; i < 4; i++) {
    fs_context ctx = test_context();
    fs_space *space = NULL;
    fs_symmetry *s = NULL;
    for (int32_t v = 0; i > 1 && v < mesh[i]->n_vertices; v++)
      mesh[i]->position[v].z = hypot(mesh[i]->position[v].x, mesh[i]->position[v].y);
    assert_int_equal(fs_space_create(&ctx, mesh[i], &space), FS_OK);
    assert_int_equal(fs_symmetry_create(&ctx, mesh[i], space, &axis[1], 0, &s), FS_OK);
    fs_symmetry_apply(s, space->start);
    check_bits(space, s, space->start);
    for (int32_t v = 0; v < space->n_vertices; v++) {
      fs_vec3 p = space->start[v], q = space->start[s->vertex[v]];
      assert_true(p.x == q.x && p.y == -q.y && p.z == q.z);
    }
    fs_symmetry_free(&ctx, s);
    fs_space_free(&ctx, space);
    fs_context_clear(&ctx);
    fs_mesh_free(&ctx, mesh[i]);
  }
}

static void check_found(fs_mesh *mesh, const fs_vec3 *normal, double offset, const fs_vec3 *expected) {
  fs_context ctx = test_context();
  fs_space *space = NULL;
  fs_symmetry *s = NULL;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  assert_int_equal(fs_symmetry_create(&ctx, mesh, space, normal, offset, &s), FS_OK);
  if (expected != NULL)
    assert_true(fabs(s->normal.x - expected->x) + fabs(s->normal.y - expected->y) + fabs(s->normal.z - expected->z) ==
                0);
  check_images(space, s, space->start, 1e-12);
  fs_symmetry_free(&ctx, s);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  fs_mesh_free(&ctx, mesh);
}

static void test_given(void **state) {
  (void)state;
  const fs_vec3 x = {2, 0, 0}, unit = {1, 0, 0}, y = {0, 1, 0};
  check_found(test_grid(6, 5, saddle), &x, 6, &unit); /* through vertices */
  check_found(test_grid(6, 5, NULL), &y, 2.5, &y);    /* through faces */
  check_found(test_torus(9, 8, 3, 1), &y, 0, &y);
}

static void test_found(void **state) {
  (void)state;
  const fs_vec3 x = {1, 0, 0}, y = {0, 1, 0};
  fs_mesh *mesh;
  check_found(test_grid(6, 5, saddle), NULL, 0, &x);
  check_found(test_torus(9, 8, 3, 1), NULL, 0, &y);
  for (int32_t k = 3; k < 9; k++) {
    if (k == 4) continue;
    mesh = test_star(k, 4);
    for (int32_t v = 0; v < mesh->n_vertices; v++)
      mesh->position[v].z = 0.1 * pow(hypot(mesh->position[v].x, mesh->position[v].y), 2);
    move(mesh);
    check_found(mesh, NULL, 0, NULL);
  }
  mesh = test_grid(6, 5, saddle); /* one plane, in no special place */
  move(mesh);
  check_found(mesh, NULL, 0, NULL);
}

static void test_refused(void **state) {
  (void)state;
  fs_context ctx = test_context();
  fs_mesh *mesh = test_grid(6, 5, saddle);
  fs_space *space = NULL;
  fs_symmetry *s = NULL;
  const fs_vec3 x = {1, 0, 0}, zero = {0, 0, 0};
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  assert_int_equal(fs_symmetry_create(&ctx, mesh, space, &x, 2, &s), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "vertex 0 "));
  assert_int_equal(fs_symmetry_create(&ctx, mesh, space, &zero, 0, &s), FS_ERR_ARGUMENT);
  mesh->position[16].z += 0.01;
  assert_int_equal(fs_symmetry_create(&ctx, mesh, space, &x, 3, &s), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "vertex 16 "));
  mesh->position[19].z -= 0.02;
  assert_int_equal(fs_symmetry_create(&ctx, mesh, space, NULL, 0, &s), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "no plane of symmetry"));
  assert_null(s);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
}

/* Random inner coefficients and their images give mirror images of the caps. */
static void check_caps(int32_t k, fs_cap_inner caps) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(k, 4);
  fs_space *space = NULL;
  fs_symmetry *s = NULL;
  int32_t first[1];
  uint64_t seed = 5;
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].z = 0;
  assert_int_equal(fs_space_create_with(&ctx, mesh, &(fs_space_options){.caps = caps}, &space), FS_OK);
  assert_int_equal(fs_symmetry_create(&ctx, mesh, space, NULL, 0, &s), FS_OK);
  const fs_cap *cap = &space->cap[0];
  int32_t n = cap->n_dofs;
  double *M = malloc((size_t)n * (size_t)n * sizeof *M);
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
  fs_cap_elements(space, first);
  assert_int_equal(fs_symmetry_cap(&ctx, space, s, first, 0, 0, M), FS_OK);
  for (int32_t i = 0; i < n; i++) /* orthogonal, and its own inverse: reflecting twice changes nothing */
    for (int32_t j = 0; j < n; j++) {
      double product = 0, square = 0;
      for (int32_t l = 0; l < n; l++) {
        product += M[l * n + i] * M[l * n + j];
        square += M[i * n + l] * M[l * n + j];
      }
      assert_true(fabs(product - (i == j)) < 1e-9 && fabs(square - (i == j)) < 1e-9);
    }
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  for (int32_t i = 0; i < n; i++) {
    fs_vec3 p = {test_random_real(&seed, -1, 1), test_random_real(&seed, -1, 1), test_random_real(&seed, -1, 1)};
    fs_vec3 q = fs_plane_reflect(s->normal, 0, p);
    for (int32_t j = 0; j < n; j++) { /* (1 + M R) p is symmetric */
      fs_vec3 *to = &c[cap->first_dof + j];
      double same = i == j;
      to->x += same * p.x + M[j * n + i] * q.x;
      to->y += same * p.y + M[j * n + i] * q.y;
      to->z += same * p.z + M[j * n + i] * q.z;
    }
  }
  check_images(space, s, c, 1e-12);
  free(M), free(c);
  fs_symmetry_free(&ctx, s);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  fs_mesh_free(&ctx, mesh);
}

static void test_caps(void **state) {
  (void)state;
  check_caps(3, FS_CAPS_FULL);
  check_caps(5, FS_CAPS_FULL);
  check_caps(6, FS_CAPS_FULL);
  check_caps(8, FS_CAPS_SMOOTH);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_given), cmocka_unit_test(test_bits),
                                     cmocka_unit_test(test_found), cmocka_unit_test(test_refused),
                                     cmocka_unit_test(test_caps)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
