/* SPDX-License-Identifier: MIT */
/* Surfaces of Gregory patches: what they interpolate, how they meet, what they reproduce, what is refused; and that the
   formulas of the literature as printed fail the same checks. */
#include <fairsurf/analyse.h>
#include "construct/gregory.h"
#include "math/vec3.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

enum { N_RULES = 3 };

static void near(double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g (difference %.3g)", a, b, a - b);
}

static fs_vec3 unit(fs_vec3 a) { return fs_vec3_scale(a, 1 / fs_vec3_length(a)); }

/* ---- meshes ---- */

static fs_mesh *icosahedron(void) {
  static const int32_t corner[60] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                     4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                     6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  const double g = (1 + sqrt(5)) / 2, s = 1 / sqrt(1 + g * g);
  const fs_vec3 at[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                          {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  int32_t start[21];
  fs_vec3 position[12];
  for (int v = 0; v < 12; v++) position[v] = fs_vec3_scale(at[v], s);
  for (int f = 0; f <= 20; f++) start[f] = 3 * f;
  return test_mesh(12, position, 20, start, corner);
}

/* The dual of a closed mesh, its vertices on the unit sphere: a dodecahedron from the icosahedron. */
static fs_mesh *dual(const fs_mesh *mesh) {
  fs_vec3 *position = calloc((size_t)mesh->n_faces, sizeof *position);
  int32_t *start = calloc((size_t)mesh->n_vertices + 1, sizeof *start), n = 0;
  int32_t *corner = calloc((size_t)mesh->n_halfedges, sizeof *corner);
  fs_mesh *made;
  for (int32_t h = 0; h < mesh->n_halfedges; h++)
    position[mesh->face[h]] = fs_vec3_add(position[mesh->face[h]], mesh->position[mesh->origin[h]]);
  for (int32_t f = 0; f < mesh->n_faces; f++) position[f] = unit(position[f]);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    int32_t h = mesh->outgoing[v], first = h;
    do corner[n++] = mesh->face[h];
    while ((h = fs_mesh_rotate(mesh, h)) != first);
    start[v + 1] = n;
  }
  made = test_mesh(mesh->n_faces, position, mesh->n_vertices, start, corner);
  free(position);
  free(start);
  free(corner);
  return made;
}

/* A cube with a pyramid of triangles on one side and a pentagonal prism's triangles and quads come with test_prism. */
static fs_mesh *mixed(void) {
  static const int32_t corner[] = {0, 2, 3, 1, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2,
                                   1, 3, 7, 5, 4, 5, 8, 5, 7, 8, 7, 6, 8, 6, 4, 8};
  static const int32_t start[] = {0, 4, 8, 12, 16, 20, 23, 26, 29, 32};
  fs_vec3 position[9] = {[8] = {0.1, -0.2, 2.1}};
  for (int v = 0; v < 8; v++) position[v] = (fs_vec3){v & 1 ? 1 : -1, v & 2 ? 1 : -1, v & 4 ? 1 : -1};
  return test_mesh(9, position, 9, start, corner);
}

static fs_mesh *on_sphere(fs_mesh *mesh) {
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->position[v] = unit(mesh->position[v]);
  return mesh;
}

/* ---- properties of one surface ---- */

/* One tangent plane along all sides; vertices and normals interpolated. */
static void check_surface(const fs_mesh *mesh, const fs_vec3 *normal, fs_edge_rule rule) {
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  fs_contact contact;
  fs_vec3 x[FS_JET_SIZE], *own = calloc((size_t)mesh->n_vertices, sizeof *own);
  if (fs_gregory_create(&ctx, mesh, normal, rule, &s) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(fs_surface_validate(&ctx, s), FS_OK);
  assert_int_equal(fs_surface_contact(&ctx, s, 12, &contact), FS_OK);
  near(contact.position, 0, 1e-12);
  near(contact.normal, 0, 1e-10);
  if (normal == NULL) assert_int_equal(fs_vertex_normals(&ctx, mesh, own), FS_OK);
  for (int32_t p = 0; p < s->n_patches; p++) {
    const fs_patch *patch = &s->patch[p];
    if (fs_mesh_face_size(mesh, patch->face) != patch->n_sides) continue; /* split */
    for (int32_t c = 0; c < patch->n_sides; c++) {
      int32_t vertex = mesh->origin[mesh->face_start[patch->face] + c];
      double u, v;
      fs_side_parameters(patch->n_sides, c, 0, &u, &v);
      fs_surface_evaluate(s, p, u, v, x);
      near(fs_vec3_distance(x[FS_D], mesh->position[vertex]), 0, 1e-12);
      near(fs_vec3_angle(fs_vec3_cross(x[FS_DU], x[FS_DV]), normal != NULL ? normal[vertex] : own[vertex]), 0, 1e-11);
    }
  }
  fs_surface_free(&ctx, s);
  free(own);
}

static void check_mesh(fs_mesh *mesh, bool is_disturbed) {
  uint64_t seed = 11;
  fs_context ctx = test_context();
  fs_vec3 *normal = calloc((size_t)mesh->n_vertices, sizeof *normal);
  for (int rule = 0; rule < N_RULES; rule++) check_surface(mesh, NULL, (fs_edge_rule)rule);
  assert_int_equal(fs_vertex_normals(&ctx, mesh, normal), FS_OK);
  for (int32_t v = 0; v < mesh->n_vertices; v++)
    normal[v] = unit((fs_vec3){normal[v].x + test_random_real(&seed, -0.1, 0.1), normal[v].y,
                               normal[v].z + test_random_real(&seed, -0.1, 0.1)});
  if (is_disturbed) test_mesh_disturb(mesh, 0.08, &seed);
  for (int rule = 0; rule < N_RULES; rule++) check_surface(mesh, normal, (fs_edge_rule)rule);
  free(normal);
  fs_mesh_free(&ctx, mesh);
}

static void test_contact(void **state) {
  fs_mesh *ico = icosahedron();
  (void)state;
  check_mesh(test_cube(), true);
  check_mesh(test_prism(3), true);
  check_mesh(test_prism(5), true); /* pentagons */
  check_mesh(mixed(), true);
  check_mesh(dual(ico), true);
  check_mesh(ico, true);
  check_mesh(test_torus(7, 5, 3, 1), true);
  check_mesh(test_star(5, 2), true); /* with a boundary */
}

/* The tangents of the rule wm are not along the edge, and make one of the sharp corners of the rook reflex. */
static void test_shared_meshes(void **state) {
  static const char *const name[] = {"pmp_chamfer-cube", "catmark_rook"};
  (void)state;
  for (int k = 0; k < 2; k++) {
    fs_mesh *mesh = test_shared_mesh(name[k]);
    if (mesh == NULL) skip();
    for (int rule = 0; rule < (k == 0 ? N_RULES : FS_EDGE_WM); rule++) check_surface(mesh, NULL, (fs_edge_rule)rule);
    fs_mesh_free(&(fs_context){0}, mesh);
  }
}

/* ---- what is reproduced ---- */

/* Largest and smallest distance from the origin at a grid of points. */
static void radius_range(const fs_mesh *mesh, fs_edge_rule rule, double *least, double *most) {
  enum { N = 20 };
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  fs_vec3 x[FS_JET_SIZE];
  assert_int_equal(fs_gregory_create(&ctx, mesh, mesh->position, rule, &s), FS_OK);
  *least = INFINITY, *most = 0;
  for (int32_t p = 0; p < s->n_patches; p++)
    for (int k = 0; k < (N + 1) * (N + 1); k++) {
      double u = k % (N + 1) / (double)N, v = k / (N + 1) / (double)N;
      if (!fs_domain_holds(s->patch[p].n_sides, u, v)) continue;
      fs_surface_evaluate(s, p, u, v, x);
      *least = fmin(*least, fs_vec3_length(x[FS_D]));
      *most = fmax(*most, fs_vec3_length(x[FS_D]));
    }
  fs_surface_free(&ctx, s);
}

/* Radii of the published comparison of the rules; the middles of pentagons lie on the sphere. */
static void test_sphere(void **state) {
  static const double triangles[N_RULES][2] = {{.9965, 1.00003}, {.9536, 1}, {.9894, 1}};
  static const double quads[N_RULES][2] = {{.9017, 1.0001}, {.8179, 1}, {.8866, 1}};
  fs_mesh *ico = icosahedron(), *cube = on_sphere(test_cube()), *dodecahedron = dual(ico);
  fs_context ctx = test_context();
  double least, most;
  (void)state;
  for (int rule = 0; rule < N_RULES; rule++) {
    radius_range(ico, (fs_edge_rule)rule, &least, &most);
    near(least, triangles[rule][0], 5e-4), near(most, triangles[rule][1], 1e-5);
    radius_range(cube, (fs_edge_rule)rule, &least, &most);
    near(least, quads[rule][0], 1e-4), near(most, quads[rule][1], 1e-4);
  }
  radius_range(dodecahedron, FS_EDGE_ARC, &least, &most);
  assert_true(least > 0.99 && most < 1.001);
  fs_mesh_free(&ctx, ico);
  fs_mesh_free(&ctx, cube);
  fs_mesh_free(&ctx, dodecahedron);
}

/* On flat faces arc and pn give the bilinear and the linear map. */
static void test_plane(void **state) {
  static const int32_t start[3] = {0, 4, 7}, corner[7] = {0, 1, 2, 3, 1, 4, 2};
  static const fs_vec3 at[5] = {{0, 0, 0}, {2, .2, 0}, {2.3, 1.7, 0}, {-.2, 1.5, 0}, {4, 1, 0}};
  (void)state;
  for (int rule = 0; rule < 2; rule++) {
    fs_mesh *mesh = test_mesh(5, at, 2, start, corner);
    fs_context ctx = test_context();
    fs_surface *s = NULL;
    fs_vec3 x[FS_JET_SIZE];
    assert_int_equal(fs_gregory_create(&ctx, mesh, NULL, (fs_edge_rule)rule, &s), FS_OK);
    for (int k = 0; k < 81; k++) {
      double u = k % 9 / 8.0, v = k / 9 / 8.0;
      fs_vec3 bilinear = fs_vec3_scale(at[0], (1 - u) * (1 - v));
      bilinear = fs_vec3_add_scaled(bilinear, at[1], u * (1 - v));
      bilinear = fs_vec3_add_scaled(fs_vec3_add_scaled(bilinear, at[2], u * v), at[3], (1 - u) * v);
      fs_surface_evaluate(s, 0, u, v, x);
      near(fs_vec3_distance(x[FS_D], bilinear), 0, 1e-14);
      if (u + v > 1) continue;
      fs_vec3 linear = fs_vec3_add_scaled(fs_vec3_add_scaled(fs_vec3_scale(at[1], 1 - u - v), at[4], u), at[2], v);
      fs_surface_evaluate(s, 1, u, v, x);
      near(fs_vec3_distance(x[FS_D], linear), 0, 1e-14);
    }
    fs_surface_free(&ctx, s);
    fs_mesh_free(&ctx, mesh);
  }
}

/* p -> 1.7 R p + t with a rotation R. */
static fs_vec3 move(fs_vec3 p, double scale, double shift) {
  const double c = cos(0.7), s = sin(0.7);
  fs_vec3 a = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  fs_vec3 b = {a.x, c * a.y - s * a.z, s * a.y + c * a.z};
  return (fs_vec3){scale * b.x + shift, scale * b.y - 2 * shift, scale * b.z + 3 * shift};
}

static void test_similarity(void **state) {
  fs_mesh *mesh = mixed(), *moved = mixed();
  fs_vec3 normal[9], turned[9], x[FS_JET_SIZE], y[FS_JET_SIZE];
  fs_context ctx = test_context();
  (void)state;
  assert_int_equal(fs_vertex_normals(&ctx, mesh, normal), FS_OK);
  for (int v = 0; v < 9; v++) moved->position[v] = move(mesh->position[v], 1.7, 0.3), turned[v] = move(normal[v], 1, 0);
  for (int rule = 0; rule < N_RULES; rule++) {
    fs_surface *s = NULL, *t = NULL;
    assert_int_equal(fs_gregory_create(&ctx, mesh, normal, (fs_edge_rule)rule, &s), FS_OK);
    assert_int_equal(fs_gregory_create(&ctx, moved, rule == 0 ? NULL : turned, (fs_edge_rule)rule, &t), FS_OK);
    for (int32_t p = 0; p < s->n_patches; p++) {
      fs_surface_evaluate(s, p, 0.3, 0.4, x);
      fs_surface_evaluate(t, p, 0.3, 0.4, y);
      near(fs_vec3_distance(move(x[FS_D], 1.7, 0.3), y[FS_D]), 0, 1e-14 * 10);
    }
    fs_surface_free(&ctx, s);
    fs_surface_free(&ctx, t);
  }
  fs_mesh_free(&ctx, mesh);
  fs_mesh_free(&ctx, moved);
}

/* The same bits for any number of threads. */
static void test_threads(void **state) {
  fs_mesh *mesh = test_torus(40, 30, 3, 1);
  fs_context one = test_context(), four = test_context();
  fs_surface *s = NULL, *t = NULL;
  (void)state;
  four.n_threads = 4;
  assert_int_equal(fs_gregory_create(&one, mesh, NULL, FS_EDGE_ARC, &s), FS_OK);
  assert_int_equal(fs_gregory_create(&four, mesh, NULL, FS_EDGE_ARC, &t), FS_OK);
  assert_int_equal(s->n_data, t->n_data);
  assert_memory_equal(s->data, t->data, s->n_data * sizeof *s->data);
  fs_surface_free(&one, s);
  fs_surface_free(&four, t);
  fs_mesh_free(&one, mesh);
}

/* ---- guards: formulas as printed fail ---- */

/* Largest |det(c', b, D)| along side 0 of a triangle, for the end vector with or without the last difference. */
static double field_error(bool is_printed) {
  const fs_vec3 P[3] = {{0, 0, 0}, {2, .1, .2}, {2.2, 1.9, .6}};
  const fs_vec3 N[3] = {unit((fs_vec3){-.3, -.2, 1}), unit((fs_vec3){.3, -.25, 1}), unit((fs_vec3){.2, .4, 1})};
  fs_vec3 edge[3][4];
  fs_gregory_field field;
  double largest = 0;
  for (int e = 0; e < 3; e++)
    assert_int_equal(fs_gregory_edge(P[e], P[(e + 1) % 3], N[e], N[(e + 1) % 3], FS_EDGE_ARC, edge[e]), 0);
  const fs_vec3 c[3] = {fs_vec3_sub(edge[0][1], edge[0][0]), fs_vec3_sub(edge[0][2], edge[0][1]),
                        fs_vec3_sub(edge[0][3], edge[0][2])};
  fs_vec3 first = fs_vec3_sub(edge[2][2], edge[2][3]), last = fs_vec3_sub(edge[1][1], edge[1][0]);
  fs_vec3 end = is_printed ? last : fs_vec3_add(last, c[2]);
  assert_int_equal(fs_gregory_cross(edge[0], N[0], N[1], first, end, &field), FS_GREGORY_FINE);
  /* the patch has the true end derivative, which needs the difference */
  const fs_vec3 D[4] = {first, field.inner[0], field.inner[1], fs_vec3_add(last, c[2])};
  fs_vec3 b0 = unit(fs_vec3_cross(N[0], c[0])), b3 = unit(fs_vec3_cross(N[1], c[2]));
  for (int k = 0; k <= 10; k++) {
    double t = k / 10.0, s = 1 - t;
    fs_vec3 along = fs_vec3_scale(c[0], 3 * s * s), across = fs_vec3_scale(D[0], 4 * s * s * s);
    along = fs_vec3_add_scaled(fs_vec3_add_scaled(along, c[1], 6 * s * t), c[2], 3 * t * t);
    across = fs_vec3_add_scaled(fs_vec3_add_scaled(across, D[1], 12 * s * s * t), D[2], 12 * s * t * t);
    across = fs_vec3_add_scaled(across, D[3], 4 * t * t * t);
    fs_vec3 b = fs_vec3_add_scaled(fs_vec3_scale(b0, s), b3, t);
    largest = fmax(largest, fabs(fs_vec3_dot(fs_vec3_cross(along, b), across)));
  }
  return largest;
}

static void test_printed_end_vector(void **state) {
  (void)state;
  near(field_error(false), 0, 1e-12);
  assert_true(field_error(true) > 0.1);
}

/* The blend of the inner point near the second corner as printed has (1 - u) v where (1 - u) w must stand: on the side
   u = 0 only the point of that side may act, and does not. */
static void test_printed_weights(void **state) {
  const double u = 0, v = 0.3, w = 0.7;
  double corrected = ((1 - w) * u + (1 - u) * w) / ((1 - w) * u + (1 - u) * w);
  double printed = ((1 - w) * u + (1 - u) * v) / ((1 - w) * u + (1 - u) * w);
  (void)state;
  near(corrected, 1, 0);
  assert_true(fabs(printed - 1) > 0.1);
}

/* ---- refusals ---- */

static void refuse(const fs_vec3 *position, const fs_vec3 *normal, const char *part) {
  static const int32_t start[3] = {0, 4, 8}, corner[8] = {0, 1, 2, 3, 1, 4, 5, 2};
  fs_mesh *mesh = test_mesh(6, position, 2, start, corner);
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  assert_int_equal(fs_gregory_create(&ctx, mesh, normal, FS_EDGE_ARC, &s), FS_ERR_NUMERIC);
  assert_null(s);
  if (strstr(ctx.message, part) == NULL) fail_msg("\"%s\" does not hold \"%s\"", ctx.message, part);
  fs_mesh_free(&ctx, mesh);
}

static void test_refusals(void **state) {
  const fs_vec3 flat[6] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  const fs_vec3 up[6] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  fs_vec3 position[6], normal[6];
  (void)state;
  memcpy(position, flat, sizeof flat), memcpy(normal, up, sizeof up);
  position[5] = (fs_vec3){1.2, 0.3, 0};
  refuse(position, up, "face 1: the corner at vertex 5 is reflex or has no angle");
  position[5] = position[4];
  refuse(position, up, "face 1: the edge from vertex 4 to vertex 5 has no length");
  normal[3] = (fs_vec3){0, 1, 0};
  refuse(flat, normal, "face 0: the edge from vertex 3 to vertex 0 runs along the normal");
  normal[3] = (fs_vec3){0, 0, -1};
  refuse(flat, normal, "face 0: the corner at vertex 3 is reflex");
  normal[3] = (fs_vec3){0, 0, 2};
  refuse(flat, normal, "the normal of vertex 3 has length 2, not 1");
  normal[3] = (fs_vec3){0, 0, NAN};
  refuse(flat, normal, "the normal of vertex 3");
  for (int v = 0; v < 6; v++) position[v] = (fs_vec3){v, 0, 0};
  refuse(position, NULL, "the faces around vertex 0 give no normal");
}

static void test_turning_over(void **state) {
  const fs_vec3 edge[4] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const fs_vec3 up = {0, 0, 1}, down = {0, 0, -1};
  fs_gregory_field field;
  (void)state;
  assert_int_equal(fs_gregory_cross(edge, up, down, (fs_vec3){0, 1, 0}, (fs_vec3){0, -1, 0}, &field),
                   FS_GREGORY_TURNS_OVER);
}

static void test_table(void **state) {
  fs_mesh *mesh = test_cube();
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  fs_construction_input input = {0};
  (void)state;
  assert_null(fs_construction_find("none"));
  for (int k = 0; fs_constructions[k] != NULL; k++) {
    assert_ptr_equal(fs_construction_find(fs_constructions[k]->name), fs_constructions[k]);
    assert_int_equal(fs_construct(&ctx, fs_constructions[k], &input, NULL, &s), FS_ERR_ARGUMENT);
  }
  input.mesh = mesh;
  assert_int_equal(fs_construct(&ctx, fs_construction_find("gregory"), &input, NULL, &s), FS_OK);
  assert_int_equal(s->n_patches, 6);
  fs_surface_free(&ctx, s);
  assert_int_equal(fs_gregory_create(&ctx, mesh, NULL, (fs_edge_rule)7, &s), FS_ERR_ARGUMENT);
  fs_mesh_free(&ctx, mesh);
}

/* Every allocation fails once. */
static void test_memory(void **state) {
  struct test_memory memory = {0};
  fs_status status = FS_ERR_MEMORY;
  fs_mesh *mesh = test_prism(5);
  (void)state;
  for (int64_t n = 1; status != FS_OK; n++) {
    fs_context ctx = test_memory_context(&memory);
    fs_surface *s = NULL, *bicubics = NULL;
    double deviation;
    memory.n_allocations = 0;
    memory.fail_at = n;
    status = fs_gregory_create(&ctx, mesh, NULL, FS_EDGE_ARC, &s);
    if (status == FS_OK) status = fs_surface_to_bicubics(&ctx, s, 1, 1, &bicubics, &deviation);
    assert_true(status == FS_OK || (status == FS_ERR_MEMORY && bicubics == NULL));
    fs_surface_free(&ctx, s);
    fs_surface_free(&ctx, bicubics);
    assert_int_equal(memory.n_live, 0);
  }
  fs_mesh_free(&(fs_context){0}, mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_contact),
      cmocka_unit_test(test_shared_meshes),
      cmocka_unit_test(test_sphere),
      cmocka_unit_test(test_plane),
      cmocka_unit_test(test_similarity),
      cmocka_unit_test(test_threads),
      cmocka_unit_test(test_printed_end_vector),
      cmocka_unit_test(test_printed_weights),
      cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_turning_over),
      cmocka_unit_test(test_table),
      cmocka_unit_test(test_memory),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
