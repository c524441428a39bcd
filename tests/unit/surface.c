/* SPDX-License-Identifier: MIT */
/* Patches, their derivatives, tessellation, bicubic stand-ins, contact and measures, on surfaces put together by hand. */
#include <fairsurf/analyse.h>
#include "math/vec3.h"
#include "surface_samples.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>
#include <cmocka.h>

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

static void near_points(fs_vec3 a, fs_vec3 b, double tolerance) { near(fs_vec3_distance(a, b), 0, tolerance); }

/* One open patch with random control points. */
static fs_surface *random_patch(int degree_u, int degree_v, uint64_t seed) {
  fs_surface *s = calloc(1, sizeof *s);
  s->n_patches = 1;
  s->n_data = 3 * (size_t)(degree_u + 1) * (size_t)(degree_v + 1);
  s->patch = calloc(1, sizeof *s->patch);
  s->data = calloc(s->n_data, sizeof *s->data);
  *s->patch = (fs_patch){.n_sides = 4,
                         .degree_u = degree_u,
                         .degree_v = degree_v,
                         .valence = 4,
                         .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  for (int j = 0, k = 0; j <= degree_v; j++)
    for (int i = 0; i <= degree_u; i++)
      for (int d = 0; d < 3; d++)
        s->data[k++] = (d == 0   ? (double)i / degree_u
                        : d == 1 ? (double)j / degree_v
                                 : 0) +
                       test_random_real(&seed, -0.2, 0.2);
  return s;
}

static fs_vec3 point(const fs_surface *s, double u, double v) {
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(s, 0, u, v, x);
  return x[FS_D];
}

/* Bernstein sum with binomials and powers: another way than the one under test. */
static fs_vec3 bernstein_sum(const fs_surface *s, double u, double v) {
  int n = s->patch->degree_u, m = s->patch->degree_v;
  fs_vec3 sum = {0, 0, 0};
  for (int j = 0; j <= m; j++)
    for (int i = 0; i <= n; i++) {
      double w = exp(lgamma(n + 1) - lgamma(i + 1) - lgamma(n - i + 1)) * pow(u, i) * pow(1 - u, n - i) *
                 exp(lgamma(m + 1) - lgamma(j + 1) - lgamma(m - j + 1)) * pow(v, j) * pow(1 - v, m - j);
      const double *b = s->data + 3 * (i + (n + 1) * j);
      sum = fs_vec3_add_scaled(sum, (fs_vec3){b[0], b[1], b[2]}, w);
    }
  return sum;
}

static void test_jets(void **state) {
  static const int degrees[][2] = {{1, 1}, {2, 3}, {3, 3}, {5, 1}, {9, 9}, {9, 4}, {31, 20}};
  static const int from_u[] = {FS_D, FS_DU, FS_DV, FS_DUU, FS_DUV, FS_DVV},
                   by_u[] = {FS_DU, FS_DUU, FS_DUV, FS_DUUU, FS_DUUV, FS_DUVV},
                   by_v[] = {FS_DV, FS_DUV, FS_DVV, FS_DUUV, FS_DUVV, FS_DVVV};
  (void)state;
  for (size_t t = 0; t < sizeof degrees / sizeof *degrees; t++) {
    fs_surface *s = random_patch(degrees[t][0], degrees[t][1], 5 + t);
    for (int k = 0; k < 9; k++) {
      double u = 0.1 + 0.1 * k, v = 0.93 - 0.1 * k, h = 1e-5;
      fs_vec3 x[FS_JET_SIZE], a[FS_JET_SIZE], b[FS_JET_SIZE];
      fs_surface_evaluate(s, 0, u, v, x);
      near_points(x[FS_D], bernstein_sum(s, u, v), 1e-12);
      for (int d = 0; d < 6; d++) {
        double scale = pow(degrees[t][0] + degrees[t][1], 2 + (d > 0) + (d > 2));
        fs_surface_evaluate(s, 0, u + h, v, a);
        fs_surface_evaluate(s, 0, u - h, v, b);
        near_points(fs_vec3_scale(fs_vec3_sub(a[from_u[d]], b[from_u[d]]), 0.5 / h), x[by_u[d]], 1e-7 * scale);
        fs_surface_evaluate(s, 0, u, v + h, a);
        fs_surface_evaluate(s, 0, u, v - h, b);
        near_points(fs_vec3_scale(fs_vec3_sub(a[from_u[d]], b[from_u[d]]), 0.5 / h), x[by_v[d]], 1e-7 * scale);
      }
    }
    sample_free(s);
  }
}

/* At corners the position is the control point, to the bit, and p_u its difference. */
static void test_jets_are_exact_at_ends(void **state) {
  fs_surface *s = random_patch(9, 7, 3);
  fs_vec3 x[FS_JET_SIZE];
  (void)state;
  for (int corner = 0; corner < 4; corner++) {
    int i = corner % 2 * 9, j = corner / 2 * 7;
    const double *b = s->data + 3 * (i + 10 * j), *c = b + (i == 0 ? 3 : -3);
    fs_surface_evaluate(s, 0, corner % 2, corner / 2, x);
    assert_true(x[FS_D].x == b[0] && x[FS_D].y == b[1] && x[FS_D].z == b[2]);
    near(x[FS_DU].x, 9 * (i == 0 ? c[0] - b[0] : b[0] - c[0]), 1e-14);
  }
  for (int k = 0; k <= 4; k++)
    for (int side = 0; side < 4; side++) {
      double u, v, t[2] = {0, 0};
      fs_side_parameters(4, side, k / 4.0, &u, &v);
      t[side % 2] = side < 2 ? k / 4.0 : 1 - k / 4.0;
      t[1 - side % 2] = side == 1 || side == 2;
      assert_true(u == t[0] && v == t[1]);
    }
  s->patch->degree_u = FS_MAX_DEGREE + 1; /* not a number instead of a crash */
  assert_true(isnan(point(s, 0.5, 0.5).x));
  sample_free(s);
}

static int every(int i, int j) { return i >= 0 && j >= 0; }
static int some(int i, int j) { return (i / 2 + j) % 3 == 0; }

/* A bicubic and the same patch of degree (9, 9) have the same derivatives. */
static void test_degree_does_not_matter(void **state) {
  fs_surface *a = sample_torus(6, 5, NULL, 0), *b = sample_torus(6, 5, every, 0);
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  (void)state;
  for (int p = 0; p < a->n_patches; p++)
    for (int k = 0; k <= 10; k++) {
      fs_surface_evaluate(a, p, 0.1 * k, 1 - 0.07 * k, x);
      fs_surface_evaluate(b, p, 0.1 * k, 1 - 0.07 * k, y);
      for (int d = 0; d < FS_JET_SIZE; d++) near_points(x[d], y[d], 1e-11);
    }
  sample_free(a);
  sample_free(b);
}

/* b = E c: two elements share an extraction, dofs in different order. */
static void test_create(void **state) {
  double E[16] = {0.25, 0.25, 0.25, 0.25, 0, 1, 0, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1};
  fs_extraction extraction = {.degree_u = 1, .degree_v = 1, .n_dofs = 4, .E = E, .valence = 3};
  fs_element element[2] = {{.face = 7, .dof_start = 0, .neighbour = {1, -1, -1, -1}, .neighbour_side = {2, 0, 0, 0}},
                           {.face = 8, .dof_start = 4, .neighbour = {-1, -1, 0, -1}}};
  int32_t dof[8] = {0, 1, 2, 3, 3, 2, 1, 4};
  fs_space space = {.n_vertices = 5,
                    .n_dofs = 5,
                    .n_elements = 2,
                    .n_extractions = 1,
                    .n_element_dofs = 8,
                    .element = element,
                    .extraction = &extraction,
                    .dof = dof};
  fs_vec3 c[5] = {{1, 0, 0}, {0, 2, 0}, {0, 0, 4}, {8, 0, 0}, {0, 16, 0}};
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_surface *s = NULL;
  (void)state;
  assert_int_equal(fs_surface_create(&ctx, &space, c, &s), FS_OK);
  assert_int_equal(s->n_patches, 2);
  assert_int_equal(s->n_data, 24);
  assert_int_equal(s->patch[1].data_start, 12);
  assert_int_equal(s->patch[1].face, 8);
  assert_int_equal(s->patch[0].valence, 3);
  assert_int_equal(s->patch[0].neighbour[0], 1);
  assert_int_equal(s->patch[0].neighbour_side[0], 2);
  const double expected[24] = {2.25, 0.5, 1, 0, 2, 0, 4, 0, 2, 8, 0, 0, 2, 4.5, 1, 0, 0, 4, 0, 9, 0, 0, 16, 0};
  for (int k = 0; k < 24; k++) near(s->data[k], expected[k], 0);
  fs_surface_free(&ctx, s);
  fs_surface_free(&ctx, NULL);
  for (int64_t n = memory.n_allocations; n >= 1; n--) {
    memory = (struct test_memory){.fail_at = n};
    s = NULL;
    assert_int_equal(fs_surface_create(&ctx, &space, c, &s), FS_ERR_MEMORY);
    assert_null(s);
    assert_int_equal(memory.n_live, 0);
  }
  memory.fail_at = 0;
  extraction.degree_u = FS_MAX_DEGREE + 1;
  assert_int_equal(fs_surface_create(&ctx, &space, c, &s), FS_ERR_UNSUPPORTED);
}

static int compare_edges(const void *a, const void *b) {
  const int64_t *x = a, *y = b;
  return (*x > *y) - (*x < *y);
}

/* Number of directed edges without an opposite; fails where one is used twice. */
static int count_open_edges(const fs_triangles *t) {
  int n = 3 * t->n_triangles, n_open = 0;
  int64_t *edge = malloc((size_t)n * sizeof *edge);
  for (int k = 0; k < n; k++) edge[k] = (int64_t)t->corner[k] * t->n_vertices + t->corner[k % 3 == 2 ? k - 2 : k + 1];
  qsort(edge, (size_t)n, sizeof *edge, compare_edges);
  for (int k = 0; k < n; k++) {
    if (k > 0) assert_true(edge[k] != edge[k - 1]);
    int64_t back = edge[k] % t->n_vertices * t->n_vertices + edge[k] / t->n_vertices;
    if (bsearch(&back, edge, (size_t)n, sizeof *edge, compare_edges) == NULL) n_open++;
  }
  free(edge);
  return n_open;
}

static void check_vertices(const fs_surface *s, const fs_triangles *t) {
  for (int k = 0; k < t->n_vertices; k++) {
    fs_vec3 x[FS_JET_SIZE];
    near(fs_vec3_length(t->normal[k]), 1, 1e-14);
    fs_surface_evaluate(s, t->vertex_patch[k], t->vertex_uv[2 * k], t->vertex_uv[2 * k + 1], x);
    near_points(x[FS_D], t->position[k], 0);
    near(fs_vec3_dot(t->normal[k], x[FS_DU]), 0, 1e-13);
  }
}

static void test_tessellate_closed(void **state) {
  (void)state;
  for (int steps = 1; steps <= 5; steps++) {
    fs_surface *s = sample_torus(7, 5, some, 0.01);
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    fs_triangles *t = NULL;
    assert_int_equal(fs_tessellate(&ctx, s, steps, &t), FS_OK);
    assert_int_equal(t->n_vertices, 35 * steps * steps);
    assert_int_equal(t->n_triangles, 70 * steps * steps);
    assert_int_equal(count_open_edges(t), 0);
    check_vertices(s, t);
    double volume = 0;
    for (int k = 0; k < t->n_triangles; k++) {
      const int32_t *c = t->corner + 3 * k;
      fs_vec3 a = t->position[c[0]], b = t->position[c[1]], d = t->position[c[2]];
      volume += fs_vec3_dot(a, fs_vec3_cross(b, d)) / 6;
      if (steps < 3) continue;
      fs_vec3 flat = fs_vec3_cross(fs_vec3_sub(b, a), fs_vec3_sub(d, a));
      assert_true(fs_vec3_angle(flat, t->normal[c[0]]) < 0.8);
    }
    assert_true(volume > 1);
    fs_triangles_free(&ctx, t);
    assert_int_equal(memory.n_live, 0);
    sample_free(s);
  }
}

/* Cut open at side 3 of column 0, one patch turned by a quarter: counts follow from Euler's formula. */
static void test_tessellate_open(void **state) {
  const int n = 4, m = 5, steps = 3;
  fs_surface *s = sample_torus(n, m, NULL, 0);
  fs_context ctx = test_context();
  fs_triangles *t = NULL;
  (void)state;
  for (int j = 0; j < m; j++) {
    s->patch[n * j].neighbour[3] = FS_NONE;
    s->patch[n - 1 + n * j].neighbour[1] = FS_NONE;
  }
  fs_patch *turned = &s->patch[1 + n]; /* its side k becomes side k - 1: new u is old v, new v is old 1 - u */
  fs_patch old = *turned;
  double b[48];
  memcpy(b, s->data + old.data_start, sizeof b);
  for (int j = 0; j < 4; j++)
    for (int i = 0; i < 4; i++)
      memcpy(s->data + old.data_start + 3 * (i + 4 * j), b + 3 * (3 - j + 4 * i), 3 * sizeof *b);
  for (int k = 0; k < 4; k++) {
    int before = (k + 1) % 4;
    turned->neighbour[k] = old.neighbour[before];
    turned->neighbour_side[k] = old.neighbour_side[before];
    s->patch[old.neighbour[before]].neighbour_side[old.neighbour_side[before]] = (uint8_t)k;
  }
  assert_int_equal(fs_tessellate(&ctx, s, steps, &t), FS_OK);
  assert_int_equal(t->n_vertices, (n * steps + 1) * m * steps);
  assert_int_equal(count_open_edges(t), 2 * m * steps);
  check_vertices(s, t);
  for (int k = 0; k < t->n_triangles; k++) /* a wrong turn makes long triangles */
    for (int c = 0; c < 3; c++)
      assert_true(fs_vec3_distance(t->position[t->corner[3 * k + c]], t->position[t->corner[3 * k + (c + 1) % 3]]) < 1);
  fs_contact contact;
  assert_int_equal(fs_surface_contact(&ctx, s, 10, &contact), FS_OK);
  near(contact.position, 0, 1e-14);
  fs_triangles_free(&ctx, t);
  sample_free(s);
}

static void test_tessellate_refuses(void **state) {
  fs_surface *s = sample_torus(4, 4, NULL, 0);
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_triangles *t = NULL;
  (void)state;
  assert_int_equal(fs_tessellate(&ctx, s, 0, &t), FS_ERR_ARGUMENT);
  assert_int_equal(fs_tessellate(&ctx, s, 20000, &t), FS_ERR_ARGUMENT);
  assert_int_equal(fs_tessellate(&ctx, s, INT32_MAX, &t), FS_ERR_ARGUMENT);
  assert_int_equal(fs_tessellate(&ctx, s, 2, &t), FS_OK);
  fs_triangles_free(&ctx, t);
  int64_t n_allocations = memory.n_allocations;
  for (int64_t n = 1;; n++) {
    memory = (struct test_memory){.fail_at = n};
    t = NULL;
    fs_status status = fs_tessellate(&ctx, s, 2, &t);
    fs_triangles_free(&ctx, t);
    assert_int_equal(memory.n_live, 0);
    if (status == FS_OK) break;
    assert_int_equal(status, FS_ERR_MEMORY);
    assert_null(t);
  }
  assert_true(n_allocations > 5);
  s->data[17] = NAN;
  memory = (struct test_memory){0};
  assert_int_equal(fs_tessellate(&ctx, s, 2, &t), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "patch 0"));
  assert_int_equal(memory.n_live, 0);
  sample_free(s);
}

/* One side of the patch is a point: the normals there come from nearby. */
static void test_tessellate_singular(void **state) {
  fs_surface *s = random_patch(3, 3, 8);
  fs_context ctx = test_context();
  fs_triangles *t = NULL;
  (void)state;
  for (int i = 1; i < 4; i++) memcpy(s->data + 3 * i, s->data, 3 * sizeof *s->data);
  assert_int_equal(fs_tessellate(&ctx, s, 4, &t), FS_OK);
  for (int k = 0; k < t->n_vertices; k++) near(fs_vec3_length(t->normal[k]), 1, 1e-14);
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(s, 0, 0.5, 0, x);
  for (const fs_measure *const *measure = fs_measures; *measure != NULL; measure++)
    assert_true(isnan((*measure)->value(NULL, x)));
  fs_triangles_free(&ctx, t);
  sample_free(s);
}

static void test_hermite(void **state) {
  fs_surface *s = sample_torus(6, 5, NULL, 0), *high = random_patch(9, 9, 4), *low = random_patch(2, 1, 4);
  fs_context ctx = test_context();
  fs_vec3 bezier[16 * 64];
  (void)state;
  /* m = 0 reproduces bicubics, and patches of lower degree */
  fs_surface_hermite_bicubics(s, 7, 0, bezier);
  for (int k = 0; k < 16; k++) {
    const double *b = s->data + s->patch[7].data_start + 3 * k;
    near_points(bezier[k], (fs_vec3){b[0], b[1], b[2]}, 1e-15);
  }
  int32_t m = 9;
  double deviation = 9, before = 0;
  assert_int_equal(fs_surface_hermite_depth(&ctx, s, 3, 1e-12, 3, &m, &deviation), FS_OK);
  assert_int_equal(m, 0);
  near(deviation, 0, 1e-15);
  assert_int_equal(fs_surface_hermite_depth(&ctx, low, 0, 1e-12, 3, &m, &deviation), FS_OK);
  assert_int_equal(m, 0);
  /* the error falls by 16 at each halving */
  for (int depth = 4; depth <= 6; depth++) {
    assert_int_equal(fs_surface_hermite_depth(&ctx, high, 0, 0, depth, &m, &deviation), FS_OK);
    assert_int_equal(m, depth);
    if (depth > 4) near(log2(before / deviation), 4, 0.3);
    before = deviation;
  }
  /* the smallest depth within the tolerance */
  assert_int_equal(fs_surface_hermite_depth(&ctx, high, 0, before * 1.001, 9, &m, &deviation), FS_OK);
  assert_int_equal(m, 6);
  near(deviation, before, 0);
  assert_int_equal(fs_surface_hermite_depth(&ctx, high, 0, 1e-3, -1, &m, &deviation), FS_ERR_ARGUMENT);
  /* corners of the pieces interpolate, neighbouring pieces share points to the bit and are C1 */
  fs_surface_hermite_bicubics(high, 0, 3, bezier);
  for (int b = 0; b < 8; b++)
    for (int a = 0; a < 8; a++) {
      const fs_vec3 *piece = bezier + 16 * (a + 8 * b);
      near_points(piece[0], point(high, a / 8.0, b / 8.0), 0);
      for (int k = 0; a < 7 && k < 4; k++) {
        near_points(piece[3 + 4 * k], piece[16 + 4 * k], 0);
        near_points(fs_vec3_sub(piece[3 + 4 * k], piece[2 + 4 * k]), fs_vec3_sub(piece[17 + 4 * k], piece[16 + 4 * k]),
                    1e-15);
      }
    }
  sample_free(s);
  sample_free(high);
  sample_free(low);
}

static void test_contact(void **state) {
  fs_surface *s = sample_torus(8, 6, some, 0.01), *alone = random_patch(3, 3, 1);
  fs_context ctx = test_context();
  fs_contact contact;
  (void)state;
  assert_int_equal(fs_surface_contact(&ctx, s, 8, &contact), FS_OK); /* a C2 B-spline surface */
  near(contact.position, 0, 1e-14);
  near(contact.normal, 0, 1e-13);
  near(contact.curvature, 0, 1e-11);
  assert_true(contact.largest_curvature > 1 && contact.patch[0] != FS_NONE);
  /* points move: of a second row curvature breaks, of a first row the normal too, of a side position too */
  double *row = s->data + s->patch[10].data_start; /* a bicubic: its second row lies also on the third from side 2 */
  assert_int_equal(s->patch[10].degree_u, 3);
  row[3 * (1 + 4 * 1) + 2] += 1e-3;
  assert_int_equal(fs_surface_contact(&ctx, s, 8, &contact), FS_OK);
  near(contact.position, 0, 1e-14);
  assert_true(contact.normal > 1e-4 && contact.curvature > 1e-2);
  assert_true(contact.patch[1] == 10 || s->patch[contact.patch[1]].neighbour[contact.side[1]] == 10);
  row[3 * 1] += 0.25;
  assert_int_equal(fs_surface_contact(&ctx, s, 9, &contact), FS_OK);
  near(contact.position, 0.25 * 3 * (1 / 3.) * (2 / 3.) * (2 / 3.), 1e-12); /* B_1^3 is largest at 1/3 */
  assert_int_equal(fs_surface_contact(&ctx, alone, 4, &contact), FS_OK);
  assert_int_equal(contact.patch[0], FS_NONE);
  assert_int_equal(fs_surface_contact(&ctx, s, 0, &contact), FS_ERR_ARGUMENT);
  sample_free(s);
  sample_free(alone);
}

/* On the cylinder (cos u, sin u, v) seen from inside: curvatures 1 and 0. */
static void test_measures(void **state) {
  const fs_vec3 x[FS_JET_SIZE] = {
      [FS_D] = {1, 0, 0}, [FS_DU] = {0, 0, 1}, [FS_DV] = {0, 1, 0}, [FS_DVV] = {-1, 0, 0}, [FS_DVVV] = {0, -1, 0}};
  static const struct {
    const char *name;
    double value;
  } expected[] = {{"mean", 0.5}, {"gaussian", 0}, {"gradient", 0}, {"maximum", 1}, {"minimum", 0}};
  (void)state;
  for (size_t k = 0; k < sizeof expected / sizeof *expected; k++) {
    const fs_measure *measure = fs_measure_find(expected[k].name);
    assert_non_null(measure);
    assert_ptr_equal(measure, fs_measures[k]);
    near(measure->value(NULL, x), expected[k].value, 1e-15);
  }
  assert_null(fs_measures[5]);
  assert_null(fs_measure_find("nonsense"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_jets),
      cmocka_unit_test(test_jets_are_exact_at_ends),
      cmocka_unit_test(test_degree_does_not_matter),
      cmocka_unit_test(test_create),
      cmocka_unit_test(test_tessellate_closed),
      cmocka_unit_test(test_tessellate_open),
      cmocka_unit_test(test_tessellate_refuses),
      cmocka_unit_test(test_tessellate_singular),
      cmocka_unit_test(test_hermite),
      cmocka_unit_test(test_contact),
      cmocka_unit_test(test_measures),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
