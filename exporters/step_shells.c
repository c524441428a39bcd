/* SPDX-License-Identifier: MIT */
/* Single role: the components of a surface, each with the shell of its faces: a solid where it is closed, else an open shell. */
#include "step.h"
#include "base/base.h"
#include "math/vec3.h"
#include "surface/surface.h"

/* Numbers the components of the surface: component[n_patches], in ascending order. stack[n_patches]. */
static int32_t find_components(const fs_surface *surface, int32_t *component, int32_t *stack) {
  int32_t n = 0;
  for (int32_t p = 0; p < surface->n_patches; p++) component[p] = FS_NONE;
  for (int32_t p = 0; p < surface->n_patches; p++) {
    int32_t n_stack = 0;
    if (component[p] != FS_NONE) continue;
    component[p] = n;
    stack[n_stack++] = p;
    while (n_stack > 0) {
      const int32_t *neighbour = surface->patch[stack[--n_stack]].neighbour;
      for (int32_t s = 0; s < 4; s++) {
        if (neighbour[s] == FS_NONE || component[neighbour[s]] != FS_NONE) continue;
        component[neighbour[s]] = n;
        stack[n_stack++] = neighbour[s];
      }
    }
    n++;
  }
  return n;
}

/* Six times the volume below the net of a patch, seen from a point; its sum says which side of a closed net is inside. */
static double net_volume(const fs_surface *surface, int32_t p, fs_vec3 from) {
  double sum = 0;
  int32_t n, m;
  fs_step_degrees(surface, 4 * p, &n, &m);
  for (int32_t j = 0; j < m; j++)
    for (int32_t i = 0; i < n; i++) {
      fs_vec3 a = fs_vec3_sub(fs_step_point(surface, 4 * p, i, j), from);
      fs_vec3 b = fs_vec3_sub(fs_step_point(surface, 4 * p, i + 1, j), from);
      fs_vec3 c = fs_vec3_sub(fs_step_point(surface, 4 * p, i + 1, j + 1), from);
      fs_vec3 d = fs_vec3_sub(fs_step_point(surface, 4 * p, i, j + 1), from);
      sum += fs_vec3_dot(fs_vec3_cross(a, b), c) + fs_vec3_dot(fs_vec3_cross(a, c), d);
    }
  return sum;
}

fs_status fs_step_shells_create(fs_context *ctx, const fs_surface *surface, const fs_step_layout *layout,
                                fs_step_shells **shells) {
  fs_status status = FS_OK;
  fs_step_shells *made = NULL;
  int32_t *stack = NULL, *component = NULL;
  double *volume = NULL;
  fs_vec3 from = fs_step_point(surface, 0, 0, 0);
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, stack, surface->n_patches);
  FS_ALLOC(ctx, component, surface->n_patches);
  made->n_shells = find_components(surface, component, stack);
  FS_ALLOC(ctx, volume, made->n_shells);
  FS_ALLOC(ctx, made->is_open, made->n_shells);
  FS_ALLOC(ctx, made->start, (size_t)made->n_shells + 1);
  FS_ALLOC(ctx, made->face, layout->n_faces);
  for (int32_t p = 0; p < surface->n_patches; p++) {
    for (int32_t s = 0; s < 4; s++)
      if (surface->patch[p].neighbour[s] == FS_NONE) made->is_open[component[p]] = true;
    volume[component[p]] += net_volume(surface, p, from);
  }
  for (int32_t c = 0; c < made->n_shells; c++)
    if (!made->is_open[c] && volume[c] < 0)
      fs_note(ctx, "solid %d of the STEP file is inside out: the faces of the mesh look inwards", (int)c);
  /* faces sorted by component: counts, starts, then each to the next place of its component */
  for (int32_t f = 0; f < layout->n_faces; f++) made->start[component[layout->face[f].cell / 4] + 1]++;
  for (int32_t c = 0; c < made->n_shells; c++) stack[c] = made->start[c], made->start[c + 1] += made->start[c];
  for (int32_t f = 0; f < layout->n_faces; f++) made->face[stack[component[layout->face[f].cell / 4]]++] = f;
  *shells = made;
  made = NULL;
done:
  fs_release(ctx, stack);
  fs_release(ctx, component);
  fs_release(ctx, volume);
  fs_step_shells_free(ctx, made);
  return status;
}

void fs_step_shells_free(fs_context *ctx, fs_step_shells *shells) {
  if (shells == NULL) return;
  fs_release(ctx, shells->is_open);
  fs_release(ctx, shells->start);
  fs_release(ctx, shells->face);
  fs_release(ctx, shells);
}
