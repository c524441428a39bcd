/* SPDX-License-Identifier: MIT */
/* Single role: a part of a GLB file compressed by Draco, and what a decoder will get from it. */
#include "glb.h"
#include "base/base.h"
#include "mesh/draco_bridge.h"

/* Counts and box of what was written, from a decoder: the box is not that of the input, but up to half a step of the grid
   larger or smaller. */
static fs_status look_back(fs_context *ctx, const char *bytes, size_t size, fs_glb_stored *stored) {
  fs_draco_mesh *draco = NULL;
  float *x = NULL;
  int32_t attribute, n;
  fs_status status = FS_OK;
  FS_TRY(fs_draco_decode(ctx, bytes, size, &draco));
  stored->n_vertices = fs_draco_n_points(draco);
  if (fs_draco_n_triangles(draco) != stored->n_triangles) {
    status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "Draco keeps %d of %d triangles", fs_draco_n_triangles(draco),
                     stored->n_triangles);
    goto done;
  }
  attribute = fs_draco_find_id(draco, stored->id[FS_GLB_POSITION]);
  n = fs_draco_n_values(draco, attribute);
  FS_ALLOC(ctx, x, 3 * (size_t)n);
  fs_draco_values(draco, attribute, x);
  for (int32_t i = 0; i < 3 * n; i++) {
    if (i < 3 || x[i] < stored->min[i % 3]) stored->min[i % 3] = x[i];
    if (i < 3 || x[i] > stored->max[i % 3]) stored->max[i % 3] = x[i];
  }
done:
  fs_release(ctx, x);
  fs_draco_free(draco);
  return status;
}

fs_status fs_glb_append_compressed(fs_context *ctx, const fs_glb_mesh *mesh, const fs_glb_part *part,
                                   const fs_glb_bits *bits, fs_blob *chunk, fs_glb_stored *stored) {
  const size_t first = (size_t)part->first_vertex;
  const int32_t n = part->n_vertices;
  char *bytes = NULL;
  size_t size = 0;
  fs_status status = FS_OK;
  const fs_draco_attribute attribute[FS_GLB_ATTRIBUTES] = {
      [FS_GLB_POSITION] = {.kind = FS_DRACO_POSITION,
                           .n_components = 3,
                           .n_values = n,
                           .values = mesh->position + 3 * first,
                           .bits = bits->position,
                           .grid = mesh->grid},
      [FS_GLB_NORMAL] = {.kind = FS_DRACO_NORMAL,
                         .n_components = 3,
                         .n_values = n,
                         .values = mesh->normal + 3 * first,
                         .bits = bits->normal},
      [FS_GLB_TEXTURE] = {.kind = FS_DRACO_TEXTURE,
                          .n_components = 2,
                          .n_values = n,
                          .values = mesh->texture != NULL ? mesh->texture + 2 * first : NULL,
                          .bits = bits->measure},
      [FS_GLB_MEASURE] = {.kind = FS_DRACO_GENERIC,
                          .n_components = 1,
                          .n_values = n,
                          .values = mesh->measure != NULL ? mesh->measure + first : NULL,
                          .bits = bits->measure}};
  const fs_draco_geometry geometry = {.n_points = n,
                                      .n_triangles = part->n_triangles,
                                      .corner = mesh->corner + 3 * (size_t)part->first_triangle,
                                      .n_attributes = mesh->measure != NULL ? FS_GLB_ATTRIBUTES : FS_GLB_TEXTURE,
                                      .attribute = attribute};
  FS_TRY(fs_draco_encode(ctx, &geometry, stored->id, &bytes, &size));
  stored->n_triangles = part->n_triangles;
  FS_TRY(look_back(ctx, bytes, size, stored));
  stored->start = chunk->size;
  stored->size = size;
  FS_TRY(fs_blob_append(chunk, bytes, size));
  FS_TRY(fs_blob_pad(chunk, 4, 0));
done:
  fs_release(ctx, bytes);
  return status;
}
