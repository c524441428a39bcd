/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the filter that closes selected boundary loops of n edges by n-gons and refines the mesh once, so that in the
   middle of each lies a vertex of valence n with quadrilaterals around it, which takes a G2 cap. */
#include "build.h"
#include "filters.h"

#include <stdlib.h>
#include <string.h>

enum { NEW_LAYER };
enum { MOST_EDGES = 24 };

/* The boundary half-edge that follows h around the hole; h and the result have no twin. */
static int32_t next_at_hole(const fs_mesh *mesh, int32_t h) {
  /* the half-edges without twin that leave a vertex are its outgoing one, as there is one fan at each vertex */
  return mesh->outgoing[fs_mesh_target(mesh, h)];
}

/* Counts the edges of the loop of h and, where corner is not NULL, writes the face that closes it; 0: not all vertices are
   selected. */
static int32_t walk_loop(const fs_mesh *mesh, const bool *selected, int32_t h, bool *is_seen, int32_t *corner) {
  int32_t n = 0, g = h;
  bool is_whole = true;
  do {
    is_seen[g] = true;
    is_whole &= selected[mesh->origin[g]];
    n++;
    g = next_at_hole(mesh, g);
  } while (g != h);
  if (!is_whole) return 0;
  for (int32_t i = 0; corner != NULL && i < n; i++) { /* against the half-edges of the faces around it */
    corner[n - 1 - i] = mesh->origin[g];
    g = next_at_hole(mesh, g);
  }
  return n;
}

/* p: the faces of the mesh, and those that close its loops. */
static fs_status close_loops(fs_context *ctx, const fs_mesh *mesh, const bool *selected, polygon_list *p,
                             int32_t *n_closed, outcome *o) {
  fs_status status = FS_OK;
  bool *is_seen = NULL;
  size_t start;
  TAKE(ctx, is_seen, mesh->n_halfedges);
  TAKE(ctx, p->face_start, (size_t)mesh->n_faces + (size_t)mesh->n_halfedges + 1);
  TAKE(ctx, p->corner, 2 * (size_t)mesh->n_halfedges);
  p->n_faces = mesh->n_faces;
  memcpy(p->face_start, mesh->face_start, ((size_t)mesh->n_faces + 1) * sizeof *p->face_start);
  memcpy(p->corner, mesh->origin, (size_t)mesh->n_halfedges * sizeof *p->corner);
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    int32_t n;
    if (mesh->twin[h] != FS_NONE || is_seen[h]) continue;
    start = (size_t)p->face_start[p->n_faces];
    n = walk_loop(mesh, selected, h, is_seen, p->corner + start);
    if (n == 0) continue;
    if (n > MOST_EDGES) {
      status = refuse(ctx, FS_ERR_UNSUPPORTED, "the boundary loop at vertex %d has %d edges: 3 to %d are possible",
                      mesh->origin[h], n, MOST_EDGES);
      goto done;
    }
    p->face_start[++p->n_faces] = (int32_t)start + n;
    ++*n_closed;
    outcome_say(o, "a loop of %d edges is closed\n", n);
  }
  if (*n_closed == 0)
    status = refuse(ctx, FS_ERR_ARGUMENT, "no boundary loop is selected as a whole: select all its vertices");
done:
  free(is_seen);
  return status;
}

static fs_status run(fs_context *ctx, const layer *l, const double *param, outcome *o) {
  fs_status status = FS_OK;
  fs_mesh *mesh = NULL, *closed = NULL;
  fs_refinement *fine = NULL;
  polygon_list p = {0};
  int32_t n_closed = 0;
  TRY(layer_to_mesh(ctx, l, &mesh));
  TRY(close_loops(ctx, mesh, l->selected, &p, &n_closed, o));
  TRY(fs_mesh_create(ctx, mesh->n_vertices, mesh->position, p.n_faces, p.face_start, p.corner, &closed));
  TRY(fs_mesh_refine(ctx, closed, "catmull-clark", NULL, &fine));
  TRY(outcome_take_mesh(ctx, fine->mesh, o));
  o->in_new_layer = param[NEW_LAYER] != 0;
  o->suffix = "filled";
  outcome_say(o, "refined once: %d vertices, %d faces\n", o->polygons.n_vertices, o->polygons.n_faces);
  outcome_add(o, "loops", n_closed);
  outcome_add(o, "faces", o->polygons.n_faces);
done:
  fs_refinement_free(ctx, fine);
  fs_mesh_free(ctx, closed);
  fs_mesh_free(ctx, mesh);
  polygons_clear(&p);
  return status;
}

const filter filter_fill_hole = {
    .name = "Fairsurf: Fill hole",
    .python_name = "fairsurf_fill_hole",
    .help =
        "Closes every boundary loop of 3 to 24 edges of which all vertices are selected, by one polygon, and refines "
        "the "
        "mesh once by Catmull-Clark. In the middle of each hole lies then a vertex with a ring of quadrilaterals, over "
        "which <i>Fairsurf: Fair surface</i> lays a cap of continuous curvature.",
    .menu = MENU_REFINE,
    .params = (const filter_param[]){PARAM_NEW_LAYER, {.name = NULL}},
    .run = run,
};
