/* SPDX-License-Identifier: MIT */
/* Coarse meshes found from the connectivity of refinements: counts, and the rows against those of the refiner. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "refine/refine.h"
#include "support.h"

static double distance(fs_vec3 a, fs_vec3 b) { return fmax(fabs(a.x - b.x), fmax(fabs(a.y - b.y), fabs(a.z - b.z))); }

/* The rows map the positions of the original mesh to those of its refinement, where special vertices leave no choice of the
   coarse mesh. */
static void check_rows(const fs_mesh *mesh, const fs_refinement *r, const fs_mesh *coarse, const fs_stencils *s,
                       const int32_t *origin, bool is_unique, int32_t least_complete) {
  int32_t n_complete = 0, *original = malloc((size_t)coarse->n_vertices * sizeof *original);
  fs_vec3 *position = calloc((size_t)coarse->n_vertices, sizeof *position);
  assert_int_equal(s->n_rows, r->mesh->n_vertices);
  assert_int_equal(s->n_columns, coarse->n_vertices);
  for (int32_t i = 0; i < coarse->n_vertices;
       i++) { /* the old vertex with the largest weight in the row of origin[i] */
    int32_t row = origin[i], best = r->row_start[row];
    for (int32_t j = best; j < r->row_start[row + 1]; j++)
      if (r->weight[j] > r->weight[best]) best = j;
    original[i] = r->column[best];
    position[i] = mesh->position[original[i]];
  }
  for (int32_t v = 0; v < s->n_rows; v++) {
    fs_vec3 p = {0};
    double sum = 0;
    if (s->start[v] == s->start[v + 1]) continue;
    for (int32_t j = s->start[v]; j < s->start[v + 1]; j++) {
      fs_vec3 q = position[s->column[j]];
      sum += s->weight[j];
      p = (fs_vec3){p.x + s->weight[j] * q.x, p.y + s->weight[j] * q.y, p.z + s->weight[j] * q.z};
    }
    assert_true(sum > 0 && sum <= 1 + 1e-14);
    if (sum < 1 - 1e-12) continue; /* near the rim */
    n_complete++;
    if (is_unique) assert_true(distance(p, r->mesh->position[v]) <= 1e-13);
  }
  assert_true(n_complete >= least_complete);
  free(original);
  free(position);
}

static void check(fs_mesh *mesh, const char *refiner, bool is_unique, int32_t least_complete) {
  fs_context ctx = test_context();
  fs_refinement *r = NULL;
  fs_mesh *coarse = NULL;
  fs_stencils s = {0};
  int32_t *origin = NULL;
  uint64_t seed = 11;
  test_mesh_disturb(mesh, 0.1, &seed);
  assert_int_equal(fs_mesh_refine(&ctx, mesh, refiner, NULL, &r), FS_OK);
  assert_int_equal(fs_mesh_coarsen(&ctx, r->mesh, &coarse, &s, &origin), FS_OK);
  assert_non_null(coarse);
  check_rows(mesh, r, coarse, &s, origin, is_unique, least_complete);
  fs_stencils_release(&ctx, &s);
  fs_release(&ctx, origin);
  fs_mesh_free(&ctx, coarse);
  fs_refinement_free(&ctx, r);
  fs_mesh_free(&ctx, mesh);
}

static void test_rows(void **state) {
  (void)state;
  check(test_star(5, 6), "averaging", true, 200);
  check(test_star(5, 6), "catmull-clark", false, 200); /* other masks at the special vertex */
  check(test_star(3, 7), "averaging", true, 100);
  check(test_cube(), "averaging", true, 26);            /* closed: all rows */
  check(test_prism(5), "averaging", true, 10 + 15 + 7); /* pentagons become special faces */
  check(test_torus(6, 8, 3, 1), "catmull-clark", false, 4 * 48);
  check(test_grid(8, 9, NULL), "averaging", false, 80); /* nothing special: any of four coarse grids */
}

static void refuse(fs_mesh *mesh) {
  fs_context ctx = test_context();
  fs_mesh *coarse = mesh;
  fs_stencils s = {0};
  int32_t *origin = NULL;
  assert_int_equal(fs_mesh_coarsen(&ctx, mesh, &coarse, &s, &origin), FS_OK);
  assert_null(coarse);
  assert_null(origin);
  assert_null(s.start);
  assert_int_equal(ctx.message[0], '\0');
  fs_mesh_free(&ctx, mesh);
}

static void test_no_refinement(void **state) {
  (void)state;
  refuse(test_cube());            /* special vertices side by side */
  refuse(test_prism(5));          /* faces that are no quadrilaterals */
  refuse(test_torus(7, 6, 3, 1)); /* an odd way round */
  refuse(test_grid(1, 1, NULL));  /* no inner vertex */
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_rows),
      cmocka_unit_test(test_no_refinement),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
