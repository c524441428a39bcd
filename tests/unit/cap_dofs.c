/* SPDX-License-Identifier: MIT */
/* Spaces whose caps have inner coefficients: numbering, G2 contact for any coefficients, the rim, derivatives of the
   functional by all dofs, bad input, memory. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fair/problem.h"
#include "fairsurf/analyse.h"
#include "fairsurf/refine.h"
#include "fairsurf/surface.h"
#include "space/g2cap.h"
#include "support.h"

static const fs_space_options LINEAR = {.caps = FS_CAPS_LINEAR}, SMOOTH = {.caps = FS_CAPS_SMOOTH},
                              FULL = {.caps = FS_CAPS_FULL}, ALL_FULL = {.caps = FS_CAPS_FULL, .max_full_valence = 24};

static fs_space *make_space(fs_context *ctx, const fs_mesh *mesh, const fs_space_options *options) {
  fs_space *space = NULL;
  assert_int_equal(fs_space_create_with(ctx, mesh, options, &space), FS_OK);
  assert_int_equal(fs_space_validate(ctx, space), FS_OK);
  return space;
}

static int32_t n_smooth(int32_t k) { return k == 3 ? 16 : k == 5 ? 21 : k == 6 ? 25 : 3 * k + 6; }

/* The mesh refined n times by averaging; the given one is freed. */
static fs_mesh *refined(fs_mesh *mesh, int n) {
  fs_context ctx = test_context();
  for (int i = 0; i < n; i++) {
    fs_refinement *step;
    assert_int_equal(fs_mesh_refine(&ctx, mesh, "averaging", NULL, &step), FS_OK);
    fs_mesh_free(&ctx, mesh);
    mesh = test_mesh(step->mesh->n_vertices, step->mesh->position, step->mesh->n_faces, step->mesh->face_start,
                     step->mesh->origin);
    fs_refinement_free(&ctx, step);
  }
  return mesh;
}

static fs_vec3 *random_dofs(const fs_space *space, double size, uint64_t seed) {
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  for (int32_t i = space->n_vertices; i < space->n_dofs; i++)
    c[i] = (fs_vec3){test_random_real(&seed, -size, size), test_random_real(&seed, -size, size),
                     test_random_real(&seed, -size, size)};
  return c;
}

/* ---- numbering ---- */

/* A 7-prism refined twice: caps of valence 3 and 7. */
static void check_numbering(const fs_space_options *options, int32_t (*n_local)(int32_t k)) {
  fs_context ctx = test_context();
  fs_mesh *mesh = refined(test_prism(7), 2);
  fs_space *space = make_space(&ctx, mesh, options);
  int32_t dof = mesh->n_vertices, n_found[2] = {0};
  assert_int_equal(space->n_vertices, mesh->n_vertices);
  assert_int_equal(space->n_caps, 16);
  for (int32_t i = 0; i < space->n_caps; i++) {
    const fs_cap *cap = &space->cap[i];
    int32_t k = cap->valence, h = cap->halfedge;
    n_found[k == 7]++;
    assert_true(i == 0 || cap->vertex > cap[-1].vertex);
    assert_true(mesh->origin[h] == cap->vertex && k == fs_mesh_valence(mesh, cap->vertex));
    assert_int_equal(cap->first_dof, dof);
    assert_int_equal(cap->n_dofs, options->caps == FS_CAPS_LINEAR ? 0 : n_smooth(k) + k * n_local(k));
    for (int32_t s = 0; s < k; s++, h = fs_mesh_rotate(mesh, h)) { /* anticlockwise, each sector with its own 16 */
      const fs_element *e = NULL;
      for (int32_t j = 0; j < space->n_elements; j++)
        if (space->element[j].halfedge == h && space->extraction[space->element[j].extraction].valence == k)
          e = &space->element[j];
      assert_non_null(e);
      const fs_extraction *x = &space->extraction[e->extraction];
      const int32_t *own = space->dof + e->dof_start + 6 * k + 1;
      if (cap->n_dofs == 0) {
        assert_true(x->n_dofs == 6 * k + 1 && x->n_offsets == 0);
        continue;
      }
      assert_int_equal(x->n_dofs, 6 * k + 1 + n_smooth(k) + n_local(k));
      assert_int_equal(x->n_offsets, n_smooth(k) + n_local(k));
      for (int32_t d = 0; d < n_smooth(k); d++) assert_int_equal(own[d], dof + d);
      for (int32_t d = 0; d < n_local(k); d++)
        assert_int_equal(own[n_smooth(k) + d], dof + n_smooth(k) + s * n_local(k) + d);
    }
    dof += cap->n_dofs;
  }
  assert_int_equal(space->n_dofs, dof);
  assert_true(n_found[0] == 14 && n_found[1] == 2);
  assert_int_equal(space->n_extractions, options->caps == FS_CAPS_LINEAR ? 1 + 2 : 1 + 3 + 7);
  for (int32_t i = 0; i < space->n_dofs; i++) {
    fs_vec3 zero = {0, 0, 0};
    assert_memory_equal(&space->start[i], i < mesh->n_vertices ? &mesh->position[i] : &zero, sizeof zero);
  }
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

static int32_t none(int32_t k) { return (void)k, 0; }
static int32_t sixteen(int32_t k) { return (void)k, 16; }
static int32_t only_three(int32_t k) { return k == 3 ? 16 : 0; }

static void test_numbering(void **state) {
  const fs_space_options up_to_six = {.caps = FS_CAPS_FULL, .max_full_valence = 6};
  (void)state;
  check_numbering(&LINEAR, none);
  check_numbering(&SMOOTH, none);
  check_numbering(&FULL, sixteen);
  check_numbering(&up_to_six, only_three);
}

/* Larger valences than 8 are smooth unless asked otherwise; NULL and fs_space_create give linear caps. */
static void test_defaults(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(9, 3);
  const fs_space_options *options[] = {NULL, &LINEAR, &SMOOTH, &FULL, &ALL_FULL};
  const int32_t n_dofs[] = {0, 0, 33, 33, 33 + 16 * 9};
  fs_space *space = NULL;
  (void)state;
  for (int i = 0; i < 5; i++) {
    space = make_space(&ctx, mesh, options[i]);
    assert_int_equal(space->n_dofs, mesh->n_vertices + n_dofs[i]);
    fs_space_free(&ctx, space);
  }
  assert_int_equal(fs_space_create(&ctx, mesh, &space), FS_OK);
  assert_int_equal(space->n_dofs, mesh->n_vertices);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

/* ---- the surface ---- */

/* Zero coefficients: the linear caps, point for point. */
static void test_offsets(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(5, 4);
  fs_space *linear = make_space(&ctx, mesh, &LINEAR), *full = make_space(&ctx, mesh, &FULL);
  fs_surface *a, *b;
  (void)state;
  assert_int_equal(fs_surface_create(&ctx, linear, linear->start, &a), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, full, full->start, &b), FS_OK);
  assert_true(a->n_data == b->n_data);
  for (size_t i = 0; i < a->n_data; i++) assert_true(a->data[i] == b->data[i]);
  fs_surface_free(&ctx, a);
  fs_surface_free(&ctx, b);
  fs_space_free(&ctx, linear);
  fs_space_free(&ctx, full);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

static void check_contact(fs_mesh *mesh, double noise, const fs_space_options *options, double size) {
  fs_context ctx = test_context();
  uint64_t seed = 31;
  test_mesh_disturb(mesh, noise, &seed);
  fs_space *space = make_space(&ctx, mesh, options);
  for (int trial = 0; trial < 2; trial++) {
    fs_vec3 *c = random_dofs(space, size, 100 + (uint64_t)trial);
    fs_surface *surface;
    fs_contact contact;
    assert_int_equal(fs_surface_create(&ctx, space, c, &surface), FS_OK);
    assert_int_equal(fs_surface_contact(&ctx, surface, 6, &contact), FS_OK);
    assert_true(contact.position <= 1e-11 && contact.normal <= 1e-10);
    assert_true(contact.curvature <= 1e-8 * contact.largest_curvature && contact.largest_curvature > 0.1);
    if (trial == 0)
      print_message("%4d caps, %6d dofs: position %.0e, normal %.0e, curvature %.0e of %.3g\n", space->n_caps,
                    space->n_dofs, contact.position, contact.normal, contact.curvature, contact.largest_curvature);
    fs_surface_free(&ctx, surface);
    free(c);
  }
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

static void test_contact(void **state) {
  static const int32_t valences[] = {3, 5, 6, 7, 8, 9, 12, 16, 24};
  (void)state;
  check_contact(refined(test_cube(), 1), 0.03, &FULL, 0.05);
  check_contact(refined(test_cube(), 1), 0.03, &FULL, 0.2);
  check_contact(refined(test_cube(), 1), 0.03, &SMOOTH, 0.2);
  check_contact(refined(test_cube(), 2), 0.01, &FULL, 0.1);
  check_contact(refined(test_prism(5), 2), 0.01, &FULL, 0.1);
  check_contact(refined(test_prism(6), 2), 0.01, &SMOOTH, 0.1);
  check_contact(refined(test_prism(8), 2), 0.01, &FULL, 0.05);
  for (size_t i = 0; i < sizeof valences / sizeof *valences; i++) {
    check_contact(test_star(valences[i], 4), 0.02, &SMOOTH, 0.3);
    check_contact(test_star(valences[i], 4), 0.02, &ALL_FULL, 0.3);
  }
}

/* Coefficients change the surface: largest movement of a Bezier point by coefficients of size 1 is not negligible. */
static void test_effect(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(5, 3);
  fs_space *space = make_space(&ctx, mesh, &FULL);
  fs_surface *a, *b;
  (void)state;
  assert_int_equal(fs_surface_create(&ctx, space, space->start, &a), FS_OK);
  for (int32_t dof = space->n_vertices; dof < space->n_dofs; dof++) {
    fs_vec3 *c = random_dofs(space, 0, 1);
    double largest = 0;
    c[dof].z += 1;
    assert_int_equal(fs_surface_create(&ctx, space, c, &b), FS_OK);
    for (size_t i = 0; i < a->n_data; i++) largest = fmax(largest, fabs(a->data[i] - b->data[i]));
    assert_true(largest > 1e-3);
    fs_surface_free(&ctx, b);
    free(c);
  }
  fs_surface_free(&ctx, a);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

/* Free, except where all vertices of the cap are fixed. */
static void test_rim(void **state) {
  (void)state;
  for (int32_t rings = 2; rings <= 4; rings++) {
    fs_context ctx = test_context();
    fs_mesh *mesh = test_star(5, rings);
    fs_space *space = make_space(&ctx, mesh, &FULL);
    bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed), all = true;
    assert_int_equal(fs_space_rim(&ctx, mesh, space, fixed), FS_OK);
    for (int32_t v = 0; v < space->n_vertices; v++) all &= fixed[v];
    assert_int_equal(all, rings == 2);
    for (int32_t i = space->n_vertices; i < space->n_dofs; i++) assert_int_equal(fixed[i], rings == 2);
    free(fixed);
    fs_space_free(&ctx, space);
    fs_mesh_free(&ctx, mesh);
    fs_context_clear(&ctx);
  }
}

/* ---- derivatives of the functional ---- */

static const fs_density *const S_and_Q[2] = {&fs_density_curvature_variation, &fs_density_tangential};

/* x[n] moved along d; gradient there. */
static double value_at(fs_problem *p, int32_t n, const double *x, double h, const double *d, double *g) {
  double *y = calloc((size_t)n, sizeof *y), integral[2];
  for (int32_t i = 0; i < n; i++) y[i] = x[i] + h * d[i];
  fs_problem_set(p, y);
  assert_int_equal(fs_problem_evaluate(p, FS_GRADIENT, integral, NULL, g, NULL), FS_OK);
  free(y);
  return p->weight[0] * integral[0] + p->weight[1] * integral[1];
}

/* Central differences, with one extrapolation for the value, along random directions: all dofs, then inner ones only. */
static void check_derivatives(fs_mesh *mesh, double noise, const fs_space_options *options, double weight_S,
                              double weight_Q) {
  fs_context ctx = test_context();
  uint64_t seed = 41;
  test_mesh_disturb(mesh, noise, &seed);
  fs_space *space = make_space(&ctx, mesh, options);
  fs_vec3 *c = random_dofs(space, 3 * noise, 7);
  fs_problem *p;
  assert_int_equal(fs_problem_create(&ctx, space, 2, S_and_Q, NULL, 6, 6, c, &p), FS_OK);
  p->weight[0] = weight_S, p->weight[1] = weight_Q;
  int32_t n = 3 * p->n_free, first = 3 * (p->n_free - (space->n_dofs - space->n_vertices));
  double *x = calloc((size_t)n, sizeof *x), *d = calloc((size_t)n, sizeof *d), *g = calloc((size_t)n, sizeof *g);
  double *Hd = calloc((size_t)n, sizeof *Hd), *gp = calloc((size_t)n, sizeof *gp), *gm = calloc((size_t)n, sizeof *gm);
  double *coarse = calloc((size_t)n, sizeof *coarse), integral[2]; /* differences of the gradient by the longer step */
  fs_problem_get(p, x);
  assert_int_equal(fs_problem_evaluate(p, FS_HESSIAN, integral, NULL, g, p->pattern), FS_OK);
  for (int trial = 0; trial < 4; trial++) {
    double along = 0, difference[2], largest = 0, error = 0;
    for (int32_t i = 0; i < n; i++) {
      d[i] = trial >= 2 && i < first ? 0 : test_random_real(&seed, -1, 1);
      along += d[i] * g[i];
    }
    for (int i = 0; i < 2; i++) {
      double h = i == 0 ? 2e-4 : 1e-4, plus = value_at(p, n, x, h, d, gp);
      difference[i] = (plus - value_at(p, n, x, -h, d, gm)) / (2 * h);
      for (int32_t k = 0; k < n && i == 0; k++) coarse[k] = (gp[k] - gm[k]) / (2 * h);
    }
    assert_true(fabs((4 * difference[1] - difference[0]) / 3 - along) <= 1e-7 * fabs(along));
    fs_sparse_multiply(p->pattern, d, Hd);
    for (int32_t i = 0; i < n; i++) {
      largest = fmax(largest, fabs(Hd[i]));
      error = fmax(error, fabs((4 * (gp[i] - gm[i]) / 2e-4 - coarse[i]) / 3 - Hd[i])); /* one extrapolation */
    }
    assert_true(error <= 1e-5 * largest);
  }
  free(x), free(d), free(g), free(Hd), free(gp), free(gm), free(c), free(coarse);
  fs_problem_free(&ctx, p);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

/* The star of two rings on the plane net of the cap, bent a little: regular for any valence. */
static fs_mesh *plane_star(int32_t k) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(k, 2);
  const fs_g2cap *cap;
  assert_int_equal(fs_g2cap_get(&ctx, k, &cap), FS_OK);
  for (int32_t v = 0; v < 6 * k + 1; v++) { /* V(a, b) is number 3 (a - 1) + b of its sector here, 2 b + a - 1 there */
    int32_t within = (v + 5) % 6, other = v == 0 ? 0 : v - within + 2 * (within % 3) + within / 3;
    double x = cap->net[2 * other], y = cap->net[2 * other + 1];
    mesh->position[v] = (fs_vec3){x, y, 0.05 * (x * x + x * y)};
  }
  fs_context_clear(&ctx);
  return mesh;
}

static void test_derivatives(void **state) {
  (void)state;
  check_derivatives(test_star(3, 4), 0.03, &FULL, 1, 0);
  check_derivatives(test_star(5, 4), 0.03, &FULL, 1, 0.2);
  check_derivatives(test_star(6, 4), 0.03, &SMOOTH, 0, 1);
  check_derivatives(refined(test_cube(), 1), 0.03, &FULL, 1, 0.1);
  check_derivatives(plane_star(24), 0.003, &ALL_FULL, 1, 0.1); /* the widest elements there are: 239 dofs */
}

/* ---- bad input, memory ---- */

static void test_refuses(void **state) {
  static const fs_space_options bad[] = {{.caps = (fs_cap_inner)3}, {.caps = FS_CAPS_FULL, .max_full_valence = -1}};
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory), other = test_context();
  fs_mesh *mesh = test_star(5, 3);
  fs_space *space = NULL;
  (void)state;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    assert_int_equal(fs_space_create_with(&ctx, mesh, &bad[i], &space), FS_ERR_ARGUMENT);
    assert_true(space == NULL && ctx.message[0] != 0);
  }
  space = make_space(&ctx, mesh, &FULL);
  const fs_element *e = &space->element[space->n_elements - 1]; /* of the cap */
  int32_t *dof = &space->dof[e->dof_start], n = space->extraction[e->extraction].n_dofs;
  int32_t kept = dof[n - 1];
  dof[n - 1] = 0; /* a vertex in the place of an offset, and the other way */
  assert_int_equal(fs_space_validate(&ctx, space), FS_ERR_ARGUMENT);
  dof[n - 1] = kept;
  kept = dof[0];
  dof[0] = space->n_vertices;
  assert_int_equal(fs_space_validate(&ctx, space), FS_ERR_ARGUMENT);
  dof[0] = kept;
  assert_int_equal(fs_space_validate(&ctx, space), FS_OK);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  assert_int_equal(memory.n_live, 0);
  fs_mesh_free(&other, mesh);
}

static void test_memory_failures(void **state) {
  fs_context other = test_context();
  fs_mesh *mesh = test_star(3, 3);
  (void)state;
  for (int64_t fail_at = 1;; fail_at++) {
    struct test_memory memory = {.fail_at = fail_at};
    fs_context ctx = test_memory_context(&memory);
    fs_space *space = NULL;
    fs_status status = fs_space_create_with(&ctx, mesh, &FULL, &space);
    bool has_failed = memory.n_allocations >= fail_at;
    assert_int_equal(status, has_failed ? FS_ERR_MEMORY : FS_OK);
    assert_true((space == NULL) == has_failed);
    fs_space_free(&ctx, space);
    fs_context_clear(&ctx);
    assert_int_equal(memory.n_live, 0);
    if (!has_failed) {
      assert_true(fail_at > 50);
      break;
    }
  }
  fs_mesh_free(&other, mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_numbering),   cmocka_unit_test(test_defaults), cmocka_unit_test(test_offsets),
      cmocka_unit_test(test_contact),     cmocka_unit_test(test_effect),   cmocka_unit_test(test_rim),
      cmocka_unit_test(test_derivatives), cmocka_unit_test(test_refuses),  cmocka_unit_test(test_memory_failures),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
