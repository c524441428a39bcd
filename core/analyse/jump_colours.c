/* SPDX-License-Identifier: MIT */
/* Single role: the jumps of edges as a measure over the surface, for exporters that colour by one. */
#include "analyse/analyse.h"

#include <math.h>

static const double least = -16;

static const fs_param no_params[] = {{0}};

/* The larger of the values of the sides, each fading with the sixth power of the distance. */
static double value_at(const void *user, int32_t patch, double u, double v) {
  const fs_jump_colours *colours = user;
  const double quad[4] = {v, 1 - u, 1 - v, u}, triangle[4] = {v, 1 - u - v, u, 1};
  const double *distance = colours->surface->patch[patch].n_sides == 3 ? triangle : quad;
  double value = least;
  for (int s = 0; s < colours->surface->patch[patch].n_sides; s++)
    value = fmax(value, least + (colours->side[patch][s] - least) * pow(1 - distance[s], 6));
  return value;
}

fs_status fs_jump_colours_create(fs_context *ctx, const fs_surface *surface, const fs_edges *edges,
                                 const fs_continuity *continuity, fs_jump jump, fs_jump_colours **colours) {
  static const char *const summaries[FS_N_JUMPS] = {
      "log10 of the largest gap of the nearest edge", "log10 of the largest angle of normals at the nearest edge",
      "log10 of the largest relative jump of curvature at the nearest edge",
      "log10 of the largest jump of the gradient of the mean curvature at the nearest edge"};
  fs_jump_colours *c = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, c, 1);
  FS_ALLOC(ctx, c->side, surface->n_patches);
  c->surface = surface;
  c->measure = (fs_measure){
      .name = fs_jump_names[jump], .summary = summaries[jump], .params = no_params, .at = value_at, .user = c};
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int s = 0; s < 4; s++) c->side[p][s] = least;
  for (int32_t i = 0; i < edges->n_edges; i++) {
    double value = continuity->edge[i][jump], shown = value > 0 ? log10(value) : least;
    for (int k = 0; k < 2; k++) {
      double *side = &c->side[edges->edge[i].patch[k]][edges->edge[i].side[k]];
      *side = fmax(*side, shown);
    }
  }
  *colours = c;
  c = NULL;
done:
  fs_jump_colours_free(ctx, c);
  return status;
}

void fs_jump_colours_free(fs_context *ctx, fs_jump_colours *colours) {
  if (colours == NULL) return;
  fs_release(ctx, colours->side);
  fs_release(ctx, colours);
}
