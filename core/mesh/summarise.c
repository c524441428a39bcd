/* SPDX-License-Identifier: MIT */
/* Single role: counts of a mesh. Genus: a component of genus g with b boundary loops has V - E + F = 2 - 2 g - b; summed
   over the components that gives the sum of the genera. */
#include "mesh/mesh.h"

enum { BINS = 26 };

static int32_t bin(int32_t n) { return n < BINS - 1 ? n : BINS - 1; }

/* Floods the faces across their edges; stack[n_faces] is work space, seen[n_faces] starts false. */
static int32_t count_components(const fs_mesh *mesh, int32_t *stack, bool *seen) {
  int32_t n_components = 0, n_stack;
  for (int32_t seed = 0; seed < mesh->n_faces; seed++) {
    if (seen[seed]) continue;
    n_components++;
    n_stack = 1;
    stack[0] = seed;
    seen[seed] = true;
    while (n_stack > 0) {
      int32_t f = stack[--n_stack];
      for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; h++) {
        int32_t g = mesh->twin[h] == FS_NONE ? f : mesh->face[mesh->twin[h]];
        if (seen[g]) continue;
        seen[g] = true;
        stack[n_stack++] = g;
      }
    }
  }
  return n_components;
}

/* A boundary vertex has one boundary half-edge that leaves it, its first one; seen[n_vertices] starts false. */
static int32_t count_boundary_loops(const fs_mesh *mesh, bool *seen) {
  int32_t n_loops = 0;
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    if (seen[v] || !fs_mesh_is_boundary(mesh, v)) continue;
    n_loops++;
    for (int32_t w = v; !seen[w]; w = fs_mesh_target(mesh, mesh->outgoing[w])) seen[w] = true;
  }
  return n_loops;
}

static void count_vertices(const fs_mesh *mesh, fs_mesh_summary *s) {
  s->min = s->max = mesh->position[0];
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    fs_vec3 p = mesh->position[v];
    bool is_boundary = fs_mesh_is_boundary(mesh, v);
    (is_boundary ? s->valence_boundary : s->valence_interior)[bin(fs_mesh_valence(mesh, v))]++;
    s->n_boundary_vertices += is_boundary;
    if (p.x < s->min.x) s->min.x = p.x;
    if (p.y < s->min.y) s->min.y = p.y;
    if (p.z < s->min.z) s->min.z = p.z;
    if (p.x > s->max.x) s->max.x = p.x;
    if (p.y > s->max.y) s->max.y = p.y;
    if (p.z > s->max.z) s->max.z = p.z;
  }
}

fs_status fs_mesh_summarise(fs_context *ctx, const fs_mesh *mesh, fs_mesh_summary *summary) {
  fs_status status = FS_OK;
  fs_mesh_summary s = {.n_vertices = mesh->n_vertices, .n_faces = mesh->n_faces};
  int32_t *stack = NULL;
  bool *seen_face = NULL, *seen_vertex = NULL;
  FS_ALLOC(ctx, stack, mesh->n_faces);
  FS_ALLOC(ctx, seen_face, mesh->n_faces);
  FS_ALLOC(ctx, seen_vertex, mesh->n_vertices);
  for (int32_t h = 0; h < mesh->n_halfedges; h++) s.n_edges += mesh->twin[h] == FS_NONE || h < mesh->twin[h];
  for (int32_t f = 0; f < mesh->n_faces; f++) s.face_size[bin(fs_mesh_face_size(mesh, f))]++;
  s.n_triangles = s.face_size[3];
  s.n_quads = s.face_size[4];
  count_vertices(mesh, &s);
  s.n_components = count_components(mesh, stack, seen_face);
  s.n_boundary_loops = count_boundary_loops(mesh, seen_vertex);
  s.genus =
      (int32_t)((2 * (int64_t)s.n_components - s.n_boundary_loops - ((int64_t)s.n_vertices - s.n_edges + s.n_faces)) /
                2);
  *summary = s;
done:
  fs_release(ctx, stack);
  fs_release(ctx, seen_face);
  fs_release(ctx, seen_vertex);
  return status;
}
