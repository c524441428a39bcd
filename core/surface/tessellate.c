/* SPDX-License-Identifier: MIT */
/* Watertight triangles: every patch becomes a grid, and vertices on shared sides and corners are made once.

   The vertices inside a shared side belong to the side of the lower number 4 patch + side, and the other patch counts
   them backwards. Vertices are numbered: corners, then insides of sides, then insides of patches. */
#include "surface/surface.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

typedef struct grid {
  const fs_surface *surface;
  int32_t n_steps;
  int32_t *corner; /* [4 n_patches] vertex at each corner of each patch */
  int32_t *side;   /* [4 n_patches] first vertex inside each side, the same for both patches of a shared side */
  int32_t *inside; /* [n_patches] first vertex inside each patch, rows of constant v */
  int64_t n_vertices;
} grid;

/* Vertices inside a patch. */
static int64_t n_inside(const grid *g, int32_t p) {
  int64_t n = g->n_steps;
  return g->surface->patch[p].n_sides == 3 ? (n - 1) * (n - 2) / 2 : (n - 1) * (n - 1);
}

static fs_status number_vertices(fs_context *ctx, grid *g) {
  const fs_surface *surface = g->surface;
  int32_t n_sides = 4 * surface->n_patches, n_corners = 0;
  fs_status status = fs_surface_corners(ctx, surface, g->corner, &n_corners);
  if (status != FS_OK) return status;
  int64_t n = n_corners;
  for (int32_t i = 0; i < n_sides; i++) {
    if (i % 4 >= surface->patch[i / 4].n_sides) continue;
    int32_t other = fs_side_across(surface, i / 4, i % 4);
    bool is_owner = other == FS_NONE || other > i;
    if (n + g->n_steps > INT32_MAX) break;
    g->side[i] = is_owner ? (int32_t)n : g->side[other];
    if (is_owner) n += g->n_steps - 1;
  }
  for (int32_t p = 0; p < surface->n_patches && n + g->n_steps <= INT32_MAX; p++) {
    g->inside[p] = (int32_t)n;
    n += n_inside(g, p);
  }
  g->n_vertices = n;
  if (n + g->n_steps > INT32_MAX)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d steps on %d patches give more vertices than can be numbered",
                   (int)g->n_steps, (int)surface->n_patches);
  return FS_OK;
}

/* Vertex on side s of patch p, step k of 0 .. n_steps - 1 anticlockwise. */
static int32_t side_vertex(const grid *g, int32_t p, int32_t s, int32_t k) {
  int32_t i = 4 * p + s, other = fs_side_across(g->surface, p, s);
  if (k == 0) return g->corner[i];
  return g->side[i] + (other == FS_NONE || other > i ? k - 1 : g->n_steps - 1 - k);
}

/* Vertex at (i, j) / n_steps of patch p. */
static int32_t vertex(const grid *g, int32_t p, int32_t i, int32_t j) {
  int32_t n = g->n_steps;
  if (g->surface->patch[p].n_sides == 3) {
    if (j == 0 && i < n) return side_vertex(g, p, 0, i);
    if (i + j == n && j < n) return side_vertex(g, p, 1, j);
    if (i == 0) return side_vertex(g, p, 2, n - j);
    /* rows 1 .. j - 1 have n - 2, n - 3, .. vertices */
    return (int32_t)(g->inside[p] + (j - 1) * (2 * (int64_t)n - 2 - j) / 2 + i - 1);
  }
  if (j == 0 && i < n) return side_vertex(g, p, 0, i);
  if (i == n && j < n) return side_vertex(g, p, 1, j);
  if (j == n && i > 0) return side_vertex(g, p, 2, n - i);
  if (i == 0) return side_vertex(g, p, 3, n - j);
  return g->inside[p] + (j - 1) * (n - 1) + i - 1;
}

/* The normal at (u, v), or where p_u x p_v vanishes there the one at a near point towards the middle of the patch. */
static fs_vec3 normal_near(const fs_surface *surface, int32_t p, double u, double v, const fs_vec3 *at) {
  static const double way[] = {1e-4, 1e-3, 1e-2, 0.1, 0.5};
  fs_vec3 normal = {0, 0, 1}, x[FS_JET_SIZE];
  double centre[2];
  fs_domain_centre(surface->patch[p].n_sides, centre);
  if (fs_normal_compute(at, &normal)) return normal;
  for (size_t k = 0; k < sizeof way / sizeof *way; k++) {
    fs_surface_evaluate(surface, p, u + way[k] * (centre[0] - u), v + way[k] * (centre[1] - v), x);
    if (fs_normal_compute(x, &normal)) break;
  }
  return normal;
}

/* Evaluates the vertices that patch p is the first to hold; those have vertex_patch FS_NONE so far. */
static fs_status evaluate_patch(fs_context *ctx, const grid *g, int32_t p, fs_triangles *t) {
  fs_vec3 x[FS_JET_SIZE];
  bool is_triangle = g->surface->patch[p].n_sides == 3;
  for (int32_t j = 0; j <= g->n_steps; j++)
    for (int32_t i = 0; i <= g->n_steps - (is_triangle ? j : 0); i++) {
      int32_t k = vertex(g, p, i, j);
      if (t->vertex_patch[k] != FS_NONE) continue;
      double u = (double)i / g->n_steps, v = (double)j / g->n_steps;
      fs_surface_evaluate(g->surface, p, u, v, x);
      if (!fs_vec3_is_finite(x[FS_D]))
        return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)p);
      t->position[k] = x[FS_D];
      t->normal[k] = normal_near(g->surface, p, u, v, x);
      t->vertex_patch[k] = p;
      t->vertex_uv[2 * (size_t)k] = u, t->vertex_uv[2 * (size_t)k + 1] = v;
    }
  return FS_OK;
}

static void put_triangle(fs_triangles *t, size_t k, int32_t p, int32_t a, int32_t b, int32_t c) {
  t->corner[3 * k] = a, t->corner[3 * k + 1] = b, t->corner[3 * k + 2] = c;
  t->patch[k] = p;
}

/* Two triangles of a cell, cut along the shorter diagonal. */
static void split_cell(const grid *g, int32_t p, int32_t i, int32_t j, fs_triangles *t, size_t first) {
  const int32_t a = vertex(g, p, i, j), b = vertex(g, p, i + 1, j);
  const int32_t c = vertex(g, p, i + 1, j + 1), d = vertex(g, p, i, j + 1);
  const fs_vec3 *at = t->position;
  bool along_ac = fs_vec3_distance(at[a], at[c]) <= fs_vec3_distance(at[b], at[d]);
  put_triangle(t, first, p, a, b, along_ac ? c : d);
  put_triangle(t, first + 1, p, along_ac ? a : b, c, d);
}

/* The triangles of a patch from number *first on, which is moved behind them. */
static void connect_patch(const grid *g, int32_t p, fs_triangles *t, size_t *first) {
  int32_t n = g->n_steps;
  if (g->surface->patch[p].n_sides == 4) {
    for (int32_t j = 0; j < n; j++)
      for (int32_t i = 0; i < n; i++, *first += 2) split_cell(g, p, i, j, t, *first);
    return;
  }
  for (int32_t j = 0; j < n; j++)
    for (int32_t i = 0; i < n - j; i++) {
      const int32_t a = vertex(g, p, i, j), b = vertex(g, p, i + 1, j), c = vertex(g, p, i, j + 1);
      put_triangle(t, (*first)++, p, a, b, c);
      if (i + j + 1 < n) put_triangle(t, (*first)++, p, b, vertex(g, p, i + 1, j + 1), c);
    }
}

static fs_status make_triangles(fs_context *ctx, const grid *g, fs_triangles **triangles) {
  fs_status status = FS_OK;
  fs_triangles *t = NULL;
  size_t n_cells = (size_t)g->n_steps * (size_t)g->n_steps, n_triangles = 0, first = 0;
  for (int32_t p = 0; p < g->surface->n_patches; p++)
    n_triangles += g->surface->patch[p].n_sides == 3 ? n_cells : 2 * n_cells;
  FS_ALLOC(ctx, t, 1);
  t->n_vertices = (int32_t)g->n_vertices;
  t->n_triangles = (int32_t)n_triangles;
  FS_ALLOC(ctx, t->position, t->n_vertices);
  FS_ALLOC(ctx, t->normal, t->n_vertices);
  FS_ALLOC(ctx, t->vertex_patch, t->n_vertices);
  FS_ALLOC(ctx, t->vertex_uv, 2 * (size_t)t->n_vertices);
  FS_ALLOC(ctx, t->corner, 3 * n_triangles);
  FS_ALLOC(ctx, t->patch, n_triangles);
  for (int32_t k = 0; k < t->n_vertices; k++) t->vertex_patch[k] = FS_NONE;
  for (int32_t p = 0; p < g->surface->n_patches; p++) {
    FS_TRY(evaluate_patch(ctx, g, p, t));
    connect_patch(g, p, t, &first);
  }
  *triangles = t;
  t = NULL;
done:
  fs_triangles_free(ctx, t);
  return status;
}

fs_status fs_tessellate(fs_context *ctx, const fs_surface *surface, int32_t n_steps, fs_triangles **triangles) {
  fs_status status = FS_OK;
  grid g = {.surface = surface, .n_steps = n_steps};
  if (n_steps < 1) return fs_fail(ctx, FS_ERR_ARGUMENT, "a patch needs 1 step or more, not %d", (int)n_steps);
  /* 2 n^2 triangles per patch, as long as that fits; n^2 alone may leave int64_t only if n leaves int32_t */
  if (surface->n_patches > INT32_MAX / 4 ||
      (surface->n_patches > 0 && (int64_t)n_steps * n_steps > INT32_MAX / 2 / surface->n_patches))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d steps on %d patches give more triangles than can be numbered",
                   (int)n_steps, (int)surface->n_patches);
  FS_ALLOC(ctx, g.corner, 4 * (size_t)surface->n_patches);
  FS_ALLOC(ctx, g.side, 4 * (size_t)surface->n_patches);
  FS_ALLOC(ctx, g.inside, surface->n_patches);
  FS_TRY(number_vertices(ctx, &g));
  FS_TRY(make_triangles(ctx, &g, triangles));
done:
  fs_release(ctx, g.corner);
  fs_release(ctx, g.side);
  fs_release(ctx, g.inside);
  return status;
}

void fs_triangles_free(fs_context *ctx, fs_triangles *triangles) {
  if (triangles == NULL) return;
  fs_release(ctx, triangles->position);
  fs_release(ctx, triangles->normal);
  fs_release(ctx, triangles->corner);
  fs_release(ctx, triangles->patch);
  fs_release(ctx, triangles->vertex_patch);
  fs_release(ctx, triangles->vertex_uv);
  fs_release(ctx, triangles);
}
