/* SPDX-License-Identifier: MIT */
/* Single role: steps along lines of curvature.

   With the unit principal direction e, (u, v)' = G^-1 (p_u . e, p_v . e) by arc length. A step is the Runge-Kutta pair of
   orders 3 and 2 of Bogacki and Shampine (1989); its error, as a length on the surface, decides on the next. Patches are
   polynomials or nearly so, and stages may lie a little outside of them; a step that ends outside is shortened until it ends
   on the side, and the walk goes on from the same point of the neighbour, along the same direction in space. */
#include "analyse/walk.h"
#include "math/diffgeo.h"
#include "math/vec3.h"

enum { MAX_TRIES = 60 };

/* A line that runs along a side leaves the patch by rounding: as far outside as this, in parameters, is on the side. */
static const double slack = 1e-7;

/* Direction of the family at (u, v) of the walker's patch, turned to go along; velocity[2] in the parameters. */
static bool direction_at(const fs_walker *w, double u, double v, fs_vec3 along, fs_vec3 *direction,
                         double velocity[2]) {
  fs_vec3 x[FS_JET_SIZE], e;
  fs_geometry g;
  fs_principal principal;
  double p, q, det;
  fs_surface_evaluate(w->surface, w->place.patch, u, v, x);
  if (!fs_geometry_compute(x, &g)) return false;
  fs_geometry_principal(&g, &principal);
  double bend = fmax(fabs(principal.maximum), fabs(principal.minimum));
  if (!(principal.maximum - principal.minimum > 1e-5 * bend)) return false;
  e = w->family == 0 ? principal.maximum_direction : principal.minimum_direction;
  if (fs_vec3_dot(e, along) < 0) e = fs_vec3_scale(e, -1);
  p = fs_vec3_dot(x[FS_DU], e), q = fs_vec3_dot(x[FS_DV], e);
  det = g.g11 * g.g22 - g.g12 * g.g12;
  velocity[0] = (g.g22 * p - g.g12 * q) / det, velocity[1] = (g.g11 * q - g.g12 * p) / det;
  *direction = e;
  return true;
}

bool fs_walker_start(fs_walker *w, fs_place place, fs_vec3 along) {
  double velocity[2];
  fs_curve_point point;
  w->place = place;
  if (!direction_at(w, place.u, place.v, along, &w->direction, velocity)) return false;
  point = fs_curve_point_at(w->surface, place.patch, place.u, place.v);
  w->position = point.position, w->normal = point.normal;
  return true;
}

/* A step of length h from the walker's place: to[2], and its error in the parameters. */
static bool try_step(const fs_walker *w, double h, double to[2], double error[2]) {
  double u = w->place.u, v = w->place.v, k1[2], k2[2], k3[2], k4[2];
  fs_vec3 d1, d2, d3, d4;
  if (!direction_at(w, u, v, w->direction, &d1, k1)) return false;
  if (!direction_at(w, u + h / 2 * k1[0], v + h / 2 * k1[1], d1, &d2, k2)) return false;
  if (!direction_at(w, u + 3 * h / 4 * k2[0], v + 3 * h / 4 * k2[1], d2, &d3, k3)) return false;
  to[0] = u + h * (2 * k1[0] + 3 * k2[0] + 4 * k3[0]) / 9, to[1] = v + h * (2 * k1[1] + 3 * k2[1] + 4 * k3[1]) / 9;
  if (!direction_at(w, to[0], to[1], d3, &d4, k4)) return false;
  for (int i = 0; i < 2; i++) error[i] = h * (-5 * k1[i] / 72 + k2[i] / 12 + k3[i] / 9 - k4[i] / 8);
  return true;
}

static double outside(const double uv[2]) { return fmax(fmax(-uv[0], uv[0] - 1), fmax(-uv[1], uv[1] - 1)); }

static double length_of(const fs_walker *w, const double uv[2], const double d[2]) {
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(w->surface, w->place.patch, uv[0], uv[1], x);
  return fs_vec3_length(fs_vec3_add_scaled(fs_vec3_scale(x[FS_DU], d[0]), x[FS_DV], d[1]));
}

/* The side that (u, v) lies on or beyond. */
static int32_t side_of(const double uv[2]) {
  const double beyond[4] = {-uv[1], uv[0] - 1, uv[1] - 1, -uv[0]};
  int32_t side = 0;
  for (int32_t s = 1; s < 4; s++)
    if (beyond[s] > beyond[side]) side = s;
  return side;
}

/* The walker, on a side of its patch, goes over to the neighbour. */
static fs_walk_end cross(fs_walker *w, const double uv[2]) {
  const fs_patch *patch = &w->surface->patch[w->place.patch];
  int32_t side = side_of(uv);
  double t = side == 0 ? uv[0] : side == 1 ? uv[1] : side == 2 ? 1 - uv[0] : 1 - uv[1];
  fs_place place = {.patch = patch->neighbour[side]};
  fs_vec3 along = w->direction;
  double at[2] = {fmin(fmax(uv[0], 0), 1), fmin(fmax(uv[1], 0), 1)};
  fs_curve_point end = fs_curve_point_at(w->surface, w->place.patch, at[0], at[1]);
  w->place.u = at[0], w->place.v = at[1], w->position = end.position, w->normal = end.normal;
  if (place.patch == FS_NONE) return FS_WALK_BORDER;
  fs_side_parameters(4, patch->neighbour_side[side], 1 - fmin(fmax(t, 0), 1), &place.u, &place.v);
  return fs_walker_start(w, place, along) ? FS_WALK_GOES_ON : FS_WALK_UMBILIC;
}

fs_walk_end fs_walker_step(fs_walker *w, double *length, double *done) {
  double h = *length, to[2], error[2], e, inside = 0, beyond;
  for (int k = 0;; k++) {
    /* steps that must be shorter than the error they may have: directions turn without limit */
    if (k == MAX_TRIES || (k > 0 && h < 0.01 * w->tolerance)) return FS_WALK_UMBILIC;
    if (!try_step(w, h, to, error)) {
      h /= 2;
      continue;
    }
    e = length_of(w, to, error);
    if (e <= w->tolerance) break;
    h *= fmax(0.2, 0.9 * cbrt(w->tolerance / e));
  }
  *length = h * fmin(4, 0.9 * cbrt(w->tolerance / fmax(e, 1e-300)));
  *done = h;
  if (!(outside(to) > slack)) {
    fs_place place = {w->place.patch, fmin(fmax(to[0], 0), 1), fmin(fmax(to[1], 0), 1)};
    fs_vec3 before = w->position, along = w->direction;
    if (!fs_walker_start(w, place, along)) return FS_WALK_UMBILIC;
    /* a step as short as the tolerance allows that turns by 60 degrees, or gets nowhere, goes around an umbilic */
    bool is_turned = fs_vec3_dot(w->direction, along) < 0.5 || fs_vec3_distance(w->position, before) < 0.5 * h;
    return is_turned ? FS_WALK_UMBILIC : FS_WALK_GOES_ON;
  }
  beyond = h;
  for (int k = 0; k < MAX_TRIES && beyond - inside > 1e-11 * h; k++) { /* the length that ends on the side */
    double middle = 0.5 * (inside + beyond), m[2];
    if (!try_step(w, middle, m, error)) return FS_WALK_UMBILIC;
    if (outside(m) > slack)
      beyond = middle, to[0] = m[0], to[1] = m[1];
    else
      inside = middle;
  }
  *done = beyond;
  double velocity[2];
  fs_vec3 direction;
  if (direction_at(w, to[0], to[1], w->direction, &direction, velocity)) w->direction = direction;
  return cross(w, to);
}
