/* SPDX-License-Identifier: MIT */
/* Single role: which parts of sides lie on each other, by geometry alone.

   Sides are cut where ends of other sides lie on them, so that T-junctions become pairs of whole stretches. Ends of stretches
   that are closer than the tolerance form clusters; two stretches between the same clusters that agree at three points in
   between are an edge. Ends are sorted along a direction that no grid is likely to be aligned with; neighbours within the
   tolerance are near in that order. */
#include "analyse/analyse.h"
#include "math/union_find.h"
#include "math/vec3.h"

#include <stdlib.h>

enum { N_SAMPLES = 8 }; /* steps along a side to know its length and its box */
static const fs_vec3 sweep = {0.7713, 0.5342, 0.3461};

/* A stretch, or a whole side. */
typedef struct piece {
  fs_stretch at;
  fs_vec3 end[2], low, high;
  double length, tolerance; /* its own: a short one may not collapse */
  int32_t cluster[2];
  int32_t n_edges; /* it is part of */
} piece;

/* An end of a piece. */
typedef struct tip {
  double key; /* along the sweep */
  fs_vec3 point;
  int32_t piece, end;
} tip;

static int compare_tips(const void *a, const void *b) {
  const tip *p = a, *q = b;
  if (p->key != q->key) return p->key < q->key ? -1 : 1;
  return p->piece != q->piece ? (p->piece < q->piece ? -1 : 1) : p->end - q->end;
}

static void measure(const fs_surface *surface, double tolerance, piece *p) {
  fs_vec3 x[FS_JET_SIZE], before = {0, 0, 0};
  p->low = (fs_vec3){INFINITY, INFINITY, INFINITY};
  p->high = (fs_vec3){-INFINITY, -INFINITY, -INFINITY};
  p->length = 0;
  for (int32_t k = 0; k <= N_SAMPLES; k++) {
    double t = k < N_SAMPLES ? p->at.begin + (p->at.end - p->at.begin) * k / N_SAMPLES : p->at.end;
    fs_side_evaluate(surface, p->at.patch, p->at.side, t, x);
    if (k == 0) p->end[0] = x[FS_D];
    if (k == N_SAMPLES) p->end[1] = x[FS_D];
    if (k > 0) p->length += fs_vec3_distance(before, x[FS_D]);
    p->low = fs_vec3_min(p->low, x[FS_D]);
    p->high = fs_vec3_max(p->high, x[FS_D]);
    before = x[FS_D];
  }
  p->tolerance = fmin(tolerance, 0.1 * p->length);
  /* between samples a side leaves their box by a small part of its length */
  double room = p->tolerance + 0.1 * p->length;
  p->low = fs_vec3_sub(p->low, (fs_vec3){room, room, room});
  p->high = fs_vec3_add(p->high, (fs_vec3){room, room, room});
}

static fs_status sort_tips(fs_context *ctx, int32_t n, const piece *p, tip **tips) {
  tip *t = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, t, 2 * (size_t)n);
  for (int32_t i = 0; i < 2 * n; i++)
    t[i] = (tip){fs_vec3_dot(sweep, p[i / 2].end[i % 2]), p[i / 2].end[i % 2], i / 2, i % 2};
  if (n > 0) qsort(t, 2 * (size_t)n, sizeof *t, compare_tips);
  *tips = t;
done:
  return status;
}

/* The first tip with at least that key. */
static int32_t lower_bound(int32_t n, const tip *t, double key) {
  int32_t low = 0, high = n;
  while (low < high) {
    int32_t middle = low + (high - low) / 2;
    if (t[middle].key < key)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static bool is_inside(fs_vec3 p, fs_vec3 low, fs_vec3 high) {
  return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
}

/* ---- cutting ---- */

typedef struct cuts {
  int32_t n, room;
  double *t;
} cuts;

static fs_status add_cut(fs_context *ctx, cuts *c, double t) {
  double *more = NULL;
  fs_status status = FS_OK;
  if (c->n == c->room) {
    if (c->room > INT32_MAX / 2 - 8) return fs_fail(ctx, FS_ERR_UNSUPPORTED, "a side meets too many others");
    FS_ALLOC(ctx, more, 2 * (size_t)c->room + 8);
    for (int32_t i = 0; i < c->n; i++) more[i] = c->t[i];
    fs_release(ctx, c->t);
    c->t = more;
    c->room = 2 * c->room + 8;
  }
  c->t[c->n++] = t;
done:
  return status;
}

static int compare_reals(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return x < y ? -1 : x > y;
}

/* Parameters within a side where tips of others lie on it, ascending and apart by more than the tolerance. */
static fs_status find_cuts(fs_context *ctx, const fs_surface *surface, const piece *p, int32_t n_tips, const tip *tips,
                           cuts *c) {
  double low = fs_vec3_dot(sweep, p->low), high = fs_vec3_dot(sweep, p->high);
  int32_t n_kept = 0;
  fs_vec3 x[FS_JET_SIZE], last = p->end[0];
  fs_status status = FS_OK;
  c->n = 0;
  for (int32_t i = lower_bound(n_tips, tips, low); i < n_tips && tips[i].key <= high; i++) {
    double t = 0.5;
    if (!is_inside(tips[i].point, p->low, p->high)) continue;
    if (fs_vec3_distance(tips[i].point, p->end[0]) <= p->tolerance ||
        fs_vec3_distance(tips[i].point, p->end[1]) <= p->tolerance)
      continue;
    if (fs_side_closest(surface, p->at.patch, p->at.side, 0, 1, tips[i].point, &t) > p->tolerance) continue;
    FS_TRY(add_cut(ctx, c, t));
  }
  if (c->n > 1) qsort(c->t, (size_t)c->n, sizeof *c->t, compare_reals);
  for (int32_t i = 0; i < c->n; i++) {
    fs_side_evaluate(surface, p->at.patch, p->at.side, c->t[i], x);
    if (fs_vec3_distance(x[FS_D], last) <= p->tolerance || fs_vec3_distance(x[FS_D], p->end[1]) <= p->tolerance ||
        c->t[i] <= 0 || c->t[i] >= 1)
      continue;
    last = x[FS_D];
    c->t[n_kept++] = c->t[i];
  }
  c->n = n_kept;
done:
  return status;
}

/* ---- clusters of ends ---- */

static fs_status cluster_ends(fs_context *ctx, int32_t n, piece *p) {
  tip *tips = NULL;
  int32_t *parent = NULL;
  double widest = 0;
  fs_status status = FS_OK;
  FS_TRY(sort_tips(ctx, n, p, &tips));
  FS_ALLOC(ctx, parent, 2 * (size_t)n);
  for (int32_t i = 0; i < 2 * n; i++) parent[i] = i;
  for (int32_t i = 0; i < n; i++) widest = fmax(widest, p[i].tolerance);
  for (int32_t i = 0; i < 2 * n; i++)
    for (int32_t j = i + 1; j < 2 * n && tips[j].key <= tips[i].key + widest; j++) {
      double least = fmin(p[tips[i].piece].tolerance, p[tips[j].piece].tolerance);
      if (fs_vec3_distance(tips[i].point, tips[j].point) > least) continue;
      fs_union_join(parent, 2 * tips[i].piece + tips[i].end, 2 * tips[j].piece + tips[j].end);
    }
  for (int32_t i = 0; i < 2 * n; i++) p[i / 2].cluster[i % 2] = fs_union_find(parent, i);
done:
  fs_release(ctx, tips);
  fs_release(ctx, parent);
  return status;
}

/* ---- pairs ---- */

/* Pieces in the order of their clusters. */
typedef struct keyed {
  int32_t low, high, piece;
} keyed;

static int compare_keyed(const void *a, const void *b) {
  const keyed *p = a, *q = b;
  if (p->low != q->low) return p->low < q->low ? -1 : 1;
  if (p->high != q->high) return p->high < q->high ? -1 : 1;
  return p->piece < q->piece ? -1 : p->piece > q->piece;
}

/* Whether three points within p lie on q; runs: whether q runs the same way (1) or the other (-1), by the middle. */
static bool agree(const fs_surface *surface, const piece *p, const piece *q, int *runs) {
  fs_vec3 x[FS_JET_SIZE], along[2];
  for (int32_t k = 1; k <= 3; k++) {
    double t = p->at.begin + (p->at.end - p->at.begin) * k / 4,
           s = q->at.begin + (q->at.end - q->at.begin) * (4 - k) / 4;
    fs_side_evaluate(surface, p->at.patch, p->at.side, t, x);
    if (fs_side_closest(surface, q->at.patch, q->at.side, q->at.begin, q->at.end, x[FS_D], &s) >
        fmin(p->tolerance, q->tolerance))
      return false;
    if (k != 2) continue;
    for (int side = 0; side < 2; side++) {
      const piece *of = side == 0 ? p : q;
      double at = side == 0 ? t : s, step = 1e-3 * (of->at.end - of->at.begin);
      fs_vec3 y[FS_JET_SIZE];
      fs_side_evaluate(surface, of->at.patch, of->at.side, fmax(at - step, of->at.begin), x);
      fs_side_evaluate(surface, of->at.patch, of->at.side, fmin(at + step, of->at.end), y);
      along[side] = fs_vec3_sub(y[FS_D], x[FS_D]);
    }
  }
  *runs = fs_vec3_dot(along[0], along[1]) > 0 ? 1 : -1;
  return true;
}

static fs_edge make_edge(const piece *p, const piece *q, int runs) {
  bool is_same = runs > 0;
  return (fs_edge){.patch = {p->at.patch, q->at.patch},
                   .side = {p->at.side, q->at.side},
                   .begin = {p->at.begin, is_same ? q->at.begin : q->at.end},
                   .end = {p->at.end, is_same ? q->at.end : q->at.begin},
                   .is_flipped = is_same};
}

/* A piece beyond the first two at one line is compared with the first. */
static void pair_group(const fs_surface *surface, int32_t n, const keyed *group, piece *p, fs_matches *m) {
  for (int32_t j = 1; j < n; j++) {
    piece *q = &p[group[j].piece];
    int32_t with = FS_NONE;
    int runs = 0, found;
    for (int32_t i = 0; i < j; i++) {
      const piece *other = &p[group[i].piece];
      bool is_better = with == FS_NONE || (p[with].n_edges > 0 && other->n_edges == 0);
      if (is_better && agree(surface, other, q, &found)) with = group[i].piece, runs = found;
    }
    if (with == FS_NONE) continue;
    m->edge[m->n++] = make_edge(&p[with], q, runs);
    p[with].n_edges++, q->n_edges++;
  }
}

static int compare_edges(const void *a, const void *b) {
  const fs_edge *p = a, *q = b;
  if (p->patch[0] != q->patch[0]) return p->patch[0] < q->patch[0] ? -1 : 1;
  if (p->side[0] != q->side[0]) return p->side[0] < q->side[0] ? -1 : 1;
  return p->begin[0] < q->begin[0] ? -1 : p->begin[0] > q->begin[0];
}

static fs_status pair_pieces(fs_context *ctx, const fs_surface *surface, int32_t n, piece *p, fs_matches *m) {
  keyed *key = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, key, n);
  FS_ALLOC(ctx, m->edge, n);
  FS_ALLOC(ctx, m->left, n);
  for (int32_t i = 0; i < n; i++) {
    int32_t a = p[i].cluster[0], b = p[i].cluster[1];
    key[i] = (keyed){a < b ? a : b, a < b ? b : a, i};
  }
  if (n > 0) qsort(key, (size_t)n, sizeof *key, compare_keyed);
  for (int32_t i = 0, end; i < n; i = end) {
    for (end = i + 1; end < n && key[end].low == key[i].low && key[end].high == key[i].high;) end++;
    pair_group(surface, end - i, key + i, p, m);
    if (i % 1024 == 0) FS_TRY(fs_progress(ctx, "edges", (double)i / n));
  }
  for (int32_t i = 0; i < n; i++)
    if (p[i].n_edges == 0) m->left[m->n_left++] = p[i].at;
  if (m->n > 0) qsort(m->edge, (size_t)m->n, sizeof *m->edge, compare_edges);
done:
  fs_release(ctx, key);
  return status;
}

/* ---- all of it ---- */

/* Sides that are longer than a point. */
static fs_status take_sides(fs_context *ctx, const fs_surface *surface, int32_t n, const fs_stretch *side,
                            double tolerance, piece **whole, int32_t *n_whole) {
  piece *p = NULL;
  int32_t n_kept = 0;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, p, n);
  for (int32_t i = 0; i < n; i++) {
    p[n_kept].at = side[i];
    measure(surface, tolerance, &p[n_kept]);
    if (p[n_kept].length > 1e-6 * tolerance) n_kept++;
  }
  *whole = p;
  *n_whole = n_kept;
done:
  return status;
}

fs_status fs_edges_match(fs_context *ctx, const fs_surface *surface, int32_t n, const fs_stretch *side,
                         double tolerance, fs_matches *matches) {
  piece *whole = NULL, *part = NULL;
  tip *tips = NULL;
  cuts c = {0};
  int32_t n_whole = 0, n_parts = 0;
  size_t room = 0;
  fs_matches m = {0};
  fs_status status = FS_OK;
  FS_TRY(take_sides(ctx, surface, n, side, tolerance, &whole, &n_whole));
  FS_TRY(sort_tips(ctx, n_whole, whole, &tips));
  for (int32_t i = 0; i < n_whole; i++) {
    FS_TRY(find_cuts(ctx, surface, &whole[i], 2 * n_whole, tips, &c));
    if ((size_t)n_parts + (size_t)c.n + 1 > room) {
      piece *more = NULL;
      room = 2 * room + (size_t)c.n + (size_t)n_whole;
      if (room > INT32_MAX / 4) {
        status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "the sides of the patches cut each other into too many parts");
        goto done;
      }
      FS_ALLOC(ctx, more, room);
      for (int32_t k = 0; k < n_parts; k++) more[k] = part[k];
      fs_release(ctx, part);
      part = more;
    }
    for (int32_t k = 0; k <= c.n; k++) {
      piece *p = &part[n_parts++];
      p->at = whole[i].at;
      p->at.begin = k > 0 ? c.t[k - 1] : 0;
      p->at.end = k < c.n ? c.t[k] : 1;
      measure(surface, tolerance, p);
    }
    if (i % 256 == 0) FS_TRY(fs_progress(ctx, "edges", (double)i / n_whole));
  }
  FS_TRY(cluster_ends(ctx, n_parts, part));
  FS_TRY(pair_pieces(ctx, surface, n_parts, part, &m));
  *matches = m;
  m = (fs_matches){0};
done:
  fs_matches_clear(ctx, &m);
  fs_release(ctx, whole);
  fs_release(ctx, part);
  fs_release(ctx, tips);
  fs_release(ctx, c.t);
  return status;
}

void fs_matches_clear(fs_context *ctx, fs_matches *matches) {
  fs_release(ctx, matches->edge);
  fs_release(ctx, matches->left);
  *matches = (fs_matches){0};
}
