/* SPDX-License-Identifier: MIT */
/* Stacho's G1 surfaces: numbers of an independent program (FAIRSURF_SHARED/math/patches-vectors.json), derivatives against
   differences, tangent planes along all edges of closed and open meshes, what is interpolated, spheres, flat data. */
#include <fairsurf/construct.h>
#include <fairsurf/construct_stacho.h>
#include "math/bernstein.h"
#include "math/diffgeo.h"
#include "math/triangle.h"
#include "math/vec3.h"
#include "surface/stacho.h"
#include "vectors.h"
#include <string.h>

static cJSON *vectors;

/* ---- samples ---- */

static fs_mesh *icosahedron(void) {
  static const int32_t corner[60] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                     4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                     6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  const double g = (1 + sqrt(5)) / 2, r = sqrt(1 + g * g);
  const double x[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  fs_vec3 position[12];
  int32_t start[21];
  for (int v = 0; v < 12; v++) position[v] = (fs_vec3){x[v][0] / r, x[v][1] / r, x[v][2] / r};
  for (int f = 0; f <= 20; f++) start[f] = 3 * f;
  return test_mesh(12, position, 20, start, corner);
}

/* Fans from the first corner of every face. */
static fs_mesh *triangulated(fs_mesh *mesh) {
  fs_context ctx = test_context();
  int32_t *start = calloc((size_t)mesh->n_halfedges + 1, sizeof *start);
  int32_t *corner = calloc(3 * (size_t)mesh->n_halfedges, sizeof *corner), n = 0;
  for (int32_t f = 0; f < mesh->n_faces; f++)
    for (int32_t i = 1; i + 1 < fs_mesh_face_size(mesh, f); i++, n++) {
      const int32_t *v = mesh->origin + mesh->face_start[f];
      corner[3 * n] = v[0], corner[3 * n + 1] = v[i], corner[3 * n + 2] = v[i + 1];
      start[n + 1] = 3 * (n + 1);
    }
  fs_mesh *made = test_mesh(mesh->n_vertices, mesh->position, n, start, corner);
  free(start), free(corner);
  fs_mesh_free(&ctx, mesh);
  return made;
}

static fs_vec3 *random_normals(const fs_mesh *mesh, double amount, uint64_t seed) {
  fs_context ctx = test_context();
  fs_vec3 *n = calloc((size_t)mesh->n_vertices, sizeof *n);
  assert_int_equal(fs_vertex_normals(&ctx, mesh, n), FS_OK);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    n[v].x += test_random_real(&seed, -amount, amount);
    n[v].y += test_random_real(&seed, -amount, amount);
    n[v].z += test_random_real(&seed, -amount, amount);
    n[v] = fs_vec3_scale(n[v], 1 / fs_vec3_length(n[v]));
  }
  return n;
}

static fs_surface *build(const fs_mesh *mesh, const fs_vec3 *normal, const double *shape, fs_stacho_options options) {
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  if (fs_stacho_surface(&ctx, mesh, normal, shape, &options, &s) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(fs_surface_validate(&ctx, s), FS_OK);
  return s;
}

static void side_point(const fs_surface *s, int32_t p, int32_t side, double t, fs_vec3 *x, fs_vec3 *normal) {
  double u, v;
  fs_side_parameters(3, side, t, &u, &v);
  fs_surface_evaluate(s, p, u, v, x);
  if (!fs_normal_compute(x, normal)) fail_msg("patch %d is singular at side %d, t = %g", (int)p, (int)side, t);
}

/* Largest gaps of positions and unit normals along the inner edges. */
static void measure_gaps(const fs_surface *s, double gap[2]) {
  gap[0] = gap[1] = 0;
  for (int32_t p = 0; p < s->n_patches; p++)
    for (int32_t side = 0; side < 3; side++)
      for (int i = 0; i <= 12 && s->patch[p].neighbour[side] > p; i++) {
        fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE], n, m;
        side_point(s, p, side, i / 12.0, x, &n);
        side_point(s, s->patch[p].neighbour[side], s->patch[p].neighbour_side[side], 1 - i / 12.0, y, &m);
        gap[0] = fmax(gap[0], fs_vec3_distance(x[FS_D], y[FS_D]));
        gap[1] = fmax(gap[1], fs_vec3_distance(n, m));
      }
}

static void assert_smooth(const fs_surface *s, double size) {
  double gap[2];
  measure_gaps(s, gap);
  if (!(gap[0] <= 1e-12 * size) || !(gap[1] <= 1e-10)) fail_msg("gaps %.3g, %.3g", gap[0], gap[1]);
}

/* ---- numbers of another program ---- */

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

/* ---- laws ---- */

/* Differences of order 4 of each derivative against the next. */
static void test_derivatives(void **state) {
  static const int8_t below[FS_JET_SIZE] = {-1, 0, 0, 1, 1, 2, 3, 3, 4, 5}; /* differentiated by u, or v where … */
  static const bool is_v[FS_JET_SIZE] = {0, 0, 1, 0, 1, 1, 0, 1, 1, 1};     /* … this says so */
  fs_context ctx = test_context();
  fs_mesh *mesh = icosahedron();
  fs_vec3 *normal = random_normals(mesh, 0.2, 4);
  const double h = 1e-3;
  (void)state;
  for (int variant = 0; variant < 6; variant++) {
    fs_surface *s =
        build(mesh, normal, NULL,
              (fs_stacho_options){.variant = (fs_stacho_variant)(variant % 3), .is_fixed_direction = variant >= 3});
    fs_vec3 x[FS_JET_SIZE], y[4][FS_JET_SIZE];
    fs_surface_evaluate(s, 3, 0.3, 0.45, x);
    for (int k = 1; k < FS_JET_SIZE; k++) {
      static const double step[4] = {-2, -1, 1, 2}, weight[4] = {1, -8, 8, -1};
      fs_vec3 sum = {0, 0, 0};
      for (int i = 0; i < 4; i++) {
        fs_surface_evaluate(s, 3, 0.3 + !is_v[k] * step[i] * h, 0.45 + is_v[k] * step[i] * h, y[i]);
        sum = fs_vec3_add_scaled(sum, y[i][below[k]], weight[i] / (12 * h));
      }
      if (!(fs_vec3_distance(sum, x[k]) <= 1e-7 * (1 + fs_vec3_length(x[k]))))
        fail_msg("derivative %d of variant %d: %g", k, variant, fs_vec3_distance(sum, x[k]));
    }
    fs_surface_free(&ctx, s);
  }
  free(normal);
  fs_mesh_free(&ctx, mesh);
}

static void check_mesh(const fs_mesh *mesh, const fs_vec3 *normal, double size) {
  fs_context ctx = test_context();
  for (int variant = 0; variant < 3; variant++)
    for (int tangent = 0; tangent < 3; tangent++)
      for (int fixed = 0; fixed < 2; fixed++) {
        fs_surface *s = build(mesh, normal, NULL,
                              (fs_stacho_options){(fs_stacho_variant)variant, (fs_stacho_tangent)tangent, fixed == 1});
        assert_smooth(s, size);
        for (int32_t h = 0; h < mesh->n_halfedges; h++) {
          fs_vec3 x[FS_JET_SIZE], n;
          side_point(s, h / 3, h % 3, 0, x, &n);
          assert_true(fs_vec3_distance(x[FS_D], mesh->position[mesh->origin[h]]) <= 1e-13 * size);
          assert_true(fs_vec3_distance(n, normal[mesh->origin[h]]) <= 1e-12);
        }
        fs_surface_free(&ctx, s);
      }
}

static void test_meshes(void **state) {
  fs_context ctx = test_context();
  uint64_t seed = 9;
  (void)state;
  for (int k = 0; k < 4; k++) {
    fs_mesh *mesh = k < 2 ? icosahedron() : triangulated(k == 2 ? test_torus(9, 7, 3, 1) : test_grid(3, 3, NULL));
    fs_vec3 *normal;
    if (k > 0) test_mesh_disturb(mesh, 0.1, &seed);
    normal = random_normals(mesh, 0.15, 5);
    check_mesh(mesh, normal, 4);
    free(normal);
    fs_mesh_free(&ctx, mesh);
  }
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

static void test_sphere(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = icosahedron();
  double shape[72], low = 2, high = 0;
  fs_vec3 x[FS_JET_SIZE], n;
  fs_geometry g;
  (void)state;
  assert_int_equal(fs_mesh_shape_tensors(&ctx, mesh, mesh->position, shape), FS_OK);
  for (int v = 0; v < 12; v++) { /* II = -(1 - n n^T) on the unit sphere */
    fs_vec3 p = mesh->position[v];
    const double exact[6] = {p.x * p.x - 1, p.x * p.y, p.x * p.z, p.y * p.y - 1, p.y * p.z, p.z * p.z - 1};
    vectors_agree("tensor on the sphere", 6, shape + 6 * v, exact, 1e-13);
  }
  fs_surface *s = build(mesh, NULL, NULL, (fs_stacho_options){.variant = FS_STACHO_SECOND_ORDER});
  for (int i = 0; i <= 20; i++)
    for (int j = 0; i + j <= 20; j++) {
      fs_surface_evaluate(s, 4, i / 20.0, j / 20.0, x);
      low = fmin(low, fs_vec3_length(x[FS_D])), high = fmax(high, fs_vec3_length(x[FS_D]));
    }
  assert_true(low > 0.9995 && low < 1 && high > 1 &&
              high < 1.0018); /* .9996 and 1.0017 in the table of docs/stacho.md */
  side_point(s, 4, 0, 0, x, &n);
  assert_true(fs_geometry_compute(x, &g));
  assert_true(fabs(g.K - 1) <= 1e-12 && fabs(g.H + 1) <= 1e-12);
  fs_surface_free(&ctx, s);
  s = build(mesh, NULL, NULL, (fs_stacho_options){.variant = FS_STACHO_FIRST_ORDER}); /* flat at the vertices */
  side_point(s, 4, 0, 0, x, &n);
  assert_true(fs_geometry_compute(x, &g));
  assert_true(fabs(g.K) <= 1e-12 && fabs(g.H) <= 1e-12);
  fs_surface_free(&ctx, s);
  fs_mesh_free(&ctx, mesh);
}

static void test_flat(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = triangulated(test_grid(3, 3, NULL));
  uint64_t seed = 2;
  (void)state;
  test_mesh_disturb(mesh, 0.2, &seed);
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].z = 0;
  for (int variant = 0; variant < 3; variant++) {
    fs_surface *s = build(mesh, NULL, NULL, (fs_stacho_options){.variant = (fs_stacho_variant)variant});
    double largest = 0;
    for (int32_t p = 0; p < s->n_patches; p++) {
      const int32_t *v = mesh->origin + 3 * p;
      fs_vec3 x[FS_JET_SIZE], linear = fs_vec3_scale(mesh->position[v[0]], 0.4);
      linear = fs_vec3_add_scaled(linear, mesh->position[v[1]], 0.25);
      linear = fs_vec3_add_scaled(linear, mesh->position[v[2]], 0.35);
      fs_surface_evaluate(s, p, 0.25, 0.35, x);
      assert_true(fabs(x[FS_D].z) <= 1e-14);
      largest = fmax(largest, fs_vec3_distance(x[FS_D], linear));
    }
    if (variant == FS_STACHO_QUINTIC)
      assert_true(largest > 1e-3);
    else
      assert_true(largest <= 1e-12);
    fs_surface_free(&ctx, s);
  }
  fs_mesh_free(&ctx, mesh);
}

static void test_similarity(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = icosahedron(), *moved;
  uint64_t seed = 12;
  (void)state;
  test_mesh_disturb(mesh, 0.15, &seed);
  assert_int_equal(fs_mesh_copy(&ctx, mesh, &moved), FS_OK);
  const double c = 0.6, s = 0.8, scale = 1.7;
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    fs_vec3 p = mesh->position[v];
    moved->position[v] = (fs_vec3){scale * (c * p.x - s * p.y) + 1, scale * p.z - 2, -scale * (s * p.x + c * p.y) + 3};
  }
  fs_surface *a = build(mesh, NULL, NULL, (fs_stacho_options){0}),
             *b = build(moved, NULL, NULL, (fs_stacho_options){0});
  for (int32_t p = 0; p < a->n_patches; p++) {
    fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE], q;
    fs_surface_evaluate(a, p, 0.3, 0.6, x);
    fs_surface_evaluate(b, p, 0.3, 0.6, y);
    q = x[FS_D];
    q = (fs_vec3){scale * (c * q.x - s * q.y) + 1, scale * q.z - 2, -scale * (s * q.x + c * q.y) + 3};
    assert_true(fs_vec3_distance(q, y[FS_D]) <= 1e-12);
  }
  fs_surface_free(&ctx, a);
  fs_surface_free(&ctx, b);
  fs_mesh_free(&ctx, mesh);
  fs_mesh_free(&ctx, moved);
}

static void test_threads(void **state) {
  fs_context one = test_context(), three = test_context();
  fs_mesh *mesh = triangulated(test_torus(24, 16, 3, 1));
  fs_surface *a, *b;
  (void)state;
  three.n_threads = 3;
  assert_int_equal(fs_stacho_surface(&one, mesh, NULL, NULL, NULL, &a), FS_OK);
  assert_int_equal(fs_stacho_surface(&three, mesh, NULL, NULL, NULL, &b), FS_OK);
  assert_memory_equal(a->data, b->data, a->n_data * sizeof *a->data);
  fs_surface_free(&one, a);
  fs_surface_free(&one, b);
  fs_mesh_free(&one, mesh);
}

/* ---- bad input ---- */

static void refuse(const fs_mesh *mesh, const fs_vec3 *normal, fs_status expected, const char *sentence) {
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  assert_int_equal(fs_stacho_surface(&ctx, mesh, normal, NULL, NULL, &s), expected);
  if (strstr(ctx.message, sentence) == NULL) fail_msg("\"%s\" lacks \"%s\"", ctx.message, sentence);
  assert_null(s);
}

/* Curvatures as no surface of this size has, at random: two triangles come to lie on one side of their edge. */
static void test_folded_edges(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = icosahedron();
  fs_surface *s = NULL;
  double shape[72];
  uint64_t seed = 1;
  int n_folded = 0;
  (void)state;
  for (int repeat = 0; repeat < 20; repeat++) {
    for (int v = 0; v < 12; v++) { /* a w w^T with tangent w */
      fs_vec3 n = mesh->position[v], w = {test_random_real(&seed, -1, 1), test_random_real(&seed, -1, 1), 0};
      double a = test_random_real(&seed, -60, 60);
      w = fs_vec3_add_scaled(w, n, -fs_vec3_dot(w, n));
      const double tensor[6] = {a * w.x * w.x, a * w.x * w.y, a * w.x * w.z,
                                a * w.y * w.y, a * w.y * w.z, a * w.z * w.z};
      memcpy(shape + 6 * v, tensor, sizeof tensor);
    }
    fs_status status = fs_stacho_surface(&ctx, mesh, NULL, shape, NULL, &s);
    if (status == FS_OK) {
      fs_surface_free(&ctx, s);
      s = NULL;
      continue;
    }
    assert_int_equal(status, FS_ERR_NUMERIC);
    assert_non_null(strstr(ctx.message, "do not lie on opposite sides of the edge between vertices"));
    assert_null(s);
    n_folded++;
  }
  assert_true(n_folded > 0);
  fs_mesh_free(&ctx, mesh);
}

static void test_bad_input(void **state) {
  fs_context ctx = test_context();
  fs_mesh *cube = test_cube(), *mesh = icosahedron();
  fs_vec3 *normal = random_normals(mesh, 0, 0), kept, d;
  (void)state;
  refuse(cube, NULL, FS_ERR_UNSUPPORTED, "face 0 has 4 vertices");
  kept = normal[3];
  normal[3] = fs_vec3_scale(kept, 1.1);
  refuse(mesh, normal, FS_ERR_ARGUMENT, "the normal of vertex 3 has length 1.1 instead of 1");
  d = fs_vec3_sub(mesh->position[9], mesh->position[3]);
  normal[3] = fs_vec3_scale(d, 1 / fs_vec3_length(d));
  refuse(mesh, normal, FS_ERR_ARGUMENT, "is parallel to the normal at vertex 3");
  normal[3] = fs_vec3_scale(kept, -1);
  refuse(mesh, normal, FS_ERR_ARGUMENT, "at vertex 3 has no area, or shows its back");
  normal[3] = kept;
  mesh->position[3] = mesh->position[9];
  refuse(mesh, normal, FS_ERR_ARGUMENT, "has no length");
  fs_mesh_free(&ctx, cube);
  fs_mesh_free(&ctx, mesh);
  free(normal);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_vectors),       cmocka_unit_test(test_tensor_vector),
      cmocka_unit_test(test_derivatives),   cmocka_unit_test(test_meshes),
      cmocka_unit_test(test_shared_meshes), cmocka_unit_test(test_corrections_stay_at_their_sides),
      cmocka_unit_test(test_misprint),      cmocka_unit_test(test_sphere),
      cmocka_unit_test(test_flat),          cmocka_unit_test(test_similarity),
      cmocka_unit_test(test_threads),       cmocka_unit_test(test_bad_input),
      cmocka_unit_test(test_folded_edges),
  };
  int failures;
  vectors = vectors_open("math/patches-vectors.json");
  if (vectors == NULL) return TEST_SKIPPED;
  failures = cmocka_run_group_tests(tests, NULL, NULL);
  cJSON_Delete(vectors);
  return failures;
}
