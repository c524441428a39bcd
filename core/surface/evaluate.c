/* SPDX-License-Identifier: MIT */
/* Points of a surface by patch and parameters. */
#include <fairsurf/surface.h>

void fs_surface_evaluate(const fs_surface *surface, int32_t patch, double u, double v, fs_vec3 *x) {
  const fs_patch *p = &surface->patch[patch];
  fs_patch_kinds[p->kind].jet(p, surface->data, u, v, x);
}

void fs_side_parameters(int32_t side, double t, double *u, double *v) {
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
