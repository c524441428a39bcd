/* SPDX-License-Identifier: MIT */
/* Surfaces: patches with their neighbours, their derivatives, and triangles from them. */
#ifndef FAIRSURF_SURFACE_H
#define FAIRSURF_SURFACE_H

#include <fairsurf/space.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A line of fs_patch_kinds each. What lies at data_start are points, x, y, z each:

   tensor Bezier     point (i, j), i along u, is number i + (degree_u + 1) j
   Bezier triangle   of degree n = degree_u = degree_v: rows of n + 1, n, .. 1 points; the coefficient of
                     n! / (i! j! k!) (1 - u - v)^i u^j v^k is point j of row k
   Gregory quad      those of a tensor Bezier patch of degrees 3 or more; then four points q, one beside each of its points
                     p = (1, 1), (degree_u - 1, 1), (1, degree_v - 1), (degree_u - 1, degree_v - 1). The patch is that
                     tensor patch and, for each corner, 9 (1 - x)^2 (1 - y)^2 x^2 y / (x + y) (q - p), x and y the
                     distances of u and v from it: for degree (3, 3) p acts on the sides 1 and 3, q on 0 and 2
   Gregory triangle  15 points as of a Bezier triangle of degree 4, the inner one at corner c that for side c - 1; then
                     the inner points at corners 0, 1, 2 for the sides 0, 1, 2 */
typedef enum fs_patch_kind {
  FS_PATCH_TENSOR_BEZIER,
  FS_PATCH_BEZIER_TRIANGLE,
  FS_PATCH_GREGORY_QUAD,
  FS_PATCH_GREGORY_TRIANGLE,
  FS_PATCH_STACHO_TRIANGLE,
  FS_N_PATCH_KINDS
} fs_patch_kind;

enum { FS_MAX_DEGREE = 31 }; /* of a patch, in u and in v */

/* A patch of four sides lives on [0, 1]^2, sides and corners as in space.h. One of three sides lives on the triangle
   u, v >= 0, u + v <= 1, where (1 - u - v, u, v) are barycentric coordinates:

        (0,1)
          |  \             Side s runs anticlockwise from corner s to corner s + 1 (of corner 2 to corner 0):
        side 2  side 1       0: v = 0, u up    1: u + v = 1, v up    2: u = 0, v down
          |        \
        (0,0) - side 0 - (1,0)                                                                                       */
typedef struct fs_patch {
  int32_t kind;    /* fs_patch_kind; it says what lies at data_start */
  int32_t n_sides; /* 3 or 4 */
  int32_t degree_u, degree_v;
  size_t data_start;
  int32_t face;              /* control face it lies on, or FS_NONE */
  int32_t valence;           /* of the special vertex at corner 0 of a cap patch; 4 for regular patches */
  int32_t neighbour[4];      /* patch across each side, or FS_NONE; of three sides: the last is FS_NONE */
  uint8_t neighbour_side[4]; /* the side of the neighbour that meets ours; it runs the other way */
  uint8_t part; /* 0: all of its kind's domain. c + 1: the quadrilateral of corner c, the middle of side c, the
                                centre, the middle of side c - 1 of that domain, over which [0, 1]^2 is laid bilinearly in this
                                order; n_sides is 4 then */
} fs_patch;

typedef struct fs_surface {
  int32_t n_patches;
  size_t n_data;
  fs_patch *patch;
  double *data; /* [n_data] */
} fs_surface;

/* A kind of patch. Lines of a table, indexed by fs_patch_kind. */
typedef struct fs_patch_kind_info {
  const char *name, *summary;
  int32_t n_sides;      /* of its domain */
  int32_t corner_order; /* derivatives above this order have no single value at corners: those of order 2 are then the
                           limits along the line to the middle, and those of order 3 may be NaN */
  size_t (*n_numbers)(const fs_patch *patch); /* that it takes from data_start; 0: its degree is outside 1 .. 31 */
  /* Derivatives up to order 3 at (u, v) of the whole domain, whatever patch->part: x[FS_JET_SIZE]. */
  void (*jet)(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x);
} fs_patch_kind_info;
FS_API extern const fs_patch_kind_info fs_patch_kinds[FS_N_PATCH_KINDS];

/* The surface of a space with dofs c[n_dofs]: patch i is element i. */
FS_API fs_status fs_surface_create(fs_context *ctx, const fs_space *space, const fs_vec3 *c, fs_surface **surface);
FS_API void fs_surface_free(fs_context *ctx, fs_surface *surface); /* NULL is allowed */

/* Makes the surface of a space exactly symmetric: of two patches that are images of each other that of the larger number
   becomes the image of the other, and those that are images of themselves the mean of both. Then fs_surface_evaluate gives
   mirror images at image parameters, to the last bit for coordinate planes through the origin and parameters t whose 1 - t
   is exact. patch i must be element i, as fs_surface_create makes them. */
FS_API fs_status fs_surface_mirror(fs_context *ctx, const fs_symmetry *symmetry, fs_surface *surface);

/* Checks the invariants of a surface that a program made itself: known kinds and degrees, data within n_data and finite,
   neighbours that agree from both sides. Messages name the patch. */
FS_API fs_status fs_surface_validate(fs_context *ctx, const fs_surface *surface);

/* Position and derivatives up to order 3 of a patch at (u, v): x[FS_JET_SIZE]. */
FS_API void fs_surface_evaluate(const fs_surface *surface, int32_t patch, double u, double v, fs_vec3 *x);

/* The same at many points of one patch, several times faster for Bezier triangles and, to order 2, for bicubic tensor Bezier
   patches and Gregory quads of degree (3, 3); values agree to rounding, which depends on the processor. order: 0 .. 3.
   out[(3 k + c) n + i]: coordinate c of derivative k, 1, 3, 6 or FS_JET_SIZE of them, at point i. */
FS_API void fs_surface_evaluate_points(const fs_surface *surface, int32_t patch, int32_t order, size_t n,
                                       const double *u, const double *v, double *out);

/* Position, unit normal, mean and Gaussian curvature: out[8][n], the rows x, y, z, the normal's x, y, z, H, K. The last five
   are NaN where p_u x p_v = 0. */
FS_API void fs_surface_bend_points(const fs_surface *surface, int32_t patch, size_t n, const double *u, const double *v,
                                   double *out);

/* (u, v) of the point at parameter t in [0, 1] of a side of a patch of 3 or 4 sides, t running anticlockwise. */
FS_API void fs_side_parameters(int32_t n_sides, int32_t side, double t, double *u, double *v);

/* Whether (u, v) of [0, 1]^2 lies in the domain of a patch of 3 or 4 sides. */
static inline bool fs_domain_holds(int32_t n_sides, double u, double v) { return n_sides == 4 || u + v <= 1; }

/* Triangles, anticlockwise seen from outside, with exact unit normals; vertices on shared sides and corners are shared,
   so a closed surface gives a watertight mesh. */
typedef struct fs_triangles {
  int32_t n_vertices, n_triangles;
  fs_vec3 *position, *normal; /* [n_vertices] */
  int32_t *corner;            /* [3 n_triangles] */
  int32_t *patch;             /* [n_triangles] */
  int32_t *vertex_patch;      /* [n_vertices] a patch that holds the vertex, and where: */
  double *vertex_uv;          /* [n_vertices][2] */
} fs_triangles;

/* n_steps parts per side: n_steps x n_steps quadrilaterals per patch, each split along its shorter diagonal, or
   n_steps x n_steps triangles in a patch of three sides; n_steps >= 1. They come patch by patch, and in it row by row of
   cells, rows along u.
   FS_ERR_ARGUMENT when the counts would leave int32_t. */
FS_API fs_status fs_tessellate(fs_context *ctx, const fs_surface *surface, int32_t n_steps, fs_triangles **triangles);
FS_API void fs_triangles_free(fs_context *ctx, fs_triangles *triangles); /* NULL is allowed */

/* The same surface of patches of four sides. Where one has three, every patch becomes the parts at its corners, in their
   order (fs_patch.part), and tensor Bezier ones become tensor Bezier patches again; else this is a copy. */
FS_API fs_status fs_surface_to_quads(fs_context *ctx, const fs_surface *surface, fs_surface **quads);

/* The same surface of bicubic tensor Bezier patches, 4^m for each patch of its fs_surface_to_quads: the smallest common
   m <= max_m that fs_surface_hermite_depth finds. deviation: what was measured. */
FS_API fs_status fs_surface_to_bicubics(fs_context *ctx, const fs_surface *surface, double tolerance, int32_t max_m,
                                        fs_surface **bicubics, double *deviation);

/* Replaces a patch of four sides by 2^m x 2^m bicubic Hermite patches: position, S_u, S_v and S_uv are interpolated at the corners of
   the pieces, so the pieces join C1 and reproduce sides that are cubic. bezier[4^m][16]: piece (a, b) is number
   a + 2^m b, its points u fastest. */
FS_API void fs_surface_hermite_bicubics(const fs_surface *surface, int32_t patch, int32_t m, fs_vec3 *bezier);

/* Smallest m <= max_m for which those pieces stay within tolerance of the patch (distance of points at equal parameters,
   measured at 8x8 points per piece). deviation: what was measured for that m. */
FS_API fs_status fs_surface_hermite_depth(fs_context *ctx, const fs_surface *surface, int32_t patch, double tolerance,
                                          int32_t max_m, int32_t *m, double *deviation);

/* Finds nearest points of a surface, or of the polygons of a mesh. Made once; any number of threads may ask. */
typedef struct fs_nearest fs_nearest;
typedef struct fs_near {
  fs_vec3 position;
  double distance;
  int32_t patch; /* of the surface; or the face of the mesh */
  double u, v;   /* parameters of the patch; 0 on a mesh */
} fs_near;

/* The surface is borrowed and must outlive it. FS_ERR_NUMERIC where a patch has points that are not finite. */
FS_API fs_status fs_nearest_create(fs_context *ctx, const fs_surface *surface, fs_nearest **nearest);
/* Faces are cut into triangles from their first vertices. The mesh is not kept. */
FS_API fs_status fs_nearest_create_for_mesh(fs_context *ctx, const fs_mesh *mesh, fs_nearest **nearest);
FS_API void fs_nearest_free(fs_context *ctx, fs_nearest *nearest); /* NULL is allowed */

/* A nearest point to p. On a surface: a point of least distance among its neighbours, found from the nearest of 32 triangles
   per patch, so that the distance may exceed the least one where patches bend strongly; it is never below it. */
FS_API void fs_nearest_find(const fs_nearest *nearest, fs_vec3 p, fs_near *near);

/* The same as fs_target of fair.h asks: self is an fs_nearest. */
FS_API double fs_nearest_distance(const void *self, fs_vec3 p, fs_vec3 *position);

#ifdef __cplusplus
}
#endif
#endif
