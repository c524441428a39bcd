/* SPDX-License-Identifier: MIT */
/* Nearest points: on meshes against all triangles, on surfaces against dense samples and against where the point came from. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fairsurf/surface.h"
#include "support.h"

static double distance(fs_vec3 a, fs_vec3 b) { return hypot(hypot(a.x - b.x, a.y - b.y), a.z - b.z); }

static fs_vec3 random_point(uint64_t *seed, double size) {
  return (fs_vec3){test_random_real(seed, -size, size), test_random_real(seed, -size, size),
                   test_random_real(seed, -size, size)};
}

/* The cube [-1, 1]^3: distance to its faces is known. */
static void test_cube_distance(void **state) {
  (void)state;
  fs_context ctx = test_context();
  fs_mesh *cube = test_cube();
  fs_nearest *nearest = NULL;
  uint64_t seed = 11;
  assert_int_equal(fs_nearest_create_for_mesh(&ctx, cube, &nearest), FS_OK);
  for (int i = 0; i < 500; i++) {
    fs_vec3 p = random_point(&seed, 3), q;
    double x = fabs(p.x), y = fabs(p.y), z = fabs(p.z), expected;
    bool is_inside = x < 1 && y < 1 && z < 1;
    expected =
        is_inside ? fmin(1 - x, fmin(1 - y, 1 - z)) : hypot(hypot(fmax(x - 1, 0), fmax(y - 1, 0)), fmax(z - 1, 0));
    assert_true(fabs(fs_nearest_distance(nearest, p, &q) - expected) < 1e-14);
    assert_true(fabs(distance(p, q) - expected) < 1e-14);
  }
  fs_nearest_free(&ctx, nearest);
  fs_mesh_free(&ctx, cube);
}

/* Points lifted along the normal by less than the radius of curvature come back to where they were lifted. */
static void check_lifted(fs_mesh *mesh, double height) {
  fs_context ctx = test_context();
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  fs_nearest *nearest = NULL;
  uint64_t seed = 12;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, space, space->start, &surface), FS_OK);
  assert_int_equal(fs_nearest_create(&ctx, surface, &nearest), FS_OK);
  for (int i = 0; i < 300; i++) {
    int32_t patch = test_random_integer(&seed, 0, surface->n_patches - 1);
    double u = i % 7 == 0 ? 0 : test_random_real(&seed, 0, 1), v = i % 11 == 0 ? 1 : test_random_real(&seed, 0, 1);
    double h = test_random_real(&seed, -height, height), length;
    fs_vec3 x[FS_JET_SIZE], n, p;
    fs_near near;
    fs_surface_evaluate(surface, patch, u, v, x);
    n = (fs_vec3){x[FS_DU].y * x[FS_DV].z - x[FS_DU].z * x[FS_DV].y, x[FS_DU].z * x[FS_DV].x - x[FS_DU].x * x[FS_DV].z,
                  x[FS_DU].x * x[FS_DV].y - x[FS_DU].y * x[FS_DV].x};
    length = distance(n, (fs_vec3){0, 0, 0});
    p = (fs_vec3){x[FS_D].x + h / length * n.x, x[FS_D].y + h / length * n.y, x[FS_D].z + h / length * n.z};
    fs_nearest_find(nearest, p, &near);
    assert_true(fabs(near.distance - fabs(h)) < 1e-12);
    assert_true(distance(near.position, x[FS_D]) < 1e-7);
    fs_surface_evaluate(surface, near.patch, near.u, near.v, x);
    assert_true(distance(near.position, x[FS_D]) == 0);
  }
  fs_nearest_free(&ctx, nearest);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  fs_mesh_free(&ctx, mesh);
}

static void test_lifted(void **state) {
  (void)state;
  fs_mesh *star = test_star(5, 4);
  for (int32_t v = 0; v < star->n_vertices; v++) star->position[v].z *= 0.3;
  check_lifted(test_torus(12, 10, 3, 1), 0.4);
  check_lifted(star, 0.3);
}

/* Anywhere: never farther than the nearest of dense samples. */
static void test_samples(void **state) {
  (void)state;
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(3, 4);
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  fs_nearest *nearest = NULL;
  uint64_t seed = 13;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, space, space->start, &surface), FS_OK);
  assert_int_equal(fs_nearest_create(&ctx, surface, &nearest), FS_OK);
  for (int i = 0; i < 60; i++) {
    fs_vec3 p = random_point(&seed, 5), x[FS_JET_SIZE];
    double least = INFINITY;
    fs_near near;
    fs_nearest_find(nearest, p, &near);
    for (int32_t patch = 0; patch < surface->n_patches; patch++)
      for (int k = 0; k < 441; k++) {
        fs_surface_evaluate(surface, patch, 0.05 * (k % 21), 0.05 * (k / 21), x);
        least = fmin(least, distance(p, x[FS_D]));
      }
    assert_true(near.distance <= least + 1e-12);
  }
  fs_nearest_free(&ctx, nearest);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  fs_mesh_free(&ctx, mesh);
}

/* Every allocation fails once. */
static void test_memory(void **state) {
  (void)state;
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory), plain = test_context();
  fs_mesh *mesh = test_torus(8, 6, 3, 1);
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, space, space->start, &surface), FS_OK);
  for (int kind = 0; kind < 2; kind++) {
    fs_status status = FS_ERR_MEMORY;
    for (int64_t n = 1; status == FS_ERR_MEMORY; n++) {
      fs_nearest *nearest = NULL;
      int64_t live = memory.n_live;
      memory.fail_at = memory.n_allocations + n;
      status =
          kind == 0 ? fs_nearest_create(&ctx, surface, &nearest) : fs_nearest_create_for_mesh(&ctx, mesh, &nearest);
      if (status != FS_OK) assert_null(nearest);
      fs_nearest_free(&ctx, nearest);
      assert_int_equal(memory.n_live, live);
      assert_true(n < 20);
    }
    assert_int_equal(status, FS_OK);
  }
  surface->data[5] = NAN;
  memory.fail_at = 0;
  fs_nearest *nearest = NULL;
  assert_int_equal(fs_nearest_create(&ctx, surface, &nearest), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "patch 0"));
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  fs_mesh_free(&plain, mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_cube_distance), cmocka_unit_test(test_lifted),
                                     cmocka_unit_test(test_samples), cmocka_unit_test(test_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
