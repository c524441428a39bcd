/* SPDX-License-Identifier: MIT */
/* Single role: the edges and vertices of a surface: those that the patches name, those that geometry finds, and the border.

   Vertices are the classes of corners, and of points within sides, that edges join at their ends: union-find over nodes. Node
   4 patch + corner is a corner; points within sides follow. */
#include "analyse/analyse.h"
#include "math/union_find.h"
#include "math/vec3.h"

#include <stdlib.h>

/* A point within a side at which edges end. */
typedef struct inner {
  int32_t patch, side;
  double t;
} inner;

typedef struct nodes {
  const fs_surface *surface;
  int32_t n_inner;
  inner *inner;    /* ascending */
  int32_t *parent; /* [4 n_patches + n_inner] */
} nodes;

static int compare_inner(const void *a, const void *b) {
  const inner *p = a, *q = b;
  if (p->patch != q->patch) return p->patch < q->patch ? -1 : 1;
  if (p->side != q->side) return p->side < q->side ? -1 : 1;
  return p->t < q->t ? -1 : p->t > q->t;
}

static int32_t node_at(const nodes *n, int32_t patch, int32_t side, double t) {
  const int32_t n_sides = n->surface->patch[patch].n_sides;
  inner key = {patch, side, t};
  const inner *found;
  if (t <= 0) return 4 * patch + side;
  if (t >= 1) return 4 * patch + (side + 1) % n_sides;
  found = bsearch(&key, n->inner, (size_t)n->n_inner, sizeof key, compare_inner);
  return 4 * n->surface->n_patches + (int32_t)(found - n->inner);
}

/* Sides of patches, by what the patches say of them. */
static void count_sides(const fs_surface *surface, int32_t *n_given, int32_t *n_alone) {
  *n_given = *n_alone = 0;
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      int32_t q = surface->patch[p].neighbour[s], r = surface->patch[p].neighbour_side[s];
      *n_alone += q == FS_NONE;
      *n_given += q != FS_NONE && 4 * (int64_t)q + r > 4 * (int64_t)p + s;
    }
}

static void list_sides(const fs_surface *surface, fs_edge *edge, fs_stretch *alone) {
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      int32_t q = surface->patch[p].neighbour[s], r = surface->patch[p].neighbour_side[s];
      if (q == FS_NONE)
        *alone++ = (fs_stretch){p, s, 0, 1};
      else if (4 * (int64_t)q + r > 4 * (int64_t)p + s)
        *edge++ = (fs_edge){.patch = {p, q}, .side = {s, r}, .begin = {0, 1}, .end = {1, 0}, .is_given = true};
    }
}

/* Diagonal of the box of the corners. */
static fs_status measure_box(fs_context *ctx, const fs_surface *surface, double *diagonal) {
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY}, x[FS_JET_SIZE];
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      fs_side_evaluate(surface, p, s, 0, x);
      if (!fs_vec3_is_finite(x[FS_D]))
        return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)p);
      low = fs_vec3_min(low, x[FS_D]);
      high = fs_vec3_max(high, x[FS_D]);
    }
  *diagonal = surface->n_patches > 0 ? fs_vec3_distance(low, high) : 0;
  return FS_OK;
}

static fs_status list_inner(fs_context *ctx, const fs_edges *e, nodes *n) {
  fs_status status = FS_OK;
  int32_t n_all = 0, n_kept = 0;
  FS_ALLOC(ctx, n->inner, 4 * ((size_t)e->n_found + (size_t)e->n_borders));
  for (int32_t i = e->n_edges - e->n_found; i < e->n_edges + e->n_borders; i++)
    for (int k = 0; k < 2 && e->edge[i].patch[k] != FS_NONE; k++)
      for (int end = 0; end < 2; end++) {
        double t = end == 0 ? e->edge[i].begin[k] : e->edge[i].end[k];
        if (t > 0 && t < 1) n->inner[n_all++] = (inner){e->edge[i].patch[k], e->edge[i].side[k], t};
      }
  if (n_all > 1) qsort(n->inner, (size_t)n_all, sizeof *n->inner, compare_inner);
  for (int32_t i = 0; i < n_all; i++)
    if (n_kept == 0 || compare_inner(&n->inner[n_kept - 1], &n->inner[i]) != 0) n->inner[n_kept++] = n->inner[i];
  n->n_inner = n_kept;
done:
  return status;
}

/* Numbers the classes of nodes in the order of their first ones, and lists their places. Nodes 4 patch + corner of corners
   that the patch does not have stay out. */
static fs_status list_vertices(fs_context *ctx, const nodes *n, fs_edges *e) {
  const fs_surface *surface = n->surface;
  const int32_t n_nodes = 4 * surface->n_patches + n->n_inner;
  int32_t *number = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, number, n_nodes);
  for (int32_t i = 0; i < n_nodes; i++) {
    bool is_there = i >= 4 * surface->n_patches || i % 4 < surface->patch[i / 4].n_sides;
    int32_t root = fs_union_find(n->parent, i);
    number[i] = !is_there ? FS_NONE : root == i ? e->n_vertices++ : number[root];
  }
  FS_ALLOC(ctx, e->place_start, (size_t)e->n_vertices + 2);
  FS_ALLOC(ctx, e->place, n_nodes);
  for (int32_t i = 0; i < n_nodes; i++)
    if (number[i] != FS_NONE) e->place_start[number[i] + 2]++;
  for (int32_t v = 0; v < e->n_vertices; v++) e->place_start[v + 2] += e->place_start[v + 1];
  for (int32_t i = 0; i < n_nodes; i++) {
    if (number[i] == FS_NONE) continue;
    const inner *at = i < 4 * surface->n_patches ? NULL : &n->inner[i - 4 * surface->n_patches];
    e->place[e->place_start[number[i] + 1]++] =
        at == NULL ? fs_side_place(surface, i / 4, i % 4, 0) : fs_side_place(surface, at->patch, at->side, at->t);
  }
  for (int32_t i = 0; i < e->n_edges + e->n_borders; i++) {
    fs_edge *edge = &e->edge[i];
    edge->vertex[0] = number[node_at(n, edge->patch[0], edge->side[0], edge->begin[0])];
    edge->vertex[1] = number[node_at(n, edge->patch[0], edge->side[0], edge->end[0])];
  }
done:
  fs_release(ctx, number);
  return status;
}

static fs_status make_vertices(fs_context *ctx, const fs_surface *surface, fs_edges *e) {
  nodes n = {.surface = surface};
  fs_status status = FS_OK;
  FS_TRY(list_inner(ctx, e, &n));
  FS_ALLOC(ctx, n.parent, 4 * (size_t)surface->n_patches + (size_t)n.n_inner);
  for (int32_t i = 0; i < 4 * surface->n_patches + n.n_inner; i++) n.parent[i] = i;
  for (int32_t i = 0; i < e->n_edges; i++) {
    const fs_edge *edge = &e->edge[i];
    fs_union_join(n.parent, node_at(&n, edge->patch[0], edge->side[0], edge->begin[0]),
                  node_at(&n, edge->patch[1], edge->side[1], edge->begin[1]));
    fs_union_join(n.parent, node_at(&n, edge->patch[0], edge->side[0], edge->end[0]),
                  node_at(&n, edge->patch[1], edge->side[1], edge->end[1]));
  }
  FS_TRY(list_vertices(ctx, &n, e));
done:
  fs_release(ctx, n.inner);
  fs_release(ctx, n.parent);
  return status;
}

fs_status fs_edges_create(fs_context *ctx, const fs_surface *surface, double tolerance, fs_edges **edges) {
  fs_edges *e = NULL;
  fs_stretch *alone = NULL;
  fs_matches matches = {0};
  int32_t n_given, n_alone;
  double diagonal = 0;
  fs_status status = FS_OK;
  if (surface->n_patches > INT32_MAX / 16)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "%d patches are too many to number their edges", (int)surface->n_patches);
  FS_TRY(measure_box(ctx, surface, &diagonal));
  count_sides(surface, &n_given, &n_alone);
  FS_ALLOC(ctx, e, 1);
  FS_ALLOC(ctx, alone, n_alone);
  FS_ALLOC(ctx, e->edge, n_given);
  list_sides(surface, e->edge, alone);
  e->n_edges = n_given;
  if (n_alone > 0) {
    fs_edge *all = NULL;
    FS_TRY(fs_edges_match(ctx, surface, n_alone, alone, tolerance > 0 ? tolerance : 1e-4 * diagonal, &matches));
    FS_ALLOC(ctx, all, (size_t)n_given + (size_t)matches.n + (size_t)matches.n_left);
    for (int32_t i = 0; i < n_given; i++) all[i] = e->edge[i];
    for (int32_t i = 0; i < matches.n; i++) all[n_given + i] = matches.edge[i];
    for (int32_t i = 0; i < matches.n_left; i++) {
      const fs_stretch *left = &matches.left[i];
      all[n_given + matches.n + i] = (fs_edge){.patch = {left->patch, FS_NONE},
                                               .side = {left->side, FS_NONE},
                                               .begin = {left->begin, 0},
                                               .end = {left->end, 0}};
    }
    fs_release(ctx, e->edge);
    e->edge = all;
    e->n_found = matches.n;
    e->n_edges = n_given + matches.n;
    e->n_borders = matches.n_left;
  }
  FS_TRY(make_vertices(ctx, surface, e));
  *edges = e;
  e = NULL;
done:
  fs_matches_clear(ctx, &matches);
  fs_release(ctx, alone);
  fs_edges_free(ctx, e);
  return status;
}

void fs_edges_free(fs_context *ctx, fs_edges *edges) {
  if (edges == NULL) return;
  fs_release(ctx, edges->edge);
  fs_release(ctx, edges->place_start);
  fs_release(ctx, edges->place);
  fs_release(ctx, edges);
}
