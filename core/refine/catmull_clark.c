/* SPDX-License-Identifier: MIT */
/* Single role: Catmull-Clark refinement with boundary curves as cubic B-splines.
   With the vertices of the split mesh (V a vertex, M a midpoint of an edge, C the centroid of a face), [Catmull Clark 1978]:
     face:            C
     edge inside:     (V1 + V2 + C1 + C2) / 4 = M / 2 + (C1 + C2) / 4
     edge at the rim: M
     vertex inside:   mean of C / n + 2 mean of M / n + (n - 3) V / n,  n = valence
     vertex at the rim: V / 2 + (M1 + M2) / 4, M1 and M2 on its two rim edges
   Vertices of the result: those of the mesh, then one per edge, then one per face; faces as in split.c. */
#include "refine/refine.h"

/* Rows by the vertices of the split mesh, filled in order. */
typedef struct masks {
  const fs_mesh *mesh, *split;
  const int32_t *edge; /* [n_halfedges] of mesh: vertex of the split mesh */
  fs_stencils rows;
  int32_t n_entries;
} masks;

static void put(masks *m, int32_t vertex, double weight) {
  m->rows.column[m->n_entries] = vertex;
  m->rows.weight[m->n_entries++] = weight;
}

static int32_t centre(const masks *m, int32_t h) { return m->split->n_vertices - m->mesh->n_faces + m->mesh->face[h]; }

static void mask_vertex_inside(masks *m, int32_t v) {
  double n = fs_mesh_valence(m->mesh, v);
  int32_t first = m->mesh->outgoing[v], h = first;
  put(m, v, (n - 3) / n);
  do {
    put(m, m->edge[h], 2 / (n * n));
    put(m, centre(m, h), 1 / (n * n));
    h = fs_mesh_rotate(m->mesh, h);
  } while (h != first);
}

static void mask_vertex_rim(masks *m, int32_t v) {
  int32_t first = m->mesh->outgoing[v], last = first;
  for (int32_t h = first; h != FS_NONE; h = fs_mesh_rotate(m->mesh, h)) last = h;
  put(m, v, 0.5);
  put(m, m->edge[first], 0.25);
  put(m, m->edge[fs_mesh_previous(m->mesh, last)], 0.25);
}

static void mask_edge(masks *m, int32_t h) {
  int32_t twin = m->mesh->twin[h];
  if (twin == FS_NONE) {
    put(m, m->edge[h], 1);
    return;
  }
  put(m, m->edge[h], 0.5);
  put(m, centre(m, h), 0.25);
  put(m, centre(m, twin), 0.25);
}

static fs_status make_masks(fs_context *ctx, const fs_mesh *mesh, const fs_mesh *split, const int32_t *edge,
                            fs_stencils *rows) {
  masks m = {.mesh = mesh, .split = split, .edge = edge};
  int64_t n_entries = (int64_t)mesh->n_vertices + 5 * (int64_t)mesh->n_halfedges + mesh->n_faces;
  int32_t row = mesh->n_vertices;
  fs_status status = FS_OK;
  /* A vertex of n faces has at most 1 + 2 n, an edge 3, a face 1. */
  if (n_entries > INT32_MAX)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the matrix of the refinement would have more than %d entries", INT32_MAX);
  FS_TRY(fs_stencils_allocate(ctx, split->n_vertices, split->n_vertices, (int32_t)n_entries, &m.rows));
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    m.rows.start[v] = m.n_entries;
    if (fs_mesh_is_boundary(mesh, v))
      mask_vertex_rim(&m, v);
    else
      mask_vertex_inside(&m, v);
  }
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    if (edge[h] != row) continue; /* the other half-edge of an earlier edge */
    m.rows.start[row++] = m.n_entries;
    mask_edge(&m, h);
  }
  for (; row < split->n_vertices; row++) {
    m.rows.start[row] = m.n_entries;
    put(&m, row, 1);
  }
  m.rows.start[row] = m.n_entries;
  *rows = m.rows;
done:
  return status;
}

static fs_status refine(fs_context *ctx, const fs_mesh *mesh, const double *param, fs_refinement **refinement) {
  fs_mesh *split = NULL;
  int32_t *edge = NULL;
  fs_stencils midpoints = {0}, rows = {0}, product = {0};
  fs_status status = FS_OK;
  (void)param; /* it has none */
  FS_TRY(fs_mesh_split(ctx, mesh, &split, &edge));
  FS_TRY(fs_mesh_split_stencils(ctx, mesh, split, edge, &midpoints));
  FS_TRY(make_masks(ctx, mesh, split, edge, &rows));
  FS_TRY(fs_stencils_multiply(ctx, &rows, &midpoints, &product));
  FS_TRY(fs_refinement_assemble(ctx, mesh, &split, &product, refinement));
done:
  fs_release(ctx, edge);
  fs_mesh_free(ctx, split);
  fs_stencils_release(ctx, &midpoints);
  fs_stencils_release(ctx, &rows);
  fs_stencils_release(ctx, &product);
  return status;
}

const fs_refiner fs_refiner_catmull_clark = {
    .name = "catmull-clark",
    .summary = "Catmull-Clark refinement, boundary curves as cubic B-splines",
    .params = (const fs_param[]){{.name = NULL}},
    .refine = refine,
};
