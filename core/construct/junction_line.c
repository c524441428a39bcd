/* SPDX-License-Identifier: MIT */
/* Single role: pairs of patches as a line of the table of constructions: the auxiliary patch "aux", the functions beta1-a,
   gamma1-a, beta2-a, gamma2-a of the first patch and those of the second with -b, and the patches "a" and "b", whose further
   columns are kept, from a list of splines. */
#include "construct/construct.h"
#include "base/base.h"

#include <fairsurf/construct_junction.h>

#include <stdio.h>

enum { ORDER, DEGREE_U, DEGREE_V };

static const char *const orders[] = {"tangent", "curvature", NULL};

static bool is_bezier(const fs_spline *s) { return s->n[0] == s->degree[0] + 1 && s->n[1] == s->degree[1] + 1; }

static fs_status take_patch(fs_context *ctx, const fs_splines *splines, const char *name, fs_bezier_patch *patch,
                            bool *is_there) {
  const fs_spline *s = fs_splines_find(splines, name);
  *is_there = s != NULL;
  if (s == NULL) return FS_OK;
  if (s->n_parameters != 2 || !is_bezier(s))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "'%s' is no Bezier patch: it has knots inside, or is a curve", name);
  *patch = (fs_bezier_patch){s->degree[0], s->degree[1], (const fs_vec3 *)(const void *)s->c};
  return FS_OK;
}

/* gamma1 is 1 for the first and -1 for the second patch unless given. */
static fs_status take_functions(fs_context *ctx, const fs_splines *splines, int side, fs_junction *junction) {
  static const char *const name[FS_N_JUNCTION_FUNCTIONS] = {"beta1", "gamma1", "beta2", "gamma2"};
  static const double one[2] = {1, -1};
  *junction = (fs_junction){.function = {[FS_GAMMA_1] = &one[side]}};
  for (int f = 0; f < FS_N_JUNCTION_FUNCTIONS; f++) {
    char full[16];
    snprintf(full, sizeof full, "%s-%c", name[f], "ab"[side]);
    const fs_spline *s = fs_splines_find(splines, full);
    if (s == NULL) continue;
    if (s->n_parameters != 1 || s->width != 1 || !is_bezier(s))
      return fs_fail(ctx, FS_ERR_ARGUMENT,
                     "'%s' is no polynomial function: it has knots inside, or is a curve or patch", full);
    junction->degree[f] = s->degree[0];
    junction->function[f] = s->c;
  }
  return FS_OK;
}

static fs_status build(fs_context *ctx, const fs_construction_input *input, const double *param, fs_surface **surface) {
  static const char *const far_name[2] = {"a", "b"};
  fs_status status = FS_OK;
  fs_bezier_patch aux, far[2];
  const fs_bezier_patch *kept[2] = {NULL, NULL};
  fs_junction junction[2];
  bool is_there;
  int32_t order = (int32_t)param[ORDER] + 1, degree_u = (int32_t)param[DEGREE_U], degree_v = (int32_t)param[DEGREE_V];
  FS_TRY(take_patch(ctx, input->splines, "aux", &aux, &is_there));
  if (!is_there) return fs_fail(ctx, FS_ERR_ARGUMENT, "a pair of patches needs the auxiliary patch 'aux'");
  for (int side = 0; side < 2; side++) {
    FS_TRY(take_functions(ctx, input->splines, side, &junction[side]));
    FS_TRY(take_patch(ctx, input->splines, far_name[side], &far[side], &is_there));
    if (!is_there) continue;
    kept[side] = &far[side];
    if (degree_u == 0) degree_u = far[side].degree_u;
    if (degree_v == 0) degree_v = far[side].degree_v;
  }
  for (int side = 0; side < 2 && param[DEGREE_U] == 0 && kept[0] == NULL && kept[1] == NULL; side++) {
    int32_t least = fs_junction_degree(&aux, &junction[side], order);
    if (least > degree_u) degree_u = least;
  }
  if (degree_v == 0) degree_v = order == 1 ? 3 : 5;
  FS_TRY(fs_junction_pair(ctx, &aux, junction, order, degree_u, degree_v, kept, surface));
done:
  return status;
}

const fs_construction fs_construction_junction = {
    .name = "junction",
    .summary = "two patches that meet along the edge of an auxiliary patch, from a file of splines",
    .takes = FS_TAKES_SPLINES,
    .params = (const fs_param[]){{"joint", "what agrees along the edge", 0, 0, 1, orders},
                                 {"degree-u", "degree along the edge; 0: as the functions ask", 0, 0, 31, NULL},
                                 {"degree-v", "degree across the edge; 0: 3, or 5 for curvature", 0, 0, 31, NULL},
                                 {.name = NULL}},
    .build = build,
};
