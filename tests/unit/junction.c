/* SPDX-License-Identifier: MIT */
/* Pairs of patches from an auxiliary patch: numbers of an independent program (FAIRSURF_SHARED/math/patches-vectors.json),
   tangent planes and curvatures along the edge, invariance, and what is refused. */
#include <fairsurf/analyse.h>
#include <fairsurf/construct_junction.h>
#include "math/diffgeo.h"
#include "math/vec3.h"
#include "vectors.h"
#include <string.h>

static cJSON *vectors;

enum { MAX_POINTS = 64 };

typedef struct sample {
  int32_t order, degree_u, degree_v;
  fs_vec3 point[MAX_POINTS];
  fs_bezier_patch aux;
  double coefficient[2][FS_N_JUNCTION_FUNCTIONS][12];
  fs_junction junction[2];
} sample;

/* The file has nets [i][j]. */
static void read_sample(const cJSON *from, sample *s) {
  static const char *const name[FS_N_JUNCTION_FUNCTIONS] = {"beta1", "gamma1", "beta2", "gamma2"};
  const cJSON *aux = vectors_item(from, "aux"), *patch;
  int32_t n = cJSON_GetArraySize(aux), m = cJSON_GetArraySize(aux->child), k = 0;
  double net[3 * MAX_POINTS], degrees[2];
  assert_int_equal(vectors_flatten(aux, net), 3 * n * m);
  for (int i = 0; i < n; i++)
    for (int j = 0; j < m; j++) memcpy(&s->point[i + n * j], net + 3 * (i * m + j), sizeof(fs_vec3));
  s->aux = (fs_bezier_patch){n - 1, m - 1, s->point};
  vectors_numbers(from, "degree_final", 2, degrees);
  s->degree_u = (int32_t)degrees[0], s->degree_v = (int32_t)degrees[1];
  s->order = vectors_item(from, "order")->valueint;
  cJSON_ArrayForEach(patch, vectors_item(from, "patches")) {
    const cJSON *functions = vectors_item(patch, "junction");
    s->junction[k] = (fs_junction){.degree = {0}};
    for (int f = 0; f < (s->order == 2 ? 4 : 2); f++) {
      const cJSON *function = vectors_item(functions, name[f]);
      s->junction[k].degree[f] = cJSON_GetArraySize(function) - 1;
      vectors_flatten(function, s->coefficient[k][f]);
      s->junction[k].function[f] = s->coefficient[k][f];
    }
    k++;
  }
  assert_int_equal(k, 2);
}

static fs_vec3 bezier(const fs_bezier_patch *p, double u, double v, int order_u, int order_v) {
  fs_surface s = {.n_patches = 1};
  fs_patch patch = {.n_sides = 4, .degree_u = p->degree_u, .degree_v = p->degree_v};
  fs_vec3 x[FS_JET_SIZE];
  static const int8_t at[3][3] = {{FS_D, FS_DV, FS_DVV}, {FS_DU, FS_DUV, FS_DUVV}, {FS_DUU, FS_DUUV, -1}};
  s.patch = &patch;
  s.data = (double *)(void *)p->point;
  fs_surface_evaluate(&s, 0, u, v, x);
  return x[at[order_u][order_v]];
}

static void geometry_of(const fs_bezier_patch *p, double u, fs_geometry *g) {
  fs_vec3 x[6] = {bezier(p, u, 0, 0, 0), bezier(p, u, 0, 1, 0), bezier(p, u, 0, 0, 1),
                  bezier(p, u, 0, 2, 0), bezier(p, u, 0, 1, 1), bezier(p, u, 0, 0, 2)};
  assert_true(fs_geometry_compute(x, g));
}

static double line_angle(fs_vec3 a, fs_vec3 b) {
  return atan2(fs_vec3_length(fs_vec3_cross(a, b)), fabs(fs_vec3_dot(a, b)));
}

static double tensor_difference(const fs_geometry *a, const fs_geometry *b) {
  double A[3][3], B[3][3], largest = 0, sign = fs_vec3_dot(a->normal, b->normal) < 0 ? -1 : 1;
  fs_geometry_shape_tensor(a, A);
  fs_geometry_shape_tensor(b, B);
  for (int i = 0; i < 9; i++) largest = fmax(largest, fabs(A[i / 3][i % 3] - sign * B[i / 3][i % 3]));
  return largest;
}

static fs_bezier_patch net_of(const fs_surface *s, int p) {
  return (fs_bezier_patch){s->patch[p].degree_u, s->patch[p].degree_v,
                           (const fs_vec3 *)(const void *)(s->data + s->patch[p].data_start)};
}

static void check_columns(const cJSON *from, const sample *s) {
  fs_context ctx = test_context();
  const cJSON *patch, *column;
  int k = 0;
  cJSON_ArrayForEach(patch, vectors_item(from, "patches")) {
    fs_vec3 ours[3 * 12];
    double theirs[3 * 12];
    int j = 0;
    assert_int_equal(fs_junction_columns(&ctx, &s->aux, &s->junction[k++], s->order, s->degree_u, s->degree_v, ours),
                     FS_OK);
    cJSON_ArrayForEach(column, vectors_item(patch, "columns")) {
      assert_int_equal(vectors_flatten(column, theirs), 3 * (s->degree_u + 1));
      vectors_agree("column", 3 * (s->degree_u + 1), &ours[(s->degree_u + 1) * j++].x, theirs, 1e-12);
    }
    assert_int_equal(j, s->order + 1);
  }
}

static void check_geometry(const cJSON *from, const sample *s) {
  fs_context ctx = test_context();
  fs_surface *pair;
  fs_geometry g[3];
  fs_contact contact;
  assert_int_equal(fs_junction_pair(&ctx, &s->aux, s->junction, s->order, s->degree_u, s->degree_v, NULL, &pair),
                   FS_OK);
  assert_int_equal(fs_surface_validate(&ctx, pair), FS_OK);
  fs_bezier_patch first = net_of(pair, 0), second = net_of(pair, 1);
  for (int i = 0; i <= 10; i++) {
    double u = i / 10.0;
    assert_true(fs_vec3_distance(bezier(&first, u, 0, 0, 0), bezier(&s->aux, u, 0, 0, 0)) <= 1e-13);
    assert_true(fs_vec3_distance(bezier(&second, 1 - u, 0, 0, 0), bezier(&s->aux, u, 0, 0, 0)) <= 1e-13);
    geometry_of(&s->aux, u, &g[0]);
    geometry_of(&first, u, &g[1]);
    geometry_of(&second, 1 - u, &g[2]);
    for (int k = 1; k < 3; k++) {
      assert_true(fs_vec3_dot(g[k].normal, g[0].normal) > 0);
      assert_true(line_angle(g[k].normal, g[0].normal) <= 1e-12);
      if (s->order == 2) assert_true(tensor_difference(&g[k], &g[0]) <= 1e-10);
    }
  }
  assert_int_equal(fs_surface_contact(&ctx, pair, 10, &contact), FS_OK);
  assert_true(contact.position <= 1e-12 && contact.normal <= 1e-12);
  if (s->order == 2) assert_true(contact.curvature <= 1e-9);
  geometry_of(&first, 0.3, &g[0]);
  double theirs[9], tensor[3][3], line[3];
  vectors_numbers(from, "normal_line_u_0_3", 3, line);
  assert_true(line_angle(g[0].normal, (fs_vec3){line[0], line[1], line[2]}) <= 1e-12);
  if (s->order == 2) {
    vectors_numbers(from, "curvature_tensor_u_0_3", 9, theirs);
    fs_geometry_shape_tensor(&g[0], tensor);
    double sign = g[0].normal.x * line[0] + g[0].normal.y * line[1] + g[0].normal.z * line[2] < 0 ? -1 : 1;
    for (int i = 0; i < 9; i++) theirs[i] *= sign;
    vectors_agree("curvature tensor", 9, tensor[0], theirs, 1e-10);
  }
  fs_surface_free(&ctx, pair);
}

static void test_vectors(void **state) {
  const cJSON *from;
  int n = 0;
  (void)state;
  cJSON_ArrayForEach(from, vectors_item(vectors, "junction_pairs")) {
    sample s;
    read_sample(from, &s);
    check_columns(from, &s);
    check_geometry(from, &s);
    assert_int_equal(fs_junction_degree(&s.aux, &s.junction[0], s.order), s.degree_u);
    n++;
  }
  assert_int_equal(n, 2);
}

static fs_vec3 map_point(const double *A, fs_vec3 p) {
  return (fs_vec3){A[0] * p.x + A[1] * p.y + A[2] * p.z + 1, A[3] * p.x + A[4] * p.y + A[5] * p.z - 2,
                   A[6] * p.x + A[7] * p.y + A[8] * p.z + 3};
}

/* Affine maps of the auxiliary patch map the columns; a plane stays. */
static void test_invariance(void **state) {
  static const double A[9] = {1.2, 0.3, -0.4, 0.1, -0.8, 0.5, 0.7, 0.2, 1.1};
  fs_context ctx = test_context();
  sample s;
  fs_vec3 before[24], after[24], moved[MAX_POINTS];
  (void)state;
  read_sample(cJSON_GetArrayItem(vectors_item(vectors, "junction_pairs"), 1), &s);
  assert_int_equal(fs_junction_columns(&ctx, &s.aux, s.junction, 2, 7, 5, before), FS_OK);
  for (int i = 0; i < 12; i++) moved[i] = map_point(A, s.point[i]);
  fs_bezier_patch aux = {3, 2, moved};
  assert_int_equal(fs_junction_columns(&ctx, &aux, s.junction, 2, 7, 5, after), FS_OK);
  for (int i = 0; i < 24; i++) assert_true(fs_vec3_distance(map_point(A, before[i]), after[i]) <= 1e-11);
  for (int i = 0; i < 12; i++) moved[i].z = 0;
  assert_int_equal(fs_junction_columns(&ctx, &aux, s.junction, 2, 7, 5, after), FS_OK);
  for (int i = 0; i < 24; i++) assert_true(after[i].z == 0);
}

/* With the mixed term left out, as a misread chain rule does, the curvatures differ. */
static void test_guard(void **state) {
  fs_context ctx = test_context();
  sample s;
  fs_surface *pair;
  fs_contact contact;
  (void)state;
  read_sample(cJSON_GetArrayItem(vectors_item(vectors, "junction_pairs"), 1), &s);
  assert_int_equal(fs_junction_pair(&ctx, &s.aux, s.junction, 2, 7, 5, NULL, &pair), FS_OK);
  assert_int_equal(fs_surface_contact(&ctx, pair, 10, &contact), FS_OK);
  assert_true(contact.curvature <= 1e-9);
  pair->data[3 * (2 + 8 * 2) + 2] += 1e-3;
  assert_int_equal(fs_surface_contact(&ctx, pair, 10, &contact), FS_OK);
  assert_true(contact.curvature > 1e-5 && contact.normal <= 1e-12);
  fs_surface_free(&ctx, pair);
}

static void test_far_columns_are_kept(void **state) {
  fs_context ctx = test_context();
  sample s;
  fs_vec3 far[24];
  fs_surface *pair;
  (void)state;
  read_sample(cJSON_GetArrayItem(vectors_item(vectors, "junction_pairs"), 0), &s);
  for (int i = 0; i < 24; i++) far[i] = (fs_vec3){i, 2 * i, -i};
  const fs_bezier_patch kept = {5, 3, far}, *const both[2] = {&kept, NULL};
  assert_int_equal(fs_junction_pair(&ctx, &s.aux, s.junction, 1, 5, 3, both, &pair), FS_OK);
  assert_memory_equal(pair->data + 3 * 12, far + 12, 12 * sizeof *far);
  fs_surface_free(&ctx, pair);
}

/* ---- bad input ---- */

static void refuse(const sample *s, int32_t order, int32_t degree_u, int32_t degree_v, fs_status expected,
                   const char *sentence) {
  fs_context ctx = test_context();
  fs_surface *pair = NULL;
  assert_int_equal(fs_junction_pair(&ctx, &s->aux, s->junction, order, degree_u, degree_v, NULL, &pair), expected);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" lacks \"%s\"", ctx.message, sentence);
  assert_null(pair);
}

static void test_bad_input(void **state) {
  static const double wave[3] = {1, -3, 1}, touching[3] = {1, -1, 1}, negative[3] = {-1, -0.1, -1};
  sample s;
  (void)state;
  read_sample(cJSON_GetArrayItem(vectors_item(vectors, "junction_pairs"), 1), &s);
  refuse(&s, 2, 6, 5, FS_ERR_ARGUMENT, "the final patch only 6");
  refuse(&s, 2, 7, 1, FS_ERR_ARGUMENT, "cannot meet a junction of order 2");
  refuse(&s, 3, 7, 5, FS_ERR_ARGUMENT, "order 1 or 2, not 3");
  refuse(&s, 2, 2, 5, FS_ERR_ARGUMENT, "the auxiliary patch has degree 3 along the edge, the final patch only 2");
  s.junction[1].function[FS_GAMMA_1] = s.junction[0].function[FS_GAMMA_1];
  refuse(&s, 2, 7, 5, FS_ERR_ARGUMENT, "meet in a cusp");
  s.junction[1].function[FS_GAMMA_1] = negative;
  s.junction[0].function[FS_GAMMA_1] = wave;
  refuse(&s, 2, 7, 5, FS_ERR_ARGUMENT, "gamma1 vanishes or changes its sign near u = 0.");
  s.junction[0].function[FS_GAMMA_1] = touching; /* (1 - 2 t)^2: zero at 1/2 */
  refuse(&s, 2, 7, 5, FS_ERR_ARGUMENT, "gamma1 vanishes or changes its sign near u = 0.5");
  s.junction[0].function[FS_GAMMA_1] = NULL;
  refuse(&s, 2, 7, 5, FS_ERR_ARGUMENT, "gamma1 is missing");
  read_sample(cJSON_GetArrayItem(vectors_item(vectors, "junction_pairs"), 1), &s);
  s.coefficient[0][FS_BETA_2][2] = NAN;
  refuse(&s, 2, 7, 5, FS_ERR_ARGUMENT, "coefficient 2 of beta2 is not finite");
  read_sample(cJSON_GetArrayItem(vectors_item(vectors, "junction_pairs"), 1), &s);
  for (int i = 0; i < 4; i++) s.point[i + 4] = s.point[i];
  refuse(&s, 2, 7, 5, FS_ERR_NUMERIC, "the auxiliary patch has no normal at its edge, near u = 0");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_vectors),   cmocka_unit_test(test_invariance),           cmocka_unit_test(test_guard),
      cmocka_unit_test(test_bad_input), cmocka_unit_test(test_far_columns_are_kept),
  };
  int failures;
  vectors = vectors_open("math/patches-vectors.json");
  if (vectors == NULL) return TEST_SKIPPED;
  failures = cmocka_run_group_tests(tests, NULL, NULL);
  cJSON_Delete(vectors);
  return failures;
}
