/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: polygons from triangles with faux edges and back. Half-edge 3 t + k runs from corner k of triangle t to
   corner k + 1. */
#include "layer.h"

#include <stdlib.h>
#include <string.h>

/* A marked half-edge by its ends, smaller one first. */
typedef struct side {
  int32_t low, high, halfedge;
  bool is_up; /* it runs from low to high */
} side;

static int compare_sides(const void *a, const void *b) {
  const side *x = a, *y = b;
  if (x->low != y->low) return x->low < y->low ? -1 : 1;
  if (x->high != y->high) return x->high < y->high ? -1 : 1;
  return x->halfedge < y->halfedge ? -1 : x->halfedge > y->halfedge;
}

static int32_t next_side(int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

/* twin[3 n]: the half-edge across a faux edge, or FS_NONE. */
static fs_status pair_sides(fs_context *ctx, int32_t n, const int32_t *triangle, const uint8_t *faux, int32_t *twin) {
  fs_status status = FS_OK;
  side *sides = NULL;
  size_t n_sides = 0;
  TAKE(ctx, sides, 3 * (size_t)n);
  for (int32_t h = 0; h < 3 * n; h++) {
    int32_t a = triangle[h], b = triangle[next_side(h)];
    twin[h] = FS_NONE;
    if (faux[h / 3] >> h % 3 & 1) sides[n_sides++] = (side){a < b ? a : b, a < b ? b : a, h, a < b};
  }
  qsort(sides, n_sides, sizeof *sides, compare_sides);
  for (size_t i = 0, j; i < n_sides; i = j) {
    for (j = i + 1; j < n_sides && sides[j].low == sides[i].low && sides[j].high == sides[i].high;) j++;
    if (j != i + 2 || sides[i].is_up == sides[i + 1].is_up) continue;
    if (sides[i].halfedge / 3 == sides[i + 1].halfedge / 3) continue;
    twin[sides[i].halfedge] = sides[i + 1].halfedge;
    twin[sides[i + 1].halfedge] = sides[i].halfedge;
  }
done:
  free(sides);
  return status;
}

/* The border from half-edge first around a component with n_border border edges, into corner; false where it is not one
   loop, or visits a vertex twice. last[n_vertices]: the number of the last polygon that had the vertex. */
static bool walk_border(const int32_t *triangle, const int32_t *twin, int32_t first, int32_t n_border, int32_t number,
                        int32_t *last, int32_t *corner) {
  int32_t h = first, n = 0;
  do {
    if (n == n_border || last[triangle[h]] == number) return false;
    last[triangle[h]] = number;
    corner[n++] = triangle[h];
    h = next_side(h);
    /* Around the vertex to the next border edge. It comes to an end: the twins of different half-edges differ, so that a
       circle would have to hold the border edge where it began. */
    while (twin[h] != FS_NONE) h = next_side(twin[h]);
  } while (h != first);
  return n == n_border;
}

fs_status polygons_join(fs_context *ctx, int32_t n, const int32_t *triangle, const uint8_t *faux, polygon_list *p) {
  fs_status status = FS_OK;
  int32_t *twin = NULL, *part = NULL, *last = NULL, number = 0, n_corners = 0;
  bool *is_seen = NULL;
  p->n_faces = 0;
  if (n > INT32_MAX / 3) return refuse(ctx, FS_ERR_UNSUPPORTED, "%d triangles are too many", n);
  TAKE(ctx, twin, 3 * (size_t)n);
  TAKE(ctx, part, n);
  TAKE(ctx, is_seen, n);
  TAKE(ctx, last, p->n_vertices);
  TAKE(ctx, p->face_start, n + 1);
  TAKE(ctx, p->corner, 3 * (size_t)n);
  TRY(pair_sides(ctx, n, triangle, faux, twin));
  for (int32_t t = 0; t < n; t++) {
    int32_t n_part = 0, n_border = 0, first = FS_NONE;
    if (is_seen[t]) continue;
    part[n_part++] = t, is_seen[t] = true;
    for (int32_t i = 0; i < n_part; i++)
      for (int32_t h = 3 * part[i]; h < 3 * part[i] + 3; h++) {
        if (twin[h] == FS_NONE) {
          n_border++;
          if (first == FS_NONE) first = h;
        } else if (!is_seen[twin[h] / 3]) {
          is_seen[twin[h] / 3] = true;
          part[n_part++] = twin[h] / 3;
        }
      }
    /* a disc of m triangles without a vertex inside has m + 2 border edges */
    if (n_part > 1 && n_border == n_part + 2 &&
        walk_border(triangle, twin, first, n_border, ++number, last, p->corner + n_corners)) {
      p->face_start[++p->n_faces] = n_corners += n_border;
      continue;
    }
    for (int32_t i = 0; i < n_part; i++) {
      memcpy(p->corner + n_corners, triangle + 3 * (size_t)part[i], 3 * sizeof *triangle);
      p->face_start[++p->n_faces] = n_corners += 3;
    }
  }
done:
  free(twin);
  free(part);
  free(is_seen);
  free(last);
  return status;
}

static double squared_distance(fs_vec3 a, fs_vec3 b) {
  double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

fs_status polygons_split(fs_context *ctx, const polygon_list *p, int32_t *n, int32_t **triangle, uint8_t **faux) {
  fs_status status = FS_OK;
  int32_t count = p->face_start[p->n_faces] - 2 * p->n_faces, t = 0, *corners = NULL;
  uint8_t *marks = NULL;
  TAKE(ctx, corners, 3 * (size_t)count);
  TAKE(ctx, marks, count);
  for (int32_t f = 0; f < p->n_faces; f++) {
    const int32_t *c = p->corner + p->face_start[f];
    int32_t size = p->face_start[f + 1] - p->face_start[f], first = 0;
    if (size == 4 &&
        squared_distance(p->position[c[1]], p->position[c[3]]) < squared_distance(p->position[c[0]], p->position[c[2]]))
      first = 1;
    for (int32_t k = 1; k + 1 < size; k++, t++) {
      corners[3 * t] = c[first];
      corners[3 * t + 1] = c[(first + k) % size];
      corners[3 * t + 2] = c[(first + k + 1) % size];
      marks[t] = (uint8_t)((k > 1) | (k + 2 < size) << 2);
    }
  }
  *n = count, *triangle = corners, *faux = marks;
  corners = NULL, marks = NULL;
done:
  free(corners);
  free(marks);
  return status;
}
