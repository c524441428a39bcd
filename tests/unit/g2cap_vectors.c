/* SPDX-License-Identifier: MIT */
/* Caps of valence 3, 5, 6, 8 against numbers of an independent program (FAIRSURF_SHARED/math/g2-holes-vectors.json):
   every step of the construction, matrices, energies, and geometry at points of filled nets. */
#include "g2cap_samples.h"
#include <cjson/cJSON.h>
#include <stdio.h>

static cJSON *vectors;

static const cJSON *item(const cJSON *object, const char *name) {
  const cJSON *found = cJSON_GetObjectItemCaseSensitive(object, name);
  if (found == NULL) fail_msg("the file has no \"%s\"", name);
  return found;
}

/* Flattens nested arrays of numbers into out; returns how many there are. */
static int flatten(const cJSON *array, double *out) {
  int n = 0;
  if (cJSON_IsNumber(array)) {
    *out = array->valuedouble;
    return 1;
  }
  for (const cJSON *child = array->child; child != NULL; child = child->next) n += flatten(child, out + n);
  return n;
}

static double *numbers(const cJSON *object, const char *name, int expected) {
  double *out = calloc((size_t)expected + 1, sizeof *out);
  const cJSON *array = item(object, name);
  assert_int_equal(flatten(array, out), expected);
  return out;
}

static void compare(const cJSON *object, const char *name, int n, const double *ours, double tolerance) {
  double *theirs = numbers(object, name, n);
  for (int i = 0; i < n; i++)
    if (!(fabs(ours[i] - theirs[i]) <= tolerance))
      fail_msg("%s[%d]: %.17g is not %.17g (difference %.3g)", name, i, ours[i], theirs[i], ours[i] - theirs[i]);
  free(theirs);
}

/* The file numbers Bezier points 10 i + j. */
static void compare_patch(const cJSON *object, const char *name, int width, const double *ours, double tolerance) {
  double *turned = calloc((size_t)(100 * width), sizeof *turned);
  for (int row = 0; row < 100; row++)
    memcpy(turned + row * width, ours + (row / 10 + 10 * (row % 10)) * width, (size_t)width * sizeof *turned);
  compare(object, name, 100 * width, turned, tolerance);
  free(turned);
}

static void check_domain(const cJSON *from, const construction *c) {
  static const char *const curve[3] = {"r", "r_s", "r_ss"};
  const cJSON *curves = item(from, "aux_domain_curve_0"), *functions = item(from, "junction_sector_0");
  double centre[3][5][2] = {{{0}}}, end[3][3][2], *positions;
  fs_g2cap_curves spoke;
  near(c->eigenvalue, item(from, "eigenvalue")->valuedouble, 1e-15);
  compare(from, "domain_net", 2 * c->n, c->net, 1e-13);
  memcpy(centre[0][1], c->domain.e[0], sizeof centre[0][1]);
  memcpy(centre[1][0], c->domain.n[0], sizeof centre[1][0]);
  fs_g2cap_ring_jet(0, 2, c->domain.grid[0], end[0][0]);
  fs_g2cap_spoke_curves(2, centre[0][0], end[0][0], &spoke);
  for (int n = 0; n < 3; n++) compare(curves, curve[n], 2 * (spoke.degree[n] + 1), spoke.value[n], 1e-13);
  for (int f = 0; f < 16; f++) {
    const char name[] = {"bcfg"[f / 4], (char)('0' + f / 2 % 2), (char)('1' + f % 2), 0};
    compare(functions, name, c->junction.degree[f] + 1, c->junction.polynomial[f], 1e-13);
  }
  compare_patch(from, "domain_patch_0", 2, c->chart, 1e-13);
  positions = numbers(from, "relevant_in_ext", c->n);
  for (int b = 0; b <= 2; b++)
    for (int a = 1; a <= 2; a++)
      assert_int_equal(third_vertex(c->k, 1, a, b), (int)positions[fs_g2cap_vertex(c->k, 1, a, b)]);
  free(positions);
}

/* Matrix, energy and filled patch of one kind of cap: matrix [100][6k+1] is left. */
static void check_cap(const cJSON *from, const construction *c, const char *kind, double *matrix) {
  char name[80];
  double points[300], trace = 0, phi = 0, *net = numbers(from, "random_net", 3 * c->n), expected;
  fs_g2cap_matrix(c->ritz, matrix);
  snprintf(name, sizeof name, "matrix_%s", kind);
  compare_patch(from, name, c->n, matrix, 1e-11);
  fill_sector(c->k, matrix, 0, 3, net, points);
  snprintf(name, sizeof name, "filled_%s_patch_0", kind);
  compare_patch(from, name, 3, points, 1e-11);
  for (int i = 0; i < c->n; i++) {
    trace += c->ritz->energy[i * c->n + i];
    for (int j = 0; j < c->n; j++)
      for (int w = 0; w < 3; w++) phi += net[3 * i + w] * c->ritz->energy[i * c->n + j] * net[3 * j + w];
  }
  snprintf(name, sizeof name, "trace_K_%s", kind);
  expected = item(from, name)->valuedouble;
  near(trace, expected, 1e-11 * expected);
  snprintf(name, sizeof name, "phi_random_%s", kind);
  expected = item(from, name)->valuedouble;
  near(phi, expected, 1e-11 * expected);
  free(net);
}

static double length(const double *a, int n) {
  double sum = 0;
  for (int i = 0; i < n; i++) sum += a[i] * a[i];
  return sqrt(sum);
}

/* Position, normal, H, K and, where the file has them, gradient of H and shape tensor. */
static void check_sample(const cJSON *sample, const fs_vec3 *x) {
  fs_geometry g;
  double W[3][3], size, *theirs;
  assert_true(fs_geometry_compute(x, &g));
  compare(sample, "pos", 3, &x[0].x, 1e-11);
  compare(sample, "normal", 3, &g.normal.x, 1e-11);
  size = 1 + fabs(g.H) + sqrt(fabs(g.K)); /* curvature */
  near(g.H, item(sample, "H")->valuedouble, 1e-11 * size);
  near(g.K, item(sample, "K")->valuedouble, 1e-11 * size * size);
  if (!cJSON_HasObjectItem(sample, "gradH")) return;
  fs_geometry_shape_tensor(&g, W);
  compare(sample, "shape_tensor", 9, W[0], 1e-11 * size);
  fs_vec3 gradient = fs_geometry_mean_gradient(x, &g);
  theirs = numbers(sample, "gradH", 3);
  for (int i = 0; i < 3; i++) near((&gradient.x)[i], theirs[i], 1e-11 * (size * size + length(theirs, 3)));
  free(theirs);
}

static void check_samples(const cJSON *from, const construction *c, const double *matrix) {
  double *net = numbers(from, "random_net", 3 * c->n), *wide = numbers(from, "random_net_ext", 3 * (12 * c->k + 1));
  const cJSON *sample;
  double points[300], ring[48], *theirs = numbers(from, "ring_patch_sector0_face_1_0", 48);
  fs_vec3 x[FS_JET_SIZE];
  int n_samples = 0;
  cJSON_ArrayForEach(sample, item(from, "samples_extended")) {
    fill_sector(c->k, matrix, item(sample, "sector")->valueint, 3, net, points);
    patch_jet(9, points, item(sample, "u")->valuedouble, item(sample, "v")->valuedouble, x);
    check_sample(sample, x);
    n_samples++;
  }
  assert_true(n_samples >= 21);
  ring_patch(c->k, 0, 1, 0, wide, ring);
  for (int row = 0; row < 16; row++)
    for (int w = 0; w < 3; w++) near(ring[3 * (row / 4 + 4 * (row % 4)) + w], theirs[3 * row + w], 1e-13);
  patch_jet(3, ring, 0, 0.3, x);
  check_sample(item(from, "ring_sample_u0_v03"), x);
  fill_sector(c->k, matrix, 0, 3, net, points); /* the cap itself has the same geometry there */
  patch_jet(9, points, 1, 0.3, x);
  check_sample(item(from, "ring_sample_u0_v03"), x);
  free(net);
  free(wide);
  free(theirs);
}

static void test_vectors(void **state) {
  fs_context ctx = test_context();
  const cJSON *from;
  int n_cases = 0;
  (void)state;
  cJSON_ArrayForEach(from, item(vectors, "cases")) {
    const fs_g2cap_options extended = {0}, basic = {.basic = true}, composite = {.n_nodes = 16, .composite = true};
    int k = item(from, "k")->valueint;
    construction *c = construct(&ctx, k, &extended), *b = construct(&ctx, k, &basic);
    double *matrix = calloc((size_t)(100 * c->n), sizeof *matrix);
    assert_int_equal(item(from, "dim_V0_basic")->valueint, fs_g2cap_n_functions(k));
    check_domain(from, c);
    check_cap(from, b, "basic", matrix);
    check_cap(from, c, "extended", matrix);
    check_samples(from, c, matrix);
    if (cJSON_HasObjectItem(from, "matrix_extended_composite_gauss_2x8")) {
      fs_g2cap *cap;
      assert_int_equal(fs_g2cap_create(&ctx, k, &composite, &cap), FS_OK);
      compare_patch(from, "matrix_extended_composite_gauss_2x8", c->n, cap->matrix, 1e-11);
      fs_g2cap_free(&ctx, cap);
      n_cases += 100;
    }
    free(matrix);
    destroy(&ctx, b);
    destroy(&ctx, c);
    n_cases++;
  }
  assert_int_equal(n_cases, 104); /* four valences, one of them with the composite rule */
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_vectors)};
  const char *path = test_shared("math/g2-holes-vectors.json");
  size_t size;
  char *text;
  int failures;
  if (path == NULL) return TEST_SKIPPED;
  text = test_file(path, &size);
  vectors = cJSON_Parse(text);
  free(text);
  failures = cmocka_run_group_tests(tests, NULL, NULL);
  cJSON_Delete(vectors);
  return failures;
}
