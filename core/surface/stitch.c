/* SPDX-License-Identifier: MIT */
/* Single role: finds the sides that patches share where nobody has said so. Sides are compared in five points; candidates
   come from an order of their middles along a line that no common model has its sides across, so that few are compared. */
#include "surface/surface.h"
#include "math/vec3.h"

#include <stdlib.h>

enum { N_POINTS = 5 };

typedef struct open_side {
  int32_t patch, side;
  fs_vec3 point[N_POINTS]; /* at t = 0, 1/4, … 1 */
  double key;              /* of the middle, on a line of unit direction */
} open_side;

static int by_middle(const void *a, const void *b) {
  const open_side *p = a, *q = b;
  if (p->key != q->key) return p->key < q->key ? -1 : 1;
  if (p->patch != q->patch) return p->patch < q->patch ? -1 : 1;
  return p->side - q->side;
}

/* Whether two sides agree within near, the second run backwards or (is_same_way) forwards. */
static bool agree(const open_side *a, const open_side *b, bool is_same_way, double near) {
  for (int i = 0; i < N_POINTS; i++)
    if (!(fs_vec3_distance(a->point[i], b->point[is_same_way ? i : N_POINTS - 1 - i]) <= near)) return false;
  return true;
}

static bool has_length(const open_side *s, double near) {
  for (int i = 1; i < N_POINTS; i++)
    if (fs_vec3_distance(s->point[0], s->point[i]) > near) return true;
  return false;
}

/* Fills sides with those that have no neighbour, and the size of the surface: its bounding box at corners and sides. */
static int32_t collect(const fs_surface *surface, open_side *sides, double *size) {
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY}, x[FS_JET_SIZE];
  int32_t n = 0;
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      open_side *o = &sides[n];
      o->patch = p, o->side = s;
      for (int i = 0; i < N_POINTS; i++) {
        double u, v;
        fs_side_parameters(surface->patch[p].n_sides, s, (double)i / (N_POINTS - 1), &u, &v);
        fs_surface_evaluate(surface, p, u, v, x);
        o->point[i] = x[FS_D];
        low = fs_vec3_min(low, x[FS_D]), high = fs_vec3_max(high, x[FS_D]);
      }
      o->key = fs_vec3_dot(o->point[N_POINTS / 2], (fs_vec3){0.7272, 0.5489, 0.4121});
      n += surface->patch[p].neighbour[s] == FS_NONE;
    }
  *size = n > 0 ? fs_vec3_distance(low, high) : 0;
  return n;
}

/* The only other side that agrees with side k, or FS_NONE; n_same counts those that run the same way. */
static int32_t find_partner(const open_side *sides, int32_t n, int32_t k, double near, int32_t *n_same) {
  int32_t partner = FS_NONE, n_partners = 0;
  for (int step = -1; step <= 1; step += 2)
    for (int32_t i = k + step; i >= 0 && i < n; i += step) {
      if (n_partners > 1 || !(fabs(sides[i].key - sides[k].key) <= 2 * near)) break;
      if (agree(&sides[k], &sides[i], true, near)) ++*n_same, n_partners++;
      if (!agree(&sides[k], &sides[i], false, near)) continue;
      partner = i;
      n_partners++;
    }
  return n_partners == 1 ? partner : FS_NONE;
}

fs_status fs_surface_stitch(fs_context *ctx, fs_surface *surface, double tolerance, int32_t *n_joined) {
  fs_status status = FS_OK;
  open_side *sides = NULL;
  int32_t *partner = NULL, n, n_pairs = 0, n_same = 0;
  double size = 0;
  FS_ALLOC(ctx, sides, 4 * (size_t)surface->n_patches + 1);
  n = collect(surface, sides, &size);
  FS_ALLOC(ctx, partner, n);
  qsort(sides, (size_t)n, sizeof *sides, by_middle);
  for (int32_t k = 0; k < n; k++) {
    if (k % 1024 == 0) FS_TRY(fs_progress(ctx, "join patches", (double)k / n));
    partner[k] =
        has_length(&sides[k], tolerance * size) ? find_partner(sides, n, k, tolerance * size, &n_same) : FS_NONE;
  }
  for (int32_t k = 0; k < n; k++) {
    int32_t other = partner[k];
    if (other < k || partner[other] != k) continue;
    const open_side *a = &sides[k], *b = &sides[other];
    surface->patch[a->patch].neighbour[a->side] = b->patch;
    surface->patch[a->patch].neighbour_side[a->side] = (uint8_t)b->side;
    surface->patch[b->patch].neighbour[b->side] = a->patch;
    surface->patch[b->patch].neighbour_side[b->side] = (uint8_t)a->side;
    n_pairs++;
  }
  if (n_same > 0)
    fs_note(ctx, "%d pairs of sides coincide but are not joined: their patches show opposite faces", (int)(n_same / 2));
  if (n_joined != NULL) *n_joined = n_pairs;
done:
  fs_release(ctx, sides);
  fs_release(ctx, partner);
  return status;
}
