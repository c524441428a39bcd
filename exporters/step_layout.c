/* SPDX-License-Identifier: MIT */
/* Single role: the partition of a surface into rectangles of bicubic patches that join C2, found by walking from patch to
   patch; all other patches stay faces of their own. */
#include "step.h"
#include "base/base.h"
#include "math/vec3.h"
#include "surface/surface.h"

int32_t fs_step_cross(const fs_surface *surface, int32_t cell, int32_t s) {
  int32_t side = fs_step_side(cell, s), across = fs_side_across(surface, side / 4, side % 4);
  if (across == FS_NONE) return FS_NONE;
  /* the side that meets ours is side s + 2 of the new cell */
  return across - across % 4 + (across % 4 + 6 - s) % 4;
}

/* ---- joints ---- */

static double largest(fs_vec3 a) { return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))); }

/* Whether two bicubic patches join C2 along side 1 of cell a: b_3 = c_0, and equal first and second differences. */
static bool is_smooth(const fs_surface *surface, int32_t a, int32_t b, double tolerance) {
  double worst = 0;
  for (int32_t j = 0; j < 4; j++) {
    fs_vec3 p[3], q[3];
    for (int32_t k = 0; k < 3; k++) p[k] = fs_step_point(surface, a, 3 - k, j), q[k] = fs_step_point(surface, b, k, j);
    worst = fmax(worst, largest(fs_vec3_sub(p[0], q[0])));
    worst = fmax(worst, largest(fs_vec3_sub(fs_vec3_sub(p[0], p[1]), fs_vec3_sub(q[1], q[0]))));
    worst = fmax(worst, largest(fs_vec3_sub(fs_vec3_add_scaled(fs_vec3_add(p[0], p[2]), p[1], -2),
                                            fs_vec3_add_scaled(fs_vec3_add(q[0], q[2]), q[1], -2))));
  }
  return worst <= tolerance;
}

static bool is_bicubic(const fs_patch *patch) {
  return fs_patch_is_tensor_bezier(patch) && patch->degree_u == 3 && patch->degree_v == 3;
}

/* smooth[4 n_patches] of sides. */
static void find_smooth_sides(const fs_surface *surface, double tolerance, uint8_t *smooth) {
  for (int32_t side = 0; side < 4 * surface->n_patches; side++) {
    int32_t across = fs_side_across(surface, side / 4, side % 4);
    int32_t cell = side - side % 4 + (side % 4 + 3) % 4; /* its side 1 is ours */
    if (across == FS_NONE || across < side) continue;
    if (!is_bicubic(&surface->patch[side / 4]) || !is_bicubic(&surface->patch[across / 4])) continue;
    smooth[side] = smooth[across] = is_smooth(surface, cell, fs_step_cross(surface, cell, 1), tolerance);
  }
}

/* ---- growth of one rectangle ---- */

typedef struct grower {
  const fs_surface *surface;
  fs_step_layout *layout;
  uint8_t *smooth;   /* [4 n_patches] sides across which bicubic patches join C2 */
  int32_t trial;     /* number of the rectangle that grows, from 1 */
  int32_t *trial_of; /* [n_corners] trial if the rectangle has the corner, else another number */
  int32_t *row;      /* [n_patches] cells to add */
} grower;

typedef struct rectangle {
  int32_t end[4];     /* cells at its corners: end[s] where side s starts */
  int32_t size[2];    /* cells along sides 0 and 2; along sides 1 and 3 */
  bool is_wrapped[2]; /* a row more in that direction would have touched the rectangle itself */
  bool is_done[4];    /* nothing more to add across that side */
} rectangle;

static bool take_corner(grower *g, int32_t cell, int32_t s) {
  int32_t *trial = &g->trial_of[g->layout->corner[fs_step_side(cell, s)]];
  if (*trial == g->trial) return false;
  *trial = g->trial;
  return true;
}

static void leave_corner(grower *g, int32_t cell, int32_t s) {
  g->trial_of[g->layout->corner[fs_step_side(cell, s)]] = 0;
}

static rectangle start(grower *g, int32_t patch) {
  rectangle r = {.size = {1, 1}};
  g->trial++;
  for (int32_t s = 0; s < 4; s++) {
    r.end[s] = 4 * patch;
    if (!take_corner(g, 4 * patch, s)) r.is_done[0] = r.is_done[1] = r.is_done[2] = r.is_done[3] = true;
  }
  return r;
}

/* Collects the cells across side s; false where one is missing, taken, or not smooth to its neighbours. */
static bool find_row(grower *g, const rectangle *r, int32_t s) {
  int32_t inner = r->end[s];
  for (int32_t k = 0; k < r->size[s % 2]; k++) {
    int32_t cell = fs_step_cross(g->surface, inner, s);
    if (!g->smooth[fs_step_side(inner, s)] || g->layout->face_of[cell / 4] != FS_NONE) return false;
    if (k > 0 && (fs_step_cross(g->surface, g->row[k - 1], (s + 1) % 4) != cell ||
                  !g->smooth[fs_step_side(g->row[k - 1], (s + 1) % 4)]))
      return false;
    g->row[k] = cell;
    inner = fs_step_cross(g->surface, inner, (s + 1) % 4);
  }
  return true;
}

/* Takes the corners at the far side of a row of n cells; none of them may be in the rectangle yet. */
static bool take_row(grower *g, int32_t n, int32_t s) {
  for (int32_t k = 0; k <= n; k++) {
    if (k == 0 ? take_corner(g, g->row[0], s) : take_corner(g, g->row[k - 1], (s + 1) % 4)) continue;
    while (--k > 0) leave_corner(g, g->row[k - 1], (s + 1) % 4);
    if (k == 0) leave_corner(g, g->row[0], s);
    return false;
  }
  return true;
}

static void extend(grower *g, rectangle *r, int32_t s, const int32_t max[2]) {
  int32_t n = r->size[s % 2], *size = &r->size[(s + 1) % 2];
  if (r->is_done[s]) return;
  r->is_done[s] = true;
  if (*size >= max[(s + 1) % 2] || !find_row(g, r, s)) return;
  if (!take_row(g, n, s)) {
    r->is_wrapped[(s + 1) % 2] = true;
    return;
  }
  r->end[s] = g->row[0], r->end[(s + 1) % 4] = g->row[n - 1];
  ++*size;
  r->is_done[s] = false;
}

static bool is_done(const rectangle *r, int32_t s) { return r->is_done[s] && r->is_done[(s + 2) % 4]; }

/* order 0: the two directions in turn; 1: first across sides 1 and 3; 2: first across 0 and 2. */
static rectangle grow(grower *g, int32_t patch, int32_t order, const int32_t max[2]) {
  rectangle r = start(g, patch);
  while (!is_done(&r, 0) || !is_done(&r, 1))
    for (int32_t s = 0; s < 4; s++)
      if (order == 0 || (order == 1) == (s % 2 == 1) || is_done(&r, order == 1 ? 1 : 0)) extend(g, &r, s, max);
  return r;
}

/* A rectangle that would meet itself around a tube is made again, half as long as the way around. */
static rectangle grow_open(grower *g, int32_t patch, int32_t order) {
  int32_t max[2] = {INT32_MAX, INT32_MAX};
  rectangle r = grow(g, patch, order, max);
  for (int32_t attempt = 0; attempt < 2 && (r.is_wrapped[0] || r.is_wrapped[1]); attempt++) {
    for (int32_t k = 0; k < 2; k++)
      if (r.is_wrapped[k]) max[k] = (r.size[k] + 2) / 2;
    r = grow(g, patch, order, max);
  }
  return r;
}

/* ---- the layout ---- */

static void add_face(const fs_surface *surface, fs_step_layout *layout, const rectangle *r) {
  int32_t row = r->end[0];
  layout->face[layout->n_faces] = (fs_step_face){row, r->size[0], r->size[1]};
  for (int32_t j = 0; j < r->size[1]; j++) {
    for (int32_t i = 0, cell = row; i < r->size[0]; i++, cell = fs_step_cross(surface, cell, 1)) {
      layout->face_of[cell / 4] = layout->n_faces;
      layout->turn[cell / 4] = (uint8_t)(cell % 4);
    }
    row = fs_step_cross(surface, row, 2);
  }
  layout->n_faces++;
}

static int64_t area(const rectangle *r) { return (int64_t)r->size[0] * r->size[1]; }

static void add_largest(grower *g, int32_t patch) {
  rectangle best = {.size = {0, 0}};
  for (int32_t order = 0; order < 3; order++) {
    rectangle r = grow_open(g, patch, order);
    if (area(&r) > area(&best)) best = r;
  }
  add_face(g->surface, g->layout, &best);
}

static fs_status merge(fs_context *ctx, const fs_surface *surface, double tolerance, fs_step_layout *layout) {
  fs_status status = FS_OK;
  grower g = {.surface = surface, .layout = layout};
  FS_ALLOC(ctx, g.smooth, 4 * (size_t)surface->n_patches);
  FS_ALLOC(ctx, g.trial_of, layout->n_corners);
  FS_ALLOC(ctx, g.row, surface->n_patches);
  find_smooth_sides(surface, tolerance, g.smooth);
  for (int32_t p = 0; p < surface->n_patches; p++)
    if (layout->face_of[p] == FS_NONE) add_largest(&g, p);
done:
  fs_release(ctx, g.smooth);
  fs_release(ctx, g.trial_of);
  fs_release(ctx, g.row);
  return status;
}

fs_status fs_step_layout_create(fs_context *ctx, const fs_surface *surface, bool is_merging, double tolerance,
                                fs_step_layout **layout) {
  fs_status status = FS_OK;
  fs_step_layout *made = NULL;
  size_t n = (size_t)surface->n_patches;
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, made->face, n);
  FS_ALLOC(ctx, made->face_of, n);
  FS_ALLOC(ctx, made->turn, n);
  FS_ALLOC(ctx, made->corner, 4 * n);
  FS_TRY(fs_surface_corners(ctx, surface, made->corner, &made->n_corners));
  for (int32_t p = 0; p < surface->n_patches; p++) made->face_of[p] = FS_NONE;
  if (is_merging) FS_TRY(merge(ctx, surface, tolerance, made));
  for (int32_t p = 0; !is_merging && p < surface->n_patches; p++)
    add_face(surface, made, &(rectangle){.end = {4 * p}, .size = {1, 1}});
  *layout = made;
  made = NULL;
done:
  fs_step_layout_free(ctx, made);
  return status;
}

void fs_step_layout_free(fs_context *ctx, fs_step_layout *layout) {
  if (layout == NULL) return;
  fs_release(ctx, layout->face);
  fs_release(ctx, layout->face_of);
  fs_release(ctx, layout->turn);
  fs_release(ctx, layout->corner);
  fs_release(ctx, layout);
}
