/* SPDX-License-Identifier: MIT */
/* Surfaces: patches with their neighbours, their derivatives, and triangles from them. */
#ifndef FAIRSURF_SURFACE_H
#define FAIRSURF_SURFACE_H

#include <fairsurf/space.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum fs_patch_kind { FS_PATCH_TENSOR_BEZIER } fs_patch_kind; /* a line of fs_patch_kinds each */

enum { FS_MAX_DEGREE = 31 }; /* of a patch, in u and in v */

typedef struct fs_patch {
  int32_t kind;    /* fs_patch_kind; it says what lies at data_start */
  int32_t n_sides; /* 4: domain [0, 1]^2, sides and corners as in space.h */
  int32_t degree_u, degree_v;
  size_t data_start;         /* tensor Bezier: control points x, y, z; point (i, j) is number i + (degree_u + 1) j */
  int32_t face;              /* control face it lies on, or FS_NONE */
  int32_t valence;           /* of the special vertex at corner 0 of a cap patch; 4 for regular patches */
  int32_t neighbour[4];      /* patch across each side, or FS_NONE */
  uint8_t neighbour_side[4]; /* the side of the neighbour that meets ours; it runs the other way */
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
  /* Derivatives up to order 3 at (u, v): x[FS_JET_SIZE]. */
  void (*jet)(const fs_patch *patch, const double *data, double u, double v, fs_vec3 *x);
} fs_patch_kind_info;
FS_API extern const fs_patch_kind_info fs_patch_kinds[];

/* The surface of a space with dofs c[n_dofs]: patch i is element i. */
FS_API fs_status fs_surface_create(fs_context *ctx, const fs_space *space, const fs_vec3 *c, fs_surface **surface);
FS_API void fs_surface_free(fs_context *ctx, fs_surface *surface); /* NULL is allowed */

/* Position and derivatives up to order 3 of a patch at (u, v): x[FS_JET_SIZE]. */
FS_API void fs_surface_evaluate(const fs_surface *surface, int32_t patch, double u, double v, fs_vec3 *x);

/* (u, v) of the point at parameter t in [0, 1] of a side, t running anticlockwise (as the sides of space.h do). */
FS_API void fs_side_parameters(int32_t side, double t, double *u, double *v);

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

/* n_steps x n_steps quadrilaterals per patch, each split along its shorter diagonal; n_steps >= 1.
   FS_ERR_ARGUMENT when the counts would leave int32_t. */
FS_API fs_status fs_tessellate(fs_context *ctx, const fs_surface *surface, int32_t n_steps, fs_triangles **triangles);
FS_API void fs_triangles_free(fs_context *ctx, fs_triangles *triangles); /* NULL is allowed */

/* Replaces a patch by 2^m x 2^m bicubic Hermite patches: position, S_u, S_v and S_uv are interpolated at the corners of
   the pieces, so the pieces join C1 and reproduce sides that are cubic. bezier[4^m][16]: piece (a, b) is number
   a + 2^m b, its points u fastest. */
FS_API void fs_surface_hermite_bicubics(const fs_surface *surface, int32_t patch, int32_t m, fs_vec3 *bezier);

/* Smallest m <= max_m for which those pieces stay within tolerance of the patch (distance of points at equal parameters,
   measured at 8x8 points per piece). deviation: what was measured for that m. */
FS_API fs_status fs_surface_hermite_depth(fs_context *ctx, const fs_surface *surface, int32_t patch, double tolerance,
                                          int32_t max_m, int32_t *m, double *deviation);

#ifdef __cplusplus
}
#endif
#endif
