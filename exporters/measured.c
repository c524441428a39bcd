/* SPDX-License-Identifier: MIT */
/* Single role: the values of a measure at the vertices of triangles, from the patches, not from the triangles. */
#include "measured.h"
#include "base/base.h"

fs_status fs_measure_vertices(fs_context *ctx, const fs_surface *surface, const fs_measure *measure,
                              const fs_triangles *t, double *value) {
  fs_status status = FS_OK;
  fs_vec3 x[FS_JET_SIZE];
  double *param = NULL;
  size_t n_params = 0;
  while (measure->params != NULL && measure->params[n_params].name != NULL) n_params++;
  FS_ALLOC(ctx, param, n_params);
  for (size_t k = 0; k < n_params; k++) param[k] = measure->params[k].initial;
  for (int32_t k = 0; k < t->n_vertices; k++) {
    const double *uv = t->vertex_uv + 2 * (size_t)k;
    fs_surface_evaluate(surface, t->vertex_patch[k], uv[0], uv[1], x);
    value[k] = measure->value(param, x);
  }
done:
  fs_release(ctx, param);
  return status;
}
