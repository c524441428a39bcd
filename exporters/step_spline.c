/* SPDX-License-Identifier: MIT */
/* Single role: control points of edges and faces. Pieces that join C2 become one clamped cubic spline on the knots
   0, 0, 0, 0, 1, .., n - 1, n, n, n, n. With blossoms f of its pieces [Ramshaw 1989; Farin, Curves and Surfaces for CAGD]
   its points are f(0,0,0), f(0,0,1), f(a-1,a,a+1) for a = 1 .. n - 1, f(n-1,n,n), f(n,n,n); from the Bezier points b of the
   piece left of the joint a and c right of it f(a-1,a,a+1) = 2 b_2 - b_1 = 2 c_1 - c_2, of which the mean is taken. */
#include "step.h"
#include "base/base.h"
#include "math/bernstein.h"
#include "math/vec3.h"
#include "surface/surface.h"

fs_vec3 fs_step_point(const fs_surface *surface, int32_t cell, int32_t i, int32_t j) {
  const fs_patch *patch = &surface->patch[cell / 4];
  int32_t n = patch->degree_u, m = patch->degree_v, k, l;
  const double *b;
  switch (cell % 4) {
  case 0:
    k = i, l = j;
    break;
  case 1:
    k = n - j, l = i;
    break;
  case 2:
    k = n - i, l = m - j;
    break;
  default:
    k = j, l = m - i;
    break;
  }
  b = surface->data + patch->data_start + 3 * ((size_t)k + (size_t)(n + 1) * (size_t)l);
  return (fs_vec3){b[0], b[1], b[2]};
}

void fs_step_degrees(const fs_surface *surface, int32_t cell, int32_t *degree_u, int32_t *degree_v) {
  const fs_patch *patch = &surface->patch[cell / 4];
  *degree_u = cell % 2 == 0 ? patch->degree_u : patch->degree_v;
  *degree_v = cell % 2 == 0 ? patch->degree_v : patch->degree_u;
}

/* Turns the Bezier points [4 n] of n pieces, stride apart, into the [n + 3] of their spline, in place: point a + 1 of it
   comes from later points only. */
static void join(int32_t n, size_t stride, fs_vec3 *points) {
  for (int32_t a = 1; a < n; a++) {
    const fs_vec3 *b = points + 4 * (size_t)(a - 1) * stride, *c = b + 4 * stride;
    fs_vec3 from_left = fs_vec3_sub(fs_vec3_scale(b[2 * stride], 2), b[stride]);
    fs_vec3 from_right = fs_vec3_sub(fs_vec3_scale(c[stride], 2), c[2 * stride]);
    points[(size_t)(a + 1) * stride] = fs_vec3_scale(fs_vec3_add(from_left, from_right), 0.5);
  }
  points[(size_t)(n + 1) * stride] = points[(size_t)(4 * n - 2) * stride];
  points[(size_t)(n + 2) * stride] = points[(size_t)(4 * n - 1) * stride];
}

/* Points along a side, anticlockwise: points[degree + 1]. */
static int32_t take_side(const fs_surface *surface, int32_t side, fs_vec3 *points) {
  int32_t n, m;
  fs_step_degrees(surface, side, &n, &m);
  for (int32_t i = 0; i <= n; i++) points[i] = fs_step_point(surface, side, i, 0);
  return n;
}

static int32_t side_degree(const fs_surface *surface, int32_t side) {
  int32_t n, m;
  fs_step_degrees(surface, side, &n, &m);
  return n;
}

/* The cubic with the same ends and end tangents, where it is the same curve. */
static int32_t reduce(int32_t n, double tolerance, fs_vec3 *points) {
  fs_vec3 first = points[0], last = points[n], raised[FS_MAX_DEGREE + 1];
  fs_vec3 cubic[4] = {first, fs_vec3_add_scaled(first, fs_vec3_sub(points[1], first), n / 3.),
                      fs_vec3_add_scaled(last, fs_vec3_sub(points[n - 1], last), n / 3.), last};
  if (n <= 3) return n;
  fs_bernstein_elevate(3, 3, &cubic[0].x, n, &raised[0].x);
  for (int32_t i = 0; i <= n; i++)
    if (!(fs_vec3_distance(raised[i], points[i]) <= tolerance)) return n;
  for (int32_t i = 0; i < 4; i++) points[i] = cubic[i];
  return 3;
}

/* Of one side: the points of the patch of lower degree. */
static int32_t take_single(const fs_surface *surface, int32_t side, double tolerance, fs_vec3 *points) {
  int32_t across = fs_side_across(surface, side / 4, side % 4), n;
  if (across == FS_NONE || side_degree(surface, side) <= side_degree(surface, across)) {
    n = take_side(surface, side, points);
  } else {
    n = take_side(surface, across, points);
    for (int32_t i = 0; i < n - i; i++) {
      fs_vec3 p = points[i];
      points[i] = points[n - i];
      points[n - i] = p;
    }
  }
  return reduce(n, tolerance, points);
}

fs_step_curve fs_step_edge_curve(const fs_surface *surface, const fs_step_edge *edge, double tolerance, fs_vec3 start,
                                 fs_vec3 end, fs_vec3 *points) {
  fs_step_curve curve = {3, edge->n_sides};
  if (edge->n_sides == 1) curve.degree = take_single(surface, edge->first, tolerance, points);
  /* a side is also the number of the cell that has it at its bottom */
  for (int32_t k = 0, side = edge->first; edge->n_sides > 1 && k < edge->n_sides; k++) {
    take_side(surface, side, points + 4 * (size_t)k);
    side = fs_step_cross(surface, side, 1);
  }
  if (edge->n_sides > 1) join(edge->n_sides, 1, points);
  points[0] = start;
  points[curve.degree + curve.n_pieces - 1] = end;
  return curve;
}

void fs_step_face_surface(const fs_surface *surface, const fs_step_face *face, fs_step_curve *u, fs_step_curve *v,
                          fs_vec3 *points) {
  int32_t n, m, row = face->cell;
  fs_step_degrees(surface, face->cell, &n, &m);
  size_t pitch = (size_t)(n + 1) * (size_t)face->n, n_points = (size_t)n + (size_t)face->n;
  for (int32_t b = 0; b < face->m; b++) {
    for (int32_t a = 0, cell = row; a < face->n; a++, cell = fs_step_cross(surface, cell, 1))
      for (int32_t j = 0; j <= m; j++)
        for (int32_t i = 0; i <= n; i++)
          points[(size_t)((n + 1) * a + i) + pitch * (size_t)((m + 1) * b + j)] = fs_step_point(surface, cell, i, j);
    if (b + 1 < face->m) row = fs_step_cross(surface, row, 2);
  }
  for (size_t j = 0; face->n > 1 && j < (size_t)(m + 1) * (size_t)face->m; j++) join(face->n, 1, points + pitch * j);
  for (size_t i = 0; face->m > 1 && i < n_points; i++) join(face->m, pitch, points + i);
  for (size_t j = 1; j < (size_t)m + (size_t)face->m; j++)
    for (size_t i = 0; i < n_points; i++) points[i + n_points * j] = points[i + pitch * j];
  *u = (fs_step_curve){n, face->n};
  *v = (fs_step_curve){m, face->m};
}
