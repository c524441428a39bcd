/* SPDX-License-Identifier: MIT */
/* Single role: the Delaunay triangulation of points of the plane.

   Points are added in the order of their x. Each lies outside of the hull so far, and sees some of its edges: with these it
   makes triangles, and edges are flipped until the circumcircle of no triangle holds the opposite corner of a neighbour
   [Lawson 1977]. Coordinates are integers below 2^26, so both predicates are exact:
     orient(a, b, c) > 0: c lies left of a -> b,      |.| < 2^55
     in_circle(a, b, c, d) > 0: d lies inside,        |.| < 2^111                                               */
#include "mesh/delaunay.h"

#include <math.h>
#include <stdlib.h>

__extension__ typedef __int128 wide;

static const double n_cells = 1 << 25;

typedef struct site {
  int64_t x, y;
  int32_t number;
} site;

typedef struct triangle {
  int32_t vertex[3], neighbour[3]; /* across the edge from vertex i to i + 1 */
} triangle;

typedef struct triangulation {
  const site *site; /* in their order */
  triangle *triangle;
  int32_t n_triangles;
  int32_t *next, *previous,
      *inside;    /* of the edge of the hull that leaves a site: the next one, … the triangle at it */
  int32_t *stack; /* triangles with the newest site as vertex 2 whose edge 0 may have to be flipped */
  int32_t n_stacked;
} triangulation;

static int64_t orient(const site *a, const site *b, const site *c) {
  return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

static bool in_circle(const site *a, const site *b, const site *c, const site *d) {
  const int64_t ax = a->x - d->x, ay = a->y - d->y, bx = b->x - d->x, by = b->y - d->y;
  const int64_t cx = c->x - d->x, cy = c->y - d->y;
  return (wide)(ax * ax + ay * ay) * (bx * cy - by * cx) - (wide)(bx * bx + by * by) * (ax * cy - ay * cx) +
             (wide)(cx * cx + cy * cy) * (ax * by - ay * bx) >
         0;
}

static int compare(const void *a, const void *b) {
  const site *p = a, *q = b;
  if (p->x != q->x) return p->x < q->x ? -1 : 1;
  if (p->y != q->y) return p->y < q->y ? -1 : 1;
  return p->number < q->number ? -1 : 1;
}

static void link_edge(triangulation *d, int32_t t, int32_t from, int32_t old, int32_t now) {
  if (t == FS_NONE) {
    d->inside[from] = now; /* an edge of the hull */
    return;
  }
  for (int i = 0; i < 3; i++)
    if (d->triangle[t].neighbour[i] == old) d->triangle[t].neighbour[i] = now;
}

/* Edge 0 of t, a -> b with corner c, is edge j of s with corner e: t becomes a e c and s becomes e b c. */
static void flip(triangulation *d, int32_t t, int32_t s, int32_t j) {
  const triangle T = d->triangle[t], S = d->triangle[s];
  int32_t a = T.vertex[0], b = T.vertex[1], c = T.vertex[2], e = S.vertex[(j + 2) % 3];
  int32_t bc = T.neighbour[1], ca = T.neighbour[2], ae = S.neighbour[(j + 1) % 3], eb = S.neighbour[(j + 2) % 3];
  d->triangle[t] = (triangle){{a, e, c}, {ae, s, ca}};
  d->triangle[s] = (triangle){{e, b, c}, {eb, bc, t}};
  link_edge(d, ae, a, s, t);
  link_edge(d, bc, b, t, s);
}

/* Flips edges opposite the newest site until all are legal; no others can be illegal. */
static void legalise(triangulation *d) {
  while (d->n_stacked > 0) {
    int32_t t = d->stack[--d->n_stacked], s = d->triangle[t].neighbour[0], j = 0;
    const int32_t *v = d->triangle[t].vertex;
    if (s == FS_NONE) continue;
    while (d->triangle[s].neighbour[j] != t) j++;
    if (!in_circle(&d->site[v[0]], &d->site[v[1]], &d->site[v[2]], &d->site[d->triangle[s].vertex[(j + 2) % 3]]))
      continue;
    flip(d, t, s, j);
    d->stack[d->n_stacked++] = t;
    d->stack[d->n_stacked++] = s;
  }
}

/* Triangles between site p and the edges of the hull from first to last, which it sees. */
static void cover(triangulation *d, int32_t p, int32_t first, int32_t last) {
  int32_t before = FS_NONE;
  for (int32_t a = first; a != last; a = d->next[a]) {
    int32_t t = d->n_triangles++, inner = d->inside[a];
    d->triangle[t] = (triangle){{d->next[a], a, p}, {inner, before, FS_NONE}};
    for (int i = 0; i < 3; i++)
      if (d->triangle[inner].vertex[i] == a) d->triangle[inner].neighbour[i] = t;
    if (before != FS_NONE) d->triangle[before].neighbour[2] = t;
    d->stack[d->n_stacked++] = t;
    before = t;
  }
  d->inside[p] = before;
  d->inside[first] = d->stack[0];
  d->next[first] = p, d->previous[p] = first;
  d->next[p] = last, d->previous[last] = p;
  legalise(d);
}

static void add_site(triangulation *d, int32_t p) {
  const site *at = d->site;
  int32_t first = p - 1, last = p - 1; /* the site before is on the hull, and p sees an edge at it */
  while (orient(&at[last], &at[d->next[last]], &at[p]) < 0) last = d->next[last];
  while (orient(&at[d->previous[first]], &at[first], &at[p]) < 0) first = d->previous[first];
  cover(d, p, first, last);
}

/* The first n sites lie on a line, site n does not: a fan. */
static void start(triangulation *d, int32_t n) {
  bool is_left = orient(&d->site[0], &d->site[1], &d->site[n]) > 0;
  int32_t m = n - 1; /* triangles */
  for (int32_t k = 0; k < n; k++) {
    int32_t from = is_left ? k : m - k, to = is_left ? k + 1 : m - k - 1;
    d->next[from] = k < m ? to : n;
    d->inside[from] = k < m ? k : m - 1;
    if (k < m)
      d->triangle[k] = (triangle){{from, to, n}, {FS_NONE, k + 1 < m ? k + 1 : FS_NONE, k > 0 ? k - 1 : FS_NONE}};
  }
  d->next[n] = is_left ? 0 : m;
  d->inside[n] = 0;
  d->n_triangles = m;
  for (int32_t k = 0; k <= n; k++) d->previous[d->next[k]] = k;
}

/* ---- from points to sites and back ---- */

static fs_status set_sites(fs_context *ctx, int32_t n, const fs_vec3 *point, site *sites) {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, size;
  for (int32_t i = 0; i < n; i++) {
    low[0] = fmin(low[0], point[i].x), high[0] = fmax(high[0], point[i].x);
    low[1] = fmin(low[1], point[i].y), high[1] = fmax(high[1], point[i].y);
  }
  size = fmax(high[0] - low[0], high[1] - low[1]);
  if (!(size > 0) || !isfinite(size)) return fs_fail(ctx, FS_ERR_FORMAT, "the points span no finite rectangle");
  for (int32_t i = 0; i < n; i++) {
    sites[i].x = llrint((point[i].x - low[0]) / size * n_cells);
    sites[i].y = llrint((point[i].y - low[1]) / size * n_cells);
    sites[i].number = i;
  }
  qsort(sites, (size_t)n, sizeof *sites, compare);
  for (int32_t i = 1; i < n; i++)
    if (sites[i].x == sites[i - 1].x && sites[i].y == sites[i - 1].y)
      return fs_fail(ctx, FS_ERR_FORMAT, "points %d and %d have the same x and y, or nearly so",
                     (int)sites[i - 1].number, (int)sites[i].number);
  return FS_OK;
}

fs_status fs_delaunay(fs_context *ctx, int32_t n, const fs_vec3 *point, int32_t *corner, int32_t *n_triangles) {
  fs_status status = FS_OK;
  site *sites = NULL;
  triangulation d = {.n_triangles = 0};
  int32_t p = 2;
  if (n < 3) return fs_fail(ctx, FS_ERR_FORMAT, "%d points make no triangle", (int)n);
  FS_ALLOC(ctx, sites, n);
  FS_TRY(set_sites(ctx, n, point, sites));
  while (p < n && orient(&sites[0], &sites[1], &sites[p]) == 0) p++;
  if (p == n) {
    status = fs_fail(ctx, FS_ERR_FORMAT, "all points lie on one line, seen along z");
    goto done;
  }
  d.site = sites;
  FS_ALLOC(ctx, d.triangle, 2 * (size_t)n);
  FS_ALLOC(ctx, d.next, n);
  FS_ALLOC(ctx, d.previous, n);
  FS_ALLOC(ctx, d.inside, n);
  FS_ALLOC(ctx, d.stack, 2 * (size_t)n);
  start(&d, p);
  for (p++; p < n; p++) {
    if (p % 4096 == 0) FS_TRY(fs_progress(ctx, "triangulate", (double)p / n));
    add_site(&d, p);
  }
  for (int32_t t = 0; t < d.n_triangles; t++)
    for (int i = 0; i < 3; i++) corner[3 * t + i] = sites[d.triangle[t].vertex[i]].number;
  *n_triangles = d.n_triangles;
done:
  fs_release(ctx, sites);
  fs_release(ctx, d.triangle);
  fs_release(ctx, d.next);
  fs_release(ctx, d.previous);
  fs_release(ctx, d.inside);
  fs_release(ctx, d.stack);
  return status;
}
