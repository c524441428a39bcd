/* SPDX-License-Identifier: MIT */
/* Single role: whether two triangles cut each other, and where.

   An edge of one cuts the other where its ends lie on both sides of the plane of the other, and the signed volumes of the edge
   with the three sides of the other have one sign [Moller Trumbore 1997, in the form of volumes]. Two triangles that are not
   coplanar cut each other if and only if one of the six edges does. Triangles that touch may count as cutting. */
#include "analyse/analyse.h"
#include "math/vec3.h"

/* 6 times the signed volume of the tetrahedron a, b, c, d. */
static double volume(fs_vec3 a, fs_vec3 b, fs_vec3 c, fs_vec3 d) {
  return fs_vec3_dot(fs_vec3_cross(fs_vec3_sub(b, a), fs_vec3_sub(c, a)), fs_vec3_sub(d, a));
}

/* Corners in the plane count as above it, so that a surface that crosses just through the corners of the triangles of another
   one is not missed. */
static bool is_above(double distance) { return distance >= 0; }

/* The points where edges of s pass through t, at most two are kept. distance[k]: of corner k of s from the plane of t, times
   a common positive factor. */
static int32_t pierce(const fs_vec3 *s, const fs_vec3 *t, const double *distance, int32_t n, fs_vec3 point[2]) {
  for (int k = 0; k < 3 && n < 2; k++) {
    fs_vec3 a = s[k], b = s[(k + 1) % 3];
    double da = distance[k], db = distance[(k + 1) % 3], v[3];
    if (is_above(da) == is_above(db)) continue;
    for (int i = 0; i < 3; i++) v[i] = volume(a, b, t[i], t[(i + 1) % 3]);
    if (!((v[0] >= 0 && v[1] >= 0 && v[2] >= 0) || (v[0] <= 0 && v[1] <= 0 && v[2] <= 0))) continue;
    point[n++] = fs_vec3_add_scaled(a, fs_vec3_sub(b, a), da / (da - db));
  }
  return n;
}

static bool one_side(const double d[3]) { return is_above(d[0]) == is_above(d[1]) && is_above(d[0]) == is_above(d[2]); }

bool fs_triangles_cut(const fs_vec3 s[3], const fs_vec3 t[3], fs_vec3 *point) {
  fs_vec3 found[2], normal = fs_vec3_cross(fs_vec3_sub(t[1], t[0]), fs_vec3_sub(t[2], t[0]));
  double ds[3], dt[3];
  int32_t n;
  for (int k = 0; k < 3; k++) ds[k] = fs_vec3_dot(normal, fs_vec3_sub(s[k], t[0]));
  if (one_side(ds)) return false;
  normal = fs_vec3_cross(fs_vec3_sub(s[1], s[0]), fs_vec3_sub(s[2], s[0]));
  for (int k = 0; k < 3; k++) dt[k] = fs_vec3_dot(normal, fs_vec3_sub(t[k], s[0]));
  if (one_side(dt)) return false;
  n = pierce(s, t, ds, 0, found);
  n = pierce(t, s, dt, n, found);
  if (n == 0) return false;
  *point = n == 1 ? found[0] : fs_vec3_scale(fs_vec3_add(found[0], found[1]), 0.5);
  return true;
}
