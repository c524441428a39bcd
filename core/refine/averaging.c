/* SPDX-License-Identifier: MIT */
/* Single role: refinement by doubling and n averagings, n = 1 .. 16, after [Lane Riesenfeld 1980], on meshes.
   Doubling makes a face of every vertex, edge and face; the first averaging replaces that by its dual: one quadrilateral
   per corner of the mesh with bilinear midpoints, which split.c makes at once, rims included. Every further averaging
   takes the dual:
     new vertices = centroids of the old faces that touch an inner vertex, in their order,
     new faces    = inner old vertices, in their order, around them anticlockwise.
   So for n odd the vertices are, in this order, (what is left of) old vertices, edges, faces, and the faces are corners
   (half-edges); for n even the other way round. Old faces whose inner vertices form several runs along their rim
   would become a vertex with several fans of faces: there every run gets a copy of the vertex.
   On a regular grid the masks are those of uniform tensor B-splines of degree n, binomials(n + 1) / 2^n.

   Half-edges in closed form. The new half-edge of an old half-edge h with inner origin v belongs to the new face v,
   leaves the centroid of the face of h and crosses prev(h) into the face of rotate(h). The new half-edge the other way
   belongs to the other end w of prev(h) and is that of next(twin(prev(h))); there is none if w is no inner vertex. */
#include "refine/refine.h"

#include <math.h>

/* One dual step under way. */
typedef struct dual {
  const fs_mesh *old;
  int32_t *vertex;   /* [old n_halfedges] new vertex of a corner, FS_NONE where the old vertex is at the rim */
  int32_t *halfedge; /* [old n_halfedges] new half-edge, or FS_NONE */
  int32_t *from;     /* [n_vertices] old face of a new vertex */
  int32_t n_vertices, n_faces, n_halfedges;
} dual;

static bool is_inner(const fs_mesh *mesh, int32_t h) { return !fs_mesh_is_boundary(mesh, mesh->origin[h]); }

/* Gives each run of inner corners of the face a new vertex; a face with inner corners only is one run. */
static void number_runs(dual *d, int32_t face) {
  int32_t begin = d->old->face_start[face], end = d->old->face_start[face + 1], first = d->n_vertices;
  int32_t vertex = FS_NONE;
  for (int32_t h = begin; h < end; h++) {
    if (!is_inner(d->old, h)) {
      vertex = FS_NONE;
    } else if (vertex == FS_NONE) {
      d->from[d->n_vertices] = face;
      vertex = d->n_vertices++;
    }
    d->vertex[h] = vertex;
  }
  /* The last run goes on at the first corner: it is the run of that corner, unless it is that already. */
  if (vertex == FS_NONE || vertex == first || d->vertex[begin] == FS_NONE) return;
  for (int32_t h = end - 1; d->vertex[h] == vertex; h--) d->vertex[h] = first;
  d->n_vertices--;
}

static void number_elements(dual *d) {
  for (int32_t f = 0; f < d->old->n_faces; f++) number_runs(d, f);
  for (int32_t h = 0; h < d->old->n_halfedges; h++) d->halfedge[h] = FS_NONE;
  for (int32_t v = 0; v < d->old->n_vertices; v++) {
    int32_t first = d->old->outgoing[v], h = first;
    if (!is_inner(d->old, first)) continue;
    do {
      d->halfedge[h] = d->n_halfedges++;
      h = fs_mesh_rotate(d->old, h);
    } while (h != first);
    d->n_faces++;
  }
}

static void fill_mesh(const dual *d, fs_mesh *mesh) {
  int32_t n_faces = 0;
  for (int32_t v = 0; v < d->old->n_vertices; v++) {
    int32_t first = d->old->outgoing[v], n = d->halfedge[first], h = first;
    if (n == FS_NONE) continue;
    do {
      int32_t across = fs_mesh_next(d->old, fs_mesh_rotate(d->old, h)); /* it leaves the other end of prev(h) */
      mesh->origin[n] = d->vertex[h];
      mesh->twin[n++] = d->halfedge[across];
      h = fs_mesh_rotate(d->old, h);
    } while (h != first);
    mesh->face_start[++n_faces] = n;
  }
  fs_mesh_complete(mesh);
}

/* The rows of the centroids: each old vertex of the face with the same weight. */
static fs_status make_centroids(fs_context *ctx, const dual *d, fs_stencils *rows) {
  fs_stencils result = {0};
  int64_t n_entries = 0;
  int32_t place = 0;
  fs_status status = FS_OK;
  for (int32_t i = 0; i < d->n_vertices; i++) n_entries += fs_mesh_face_size(d->old, d->from[i]);
  if (n_entries > INT32_MAX)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the matrix of the refinement would have more than %d entries", INT32_MAX);
  FS_TRY(fs_stencils_allocate(ctx, d->n_vertices, d->old->n_vertices, (int32_t)n_entries, &result));
  for (int32_t i = 0; i < d->n_vertices; i++) {
    int32_t f = d->from[i], size = fs_mesh_face_size(d->old, f);
    result.start[i] = place;
    for (int32_t j = 0; j < size; j++) {
      result.column[place] = d->old->origin[d->old->face_start[f] + j];
      result.weight[place++] = 1.0 / size;
    }
  }
  result.start[d->n_vertices] = place;
  *rows = result;
done:
  return status;
}

/* Replaces the mesh by its dual, and rows by the rows of the new vertices. */
static fs_status average(fs_context *ctx, fs_mesh **mesh, fs_stencils *rows) {
  dual d = {.old = *mesh};
  fs_mesh *result = NULL;
  fs_stencils centroids = {0}, product = {0};
  fs_status status = FS_OK;
  FS_ALLOC(ctx, d.vertex, d.old->n_halfedges);
  FS_ALLOC(ctx, d.halfedge, d.old->n_halfedges);
  FS_ALLOC(ctx, d.from, d.old->n_halfedges);
  number_elements(&d);
  if (d.n_faces == 0) {
    status =
        fs_fail(ctx, FS_ERR_UNSUPPORTED, "the averagings leave no face: the mesh is too narrow inside its boundary");
    goto done;
  }
  FS_TRY(make_centroids(ctx, &d, &centroids));
  FS_TRY(fs_stencils_multiply(ctx, &centroids, rows, &product));
  FS_TRY(fs_mesh_allocate(ctx, d.n_vertices, d.n_faces, d.n_halfedges, &result));
  fill_mesh(&d, result);
  fs_mesh_free(ctx, *mesh);
  fs_stencils_release(ctx, rows);
  *mesh = result;
  *rows = product;
  product = (fs_stencils){0};
done:
  fs_release(ctx, d.vertex);
  fs_release(ctx, d.halfedge);
  fs_release(ctx, d.from);
  fs_stencils_release(ctx, &centroids);
  fs_stencils_release(ctx, &product);
  return status;
}

/* An inner vertex of valence 2 would become a face of two corners. */
static fs_status check_valences(fs_context *ctx, const fs_mesh *mesh) {
  for (int32_t v = 0; v < mesh->n_vertices; v++)
    if (!fs_mesh_is_boundary(mesh, v) && fs_mesh_valence(mesh, v) < 3)
      return fs_fail(ctx, FS_ERR_UNSUPPORTED, "vertex %d inside the mesh has only %d edges; averaging needs 3", v,
                     fs_mesh_valence(mesh, v));
  return FS_OK;
}

static fs_status refine(fs_context *ctx, const fs_mesh *mesh, const double *param, fs_refinement **refinement) {
  fs_mesh *fine = NULL;
  int32_t *edge = NULL;
  fs_stencils rows = {0};
  fs_status status = FS_OK;
  if (param[0] != floor(param[0]))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the number of averagings is not whole: %g", param[0]);
  FS_TRY(check_valences(ctx, mesh));
  FS_TRY(fs_mesh_split(ctx, mesh, &fine, &edge));
  FS_TRY(fs_mesh_split_stencils(ctx, mesh, fine, edge, &rows));
  for (int32_t i = 1; i < (int32_t)param[0]; i++) FS_TRY(average(ctx, &fine, &rows));
  FS_TRY(fs_refinement_assemble(ctx, mesh, &fine, &rows, refinement));
done:
  fs_release(ctx, edge);
  fs_mesh_free(ctx, fine);
  fs_stencils_release(ctx, &rows);
  return status;
}

const fs_refiner fs_refiner_averaging = {
    .name = "averaging",
    .summary = "doubling followed by averagings: B-spline refinement of any degree, on any mesh",
    .params = (const fs_param[]){{.name = "averagings",
                                  .summary = "how many; the degree on a regular grid",
                                  .initial = 3,
                                  .min = 1,
                                  .max = 16},
                                 {.name = NULL}},
    .refine = refine,
};
