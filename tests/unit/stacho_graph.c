/* SPDX-License-Identifier: MIT */
/* Stacho's graphs: numbers of an independent program (FAIRSURF_SHARED/math/patches-vectors.json), C1, interpolation, what
   is reproduced, invariance; the misprints of the source must fail. */
#include <fairsurf/construct_stacho.h>
#include "math/triangle.h"
#include "math/vec3.h"
#include "vectors.h"
#include <string.h>

enum { N_VARIANTS = 3 };
static cJSON *vectors;

/* ---- samples ---- */

/* Random triangulated n x n grid over the plane, moved. */
static fs_mesh *random_triangulation(int n, uint64_t seed) {
  fs_vec3 *position = calloc((size_t)((n + 1) * (n + 1)), sizeof *position);
  int32_t *start = calloc((size_t)(2 * n * n + 1), sizeof *start),
          *corner = calloc((size_t)(6 * n * n), sizeof *corner);
  fs_mesh *mesh;
  int k = 0;
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= n; i++)
      position[i + (n + 1) * j] = (fs_vec3){i + test_random_real(&seed, -0.2, 0.2),
                                            j + test_random_real(&seed, -0.2, 0.2), test_random_real(&seed, -1, 1)};
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      int a = i + (n + 1) * j, b = a + 1, c = a + n + 2, d = a + n + 1, turned = (int)(test_random(&seed) % 2);
      const int32_t two[2][6] = {{a, b, c, a, c, d}, {a, b, d, b, c, d}};
      memcpy(corner + k, two[turned], sizeof two[turned]);
      k += 6;
    }
  for (int f = 0; f <= 2 * n * n; f++) start[f] = 3 * f;
  mesh = test_mesh((n + 1) * (n + 1), position, 2 * n * n, start, corner);
  free(position), free(start), free(corner);
  return mesh;
}

typedef struct data {
  double *gradient, *hessian;
} data;

static data random_data(const fs_mesh *mesh, uint64_t seed) {
  data d = {calloc(2 * (size_t)mesh->n_vertices, sizeof(double)), calloc(3 * (size_t)mesh->n_vertices, sizeof(double))};
  for (int32_t i = 0; i < 2 * mesh->n_vertices; i++) d.gradient[i] = test_random_real(&seed, -1, 1);
  for (int32_t i = 0; i < 3 * mesh->n_vertices; i++) d.hessian[i] = test_random_real(&seed, -1, 1);
  return d;
}

static void free_data(data d) { free(d.gradient), free(d.hessian); }

/* Value, gradient and Hessian (xx, xy, yy) of z over the plane from the derivatives by (u, v); x and y are linear. */
static void plane_jet(const fs_surface *s, int32_t p, double u, double v, double out[6]) {
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(s, p, u, v, x);
  double a = x[FS_DU].x, b = x[FS_DU].y, c = x[FS_DV].x, d = x[FS_DV].y, det = a * d - b * c;
  const double ux = d / det, vx = -b / det, uy = -c / det, vy = a / det;
  out[0] = x[FS_D].z;
  out[1] = x[FS_DU].z * ux + x[FS_DV].z * vx;
  out[2] = x[FS_DU].z * uy + x[FS_DV].z * vy;
  out[3] = x[FS_DUU].z * ux * ux + 2 * x[FS_DUV].z * ux * vx + x[FS_DVV].z * vx * vx;
  out[4] = x[FS_DUU].z * ux * uy + x[FS_DUV].z * (ux * vy + uy * vx) + x[FS_DVV].z * vx * vy;
  out[5] = x[FS_DUU].z * uy * uy + 2 * x[FS_DUV].z * uy * vy + x[FS_DVV].z * vy * vy;
}

static fs_surface *graph(const fs_mesh *mesh, const data *d, fs_stacho_graph_options options) {
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  fs_status status =
      fs_stacho_graph(&ctx, mesh, d == NULL ? NULL : d->gradient, d == NULL ? NULL : d->hessian, &options, &s);
  if (status != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(fs_surface_validate(&ctx, s), FS_OK);
  return s;
}

/* Largest difference of values and gradients across inner sides. */
static double c1_error(const fs_surface *s) {
  double largest = 0;
  for (int32_t p = 0; p < s->n_patches; p++)
    for (int side = 0; side < 3; side++)
      for (int i = 0; i <= 10 && s->patch[p].neighbour[side] != FS_NONE; i++) {
        double a[6], b[6], u, v;
        fs_side_parameters(3, side, i / 10.0, &u, &v);
        plane_jet(s, p, u, v, a);
        fs_side_parameters(3, s->patch[p].neighbour_side[side], 1 - i / 10.0, &u, &v);
        plane_jet(s, s->patch[p].neighbour[side], u, v, b);
        for (int k = 0; k < 3; k++) largest = fmax(largest, fabs(a[k] - b[k]));
      }
  return largest;
}

static double largest_deviation(const fs_surface *s, double (*f)(double x, double y)) {
  static const double at[][2] = {{0.3, 0.5}, {1.0 / 3, 1.0 / 3}, {0.7, 0.2}, {0.1, 0.1}, {0.5, 0}};
  double largest = 0;
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t p = 0; p < s->n_patches; p++)
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
      fs_surface_evaluate(s, p, at[i][0], at[i][1], x);
      largest = fmax(largest, fabs(x[FS_D].z - f(x[FS_D].x, x[FS_D].y)));
    }
  return largest;
}

/* ---- numbers of another program ---- */

static fs_mesh *vector_mesh(const cJSON *from, double A[10], double H[15]) {
  double X[10], f[5], corners[9], full[20];
  fs_vec3 position[5];
  int32_t corner[9], start[4] = {0, 3, 6, 9};
  vectors_numbers(from, "X", 10, X);
  vectors_numbers(from, "f", 5, f);
  vectors_numbers(from, "A", 10, A);
  vectors_numbers(from, "Hess", 20, full);
  vectors_numbers(from, "T", 9, corners);
  for (int v = 0; v < 5; v++) {
    position[v] = (fs_vec3){X[2 * v], X[2 * v + 1], f[v]};
    H[3 * v] = full[4 * v], H[3 * v + 1] = full[4 * v + 1], H[3 * v + 2] = full[4 * v + 3];
  }
  for (int i = 0; i < 9; i++) corner[i] = (int32_t)corners[i];
  return test_mesh(5, position, 3, start, corner);
}

static void check_coefficients(const fs_surface *s, const cJSON *coefficients) {
  int32_t p = 0, n = s->patch[0].degree_u;
  const cJSON *triangle, *one;
  cJSON_ArrayForEach(triangle, coefficients) {
    int32_t count = 0;
    cJSON_ArrayForEach(one, triangle) {
      int32_t at = fs_triangle_index(n, one->string[1] - '0', one->string[2] - '0');
      vectors_agree(one->string, 1, s->data + s->patch[p].data_start + 3 * at + 2, &one->valuedouble, 1e-12);
      count++;
    }
    assert_int_equal(count, fs_triangle_size(n));
    p++;
  }
  assert_int_equal(p, 3);
}

/* The weights of the directions across the edges, out of the coefficients of the quintic. */
static void check_alpha(const fs_surface *s, const fs_mesh *mesh, const double *A, const cJSON *result) {
  double theirs[9];
  vectors_numbers(result, "alpha", 9, theirs);
  for (int p = 0; p < 3; p++)
    for (int k = 0; k < 3; k++) {
      int32_t e[3] = {2, 2, 2}, i = mesh->origin[3 * p + (k + 1) % 3], j = mesh->origin[3 * p + (k + 2) % 3];
      double dx = mesh->position[j].x - mesh->position[i].x, dy = mesh->position[j].y - mesh->position[i].y;
      double a = mesh->position[i].z + 0.4 * (A[2 * i] * dx + A[2 * i + 1] * dy);
      double b = mesh->position[j].z - 0.4 * (A[2 * j] * dx + A[2 * j + 1] * dy), alpha;
      e[k] = 1;
      alpha = (s->data[s->patch[p].data_start + 3 * (size_t)fs_triangle_at(e) + 2] - b) / (a - b);
      vectors_agree("alpha", 1, &alpha, &theirs[3 * p + k], 1e-12);
    }
}

static void test_vectors(void **state) {
  static const char *const name[N_VARIANTS][2] = {{"c_perp", "c_opp"}, {"b_perp", "b_opp"}, {"a_perp", "a_opp"}};
  const cJSON *from = vectors_item(vectors, "stacho_2d");
  double A[10], H[15], x[2], theirs[7], ours[6];
  fs_mesh *mesh = vector_mesh(from, A, H);
  fs_context ctx = test_context();
  data d = {A, H};
  (void)state;
  for (int variant = 0; variant < N_VARIANTS; variant++)
    for (int direction = 0; direction < 2; direction++) {
      const cJSON *result = vectors_item(vectors_item(from, "results"), name[variant][direction]);
      fs_surface *s = graph(mesh, &d,
                            (fs_stacho_graph_options){.variant = (fs_stacho_variant)variant,
                                                      .direction = (fs_stacho_direction)direction});
      assert_int_equal(s->patch[0].degree_u, 7 - variant);
      check_coefficients(s, vectors_item(result, "coeffs"));
      if (variant == FS_STACHO_QUINTIC) check_alpha(s, mesh, A, result);
      vectors_numbers(result, "at_x", 2, x);
      fs_vec3 o = mesh->position[0], e = fs_vec3_sub(mesh->position[1], o), f = fs_vec3_sub(mesh->position[2], o);
      double det = e.x * f.y - e.y * f.x;
      plane_jet(s, 0, ((x[0] - o.x) * f.y - (x[1] - o.y) * f.x) / det, ((x[1] - o.y) * e.x - (x[0] - o.x) * e.y) / det,
                ours);
      vectors_numbers(result, "value_grad_hess", 7, theirs);
      theirs[5] = theirs[6]; /* the Hessian of the file has both mixed derivatives */
      vectors_agree("value and gradient", 3, ours, theirs, 1e-12);
      vectors_agree("Hessian", 3, ours + 3, theirs + 3, 1e-10);
      fs_surface_free(&ctx, s);
    }
  fs_mesh_free(&ctx, mesh);
}

/* ---- laws ---- */

static void test_continuity_and_interpolation(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = random_triangulation(4, 3);
  data d = random_data(mesh, 4);
  (void)state;
  for (int variant = 0; variant < N_VARIANTS; variant++)
    for (int direction = 0; direction < 2; direction++) {
      fs_surface *s = graph(mesh, &d,
                            (fs_stacho_graph_options){.variant = (fs_stacho_variant)variant,
                                                      .direction = (fs_stacho_direction)direction});
      assert_true(c1_error(s) <= 1e-11);
      for (int32_t h = 0; h < mesh->n_halfedges; h++) {
        int32_t v = mesh->origin[h];
        double x[6], u, w, expected[6] = {mesh->position[v].z, d.gradient[2 * v], d.gradient[2 * v + 1]};
        if (variant == FS_STACHO_SECOND_ORDER) memcpy(expected + 3, d.hessian + 3 * v, 3 * sizeof(double));
        fs_side_parameters(3, h % 3, 0, &u, &w);
        plane_jet(s, h / 3, u, w, x);
        vectors_agree("at a vertex", 3, x, expected, 1e-12);
        vectors_agree("Hessian at a vertex", 3, x + 3, expected + 3, 1e-10); /* flat but for the second order */
      }
      fs_surface_free(&ctx, s);
    }
  free_data(d);
  fs_mesh_free(&ctx, mesh);
}

static double constant(double x, double y) { return 0 * (x + y) + 1.5; }
static double affine(double x, double y) { return 1 + 0.7 * x - 1.3 * y; }
static double quadratic(double x, double y) { return affine(x, y) + 0.5 * x * x + 0.4 * x * y - y * y; }

/* Heights and exact derivatives of f = value + A x + quadratic part. */
static data exact_data(fs_mesh *mesh, double (*f)(double, double), double a, double b) {
  data d = random_data(mesh, 1);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    fs_vec3 *p = &mesh->position[v];
    double second = f == quadratic;
    p->z = f(p->x, p->y);
    d.gradient[2 * v] = a + second * (p->x + 0.4 * p->y), d.gradient[2 * v + 1] = b + second * (0.4 * p->x - 2 * p->y);
    d.hessian[3 * v] = second, d.hessian[3 * v + 1] = 0.4 * second, d.hessian[3 * v + 2] = -2 * second;
  }
  return d;
}

static double reproduction_error(fs_stacho_graph_options options, double (*f)(double, double), bool is_estimated) {
  fs_context ctx = test_context();
  fs_mesh *mesh = random_triangulation(4, 8);
  data d = exact_data(mesh, f, f == constant ? 0 : 0.7, f == constant ? 0 : -1.3);
  fs_surface *s = graph(mesh, is_estimated ? NULL : &d, options);
  double error = largest_deviation(s, f);
  fs_surface_free(&ctx, s);
  free_data(d);
  fs_mesh_free(&ctx, mesh);
  return error;
}

static void test_reproduction(void **state) {
  const fs_stacho_graph_options quintic = {.variant = FS_STACHO_QUINTIC}, first = {.variant = FS_STACHO_FIRST_ORDER};
  const fs_stacho_graph_options second = {.variant = FS_STACHO_SECOND_ORDER};
  (void)state;
  assert_true(reproduction_error(quintic, constant, false) <= 1e-13);
  assert_true(reproduction_error(quintic, affine, false) > 1e-3);
  assert_true(reproduction_error(first, affine, false) <= 1e-12);
  assert_true(reproduction_error(first, quadratic, false) > 1e-3);
  assert_true(reproduction_error(second, quadratic, false) <= 1e-12);
  assert_true(reproduction_error(second, quadratic, true) <= 1e-10); /* estimated derivatives are exact for these */
}

/* z at a point of every triangle, of data moved by a linear map M of the plane (gradients by its inverse transpose). */
static void heights(fs_mesh *mesh, const data *d, fs_stacho_direction direction, const double M[4], double *z) {
  fs_context ctx = test_context();
  fs_mesh *moved;
  data e = random_data(mesh, 1);
  double det = M[0] * M[3] - M[1] * M[2];
  fs_vec3 x[FS_JET_SIZE];
  assert_int_equal(fs_mesh_copy(&ctx, mesh, &moved), FS_OK);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    fs_vec3 p = mesh->position[v];
    const double *g = d->gradient + 2 * v;
    moved->position[v] = (fs_vec3){M[0] * p.x + M[1] * p.y + 1, M[2] * p.x + M[3] * p.y - 2, p.z};
    e.gradient[2 * v] = (M[3] * g[0] - M[2] * g[1]) / det, e.gradient[2 * v + 1] = (M[0] * g[1] - M[1] * g[0]) / det;
  }
  fs_surface *s = graph(moved, &e, (fs_stacho_graph_options){.variant = FS_STACHO_FIRST_ORDER, .direction = direction});
  for (int32_t p = 0; p < s->n_patches; p++) {
    fs_surface_evaluate(s, p, 0.3, 0.45, x);
    z[p] = x[FS_D].z;
  }
  fs_surface_free(&ctx, s);
  free_data(e);
  fs_mesh_free(&ctx, moved);
}

static double invariance_error(fs_stacho_direction direction, const double M[4]) {
  static const double identity[4] = {1, 0, 0, 1};
  fs_context ctx = test_context();
  fs_mesh *mesh = random_triangulation(3, 21);
  data d = random_data(mesh, 22);
  double a[18], b[18], largest = 0;
  heights(mesh, &d, direction, identity, a);
  heights(mesh, &d, direction, M, b);
  for (int i = 0; i < 18; i++) largest = fmax(largest, fabs(a[i] - b[i]));
  free_data(d);
  fs_mesh_free(&ctx, mesh);
  return largest;
}

static void test_invariance(void **state) {
  static const double similarity[4] = {1.2, -0.5, 0.5, 1.2}, map[4] = {1.3, 0.4, -0.2, 0.8};
  (void)state;
  assert_true(invariance_error(FS_STACHO_PERPENDICULAR, similarity) <= 1e-12);
  assert_true(invariance_error(FS_STACHO_PERPENDICULAR, map) > 1e-3);
  assert_true(invariance_error(FS_STACHO_OPPOSITE, similarity) <= 1e-12);
  assert_true(invariance_error(FS_STACHO_OPPOSITE, map) <= 1e-12);
}

/* ---- shape functions of one's own, and the misprints of the source ---- */

static const double Phi[6] = {0, 0, 0, 1, 1, 1}, Theta[5] = {0, 0, 0, 1, 1}, printed_Theta[4] = {0, 0, 4.0 / 3, 1};
static const double bump[21] = {[8] = 1}, smaller_bump[21] = {[8] = 0.4};
/* 30 t1^2 t2^3 t3: 6! / (2! 3! 1!) = 60 halves of it at exponents (2, 3, 1), number 7 + 3 = 10 */
static const double source_bump[28] = {[10] = 0.5};

static void refuse(fs_stacho_shape shape, const char *sentence) {
  fs_context ctx = test_context();
  assert_int_equal(fs_stacho_shape_check(&ctx, &shape), FS_ERR_ARGUMENT);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" lacks \"%s\"", ctx.message, sentence);
}

static void test_shapes(void **state) {
  const fs_stacho_shape quintic = {{5, 4}, {5, 5}, {Phi, Theta}, {bump, smaller_bump}};
  const fs_stacho_shape source = {{5, 5}, {5, 6}, {Phi, Phi}, {bump, source_bump}};
  fs_context ctx = test_context();
  fs_mesh *mesh = random_triangulation(3, 5);
  data d = random_data(mesh, 6);
  fs_surface *a = graph(mesh, &d, (fs_stacho_graph_options){.variant = FS_STACHO_QUINTIC});
  fs_surface *b = graph(mesh, &d, (fs_stacho_graph_options){.shape = &quintic});
  (void)state;
  assert_int_equal(a->n_data, b->n_data);
  vectors_agree("points", (int)a->n_data, b->data, a->data, 1e-14);
  fs_surface_free(&ctx, a);
  fs_surface_free(&ctx, b);
  b = graph(mesh, &d, (fs_stacho_graph_options){.shape = &source});
  assert_true(c1_error(b) <= 1e-11);
  fs_surface_free(&ctx, b);
  /* the first order of the source is C1 but does not keep affine functions; this one does */
  assert_true(reproduction_error((fs_stacho_graph_options){.shape = &source}, affine, false) > 1e-3);
  free_data(d);
  fs_mesh_free(&ctx, mesh);
}

static void test_misprints(void **state) {
  const fs_stacho_shape theta = {{5, 3}, {5, 5}, {Phi, printed_Theta}, {bump, smaller_bump}};
  const fs_stacho_shape chi = {{5, 5}, {5, 5}, {Phi, Phi}, {bump, bump}}; /* 30 t1^2 t2^2 t3 */
  const fs_stacho_shape end = {{4, 4}, {5, 5}, {(const double[]){0, 0, 0, 0.5, 1}, Theta}, {bump, smaller_bump}};
  const fs_stacho_shape start = {{5, 4}, {5, 5}, {(const double[]){0, 0.1, 0, 1, 1, 1}, Theta}, {bump, smaller_bump}};
  const fs_stacho_shape edge = {{5, 4}, {5, 5}, {Phi, Theta}, {(const double[21]){[8] = 1, [7] = 0.2}, smaller_bump}};
  (void)state;
  refuse(theta, "chi_1 across its edge does not match psi_1");
  refuse(chi, "chi_1 across its edge does not match psi_1");
  refuse(end, "psi_0'(1)");
  refuse(start, "psi_0'(0)");
  refuse(edge, "chi_0 has the coefficient 0.2 at exponents (3, 1, 1)");
  /* zeta_k with the printed sign of one term: no longer C1 */
  double A[10], H[15];
  fs_context ctx = test_context();
  fs_mesh *mesh = vector_mesh(vectors_item(vectors, "stacho_2d"), A, H);
  data d = {A, H};
  fs_surface *s = graph(mesh, &d, (fs_stacho_graph_options){.variant = FS_STACHO_QUINTIC});
  double g12 = A[2] * (mesh->position[2].x - mesh->position[1].x) + A[3] * (mesh->position[2].y - mesh->position[1].y);
  double alpha[9];
  vectors_numbers(vectors_item(vectors_item(vectors_item(vectors, "stacho_2d"), "results"), "a_perp"), "alpha", 9,
                  alpha);
  assert_true(c1_error(s) <= 1e-11);
  s->data[s->patch[0].data_start + 3 * (size_t)fs_triangle_index(5, 2, 2) + 2] -= 0.8 * alpha[0] * g12;
  assert_true(c1_error(s) > 0.1);
  fs_surface_free(&ctx, s);
  fs_mesh_free(&ctx, mesh);
}

static void test_bad_input(void **state) {
  fs_context ctx = test_context();
  fs_mesh *grid = test_grid(2, 2, NULL), *mesh = random_triangulation(2, 1);
  fs_surface *s = NULL;
  double gradient[18] = {0};
  (void)state;
  assert_int_equal(fs_stacho_graph(&ctx, grid, NULL, NULL, NULL, &s), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "face 0 has 4 vertices"));
  gradient[7] = NAN;
  assert_int_equal(fs_stacho_graph(&ctx, mesh, gradient, NULL, NULL, &s), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "gradient at vertex 3"));
  mesh->position[4] = (fs_vec3){-3, -3, 0}; /* turns triangles over */
  assert_int_equal(fs_stacho_graph(&ctx, mesh, NULL, NULL, NULL, &s), FS_ERR_ARGUMENT);
  assert_non_null(strstr(ctx.message, "is not anticlockwise in the (x, y) plane"));
  assert_null(s);
  fs_mesh_free(&ctx, grid);
  fs_mesh_free(&ctx, mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_vectors),      cmocka_unit_test(test_continuity_and_interpolation),
      cmocka_unit_test(test_reproduction), cmocka_unit_test(test_invariance),
      cmocka_unit_test(test_shapes),       cmocka_unit_test(test_misprints),
      cmocka_unit_test(test_bad_input),
  };
  int failures;
  vectors = vectors_open("math/patches-vectors.json");
  if (vectors == NULL) return TEST_SKIPPED;
  failures = cmocka_run_group_tests(tests, NULL, NULL);
  cJSON_Delete(vectors);
  return failures;
}
