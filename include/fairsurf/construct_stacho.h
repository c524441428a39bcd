/* SPDX-License-Identifier: MIT */
/* Stacho's surfaces over triangulations: C1 graphs from heights and gradients, G1 surfaces from points and normals. */
#ifndef FAIRSURF_CONSTRUCT_STACHO_H
#define FAIRSURF_CONSTRUCT_STACHO_H

#include <fairsurf/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How a triangle interpolates what its corners prescribe. */
typedef enum fs_stacho_variant {
  FS_STACHO_SECOND_ORDER, /* degree 7: value, gradient, second derivatives; reproduces quadratic polynomials */
  FS_STACHO_FIRST_ORDER,  /* degree 6: value, gradient; reproduces affine functions; flat at the vertices */
  FS_STACHO_QUINTIC       /* degree 5: value, gradient; reproduces constants; flat at the vertices */
} fs_stacho_variant;

/* Shape functions of one's own, for graphs:
     F = sum_i psi_0(l_i) f_i + psi_1(l_i) A_i (x - x_i)
       + sum_k alpha_k (chi_0(l_i, l_j, l_k) f_i + chi_1(l_i, l_j, l_k) A_i (x_j - x_i))
             + (1 - alpha_k) (chi_0(l_j, l_i, l_k) f_j + chi_1(l_j, l_i, l_k) A_j (x_i - x_j)),   i = k + 1, j = k + 2.
   The graph is C1 and interpolates if
     psi(0) = psi'(0) = 0, psi(1) = 1, psi_0'(1) = 0;
     chi vanishes on the three edges, and with its first derivatives on those where its first or second argument is 0;
     d chi_0 / d l_k (t, 1 - t, 0) = psi_0'(t),  d chi_1 / d l_k (t, 1 - t, 0) = (1 - t) psi_1'(t).
   psi: Bernstein coefficients [degree + 1]. chi: those over the triangle of its three arguments with exponents
   (e1, e2, e3), in rows of equal e3, e2 fastest, [(degree + 1) (degree + 2) / 2]. */
typedef struct fs_stacho_shape {
  int32_t psi_degree[2], chi_degree[2]; /* at most 14 */
  const double *psi[2], *chi[2];
} fs_stacho_shape;

/* FS_ERR_ARGUMENT names the first of these conditions that fails, and by how much. */
FS_API fs_status fs_stacho_shape_check(fs_context *ctx, const fs_stacho_shape *shape);

/* Across an edge the derivative is prescribed in one direction, seen from both of its triangles. */
typedef enum fs_stacho_direction {
  FS_STACHO_PERPENDICULAR, /* to the edge: turning and scaling the plane commutes with the construction */
  FS_STACHO_OPPOSITE       /* from one opposite corner to the other: every affine map of the plane does */
} fs_stacho_direction;

typedef struct fs_stacho_graph_options {
  fs_stacho_variant variant;
  fs_stacho_direction direction;
  const fs_stacho_shape *shape; /* instead of the variant; or NULL */
} fs_stacho_graph_options;

/* The graph z(x, y) over a mesh of triangles that are anticlockwise in the (x, y) plane, whose heights are the z of the
   vertices: Bezier triangles, C1 across edges. gradient[n_vertices][2]: z_x, z_y; hessian[n_vertices][3]: z_xx, z_xy,
   z_yy, for FS_STACHO_SECOND_ORDER only; NULL: estimated as fs_graph_derivatives does.
   FS_ERR_ARGUMENT names the triangle that is not anticlockwise or no triangle. */
FS_API fs_status fs_stacho_graph(fs_context *ctx, const fs_mesh *mesh, const double *gradient, const double *hessian,
                                 const fs_stacho_graph_options *options, fs_surface **surface);

/* First and second derivatives of heights at the vertices, by least squares over a ring of neighbours or two: exact for
   quadratic heights wherever there are enough neighbours. Either may be NULL. */
FS_API fs_status fs_graph_derivatives(fs_context *ctx, const fs_mesh *mesh, double *gradient, double *hessian);

/* Length of the tangent at a vertex along the projection q of the edge d to its tangent plane. */
typedef enum fs_stacho_tangent {
  FS_STACHO_PROJECTION, /* |q|: flat meshes get their linear parameters */
  FS_STACHO_CHORD,      /* |d| */
  FS_STACHO_ARC         /* 2 |d| / (1 + |q| / |d|) */
} fs_stacho_tangent;

typedef struct fs_stacho_options {
  fs_stacho_variant variant;
  fs_stacho_tangent tangent;
  bool is_fixed_direction; /* the corrections at an edge all point along the sum of its end normals, which makes them of
                              lower degree; else along the least correction */
} fs_stacho_options;

/* A G1 surface over a mesh of triangles: the pieces share their edge curves, and every piece has a rational correction at
   each inner edge that makes the tangent planes agree [docs/stacho.md]. normal[n_vertices]: unit normals to the outside;
   NULL: the sum of the normals of the triangles weighted by their angles. shape[n_vertices][6]: symmetric tensors of
   curvature xx, xy, xz, yy, yz, zz that vanish along the normal, for FS_STACHO_SECOND_ORDER only; NULL: estimated.
   FS_ERR_ARGUMENT names the edge that is parallel to a normal or has no length, FS_ERR_NUMERIC the one whose triangles do
   not lie on opposite sides. */
FS_API fs_status fs_stacho_surface(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, const double *shape,
                                   const fs_stacho_options *options, fs_surface **surface);

/* Tensors of curvature at the vertices, [n_vertices][6] as above: least squares over the curvatures of the circles that
   touch the tangent plane and pass through a neighbour; exact on spheres. */
FS_API fs_status fs_mesh_shape_tensors(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, double *shape);

#ifdef __cplusplus
}
#endif
#endif
