/* SPDX-License-Identifier: MIT */
/* Measures of a surface: numbers at a point, and how patches meet. */
#ifndef FAIRSURF_ANALYSE_H
#define FAIRSURF_ANALYSE_H

#include <fairsurf/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A scalar to look at; one point in, one number out. Lines of a table. NaN where p_u x p_v = 0. */
typedef struct fs_measure {
  const char *name, *summary;
  const fs_param *params;
  double (*value)(const double *param, const fs_vec3 x[FS_JET_SIZE]);
  /* NULL, or instead of value: that of a point of one surface, of measures that belong to it and stand in no table. */
  double (*at)(const void *user, int32_t patch, double u, double v);
  const void *user;
} fs_measure;
FS_API extern const fs_measure *const fs_measures[];        /* ends with NULL: mean, gaussian, gradient, … */
FS_API const fs_measure *fs_measure_find(const char *name); /* NULL: unknown */

/* A point of a surface by its patch. */
typedef struct fs_place {
  int32_t patch;
  double u, v;
} fs_place;

/* Largest differences across all sides that two patches share. */
typedef struct fs_contact {
  double position;           /* distance */
  double normal;             /* angle, radians */
  double curvature;          /* Frobenius norm of the difference of the shape tensors J G^-1 B G^-1 J^T */
  double largest_curvature;  /* Frobenius norm of the largest shape tensor met, to judge the last by */
  int32_t patch[3], side[3]; /* where each of the first three was found; FS_NONE: no shared side */
} fs_contact;

/* n_samples + 1 equidistant points per side, ends included. */
FS_API fs_status fs_surface_contact(fs_context *ctx, const fs_surface *surface, int32_t n_samples, fs_contact *contact);

/* ---- the shape of a surface ------------------------------------------------------------------------------------------ */

/* The values of a scalar over a surface. */
enum { FS_N_PERCENTILES = 5 };
FS_API extern const double fs_percentiles[FS_N_PERCENTILES]; /* 1, 5, 50, 95, 99 */
typedef struct fs_distribution {
  double min, max; /* followed to the extreme within the patch */
  fs_place at_min, at_max;
  double percentile
      [FS_N_PERCENTILES]; /* so many per cent of the area have a smaller value; from some 2^18 points at most */
} fs_distribution;

/* The numbers of a surface as a whole [docs/measures.md]. NAN and FS_NONE where the surface has no normal anywhere. */
typedef struct fs_shape {
  double area;     /* integral of 1; length^2 */
  double volume;   /* integral of p . n / 3: between the surface and the origin; of a closed surface what it encloses */
  double willmore; /* integral of H^2; 4 pi on a sphere */
  double S;        /* curvature variation, the integral of |grad H|^2; length^-2 */
  double area_error, volume_error, willmore_error, S_error; /* estimates */
  double diameter;                                          /* largest distance of two points */
  fs_place diameter_end[2];
  fs_distribution H, K, gradient; /* mean and Gaussian curvature, length of the gradient of H */
  double curvature;               /* largest absolute principal curvature; its inverse is the smallest radius */
  fs_place at_curvature;
  double hollow; /* largest principal curvature: where positive, 1 / hollow is the largest radius of a
                                     ball that touches the outside everywhere, the tool radius; */
  double ridge;  /* least principal curvature: where negative, -1 / ridge is that of the inside */
  fs_place at_hollow, at_ridge;
  double regularity; /* least |p_u x p_v| of a point in relation to its average over the patch; 0: a singular point */
  fs_place at_regularity;
  int32_t n_singular; /* patches with a regularity below 1e-6 */
} fs_shape;

/* tolerance: wanted relative error of area and volume; 1e3 times that for the Willmore energy, 1e5 times for S; 0: 1e-10. */
FS_API fs_status fs_shape_measure(fs_context *ctx, const fs_surface *surface, double tolerance, fs_shape *shape);

/* ---- edges: where patches meet -------------------------------------------------------------------------------------- */

/* A line along which two patches meet, or a line of the border. It runs along side[0] of patch[0] anticlockwise, from
   parameter t = begin[0] of that side to end[0] > begin[0], and along side[1] of patch[1] from begin[1] to end[1]. */
typedef struct fs_edge {
  int32_t patch[2], side[2]; /* patch[1] FS_NONE: nothing beyond */
  double begin[2], end[2];
  int32_t vertex[2]; /* at its begin and at its end */
  bool is_given;     /* the patches name each other: equal parts of both sides are equal points. Else it was found by
                        geometry, and the second point is the one closest to the first */
  bool is_flipped;   /* the outsides of the patches are opposite; the normal of the second is turned to compare */
} fs_edge;

typedef struct fs_edges {
  int32_t n_edges, n_borders; /* edge[0 .. n_edges - 1] have two patches, the n_borders that follow have one */
  fs_edge *edge;              /* [n_edges + n_borders] in the order of their first sides */
  int32_t n_found;            /* edges that geometry found, of n_edges */
  int32_t n_vertices;
  int32_t
      *place_start; /* [n_vertices + 1]: the places of vertex k are place[place_start[k] .. place_start[k + 1] - 1] */
  fs_place *place;  /* the corners of patches, and points within sides, that meet in a vertex */
} fs_edges;

/* All edges and vertices of a surface. Sides whose patches name no neighbour are compared with each other: where they run
   along each other closer than tolerance (0: 1e-4 of the diagonal of the box of the corners), they are an edge, be it a part
   of a side only. */
FS_API fs_status fs_edges_create(fs_context *ctx, const fs_surface *surface, double tolerance, fs_edges **edges);
FS_API void fs_edges_free(fs_context *ctx, fs_edges *edges); /* NULL is allowed */

/* A point of an edge, as both patches see it. */
typedef struct fs_edge_point {
  fs_place place[2];
  fs_vec3 jet[2][FS_JET_SIZE];
} fs_edge_point;

/* The point at parameter t of an edge in [0, 1]; of a border the first half of point only. */
FS_API void fs_edge_evaluate(const fs_surface *surface, const fs_edge *edge, double t, fs_edge_point *point);

/* ---- continuity ----------------------------------------------------------------------------------------------------- */

/* How two patches differ at a point where they meet [docs/measures.md]. */
typedef enum fs_jump {
  FS_JUMP_POSITION,  /* distance of the points; length */
  FS_JUMP_NORMAL,    /* angle of the normals; radians */
  FS_JUMP_CURVATURE, /* Frobenius norm of the difference of the shape tensors: where the normals agree, the jump of the
                        normal curvature across the edge; 1 / length */
  FS_JUMP_GRADIENT,  /* length of the difference of the gradients of the mean curvature; 1 / length^2 */
  FS_N_JUMPS
} fs_jump;
FS_API extern const char *const fs_jump_names[FS_N_JUMPS]; /* "position", "normal", "curvature", "gradient_H" */

/* The jumps between two sets of derivatives. What they do not say, because p_u x p_v = 0 or a number is not finite, is
   NAN. largest_curvature: the largest absolute principal curvature of both, 0 where there is none. */
FS_API void fs_jumps_between(const fs_vec3 x[FS_JET_SIZE], const fs_vec3 y[FS_JET_SIZE], bool is_flipped,
                             double jump[FS_N_JUMPS], double *largest_curvature);

/* Two surfaces along a common line, whatever they are; t in [0, 1]. */
typedef struct fs_line {
  void (*evaluate)(void *user, double t, fs_vec3 x[FS_JET_SIZE], fs_vec3 y[FS_JET_SIZE]);
  void *user;
  bool is_flipped;
  int32_t n_start; /* equidistant samples to begin with, 3 .. 65; 0: 9 */
} fs_line;

/* The largest jumps along a line, and where. NAN: nowhere is one. */
typedef struct fs_line_jumps {
  double value[FS_N_JUMPS], t[FS_N_JUMPS];
  double largest_curvature; /* largest absolute principal curvature met */
  int32_t n_samples;
  int32_t n_irregular; /* of them without a normal on one side: they have a position only */
} fs_line_jumps;

/* Searches the line: samples are added where the second differences allow a value larger than what was found by more than
   a part precision of it (0 < precision < 1), and the best one is followed to its maximum if precision <= 1e-3. Jumps that
   are rounding errors are not searched. */
FS_API void fs_line_largest(const fs_line *line, double precision, fs_line_jumps *jumps);

/* Largest jumps of all edges and vertices. Those of vertices are between any two of the corners that meet. */
enum { FS_N_DECADES = 24 }; /* [k]: jumps of at least 10^(k - 18) and less than ten times that; [0], [23]: beyond */
typedef struct fs_worst {
  int32_t edge;            /* or FS_NONE */
  int32_t vertex;          /* or FS_NONE */
  double t;                /* of the edge */
  fs_vec3 point;           /* on the first patch */
  double jump[FS_N_JUMPS]; /* there, all four; curvature relative */
} fs_worst;
typedef struct fs_continuity {
  double max[FS_N_JUMPS]; /* curvature in relation to curvature_scale; NAN: there was nothing to compare */
  double curvature_scale; /* what curvatures are compared with */
  double diameter;        /* what gaps are compared with */
  int32_t n_irregular;    /* edges and vertices with a point where the surface has no normal */
  int32_t n_worst[FS_N_JUMPS];
  fs_worst *worst[FS_N_JUMPS];                 /* by jump, the largest first */
  int32_t histogram[FS_N_JUMPS][FS_N_DECADES]; /* of edges; curvature relative */
  double (*edge)[FS_N_JUMPS];                  /* [n_edges] largest jumps; curvature relative */
  double (*vertex)[FS_N_JUMPS];                /* [n_vertices] */
} fs_continuity;

typedef struct fs_continuity_options {
  int32_t n_worst;        /* lengths of the lists; 0: 10 */
  double precision;       /* as of fs_line_largest, of the lists; that of the other edges is 1e-2; 0: 1e-6 */
  double curvature_scale; /* the largest principal curvature of the surface (fs_shape); 0: what is met on the edges. A
                             surface whose scale is below 1e-4 / diameter counts as flat, and is measured by that */
  double diameter;        /* of the surface (fs_shape); 0: the diagonal of the box of its vertices */
} fs_continuity_options;

/* options may be NULL. */
FS_API fs_status fs_continuity_measure(fs_context *ctx, const fs_surface *surface, const fs_edges *edges,
                                       const fs_continuity_options *options, fs_continuity **continuity);
FS_API void fs_continuity_free(fs_context *ctx, fs_continuity *continuity); /* NULL is allowed */

/* Whether all edges and vertices are G^order, order = 0 .. 3: gaps of at most tolerance times the diameter, angles of at
   most tolerance, relative jumps of curvature, and jumps of its gradient in relation to curvature_scale^2, of at most
   tolerance. An irregular point breaks G1. */
FS_API bool fs_continuity_passes(const fs_continuity *continuity, int32_t order, double tolerance);

/* The jumps as colours for exporters: log10 of the largest jump of the edge at a side of a patch (curvature relative), which
   fades to -16 towards its middle. Sides of the border are like the middle. Valid as long as the colours and the surface. */
typedef struct fs_jump_colours {
  fs_measure measure; /* for fs_model.colour */
  const fs_surface *surface;
  double (*side)[4]; /* [n_patches] */
} fs_jump_colours;
FS_API fs_status fs_jump_colours_create(fs_context *ctx, const fs_surface *surface, const fs_edges *edges,
                                        const fs_continuity *continuity, fs_jump jump, fs_jump_colours **colours);
FS_API void fs_jump_colours_free(fs_context *ctx, fs_jump_colours *colours); /* NULL is allowed */

/* ---- self-intersections --------------------------------------------------------------------------------------------- */

/* Two places of a surface at one point. */
typedef struct fs_crossing {
  fs_place place[2];
  fs_vec3 point;
} fs_crossing;
typedef struct fs_crossings {
  int32_t n;             /* pairs of patches that cross, and patches that cross themselves */
  int32_t n_listed;      /* of them, the first max_listed */
  fs_crossing *crossing; /* [n_listed] a place of each */
} fs_crossings;

/* Where a surface meets itself. Candidates are pairs of triangles of n_steps x n_steps cells per patch (0: 8 for up to
   10 000 patches, else 4) without a common vertex that cut each other; Newton's method then finds a common point of the patches
   themselves, so that coarse triangles give no false alarm; what is smaller than a triangle may be missed. */
FS_API fs_status fs_crossings_find(fs_context *ctx, const fs_surface *surface, const fs_edges *edges, int32_t n_steps,
                                   int32_t max_listed, fs_crossings **crossings);
FS_API void fs_crossings_free(fs_context *ctx, fs_crossings *crossings); /* NULL is allowed */

#ifdef __cplusplus
}
#endif
#endif
