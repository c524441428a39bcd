/* SPDX-License-Identifier: MIT */
/* Makes the patches of a space: Bezier points b = E c, one patch per element. */
#include <fairsurf/surface.h>
#include "base/base.h"
#include "math/vec3.h"

static int32_t n_points(const fs_extraction *extraction) {
  return (extraction->degree_u + 1) * (extraction->degree_v + 1);
}

/* Fills patch i except for its points, which start at data_start. */
static void set_patch(const fs_space *space, int32_t i, size_t data_start, fs_patch *patch) {
  const fs_element *element = &space->element[i];
  const fs_extraction *extraction = &space->extraction[element->extraction];
  *patch = (fs_patch){.kind = FS_PATCH_TENSOR_BEZIER,
                      .n_sides = 4,
                      .degree_u = extraction->degree_u,
                      .degree_v = extraction->degree_v,
                      .data_start = data_start,
                      .face = element->face,
                      .valence = extraction->valence};
  for (int side = 0; side < 4; side++) {
    patch->neighbour[side] = element->neighbour[side];
    patch->neighbour_side[side] = element->neighbour_side[side];
  }
}

/* b = E c for one element; b[n_points][3] */
static void set_points(const fs_space *space, const fs_element *element, const fs_vec3 *c, double *b) {
  const fs_extraction *extraction = &space->extraction[element->extraction];
  const int32_t *dof = space->dof + element->dof_start;
  for (int32_t row = 0; row < n_points(extraction); row++) {
    const double *weight = extraction->E + (size_t)row * (size_t)extraction->n_dofs;
    fs_vec3 sum = {0, 0, 0};
    for (int32_t k = 0; k < extraction->n_dofs; k++) sum = fs_vec3_add_scaled(sum, c[dof[k]], weight[k]);
    b[3 * row] = sum.x, b[3 * row + 1] = sum.y, b[3 * row + 2] = sum.z;
  }
}

/* Numbers of points are known to fit: their sum is checked here. */
static fs_status measure(fs_context *ctx, const fs_space *space, size_t *n_data) {
  size_t total = 0;
  for (int32_t i = 0; i < space->n_elements; i++) {
    const fs_extraction *extraction = &space->extraction[space->element[i].extraction];
    if (extraction->degree_u < 1 || extraction->degree_v < 1 || extraction->degree_u > FS_MAX_DEGREE ||
        extraction->degree_v > FS_MAX_DEGREE)
      return fs_fail(ctx, FS_ERR_UNSUPPORTED, "element %d has degree (%d, %d), which is not between 1 and %d", (int)i,
                     (int)extraction->degree_u, (int)extraction->degree_v, FS_MAX_DEGREE);
    total += 3 * (size_t)n_points(extraction);
  }
  *n_data = total;
  return FS_OK;
}

fs_status fs_surface_create(fs_context *ctx, const fs_space *space, const fs_vec3 *c, fs_surface **surface) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  size_t n_data = 0, start = 0;
  FS_TRY(measure(ctx, space, &n_data));
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, made->patch, space->n_elements);
  FS_ALLOC(ctx, made->data, n_data);
  made->n_patches = space->n_elements;
  made->n_data = n_data;
  for (int32_t i = 0; i < space->n_elements; i++) {
    set_patch(space, i, start, &made->patch[i]);
    set_points(space, &space->element[i], c, made->data + start);
    start += 3 * (size_t)n_points(&space->extraction[space->element[i].extraction]);
  }
  *surface = made;
  made = NULL;
done:
  fs_surface_free(ctx, made);
  return status;
}

void fs_surface_free(fs_context *ctx, fs_surface *surface) {
  if (surface == NULL) return;
  fs_release(ctx, surface->patch);
  fs_release(ctx, surface->data);
  fs_release(ctx, surface);
}
