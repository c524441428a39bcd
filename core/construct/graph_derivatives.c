/* SPDX-License-Identifier: MIT */
/* Single role: first and second derivatives of heights at the vertices of a triangulation.

   Around vertex x_0 the quadratic z_0 + A d + d^T H d / 2, d = x - x_0 in units of the mean distance, is fitted to the
   neighbours by least squares with weights 1 / |d|^2: those across an edge, and where these are fewer than six those across
   another edge too. Five or more in general position determine it, and quadratic heights are reproduced. Where they do not,
   an affine function is fitted and H = 0; where even that is undetermined A = 0. */
#include "construct/stacho.h"
#include "math/dense.h"
#include "mesh/mesh.h"

#include <math.h>
#include <string.h>

enum { ENOUGH = 6, MAX_NEIGHBOURS = 96, N_UNKNOWNS = 5 };

typedef struct ring {
  int32_t n, vertex[MAX_NEIGHBOURS];
} ring;

static void add(ring *r, int32_t centre, int32_t v) {
  if (v == centre || r->n == MAX_NEIGHBOURS) return;
  for (int32_t i = 0; i < r->n; i++)
    if (r->vertex[i] == v) return;
  r->vertex[r->n++] = v;
}

static void add_neighbours(const fs_mesh *mesh, int32_t centre, int32_t v, ring *r) {
  int32_t h = mesh->outgoing[v];
  do {
    int32_t previous = fs_mesh_previous(mesh, h);
    add(r, centre, fs_mesh_target(mesh, h));
    h = mesh->twin[previous];
    if (h == FS_NONE) add(r, centre, mesh->origin[previous]);
  } while (h != FS_NONE && h != mesh->outgoing[v]);
}

static void collect(const fs_mesh *mesh, int32_t v, ring *r) {
  int32_t first;
  r->n = 0;
  add_neighbours(mesh, v, v, r);
  first = r->n;
  for (int32_t i = 0; i < first && first < ENOUGH; i++) add_neighbours(mesh, v, r->vertex[i], r);
}

/* Least squares for the first n of the unknowns z_x, z_y, z_xx, z_xy, z_yy; false where they are not determined. */
static bool fit(const fs_mesh *mesh, int32_t v, const ring *r, double scale, int32_t n, double *x) {
  fs_context own = {0}; /* a failure is an answer here */
  double normal[N_UNKNOWNS * N_UNKNOWNS] = {0}, least = INFINITY, largest = 0;
  fs_vec3 p = mesh->position[v];
  if (r->n < n) return false;
  memset(x, 0, (size_t)n * sizeof *x);
  for (int32_t i = 0; i < r->n; i++) {
    fs_vec3 q = mesh->position[r->vertex[i]];
    double a = (q.x - p.x) / scale, b = (q.y - p.y) / scale, weight = 1 / (a * a + b * b);
    const double row[N_UNKNOWNS] = {a, b, a * a / 2, a * b, b * b / 2};
    for (int32_t j = 0; j < n; j++) {
      for (int32_t k = 0; k < n; k++) normal[j * n + k] += weight * row[j] * row[k];
      x[j] += weight * row[j] * (q.z - p.z);
    }
  }
  if (fs_dense_cholesky(&own, n, normal, n) != FS_OK) return false;
  for (int32_t j = 0; j < n; j++) least = fmin(least, normal[j * n + j]), largest = fmax(largest, normal[j * n + j]);
  if (!(least > 1e-5 * largest)) return false;
  fs_dense_solve_transposed(n, normal, n, 1, x, 1);
  fs_dense_solve_upper(n, normal, n, 1, x, 1);
  return true;
}

static double mean_distance(const fs_mesh *mesh, int32_t v, const ring *r) {
  double sum = 0;
  for (int32_t i = 0; i < r->n; i++)
    sum += hypot(mesh->position[r->vertex[i]].x - mesh->position[v].x,
                 mesh->position[r->vertex[i]].y - mesh->position[v].y);
  return sum / r->n;
}

fs_status fs_graph_derivatives(fs_context *ctx, const fs_mesh *mesh, double *gradient, double *hessian) {
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    double x[N_UNKNOWNS] = {0}, scale;
    ring r;
    collect(mesh, v, &r);
    scale = mean_distance(mesh, v, &r);
    for (int32_t i = 0; i < r.n; i++)
      if (mesh->position[r.vertex[i]].x == mesh->position[v].x && mesh->position[r.vertex[i]].y == mesh->position[v].y)
        return fs_fail(ctx, FS_ERR_ARGUMENT, "vertices %d and %d have the same x and y", (int)v, (int)r.vertex[i]);
    if (!fit(mesh, v, &r, scale, N_UNKNOWNS, x)) {
      memset(x, 0, sizeof x);
      if (!fit(mesh, v, &r, scale, 2, x)) memset(x, 0, sizeof x);
    }
    for (int i = 0; i < 2 && gradient != NULL; i++) gradient[2 * (size_t)v + (size_t)i] = x[i] / scale;
    for (int i = 0; i < 3 && hessian != NULL; i++) hessian[3 * (size_t)v + (size_t)i] = x[2 + i] / (scale * scale);
  }
  return FS_OK;
}
