/* SPDX-License-Identifier: MIT */
/* Single role: tensors of curvature at the vertices of a mesh with normals.

   The circle that touches the tangent plane at p_i and passes through the neighbour p_j has curvature
     kappa_j = 2 n . d / |d|^2,  d = p_j - p_i,
   in the direction (x, y) of the projection of d, in an orthonormal basis e1, e2 of the tangent plane. The tensor
   [a b; b c] fits them, a x^2 + 2 b x y + c y^2 = kappa_j, in the sense of least squares: exact on spheres. With fewer than
   three directions, or where they decide too little, it is the mean curvature of the circles in all directions. */
#include "construct/stacho.h"
#include "math/vec3.h"
#include "mesh/mesh.h"

enum { MAX_RING = 64 }; /* further neighbours add nothing */
static const double largest_condition = 1e6;

/* Sums over the ring, by Gram-Schmidt on the three columns with the right side as a fourth. */
typedef struct fit {
  int32_t n;
  double column[4][MAX_RING];
} fit;

static double dot(int32_t n, const double *a, const double *b) {
  double sum = 0;
  for (int32_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

/* Solves the least squares problem; false where there are too few rows or they decide too little. */
static bool solve(fit *f, double x[3]) {
  double R[3][4] = {{0}}, inverse[3][3] = {{0}}, size = 0, inverse_size = 0;
  if (f->n < 3) return false;
  for (int j = 0; j < 3; j++) {
    double length = sqrt(dot(f->n, f->column[j], f->column[j]));
    if (!(length > 0)) return false;
    R[j][j] = length;
    for (int32_t i = 0; i < f->n; i++) f->column[j][i] /= length;
    for (int k = j + 1; k < 4; k++) {
      R[j][k] = dot(f->n, f->column[j], f->column[k]);
      for (int32_t i = 0; i < f->n; i++) f->column[k][i] -= R[j][k] * f->column[j][i];
    }
  }
  for (int j = 0; j < 3; j++) /* the inverse of R, to bound its condition number in the Frobenius norm */
    for (int i = j; i >= 0; i--) {
      double sum = i == j ? 1 : 0;
      for (int k = i + 1; k <= j; k++) sum -= R[i][k] * inverse[k][j];
      inverse[i][j] = sum / R[i][i];
      size += R[i][j] * R[i][j];
      inverse_size += inverse[i][j] * inverse[i][j];
    }
  if (!(sqrt(size * inverse_size) < largest_condition)) return false;
  for (int i = 2; i >= 0; i--) {
    x[i] = R[i][3];
    for (int k = i + 1; k < 3; k++) x[i] -= R[i][k] * x[k];
    x[i] /= R[i][i];
  }
  return true;
}

static void add_neighbour(fit *f, fs_vec3 d, fs_vec3 n, fs_vec3 e1, fs_vec3 e2) {
  double x = fs_vec3_dot(d, e1), y = fs_vec3_dot(d, e2), l = x * x + y * y;
  if (f->n == MAX_RING || !(l > 0)) return;
  f->column[0][f->n] = x * x / l;
  f->column[1][f->n] = 2 * x * y / l;
  f->column[2][f->n] = y * y / l;
  f->column[3][f->n++] = 2 * fs_vec3_dot(n, d) / fs_vec3_dot(d, d);
}

static void set_basis(fs_vec3 n, fs_vec3 *e1, fs_vec3 *e2) {
  double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
  fs_vec3 axis = {x <= y && x <= z, !(x <= y && x <= z) && y <= z, 0};
  axis.z = axis.x == 0 && axis.y == 0;
  *e1 = fs_vec3_cross(n, axis);
  *e1 = fs_vec3_scale(*e1, 1 / fs_vec3_length(*e1));
  *e2 = fs_vec3_cross(n, *e1);
}

static void set_tensor(const fs_mesh *mesh, int32_t v, fs_vec3 n, double tensor[6]) {
  fs_vec3 e1, e2, p = mesh->position[v];
  fit f = {.n = 0};
  double x[3], mean = 0;
  int32_t h = mesh->outgoing[v];
  set_basis(n, &e1, &e2);
  do {
    int32_t previous = fs_mesh_previous(mesh, h);
    add_neighbour(&f, fs_vec3_sub(mesh->position[fs_mesh_target(mesh, h)], p), n, e1, e2);
    h = mesh->twin[previous];
    if (h == FS_NONE) /* past the boundary: the last neighbour has no half-edge from here */
      add_neighbour(&f, fs_vec3_sub(mesh->position[mesh->origin[previous]], p), n, e1, e2);
  } while (h != FS_NONE && h != mesh->outgoing[v]);
  for (int32_t i = 0; i < f.n; i++) mean += f.column[3][i] / f.n;
  if (!solve(&f, x)) x[0] = x[2] = mean, x[1] = 0;
  const double a[3] = {e1.x, e1.y, e1.z}, b[3] = {e2.x, e2.y, e2.z};
  for (int i = 0, k = 0; i < 3; i++)
    for (int j = i; j < 3; j++, k++)
      tensor[k] = x[0] * a[i] * a[j] + x[1] * (a[i] * b[j] + b[i] * a[j]) + x[2] * b[i] * b[j];
}

fs_status fs_mesh_shape_tensors(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, double *shape) {
  for (int32_t v = 0; v < mesh->n_vertices; v++)
    if (!(fabs(fs_vec3_length(normal[v]) - 1) <= 1e-9))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "the normal of vertex %d has length %g instead of 1", (int)v,
                     fs_vec3_length(normal[v]));
  for (int32_t v = 0; v < mesh->n_vertices; v++) set_tensor(mesh, v, normal[v], shape + 6 * (size_t)v);
  return FS_OK;
}
