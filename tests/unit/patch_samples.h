/* SPDX-License-Identifier: MIT */
/* A closed surface of several kinds of patches for tests: a pyramid over a quadrilateral, sides cubic, the rest random. */
#ifndef FS_TEST_PATCH_SAMPLES_H
#define FS_TEST_PATCH_SAMPLES_H

#include <fairsurf/surface.h>
#include "math/vec3.h"
#include "../support/support.h"
#include <stdlib.h>
#include <string.h>

static const int32_t pyramid[5][4] = {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};

static inline fs_vec3 pyramid_vertex(int v) {
  static const fs_vec3 at[5] = {{-1, -1, 0}, {1, -1, 0.1}, {1, 1, -0.1}, {-1, 1, 0.2}, {0.1, 0, 1.4}};
  return at[v];
}

/* Four points of the side from vertex a to vertex b; the same backwards from b to a. */
static inline void pyramid_side(int a, int b, fs_vec3 *point) {
  uint64_t seed = 17 + 10 * (uint64_t)(a < b ? a : b) + (uint64_t)(a < b ? b : a);
  for (int k = 0; k < 4; k++) point[k] = pyramid_vertex(a < b ? a : b);
  for (int k = 1; k < 4; k++)
    point[k] = fs_vec3_add_scaled(fs_vec3_scale(point[0], (3 - k) / 3.0), pyramid_vertex(a < b ? b : a), k / 3.0);
  for (int k = 1; k < 3; k++) {
    point[k].x += test_random_real(&seed, -0.1, 0.1);
    point[k].y += test_random_real(&seed, -0.1, 0.1);
    point[k].z += test_random_real(&seed, -0.1, 0.1);
  }
  if (a > b) {
    fs_vec3 first = point[0], second = point[1];
    point[0] = point[3], point[1] = point[2], point[2] = second, point[3] = first;
  }
}

/* Its middle moved by random amounts. */
static inline fs_vec3 pyramid_inner(fs_vec3 a, fs_vec3 b, fs_vec3 c, uint64_t *seed) {
  fs_vec3 p = fs_vec3_scale(fs_vec3_add(fs_vec3_add(a, b), c), 1.0 / 3);
  p.x += test_random_real(seed, -0.2, 0.2);
  p.y += test_random_real(seed, -0.2, 0.2);
  p.z += test_random_real(seed, -0.2, 0.2);
  return p;
}

static inline void pyramid_quad(const int32_t *face, uint64_t *seed, fs_vec3 *net) {
  static const int32_t at[4][4] = {{0, 1, 2, 3}, {3, 7, 11, 15}, {15, 14, 13, 12}, {12, 8, 4, 0}};
  fs_vec3 side[4];
  for (int s = 0; s < 4; s++) {
    pyramid_side(face[s], face[(s + 1) % 4], side);
    for (int k = 0; k < 4; k++) net[at[s][k]] = side[k];
  }
  for (int c = 0; c < 4; c++) {
    static const int32_t inner[4] = {5, 6, 9, 10}, beside[4][2] = {{1, 4}, {2, 7}, {8, 13}, {11, 14}};
    net[inner[c]] = pyramid_inner(net[beside[c][0]], net[beside[c][1]], net[0], seed);
    net[16 + c] = pyramid_inner(net[beside[c][0]], net[beside[c][1]], net[15], seed);
  }
}

static inline void pyramid_triangle(const int32_t *face, uint64_t *seed, fs_vec3 *net) {
  static const int32_t at[3][5] = {{0, 1, 2, 3, 4}, {4, 8, 11, 13, 14}, {14, 12, 9, 5, 0}}, inner[3] = {6, 7, 10};
  fs_vec3 side[4];
  for (int s = 0; s < 3; s++) {
    pyramid_side(face[s], face[(s + 1) % 3], side);
    net[at[s][0]] = side[0], net[at[s][4]] = side[3];
    for (int k = 1; k < 4; k++)
      net[at[s][k]] = fs_vec3_add(fs_vec3_scale(side[k - 1], k / 4.0), fs_vec3_scale(side[k], (4 - k) / 4.0));
  }
  for (int c = 0; c < 3; c++) {
    net[inner[c]] = pyramid_inner(net[0], net[4], net[14], seed);
    net[15 + c] = pyramid_inner(net[0], net[4], net[14], seed);
  }
}

/* quad: the kind of the base. The other faces are Gregory and Bezier triangles in turn. */
static inline fs_surface *sample_pyramid(fs_patch_kind quad) {
  uint64_t seed = 5;
  fs_surface *s = calloc(1, sizeof *s);
  s->n_patches = 5;
  s->patch = calloc(5, sizeof *s->patch);
  s->data = calloc(5 * 60, sizeof *s->data);
  for (int p = 0; p < 5; p++) {
    fs_vec3 net[20];
    int n_sides = pyramid[p][3] < 0 ? 3 : 4, degree = n_sides == 3 ? 4 : 3;
    fs_patch_kind kind = n_sides == 4 ? quad : p % 2 == 0 ? FS_PATCH_BEZIER_TRIANGLE : FS_PATCH_GREGORY_TRIANGLE;
    s->patch[p] = (fs_patch){.kind = kind,
                             .n_sides = n_sides,
                             .degree_u = degree,
                             .degree_v = degree,
                             .data_start = s->n_data,
                             .face = p,
                             .valence = 4,
                             .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
    for (int q = 0; q < 5; q++)
      for (int k = 0; k < 16; k++) {
        int a = k / 4, b = k % 4, n_other = pyramid[q][3] < 0 ? 3 : 4;
        if (a >= n_sides || b >= n_other || pyramid[p][a] != pyramid[q][(b + 1) % n_other] ||
            pyramid[p][(a + 1) % n_sides] != pyramid[q][b])
          continue;
        s->patch[p].neighbour[a] = q;
        s->patch[p].neighbour_side[a] = (uint8_t)b;
      }
    if (n_sides == 4)
      pyramid_quad(pyramid[p], &seed, net);
    else
      pyramid_triangle(pyramid[p], &seed, net);
    size_t n = fs_patch_kinds[kind].n_numbers(&s->patch[p]);
    memcpy(s->data + s->n_data, net, n * sizeof *s->data);
    s->n_data += n;
  }
  return s;
}

static inline void sample_pyramid_free(fs_surface *s) {
  free(s->patch);
  free(s->data);
  free(s);
}

#endif
