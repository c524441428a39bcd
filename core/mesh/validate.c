/* SPDX-License-Identifier: MIT */
/* Single role: the invariants stated at fs_mesh, checked by making the mesh anew from its polygons and comparing. */
#include "mesh/mesh.h"

/* The sizes and pointers that everything after this relies on. */
static fs_status check_sizes(fs_context *ctx, const fs_mesh *mesh) {
  if (mesh->position == NULL || mesh->face_start == NULL || mesh->origin == NULL || mesh->face == NULL ||
      mesh->twin == NULL || mesh->outgoing == NULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the mesh lacks one of its arrays");
  if (mesh->n_faces < 1 || mesh->face_start[mesh->n_faces] != mesh->n_halfedges)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the mesh has %d half-edges, but its %d faces do not add up to them",
                   mesh->n_halfedges, mesh->n_faces);
  return FS_OK;
}

fs_status fs_mesh_validate(fs_context *ctx, const fs_mesh *mesh) {
  fs_status status = FS_OK;
  fs_mesh *made = NULL;
  FS_TRY(check_sizes(ctx, mesh));
  FS_TRY(fs_mesh_create(ctx, mesh->n_vertices, mesh->position, mesh->n_faces, mesh->face_start, mesh->origin, &made));
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    if (mesh->face[h] != made->face[h]) {
      status = fs_fail(ctx, FS_ERR_ARGUMENT, "half-edge %d says it belongs to face %d, but it lies in face %d", h,
                       mesh->face[h], made->face[h]);
      goto done;
    }
    if (mesh->twin[h] != made->twin[h]) {
      status = fs_fail(ctx, FS_ERR_TOPOLOGY, "half-edge %d has the twin %d instead of %d (-1: none)", h, mesh->twin[h],
                       made->twin[h]);
      goto done;
    }
  }
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    int32_t h = mesh->outgoing[v];
    bool leaves = h >= 0 && h < mesh->n_halfedges && mesh->origin[h] == v;
    if (!leaves || (fs_mesh_is_boundary(made, v) && h != made->outgoing[v])) {
      status = fs_fail(ctx, FS_ERR_TOPOLOGY, "vertex %d has %d as its first half-edge, which %s", v, h,
                       leaves ? "is not the first one anticlockwise" : "does not leave it");
      goto done;
    }
  }
done:
  fs_mesh_free(ctx, made);
  return status;
}
