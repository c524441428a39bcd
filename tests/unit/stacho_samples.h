/* SPDX-License-Identifier: MIT */
/* What the tests of Stacho's surfaces share: meshes, normals, gaps. */
#ifndef FS_TEST_STACHO_SAMPLES_H
#define FS_TEST_STACHO_SAMPLES_H

#include <fairsurf/construct_stacho.h>
#include "math/diffgeo.h"
#include "math/vec3.h"
#include "vectors.h"

static inline fs_mesh *icosahedron(void) {
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
static inline fs_mesh *triangulated(fs_mesh *mesh) {
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

static inline fs_vec3 *random_normals(const fs_mesh *mesh, double amount, uint64_t seed) {
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

static inline fs_surface *build(const fs_mesh *mesh, const fs_vec3 *normal, const double *shape,
                                fs_stacho_options options) {
  fs_context ctx = test_context();
  fs_surface *s = NULL;
  if (fs_stacho_surface(&ctx, mesh, normal, shape, &options, &s) != FS_OK) fail_msg("%s", ctx.message);
  assert_int_equal(fs_surface_validate(&ctx, s), FS_OK);
  return s;
}

static inline void side_point(const fs_surface *s, int32_t p, int32_t side, double t, fs_vec3 *x, fs_vec3 *normal) {
  double u, v;
  fs_side_parameters(3, side, t, &u, &v);
  fs_surface_evaluate(s, p, u, v, x);
  if (!fs_normal_compute(x, normal)) fail_msg("patch %d is singular at side %d, t = %g", (int)p, (int)side, t);
}

/* Largest gaps of positions and unit normals along the inner edges. */
static inline void measure_gaps(const fs_surface *s, double gap[2]) {
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

static inline void assert_smooth(const fs_surface *s, double size) {
  double gap[2];
  measure_gaps(s, gap);
  if (!(gap[0] <= 1e-12 * size) || !(gap[1] <= 1e-10)) fail_msg("gaps %.3g, %.3g", gap[0], gap[1]);
}

#endif
