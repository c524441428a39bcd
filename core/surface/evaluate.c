/* SPDX-License-Identifier: MIT */
/* Points of a surface by patch and parameters; parts of patches by the chain rule.

   Part c of a domain with corners k is w(s, t) = (1 - s)(1 - t) A + s (1 - t) B + s t C + (1 - s) t D with A = corner c,
   B = the middle of side c, C = the centre, D = the middle of side c - 1; w_st = A - B + C - D, w_ss = w_tt = 0. */
#include "surface/jet.h"
#include "surface/surface.h"
#include "math/vec3.h"

void fs_domain_corner(int32_t n_sides, int32_t c, double *uv) {
  static const double triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}}, square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const double *corner = n_sides == 3 ? triangle[c % 3] : square[c % 4];
  uv[0] = corner[0], uv[1] = corner[1];
}

void fs_domain_centre(int32_t n_sides, double *uv) { uv[0] = uv[1] = n_sides == 3 ? 1.0 / 3 : 0.5; }

typedef struct part_map {
  double at[2], ds[2], dt[2], dst[2];
} part_map;

static part_map map_part(int32_t n_sides, int32_t c, double s, double t) {
  double a[2], next[2], previous[2], centre[2];
  part_map m;
  fs_domain_corner(n_sides, c, a);
  fs_domain_corner(n_sides, c + 1, next);
  fs_domain_corner(n_sides, c + n_sides - 1, previous);
  fs_domain_centre(n_sides, centre);
  for (int k = 0; k < 2; k++) {
    double b = (a[k] + next[k]) / 2, d = (a[k] + previous[k]) / 2;
    m.at[k] = (1 - t) * ((1 - s) * a[k] + s * b) + t * ((1 - s) * d + s * centre[k]);
    m.ds[k] = (1 - t) * (b - a[k]) + t * (centre[k] - d);
    m.dt[k] = (1 - s) * (d - a[k]) + s * (centre[k] - b);
    m.dst[k] = a[k] - b + centre[k] - d;
  }
  return m;
}

static void part_jet(const fs_patch *patch, const double *data, double s, double t, fs_vec3 *x) {
  const fs_patch_kind_info *kind = &fs_patch_kinds[patch->kind];
  part_map m = map_part(kind->n_sides, patch->part - 1, s, t);
  double f[3][FS_JET_SIZE];
  kind->jet(patch, data, m.at[0], m.at[1], x);
  for (int k = 0; k < FS_JET_SIZE; k++) f[0][k] = x[k].x, f[1][k] = x[k].y, f[2][k] = x[k].z;
  for (int i = 0; i < 3; i++) fs_jet_compose(f[i], m.ds, m.dt, m.dst, f[i]);
  for (int k = 0; k < FS_JET_SIZE; k++) x[k] = (fs_vec3){f[0][k], f[1][k], f[2][k]};
}

void fs_surface_evaluate(const fs_surface *surface, int32_t patch, double u, double v, fs_vec3 *x) {
  const fs_patch *p = &surface->patch[patch];
  if (p->part == 0)
    fs_patch_kinds[p->kind].jet(p, surface->data, u, v, x);
  else
    part_jet(p, surface->data, u, v, x);
}

void fs_side_parameters(int32_t n_sides, int32_t side, double t, double *u, double *v) {
  if (n_sides == 3) {
    *u = side == 0 ? t : side == 1 ? 1 - t : 0;
    *v = side == 0 ? 0 : side == 1 ? t : 1 - t;
    return;
  }
  switch (side) {
  case 0:
    *u = t, *v = 0;
    break;
  case 1:
    *u = 1, *v = t;
    break;
  case 2:
    *u = 1 - t, *v = 1;
    break;
  default:
    *u = 0, *v = 1 - t;
    break;
  }
}
