/* SPDX-License-Identifier: MIT */
/* Single role: a mesh from polygons, with every check that makes it an oriented manifold. The two half-edges of an edge
   meet by two counting sorts, by the larger and then by the smaller of their vertices, so the work is O(n). */
#include "mesh/mesh.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static fs_status check_positions(fs_context *ctx, int32_t n_vertices, const fs_vec3 *position) {
  for (int32_t v = 0; v < n_vertices; v++)
    if (!isfinite(position[v].x) || !isfinite(position[v].y) || !isfinite(position[v].z))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "vertex %d has a coordinate that is not finite", v);
  return FS_OK;
}

static fs_status check_face_starts(fs_context *ctx, int32_t n_faces, const int32_t *face_start) {
  if (face_start[0] != 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the corners of face 0 start at %d instead of 0", face_start[0]);
  for (int32_t f = 0; f < n_faces; f++) {
    if (face_start[f + 1] < face_start[f])
      return fs_fail(ctx, FS_ERR_ARGUMENT, "the corners of face %d end before they start", f);
    if (face_start[f + 1] - face_start[f] < 3)
      return fs_fail(ctx, FS_ERR_TOPOLOGY, "face %d has %d vertices, but a face needs 3 or more", f,
                     face_start[f + 1] - face_start[f]);
  }
  return FS_OK;
}

/* Indices in range, no vertex twice in a face, every vertex in some face. */
static fs_status check_corners(fs_context *ctx, int32_t n_vertices, int32_t n_faces, const int32_t *face_start,
                               const int32_t *corner) {
  fs_status status = FS_OK;
  int32_t *last_face = NULL; /* [n_vertices] 1 + the last face seen that uses the vertex */
  FS_ALLOC(ctx, last_face, n_vertices);
  for (int32_t f = 0; f < n_faces; f++)
    for (int32_t h = face_start[f]; h < face_start[f + 1]; h++) {
      int32_t v = corner[h];
      if (v < 0 || v >= n_vertices) {
        status = fs_fail(ctx, FS_ERR_ARGUMENT, "face %d uses vertex %d, but there are only %d", f, v, n_vertices);
        goto done;
      }
      if (last_face[v] == f + 1) {
        status = fs_fail(ctx, FS_ERR_TOPOLOGY, "face %d repeats vertex %d", f, v);
        goto done;
      }
      last_face[v] = f + 1;
    }
  for (int32_t v = 0; v < n_vertices; v++)
    if (last_face[v] == 0) {
      status = fs_fail(ctx, FS_ERR_TOPOLOGY, "vertex %d belongs to no face", v);
      goto done;
    }
done:
  fs_release(ctx, last_face);
  return status;
}

typedef enum end { SMALLER, LARGER } end;

static int32_t edge_end(const fs_mesh *mesh, int32_t h, end which) {
  int32_t a = mesh->origin[h], b = fs_mesh_target(mesh, h);
  return (a < b) == (which == SMALLER) ? a : b;
}

/* sorted[] = in[] (NULL: 0, 1, 2, …) in ascending order of one end of their edges; equal ones keep their order.
   start[n_vertices + 1] is work space. */
static void sort_by_end(const fs_mesh *mesh, end which, const int32_t *in, int32_t *start, int32_t *sorted) {
  memset(start, 0, ((size_t)mesh->n_vertices + 1) * sizeof *start);
  for (int32_t h = 0; h < mesh->n_halfedges; h++) start[edge_end(mesh, h, which) + 1]++;
  for (int32_t v = 0; v < mesh->n_vertices; v++) start[v + 1] += start[v];
  for (int32_t i = 0; i < mesh->n_halfedges; i++) {
    int32_t h = in == NULL ? i : in[i];
    sorted[start[edge_end(mesh, h, which)]++] = h;
  }
}

static fs_status refuse_edge(fs_context *ctx, const fs_mesh *mesh, const int32_t *h, int32_t n) {
  char more[32] = "";
  int32_t a = edge_end(mesh, h[0], SMALLER), b = edge_end(mesh, h[0], LARGER);
  if (n == 2)
    return fs_fail(ctx, FS_ERR_TOPOLOGY,
                   "faces %d and %d run along the edge between vertices %d and %d in the same direction: their "
                   "orientations disagree",
                   mesh->face[h[0]], mesh->face[h[1]], a, b);
  if (n > 3) snprintf(more, sizeof more, " and %d more", n - 3);
  return fs_fail(ctx, FS_ERR_TOPOLOGY, "non-manifold edge between vertices %d and %d (faces %d, %d, %d%s)", a, b,
                 mesh->face[h[0]], mesh->face[h[1]], mesh->face[h[2]], more);
}

/* Sets twin[] from origin[], face_start[] and face[]. */
static fs_status match_twins(fs_context *ctx, fs_mesh *mesh) {
  fs_status status = FS_OK;
  int32_t *start = NULL, *by_larger = NULL, *by_edge = NULL, n;
  FS_ALLOC(ctx, start, (size_t)mesh->n_vertices + 1);
  FS_ALLOC(ctx, by_larger, mesh->n_halfedges);
  FS_ALLOC(ctx, by_edge, mesh->n_halfedges);
  sort_by_end(mesh, LARGER, NULL, start, by_larger);
  sort_by_end(mesh, SMALLER, by_larger, start, by_edge);
  for (int32_t i = 0; i < mesh->n_halfedges; i += n) {
    const int32_t *h = by_edge + i;
    int32_t a = edge_end(mesh, h[0], SMALLER), b = edge_end(mesh, h[0], LARGER);
    for (n = 1; i + n < mesh->n_halfedges; n++)
      if (edge_end(mesh, h[n], SMALLER) != a || edge_end(mesh, h[n], LARGER) != b) break;
    if (n > 2 || (n == 2 && mesh->origin[h[0]] == mesh->origin[h[1]])) {
      status = refuse_edge(ctx, mesh, h, n);
      goto done;
    }
    mesh->twin[h[0]] = n == 2 ? h[1] : FS_NONE;
    if (n == 2) mesh->twin[h[1]] = h[0];
  }
done:
  fs_release(ctx, start);
  fs_release(ctx, by_larger);
  fs_release(ctx, by_edge);
  return status;
}

static void walk_fan(const fs_mesh *mesh, int32_t h, bool *seen) {
  for (; h != FS_NONE && !seen[h]; h = fs_mesh_rotate(mesh, h)) seen[h] = true;
}

/* Every vertex has one fan of faces: open fans are counted from their boundary half-edges, then the closed ones. */
static fs_status check_fans(fs_context *ctx, const fs_mesh *mesh) {
  fs_status status = FS_OK;
  int32_t *n_fans = NULL; /* [n_vertices] */
  bool *seen = NULL;      /* [n_halfedges] */
  FS_ALLOC(ctx, n_fans, mesh->n_vertices);
  FS_ALLOC(ctx, seen, mesh->n_halfedges);
  for (int pass = 0; pass < 2; pass++)
    for (int32_t h = 0; h < mesh->n_halfedges; h++)
      if (!seen[h] && (pass == 1 || mesh->twin[h] == FS_NONE)) {
        n_fans[mesh->origin[h]]++;
        walk_fan(mesh, h, seen);
      }
  for (int32_t v = 0; v < mesh->n_vertices; v++)
    if (n_fans[v] > 1) {
      status = fs_fail(ctx, FS_ERR_TOPOLOGY, "vertex %d is a bow-tie: %d fans of faces meet there", v, n_fans[v]);
      goto done;
    }
done:
  fs_release(ctx, n_fans);
  fs_release(ctx, seen);
  return status;
}

fs_status fs_mesh_create(fs_context *ctx, int32_t n_vertices, const fs_vec3 *position, int32_t n_faces,
                         const int32_t *face_start, const int32_t *corner, fs_mesh **mesh) {
  fs_status status = FS_OK;
  fs_mesh *m = NULL;
  if (n_vertices < 1 || n_faces < 1)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a mesh of %d vertices and %d faces is none: it needs at least one face",
                   n_vertices, n_faces);
  FS_TRY(check_positions(ctx, n_vertices, position));
  FS_TRY(check_face_starts(ctx, n_faces, face_start));
  FS_TRY(check_corners(ctx, n_vertices, n_faces, face_start, corner));
  FS_TRY(fs_mesh_allocate(ctx, n_vertices, n_faces, face_start[n_faces], &m));
  memcpy(m->position, position, (size_t)n_vertices * sizeof *position);
  memcpy(m->face_start, face_start, ((size_t)n_faces + 1) * sizeof *face_start);
  memcpy(m->origin, corner, (size_t)m->n_halfedges * sizeof *corner);
  fs_mesh_complete(m); /* face[] now; outgoing[] once more when twin[] is known */
  FS_TRY(match_twins(ctx, m));
  fs_mesh_complete(m);
  FS_TRY(check_fans(ctx, m));
  *mesh = m;
  m = NULL;
done:
  fs_mesh_free(ctx, m);
  return status;
}
