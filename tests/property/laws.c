/* SPDX-License-Identifier: MIT */
/* Laws that hold for every density and every mesh: derivatives against differences, moving and scaling, growing order of
   neighbours' contact, triangles without gaps. Run FS_TEST_SCALE times as often where that variable is set. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include <fairsurf/fairsurf.h>
#include "support.h"

static int repetitions(int n) {
  const char *text = getenv("FS_TEST_SCALE");
  int scale = text != NULL ? atoi(text) : 1;
  return n * (scale > 0 ? scale : 1);
}

/* The densities, and the power of length with which their integrals scale. */
static const struct {
  const fs_density *density;
  double exponent;
} laws[] = {
    {&fs_density_curvature_variation, -2}, {&fs_density_tangential, 2}, {&fs_density_triharmonic, 2},
    {&fs_density_thin_plate, 2},           {&fs_density_willmore, 0},   {&fs_density_area, 2},
};
enum { N_LAWS = sizeof laws / sizeof laws[0], B = FS_BLOCK };

/* ---- at one point ---- */

static int n_vectors(const fs_density *d) { return d->order == 1 ? 2 : d->order == 2 ? 5 : 9; }
static int pair_number(int i, int j, int n) { return i * n - i * (i - 1) / 2 + j - i; }

static void random_point(uint64_t *seed, double *x) {
  for (int i = 0; i < 27 * B; i++) x[i] = test_random_real(seed, -0.5, 0.5);
  for (int l = 0; l < B; l++) {
    x[0 * B + l] += 1;
    x[4 * B + l] += 1;
  }
}

static void test_derivatives(void **state) {
  static double x[27 * B], f[B], df[27 * B], ddf[45 * 9 * B], f0[B], f1[B], df0[27 * B], df1[27 * B];
  uint64_t seed = 1;
  const double h = 1e-5;
  (void)state;
  for (int k = 0; k < N_LAWS; k++)
    for (int repeat = 0; repeat < repetitions(2); repeat++) {
      const fs_density *d = laws[k].density;
      int n = n_vectors(d);
      random_point(&seed, x);
      d->evaluate(x, f, df, ddf);
      for (int i = 0; i < 3 * n; i++) {
        double keep[B];
        memcpy(keep, x + i * B, sizeof keep);
        for (int l = 0; l < B; l++) x[i * B + l] = keep[l] + h;
        d->evaluate(x, f1, df1, NULL);
        for (int l = 0; l < B; l++) x[i * B + l] = keep[l] - h;
        d->evaluate(x, f0, df0, NULL);
        memcpy(x + i * B, keep, sizeof keep);
        for (int l = 0; l < B; l++) {
          double scale = 1 + fabs(f[l]) + fabs(df[i * B + l]);
          assert_true(fabs((f1[l] - f0[l]) / (2 * h) - df[i * B + l]) <= 1e-7 * scale);
          for (int j = 0; j < 3 * n; j++) {
            int a = i / 3 <= j / 3 ? i : j, b = i / 3 <= j / 3 ? j : i;
            double second = ddf[(pair_number(a / 3, b / 3, n) * 9 + 3 * (a % 3) + b % 3) * B + l];
            assert_true(fabs((df1[j * B + l] - df0[j * B + l]) / (2 * h) - second) <= 1e-6 * (scale + fabs(second)));
          }
        }
      }
    }
}

/* ---- on random meshes ---- */

/* A random mesh that carries a space, refined where needed; NULL: this seed gives none. */
static fs_mesh *random_mesh(fs_context *ctx, uint64_t seed) {
  fs_context plain = test_context();
  fs_mesh *mesh = test_random_mesh(seed), *fine = NULL;
  fs_refinement *step[FS_MAX_REFINEMENTS];
  int32_t n = 0;
  if (fs_space_prepare(ctx, mesh, 0, step, &n) == FS_OK) {
    assert_int_equal(fs_mesh_copy(&plain, n > 0 ? step[n - 1]->mesh : mesh, &fine), FS_OK);
    for (int32_t i = 0; i < n; i++) fs_refinement_free(ctx, step[i]);
  }
  fs_mesh_free(&plain, mesh);
  return fine;
}

static void single(const double *param, const fs_scale *scale, const double *integral, double *value,
                   double *derivative) {
  (void)param, (void)scale;
  *value = integral[0];
  derivative[0] = 1;
}

static double integral_of(fs_context *ctx, const fs_space *space, const fs_density *density, const fs_vec3 *c) {
  fs_functional functional = {.name = "law", .n_terms = 1, .term = {density}, .combine = single, .is_linear = true};
  bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  fs_fair_options options = {.functional = &functional, .fixed = fixed, .n_nodes_square = 4, .n_nodes_cap = 4};
  fs_energy energy;
  fixed[0] = fixed[space->n_vertices - 1] = true; /* so that no functional objects to a closed surface */
  assert_int_equal(fs_fair_energy(ctx, space, &options, c, &energy), FS_OK);
  free(fixed);
  return energy.F;
}

/* x -> s R x + t with a rotation R from a random quaternion. */
static fs_vec3 moved(fs_vec3 x, const double *q, double s, fs_vec3 t) {
  double w = q[0], a = q[1], b = q[2], c = q[3];
  return (fs_vec3){
      s * ((w * w + a * a - b * b - c * c) * x.x + 2 * (a * b - w * c) * x.y + 2 * (a * c + w * b) * x.z) + t.x,
      s * (2 * (a * b + w * c) * x.x + (w * w - a * a + b * b - c * c) * x.y + 2 * (b * c - w * a) * x.z) + t.y,
      s * (2 * (a * c - w * b) * x.x + 2 * (b * c + w * a) * x.y + (w * w - a * a - b * b + c * c) * x.z) + t.z};
}

static void test_moving_and_scaling(void **state) {
  fs_context ctx = test_context();
  int n_meshes = 0;
  (void)state;
  for (int repeat = 0; repeat < repetitions(6); repeat++) {
    uint64_t seed = 100 + (uint64_t)repeat;
    fs_mesh *mesh = random_mesh(&ctx, seed);
    fs_space *space = NULL;
    fs_surface *before = NULL, *after = NULL;
    double q[4], norm = 0, s = test_random_real(&seed, 0.2, 5);
    fs_vec3 t = {test_random_real(&seed, -9, 9), test_random_real(&seed, -9, 9), test_random_real(&seed, -9, 9)};
    if (mesh == NULL) continue;
    n_meshes++;
    for (int i = 0; i < 4; i++) {
      q[i] = test_random_real(&seed, -1, 1);
      norm += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++) q[i] /= sqrt(norm);
    assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
    assert_int_equal(fs_space_validate(&ctx, space), FS_OK);
    fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
    for (int32_t d = 0; d < space->n_dofs; d++) c[d] = moved(space->start[d], q, s, t);
    for (int k = 0; k < N_LAWS; k++) {
      double here = integral_of(&ctx, space, laws[k].density, space->start);
      double there = integral_of(&ctx, space, laws[k].density, c);
      assert_true(here >= 0);
      assert_true(fabs(there / pow(s, laws[k].exponent) - here) <= 1e-8 * here + 1e-12);
    }
    /* every point of the surface moves with its mesh */
    assert_int_equal(fs_surface_create(&ctx, space, space->start, &before), FS_OK);
    assert_int_equal(fs_surface_create(&ctx, space, c, &after), FS_OK);
    for (int i = 0; i < 20; i++) {
      int32_t p = test_random_integer(&seed, 0, before->n_patches - 1);
      double u = test_random_real(&seed, 0, 1), v = test_random_real(&seed, 0, 1);
      fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
      fs_surface_evaluate(before, p, u, v, x);
      fs_surface_evaluate(after, p, u, v, y);
      x[FS_D] = moved(x[FS_D], q, s, t);
      assert_true(fabs(x[FS_D].x - y[FS_D].x) + fabs(x[FS_D].y - y[FS_D].y) + fabs(x[FS_D].z - y[FS_D].z) < 1e-10);
    }
    free(c);
    fs_surface_free(&ctx, before);
    fs_surface_free(&ctx, after);
    fs_space_free(&ctx, space);
    fs_mesh_free(&ctx, mesh);
  }
  assert_true(n_meshes >= 3);
  fs_context_clear(&ctx);
}

static void test_contact_and_triangles(void **state) {
  fs_context ctx = test_context();
  int n_meshes = 0;
  (void)state;
  for (int repeat = 0; repeat < repetitions(12); repeat++) {
    fs_mesh *mesh = random_mesh(&ctx, 300 + (uint64_t)repeat);
    fs_space *space = NULL;
    fs_surface *surface = NULL;
    fs_triangles *triangles = NULL;
    fs_contact contact;
    if (mesh == NULL) continue;
    n_meshes++;
    assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
    assert_int_equal(fs_surface_create(&ctx, space, space->start, &surface), FS_OK);
    assert_int_equal(fs_surface_contact(&ctx, surface, 4, &contact), FS_OK);
    assert_true(contact.position <= 1e-11 && contact.normal <= 1e-9);
    assert_true(contact.curvature <= 1e-8 * contact.largest_curvature);
    assert_int_equal(fs_tessellate(&ctx, surface, 3, &triangles), FS_OK);
    /* every edge of the triangles belongs to two of them, or lies where a patch has no neighbour */
    int64_t n_open = 0, n_rim = 0;
    for (int32_t p = 0; p < surface->n_patches; p++)
      for (int s = 0; s < 4; s++) n_rim += surface->patch[p].neighbour[s] == FS_NONE;
    for (int32_t i = 0; i < 3 * triangles->n_triangles; i++) {
      int32_t a = triangles->corner[i], b = triangles->corner[i - i % 3 + (i + 1) % 3];
      bool is_matched = false;
      if (triangles->n_triangles > 4000) break; /* the search is quadratic */
      for (int32_t j = 0; j < 3 * triangles->n_triangles && !is_matched; j++)
        is_matched = triangles->corner[j] == b && triangles->corner[j - j % 3 + (j + 1) % 3] == a;
      n_open += !is_matched;
    }
    if (triangles->n_triangles <= 4000) assert_int_equal(n_open, 3 * n_rim);
    fs_triangles_free(&ctx, triangles);
    fs_surface_free(&ctx, surface);
    fs_space_free(&ctx, space);
    fs_mesh_free(&ctx, mesh);
  }
  assert_true(n_meshes >= 6);
  fs_context_clear(&ctx);
}

/* ---- tables ---- */

static void check_params(const fs_param *params) {
  for (int i = 0; params != NULL && params[i].name != NULL; i++) {
    assert_true(params[i].summary != NULL && params[i].summary[0] != '\0');
    assert_true(params[i].min <= params[i].initial && params[i].initial <= params[i].max);
    for (int j = 0; j < i; j++) assert_string_not_equal(params[i].name, params[j].name);
    if (params[i].choices == NULL) continue;
    int n = 0;
    while (params[i].choices[n] != NULL) n++;
    assert_true(params[i].initial == floor(params[i].initial) && params[i].initial < n);
  }
}

#define CHECK_TABLE(table, key)                                                                             \
  for (int i = 0; (table)[i] != NULL; i++) {                                                                \
    assert_true((table)[i]->name != NULL && (table)[i]->summary != NULL && (table)[i]->summary[0] != '\0'); \
    for (int j = 0; j < i; j++) assert_string_not_equal((table)[i]->key, (table)[j]->key);                  \
  }

static void test_tables(void **state) {
  (void)state;
  CHECK_TABLE(fs_readers, extension)
  CHECK_TABLE(fs_refiners, name)
  CHECK_TABLE(fs_patch_rules, name)
  CHECK_TABLE(fs_functionals, name)
  CHECK_TABLE(fs_measures, name)
  CHECK_TABLE(fs_exporters, extension)
  for (int i = 0; fs_refiners[i] != NULL; i++) check_params(fs_refiners[i]->params);
  for (int i = 0; fs_functionals[i] != NULL; i++) check_params(fs_functionals[i]->params);
  for (int i = 0; fs_measures[i] != NULL; i++) check_params(fs_measures[i]->params);
  for (int i = 0; fs_exporters[i] != NULL; i++) check_params(fs_exporters[i]->params);
  for (int i = 0; fs_functionals[i] != NULL; i++)
    assert_true(fs_functional_find(fs_functionals[i]->name) == fs_functionals[i]);
  assert_null(fs_functional_find("nothing"));
  assert_null(fs_exporter_find("nothing"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_derivatives),
      cmocka_unit_test(test_moving_and_scaling),
      cmocka_unit_test(test_contact_and_triangles),
      cmocka_unit_test(test_tables),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
