/* SPDX-License-Identifier: MIT */
/* Inner coefficients kept with a mesh: out of a space and back into another one, over the same mesh and over one whose
   vertices, faces and corners are numbered otherwise; what does not fit is refused with the cap named; fixed caps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "fairsurf/refine.h"
#include "fairsurf/surface.h"
#include "support.h"

static const fs_space_options FULL = {.caps = FS_CAPS_FULL};

/* A 7-prism refined twice: 14 caps of valence 3 and 2 of valence 7. */
static fs_mesh *make_mesh(void) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_prism(7);
  for (int i = 0; i < 2; i++) {
    fs_refinement *step;
    assert_int_equal(fs_mesh_refine(&ctx, mesh, "averaging", NULL, &step), FS_OK);
    fs_mesh_free(&ctx, mesh);
    assert_int_equal(fs_mesh_copy(&ctx, step->mesh, &mesh), FS_OK);
    fs_refinement_free(&ctx, step);
  }
  return mesh;
}

static fs_space *make_space(fs_context *ctx, const fs_mesh *mesh, const fs_space_options *options) {
  fs_space *space = NULL;
  assert_int_equal(fs_space_create_with(ctx, mesh, options, &space), FS_OK);
  assert_int_equal(fs_space_validate(ctx, space), FS_OK);
  return space;
}

/* Random coefficients, in the caps of is_there(vertex) only. */
static fs_vec3 *random_dofs(const fs_space *space, bool (*is_there)(const fs_cap *cap)) {
  uint64_t seed = 11;
  fs_vec3 *c = calloc((size_t)space->n_dofs, sizeof *c);
  memcpy(c, space->start, (size_t)space->n_dofs * sizeof *c);
  for (int32_t i = 0; i < space->n_caps; i++) {
    const fs_cap *cap = &space->cap[i];
    for (int32_t d = cap->first_dof; is_there(cap) && d < cap->first_dof + cap->n_dofs; d++)
      c[d] = (fs_vec3){test_random_real(&seed, -1, 1), test_random_real(&seed, -1, 1), test_random_real(&seed, -1, 1)};
  }
  return c;
}

static bool everywhere(const fs_cap *cap) { return (void)cap, true; }
static bool nowhere(const fs_cap *cap) { return (void)cap, false; }
static bool at_every_second(const fs_cap *cap) { return cap->vertex % 2 == 0; }

static fs_surface *make_surface(fs_context *ctx, const fs_space *space, const fs_vec3 *c) {
  fs_surface *surface = NULL;
  assert_int_equal(fs_surface_create(ctx, space, c, &surface), FS_OK);
  return surface;
}

/* ---- the same mesh ---- */

static void check_round_trip(const fs_space_options *options, bool (*is_there)(const fs_cap *cap), int32_t n_expected) {
  fs_context ctx = test_context();
  fs_mesh *mesh = make_mesh();
  fs_space *space = make_space(&ctx, mesh, options);
  fs_vec3 *c = random_dofs(space, is_there);
  fs_cap_notes *notes = (fs_cap_notes *)c; /* overwritten in any case */
  assert_int_equal(fs_space_keep_caps(&ctx, mesh, space, c, &notes), FS_OK);
  if (n_expected == 0) {
    assert_null(notes);
  } else {
    fs_space *again = make_space(&ctx, mesh, &(fs_space_options){.caps = FS_CAPS_FULL, .kept = notes});
    fs_surface *a = make_surface(&ctx, space, c), *b = make_surface(&ctx, again, again->start);
    assert_int_equal(notes->n_caps, n_expected);
    assert_int_equal(notes->basis, FS_CAP_BASIS);
    assert_int_equal(fs_space_check_caps(&ctx, mesh, notes), FS_OK);
    assert_true(a->n_data == b->n_data);
    for (size_t i = 0; i < a->n_data; i++) assert_true(a->data[i] == b->data[i]);
    fs_surface_free(&ctx, a);
    fs_surface_free(&ctx, b);
    fs_space_free(&ctx, again);
    fs_cap_notes_free(&ctx, notes);
  }
  free(c);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

static void test_round_trip(void **state) {
  static const fs_space_options smooth = {.caps = FS_CAPS_SMOOTH}, linear = {.caps = FS_CAPS_LINEAR};
  static const fs_space_options all_full = {.caps = FS_CAPS_FULL, .max_full_valence = 24};
  static const fs_space_options few_full = {.caps = FS_CAPS_FULL, .max_full_valence = 5};
  (void)state;
  check_round_trip(&FULL, everywhere, 16);
  check_round_trip(&all_full, everywhere, 16);
  check_round_trip(&few_full, everywhere, 16);
  check_round_trip(&smooth, everywhere, 16);
  check_round_trip(&FULL, nowhere, 0);
  check_round_trip(&linear, everywhere, 0);
  fs_context ctx = test_context();
  fs_mesh *mesh = make_mesh();
  fs_space *space = make_space(&ctx, mesh, &FULL);
  int32_t n = 0;
  for (int32_t i = 0; i < space->n_caps; i++) n += at_every_second(&space->cap[i]);
  assert_true(n > 0 && n < 16);
  check_round_trip(&FULL, at_every_second, n);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

/* A valence above max_full_valence is full where what is kept is; linear and smooth caps leave out what has no room. */
static void test_kinds(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_star(9, 4);
  fs_space *space = make_space(&ctx, mesh, &(fs_space_options){.caps = FS_CAPS_FULL, .max_full_valence = 9});
  fs_vec3 *c = random_dofs(space, everywhere);
  fs_cap_notes *notes = NULL;
  static const int32_t n_dofs[3] = {0, 33, 33 + 16 * 9};
  (void)state;
  assert_int_equal(fs_space_keep_caps(&ctx, mesh, space, c, &notes), FS_OK);
  for (int caps = 0; caps < 3; caps++) {
    fs_space *again = make_space(&ctx, mesh, &(fs_space_options){.caps = (fs_cap_inner)caps, .kept = notes});
    assert_int_equal(again->n_dofs - again->n_vertices, n_dofs[caps]);
    assert_memory_equal(again->start + mesh->n_vertices, c + mesh->n_vertices, (size_t)n_dofs[caps] * sizeof *c);
    fs_space_free(&ctx, again);
  }
  fs_cap_notes_free(&ctx, notes);
  free(c);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

/* ---- another numbering ---- */

static void shuffle(int32_t n, int32_t *order, uint64_t *seed) {
  for (int32_t i = 0; i < n; i++) order[i] = i;
  for (int32_t i = n - 1; i > 0; i--) {
    int32_t j = test_random_integer(seed, 0, i), kept = order[i];
    order[i] = order[j];
    order[j] = kept;
  }
}

/* The mesh with new numbers: vertex v becomes new_vertex[v], face f comes at place new_face[f], its corners turned. */
static fs_mesh *renumbered(const fs_mesh *mesh, const int32_t *new_vertex, const int32_t *new_face, uint64_t *seed) {
  fs_vec3 *position = calloc((size_t)mesh->n_vertices, sizeof *position);
  int32_t *start = calloc((size_t)mesh->n_faces + 1, sizeof *start);
  int32_t *corner = calloc((size_t)mesh->n_halfedges, sizeof *corner);
  for (int32_t v = 0; v < mesh->n_vertices; v++) position[new_vertex[v]] = mesh->position[v];
  for (int32_t f = 0; f <= mesh->n_faces; f++) start[f] = 4 * f;
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    int32_t turn = test_random_integer(seed, 0, 3);
    for (int32_t i = 0; i < 4; i++)
      corner[4 * new_face[f] + (i + turn) % 4] = new_vertex[mesh->origin[mesh->face_start[f] + i]];
  }
  fs_mesh *result = test_mesh(mesh->n_vertices, position, mesh->n_faces, start, corner);
  free(position), free(start), free(corner);
  return result;
}

static int32_t patch_of_face(const fs_surface *surface, int32_t face) {
  for (int32_t i = 0; i < surface->n_patches; i++)
    if (surface->patch[i].face == face) return i;
  return FS_NONE;
}

/* Distance of the points in the middle of a patch: the same place for any corner to begin with. */
static double distance(const fs_surface *a, int32_t i, const fs_surface *b, int32_t j) {
  fs_vec3 p[FS_JET_SIZE], q[FS_JET_SIZE];
  fs_surface_evaluate(a, i, 0.5, 0.5, p);
  fs_surface_evaluate(b, j, 0.5, 0.5, q);
  return hypot(hypot(p->x - q->x, p->y - q->y), p->z - q->z);
}

static void test_other_numbering(void **state) {
  fs_context ctx = test_context();
  uint64_t seed = 3;
  fs_mesh *mesh = make_mesh();
  fs_space *space = make_space(&ctx, mesh, &FULL);
  fs_vec3 *c = random_dofs(space, everywhere);
  int32_t *new_vertex = calloc((size_t)mesh->n_vertices, sizeof *new_vertex), n_turned = 0;
  int32_t *new_face = calloc((size_t)mesh->n_faces, sizeof *new_face);
  fs_cap_notes *notes = NULL, *again = NULL;
  (void)state;
  shuffle(mesh->n_vertices, new_vertex, &seed);
  shuffle(mesh->n_faces, new_face, &seed);
  fs_mesh *other = renumbered(mesh, new_vertex, new_face, &seed);
  assert_int_equal(fs_space_keep_caps(&ctx, mesh, space, c, &notes), FS_OK);
  for (int32_t i = 0; i < notes->n_caps; i++) {
    notes->cap[i].vertex = new_vertex[notes->cap[i].vertex];
    notes->cap[i].spoke = new_vertex[notes->cap[i].spoke];
  }
  fs_space *turned = make_space(&ctx, other, &(fs_space_options){.caps = FS_CAPS_FULL, .kept = notes});
  for (int32_t i = 0; i < turned->n_caps; i++)
    n_turned += turned->cap[i].halfedge != other->outgoing[turned->cap[i].vertex];
  assert_true(n_turned > 0); /* or else the spokes were of no importance */
  fs_surface *a = make_surface(&ctx, space, c), *b = make_surface(&ctx, turned, turned->start);
  for (int32_t f = 0; f < mesh->n_faces; f++)
    assert_true(distance(a, patch_of_face(a, f), b, patch_of_face(b, new_face[f])) <= 1e-13);
  assert_int_equal(fs_space_keep_caps(&ctx, other, turned, turned->start, &again), FS_OK); /* the spokes are kept */
  assert_int_equal(again->n_caps, notes->n_caps);
  for (int32_t i = 0; i < notes->n_caps; i++)
    for (int32_t j = 0; j < notes->n_caps; j++)
      if (again->cap[j].vertex == notes->cap[i].vertex) assert_int_equal(again->cap[j].spoke, notes->cap[i].spoke);
  fs_cap_notes_free(&ctx, notes);
  fs_cap_notes_free(&ctx, again);
  fs_surface_free(&ctx, a);
  fs_surface_free(&ctx, b);
  fs_space_free(&ctx, space);
  fs_space_free(&ctx, turned);
  fs_mesh_free(&ctx, mesh);
  fs_mesh_free(&ctx, other);
  free(c), free(new_vertex), free(new_face);
  fs_context_clear(&ctx);
}

/* ---- what does not fit ---- */

static void refuse(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes, const char *part) {
  fs_space *space = NULL;
  assert_int_equal(fs_space_check_caps(ctx, mesh, notes), FS_ERR_FORMAT);
  if (strstr(ctx->message, part) == NULL) fail_msg("\"%s\" does not say \"%s\"", ctx->message, part);
  assert_int_equal(fs_space_create_with(ctx, mesh, &(fs_space_options){.caps = FS_CAPS_FULL, .kept = notes}, &space),
                   FS_ERR_FORMAT);
  assert_null(space);
}

static void test_refusals(void **state) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory), other = test_context();
  fs_mesh *mesh = make_mesh();
  fs_space *space = make_space(&ctx, mesh, &FULL);
  fs_vec3 *c = random_dofs(space, everywhere);
  fs_cap_notes *notes = NULL;
  (void)state;
  assert_int_equal(fs_space_keep_caps(&ctx, mesh, space, c, &notes), FS_OK);
  fs_cap_note *cap = &notes->cap[3], kept = *cap;
  int32_t regular = 0, far = 0;
  while (fs_mesh_valence(mesh, regular) != 4) regular++;
  while (far == kept.spoke || far == kept.vertex || fs_mesh_valence(mesh, far) == 3) far++;
  notes->basis = 2, refuse(&ctx, mesh, notes, "version 2"), notes->basis = FS_CAP_BASIS;
  cap->vertex = mesh->n_vertices, refuse(&ctx, mesh, notes, "but the mesh has the vertices 0 to"), *cap = kept;
  cap->vertex = -1, refuse(&ctx, mesh, notes, "vertex -1"), *cap = kept;
  cap->vertex = regular, refuse(&ctx, mesh, notes, "carries no cap"), *cap = kept;
  cap->valence = 9, refuse(&ctx, mesh, notes, "are for valence 9, but it has"), *cap = kept;
  cap->spoke = cap->vertex, refuse(&ctx, mesh, notes, "to which no edge leads"), *cap = kept;
  cap->spoke = -5, refuse(&ctx, mesh, notes, "to which no edge leads"), *cap = kept;
  cap->spoke = INT32_MAX, refuse(&ctx, mesh, notes, "to which no edge leads"), *cap = kept;
  cap->n--, refuse(&ctx, mesh, notes, "needs"), *cap = kept;
  cap->n = INT32_MAX, refuse(&ctx, mesh, notes, "needs"), *cap = kept;
  cap->first = notes->n_coefficients - kept.n + 1, refuse(&ctx, mesh, notes, "not among"), *cap = kept;
  cap->first = -1, refuse(&ctx, mesh, notes, "not among"), *cap = kept;
  *cap = notes->cap[2], refuse(&ctx, mesh, notes, "twice"), *cap = kept;
  notes->coefficient[kept.first + 5].y = (double)NAN,
                                  refuse(&ctx, mesh, notes, "inner coefficient 5 of the cap at vertex");
  notes->coefficient[kept.first + 5].y = (double)INFINITY, refuse(&ctx, mesh, notes, "not finite");
  fs_cap_notes_free(&ctx, notes);
  notes = NULL;
  assert_int_equal(fs_cap_notes_create(&ctx, -1, 3, &notes), FS_ERR_ARGUMENT);
  assert_null(notes);
  free(c);
  fs_space_free(&ctx, space);
  fs_context_clear(&ctx);
  assert_int_equal(memory.n_live, 0);
  fs_mesh_free(&other, mesh);
}

/* ---- fixed vertices ---- */

/* The coefficients of a cap stay if and only if all its vertices do. */
static void test_fixed(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = make_mesh();
  fs_space *space = make_space(&ctx, mesh, &FULL);
  bool *fixed = calloc((size_t)space->n_dofs, sizeof *fixed);
  const fs_cap *cap = &space->cap[5];
  (void)state;
  for (int32_t i = 0; i < space->n_elements; i++) { /* all vertices of one cap, from its elements */
    const fs_element *e = &space->element[i];
    const fs_extraction *x = &space->extraction[e->extraction];
    const int32_t *dof = space->dof + e->dof_start;
    if (x->n_offsets > 0 && dof[0] == cap->vertex)
      for (int32_t d = 0; d < x->n_dofs - x->n_offsets; d++) fixed[dof[d]] = true;
  }
  fs_space_fix_caps(space, fixed);
  for (int32_t i = 0; i < space->n_caps; i++)
    for (int32_t d = 0; d < space->cap[i].n_dofs; d++)
      assert_int_equal(fixed[space->cap[i].first_dof + d], &space->cap[i] == cap);
  memset(fixed + space->n_vertices, 0, (size_t)(space->n_dofs - space->n_vertices));
  fixed[fs_mesh_target(mesh, cap->halfedge)] = false;
  fs_space_fix_caps(space, fixed);
  for (int32_t d = space->n_vertices; d < space->n_dofs; d++) assert_false(fixed[d]);
  free(fixed);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
}

/* ---- memory ---- */

static void test_memory_failures(void **state) {
  fs_context other = test_context();
  fs_mesh *mesh = test_star(3, 3);
  fs_space *space = make_space(&other, mesh, &FULL);
  fs_vec3 *c = random_dofs(space, everywhere);
  (void)state;
  for (int64_t fail_at = 1;; fail_at++) {
    struct test_memory memory = {.fail_at = fail_at};
    fs_context ctx = test_memory_context(&memory);
    fs_cap_notes *notes = NULL;
    fs_status status = fs_space_keep_caps(&ctx, mesh, space, c, &notes);
    if (status == FS_OK) status = fs_space_check_caps(&ctx, mesh, notes);
    bool has_failed = memory.n_allocations >= fail_at;
    assert_int_equal(status, has_failed ? FS_ERR_MEMORY : FS_OK);
    fs_cap_notes_free(&ctx, notes);
    assert_int_equal(memory.n_live, 0);
    if (!has_failed) break;
  }
  free(c);
  fs_space_free(&other, space);
  fs_mesh_free(&other, mesh);
  fs_context_clear(&other);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_round_trip), cmocka_unit_test(test_kinds), cmocka_unit_test(test_other_numbering),
      cmocka_unit_test(test_refusals),   cmocka_unit_test(test_fixed), cmocka_unit_test(test_memory_failures),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
