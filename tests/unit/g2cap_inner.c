/* SPDX-License-Identifier: MIT */
/* The inner functions of caps: orthonormal among themselves and orthogonal to the functions of the matrix, by a quadrature
   of its own; without effect at the rim; the same on every machine; and what happens on bad input and without memory. */
#include "g2cap_samples.h"
#include "math/dense.h"
#include "math/quadrature.h"
#include <time.h>

static const int VALENCES[] = {3, 5, 6, 7, 8, 12, 16, 24};
enum { N_VALENCES = sizeof VALENCES / sizeof *VALENCES };

/* ---- grad Laplace by Taylor arithmetic ---- */

/* Polynomials in u, v of degree 3 at a point: the coefficient of u^i v^j at [i][j], i + j <= 3. */
typedef struct taylor {
  double c[4][4];
} taylor;

static taylor times(taylor a, taylor b) {
  taylor p = {{{0}}};
  for (int i = 0; i < 4; i++)
    for (int j = 0; i + j < 4; j++)
      for (int m = 0; m <= i; m++)
        for (int n = 0; n <= j; n++) p.c[i][j] += a.c[m][n] * b.c[i - m][j - n];
  return p;
}

static taylor minus(taylor a, taylor b) {
  for (int i = 0; i < 16; i++) a.c[i / 4][i % 4] -= b.c[i / 4][i % 4];
  return a;
}

/* q with q b = a */
static taylor over(taylor a, taylor b) {
  taylor q = {{{0}}};
  for (int i = 0; i < 4; i++)
    for (int j = 0; i + j < 4; j++) {
      double rest = a.c[i][j];
      for (int m = 0; m <= i; m++)
        for (int n = 0; n <= j; n++) rest -= q.c[m][n] * b.c[i - m][j - n];
      q.c[i][j] = rest / b.c[0][0];
    }
  return q;
}

/* The derivative; its terms of degree 3 are not known and left zero. */
static taylor by(int direction, taylor a) {
  taylor d = {{{0}}};
  for (int i = 0; i < 4; i++)
    for (int j = 0; i + j < 4; j++) {
      if (direction == 0 && i > 0) d.c[i - 1][j] = i * a.c[i][j];
      if (direction == 1 && j > 0) d.c[i][j - 1] = j * a.c[i][j];
    }
  return d;
}

/* d/dx (sign 1, along = y) or d/dy (sign -1, along = x): (f_u along_v - f_v along_u) / J */
static taylor by_plane(taylor f, taylor along, taylor J, double sign) {
  taylor d = over(minus(times(by(0, f), by(1, along)), times(by(1, f), by(0, along))), J);
  for (int i = 0; i < 16; i++) d.c[i / 4][i % 4] *= sign;
  return d;
}

/* W [2][100]: sqrt(weight J) grad Laplace of the Bezier points' functions B_i(u) B_j(v), with the chart [100][2]. */
static void gradient_row(double u, double v, double weight, const double *chart, double *W) {
  double U[4][10], V[4][10], factorial[4] = {1, 1, 2, 6};
  taylor plane[2] = {{{{0}}}};
  for (int order = 0; order < 4; order++) {
    fs_bernstein_basis(9, u, order, U[order]);
    fs_bernstein_basis(9, v, order, V[order]);
  }
  for (int x = 0; x < 2; x++)
    for (int i = 0; i < 4; i++)
      for (int j = 0; i + j < 4; j++)
        for (int p = 0; p < 100; p++)
          plane[x].c[i][j] += chart[2 * p + x] * U[i][p % 10] * V[j][p / 10] / (factorial[i] * factorial[j]);
  taylor J = minus(times(by(0, plane[0]), by(1, plane[1])), times(by(1, plane[0]), by(0, plane[1])));
  memset(W, 0, 200 * sizeof *W);
  for (int i = 0; i < 4; i++) /* linear: one monomial after the other */
    for (int j = i == 0; i + j < 4; j++) {
      taylor f = {{{0}}}, laplace, f_x, f_y, f_xx, f_yy;
      double gradient[2];
      f.c[i][j] = 1 / (factorial[i] * factorial[j]);
      f_x = by_plane(f, plane[1], J, 1), f_y = by_plane(f, plane[0], J, -1);
      f_xx = by_plane(f_x, plane[1], J, 1), f_yy = by_plane(f_y, plane[0], J, -1);
      for (int t = 0; t < 16; t++) laplace.c[t / 4][t % 4] = f_xx.c[t / 4][t % 4] + f_yy.c[t / 4][t % 4];
      gradient[0] = by_plane(laplace, plane[1], J, 1).c[0][0];
      gradient[1] = by_plane(laplace, plane[0], J, -1).c[0][0];
      for (int p = 0; p < 200; p++)
        W[p] += sqrt(weight * J.c[0][0]) * U[i][p % 10] * V[j][p % 100 / 10] * gradient[p / 100];
    }
}

enum { NODES = 36 }; /* other ones than the library uses */

/* rows [NODES^2][2][100]: the above at all nodes */
static void all_gradients(const double *chart, double *rows) {
  fs_context ctx = test_context();
  double node[FS_GAUSS_MAX_NODES], weight[FS_GAUSS_MAX_NODES];
  assert_int_equal(fs_gauss_legendre(&ctx, NODES, node, weight), FS_OK);
  for (int i = 0; i < NODES * NODES; i++)
    gradient_row(node[i % NODES], node[i / NODES], weight[i % NODES] * weight[i / NODES], chart, rows + 200 * i);
}

/* form [n][n] = energies of the n functions given by their Bezier points [100][n] in one sector. */
static void energies(const double *rows, int n, const double *points, double *form) {
  double *line = calloc((size_t)(2 * NODES * n), sizeof *line);
  memset(form, 0, (size_t)(n * n) * sizeof *form);
  for (int i = 0; i < NODES; i++) {
    memset(line, 0, (size_t)(2 * NODES * n) * sizeof *line);
    fs_dense_add_product(2 * NODES, 100, n, 1, rows + 200 * NODES * i, 100, points, n, line, n);
    fs_dense_add_gram(2 * NODES, n, line, n, 1, form, n);
  }
  fs_dense_mirror(n, form, n);
  free(line);
}

/* ---- tests ---- */

/* What is known of a valence, and energies in one sector of functions in columns: those of the matrix for some random nets,
   then smooth, then local ones. */
enum { N_NETS = 6 };
typedef struct sample {
  int k, n_vertices, n_smooth, n; /* n: columns */
  const fs_g2cap *cap;
  const fs_g2cap_inner *inner;
  double net[(6 * FS_G2CAP_MAX_VALENCE + 1) * N_NETS], *rows, *points, *form;
} sample;

static void sample_create(fs_context *ctx, int k, sample *s) {
  uint64_t random = (uint64_t)k;
  *s = (sample){.k = k};
  assert_int_equal(fs_g2cap_get(ctx, k, &s->cap), FS_OK);
  assert_int_equal(fs_g2cap_get_inner(ctx, k, &s->inner), FS_OK);
  s->n_vertices = s->cap->n_vertices;
  s->n_smooth = s->inner->n_smooth;
  for (int i = 0; i < s->n_vertices * N_NETS; i++) s->net[i] = test_random_real(&random, -1, 1);
  s->n = N_NETS + s->n_smooth + FS_G2CAP_LOCAL;
  s->rows = calloc(NODES * NODES * 200, sizeof *s->rows);
  all_gradients(s->cap->chart, s->rows);
  s->points = calloc((size_t)(100 * s->n), sizeof *s->points);
  s->form = calloc((size_t)(s->n * s->n), sizeof *s->form);
}

static void sample_free(sample *s) {
  free(s->rows);
  free(s->points);
  free(s->form);
}

static void set_sector(sample *s, int sector) {
  int n = N_NETS, m = s->n_smooth;
  double filled[100 * N_NETS];
  fill_sector(s->k, s->cap->matrix, sector, N_NETS, s->net, filled);
  for (int p = 0; p < 100; p++) {
    double *row = s->points + p * s->n;
    memcpy(row, filled + p * n, (size_t)n * sizeof *row);
    memcpy(row + n, s->inner->smooth + (100 * sector + p) * m, (size_t)m * sizeof *row);
    memcpy(row + n + m, s->inner->local + FS_G2CAP_LOCAL * p, FS_G2CAP_LOCAL * sizeof *row);
  }
}

static void test_orthonormal(void **state) {
  fs_context ctx = test_context();
  (void)state;
  for (int number = 0; number < N_VALENCES; number++) {
    sample s;
    sample_create(&ctx, VALENCES[number], &s);
    int k = s.k, n = N_NETS, m = s.n_smooth;
    double *smooth = calloc((size_t)(m * m), sizeof *smooth), *mixed = calloc((size_t)(n * m), sizeof *mixed), size = 0;
    assert_int_equal(m, k == 3 ? 16 : k == 5 ? 21 : k == 6 ? 25 : 3 * k + 6);
    for (int sector = 0; sector < k; sector++) {
      set_sector(&s, sector);
      energies(s.rows, s.n, s.points, s.form);
      for (int i = 0; i < n; i++) size = fmax(size, sqrt(s.form[i * (s.n + 1)]));
      for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) smooth[i * m + j] += s.form[(n + i) * s.n + n + j];
      for (int i = 0; i < n; i++)
        for (int j = 0; j < m; j++) mixed[i * m + j] += s.form[i * s.n + n + j];
      for (int j = 0; j < FS_G2CAP_LOCAL; j++) {
        const double *row = s.form + (n + m + j) * s.n;
        for (int i = 0; i < n; i++) near(row[i], 0, 1e-11 * size);
        for (int i = 0; i < m; i++) near(row[n + i], 0, 1e-11);
        for (int i = 0; i < FS_G2CAP_LOCAL; i++) near(row[n + m + i], i == j, 1e-11);
      }
    }
    for (int i = 0; i < m * m; i++) near(smooth[i], i / m == i % m, 1e-11);
    for (int i = 0; i < n * m; i++) near(mixed[i], 0, 1e-11 * size);
    free(smooth);
    free(mixed);
    sample_free(&s);
  }
  fs_context_clear(&ctx);
}

/* Phi(P) = x^T K x + |c|^2 for random x and c, with K of the Ritz step (domain not scaled) and the quadrature of P here. */
static void test_energy(void **state) {
  fs_context ctx = test_context();
  uint64_t random = 77;
  (void)state;
  for (int number = 0; number < N_VALENCES; number++) {
    const fs_g2cap_options options = {0};
    sample s;
    sample_create(&ctx, VALENCES[number], &s);
    construction *c = construct(&ctx, s.k, &options);
    double x[6 * FS_G2CAP_MAX_VALENCE + 1], area, sum = 0, expected = 0, part;
    double free_part[3 * FS_G2CAP_MAX_VALENCE + 6 + 16 * FS_G2CAP_MAX_VALENCE];
    assert_int_equal(fs_g2cap_area(&ctx, c->chart, &area), FS_OK);
    for (int i = 0; i < s.n_vertices; i++) x[i] = test_random_real(&random, -1, 1);
    for (int i = 0; i < s.n_smooth + 16 * s.k; i++) {
      free_part[i] = test_random_real(&random, -1, 1);
      expected += free_part[i] * free_part[i];
    }
    for (int i = 0; i < s.n_vertices; i++)
      for (int j = 0; j < s.n_vertices; j++)
        expected += area * area * x[i] * c->ritz->energy[i * s.n_vertices + j] * x[j];
    for (int sector = 0; sector < s.k; sector++) {
      double points[100];
      fill_sector(s.k, s.cap->matrix, sector, 1, x, points);
      set_sector(&s, sector);
      for (int p = 0; p < 100; p++) {
        const double *row = s.points + p * s.n + N_NETS;
        for (int i = 0; i < s.n_smooth; i++) points[p] += row[i] * free_part[i];
        for (int i = 0; i < 16; i++) points[p] += row[s.n_smooth + i] * free_part[s.n_smooth + 16 * sector + i];
      }
      energies(s.rows, 1, points, &part);
      sum += part;
    }
    near(sum / expected, 1, 1e-11);
    destroy(&ctx, c);
    sample_free(&s);
  }
  fs_context_clear(&ctx);
}

/* Values and derivatives up to order 2 vanish on the rim u = 1, v = 1; those of local functions on all sides. */
static void test_rim(void **state) {
  fs_context ctx = test_context();
  (void)state;
  for (int number = 0; number < N_VALENCES; number++) {
    sample s;
    sample_create(&ctx, VALENCES[number], &s);
    for (int sector = 0; sector < s.k; sector++) {
      set_sector(&s, sector);
      for (int column = N_NETS; column < s.n; column++) {
        bool is_local = column >= N_NETS + s.n_smooth;
        double points[300] = {0}, largest = 0;
        for (int p = 0; p < 100; p++) {
          points[3 * p] = s.points[p * s.n + column];
          largest = fmax(largest, fabs(points[3 * p]));
        }
        assert_true(largest > 1e-5 || !is_local);
        for (int side = 0; side < (is_local ? 4 : 2); side++)
          for (int i = 0; i <= 4; i++) {
            fs_vec3 jet[FS_JET_SIZE];
            double t = i / 4.0, fixed = side < 2;
            patch_jet(9, points, side % 2 == 0 ? fixed : t, side % 2 == 0 ? t : fixed, jet);
            for (int d = FS_D; d <= FS_DVV; d++) near(jet[d].x, 0, 1e-11 * largest);
          }
      }
    }
    sample_free(&s);
  }
  fs_context_clear(&ctx);
}

/* Coefficients in files must mean the same functions everywhere. An independent computation (another program, other linear
   algebra) gives these Bezier points: sector, point, function, value. */
static void test_same_everywhere(void **state) {
  static const struct {
    int k;
    struct {
      int sector, point, function;
      double value;
    } smooth[7];
    double local[4]; /* at points 33, 33, 44, 66 of the functions 0, 1, 9, 15 */
  } known[] = {
      {3,
       {{0, 0, 0, 0.008610710437937655},
        {0, 54, 3, -0.008456390242740187},
        {1, 62, 9, -3.127058196150575e-05},
        {2, 36, 14, 0.004362956840404337},
        {2, 55, 15, -0.002588690663823566},
        {1, 25, 15, 0.000408336182742912},
        {2, 13, 12, 0.001425216154404584}},
       {0.03187024340664474, -0.0243419200677457, -0.1227701192262394, 0.2415860660128318}},
      {5,
       {{0, 0, 0, 0.01186232412479604},
        {0, 54, 3, 0.0003647331972241389},
        {1, 62, 9, 0.0005957068651095271},
        {4, 36, 14, -0.006189418699615757},
        {4, 55, 20, 0.005984332834377151},
        {1, 25, 20, 0.002056730996049823},
        {2, 13, 19, -0.00492260062025554}},
       {0.04745763600081607, -0.03767997563326011, -0.2298791566830692, 0.1469640727046205}},
      {6,
       {{0, 0, 0, 0.01254614301377942},
        {0, 54, 3, -0.005638825408087133},
        {1, 62, 9, 0.001662545483949298},
        {5, 36, 14, -0.004329301343659776},
        {5, 55, 24, 0.0114063695665545},
        {1, 25, 24, -5.941858173496148e-05},
        {2, 13, 23, 0.0006493629668612407}},
       {0.04280529494279174, -0.0340999206536497, -0.232093566952393, 0.1226997237081352}},
      {8,
       {{0, 0, 0, 0.01348294382500639},
        {0, 54, 3, -0.01970130975540438},
        {1, 62, 9, 0.00176710114067985},
        {7, 36, 14, -0.001819504048526799},
        {7, 55, 29, 0.00941700655060688},
        {1, 25, 29, 0.0001725645261852906},
        {2, 13, 28, 0.00236448673268322}},
       {0.03242013303490264, -0.02583528855157844, -0.2170491533170988, 0.09545294861938403}},
      {12,
       {{0, 0, 0, 0.01310465737290219},
        {0, 54, 3, -0.02220094110936072},
        {1, 62, 9, 0.001084728606213639},
        {11, 36, 14, -9.444837856266333e-05},
        {11, 55, 41, 0.0001743316493647255},
        {1, 25, 41, 0.001060844029081309},
        {2, 13, 40, -0.002819538584104727}},
       {0.01951871539427483, -0.01552478783198395, -0.1679967411385517, 0.06574209387369649}},
  };
  static const int local_point[4] = {33, 33, 44, 66}, local_function[4] = {0, 1, 9, 15};
  fs_context ctx = test_context();
  (void)state;
  for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
    const fs_g2cap_inner *inner;
    assert_int_equal(fs_g2cap_get_inner(&ctx, known[i].k, &inner), FS_OK);
    for (int j = 0; j < 7; j++)
      near(inner->smooth[(100 * known[i].smooth[j].sector + known[i].smooth[j].point) * inner->n_smooth +
                         known[i].smooth[j].function],
           known[i].smooth[j].value, 1e-12);
    for (int j = 0; j < 4; j++) near(inner->local[16 * local_point[j] + local_function[j]], known[i].local[j], 1e-12);
  }
  fs_context_clear(&ctx);
}

static void test_refuses(void **state) {
  static const int valences[] = {-1, 0, 1, 2, 4, 25, 1000000, INT32_MIN, INT32_MAX};
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  const fs_g2cap_inner *kept = NULL, *again = NULL;
  fs_g2cap_inner *inner = NULL;
  (void)state;
  for (size_t i = 0; i < sizeof valences / sizeof *valences; i++) {
    assert_int_equal(fs_g2cap_get_inner(&ctx, valences[i], &kept), FS_ERR_ARGUMENT);
    assert_int_equal(fs_g2cap_inner_create(&ctx, valences[i], &inner), FS_ERR_ARGUMENT);
    assert_non_null(strstr(ctx.message, "valence"));
  }
  assert_true(kept == NULL && inner == NULL);
  fs_g2cap_inner_free(&ctx, NULL);
  assert_int_equal(fs_g2cap_get_inner(&ctx, 5, &kept), FS_OK);
  assert_int_equal(fs_g2cap_get_inner(&ctx, 5, &again), FS_OK);
  assert_true(kept == again && kept->valence == 5);
  fs_context_clear(&ctx);
  assert_int_equal(memory.n_live, 0);
}

/* Each allocation fails once: no leak, nothing handed out. */
static void test_memory_failures(void **state) {
  (void)state;
  for (int64_t fail_at = 1;; fail_at++) {
    struct test_memory memory = {.fail_at = fail_at};
    fs_context ctx = test_memory_context(&memory);
    const fs_g2cap_inner *kept = NULL;
    fs_status status = fs_g2cap_get_inner(&ctx, 5, &kept);
    bool has_failed = memory.n_allocations >= fail_at;
    assert_int_equal(status, has_failed ? FS_ERR_MEMORY : FS_OK);
    assert_true((kept == NULL) == has_failed);
    if (has_failed) assert_true(ctx.message[0] != 0);
    fs_context_clear(&ctx);
    assert_int_equal(memory.n_live, 0);
    if (!has_failed) {
      assert_true(fail_at > 10);
      break;
    }
  }
}

static void test_time(void **state) {
  fs_context ctx = test_context();
  (void)state;
  for (int number = 0; number < N_VALENCES; number++) {
    fs_g2cap_inner *inner;
    clock_t start = clock();
    assert_int_equal(fs_g2cap_inner_create(&ctx, VALENCES[number], &inner), FS_OK);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    print_message("valence %d: %d smooth functions in %.0f ms\n", VALENCES[number], inner->n_smooth, 1e3 * seconds);
    assert_true(seconds < 1);
    fs_g2cap_inner_free(&ctx, inner);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_orthonormal), cmocka_unit_test(test_energy),
      cmocka_unit_test(test_rim),         cmocka_unit_test(test_same_everywhere),
      cmocka_unit_test(test_refuses),     cmocka_unit_test(test_memory_failures),
      cmocka_unit_test(test_time),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
