/* SPDX-License-Identifier: MIT */
/* Single role: how large the problem is, from what fixes it. */
#include "fair/setup.h"
#include "math/vec3.h"

#include <stdlib.h>

typedef struct radial {
  double radius;
  fs_vec3 position;
} radial;

static int compare_radius(const void *a, const void *b) {
  double x = ((const radial *)a)->radius, y = ((const radial *)b)->radius;
  return (x < y) - (x > y);
}

/* Largest distance of two points: pairs are tried outwards in, and no pair within radii r_i + r_j <= best remains. */
static double diameter_of(int32_t n, radial *point) {
  fs_vec3 centre = {0};
  double best = 0;
  for (int32_t i = 0; i < n; i++) centre = fs_vec3_add_scaled(centre, point[i].position, 1.0 / n);
  for (int32_t i = 0; i < n; i++) point[i].radius = fs_vec3_distance(point[i].position, centre);
  qsort(point, (size_t)n, sizeof *point, compare_radius);
  for (int32_t i = 0; i < n && 2 * point[i].radius > best; i++)
    for (int32_t j = i + 1; j < n && point[i].radius + point[j].radius > best; j++)
      best = fmax(best, fs_vec3_distance(point[i].position, point[j].position));
  return best;
}

static bool is_anything_fixed(const fs_space *space, const fs_fair_options *options) {
  for (int32_t d = 0; options->fixed != NULL && d < space->n_dofs; d++)
    if (options->fixed[d]) return true;
  return false;
}

/* Diagonal of the bounding box of the vertices. */
static double box_diagonal(const fs_space *space, const fs_vec3 *c) {
  fs_vec3 low = c[0], high = c[0];
  for (int32_t v = 1; v < space->n_vertices; v++) {
    low = fs_vec3_min(low, c[v]);
    high = fs_vec3_max(high, c[v]);
  }
  return fs_vec3_distance(low, high);
}

fs_status fs_scale_find(fs_context *ctx, const fs_space *space, const fs_fair_options *options, const fs_vec3 *c,
                        fs_scale *scale, bool *is_fixed) {
  fs_status status = FS_OK;
  const fs_constraints none = {0}, *k = options->constraints != NULL ? options->constraints : &none;
  radial *point = NULL;
  int32_t n = 0;
  double diameter;
  FS_ALLOC(ctx, point, (size_t)space->n_vertices + (size_t)k->n_holds);
  for (int32_t v = 0; v < space->n_vertices && options->fixed != NULL; v++)
    if (options->fixed[v]) point[n++].position = space->start[v];
  for (int32_t i = 0; i < k->n_holds; i++)
    if (k->hold[i].has_position) point[n++].position = k->hold[i].position;
  diameter = diameter_of(n, point);
  *is_fixed = is_anything_fixed(space, options) || n > 0 || k->n_equations > 0 || k->tolerance > 0;
  if (*is_fixed && k->keep != FS_KEEP_NOTHING) {
    status = fs_fail(ctx, FS_ERR_UNSUPPORTED,
                     "%s is kept where no places are given, but vertices are fixed or constraints give places",
                     k->keep == FS_KEEP_AREA ? "the area" : "the volume");
    goto done;
  }
  if (diameter == 0 && (n > 0 || k->n_equations > 0) && k->tolerance == 0 && n <= 1) {
    status = fs_fail(ctx, FS_ERR_UNSUPPORTED,
                     "what is fixed leaves the size free: fix or hold two points that lie apart, or more");
    goto done;
  }
  scale->n_squares = space->n_elements;
  scale->diameter = diameter == 0 && *is_fixed ? box_diagonal(space, c) : diameter;
done:
  fs_release(ctx, point);
  return status;
}
