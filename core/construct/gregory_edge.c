/* SPDX-License-Identifier: MIT */
/* Single role: the cubic over an edge from its ends and their normals.

   d = b - a, D = |d|, p = d - (d . n) n the edge in the tangent plane of an end, l = |p|. The inner points are a + t_a and
   b - t_b, with
     arc   t = p / l 2 D / (3 (1 + l / D)): an arc of radius r and angle f has l / D = cos(f / 2) and the tangent length
           4/3 r tan(f / 4) of its usual cubic, and that is this length
     pn    t = p / 3                                             [Vlachos Peters Boyd Mitchell 2001]
     wm    a + D (6 G - 2 rho m + sigma n) / 18, b - D (6 G + rho m - 2 sigma n) / 18 with G = d / D, c = m . n,
           rho = 6 (2 m . G + c n . G) / (4 - c^2), sigma = 6 (2 n . G + c m . G) / (4 - c^2)   [Walton Meek 1996] */
#include "construct/gregory.h"
#include "math/vec3.h"

/* t at an end with normal n; l < 1e-9 D is a fault. */
static bool tangent(fs_vec3 d, double length, fs_vec3 n, fs_edge_rule rule, fs_vec3 *t) {
  fs_vec3 p = fs_vec3_add_scaled(d, n, -fs_vec3_dot(d, n));
  double l = fs_vec3_length(p);
  if (!(l >= 1e-9 * length)) return false;
  *t = fs_vec3_scale(p, rule == FS_EDGE_PN ? 1.0 / 3 : 2 * length / (3 * (1 + l / length) * l));
  return true;
}

static void walton_meek(fs_vec3 a, fs_vec3 b, fs_vec3 m, fs_vec3 n, double length, fs_vec3 *point) {
  fs_vec3 along = fs_vec3_scale(fs_vec3_sub(b, a), 1 / length), p, q;
  double c = fs_vec3_dot(m, n), a0 = fs_vec3_dot(m, along), a1 = fs_vec3_dot(n, along);
  double rho = 6 * (2 * a0 + c * a1) / (4 - c * c), sigma = 6 * (2 * a1 + c * a0) / (4 - c * c);
  p = fs_vec3_add_scaled(fs_vec3_add_scaled(fs_vec3_scale(along, 6), m, -2 * rho), n, sigma);
  q = fs_vec3_add_scaled(fs_vec3_add_scaled(fs_vec3_scale(along, 6), m, rho), n, -2 * sigma);
  point[1] = fs_vec3_add_scaled(a, p, length / 18);
  point[2] = fs_vec3_add_scaled(b, q, -length / 18);
}

fs_gregory_fault fs_gregory_edge(fs_vec3 a, fs_vec3 b, fs_vec3 m, fs_vec3 n, fs_edge_rule rule, fs_vec3 *point) {
  fs_vec3 d = fs_vec3_sub(b, a), start, end;
  double length = fs_vec3_length(d);
  if (!(length > 0)) return FS_GREGORY_NO_LENGTH;
  if (!tangent(d, length, m, rule, &start) || !tangent(d, length, n, rule, &end)) return FS_GREGORY_ALONG_NORMAL;
  point[0] = a, point[3] = b;
  if (rule == FS_EDGE_WM)
    walton_meek(a, b, m, n, length, point);
  else
    point[1] = fs_vec3_add(a, start), point[2] = fs_vec3_sub(b, end);
  return FS_GREGORY_FINE;
}
