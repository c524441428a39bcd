/* SPDX-License-Identifier: MIT */
/* Stacho's G1 surfaces against the numbers of an independent program (FAIRSURF_SHARED/math/patches-vectors.json), what its
   corrections change, and tangent planes along the edges of meshes from elsewhere. */
#include <fairsurf/construct.h>
#include "math/bernstein.h"
#include "math/triangle.h"
#include "surface/stacho.h"
#include "stacho_samples.h"
#include <string.h>

static cJSON *vectors;

static void compare_jet(const cJSON *sample, const fs_vec3 *x) {
  fs_geometry g;
  double K, H;
  vectors_compare_jet(vectors_item(sample, "ders_st"), x);
  assert_true(fs_geometry_compute(x, &g));
  vectors_compare(sample, "normal", 3, &g.normal.x, 1e-12);
  K = g.K, H = g.H;
  vectors_compare(sample, "K", 1, &K, 1e-10);
  vectors_compare(sample, "H", 1, &H, 1e-10);
}

static void compare_triangle(const cJSON *points, const fs_surface *s, int32_t p) {
  int32_t n = s->patch[p].degree_u;
  const cJSON *one;
  cJSON_ArrayForEach(one, points) {
    int32_t at = fs_triangle_index(n, one->string[1] - '0', one->string[2] - '0');
    double theirs[3];
    vectors_flatten(one, theirs);
    vectors_agree(one->string, 3, s->data + s->patch[p].data_start + 3 * at, theirs, 1e-12);
  }
  assert_int_equal(cJSON_GetArraySize(points), fs_triangle_size(n));
}

/* E', D and D' in the way of the file, from the control points. */
static void compare_edge(const cJSON *result, const fs_surface *s) {
  double r0[2][24], r1[2][21], E1[21], D[2][21];
  int32_t n = s->patch[0].degree_u;
  fs_triangle_edge_rows(n, 3, s->data + s->patch[0].data_start, 0, r0[0], r1[0]);
  fs_triangle_edge_rows(n, 3, s->data + s->patch[1].data_start, 1, r0[1], r1[1]);
  for (int i = 0; i < n; i++)
    for (int w = 0; w < 3; w++) {
      int back = n - 1 - i;
      E1[3 * i + w] = n * (r0[0][3 * (i + 1) + w] - r0[0][3 * i + w]);
      D[0][3 * i + w] = n * (r1[0][3 * i + w] - (r0[0][3 * i + w] + r0[0][3 * (i + 1) + w]) / 2);
      D[1][3 * back + w] = n * (r1[1][3 * i + w] - (r0[1][3 * i + w] + r0[1][3 * (i + 1) + w]) / 2);
    }
  vectors_compare(result, "E_prime", 3 * n, E1, 1e-12);
  vectors_compare(result, "D", 3 * n, D[0], 1e-12);
  vectors_compare(result, "Dbar", 3 * n, D[1], 1e-12);
}

static void compare_correction(const cJSON *result, const fs_surface *s) {
  static const char *const at[4] = {"0.0", "0.25", "0.5", "1.0"};
  int32_t n = s->patch[0].degree_u;
  const double *block = s->data + s->patch[0].data_start + fs_stacho_side(n, 1);
  const double *reversed = s->data + s->patch[1].data_start + fs_stacho_side(n, 2);
  assert_true(block[FS_STACHO_IS_CORRECTED] == 1 && reversed[FS_STACHO_IS_CORRECTED] == 1);
  vectors_compare(result, "delta", 3 * n - 6, block + FS_STACHO_DELTA, 1e-12);
  vectors_compare(result, "N", 3 * (2 * n - 1), block + fs_stacho_n(n), 1e-12);
  for (int i = 0; i < 4; i++) {
    double V[4][3], back[4][3], t = atof(at[i]);
    fs_stacho_correction(block, n, t, V);
    fs_stacho_correction(reversed, n, 1 - t, back);
    vectors_compare(vectors_item(result, "V_at"), at[i], 9, V[0], 1e-12);
    vectors_agree("V from the other side", 3, back[0], V[0], 1e-13);
  }
}

typedef struct pair {
  fs_mesh *mesh;
  fs_vec3 normal[4];
  double shape[24];
} pair;

static pair vector_pair(const cJSON *from) {
  pair made;
  double P[12], N[12], II[36], F[6];
  int32_t corner[6], start[3] = {0, 3, 6};
  vectors_numbers(from, "P", 12, P);
  vectors_numbers(from, "N", 12, N);
  vectors_numbers(from, "II", 36, II);
  vectors_numbers(from, "F", 6, F);
  for (int i = 0; i < 6; i++) corner[i] = (int32_t)F[i];
  made.mesh = test_mesh(4, (const fs_vec3 *)(const void *)P, 2, start, corner);
  for (int v = 0; v < 4; v++) {
    static const int upper[6] = {0, 1, 2, 4, 5, 8};
    made.normal[v] = (fs_vec3){N[3 * v], N[3 * v + 1], N[3 * v + 2]};
    for (int k = 0; k < 6; k++) made.shape[6 * v + k] = II[9 * v + upper[k]];
  }
  return made;
}

static void test_vectors(void **state) {
  static const char *const name[3] = {"c", "b", "a"};
  const cJSON *from = vectors_item(vectors, "stacho_3d_pair"), *sample;
  fs_context ctx = test_context();
  pair p = vector_pair(from);
  (void)state;
  for (int variant = 0; variant < 3; variant++) {
    const cJSON *result = vectors_item(vectors_item(from, "results"), name[variant]);
    fs_surface *s = build(p.mesh, p.normal, p.shape, (fs_stacho_options){.variant = (fs_stacho_variant)variant});
    int n_samples = 0;
    compare_triangle(vectors_item(result, "bezier_tri0"), s, 0);
    compare_triangle(vectors_item(result, "bezier_tri1"), s, 1);
    compare_edge(result, s);
    compare_correction(result, s);
    cJSON_ArrayForEach(sample, vectors_item(result, "evals")) {
      double l[3];
      fs_vec3 x[FS_JET_SIZE];
      vectors_numbers(sample, "lam", 3, l);
      fs_surface_evaluate(s, vectors_item(sample, "tri")->valueint, l[1], l[2], x);
      compare_jet(sample, x);
      n_samples++;
    }
    assert_int_equal(n_samples, 4);
    fs_surface_free(&ctx, s);
  }
  fs_mesh_free(&ctx, p.mesh);
}

static void test_tensor_vector(void **state) {
  const cJSON *from = vectors_item(vectors, "estimate_II");
  static const int upper[6] = {0, 1, 2, 4, 5, 8};
  fs_context ctx = test_context();
  double P[18], F[15], n0[3], II[9], shape[36], theirs[6];
  int32_t corner[15], start[6];
  fs_vec3 normal[6];
  (void)state;
  vectors_numbers(from, "P", 18, P);
  vectors_numbers(from, "F", 15, F);
  vectors_numbers(from, "n0", 3, n0);
  vectors_numbers(from, "II0", 9, II);
  for (int i = 0; i < 15; i++) corner[i] = (int32_t)F[i];
  for (int f = 0; f < 6; f++) start[f] = 3 * f;
  for (int v = 0; v < 6; v++) normal[v] = (fs_vec3){n0[0], n0[1], n0[2]};
  fs_mesh *mesh = test_mesh(6, (const fs_vec3 *)(const void *)P, 5, start, corner);
  assert_int_equal(fs_mesh_shape_tensors(&ctx, mesh, normal, shape), FS_OK);
  for (int k = 0; k < 6; k++) theirs[k] = II[upper[k]];
  vectors_agree("tensor", 6, shape, theirs, 1e-12);
  fs_mesh_free(&ctx, mesh);
}

/* Corrections leave the other two sides as they are: positions and first derivatives. */
static void test_corrections_stay_at_their_sides(void **state) {
  fs_context ctx = test_context();
  pair p = vector_pair(vectors_item(vectors, "stacho_3d_pair"));
  fs_surface *s = build(p.mesh, p.normal, p.shape, (fs_stacho_options){.tangent = FS_STACHO_ARC});
  fs_vec3 x[4][FS_JET_SIZE];
  double gap[2];
  (void)state;
  measure_gaps(s, gap);
  assert_true(gap[1] <= 1e-10);
  for (int pass = 0; pass < 2; pass++) {
    fs_surface_evaluate(s, 0, 0.7, 0, x[2 * pass]);     /* on side 0 */
    fs_surface_evaluate(s, 0, 0, 0.4, x[2 * pass + 1]); /* on side 2 */
    s->data[s->patch[0].data_start + fs_stacho_side(7, 1)] = 0;
    s->data[s->patch[1].data_start + fs_stacho_side(7, 2)] = 0;
  }
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 2; i++) assert_true(fs_vec3_distance(x[i][k], x[i + 2][k]) <= 1e-15);
  measure_gaps(s, gap);
  assert_true(gap[0] <= 1e-15 && gap[1] > 1e-3); /* without corrections there is a crease */
  fs_surface_free(&ctx, s);
  fs_mesh_free(&ctx, p.mesh);
}

/* The source gives the other triangle the correction with the opposite sign: a crease stays. */
static void test_misprint(void **state) {
  fs_context ctx = test_context();
  pair p = vector_pair(vectors_item(vectors, "stacho_3d_pair"));
  fs_surface *s = build(p.mesh, p.normal, p.shape, (fs_stacho_options){.variant = FS_STACHO_FIRST_ORDER});
  double *delta = s->data + s->patch[1].data_start + fs_stacho_side(6, 2) + FS_STACHO_DELTA, gap[2];
  (void)state;
  for (int i = 0; i < 12; i++) delta[i] = -delta[i];
  measure_gaps(s, gap);
  assert_true(gap[1] > 0.05);
  fs_surface_free(&ctx, s);
  fs_mesh_free(&ctx, p.mesh);
}

static void test_shared_meshes(void **state) {
  static const char *const name[] = {"pmp_chamfer-cube", "catmark_rook", "catmark_pawn"};
  fs_context ctx = test_context();
  (void)state;
  for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
    fs_mesh *mesh = triangulated(test_shared_mesh(name[i]));
    fs_surface *s = build(mesh, NULL, NULL, (fs_stacho_options){.variant = FS_STACHO_SECOND_ORDER});
    assert_smooth(s, 4);
    fs_surface_free(&ctx, s);
    fs_mesh_free(&ctx, mesh);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_vectors),
      cmocka_unit_test(test_tensor_vector),
      cmocka_unit_test(test_corrections_stay_at_their_sides),
      cmocka_unit_test(test_misprint),
      cmocka_unit_test(test_shared_meshes),
  };
  int failures;
  vectors = vectors_open("math/patches-vectors.json");
  if (vectors == NULL) return TEST_SKIPPED;
  failures = cmocka_run_group_tests(tests, NULL, NULL);
  cJSON_Delete(vectors);
  return failures;
}
