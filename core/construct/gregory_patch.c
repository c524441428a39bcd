/* SPDX-License-Identifier: MIT */
/* Single role: the points of one Gregory quad or triangle from its corners and normals.

   Side e has the cubic P_0 .. P_3 over its edge. Its derivative across, in the direction of the parameter, starts and ends
   with the first differences of the neighbouring sides; in a triangle the direction towards the third corner turns, and the
   second of them gets the last difference of the side itself added. The middle coefficients a_1, a_2 give inner points:
     quad        P_1 + a_1 near corner e, P_2 + a_2 near corner e + 1
     triangle    (P_0 + 3 P_1) / 4 + 3/4 a_1,  (P_1 + P_2) / 2 + 3/4 a_2: the side is raised to degree 4
   [Chiyokura Kimura 1983; Longhi 1985; docs/patches.md, B]. */
#include "construct/gregory.h"
#include "math/vec3.h"

enum { MOST = 4 };

typedef struct sides {
  int32_t n;
  fs_vec3 edge[MOST][4], inner[MOST][2]; /* cubics; a_1, a_2 */
} sides;

/* Cubics run from the lower to the higher number, and are turned if need be: both faces get the same numbers. */
static fs_gregory_fault set_edges(const fs_vec3 *corner, const fs_vec3 *normal, const int32_t *number,
                                  fs_edge_rule rule, sides *s, int32_t *side) {
  for (int32_t e = 0; e < s->n; e++) {
    int32_t f = (e + 1) % s->n;
    bool is_forward = number[e] < number[f];
    int32_t a = is_forward ? e : f, b = is_forward ? f : e;
    fs_vec3 point[4];
    fs_gregory_fault fault = fs_gregory_edge(corner[a], corner[b], normal[a], normal[b], rule, point);
    *side = e;
    if (fault != FS_GREGORY_FINE) return fault;
    for (int k = 0; k < 4; k++) s->edge[e][k] = point[is_forward ? k : 3 - k];
  }
  return FS_GREGORY_FINE;
}

static fs_gregory_fault set_inner(const fs_vec3 *normal, sides *s, int32_t *side) {
  for (int32_t e = 0; e < s->n; e++) {
    const fs_vec3 *edge = s->edge[e], *next = s->edge[(e + 1) % s->n], *previous = s->edge[(e + s->n - 1) % s->n];
    fs_vec3 first = fs_vec3_sub(previous[2], previous[3]), last = fs_vec3_sub(next[1], next[0]);
    fs_gregory_field field;
    if (s->n == 3) last = fs_vec3_add(last, fs_vec3_sub(edge[3], edge[2]));
    fs_gregory_fault fault = fs_gregory_cross(edge, normal[e], normal[(e + 1) % s->n], first, last, &field);
    *side = e;
    if (fault != FS_GREGORY_FINE) return fault;
    s->inner[e][0] = field.inner[0], s->inner[e][1] = field.inner[1];
  }
  return FS_GREGORY_FINE;
}

fs_gregory_fault fs_gregory_quad(const fs_vec3 *corner, const fs_vec3 *normal, const int32_t *number, fs_edge_rule rule,
                                 fs_vec3 *point, int32_t *side) {
  /* points of the sides; then inner points of side e: p for the sides 1 and 3, q for the sides 0 and 2 */
  static const uint8_t at[4][4] = {{0, 1, 2, 3}, {3, 7, 11, 15}, {15, 14, 13, 12}, {12, 8, 4, 0}};
  static const uint8_t inner[4][2] = {{16, 17}, {6, 10}, {19, 18}, {9, 5}};
  sides s = {.n = 4};
  fs_gregory_fault fault = set_edges(corner, normal, number, rule, &s, side);
  if (fault == FS_GREGORY_FINE) fault = set_inner(normal, &s, side);
  if (fault != FS_GREGORY_FINE) return fault;
  for (int e = 0; e < 4; e++) {
    for (int k = 0; k < 4; k++) point[at[e][k]] = s.edge[e][k];
    point[inner[e][0]] = fs_vec3_add(s.edge[e][1], s.inner[e][0]);
    point[inner[e][1]] = fs_vec3_add(s.edge[e][2], s.inner[e][1]);
  }
  return FS_GREGORY_FINE;
}

fs_gregory_fault fs_gregory_triangle(const fs_vec3 *corner, const fs_vec3 *normal, const int32_t *number,
                                     fs_edge_rule rule, fs_vec3 *point, int32_t *side) {
  static const uint8_t at[3][5] = {{0, 1, 2, 3, 4}, {4, 8, 11, 13, 14}, {14, 12, 9, 5, 0}};
  static const uint8_t q_start[3] = {15, 16, 17}, p_end[3] = {7, 10, 6};
  sides s = {.n = 3};
  fs_gregory_fault fault = set_edges(corner, normal, number, rule, &s, side);
  if (fault == FS_GREGORY_FINE) fault = set_inner(normal, &s, side);
  if (fault != FS_GREGORY_FINE) return fault;
  for (int e = 0; e < 3; e++) {
    const fs_vec3 *P = s.edge[e];
    fs_vec3 raised[5] = {P[0], fs_vec3_scale(fs_vec3_add_scaled(P[0], P[1], 3), 0.25),
                         fs_vec3_scale(fs_vec3_add(P[1], P[2]), 0.5),
                         fs_vec3_scale(fs_vec3_add_scaled(P[3], P[2], 3), 0.25), P[3]};
    for (int k = 0; k < 5; k++) point[at[e][k]] = raised[k];
    point[q_start[e]] = fs_vec3_add_scaled(raised[1], s.inner[e][0], 0.75);
    point[p_end[e]] = fs_vec3_add_scaled(raised[2], s.inner[e][1], 0.75);
  }
  return FS_GREGORY_FINE;
}
