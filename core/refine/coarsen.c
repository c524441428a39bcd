/* SPDX-License-Identifier: MIT */
/* Single role: the coarse mesh of which a mesh may be the refinement, by its connectivity alone [Taubin 2002],
   and the matrix of three averagings.

   Refinement by three averagings, or by Catmull-Clark, leaves a mesh of quadrilaterals with three kinds of vertices: old
   vertices V, edges E of valence 4, faces F; around every quadrilateral they come as V E F E. One vertex whose kind is guessed
   settles the kinds of its component; a mesh where this leads to a contradiction is no refinement. The coarse faces are those
   of the inner F. */
#include "refine/refine.h"

enum { UNKNOWN, OLD, EDGE, FACE };

typedef struct coarsening {
  fs_context *ctx;
  const fs_mesh *fine;
  uint8_t *kind;   /* [n_vertices] */
  int32_t *queue;  /* [n_vertices] vertices of kind OLD and FACE whose faces are being settled */
  int32_t n_queue; /* of the present component */
  int32_t *coarse; /* [n_vertices] coarse vertex of those of kind OLD, or FS_NONE */
} coarsening;

/* ---- kinds ------------------------------------------------------------------------------------------------------- */

static bool settle(coarsening *c, int32_t vertex, uint8_t kind) {
  if (c->kind[vertex] != UNKNOWN) return c->kind[vertex] == kind;
  if (kind == EDGE && fs_mesh_valence(c->fine, vertex) != 4 && !fs_mesh_is_boundary(c->fine, vertex)) return false;
  c->kind[vertex] = kind;
  c->queue[c->n_queue++] = vertex;
  return true;
}

/* Settles all that follows from the first vertex of the queue. Special vertices of kind FACE are counted: a coarse mesh with
   fewer of them is closer to a mesh of quadrilaterals. */
static bool spread(coarsening *c, int32_t *n_special_faces) {
  *n_special_faces = 0;
  for (int32_t i = 0; i < c->n_queue; i++) {
    int32_t v = c->queue[i], first = c->fine->outgoing[v], h = first;
    if (c->kind[v] == EDGE) continue;
    if (c->kind[v] == FACE && !fs_mesh_is_boundary(c->fine, v) && fs_mesh_valence(c->fine, v) != 4) ++*n_special_faces;
    do {
      int32_t next = fs_mesh_next(c->fine, h), opposite = fs_mesh_next(c->fine, next);
      if (!settle(c, c->fine->origin[next], EDGE) ||
          !settle(c, c->fine->origin[opposite], c->kind[v] == OLD ? FACE : OLD) ||
          !settle(c, c->fine->origin[fs_mesh_next(c->fine, opposite)], EDGE))
        return false;
      h = fs_mesh_rotate(c->fine, h);
    } while (h != FS_NONE && h != first);
  }
  return true;
}

static void forget(coarsening *c) {
  while (c->n_queue > 0) c->kind[c->queue[--c->n_queue]] = UNKNOWN;
}

/* Settles the component of a vertex in the best of the four ways there are. */
static bool settle_component(coarsening *c, int32_t vertex) {
  int32_t neighbour = fs_mesh_target(c->fine, c->fine->outgoing[vertex]), best = -1, fewest = INT32_MAX, n;
  for (int32_t way = 0; way < 4; way++) {
    c->n_queue = 0;
    if (settle(c, way < 2 ? vertex : neighbour, way % 2 == 0 ? OLD : FACE) && spread(c, &n) && n < fewest) {
      fewest = n;
      best = way;
    }
    forget(c);
  }
  if (best < 0) return false;
  settle(c, best < 2 ? vertex : neighbour, best % 2 == 0 ? OLD : FACE);
  spread(c, &n);
  c->n_queue = 0;
  return true;
}

/* ---- the coarse mesh --------------------------------------------------------------------------------------------- */

/* The old vertex across the fine face of a half-edge that leaves a vertex of kind FACE. */
static int32_t old_across(const fs_mesh *fine, int32_t h) {
  return fine->origin[fs_mesh_next(fine, fs_mesh_next(fine, h))];
}

static bool is_inner_face(const coarsening *c, int32_t v) {
  return c->kind[v] == FACE && !fs_mesh_is_boundary(c->fine, v);
}

static fs_status make_coarse(coarsening *c, fs_mesh **coarse) {
  fs_status status = FS_OK;
  const fs_mesh *fine = c->fine;
  int32_t n_faces = 0, n_corners = 0, n_vertices = 0, *start = NULL, *corner = NULL;
  fs_vec3 *position = NULL;
  *coarse = NULL;
  for (int32_t v = 0; v < fine->n_vertices; v++) {
    c->coarse[v] = FS_NONE;
    if (!is_inner_face(c, v)) continue;
    n_faces++;
    n_corners += fs_mesh_valence(fine, v);
  }
  if (n_faces == 0) return FS_OK;
  FS_ALLOC(c->ctx, start, (size_t)n_faces + 1);
  FS_ALLOC(c->ctx, corner, n_corners);
  FS_ALLOC(c->ctx, position, fine->n_vertices);
  n_faces = n_corners = 0;
  for (int32_t v = 0; v < fine->n_vertices; v++) {
    if (!is_inner_face(c, v)) continue;
    int32_t first = fine->outgoing[v], h = first;
    do {
      int32_t old = old_across(fine, h);
      if (c->coarse[old] == FS_NONE) {
        position[n_vertices] = fine->position[old];
        c->coarse[old] = n_vertices++;
      }
      corner[n_corners++] = c->coarse[old];
      h = fs_mesh_rotate(fine, h);
    } while (h != first);
    start[++n_faces] = n_corners;
  }
  status = fs_mesh_create(c->ctx, n_vertices, position, n_faces, start, corner, coarse);
  if (status == FS_ERR_TOPOLOGY || status == FS_ERR_ARGUMENT) { /* the rim cut faces apart: nothing to build on */
    c->ctx->message[0] = '\0';
    *coarse = NULL;
    status = FS_OK;
  }
done:
  fs_release(c->ctx, start);
  fs_release(c->ctx, corner);
  fs_release(c->ctx, position);
  return status;
}

/* ---- rows -------------------------------------------------------------------------------------------------------- */

typedef struct row {
  int32_t n, *column;
  double *weight;
} row;

static void add(row *r, int32_t column, double weight) {
  if (column == FS_NONE) return; /* beyond the rim */
  for (int32_t i = 0; i < r->n; i++)
    if (r->column[i] == column) {
      r->weight[i] += weight;
      return;
    }
  r->column[r->n] = column;
  r->weight[r->n++] = weight;
}

/* weight times the old vertex, the midpoint of the coarse edge, or the centroid of the coarse face of vertex v. */
static void add_split(const coarsening *c, int32_t v, double weight, row *r) {
  const fs_mesh *fine = c->fine;
  int32_t first = fine->outgoing[v], h = first;
  if (c->kind[v] == OLD) {
    add(r, c->coarse[v], weight);
    return;
  }
  weight /= c->kind[v] == EDGE ? 2 : fs_mesh_is_boundary(fine, v) ? 4 : fs_mesh_valence(fine, v);
  do {
    int32_t old = c->kind[v] == EDGE ? fs_mesh_target(fine, h) : old_across(fine, h);
    if (c->kind[old] == OLD) add(r, c->coarse[old], weight);
    h = fs_mesh_rotate(fine, h);
  } while (h != FS_NONE && h != first);
}

/* Two averagings of the split mesh: the mean of the centroids of the faces around v. */
static void fill_row(const coarsening *c, int32_t v, row *r) {
  int32_t first = c->fine->outgoing[v], h = first;
  double weight = 0.25 / fs_mesh_valence(c->fine, v);
  r->n = 0;
  do {
    int32_t k = h;
    for (int i = 0; i < 4; i++, k = fs_mesh_next(c->fine, k)) add_split(c, c->fine->origin[k], weight, r);
    h = fs_mesh_rotate(c->fine, h);
  } while (h != first);
}

static int64_t bound_of_row(const coarsening *c, int32_t v) {
  int32_t first = c->fine->outgoing[v], h = first;
  int64_t n = 0;
  if (fs_mesh_is_boundary(c->fine, v)) return 0;
  do {
    int32_t k = h;
    for (int i = 0; i < 4; i++, k = fs_mesh_next(c->fine, k)) {
      int32_t corner = c->fine->origin[k];
      n += c->kind[corner] == OLD ? 1 : c->kind[corner] == EDGE ? 2 : fs_mesh_valence(c->fine, corner);
    }
    h = fs_mesh_rotate(c->fine, h);
  } while (h != first);
  return n;
}

static fs_status make_rows(const coarsening *c, int32_t n_coarse, fs_stencils *stencils) {
  fs_status status = FS_OK;
  fs_stencils s = {0};
  int64_t bound = 0;
  int32_t n = 0;
  for (int32_t v = 0; v < c->fine->n_vertices; v++) bound += bound_of_row(c, v);
  if (bound > INT32_MAX)
    return fs_fail(c->ctx, FS_ERR_UNSUPPORTED, "the matrix of the refinement would have more than %d entries",
                   INT32_MAX);
  FS_TRY(fs_stencils_allocate(c->ctx, c->fine->n_vertices, n_coarse, (int32_t)bound, &s));
  for (int32_t v = 0; v < c->fine->n_vertices; v++) {
    row r = {0, s.column + n, s.weight + n};
    s.start[v] = n;
    if (fs_mesh_is_boundary(c->fine, v)) continue;
    fill_row(c, v, &r);
    n += r.n;
  }
  s.start[c->fine->n_vertices] = n;
  *stencils = s;
done:
  return status;
}

fs_status fs_mesh_coarsen(fs_context *ctx, const fs_mesh *fine, fs_mesh **coarse, fs_stencils *stencils,
                          int32_t **origin) {
  fs_status status = FS_OK;
  coarsening c = {.ctx = ctx, .fine = fine};
  fs_mesh *mesh = NULL;
  int32_t *old = NULL;
  *coarse = NULL;
  for (int32_t f = 0; f < fine->n_faces; f++)
    if (fs_mesh_face_size(fine, f) != 4) return FS_OK;
  FS_ALLOC(ctx, c.kind, fine->n_vertices);
  FS_ALLOC(ctx, c.queue, fine->n_vertices);
  FS_ALLOC(ctx, c.coarse, fine->n_vertices);
  for (int32_t v = 0; v < fine->n_vertices; v++)
    if (c.kind[v] == UNKNOWN && !settle_component(&c, v)) goto done;
  FS_TRY(make_coarse(&c, &mesh));
  if (mesh == NULL) goto done;
  FS_ALLOC(ctx, old, mesh->n_vertices);
  for (int32_t v = 0; v < fine->n_vertices; v++)
    if (c.coarse[v] != FS_NONE) old[c.coarse[v]] = v;
  FS_TRY(make_rows(&c, mesh->n_vertices, stencils));
  *coarse = mesh;
  *origin = old;
  mesh = NULL;
  old = NULL;
done:
  fs_mesh_free(ctx, mesh);
  fs_release(ctx, old);
  fs_release(ctx, c.kind);
  fs_release(ctx, c.queue);
  fs_release(ctx, c.coarse);
  return status;
}
