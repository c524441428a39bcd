/* SPDX-License-Identifier: MIT */
/* Caps by what they must do, for all valences: reproduce the plane, be the same from every sector, meet the surrounding
   patches and each other with one tangent plane and one curvature; and what happens on bad input and without memory. */
#include "g2cap_samples.h"

static const int VALENCES[] = {3, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 20, 24};
enum { N_VALENCES = sizeof VALENCES / sizeof *VALENCES };

static void test_vertex_numbers(void **state) {
  (void)state;
  assert_int_equal(fs_g2cap_vertex(5, 2, 0, 0), 0);
  assert_int_equal(fs_g2cap_vertex(5, 2, 1, 0), 13);
  assert_int_equal(fs_g2cap_vertex(5, 2, 2, 2), 18);
  assert_int_equal(fs_g2cap_vertex(5, 4, 0, 2), fs_g2cap_vertex(5, 0, 2, 0));
  assert_int_equal(fs_g2cap_vertex(5, 0, 2, -1), fs_g2cap_vertex(5, 4, 1, 2));
  assert_int_equal(fs_g2cap_vertex(5, 4, -1, 2), fs_g2cap_vertex(5, 0, 2, 1));
  assert_int_equal(fs_g2cap_vertex(5, 1, 0, -1), fs_g2cap_vertex(5, 0, 1, 0));
}

/* The net is an eigenvector of Catmull-Clark refinement: checked with its stencils at the vertices of one sector. */
static void test_net(void **state) {
  (void)state;
  for (int n = 0; n < N_VALENCES; n++) {
    int k = VALENCES[n];
    double lambda, net[2 * 145], c = cos(2 * acos(-1) / k);
    fs_g2cap_domain_net(k, &lambda, net);
    near(16 * lambda * lambda - (10 + 2 * c) * lambda + 1, 0, 1e-14);
    for (int b = 0; b <= 2; b++)
      for (int a = 1; a <= 2; a++)
        for (int x = 0; x < 2; x++) {
          double sum = 0;
          for (int j = -1; j <= 1; j++)
            for (int i = -1; i <= 1; i++) {
              /* even: vertex at the half place, weights 1 6 1 over 8; odd: midpoint, 4 4 over 8 */
              double wa = a % 2 == 0 ? (i == 0 ? 6 : 1) : (i < 0 ? 0 : 4),
                     wb = b % 2 == 0 ? (j == 0 ? 6 : 1) : (j < 0 ? 0 : 4);
              if (wa * wb != 0) sum += wa * wb / 64 * net[2 * fs_g2cap_vertex(k, 0, a / 2 + i, b / 2 + j) + x];
            }
          near(sum, lambda * net[2 * fs_g2cap_vertex(k, 0, a, b) + x], 1e-14);
        }
  }
}

/* Area of a patch [100][2] by Green's formula: the integral of (x dy - y dx) / 2 along its four sides. */
static double boundary_area(const double *patch) {
  static const int start[4] = {0, 9, 99, 90}, step[4] = {1, 10, -1, -10};
  double sum = 0;
  for (int side = 0; side < 4; side++)
    for (int i = 0; i <= 9; i++)
      for (int j = 0; j < 9; j++) { /* integral of B_i^9 B_j^8 = C(9,i) C(8,j) / (18 C(17,i+j)) */
        double weight = 9 * fs_binomial(9, i) * fs_binomial(8, j) / (18 * fs_binomial(17, i + j));
        const double *p = patch + 2 * (start[side] + i * step[side]), *q = patch + 2 * (start[side] + j * step[side]);
        const double *r = q + 2 * step[side];
        sum += weight * (p[0] * (r[1] - q[1]) - p[1] * (r[0] - q[0])) / 2;
      }
  return sum;
}

/* Rows sum to 1, the net of the plane gives the chart (up to its scale), whose area is 1. */
static void test_plane(void **state) {
  static const double area[25] = {[3] = 0.765817362031385,
                                  [5] = 1.04750354117659,
                                  [6] = 1.01379527417177,
                                  [8] = 0.884177605344329,
                                  [16] = 0.512309143656425}; /* independent computation */
  fs_context ctx = test_context();
  (void)state;
  for (int n = 0; n < N_VALENCES; n++) {
    int k = VALENCES[n];
    const fs_g2cap *cap;
    double patch[200], size;
    assert_int_equal(fs_g2cap_get(&ctx, k, &cap), FS_OK);
    assert_int_equal(cap->valence, k);
    assert_int_equal(cap->n_vertices, 6 * k + 1);
    for (int row = 0; row < 100; row++) {
      double sum = 0;
      for (int i = 0; i < cap->n_vertices; i++) sum += cap->matrix[row * cap->n_vertices + i];
      near(sum, 1, 1e-12);
    }
    fill_sector(k, cap->matrix, 0, 2, cap->net, patch);
    size = boundary_area(patch);
    if (area[k] != 0) near(size, area[k], 1e-12);
    near(boundary_area(cap->chart), 1, 1e-13);
    for (int i = 0; i < 200; i++) near(patch[i], cap->chart[i] * sqrt(size), 1e-11);
  }
  fs_context_clear(&ctx);
  assert_null(ctx.caps);
}

/* All sectors give the same matrix, turned, and it is its own mirror image: V_i(a,b) becomes V_-i(b,a), u becomes v. */
static void test_symmetry(void **state) {
  fs_context ctx = test_context();
  (void)state;
  for (int basic = 0; basic <= 1; basic++)
    for (int m = 0; m < N_VALENCES; m++) {
      fs_g2cap_options options = {.basic = basic};
      int k = VALENCES[m], n = 6 * k + 1;
      construction *c = construct(&ctx, k, &options);
      double *matrix = calloc((size_t)(100 * n), sizeof *matrix);
      assert_true(c->junction.residual < 1e-12);
      assert_true(c->ritz->asymmetry > 0 && c->ritz->asymmetry < 1e-10);
      fs_g2cap_matrix(c->ritz, matrix);
      for (int row = 0; row < 100; row++)
        for (int sector = 0; sector < k; sector++)
          for (int b = 0; b <= 2; b++)
            for (int a = 1; a <= 2; a++)
              near(matrix[row * n + fs_g2cap_vertex(k, sector, a, b)],
                   matrix[(row / 10 + 10 * (row % 10)) * n + fs_g2cap_vertex(k, -sector, b, a)], 1e-10);
      free(matrix);
      destroy(&ctx, c);
    }
}

/* The energy matrix is symmetric, vanishes on 1, x, y, and is smaller with more functions. */
static void test_energy(void **state) {
  fs_context ctx = test_context();
  const fs_g2cap_options extended = {0}, basic = {.basic = true};
  (void)state;
  for (int m = 0; m < N_VALENCES; m++) {
    construction *c = construct(&ctx, VALENCES[m], &extended), *b = construct(&ctx, VALENCES[m], &basic);
    const double *K = c->ritz->energy;
    double trace = 0, basic_trace = 0;
    for (int i = 0; i < c->n; i++) trace += K[i * (c->n + 1)], basic_trace += b->ritz->energy[i * (c->n + 1)];
    for (int i = 0; i < c->n; i++) {
      double sum[3] = {0};
      for (int j = 0; j < c->n; j++) {
        assert_true(K[i * c->n + j] == K[j * c->n + i]);
        sum[0] += K[i * c->n + j];
        for (int x = 0; x < 2; x++) sum[1 + x] += K[i * c->n + j] * c->net[2 * j + x];
      }
      for (int x = 0; x < 3; x++) near(sum[x], 0, 1e-12 * trace);
      assert_true(K[i * (c->n + 1)] > 0 && K[i * (c->n + 1)] <= b->ritz->energy[i * (c->n + 1)] * (1 + 1e-12));
    }
    assert_true(trace < basic_trace);
    destroy(&ctx, c);
    destroy(&ctx, b);
  }
}

/* A net of radius 3 near the plane domain on a random quadric, with noise. relevant [6k+1][3]: its two inner rings. */
static void random_net(int k, const double *plane, uint64_t *random, double *net, double *relevant) {
  double amplitude = k < 8 ? 0.3 : 2.0 / k, bend[3];
  for (int i = 0; i < 3; i++) bend[i] = test_random_real(random, -0.15, 0.15);
  for (int sector = 0; sector < k; sector++)
    for (int b = 0; b <= 3; b++)
      for (int a = sector == 0 && b == 0 ? 0 : 1; a <= 3; a++) {
        int A = a < 2 ? a : 2, B = b < 2 ? b : 2; /* the third ring continues the first two */
        int inner = fs_g2cap_vertex(k, sector, A, B), before = fs_g2cap_vertex(k, sector, A - (a > 2), B - (b > 2));
        double *p = net + 3 * third_vertex(k, sector, a, b), x[2];
        for (int i = 0; i < 2; i++) x[i] = 2 * plane[2 * inner + i] - plane[2 * before + i];
        if (a <= 2 && b <= 2) memcpy(x, plane + 2 * inner, sizeof x);
        p[0] = x[0], p[1] = x[1], p[2] = bend[0] * x[0] * x[0] + bend[1] * x[0] * x[1] + bend[2] * x[1] * x[1];
        for (int i = 0; i < 3; i++) p[i] += test_random_real(random, -amplitude, amplitude);
        if (a <= 2 && b <= 2) memcpy(relevant + 3 * inner, p, 3 * sizeof *p);
      }
}

static double contact_size; /* largest curvature met */

static void meet(const fs_vec3 *x, const fs_vec3 *y) {
  fs_geometry g, h;
  double V[3][3], W[3][3], size = 1;
  near(x[0].x, y[0].x, 1e-11);
  near(x[0].y, y[0].y, 1e-11);
  near(x[0].z, y[0].z, 1e-11);
  assert_true(fs_geometry_compute(x, &g) && fs_geometry_compute(y, &h));
  near(g.normal.x, h.normal.x, 1e-10);
  near(g.normal.y, h.normal.y, 1e-10);
  near(g.normal.z, h.normal.z, 1e-10);
  fs_geometry_shape_tensor(&g, V);
  fs_geometry_shape_tensor(&h, W);
  for (int i = 0; i < 9; i++) size = fmax(size, fabs(V[i / 3][i % 3]));
  for (int i = 0; i < 9; i++) near(V[i / 3][i % 3], W[i / 3][i % 3], 1e-8 * size);
  contact_size = fmax(contact_size, size);
}

static void meet_at(int degree_a, const double *a, double ua, double va, int degree_b, const double *b, double ub,
                    double vb) {
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  patch_jet(degree_a, a, ua, va, x);
  patch_jet(degree_b, b, ub, vb, y);
  meet(x, y);
}

/* Position, normal and shape tensor agree across all edges: between sectors, and with the surrounding patches. */
static void test_contact(void **state) {
  fs_context ctx = test_context();
  uint64_t random = 2013;
  (void)state;
  for (int m = 0; m < 2 * N_VALENCES; m++) {
    int k = VALENCES[m / 2];
    fs_g2cap_options options = {.basic = m % 2 == 0};
    fs_g2cap *cap;
    double net[3 * 289], relevant[3 * 145], *patch = calloc((size_t)(300 * k), sizeof *patch), ring[3][48];
    assert_int_equal(fs_g2cap_create(&ctx, k, &options, &cap), FS_OK);
    random_net(k, cap->net, &random, net, relevant);
    for (int s = 0; s < k; s++) fill_sector(k, cap->matrix, s, 3, relevant, patch + 300 * s);
    for (int s = 0; s < k; s++) {
      const double *own = patch + 300 * s, *next = patch + 300 * ((s + 1) % k);
      ring_patch(k, s, 1, 0, net, ring[0]);
      ring_patch(k, s, 0, 1, net, ring[1]);
      ring_patch(k, s, 1, 1, net, ring[2]);
      for (int i = 0; i <= 10; i++) {
        double t = i / 10.0;
        meet_at(9, own, 0, t, 9, next, t, 0);
        meet_at(9, own, 1, t, 3, ring[0], 0, t);
        meet_at(9, own, t, 1, 3, ring[1], t, 0);
      }
      meet_at(9, own, 1, 1, 3, ring[2], 0, 0);
    }
    free(patch);
    fs_g2cap_free(&ctx, cap);
  }
  assert_true(contact_size > 1);
}

/* The result depends on the quadrature as little as is known: 24 nodes 1e-9, the default 1e-12 from 40 nodes. */
static void test_quadrature(void **state) {
  static const int nodes[2] = {24, 0};
  static const double tolerance[2] = {1e-9, 1e-11};
  fs_context ctx = test_context();
  (void)state;
  for (int m = 0; m < 5; m++) {
    fs_g2cap_options fine = {.n_nodes = 40};
    fs_g2cap *best, *cap;
    assert_int_equal(fs_g2cap_create(&ctx, VALENCES[m], &fine, &best), FS_OK);
    for (int i = 0; i < 2; i++) {
      fs_g2cap_options options = {.n_nodes = nodes[i]};
      assert_int_equal(fs_g2cap_create(&ctx, VALENCES[m], &options, &cap), FS_OK);
      for (int j = 0; j < 100 * cap->n_vertices; j++) near(cap->matrix[j], best->matrix[j], tolerance[i]);
      fs_g2cap_free(&ctx, cap);
    }
    fs_g2cap_free(&ctx, best);
  }
}

static void test_refuses(void **state) {
  static const int valences[] = {-1, 0, 1, 2, 4, 25, 1000000, INT32_MIN, INT32_MAX};
  static const fs_g2cap_options options[] = {
      {.n_nodes = 3}, {.n_nodes = -1}, {.n_nodes = 65}, {.n_nodes = 5, .composite = true}};
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  const fs_g2cap *kept = NULL;
  fs_g2cap *cap = NULL;
  (void)state;
  for (size_t i = 0; i < sizeof valences / sizeof *valences; i++) {
    assert_int_equal(fs_g2cap_get(&ctx, valences[i], &kept), FS_ERR_ARGUMENT);
    assert_non_null(strstr(ctx.message, "valence"));
  }
  for (size_t i = 0; i < sizeof options / sizeof *options; i++)
    assert_int_equal(fs_g2cap_create(&ctx, 5, &options[i], &cap), FS_ERR_ARGUMENT);
  assert_true(kept == NULL && cap == NULL);
  fs_g2cap_free(&ctx, NULL);
  fs_context_clear(&ctx);
  assert_int_equal(memory.n_live, 0);
}

static void test_cache(void **state) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  const fs_g2cap *first = NULL, *again = NULL, *other = NULL;
  (void)state;
  assert_int_equal(fs_g2cap_get(&ctx, 5, &first), FS_OK);
  assert_int_equal(fs_g2cap_get(&ctx, 3, &other), FS_OK);
  assert_int_equal(fs_g2cap_get(&ctx, 5, &again), FS_OK);
  assert_true(first == again && other != first);
  fs_context_clear(&ctx);
  fs_context_clear(&ctx);
  assert_int_equal(memory.n_live, 0);
}

/* Each allocation fails once: no leak, nothing handed out. */
static void test_memory_failures(void **state) {
  const fs_g2cap_options options = {.n_nodes = 4};
  (void)state;
  for (int is_kept = 0; is_kept <= 1; is_kept++)
    for (int64_t fail_at = 1;; fail_at++) {
      struct test_memory memory = {.fail_at = fail_at};
      fs_context ctx = test_memory_context(&memory);
      fs_g2cap *cap = NULL;
      const fs_g2cap *kept = NULL;
      fs_status status = is_kept ? fs_g2cap_get(&ctx, 3, &kept) : fs_g2cap_create(&ctx, 3, &options, &cap);
      bool has_failed = memory.n_allocations >= fail_at;
      assert_int_equal(status, has_failed ? FS_ERR_MEMORY : FS_OK);
      assert_true((cap == NULL && kept == NULL) == has_failed);
      if (has_failed) assert_true(ctx.message[0] != 0);
      fs_g2cap_free(&ctx, cap);
      fs_context_clear(&ctx);
      assert_int_equal(memory.n_live, 0);
      if (!has_failed) {
        assert_true(fail_at > 10);
        break;
      }
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_vertex_numbers),  cmocka_unit_test(test_net),     cmocka_unit_test(test_plane),
      cmocka_unit_test(test_symmetry),        cmocka_unit_test(test_energy),  cmocka_unit_test(test_contact),
      cmocka_unit_test(test_quadrature),      cmocka_unit_test(test_refuses), cmocka_unit_test(test_cache),
      cmocka_unit_test(test_memory_failures),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
