/* SPDX-License-Identifier: MIT */
/* Single role: faces of more than four vertices as triangles around a new vertex.

   The new vertex lies above the mean c of the corners p_i, along the mean N of their normals n_i, at c + h N. A circular
   arc between p_i and that point with the normals n_i and N has its chord orthogonal to n_i + N:
     h_i = (p_i - c) . (n_i + N) / (N . (n_i + N)),
   and h is their mean. Regular faces of a sphere get a point of the sphere. */
#include "construct/gregory.h"
#include "math/vec3.h"

#include <string.h>

static bool find_middle(const fs_mesh *mesh, const fs_vec3 *normal, int32_t f, fs_vec3 *middle, fs_vec3 *axis) {
  fs_vec3 c = {0, 0, 0}, N = {0, 0, 0};
  int32_t first = mesh->face_start[f], n = fs_mesh_face_size(mesh, f);
  double height = 0;
  for (int32_t k = 0; k < n; k++) {
    c = fs_vec3_add_scaled(c, mesh->position[mesh->origin[first + k]], 1.0 / n);
    N = fs_vec3_add(N, normal[mesh->origin[first + k]]);
  }
  double length = fs_vec3_length(N);
  if (!(length > 1e-6 * n)) return false;
  N = fs_vec3_scale(N, 1 / length);
  for (int32_t k = 0; k < n; k++) {
    int32_t v = mesh->origin[first + k];
    fs_vec3 both = fs_vec3_add(normal[v], N);
    double along = fs_vec3_dot(N, both);
    if (!(along > 1e-3)) return false;
    height += fs_vec3_dot(fs_vec3_sub(mesh->position[v], c), both) / along / n;
  }
  *middle = fs_vec3_add_scaled(c, N, height);
  *axis = N;
  return true;
}

typedef struct counts {
  int64_t n_vertices, n_faces, n_corners;
} counts;

static counts count(const fs_mesh *mesh) {
  counts c = {mesh->n_vertices, 0, 0};
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    int32_t n = fs_mesh_face_size(mesh, f);
    c.n_vertices += n > 4;
    c.n_faces += n > 4 ? n : 1;
    c.n_corners += n > 4 ? 3 * n : n;
  }
  return c;
}

fs_status fs_gregory_split(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, fs_mesh **split,
                           fs_vec3 **split_normal, int32_t **face) {
  fs_status status = FS_OK;
  fs_vec3 *position = NULL, *axis = NULL;
  int32_t *start = NULL, *corner = NULL, *from = NULL, n_faces = 0, n_corners = 0, middle = mesh->n_vertices;
  counts c = count(mesh);
  fs_mesh *made = NULL;
  if (c.n_vertices == mesh->n_vertices) {
    *split = NULL, *split_normal = NULL, *face = NULL;
    return FS_OK;
  }
  if (c.n_corners > INT32_MAX / 4)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d half-edges split into triangles are more than can be numbered",
                   (int)mesh->n_halfedges);
  FS_ALLOC(ctx, position, c.n_vertices);
  FS_ALLOC(ctx, axis, c.n_vertices);
  FS_ALLOC(ctx, start, c.n_faces + 1);
  FS_ALLOC(ctx, from, c.n_faces);
  FS_ALLOC(ctx, corner, c.n_corners);
  memcpy(position, mesh->position, (size_t)mesh->n_vertices * sizeof *position);
  memcpy(axis, normal, (size_t)mesh->n_vertices * sizeof *axis);
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    int32_t first = mesh->face_start[f], n = fs_mesh_face_size(mesh, f);
    if (n <= 4) {
      for (int32_t k = 0; k < n; k++) corner[n_corners++] = mesh->origin[first + k];
      from[n_faces++] = f;
      start[n_faces] = n_corners;
      continue;
    }
    if (!find_middle(mesh, normal, f, &position[middle], &axis[middle])) {
      status = fs_fail(ctx, FS_ERR_NUMERIC, "the normals at the corners of face %d have no common outside", (int)f);
      goto done;
    }
    for (int32_t k = 0; k < n; k++) {
      corner[n_corners++] = mesh->origin[first + k];
      corner[n_corners++] = mesh->origin[first + (k + 1) % n];
      corner[n_corners++] = middle;
      from[n_faces++] = f;
      start[n_faces] = n_corners;
    }
    middle++;
  }
  FS_TRY(fs_mesh_create(ctx, middle, position, n_faces, start, corner, &made));
  *split = made;
  *split_normal = axis, axis = NULL;
  *face = from, from = NULL;
done:
  fs_release(ctx, position);
  fs_release(ctx, axis);
  fs_release(ctx, start);
  fs_release(ctx, from);
  fs_release(ctx, corner);
  return status;
}
