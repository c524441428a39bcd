/* SPDX-License-Identifier: MIT */
/* Surfaces made directly, without fairing: patches from curves, normals and given patches [docs/patches.md]. */
#ifndef FAIRSURF_CONSTRUCT_H
#define FAIRSURF_CONSTRUCT_H

#include <fairsurf/mesh.h>
#include <fairsurf/surface.h>
#include <fairsurf/surface_splines.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the table ------------------------------------------------------------------------------------------------------ */

/* What a construction starts from; a part that it does not use may be NULL. */
typedef struct fs_construction_input {
  const fs_mesh *mesh;
  const fs_vec3 *normal; /* [n_vertices] of the mesh, unit vectors to the outside; NULL: fs_vertex_normals */
  const fs_splines *splines;
} fs_construction_input;

typedef enum fs_construction_takes { FS_TAKES_MESH, FS_TAKES_SPLINES } fs_construction_takes;

/* A construction. Lines of a table. */
typedef struct fs_construction {
  const char *name, *summary;
  fs_construction_takes takes; /* the part of the input that must be there */
  const fs_param *params;
  fs_status (*build)(fs_context *ctx, const fs_construction_input *input, const double *param, fs_surface **surface);
} fs_construction;
FS_API extern const fs_construction *const fs_constructions[];        /* ends with NULL: gregory, stacho, … */
FS_API const fs_construction *fs_construction_find(const char *name); /* NULL: unknown */

/* Builds with param, or the initial values of the construction's params where param is NULL. */
FS_API fs_status fs_construct(fs_context *ctx, const fs_construction *construction, const fs_construction_input *input,
                              const double *param, fs_surface **surface);

/* ---- Gregory patches ------------------------------------------------------------------------------------------------ */

/* normal[n_vertices]: sums of the normals of the corners (next - v) x (previous - v), each as long as its angle, made unit
   vectors. Corners whose edges span no plane add nothing; FS_ERR_NUMERIC names a vertex where the sum is zero. */
FS_API fs_status fs_vertex_normals(fs_context *ctx, const fs_mesh *mesh, fs_vec3 *normal);

/* How long the tangents of the cubic over an edge are. With d the edge, p its projection on the tangent plane of an end: */
typedef enum fs_edge_rule {
  FS_EDGE_ARC, /* along p, as the cubic that stands for a circular arc has them: 2 |d| / (3 (1 + |p| / |d|)) */
  FS_EDGE_PN,  /* p / 3 [Vlachos Peters Boyd Mitchell 2001] */
  FS_EDGE_WM   /* [Walton Meek 1996] */
} fs_edge_rule;

/* Interpolates the vertices of a mesh and their normals by a surface with one tangent plane everywhere (G1): a Gregory quad
   or triangle for each face of 4 or 3 vertices, their sides cubics that depend on the edge and its two normals only. A face
   of more vertices is split into triangles around a new vertex, on the mean of the arcs that start at its corners; its
   patches follow each other. fs_patch.face is the face of the mesh. normal: [n_vertices], or NULL: fs_vertex_normals.
   FS_ERR_NUMERIC names an edge of no length, an edge along the normal of its end, a corner whose edges, seen along its
   normal, turn clockwise or by no angle (a reflex corner), an edge along which the tangent plane turns over, and a normal
   that is no unit vector. */
FS_API fs_status fs_gregory_create(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, fs_edge_rule rule,
                                   fs_surface **surface);

/* ---- Coons patches ------------------------------------------------------------------------------------------------- */

/* A curve over [0, 1]: x[0] is its position at t, x[1 .. 3] are its derivatives. */
typedef struct fs_curve {
  void (*evaluate)(const void *user, double t, fs_vec3 x[4]);
  const void *user;
} fs_curve;

/* The curve sum_i point[i] B_i(t). A fs_curve with fs_bezier_evaluate as evaluate has one of these as user. */
typedef struct fs_bezier_curve {
  int32_t degree; /* 0 .. FS_MAX_DEGREE */
  const fs_vec3 *point;
} fs_bezier_curve;
FS_API void fs_bezier_evaluate(const void *curve, double t, fs_vec3 x[4]);

/* What a Coons patch S interpolates. Data are numbered (side, order) = (0, 0), (1, 0), (0, 1), (1, 1), (0, 2), (1, 2):
   at_u[(i, k)] is the derivative of order k by u on the side u = i, a curve in v; at_v[(j, l)] the derivative of order l by v
   on the side v = j, a curve in u. All run with growing parameter. */
enum { FS_COONS_MOST = 6 };
typedef struct fs_coons_data {
  int32_t n_data; /* 2: the four sides; 4: and first derivatives across them; 6: and second ones */
  fs_curve at_u[FS_COONS_MOST], at_v[FS_COONS_MOST];
  /* For n_data = 2 the functions that weigh opposite sides, by their Bernstein coefficients [blend_degree + 1]:
     blend[i] is 1 at i and 0 at 1 - i, and their sum is 1. blend_degree 0: 1 - t and t. */
  int32_t blend_degree;
  const double *blend[2];
  bool is_gregory; /* for n_data = 4: mixed derivatives at corners may differ from side to side [Gregory 1974] */
} fs_coons_data;

/* Data that have been checked; plain, to be copied. The curves are borrowed. */
typedef struct fs_coons {
  fs_coons_data data;
  fs_vec3 corner[FS_COONS_MOST][FS_COONS_MOST]; /* the data of both numbers, at_u first, where these sides meet */
  fs_vec3 twist_gap[2][2]; /* at (u, v) = (i, j): mixed derivative by the side v = j less that by u = i */
} fs_coons;

/* Checks that the data agree where sides meet: positions within tolerance times the size of the sides, derivatives within
   tolerance times the largest of them. FS_ERR_NUMERIC names the sides, the corner, and what differs by how much;
   FS_ERR_ARGUMENT a number of data or a pair of blending functions that cannot be. */
FS_API fs_status fs_coons_prepare(fs_context *ctx, const fs_coons_data *data, double tolerance, fs_coons *coons);

/* Position and derivatives up to order 3: x[FS_JET_SIZE]. With is_gregory, at a corner itself: derivatives of order 2 are
   the limits along the diagonal, those of order 3 NaN. */
FS_API void fs_coons_evaluate(const fs_coons *coons, double u, double v, fs_vec3 *x);

/* A surface of one patch that is the same, where all curves are Bezier curves: tensor Bezier, or with is_gregory a
   Gregory quad. FS_ERR_UNSUPPORTED for other curves. */
FS_API fs_status fs_coons_to_bezier(fs_context *ctx, const fs_coons *coons, fs_surface **surface);

/* A surface of n x n bicubic patches for any curves, n = 2^m: as fs_surface_hermite_depth. */
FS_API fs_status fs_coons_to_bicubics(fs_context *ctx, const fs_coons *coons, double tolerance, int32_t max_m,
                                      fs_surface **surface, double *deviation);

/* twist[i][j]: mixed derivative at (u, v) = (i, j) of the bilinear patch of the four sides, the usual estimate where only
   the sides are known [Barnhill Brown Klucewicz 1978]. at_u[2], at_v[2]: sides, as above. */
FS_API void fs_adini_twists(const fs_curve *at_u, const fs_curve *at_v, fs_vec3 twist[2][2]);

/* First derivatives across the sides as cubics, from the ends of the sides and from twists: neighbours that share the data
   of their ends join C1. across_u[i]: four Bezier points of at_u[(i, 1)]; across_v[j]: those of at_v[(j, 1)]. */
FS_API void fs_coons_cross(const fs_curve *at_u, const fs_curve *at_v, const fs_vec3 twist[2][2],
                           fs_vec3 across_u[2][4], fs_vec3 across_v[2][4]);

/* The bilinear patch of four B-spline sides as one B-spline patch, exact: net[i + n_u j]. Opposite sides have the same
   degree and knots: at_v[j] has n_u points over knot_u[n_u + degree_u + 1], at_u[i] has n_v points over knot_v. Knots are
   clamped. FS_ERR_NUMERIC where sides do not meet within tolerance times their size; FS_ERR_ARGUMENT names a knot. */
FS_API fs_status fs_coons_spline_net(fs_context *ctx, int32_t degree_u, int32_t n_u, const double *knot_u,
                                     const fs_vec3 *const at_v[2], int32_t degree_v, int32_t n_v, const double *knot_v,
                                     const fs_vec3 *const at_u[2], double tolerance, fs_vec3 *net);

#ifdef __cplusplus
}
#endif
#endif
