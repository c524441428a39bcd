/* SPDX-License-Identifier: MIT */
/* Single role: the connectivity of one quadrilateral per corner of a mesh, and the stencils of its midpoints.

           centre f --- 4h + 1 --- edge h           Half-edge h of the mesh leaves the vertex at the bottom left.
              |                      |              Face h of the result has the half-edges
              | 4h + 2        4h + 1 |                4h:     origin of h       -> edge of h
              |                      |                4h + 1: edge of h         -> centre of the face
        edge prev(h) -- 4h + 3 -- origin h            4h + 2: centre            -> edge of previous h
                                                      4h + 3: edge of previous h -> origin of h
   Twins in closed form, so that two edges between the same vertices do no harm. With t = twin(h):
     twin(4h) = 4 next(t) + 3, twin(4h + 1) = 4 next(h) + 2, twin(4h + 2) = 4 prev(h) + 1, twin(4h + 3) = 4 twin(prev(h)).
 */
#include "refine/refine.h"

/* Numbers the edges from first on by their lowest half-edge; returns the number behind the last. */
static int32_t number_edges(const fs_mesh *mesh, int32_t first, int32_t *edge) {
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    int32_t t = mesh->twin[h];
    edge[h] = t == FS_NONE || h < t ? first++ : edge[t];
  }
  return first;
}

static void fill_quad(const fs_mesh *mesh, int32_t h, const int32_t *edge, int32_t first_face, fs_mesh *split) {
  int32_t next = fs_mesh_next(mesh, h), previous = fs_mesh_previous(mesh, h);
  int32_t t = mesh->twin[h], s = mesh->twin[previous];
  int32_t *origin = split->origin + 4 * h, *twin = split->twin + 4 * h;
  origin[0] = mesh->origin[h];
  origin[1] = edge[h];
  origin[2] = first_face + mesh->face[h];
  origin[3] = edge[previous];
  twin[0] = t == FS_NONE ? FS_NONE : 4 * fs_mesh_next(mesh, t) + 3;
  twin[1] = 4 * next + 2;
  twin[2] = 4 * previous + 1;
  twin[3] = s == FS_NONE ? FS_NONE : 4 * s;
  split->face_start[h + 1] = 4 * (h + 1);
}

fs_status fs_mesh_split(fs_context *ctx, const fs_mesh *mesh, fs_mesh **split, int32_t **edge) {
  int32_t *number = NULL, n_halfedges = mesh->n_halfedges, first_face;
  fs_mesh *result = NULL;
  fs_status status = FS_OK;
  /* n_vertices + n_edges + n_faces stays below 4 n_halfedges, as every vertex has a half-edge. */
  if (n_halfedges > INT32_MAX / 4)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the refined mesh of %d half-edges would have more than %d", n_halfedges,
                   INT32_MAX);
  FS_ALLOC(ctx, number, n_halfedges);
  first_face = number_edges(mesh, mesh->n_vertices, number);
  FS_TRY(fs_mesh_allocate(ctx, first_face + mesh->n_faces, n_halfedges, 4 * n_halfedges, &result));
  for (int32_t h = 0; h < n_halfedges; h++) fill_quad(mesh, h, number, first_face, result);
  fs_mesh_complete(result);
  *split = result;
  *edge = number;
  number = NULL;
done:
  fs_release(ctx, number);
  return status;
}

static void put(fs_stencils *stencils, int32_t *place, int32_t column, double weight) {
  stencils->column[*place] = column;
  stencils->weight[(*place)++] = weight;
}

fs_status fs_mesh_split_stencils(fs_context *ctx, const fs_mesh *mesh, const fs_mesh *split, const int32_t *edge,
                                 fs_stencils *stencils) {
  int32_t n_edges = split->n_vertices - mesh->n_vertices - mesh->n_faces;
  int32_t place = 0, row = mesh->n_vertices;
  fs_stencils result = {0};
  fs_status status = fs_stencils_allocate(ctx, split->n_vertices, mesh->n_vertices,
                                          mesh->n_vertices + 2 * n_edges + mesh->n_halfedges, &result);
  if (status != FS_OK) return status;
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    result.start[v] = place;
    put(&result, &place, v, 1);
  }
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    if (edge[h] != row) continue; /* the other half-edge of an earlier edge */
    result.start[row++] = place;
    put(&result, &place, mesh->origin[h], 0.5);
    put(&result, &place, fs_mesh_target(mesh, h), 0.5);
  }
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    result.start[row++] = place;
    for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; h++)
      put(&result, &place, mesh->origin[h], 1.0 / fs_mesh_face_size(mesh, f));
  }
  result.start[row] = place;
  *stencils = result;
  return FS_OK;
}
