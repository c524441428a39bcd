/* SPDX-License-Identifier: MIT */
/* Pairs of patches that meet with one tangent plane, or one curvature, along a common edge: both are made from an auxiliary
   patch by the junction equations. */
#ifndef FAIRSURF_CONSTRUCT_JUNCTION_H
#define FAIRSURF_CONSTRUCT_JUNCTION_H

#include <fairsurf/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A tensor Bezier patch: point (i, j), i along u, is number i + (degree_u + 1) j, as in fs_patch. */
typedef struct fs_bezier_patch {
  int32_t degree_u, degree_v;
  const fs_vec3 *point;
} fs_bezier_patch;

/* A patch P(u, v) continues the auxiliary patch p(s, t) across their common edge t = 0, v = 0, s = u, as P = p(s(u, v),
   t(u, v)) with s_v = beta1, t_v = gamma1, s_vv = beta2, t_vv = gamma2 there:
     P = p,   P_v = beta1 p_s + gamma1 p_t,
     P_vv = beta2 p_s + gamma2 p_t + beta1^2 p_ss + 2 beta1 gamma1 p_st + gamma1^2 p_tt.
   Functions of u by their Bernstein coefficients [degree + 1]; NULL: 0. gamma1 has no zero. */
typedef enum fs_junction_function {
  FS_BETA_1,
  FS_GAMMA_1,
  FS_BETA_2,
  FS_GAMMA_2,
  FS_N_JUNCTION_FUNCTIONS
} fs_junction_function;
typedef struct fs_junction {
  int32_t degree[FS_N_JUNCTION_FUNCTIONS];
  const double *function[FS_N_JUNCTION_FUNCTIONS];
} fs_junction;

/* The least degree by u of a patch that continues aux with these functions; order 1 (G1) or 2 (G2). */
FS_API int32_t fs_junction_degree(const fs_bezier_patch *aux, const fs_junction *junction, int32_t order);

/* column[order + 1][degree_u + 1]: the points (i, 0), (i, 1) and, for order 2, (i, 2) of the patch of degree (degree_u,
   degree_v). Names in messages follow the function. FS_ERR_ARGUMENT: a degree that the functions exceed, or below order by
   v; a zero of gamma1; a function that is not finite. FS_ERR_NUMERIC: p_s x p_t = 0 at the edge. */
FS_API fs_status fs_junction_columns(fs_context *ctx, const fs_bezier_patch *aux, const fs_junction *junction,
                                     int32_t order, int32_t degree_u, int32_t degree_v, fs_vec3 *column);

/* Both patches as a surface: patch 0 for the junction whose gamma1 is positive, patch 1 for the other, which is turned
   round so that both show the side of the auxiliary patch; side 0 of one meets side 0 of the other. far[2]: patches of degree
   (degree_u, degree_v) whose further columns are kept, in the parameters of their junctions; NULL: the columns of the
   polynomial of degree order by v. FS_ERR_ARGUMENT where both gamma1 have one sign: the patches would meet in a cusp. */
FS_API fs_status fs_junction_pair(fs_context *ctx, const fs_bezier_patch *aux, const fs_junction junction[2],
                                  int32_t order, int32_t degree_u, int32_t degree_v,
                                  const fs_bezier_patch *const far[2], fs_surface **surface);

#ifdef __cplusplus
}
#endif
#endif
