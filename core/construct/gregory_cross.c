/* SPDX-License-Identifier: MIT */
/* Single role: derivatives across an edge that lie in one tangent plane with those of the neighbour
   [Chiyokura Kimura 1983; docs/patches.md, B].

   c_i are the differences of the points of the edge, b_0 and b_3 the unit vectors n x c_0, n x c_2 of the tangent planes at
   its ends, which point into the face, and b(t) goes linearly from one to the other. A derivative across the edge with the
   given ends a_0, a_3 is, over 3,
     k(t) b(t) + h(t) c'(t) / 3,   k_0 = a_0 . b_0,  h_0 = a_0 . c_0 / c_0 . c_0,  k_1, h_1 likewise at the other end.
   The neighbour has -b(1 - t): both tangent planes are those of c' and b, which belong to the edge. */
#include "construct/gregory.h"
#include "math/vec3.h"

static fs_vec3 sum3(fs_vec3 a, double x, fs_vec3 b, double y, fs_vec3 c, double z) {
  return fs_vec3_add_scaled(fs_vec3_add_scaled(fs_vec3_scale(a, x), b, y), c, z);
}

/* Whether c' and b span a plane at all of 9 parameters. */
static bool has_planes(const fs_vec3 *c, fs_vec3 b0, fs_vec3 b3) {
  for (int i = 0; i <= 8; i++) {
    double t = i / 8.0, s = 1 - t;
    fs_vec3 along = sum3(c[0], s * s, c[1], 2 * s * t, c[2], t * t);
    fs_vec3 across = fs_vec3_add_scaled(fs_vec3_scale(b0, s), b3, t);
    double area = fs_vec3_length(fs_vec3_cross(along, across));
    if (!(area > 1e-8 * fs_vec3_length(along))) return false;
  }
  return true;
}

fs_gregory_fault fs_gregory_cross(const fs_vec3 *edge, fs_vec3 m, fs_vec3 n, fs_vec3 first, fs_vec3 last,
                                  fs_gregory_field *field) {
  const fs_vec3 c[3] = {fs_vec3_sub(edge[1], edge[0]), fs_vec3_sub(edge[2], edge[1]), fs_vec3_sub(edge[3], edge[2])};
  fs_vec3 b0 = fs_vec3_cross(m, c[0]), b3 = fs_vec3_cross(n, c[2]);
  b0 = fs_vec3_scale(b0, 1 / fs_vec3_length(b0));
  b3 = fs_vec3_scale(b3, 1 / fs_vec3_length(b3));
  double k0 = fs_vec3_dot(first, b0), h0 = fs_vec3_dot(first, c[0]) / fs_vec3_dot(c[0], c[0]);
  double k1 = fs_vec3_dot(last, b3), h1 = fs_vec3_dot(last, c[2]) / fs_vec3_dot(c[2], c[2]);
  /* an angle below 1e-9 is none */
  if (!(k0 > 1e-9 * fs_vec3_length(first))) return FS_GREGORY_REFLEX_START;
  if (!(k1 > 1e-9 * fs_vec3_length(last))) return FS_GREGORY_REFLEX_END;
  if (!has_planes(c, b0, b3)) return FS_GREGORY_TURNS_OVER;
  field->k[0] = k0, field->k[1] = k1;
  field->h[0] = h0, field->h[1] = h1;
  fs_vec3 across1 = fs_vec3_add_scaled(fs_vec3_scale(b0, (k0 + k1) / 3), b3, k0 / 3);
  fs_vec3 across2 = fs_vec3_add_scaled(fs_vec3_scale(b3, (k0 + k1) / 3), b0, k1 / 3);
  field->inner[0] = sum3(across1, 1, c[1], 2 * h0 / 3, c[0], h1 / 3);
  field->inner[1] = sum3(across2, 1, c[2], h0 / 3, c[1], 2 * h1 / 3);
  return FS_GREGORY_FINE;
}
