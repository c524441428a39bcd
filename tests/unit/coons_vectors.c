/* SPDX-License-Identifier: MIT */
/* Coons patches against numbers of an independent program (FAIRSURF_SHARED/math/patches-vectors.json). */
#include "coons_samples.h"
#include "vectors.h"
#include "math/diffgeo.h"

static cJSON *vectors;

static fs_coons prepare(const fs_coons_data *data) {
  fs_context ctx = test_context();
  fs_coons coons;
  if (fs_coons_prepare(&ctx, data, 1e-9, &coons) != FS_OK) fail_msg("%s", ctx.message);
  return coons;
}

static void test_manufactured(void **state) {
  static const char *const name[3] = {"bilinear", "bicubic", "biquintic"};
  const sample_square square = {sample_F, 0, 0, 1, {{0, 0, 0}}, {0, 0, 0}};
  (void)state;
  for (int k = 0; k < 3; k++) {
    sample_line line[2][6];
    fs_coons_data data = sample_coons(&square, 2 * k + 2, line);
    fs_coons coons = prepare(&data);
    fs_vec3 x[FS_JET_SIZE];
    double at[2];
    vectors_numbers(vectors_item(vectors, "coons_manufactured"), "at", 2, at);
    fs_coons_evaluate(&coons, at[0], at[1], x);
    vectors_compare_jet(vectors_item(vectors_item(vectors, "coons_manufactured"), name[k]), x);
  }
}

static void test_square(void **state) {
  const sample_square square = {sample_F, 0, 0, 1, {{0, 0, 0}}, {0, 0, 0}};
  const cJSON *object = vectors_item(vectors, "coons_gregory_square"), *eval;
  sample_line line[2][6];
  fs_coons_data data = sample_coons(&square, 4, line);
  fs_coons coons;
  fs_vec3 x[FS_JET_SIZE];
  (void)state;
  data.is_gregory = true;
  vectors_points(object, "w", 1, &line[1][2].bump);
  coons = prepare(&data);
  cJSON_ArrayForEach(eval, vectors_item(object, "evals")) {
    fs_coons_evaluate(&coons, vectors_number(eval, "u"), vectors_number(eval, "v"), x);
    vectors_compare_jet(vectors_item(eval, "ders"), x);
  }
}

/* The four sides of coons_bilinear and coons_cubic_blended. */
typedef struct sides {
  fs_vec3 point[4][4];
  fs_bezier_curve curve[4]; /* c0, c1, d0, d1 */
} sides;

static void read_sides(const cJSON *inputs, sides *s, fs_coons_data *data) {
  static const char *const name[4] = {"c0", "c1", "d0", "d1"};
  for (int k = 0; k < 4; k++) {
    int n = k == 2 ? 3 : 4;
    vectors_points(inputs, name[k], n, s->point[k]);
    s->curve[k] = (fs_bezier_curve){n - 1, s->point[k]};
  }
  *data = (fs_coons_data){.n_data = 2};
  for (int k = 0; k < 2; k++) {
    data->at_v[k] = (fs_curve){fs_bezier_evaluate, &s->curve[k]};
    data->at_u[k] = (fs_curve){fs_bezier_evaluate, &s->curve[2 + k]};
  }
}

/* The net of the file has v fastest. */
static void compare_net(const cJSON *object, const fs_surface *s) {
  int m = s->patch->degree_u, n = s->patch->degree_v;
  double turned[3 * 36];
  for (int i = 0; i <= m; i++)
    for (int j = 0; j <= n; j++)
      for (int d = 0; d < 3; d++) turned[3 * ((n + 1) * i + j) + d] = s->data[3 * (i + (m + 1) * j) + d];
  vectors_compare(object, "control_net", 3 * (m + 1) * (n + 1), turned, 1e-12);
}

static void check_blended(const char *name, int degree, const double *b0, const double *b1) {
  const cJSON *object = vectors_item(vectors, name), *eval;
  sides s;
  fs_coons_data data;
  fs_context ctx = test_context();
  fs_surface *surface = NULL;
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  read_sides(vectors_item(object, "inputs"), &s, &data);
  data.blend_degree = degree, data.blend[0] = b0, data.blend[1] = b1;
  fs_coons coons = prepare(&data);
  assert_int_equal(fs_coons_to_bezier(&ctx, &coons, &surface), FS_OK);
  assert_int_equal(surface->patch->degree_u, 3);
  assert_int_equal(surface->patch->degree_v, 3);
  compare_net(object, surface);
  cJSON_ArrayForEach(eval, vectors_item(object, "evals")) {
    fs_geometry g;
    fs_coons_evaluate(&coons, vectors_number(eval, "u"), vectors_number(eval, "v"), x);
    fs_surface_evaluate(surface, 0, vectors_number(eval, "u"), vectors_number(eval, "v"), y);
    vectors_compare_jet(vectors_item(eval, "ders"), x);
    vectors_compare_jet(vectors_item(eval, "ders"), y);
    assert_true(fs_geometry_compute(x, &g));
    vectors_compare(eval, "normal", 3, &g.normal.x, 1e-12);
    vectors_compare(eval, "K", 1, &g.K, 1e-10);
    vectors_compare(eval, "H", 1, &g.H, 1e-10);
  }
  fs_surface_free(&ctx, surface);
}

static void test_blended(void **state) {
  const double b0[4] = {1, 1, 0, 0}, b1[4] = {0, 0, 1, 1};
  (void)state;
  check_blended("coons_bilinear", 0, NULL, NULL);
  check_blended("coons_cubic_blended", 3, b0, b1);
}

static void test_adini(void **state) {
  sides s;
  fs_coons_data data;
  fs_vec3 twist[2][2];
  (void)state;
  read_sides(vectors_item(vectors_item(vectors, "coons_bilinear"), "inputs"), &s, &data);
  fs_adini_twists(data.at_u, data.at_v, twist);
  for (int k = 0; k < 4; k++) {
    const char name[3] = {(char)('0' + k / 2), (char)('0' + k % 2), 0};
    vectors_compare(vectors_item(vectors_item(vectors, "adini_twist"), "twist"), name, 3, &twist[k / 2][k % 2].x,
                    1e-12);
  }
}

/* Hermite data of corners: every curve is the polynomial that its own corners determine. */
static void check_hermite(const char *name, int n_data) {
  const cJSON *object = vectors_item(vectors, name);
  fs_vec3 Q[6][6], point[2][6][6], at0[3], at1[3];
  fs_bezier_curve curve[2][6];
  fs_coons_data data = {.n_data = n_data};
  fs_context ctx = test_context();
  fs_surface *surface = NULL;
  double flat[108];
  int degree = n_data - 1;
  vectors_numbers(object, "Q", 3 * n_data * n_data, flat);
  for (int k = 0; k < n_data * n_data; k++)
    Q[k / n_data][k % n_data] = (fs_vec3){flat[3 * k], flat[3 * k + 1], flat[3 * k + 2]};
  for (int is_v = 0; is_v < 2; is_v++)
    for (int a = 0; a < n_data; a++) {
      /* the curve of data a has the derivatives Q[a][(end, order)] at its ends; points of a Hermite polynomial */
      for (int order = 0; order < n_data / 2; order++) {
        at0[order] = is_v ? Q[2 * order][a] : Q[a][2 * order];
        at1[order] = is_v ? Q[2 * order + 1][a] : Q[a][2 * order + 1];
      }
      fs_vec3 *b = point[is_v][a];
      double n = degree;
      b[0] = at0[0], b[degree] = at1[0];
      b[1] = fs_vec3_add_scaled(b[0], at0[1], 1 / n);
      b[degree - 1] = fs_vec3_add_scaled(b[degree], at1[1], -1 / n);
      if (n_data == 6) {
        b[2] = fs_vec3_add_scaled(fs_vec3_add_scaled(b[0], at0[1], 2 / n), at0[2], 1 / (n * (n - 1)));
        b[3] = fs_vec3_add_scaled(fs_vec3_add_scaled(b[5], at1[1], -2 / n), at1[2], 1 / (n * (n - 1)));
      }
      curve[is_v][a] = (fs_bezier_curve){degree, b};
      (is_v ? data.at_v : data.at_u)[a] = (fs_curve){fs_bezier_evaluate, &curve[is_v][a]};
    }
  fs_coons coons = prepare(&data);
  assert_int_equal(fs_coons_to_bezier(&ctx, &coons, &surface), FS_OK);
  compare_net(object, surface);
  fs_surface_free(&ctx, surface);
}

static void test_hermite(void **state) {
  (void)state;
  check_hermite("hermite_bicubic", 4);
  check_hermite("hermite_biquintic", 6);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_manufactured), cmocka_unit_test(test_square),
                                     cmocka_unit_test(test_blended), cmocka_unit_test(test_adini),
                                     cmocka_unit_test(test_hermite)};
  vectors = vectors_open("math/patches-vectors.json");
  if (vectors == NULL) return TEST_SKIPPED;
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  cJSON_Delete(vectors);
  return failed;
}
