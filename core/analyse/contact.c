/* SPDX-License-Identifier: MIT */
/* How patches meet: differences of position, normal and shape tensor along every shared side. */
#include <fairsurf/analyse.h>
#include "base/base.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

static double frobenius(double a[3][3], double b[3][3]) {
  double sum = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) sum += (a[i][j] - b[i][j]) * (a[i][j] - b[i][j]);
  return sqrt(sum);
}

/* Keeps the largest difference number k and where it was; NaN counts as largest. */
static void keep(fs_contact *contact, int k, double *largest, double value, int32_t p, int32_t s) {
  if (contact->patch[k] != FS_NONE && value <= *largest) return;
  *largest = value;
  contact->patch[k] = p;
  contact->side[k] = s;
}

/* Points where p_u x p_v vanishes on one side have a position only. */
static void compare(const fs_surface *surface, int32_t p, int32_t s, double t, fs_contact *contact) {
  double zero[3][3] = {{0}};
  const fs_patch *patch = &surface->patch[p];
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  fs_geometry g, h;
  double u, v, W[3][3], V[3][3];
  fs_side_parameters(patch->n_sides, s, t, &u, &v);
  fs_surface_evaluate(surface, p, u, v, x);
  fs_side_parameters(surface->patch[patch->neighbour[s]].n_sides, patch->neighbour_side[s], 1 - t, &u, &v);
  fs_surface_evaluate(surface, patch->neighbour[s], u, v, y);
  keep(contact, 0, &contact->position, fs_vec3_distance(x[FS_D], y[FS_D]), p, s);
  if (!fs_geometry_compute(x, &g) || !fs_geometry_compute(y, &h)) return;
  fs_geometry_shape_tensor(&g, W);
  fs_geometry_shape_tensor(&h, V);
  keep(contact, 1, &contact->normal, fs_vec3_angle(g.normal, h.normal), p, s);
  keep(contact, 2, &contact->curvature, frobenius(W, V), p, s);
  contact->largest_curvature = fmax(contact->largest_curvature, fmax(frobenius(W, zero), frobenius(V, zero)));
}

fs_status fs_surface_contact(fs_context *ctx, const fs_surface *surface, int32_t n_samples, fs_contact *contact) {
  fs_contact found = {.patch = {FS_NONE, FS_NONE, FS_NONE}, .side = {FS_NONE, FS_NONE, FS_NONE}};
  if (n_samples < 1)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "contact needs 1 sample per side or more, not %d", (int)n_samples);
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      const fs_patch *patch = &surface->patch[p];
      if (patch->neighbour[s] == FS_NONE ||
          4 * (int64_t)patch->neighbour[s] + patch->neighbour_side[s] < 4 * (int64_t)p + s)
        continue;
      for (int32_t k = 0; k <= n_samples; k++) compare(surface, p, s, (double)k / n_samples, &found);
    }
  *contact = found;
  return FS_OK;
}
