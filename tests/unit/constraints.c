/* SPDX-License-Identifier: MIT */
/* Constraints, measured on the surface: held points and tangent planes, equations, mirror symmetry; what is refused. */
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

static double hill(double x, double y) { return 0.1 * (x - 4) * (x - 4) - 0.05 * y * (y - 7); }

typedef struct fixture {
  fs_context ctx;
  struct test_memory memory;
  fs_mesh *mesh;
  fs_space *space;
  bool *fixed;
  fs_vec3 *c;
  fs_constraints constraints;
  fs_fair_options options;
  fs_fair_report report;
} fixture;

static void set_up(fixture *f, fs_mesh *mesh, fs_cap_inner caps) {
  *f = (fixture){.mesh = mesh};
  f->ctx = test_memory_context(&f->memory);
  assert_int_equal(fs_space_create_with(&f->ctx, mesh, &(fs_space_options){.caps = caps}, &f->space), FS_OK);
  f->fixed = calloc((size_t)f->space->n_dofs, sizeof *f->fixed);
  f->c = calloc((size_t)f->space->n_dofs, sizeof *f->c);
  assert_int_equal(fs_space_rim(&f->ctx, mesh, f->space, f->fixed), FS_OK);
  memcpy(f->c, f->space->start, (size_t)f->space->n_dofs * sizeof *f->c);
  f->options = (fs_fair_options){
      .functional = fs_functional_find("penalised"), .fixed = f->fixed, .constraints = &f->constraints};
}

static void tear_down(fixture *f) {
  fs_context ctx = test_context();
  fs_space_free(&f->ctx, f->space);
  fs_context_clear(&f->ctx);
  assert_int_equal(f->memory.n_live, 0);
  free(f->fixed), free(f->c);
  fs_mesh_free(&ctx, f->mesh);
}

static fs_status fair(fixture *f) { return fs_fair(&f->ctx, f->space, &f->options, f->c, &f->report); }

static double distance(fs_vec3 a, fs_vec3 b) { return hypot(hypot(a.x - b.x, a.y - b.y), a.z - b.z); }
static double dot(fs_vec3 a, fs_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/* ---- holds ---- */

static void check_holds(fixture *f, double tolerance) {
  fs_surface *surface = NULL;
  assert_int_equal(fs_surface_create(&f->ctx, f->space, f->c, &surface), FS_OK);
  for (int32_t i = 0; i < f->constraints.n_holds; i++) {
    const fs_hold *h = &f->constraints.hold[i];
    fs_vec3 x[FS_JET_SIZE];
    fs_surface_evaluate(surface, h->element, h->u, h->v, x);
    if (h->has_position) assert_true(distance(x[FS_D], h->position) <= tolerance);
    if (!h->has_normal) continue;
    assert_true(fabs(dot(h->normal, x[FS_DU])) <= tolerance && fabs(dot(h->normal, x[FS_DV])) <= tolerance);
  }
  fs_surface_free(&f->ctx, surface);
}

static fs_vec3 start_point(fixture *f, int32_t element, double u, double v) {
  fs_surface *surface = NULL;
  fs_vec3 x[FS_JET_SIZE];
  assert_int_equal(fs_surface_create(&f->ctx, f->space, f->space->start, &surface), FS_OK);
  fs_surface_evaluate(surface, element, u, v, x);
  fs_surface_free(&f->ctx, surface);
  return x[FS_D];
}

/* Points above the surface, tangent planes, several in one element, and one of each that shares an element. */
static void test_holds(void **state) {
  (void)state;
  fixture f;
  fs_hold hold[4] = {
      {.element = 17, .u = 0.3, .v = 0.6, .has_position = true},
      {.element = 17, .u = 0.9, .v = 0.1, .has_position = true, .has_normal = true, .normal = {0.2, 0, 3}},
      {.element = 24, .u = 0, .v = 0, .has_normal = true, .normal = {0, 0.1, 1}},
      {.element = 31, .u = 1, .v = 0.5, .has_position = true}};
  set_up(&f, test_grid(9, 9, hill), FS_CAPS_LINEAR);
  for (int i = 0; i < 4; i++) {
    hold[i].position = start_point(&f, hold[i].element, hold[i].u, hold[i].v);
    hold[i].position.z += 0.1 * i;
  }
  f.constraints = (fs_constraints){.n_holds = 4, .hold = hold};
  for (int k = 0; fs_functionals[k] != NULL; k++) {
    f.options.functional = fs_functionals[k];
    memcpy(f.c, f.space->start, (size_t)f.space->n_dofs * sizeof *f.c);
    if (fs_functionals[k]->is_scale_free) {
      assert_int_equal(fair(&f), FS_ERR_UNSUPPORTED);
      continue;
    }
    if (fair(&f) != FS_OK) fail_msg("%s", f.ctx.message);
    assert_int_not_equal(f.report.stop, FS_STOP_ITERATIONS);
    assert_true(f.report.n_unknowns < f.report.n_free);
    check_holds(&f, 1e-12);
    for (int32_t v = 0; v < f.mesh->n_vertices; v++)
      if (f.fixed[v]) assert_memory_equal(&f.c[v], &f.space->start[v], sizeof f.c[v]);
  }
  tear_down(&f);
}

/* In caps offsets take part; the surface without constraints is fairer. */
static void test_holds_in_caps(void **state) {
  (void)state;
  for (int caps = FS_CAPS_LINEAR; caps <= FS_CAPS_FULL; caps++) {
    fixture f;
    fs_hold hold[2] = {{.u = 0, .v = 0, .has_position = true, .has_normal = true, .normal = {0, 0, 1}},
                       {.u = 0.5, .v = 0.25, .has_position = true}};
    set_up(&f, test_star(5, 5), (fs_cap_inner)caps);
    assert_int_equal(fair(&f), FS_OK);
    double free_F = f.report.end.F;
    for (int32_t e = 0, i = 0; e < f.space->n_elements && i < 2; e++)
      if (f.space->extraction[f.space->element[e].extraction].valence == 5) hold[i++].element = e;
    for (int i = 0; i < 2; i++) {
      hold[i].position = start_point(&f, hold[i].element, hold[i].u, hold[i].v);
      hold[i].position.z += 0.2;
    }
    f.constraints = (fs_constraints){.n_holds = 2, .hold = hold};
    memcpy(f.c, f.space->start, (size_t)f.space->n_dofs * sizeof *f.c);
    assert_int_equal(fair(&f), FS_OK);
    check_holds(&f, 1e-11);
    assert_true(f.report.end.F > free_F);
    tear_down(&f);
  }
}

/* The minimum under constraints: no direction that keeps them lowers F, by differences along the result of a second run that
   starts elsewhere. */
static void test_holds_unique(void **state) {
  (void)state;
  fixture f;
  fs_hold hold = {.element = 14, .u = 0.5, .v = 0.5, .has_position = true};
  uint64_t seed = 3;
  double F;
  set_up(&f, test_grid(8, 8, hill), FS_CAPS_LINEAR);
  hold.position = start_point(&f, 14, 0.5, 0.5);
  hold.position.z += 0.5;
  f.constraints = (fs_constraints){.n_holds = 1, .hold = &hold};
  assert_int_equal(fair(&f), FS_OK);
  F = f.report.end.F;
  for (int32_t v = 0; v < f.mesh->n_vertices; v++)
    if (!f.fixed[v]) f.c[v].x += test_random_real(&seed, -0.1, 0.1), f.c[v].z += test_random_real(&seed, -0.1, 0.1);
  assert_int_equal(fair(&f), FS_OK);
  assert_true(fabs(f.report.end.F - F) <= 1e-7 * F);
  tear_down(&f);
}

/* ---- equations ---- */

static void test_equations(void **state) {
  (void)state;
  fixture f;
  const int32_t pair[2] = {44, 45}, single[1] = {54};
  const double half[2] = {0.5, 0.5}, difference[2] = {1, -1}, one[1] = {1};
  const fs_equation equation[3] = {
      {.n_terms = 2, .dof = pair, .weight = half, .value = {4.5, 4, 1}},
      {.n_terms = 2, .dof = pair, .weight = difference, .direction = {0, 0, 2}, .value = {0.5, 0, 0}},
      {.n_terms = 1, .dof = single, .weight = one, .direction = {3, 0, 4}, .value = {20, 0, 0}}};
  set_up(&f, test_grid(9, 9, hill), FS_CAPS_LINEAR);
  f.constraints = (fs_constraints){.n_equations = 3, .equation = equation};
  assert_int_equal(fair(&f), FS_OK);
  fs_vec3 p = f.c[44], q = f.c[45], r = f.c[54];
  assert_true(fabs(p.x + q.x - 9) < 1e-12 && fabs(p.y + q.y - 8) < 1e-12 && fabs(p.z + q.z - 2) < 1e-12);
  assert_true(fabs(2 * (p.z - q.z) - 0.5) < 1e-12 && fabs(3 * r.x + 4 * r.z - 20) < 1e-12);
  tear_down(&f);
}

/* ---- symmetry ---- */

/* Vertices are images to the last bit; so are points of the mirrored surface, and dofs beyond the vertices to rounding. */
static void check_symmetric(fixture *f, const fs_symmetry *s, bool is_exact) {
  fs_surface *surface = NULL;
  for (int32_t v = 0; v < f->space->n_vertices; v++) {
    fs_vec3 image = fs_symmetry_reflect(s, f->c[v]), other = f->c[s->vertex[v]];
    assert_true(s->vertex[v] < v || (image.x == other.x && image.y == other.y && image.z == other.z) ||
                (!is_exact && distance(image, other) < 1e-14));
  }
  assert_int_equal(fs_surface_create(&f->ctx, f->space, f->c, &surface), FS_OK);
  for (int pass = 0; pass < 2; pass++) {
    if (pass == 1) assert_int_equal(fs_surface_mirror(&f->ctx, s, surface), FS_OK);
    for (int32_t e = 0; e < f->space->n_elements; e++)
      for (int k = 0; k < 25; k++) {
        double u = 0.25 * (k % 5), v = 0.25 * (k / 5), image_u, image_v;
        fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE], image;
        fs_symmetry_parameters(s, e, u, v, &image_u, &image_v);
        fs_surface_evaluate(surface, e, u, v, x);
        fs_surface_evaluate(surface, s->element[e], image_u, image_v, y);
        image = fs_symmetry_reflect(s, x[FS_D]);
        assert_true(distance(image, y[FS_D]) <= (is_exact && pass == 1 ? 0 : 1e-12));
      }
  }
  fs_surface_free(&f->ctx, surface);
}

static void check_symmetry(fs_mesh *mesh, fs_cap_inner caps, const fs_vec3 *normal, double offset, bool is_exact,
                           double noise) {
  fixture f;
  fs_symmetry *s = NULL;
  uint64_t seed = 9;
  double F;
  set_up(&f, mesh, caps);
  assert_int_equal(fs_symmetry_create(&f.ctx, mesh, f.space, normal, offset, &s), FS_OK);
  assert_int_equal(fair(&f), FS_OK); /* the start is symmetric, so is the minimum */
  F = f.report.end.F;
  memcpy(f.c, f.space->start, (size_t)f.space->n_dofs * sizeof *f.c);
  for (int32_t v = 0; v < mesh->n_vertices; v++)
    if (!f.fixed[v]) f.c[v].z += test_random_real(&seed, -noise, noise);
  for (int32_t d = f.space->n_vertices; d < f.space->n_dofs; d++) f.c[d].z = test_random_real(&seed, -noise, noise);
  f.constraints = (fs_constraints){.symmetry = s};
  assert_int_equal(fair(&f), FS_OK);
  assert_true(fabs(f.report.end.F - F) <= 1e-7 * F);
  assert_true(2 * f.report.n_unknowns <= f.report.n_free + f.report.n_free / 2);
  check_symmetric(&f, s, is_exact);
  fs_symmetry_free(&f.ctx, s);
  tear_down(&f);
}

static void test_symmetry(void **state) {
  (void)state;
  const fs_vec3 x = {1, 0, 0}, y = {0, 1, 0};
  fs_mesh *mesh = test_grid(8, 8, hill);
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].x -= 4;
  check_symmetry(mesh, FS_CAPS_LINEAR, &x, 0, true, 0.1);
  mesh = test_grid(9, 7, NULL); /* the plane runs through faces */
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    mesh->position[v].x -= 4.5;
    mesh->position[v].z = 0.02 * pow(mesh->position[v].x, 2) * mesh->position[v].y;
  }
  check_symmetry(mesh, FS_CAPS_LINEAR, &x, 0, true, 0.1);
  mesh = test_grid(8, 8, hill);
  check_symmetry(mesh, FS_CAPS_LINEAR, &x, 4, false, 0.1); /* to rounding, since the plane is not at 0 */
  for (int32_t k = 3; k < (TEST_IS_SANITIZED ? 5 : 7); k++)
    for (int caps = FS_CAPS_LINEAR; caps <= FS_CAPS_FULL && k != 4; caps++) {
      if (TEST_IS_SANITIZED && caps != FS_CAPS_FULL) continue;
      mesh = test_star(k, 4);
      for (int32_t v = 0; v < mesh->n_vertices; v++)
        mesh->position[v].z = 0.2 * pow(mesh->position[v].x, 2) + 0.05 * mesh->position[v].x;
      check_symmetry(mesh, (fs_cap_inner)caps, &y, 0, true, 0.05);
    }
}

/* Two caps that are images of each other, closed: nothing but the symmetry is asked for. */
static void test_symmetry_closed(void **state) {
  (void)state;
  if (TEST_IS_SANITIZED) return;
  const fs_vec3 z = {0, 0, 1};
  fs_refinement *fine[2] = {NULL, NULL};
  fs_mesh *cube = test_cube(), *mesh;
  fs_context ctx = test_context();
  fs_symmetry *s = NULL;
  fixture f;
  for (int32_t v = 0; v < cube->n_vertices; v++) cube->position[v].x *= 1.5;
  assert_int_equal(fs_mesh_refine(&ctx, cube, "averaging", NULL, &fine[0]), FS_OK);
  assert_int_equal(fs_mesh_refine(&ctx, fine[0]->mesh, "averaging", NULL, &fine[1]), FS_OK);
  assert_int_equal(fs_mesh_copy(&ctx, fine[1]->mesh, &mesh), FS_OK);
  set_up(&f, mesh, FS_CAPS_FULL);
  f.options.fixed = NULL;
  f.options.gradient_tolerance = 1e-5;
  assert_int_equal(fs_symmetry_create(&f.ctx, mesh, f.space, &z, 0, &s), FS_OK);
  f.constraints = (fs_constraints){.symmetry = s};
  assert_int_equal(fair(&f), FS_OK);
  assert_true(f.report.end.F < 0.5 * f.report.start.F);
  check_symmetric(&f, s, true);
  fs_symmetry_free(&f.ctx, s);
  tear_down(&f);
  fs_refinement_free(&ctx, fine[0]);
  fs_refinement_free(&ctx, fine[1]);
  fs_mesh_free(&ctx, cube);
}

/* Symmetry and held points together. */
static void test_symmetry_and_holds(void **state) {
  (void)state;
  fixture f;
  fs_symmetry *s = NULL;
  const fs_vec3 x = {1, 0, 0};
  fs_hold hold[2] = {{.element = 15, .u = 0.25, .v = 0.5, .has_position = true},
                     {.element = 14, .u = 0, .v = 0, .has_position = true}};
  fs_mesh *mesh = test_grid(8, 8, hill);
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].x -= 4;
  set_up(&f, mesh, FS_CAPS_LINEAR);
  for (int i = 0; i < 2; i++) {
    hold[i].position = start_point(&f, hold[i].element, hold[i].u, hold[i].v);
    hold[i].position.z += 0.2;
  }
  assert_int_equal(fs_symmetry_create(&f.ctx, mesh, f.space, &x, 0, &s), FS_OK);
  f.constraints = (fs_constraints){.n_holds = 2, .hold = hold, .symmetry = s};
  assert_int_equal(fair(&f), FS_OK);
  check_holds(&f, 1e-12);
  check_symmetric(&f, s, true);
  fs_symmetry_free(&f.ctx, s);
  tear_down(&f);
}

/* A tangent plane on the plane of symmetry, its numbers rounded: what is left of them must not become an equation. */
static void test_symmetry_and_rounded_normal(void **state) {
  (void)state;
  const fs_vec3 y = {0, 1, 0};
  for (int caps = FS_CAPS_LINEAR; caps <= (TEST_IS_SANITIZED ? FS_CAPS_LINEAR : FS_CAPS_FULL); caps += 2) {
    fixture f;
    fs_symmetry *s = NULL;
    fs_hold hold = {.u = 1e-10, .v = 0, .has_position = true, .has_normal = true, .normal = {0.1, 3e-8, 1}};
    fs_mesh *mesh = test_star(5, 5);
    for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].z = 0.05 * pow(mesh->position[v].x, 2);
    set_up(&f, mesh, (fs_cap_inner)caps);
    while (f.space->extraction[f.space->element[hold.element].extraction].valence == 4) hold.element++;
    hold.position = start_point(&f, hold.element, 0, 0);
    hold.position.y = 1e-9;
    hold.position.z += 0.1;
    assert_int_equal(fs_symmetry_create(&f.ctx, mesh, f.space, &y, 0, &s), FS_OK);
    f.constraints = (fs_constraints){.n_holds = 1, .hold = &hold, .symmetry = s};
    assert_int_equal(fair(&f), FS_OK);
    assert_true(f.report.end.S < 10);
    assert_int_equal(f.report.stop, FS_STOP_GRADIENT);
    hold.position.y = hold.normal.y = 0;
    check_holds(&f, 1e-8);
    check_symmetric(&f, s, true);
    fs_symmetry_free(&f.ctx, s);
    tear_down(&f);
  }
}

/* ---- refusals ---- */

static void refuse(fixture *f, fs_status expected, const char *part) {
  fs_vec3 before = f->c[44];
  f->ctx.message[0] = '\0';
  assert_int_equal(fair(f), expected);
  if (strstr(f->ctx.message, part) == NULL) fail_msg("%s", f->ctx.message);
  assert_memory_equal(&before, &f->c[44], sizeof before);
}

static void test_refusals(void **state) {
  (void)state;
  fixture f;
  const int32_t dof[1] = {0}, outside[1] = {1000};
  const double one[1] = {1};
  fs_equation equation = {.name = "equations.txt, line 7", .n_terms = 1, .dof = dof, .weight = one, .value = {1, 2, 3}};
  fs_hold hold[3] = {{.name = "points.txt, line 2", .element = 20, .u = 0.5, .v = 0.5, .has_position = true},
                     {.element = 20, .u = 0.5, .v = 0.5, .has_position = true}};
  set_up(&f, test_grid(9, 9, hill), FS_CAPS_LINEAR);
  hold[0].position = hold[1].position = start_point(&f, 20, 0.5, 0.5);
  f.constraints = (fs_constraints){.n_equations = 1, .equation = &equation};
  equation.dof = (const int32_t[]){12};
  refuse(&f, FS_ERR_ARGUMENT, "equations.txt, line 7 contradicts");
  equation.dof = outside;
  refuse(&f, FS_ERR_ARGUMENT, "equations.txt, line 7 names vertex 1000");
  equation = (fs_equation){.n_terms = 1, .dof = dof, .weight = one, .value = {NAN, 0, 0}};
  refuse(&f, FS_ERR_ARGUMENT, "equation 0 has a value");

  f.constraints = (fs_constraints){.n_holds = 2, .hold = hold};
  f.memory.n_notes = 0;
  assert_int_equal(fair(&f), FS_OK); /* the same twice is said, and done once */
  assert_int_equal(f.memory.n_notes, 1);
  assert_non_null(strstr(f.memory.note, "hold 1 follows"));
  hold[1].position.z += 0.01;
  refuse(&f, FS_ERR_ARGUMENT, "hold 1 contradicts");
  assert_non_null(strstr(f.ctx.message, "0.0"));
  hold[1].has_normal = true;
  hold[1].has_position = false;
  refuse(&f, FS_ERR_ARGUMENT, "no direction");
  hold[1].has_normal = false;
  hold[1].element = 1000;
  refuse(&f, FS_ERR_ARGUMENT, "element 1000");
  hold[1].element = 3;
  hold[1].u = 1.5;
  refuse(&f, FS_ERR_ARGUMENT, "(1.5, 0.5)");
  tear_down(&f);
}

/* Nothing fixed but one point of a closed surface: its size is free. */
static void test_size_is_free(void **state) {
  (void)state;
  fixture f;
  fs_hold hold[2] = {{.element = 0, .has_position = true}, {.element = 20, .has_position = true}};
  set_up(&f, test_torus(8, 6, 3, 1), FS_CAPS_LINEAR);
  f.options.fixed = NULL;
  hold[0].position = start_point(&f, 0, 0, 0);
  hold[1].position = start_point(&f, 20, 0, 0);
  f.constraints = (fs_constraints){.n_holds = 1, .hold = hold};
  refuse(&f, FS_ERR_UNSUPPORTED, "the size");
  f.constraints.n_holds = 2;
  assert_int_equal(fair(&f), FS_OK);
  check_holds(&f, 1e-12);
  tear_down(&f);
}

/* ---- threads, cancelling, memory ---- */

static bool stop_early(void *user, const fs_step *step) {
  (void)user;
  return step->number < 2;
}

static void test_threads_and_cancel(void **state) {
  (void)state;
  fs_vec3 *first = NULL;
  fs_hold hold = {.element = 12, .u = 0.5, .v = 0.25, .has_position = true};
  for (int run = 0; run < 3; run++) {
    fixture f;
    set_up(&f, test_star(3, 5), FS_CAPS_SMOOTH);
    hold.position = start_point(&f, 12, 0.5, 0.25);
    hold.position.z += 0.3;
    f.constraints = (fs_constraints){.n_holds = 1, .hold = &hold};
    f.ctx.n_threads = run == 1 ? 3 : 1;
    if (run == 2) f.options.monitor = stop_early;
    assert_int_equal(fair(&f), FS_OK);
    assert_true((run == 2) == (f.report.stop == FS_STOP_CANCELLED));
    check_holds(&f, 1e-12); /* cancelled or not */
    if (run == 0) {
      first = malloc((size_t)f.space->n_dofs * sizeof *first);
      memcpy(first, f.c, (size_t)f.space->n_dofs * sizeof *first);
    }
    if (run == 1) assert_memory_equal(first, f.c, (size_t)f.space->n_dofs * sizeof *first);
    tear_down(&f);
  }
  free(first);
}

static void test_memory(void **state) {
  (void)state;
  fixture f;
  fs_symmetry *s = NULL;
  const fs_vec3 y = {0, 1, 0};
  fs_hold hold = {.element = 12, .u = 0.5, .v = 0.25, .has_position = true};
  fs_mesh *mesh = test_star(3, 4);
  fs_status status = FS_ERR_MEMORY;
  int64_t n = 1;
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v].z = 0.2 * pow(mesh->position[v].x, 2);
  set_up(&f, mesh, FS_CAPS_FULL);
  assert_int_equal(fs_symmetry_create(&f.ctx, mesh, f.space, &y, 0, &s), FS_OK);
  hold.position = start_point(&f, 12, 0.5, 0.25);
  hold.position.z += 0.1;
  f.constraints = (fs_constraints){.n_holds = 1, .hold = &hold, .symmetry = s};
  f.options.max_iterations = 1;
  f.options.n_nodes_square = f.options.n_nodes_cap = 2;
  for (; status == FS_ERR_MEMORY; n += TEST_IS_SANITIZED ? 7 : 3) {
    int64_t live = f.memory.n_live;
    f.memory.fail_at = f.memory.n_allocations + n;
    status = fair(&f);
    assert_int_equal(f.memory.n_live, live);
    if (status != FS_OK) assert_memory_equal(f.c, f.space->start, (size_t)f.space->n_dofs * sizeof *f.c);
  }
  assert_int_equal(status, FS_OK);
  assert_true(n > 50);
  f.memory.fail_at = 0;
  fs_symmetry_free(&f.ctx, s);
  tear_down(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_holds),
                                     cmocka_unit_test(test_holds_in_caps),
                                     cmocka_unit_test(test_holds_unique),
                                     cmocka_unit_test(test_equations),
                                     cmocka_unit_test(test_symmetry),
                                     cmocka_unit_test(test_symmetry_closed),
                                     cmocka_unit_test(test_symmetry_and_holds),
                                     cmocka_unit_test(test_symmetry_and_rounded_normal),
                                     cmocka_unit_test(test_refusals),
                                     cmocka_unit_test(test_size_is_free),
                                     cmocka_unit_test(test_threads_and_cancel),
                                     cmocka_unit_test(test_memory)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
