/* SPDX-License-Identifier: MIT */
/* Single role: normals at the vertices of a mesh: the sum of the unit normals of its corners, weighted by their angles
   [Thuermer Wuethrich 1998]. A quad has a normal at each corner, as it need not be plane. */
#include <fairsurf/construct.h>
#include "base/base.h"
#include "math/vec3.h"

/* A corner whose edges span no plane has no normal and adds nothing. */
static fs_vec3 corner_normal(const fs_mesh *mesh, int32_t h) {
  const fs_vec3 *at = mesh->position;
  fs_vec3 here = at[mesh->origin[h]];
  fs_vec3 next = fs_vec3_sub(at[fs_mesh_target(mesh, h)], here);
  fs_vec3 previous = fs_vec3_sub(at[mesh->origin[fs_mesh_previous(mesh, h)]], here);
  fs_vec3 area = fs_vec3_cross(next, previous);
  double length = fs_vec3_length(area);
  if (!(length > 1e-14 * fs_vec3_length(next) * fs_vec3_length(previous))) return (fs_vec3){0, 0, 0};
  return fs_vec3_scale(area, atan2(length, fs_vec3_dot(next, previous)) / length);
}

fs_status fs_vertex_normals(fs_context *ctx, const fs_mesh *mesh, fs_vec3 *normal) {
  fs_status status = FS_OK;
  fs_vec3 *sum = NULL;
  FS_ALLOC(ctx, sum, mesh->n_vertices);
  for (int32_t h = 0; h < mesh->n_halfedges; h++)
    sum[mesh->origin[h]] = fs_vec3_add(sum[mesh->origin[h]], corner_normal(mesh, h));
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    double length = fs_vec3_length(sum[v]);
    if (!(length > 1e-12)) {
      status = fs_fail(ctx, FS_ERR_NUMERIC, "the faces around vertex %d give no normal", (int)v);
      goto done;
    }
    sum[v] = fs_vec3_scale(sum[v], 1 / length);
  }
  for (int32_t v = 0; v < mesh->n_vertices; v++) normal[v] = sum[v];
done:
  fs_release(ctx, sum);
  return status;
}
