/* SPDX-License-Identifier: MIT */
/* Fairing: its course, stopping, refusals, and surfaces whose fairest form or energy is known: a disturbed piece of a sphere
   and of a cylinder must come back. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fairsurf/fair.h"
#include "fairsurf/surface.h"
#include "support.h"

/* ---- surfaces that must come back ---- */

typedef struct faired {
  fs_fair_report report;
  double S_undisturbed,
      deviation; /* of points of the surface from the best sphere or cylinder, relative to its radius */
} faired;

/* Radius and centre of the least squares sphere |x|^2 = 2 c.x + d through points (algebraic fit, then r^2 = d + |c|^2); with
   `axis` the z axis is a direction of the cylinder and z is left out. Returns the largest deviation / r. */
static double fit_deviation(const fs_vec3 *p, int32_t n, bool is_cylinder) {
  double A[4][5] = {{0}}, solution[4], r, worst = 0;
  int m = is_cylinder ? 3 : 4;
  for (int32_t i = 0; i < n; i++) {
    double z = is_cylinder ? 0 : p[i].z, rhs = p[i].x * p[i].x + p[i].y * p[i].y + z * z;
    double row[4] = {2 * p[i].x, 2 * p[i].y, is_cylinder ? 1 : 2 * z, 1};
    for (int a = 0; a < m; a++) {
      for (int b = 0; b < m; b++) A[a][b] += row[a] * row[b];
      A[a][4] += row[a] * rhs;
    }
  }
  for (int c = 0; c < m; c++) /* positive definite: no exchange of rows */
    for (int a = c + 1; a < m; a++) {
      double factor = A[a][c] / A[c][c];
      for (int b = 0; b < 5; b++) A[a][b] -= factor * A[c][b];
    }
  for (int c = m - 1; c >= 0; c--) {
    solution[c] = A[c][4];
    for (int b = c + 1; b < m; b++) solution[c] -= A[c][b] * solution[b];
    solution[c] /= A[c][c];
  }
  double cx = solution[0], cy = solution[1], cz = is_cylinder ? 0 : solution[2];
  r = sqrt(solution[m - 1] + cx * cx + cy * cy + cz * cz);
  for (int32_t i = 0; i < n; i++) {
    double z = is_cylinder ? 0 : p[i].z - cz;
    worst = fmax(worst, fabs(hypot(hypot(p[i].x - cx, p[i].y - cy), z) - r) / r);
  }
  return worst;
}

static void fair_disturbed(fs_mesh *mesh, bool is_cylinder, uint64_t seed, double radius, faired *result) {
  fs_context ctx = test_context();
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  fs_triangles *triangles = NULL;
  fs_fair_options options = {.functional = fs_functional_find("penalised")};
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
  assert_int_equal(fs_space_rim(&ctx, mesh, space, fixed), FS_OK);
  options.fixed = fixed;
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  assert_int_equal(fs_fair(&ctx, space, &options, c, &result->report), FS_OK);
  result->S_undisturbed = result->report.end.S;
  for (int32_t v = 0; v < space->n_dofs; v++) {
    c[v] = space->start[v];
    if (fixed[v]) continue;
    c[v].x += test_random_real(&seed, -0.1, 0.1) * radius;
    c[v].y += test_random_real(&seed, -0.1, 0.1) * radius;
    c[v].z += test_random_real(&seed, -0.1, 0.1) * radius;
  }
  assert_int_equal(fs_fair(&ctx, space, &options, c, &result->report), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, space, c, &surface), FS_OK);
  assert_int_equal(fs_tessellate(&ctx, surface, 4, &triangles), FS_OK);
  result->deviation = fit_deviation(triangles->position, triangles->n_vertices, is_cylinder);
  fs_triangles_free(&ctx, triangles);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  free(fixed);
  free(c);
}

static void check_comes_back(fs_mesh *(*make)(void), bool is_cylinder) {
  fs_context ctx = test_context();
  double S[3];
  for (int seed = 0; seed < 3; seed++) {
    fs_mesh *mesh = make();
    faired result;
    fair_disturbed(mesh, is_cylinder, (uint64_t)seed + 1, 1, &result);
    S[seed] = result.report.end.S;
    assert_true(fabs(S[seed] - S[0]) <= 1e-6 * S[0]);
    assert_true(S[seed] <= 1.01 * result.S_undisturbed);
    assert_true(result.deviation <= 5e-4);
    fs_mesh_free(&ctx, mesh);
  }
}

/* 12x12 faces on the unit sphere, half angle 35 degrees, vertices at the projections of an even grid of angles. */
static fs_mesh *sphere_cap(void) {
  fs_mesh *mesh = test_grid(12, 12, NULL);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    double unit = tan(35 * acos(-1.0) / 180) / 6, x = (mesh->position[v].x - 6) * unit,
           y = (mesh->position[v].y - 6) * unit;
    double length = sqrt(1 + x * x + y * y);
    mesh->position[v] = (fs_vec3){x / length, y / length, 1 / length};
  }
  return mesh;
}

/* 24 faces around, 11 along; the unit cylinder about the z axis. */
static fs_mesh *tube(void) {
  enum { AROUND = 24, LONG = 11 };
  fs_vec3 position[AROUND * (LONG + 1)];
  int32_t start[AROUND * LONG + 1], corner[4 * AROUND * LONG], n = 0;
  for (int j = 0; j <= LONG; j++)
    for (int i = 0; i < AROUND; i++) {
      double angle = 2 * acos(-1.0) * i / AROUND;
      position[i + AROUND * j] = (fs_vec3){cos(angle), sin(angle), 0.2618 * j};
    }
  for (int j = 0; j < LONG; j++)
    for (int i = 0; i < AROUND; i++) {
      start[n / 4] = n;
      corner[n++] = i + AROUND * j;
      corner[n++] = (i + 1) % AROUND + AROUND * j;
      corner[n++] = (i + 1) % AROUND + AROUND * (j + 1);
      corner[n++] = i + AROUND * (j + 1);
    }
  start[n / 4] = n;
  return test_mesh(AROUND * (LONG + 1), position, AROUND * LONG, start, corner);
}

static void test_sphere_comes_back(void **state) {
  (void)state;
  check_comes_back(sphere_cap, false);
}

static void test_cylinder_comes_back(void **state) {
  (void)state;
  check_comes_back(tube, true);
}

/* ---- options and refusals ---- */

static bool stop_at_second_step(void *user, const fs_step *step) {
  (void)user;
  return step->number < 2;
}

typedef struct iterates {
  int32_t n, n_dofs;
  fs_vec3 *last;
  double value;
} iterates;

static bool keep_iterate(void *user, const fs_step *step, const fs_vec3 *c) {
  iterates *it = user;
  assert_int_equal(step->number, it->n++);
  memcpy(it->last, c, (size_t)it->n_dofs * sizeof *c);
  it->value = step->value;
  return step->number < 3;
}

/* F by all nodes at every iterate: stages that see few of them report other values. */
typedef struct fall {
  const fs_space *space;
  const fs_fair_options *options;
  double F;
} fall;

static bool falls(void *user, const fs_step *step, const fs_vec3 *c) {
  fall *f = user;
  fs_context ctx = test_context();
  fs_energy energy;
  fs_fair_options options = *f->options;
  options.iterate = NULL;
  assert_int_equal(fs_fair_energy(&ctx, f->space, &options, c, &energy), FS_OK);
  assert_true(step->number == 0 || energy.F <= f->F);
  f->F = energy.F;
  return true;
}

static bool cancel_at_once(void *user, const char *stage, double fraction) {
  int *n_left = user;
  (void)stage, (void)fraction;
  return --*n_left > 0;
}

static void test_course(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = sphere_cap();
  fs_space *space = NULL;
  fs_fair_report full, cut;
  fs_energy energy;
  uint64_t seed = 5;
  (void)state;
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c), *start = calloc((size_t)space->n_dofs, sizeof *c);
  assert_int_equal(fs_space_rim(&ctx, mesh, space, fixed), FS_OK);
  memcpy(start, space->start, (size_t)space->n_dofs * sizeof *c);
  for (int32_t v = 0; v < space->n_dofs; v++)
    if (!fixed[v]) start[v].z += test_random_real(&seed, -0.05, 0.05);
  const fs_functional *penalised = fs_functional_find("penalised");
  fs_fair_options options = {.functional = penalised, .fixed = fixed};

  /* monotone, the gradient 1e-8 of its start */
  memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
  fall fall = {.space = space, .options = &options};
  options.iterate = falls;
  options.monitor_user = &fall;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &full), FS_OK);
  options.iterate = NULL;
  options.monitor_user = NULL;
  assert_int_equal(full.stop, FS_STOP_GRADIENT);
  assert_true(full.end.gradient <= 1e-8 * full.start.gradient);
  for (int32_t i = 1; i < full.n_trace; i++)
    assert_true(full.trace[i].stage > full.trace[i - 1].stage || full.trace[i].value <= full.trace[i - 1].value);
  for (int32_t v = 0; v < space->n_dofs; v++)
    if (fixed[v]) assert_memory_equal(&c[v], &start[v], sizeof *c);

  /* the report ends with a finer measurement */
  fs_quality quality;
  assert_int_equal(fs_fair_quality(&ctx, space, c, 12, 24, &quality), FS_OK);
  assert_true(quality.S == full.quality.S && quality.least_density == full.quality.least_density);
  assert_true(fabs(quality.S - full.end.S) <= 1e-9 * full.end.S && quality.least_density > 0.1);
  assert_int_equal(fs_fair_quality(&ctx, space, c, 33, 0, &quality), FS_ERR_ARGUMENT);

  /* the energy function agrees with the report */
  assert_int_equal(fs_fair_energy(&ctx, space, &options, c, &energy), FS_OK);
  assert_true(energy.F == full.end.F && energy.S == full.end.S && energy.Q == full.end.Q);
  assert_true(fabs(energy.F - energy.S - full.c * energy.Q) <= 1e-14 * energy.F);

  /* cancelled: the best iterate */
  memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
  options.monitor = stop_at_second_step;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_OK);
  assert_int_equal(cut.stop, FS_STOP_CANCELLED);
  assert_true(cut.end.F < cut.start.F && cut.n_steps == 2);
  options.monitor = NULL;

  /* every iterate, the start first; the last one is the result */
  iterates it = {.n_dofs = space->n_dofs, .last = calloc((size_t)space->n_dofs, sizeof *c)};
  memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
  options.iterate = keep_iterate;
  options.monitor_user = &it;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_OK);
  assert_true(it.n == 4 && cut.n_steps == 3 && cut.stop == FS_STOP_CANCELLED);
  assert_memory_equal(c, it.last, (size_t)space->n_dofs * sizeof *c);
  options.iterate = NULL;
  free(it.last);

  /* no time: the start; a progress function that cancels: the best iterate so far, whenever it says so */
  memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
  options.max_seconds = 1e-9;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_OK);
  assert_true(cut.stop == FS_STOP_TIME && cut.n_steps == 0 && cut.end.F == cut.start.F);
  options.max_seconds = 0;
  for (int n = 1; n < 16; n += 3) {
    int n_left = n;
    fs_context watched = test_context();
    watched.progress = cancel_at_once;
    watched.user = &n_left;
    memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
    fs_status status = fs_fair(&watched, space, &options, c, &cut);
    assert_true(status == FS_OK || status == FS_ERR_CANCELLED);
    if (status == FS_OK) assert_true(cut.stop == FS_STOP_CANCELLED && cut.end.F <= cut.start.F);
    if (status != FS_OK) assert_memory_equal(c, start, (size_t)space->n_dofs * sizeof *c);
  }

  /* a wide tolerance ends early; polishing needs something to lower */
  memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
  options.decrease_tolerance = 0.1;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_OK);
  assert_true(cut.stop == FS_STOP_DECREASE && cut.n_steps < full.n_steps);
  options.decrease_tolerance = 0;
  options.polish = true;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_ERR_ARGUMENT);
  options.polish = false;

  /* the triharmonic functional is quadratic: one step */
  memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
  options.functional = fs_functional_find("triharmonic");
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_OK);
  assert_true(cut.n_hessians <= 2 && cut.end.gradient <= 1e-8 * cut.start.gradient);
  options.functional = penalised;

  /* started there, the same minimum of F */
  memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
  options.start_triharmonic = true;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_OK);
  assert_true(fabs(cut.end.F - full.end.F) <= 1e-9 * full.end.F);
  options.start_triharmonic = false;

  /* a parameter out of range; a surface that is not regular names the face */
  double C = -1;
  options.param = &C;
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_ERR_ARGUMENT);
  options.param = NULL;
  for (int32_t v = 0; v < space->n_dofs; v++) c[v] = (fs_vec3){1, 2, 3};
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "face"));

  /* nothing free: nothing moves */
  for (int32_t v = 0; v < space->n_dofs; v++) fixed[v] = true;
  memcpy(c, start, (size_t)space->n_dofs * sizeof *c);
  assert_int_equal(fs_fair(&ctx, space, &options, c, &cut), FS_OK);
  assert_memory_equal(c, start, (size_t)space->n_dofs * sizeof *c);
  assert_true(cut.n_free == 0 && cut.end.F == cut.start.F);
  free(c), free(start), free(fixed);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
}

/* ---- graphs as bicubic patches: one element whose dofs are its Bezier points ---- */

/* Bezier coefficient k of x^power, degree 3: C(k, power) / C(3, power). */
static double monomial_coefficient(int power, int k) {
  static const double binomial[4][4] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 2, 1, 0}, {1, 3, 3, 1}};
  return binomial[k][power] / binomial[3][power];
}

static void test_graph_patches(void **state) {
  static const struct {
    double weight[4][4], S, area; /* z = sum of weight[i][j] x^i y^j */
  } graph[] = {
      {{[1] = {[1] = 1}}, 0.05818831883894, 1.280789275273},
      {{[0] = {[2] = 0.5}, [2] = {[0] = 0.5}}, 0.2075662456293, 1.280789275273},
      {{[0] = {[2] = -0.5}, [2] = {[0] = 0.5}}, 0.06765808515898, 1.280789275273},
      {{[3] = {[0] = 1}}, 3.091739546388, 1.547865654684},
      {{[2] = {[1] = 1}}, 0.8794643847793, 1.249504263163},
      {{[3] = {[3] = 1}}, 2.945106176589, 1.162040641819},
  };
  double E[16 * 16] = {0};
  int32_t dof[16];
  fs_extraction extraction = {.degree_u = 3, .degree_v = 3, .n_dofs = 16, .E = E, .valence = 4, .is_borrowed = true};
  fs_element element = {.neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  bool fixed[16] = {true, true};
  (void)state;
  for (int i = 0; i < 16; i++) {
    E[17 * i] = 1;
    dof[i] = i;
  }
  for (size_t g = 0; g < sizeof graph / sizeof graph[0]; g++) {
    fs_context ctx = test_context();
    fs_vec3 c[16];
    fs_energy energy;
    fs_fair_options options = {.fixed = fixed, .n_nodes_square = 32, .n_nodes_cap = 32};
    for (int k = 0; k < 16; k++) {
      c[k] = (fs_vec3){k % 4 / 3.0, k / 4 / 3.0, 0};
      for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
          c[k].z += graph[g].weight[i][j] * monomial_coefficient(i, k % 4) * monomial_coefficient(j, k / 4);
    }
    fs_space space = {.n_vertices = 16,
                      .n_dofs = 16,
                      .n_elements = 1,
                      .n_extractions = 1,
                      .continuity = 2,
                      .n_element_dofs = 16,
                      .element = &element,
                      .extraction = &extraction,
                      .dof = dof,
                      .start = c};
    assert_int_equal(fs_fair_energy(&ctx, &space, &options, c, &energy), FS_OK);
    assert_true(fabs(energy.S - graph[g].S) <= 1e-10 * graph[g].S);
    fs_quality quality;
    assert_int_equal(fs_fair_quality(&ctx, &space, c, 32, 32, &quality), FS_OK);
    assert_true(fabs(quality.S - graph[g].S) <= 1e-10 * graph[g].S && quality.S_caps == 0);
    /* |p_u x p_v| = (1 + |grad z|^2)^(1/2), near 1 in the corner or on the axis where the gradient is least */
    assert_true(fabs(quality.area - graph[g].area) <= 1e-10 * graph[g].area);
    assert_true(fabs(quality.least_density * quality.area - 1) <= 2e-3 && quality.face == 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_graph_patches),
      cmocka_unit_test(test_course),
      cmocka_unit_test(test_sphere_comes_back),
      cmocka_unit_test(test_cylinder_comes_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
