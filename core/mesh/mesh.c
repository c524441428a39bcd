/* SPDX-License-Identifier: MIT */
/* Single role: the life of a mesh (allocate, complete, copy, free) and the walk around a vertex. */
#include "mesh/mesh.h"

#include <string.h>

fs_status fs_mesh_allocate(fs_context *ctx, int32_t n_vertices, int32_t n_faces, int32_t n_halfedges, fs_mesh **mesh) {
  fs_status status = FS_OK;
  fs_mesh *m = NULL;
  FS_ALLOC(ctx, m, 1);
  m->n_vertices = n_vertices;
  m->n_faces = n_faces;
  m->n_halfedges = n_halfedges;
  FS_ALLOC(ctx, m->position, n_vertices);
  FS_ALLOC(ctx, m->face_start, (size_t)n_faces + 1);
  FS_ALLOC(ctx, m->origin, n_halfedges);
  FS_ALLOC(ctx, m->face, n_halfedges);
  FS_ALLOC(ctx, m->twin, n_halfedges);
  FS_ALLOC(ctx, m->outgoing, n_vertices);
  *mesh = m;
  m = NULL;
done:
  fs_mesh_free(ctx, m);
  return status;
}

void fs_mesh_complete(fs_mesh *mesh) {
  for (int32_t f = 0; f < mesh->n_faces; f++)
    for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; h++) mesh->face[h] = f;
  for (int32_t v = 0; v < mesh->n_vertices; v++) mesh->outgoing[v] = FS_NONE;
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    int32_t v = mesh->origin[h];
    if (mesh->outgoing[v] == FS_NONE || mesh->twin[h] == FS_NONE) mesh->outgoing[v] = h;
  }
}

fs_status fs_mesh_copy(fs_context *ctx, const fs_mesh *mesh, fs_mesh **copy) {
  fs_status status = FS_OK;
  fs_mesh *m = NULL;
  size_t n_vertices = (size_t)mesh->n_vertices, n_faces = (size_t)mesh->n_faces;
  size_t n_halfedges = (size_t)mesh->n_halfedges;
  FS_TRY(fs_mesh_allocate(ctx, mesh->n_vertices, mesh->n_faces, mesh->n_halfedges, &m));
  memcpy(m->position, mesh->position, n_vertices * sizeof *m->position);
  memcpy(m->face_start, mesh->face_start, (n_faces + 1) * sizeof *m->face_start);
  memcpy(m->origin, mesh->origin, n_halfedges * sizeof *m->origin);
  memcpy(m->face, mesh->face, n_halfedges * sizeof *m->face);
  memcpy(m->twin, mesh->twin, n_halfedges * sizeof *m->twin);
  memcpy(m->outgoing, mesh->outgoing, n_vertices * sizeof *m->outgoing);
  *copy = m;
done:
  return status;
}

void fs_mesh_free(fs_context *ctx, fs_mesh *mesh) {
  if (mesh == NULL) return;
  fs_release(ctx, mesh->position);
  fs_release(ctx, mesh->face_start);
  fs_release(ctx, mesh->origin);
  fs_release(ctx, mesh->face);
  fs_release(ctx, mesh->twin);
  fs_release(ctx, mesh->outgoing);
  fs_release(ctx, mesh);
}

int32_t fs_mesh_valence(const fs_mesh *mesh, int32_t vertex) {
  int32_t first = mesh->outgoing[vertex], h = first, n = 0;
  do {
    n++;
    h = fs_mesh_rotate(mesh, h);
  } while (h != FS_NONE && h != first);
  return h == FS_NONE ? n + 1 : n; /* at the boundary the last edge is entered only */
}
