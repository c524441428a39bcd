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
  return patch->kind == FS_PATCH_TENSOR_BEZIER && patch->degree_u == 3 && patch->degree_v == 3;
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
  uint8_t *smooth;
  int32_t trial;                       /* number of the rectangle that grows, from 1 */
  int32_t *trial_of, *trial_of_corner; /* [n_patches], [n_corners] rectangle that holds it, or an older one */
  int32_t *old;                        /* [n_patches + 1] of corners, to undo a step that fails */
} grower;

typedef struct rectangle {
  int32_t end[4];     /* cells at its corners: end[s] where side s starts */
  int32_t size[2];    /* cells along sides 0 and 2, along sides 1 and 3 */
  bool is_wrapped[2]; /* growth across sides 1 and 3, 0 and 2 met the rectangle itself */
} rectangle;

/* Marks the corner at end e (0 start, 1 end) of side s of a cell; false where the rectangle has it already. */
static bool take_corner(grower *g, int32_t cell, int32_t s, int32_t *old) {
  int32_t corner = g->layout->corner[fs_step_side(cell, s)];
  if (g->trial_of_corner[corner] == g->trial) return false;
  *old = g->trial_of_corner[corner];
  g->trial_of_corner[corner] = g->trial;
  return true;
}

static void start(grower *g, int32_t patch, rectangle *r) {
  int32_t old;
  g->trial++;
  *r = (rectangle){.size = {1, 1}};
  for (int32_t s = 0; s < 4; s++) {
    r->end[s] = 4 * patch;
    if (!take_corner(g, 4 * patch, s, &old)) r->is_wrapped[0] = r->is_wrapped[1] = true;
  }
  g->trial_of[patch] = g->trial;
}

/* Cells to add across side s, from its start: whether number k may follow the one before it. */
static bool is_addable(const grower *g, int32_t inner, int32_t s, int32_t before, int32_t cell) {
  if (cell == FS_NONE || !g->smooth[fs_step_side(inner, s)] || g->layout->face_of[cell / 4] != FS_NONE) return false;
  return before == FS_NONE ||
         (fs_step_cross(g->surface, before, (s + 1) % 4) == cell && g->smooth[fs_step_side(before, (s + 1) % 4)]);
}

/* One row more across side s. The corners at its far side, one more than cells, must be new. */
static bool extend(grower *g, rectangle *r, int32_t s) {
  int32_t n = r->size[s % 2], inner = r->end[s], before = FS_NONE, cell = FS_NONE, first = FS_NONE, n_taken = 0;
  bool is_free = true;
  for (int32_t k = 0; k < n && is_free; k++, before = cell) {
    cell = fs_step_cross(g->surface, inner, s);
    if (!is_addable(g, inner, s, before, cell)) {
      is_free = false;
      break;
    }
    is_free = g->trial_of[cell / 4] != g->trial;
    if (k == 0) {
      first = cell;
      if (is_free) is_free = take_corner(g, cell, s, &g->old[n_taken]);
      if (is_free) n_taken++;
    }
    if (is_free) is_free = take_corner(g, cell, (s + 1) % 4, &g->old[n_taken]);
    if (is_free)
      n_taken++;
    else
      r->is_wrapped[(s + 1) % 2] = true;
    if (k + 1 < n) inner = fs_step_cross(g->surface, inner, (s + 1) % 4);
  }
  cell = first;
  for (int32_t k = 0; k < (is_free ? n : n_taken - 1) || (!is_free && k == 0 && n_taken > 0); k++) {
    if (is_free) {
      g->trial_of[cell / 4] = g->trial;
    } else {
      if (k == 0) g->trial_of_corner[g->layout->corner[fs_step_side(cell, s)]] = g->old[0];
      if (k + 1 < n_taken) g->trial_of_corner[g->layout->corner[fs_step_side(cell, (s + 1) % 4)]] = g->old[k + 1];
    }
    before = cell;
    if (k + 1 < n) cell = fs_step_cross(g->surface, cell, (s + 1) % 4);
  }
  if (!is_free) return false;
  r->end[s] = first, r->end[(s + 1) % 4] = before;
  r->size[(s + 1) % 2]++;
  return true;
}
