/* SPDX-License-Identifier: MIT */
/* Single role: self-intersections: pairs of patches whose boxes meet, in them pairs of triangles that cut each other, and from
   there a common point of both patches.

   The four parameters of p(u, v) = q(s, t) are moved by the shortest step that solves the linearised equation,
   d = -J^T (J J^T)^-1 (p - q). Boxes are sorted along the longest direction of the surface and swept. */
#include "analyse/analyse.h"
#include "math/vec3.h"

#include <stdlib.h>

enum { N_STEPS_FINE = 8, N_STEPS_COARSE = 4, FEW_PATCHES = 10000, N_PAIRS = 1 << 14, MAX_TRIES = 24, N_CORNERS = 8 };

typedef struct box {
  fs_vec3 low, high;
} box;

typedef struct span {
  double low, high;
  int32_t patch;
} span;

typedef struct task {
  int32_t p, q; /* p <= q */
  bool is_crossing;
  fs_crossing crossing;
} task;

typedef struct job {
  const fs_surface *surface;
  const fs_triangles *triangles;
  int32_t n_steps;
  int32_t *start;   /* [n_patches + 1] triangles of each patch */
  box *patch;       /* [n_patches] */
  box *triangle;    /* [n_triangles] */
  double *shortest; /* [n_patches] a length that its triangles have */
  int32_t *corner;  /* [N_CORNERS n_patches] vertices of the edges on the border of each, or FS_NONE */
  task *task;
} job;

static bool boxes_meet(const box *a, const box *b) {
  return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y && b->low.y <= a->high.y &&
         a->low.z <= b->high.z && b->low.z <= a->high.z;
}

static void extend(box *b, fs_vec3 p) { b->low = fs_vec3_min(b->low, p), b->high = fs_vec3_max(b->high, p); }

static const box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void make_boxes(const job *j) {
  const fs_triangles *t = j->triangles;
  for (int32_t p = 0; p < j->surface->n_patches; p++) j->patch[p] = nothing;
  for (int32_t i = 0; i < t->n_triangles; i++) {
    j->triangle[i] = nothing;
    for (int k = 0; k < 3; k++) extend(&j->triangle[i], t->position[t->corner[3 * (size_t)i + (size_t)k]]);
    extend(&j->patch[t->patch[i]], j->triangle[i].low);
    extend(&j->patch[t->patch[i]], j->triangle[i].high);
    j->start[t->patch[i] + 1] = i + 1; /* triangles come patch by patch */
  }
  for (int32_t p = 0; p < j->surface->n_patches; p++)
    if (j->start[p + 1] < j->start[p]) j->start[p + 1] = j->start[p];
  for (int32_t p = 0; p < j->surface->n_patches; p++)
    j->shortest[p] = fs_vec3_distance(j->patch[p].low, j->patch[p].high) / fmax(1, sqrt(j->start[p + 1] - j->start[p]));
}

/* ---- a common point of two patches ---- */

static void clamp(int32_t n_sides, fs_place *p) {
  p->u = fmin(fmax(p->u, 0), 1);
  p->v = fmin(fmax(p->v, 0), n_sides == 3 ? 1 - p->u : 1);
}

/* y = A^-1 b for a symmetric A by Cramer's rule; false where it is singular. */
static bool solve(const fs_vec3 A[3], fs_vec3 b, fs_vec3 *y) {
  double det = fs_vec3_dot(A[0], fs_vec3_cross(A[1], A[2]));
  double size = fs_vec3_length(A[0]) * fs_vec3_length(A[1]) * fs_vec3_length(A[2]);
  if (!(fabs(det) > 1e-14 * size)) return false;
  *y = (fs_vec3){fs_vec3_dot(b, fs_vec3_cross(A[1], A[2])) / det, fs_vec3_dot(A[0], fs_vec3_cross(b, A[2])) / det,
                 fs_vec3_dot(A[0], fs_vec3_cross(A[1], b)) / det};
  return true;
}

static bool approach(const fs_surface *surface, fs_place place[2], double size, fs_vec3 *point) {
  enum { MAX_STEPS = 30 };
  for (int32_t step = 0; step < MAX_STEPS; step++) {
    fs_vec3 x[2][FS_JET_SIZE], gap, y, A[3], way[4];
    for (int k = 0; k < 2; k++) fs_surface_evaluate(surface, place[k].patch, place[k].u, place[k].v, x[k]);
    gap = fs_vec3_sub(x[0][FS_D], x[1][FS_D]);
    *point = x[0][FS_D];
    if (fs_vec3_length(gap) <= 1e-11 * size) return true;
    way[0] = x[0][FS_DU], way[1] = x[0][FS_DV];
    way[2] = fs_vec3_scale(x[1][FS_DU], -1), way[3] = fs_vec3_scale(x[1][FS_DV], -1);
    A[0] = A[1] = A[2] = (fs_vec3){0, 0, 0};
    for (int k = 0; k < 4; k++) {
      A[0] = fs_vec3_add_scaled(A[0], way[k], way[k].x);
      A[1] = fs_vec3_add_scaled(A[1], way[k], way[k].y);
      A[2] = fs_vec3_add_scaled(A[2], way[k], way[k].z);
    }
    if (!solve(A, gap, &y)) return false;
    for (int k = 0; k < 2; k++) {
      place[k].u -= fs_vec3_dot(way[2 * k], y);
      place[k].v -= fs_vec3_dot(way[2 * k + 1], y);
      clamp(surface->patch[place[k].patch].n_sides, &place[k]);
    }
  }
  return false;
}

/* ---- what is no crossing ---- */

static bool is_border(const fs_surface *surface, const fs_place *p) {
  const double near = 1e-6;
  bool is_far = surface->patch[p->patch].n_sides == 3 ? p->u + p->v > 1 - near : p->u > 1 - near || p->v > 1 - near;
  return p->u < near || p->v < near || is_far;
}

static bool share_vertex(const job *j, int32_t p, int32_t q) {
  const int32_t *a = j->corner + N_CORNERS * (size_t)p, *b = j->corner + N_CORNERS * (size_t)q;
  for (int i = 0; i < N_CORNERS; i++)
    for (int k = 0; k < N_CORNERS; k++)
      if (a[i] != FS_NONE && a[i] == b[k]) return true;
  return false;
}

/* One point of one patch, or of the common border of two neighbours. */
static bool is_trivial(const job *j, const fs_place place[2]) {
  const fs_surface *s = j->surface;
  if (place[0].patch == place[1].patch && fabs(place[0].u - place[1].u) + fabs(place[0].v - place[1].v) < 1e-3)
    return true;
  return is_border(s, &place[0]) && is_border(s, &place[1]) && share_vertex(j, place[0].patch, place[1].patch);
}

/* ---- pairs of triangles ---- */

/* The middle of the cell that triangle i lies in: triangles come row by row. */
static fs_place middle_of(const job *j, int32_t i) {
  const int32_t patch = j->triangles->patch[i], n = j->n_steps;
  int32_t k = i - j->start[patch], row = 0, in_row = 2 * n;
  const bool is_triangle = j->surface->patch[patch].n_sides == 3;
  if (is_triangle) in_row--;
  for (; k >= in_row; row++) {
    k -= in_row;
    if (is_triangle) in_row -= 2;
  }
  const double inside = is_triangle ? (k % 2 == 0 ? 1 / 3. : 2 / 3.) : 0.5;
  return (fs_place){patch, (k / 2 + inside) / n, (row + inside) / n};
}

static bool share_corner(const int32_t *a, const int32_t *b) {
  for (int k = 0; k < 3; k++)
    if (a[k] == b[0] || a[k] == b[1] || a[k] == b[2]) return true;
  return false;
}

/* Whether a pair of triangles leads to a crossing of their patches. */
static bool confirm(const job *j, int32_t a, int32_t b, fs_vec3 point, fs_crossing *crossing) {
  fs_place place[2] = {middle_of(j, a), middle_of(j, b)};
  double size = fmax(j->shortest[place[0].patch], j->shortest[place[1].patch]);
  fs_vec3 found;
  if (!approach(j->surface, place, size, &found)) return false;
  if (fs_vec3_distance(found, point) > 4 * size || is_trivial(j, place)) return false;
  *crossing = (fs_crossing){{place[0], place[1]}, found};
  return true;
}

static void test_pair(const job *j, task *task) {
  const fs_triangles *t = j->triangles;
  const int32_t p = task->p, q = task->q;
  int32_t n_tries = 0;
  for (int32_t a = j->start[p]; a < j->start[p + 1]; a++) {
    const int32_t *ca = t->corner + 3 * (size_t)a;
    if (p != q && !boxes_meet(&j->triangle[a], &j->patch[q])) continue;
    for (int32_t b = p == q ? a + 1 : j->start[q]; b < j->start[q + 1]; b++) {
      const int32_t *cb = t->corner + 3 * (size_t)b;
      fs_vec3 point;
      if (!boxes_meet(&j->triangle[a], &j->triangle[b]) || share_corner(ca, cb)) continue;
      const fs_vec3 ta[3] = {t->position[ca[0]], t->position[ca[1]], t->position[ca[2]]};
      const fs_vec3 tb[3] = {t->position[cb[0]], t->position[cb[1]], t->position[cb[2]]};
      if (!fs_triangles_cut(ta, tb, &point)) continue;
      if (++n_tries > MAX_TRIES) return;
      task->is_crossing = confirm(j, a, b, point, &task->crossing);
      if (task->is_crossing) return;
    }
  }
}

static fs_status test_pairs(void *user, int32_t begin, int32_t end, int32_t worker) {
  const job *j = user;
  (void)worker;
  for (int32_t i = begin; i < end; i++) test_pair(j, &j->task[i]);
  return FS_OK;
}

/* ---- all pairs ---- */

static int compare_spans(const void *a, const void *b) {
  const span *p = a, *q = b;
  if (p->low != q->low) return p->low < q->low ? -1 : 1;
  return p->patch < q->patch ? -1 : p->patch > q->patch;
}

static void make_spans(const job *j, span *s) {
  box all = nothing;
  for (int32_t p = 0; p < j->surface->n_patches; p++) extend(&all, j->patch[p].low), extend(&all, j->patch[p].high);
  fs_vec3 size = fs_vec3_sub(all.high, all.low);
  for (int32_t p = 0; p < j->surface->n_patches; p++) {
    const box *b = &j->patch[p];
    s[p].patch = p;
    if (size.x >= size.y && size.x >= size.z)
      s[p].low = b->low.x, s[p].high = b->high.x;
    else if (size.y >= size.z)
      s[p].low = b->low.y, s[p].high = b->high.y;
    else
      s[p].low = b->low.z, s[p].high = b->high.z;
  }
  qsort(s, (size_t)j->surface->n_patches, sizeof *s, compare_spans);
}

static fs_status run_tasks(fs_context *ctx, job *j, int32_t n, int32_t max_listed, fs_crossings *found) {
  fs_status status = FS_OK;
  FS_TRY(fs_parallel_for(ctx, n, test_pairs, j));
  for (int32_t i = 0; i < n; i++) {
    if (!j->task[i].is_crossing) continue;
    if (found->n_listed < max_listed) found->crossing[found->n_listed++] = j->task[i].crossing;
    if (found->n < INT32_MAX) found->n++;
  }
done:
  return status;
}

static fs_status sweep(fs_context *ctx, job *j, const span *s, int32_t max_listed, fs_crossings *found) {
  const int32_t n_patches = j->surface->n_patches;
  int32_t n = 0;
  fs_status status = FS_OK;
  for (int32_t i = 0; i < n_patches; i++)
    for (int32_t k = i; k < n_patches && s[k].low <= s[i].high; k++) {
      int32_t p = s[i].patch, q = s[k].patch;
      if (!boxes_meet(&j->patch[p], &j->patch[q])) continue;
      j->task[n++] = (task){.p = p < q ? p : q, .q = p < q ? q : p};
      if (n < N_PAIRS) continue;
      FS_TRY(fs_progress(ctx, "self-intersections", (double)i / n_patches));
      FS_TRY(run_tasks(ctx, j, n, max_listed, found));
      n = 0;
    }
  FS_TRY(run_tasks(ctx, j, n, max_listed, found));
done:
  return status;
}

/* Vertices of the edges at the corners of patches and within their sides. */
static void list_corners(const fs_edges *edges, const fs_surface *surface, int32_t *corner) {
  for (size_t i = 0; i < N_CORNERS * (size_t)surface->n_patches; i++) corner[i] = FS_NONE;
  for (int32_t v = 0; v < edges->n_vertices; v++)
    for (int32_t k = edges->place_start[v]; k < edges->place_start[v + 1]; k++) {
      int32_t *of = corner + N_CORNERS * (size_t)edges->place[k].patch;
      for (int c = 0; c < N_CORNERS; c++)
        if (of[c] == FS_NONE) {
          of[c] = v;
          break;
        }
    }
}

static int compare_crossings(const void *a, const void *b) {
  const fs_crossing *p = a, *q = b;
  for (int k = 0; k < 2; k++)
    if (p->place[k].patch != q->place[k].patch) return p->place[k].patch < q->place[k].patch ? -1 : 1;
  return 0;
}

fs_status fs_crossings_find(fs_context *ctx, const fs_surface *surface, const fs_edges *edges, int32_t n_steps,
                            int32_t max_listed, fs_crossings **crossings) {
  fs_triangles *triangles = NULL;
  fs_crossings *found = NULL;
  span *spans = NULL;
  job j = {.surface = surface};
  fs_status status = FS_OK;
  if (n_steps < 0 || max_listed < 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d steps and a list of %d crossings: neither may be negative", (int)n_steps,
                   (int)max_listed);
  if (n_steps == 0) n_steps = surface->n_patches <= FEW_PATCHES ? N_STEPS_FINE : N_STEPS_COARSE;
  FS_TRY(fs_tessellate(ctx, surface, n_steps, &triangles));
  j.triangles = triangles;
  j.n_steps = n_steps;
  FS_ALLOC(ctx, found, 1);
  FS_ALLOC(ctx, found->crossing, max_listed);
  FS_ALLOC(ctx, j.start, (size_t)surface->n_patches + 1);
  FS_ALLOC(ctx, j.patch, surface->n_patches);
  FS_ALLOC(ctx, j.triangle, triangles->n_triangles);
  FS_ALLOC(ctx, j.shortest, surface->n_patches);
  FS_ALLOC(ctx, j.corner, N_CORNERS * (size_t)surface->n_patches);
  FS_ALLOC(ctx, j.task, N_PAIRS);
  FS_ALLOC(ctx, spans, surface->n_patches);
  make_boxes(&j);
  list_corners(edges, surface, j.corner);
  make_spans(&j, spans);
  FS_TRY(sweep(ctx, &j, spans, max_listed, found));
  if (found->n_listed > 1) qsort(found->crossing, (size_t)found->n_listed, sizeof *found->crossing, compare_crossings);
  *crossings = found;
  found = NULL;
done:
  fs_triangles_free(ctx, triangles);
  fs_crossings_free(ctx, found);
  fs_release(ctx, j.start);
  fs_release(ctx, j.patch);
  fs_release(ctx, j.triangle);
  fs_release(ctx, j.shortest);
  fs_release(ctx, j.corner);
  fs_release(ctx, j.task);
  fs_release(ctx, spans);
  return status;
}

void fs_crossings_free(fs_context *ctx, fs_crossings *crossings) {
  if (crossings == NULL) return;
  fs_release(ctx, crossings->crossing);
  fs_release(ctx, crossings);
}
