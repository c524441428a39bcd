/* SPDX-License-Identifier: MIT */
/* What the files of this room, and the rooms that make meshes, share. */
#ifndef FS_MESH_MESH_H
#define FS_MESH_MESH_H

#include <fairsurf/mesh.h>
#include "base/base.h"

/* A mesh with zeroed arrays of the given sizes (face_start[n_faces + 1] included), for the caller to fill:
   position, face_start, origin, face, twin; then fs_mesh_complete. Frees itself on failure. */
fs_status fs_mesh_allocate(fs_context *ctx, int32_t n_vertices, int32_t n_faces, int32_t n_halfedges, fs_mesh **mesh);

/* Sets face[] from face_start, and outgoing[] from origin and twin (at the boundary the first half-edge anticlockwise).
   The rest must be consistent; nothing is checked. */
void fs_mesh_complete(fs_mesh *mesh);

#endif
