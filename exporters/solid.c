/* SPDX-License-Identifier: MIT */
/* Single role: facts about triangles as the skin of a solid.

   Volume of a closed skin: sum of a . (b x c) / 6 over its triangles, by the divergence theorem for p / 3. */
#include "solid.h"
#include "base/base.h"
#include "math/vec3.h"

/* next[a] = b for every side a b that has no triangle on its right, FS_NONE elsewhere. A vertex of a tessellation is one
   fan of triangles, so at most one such side leaves it. */
static fs_status find_next(fs_context *ctx, const fs_triangles *t, int32_t *next) {
  fs_status status = FS_OK;
  int32_t *start = NULL, *target = NULL; /* sides by the vertex they leave: target[start[v]] .. */
  const size_t n_sides = 3 * (size_t)t->n_triangles;
  FS_ALLOC(ctx, start, (size_t)t->n_vertices + 2);
  FS_ALLOC(ctx, target, n_sides);
  for (size_t i = 0; i < n_sides; i++) start[t->corner[i] + 2]++;
  for (int32_t v = 0; v < t->n_vertices; v++) start[v + 2] += start[v + 1];
  for (size_t i = 0; i < n_sides; i++) target[start[t->corner[i] + 1]++] = t->corner[i % 3 == 2 ? i - 2 : i + 1];
  for (int32_t a = 0; a < t->n_vertices; a++) {
    next[a] = FS_NONE;
    for (int32_t i = start[a]; i < start[a + 1]; i++) {
      int32_t b = target[i], k = start[b];
      while (k < start[b + 1] && target[k] != a) k++;
      if (k == start[b + 1]) next[a] = b;
    }
  }
done:
  fs_release(ctx, start);
  fs_release(ctx, target);
  return status;
}

/* Consumes next. */
static void collect_loops(int32_t n_vertices, int32_t *next, fs_rim *rim) {
  int32_t n = 0;
  for (int32_t first = 0; first < n_vertices; first++) {
    if (next[first] == FS_NONE) continue;
    for (int32_t v = first; v != FS_NONE && next[v] != FS_NONE;) {
      int32_t after = next[v];
      rim->vertex[n++] = v;
      next[v] = FS_NONE;
      v = after;
    }
    rim->start[++rim->n_loops] = n;
  }
}

fs_status fs_rim_create(fs_context *ctx, const fs_triangles *t, fs_rim **rim) {
  fs_status status = FS_OK;
  int32_t *next = NULL, n_vertices = 0;
  fs_rim *made = NULL;
  FS_ALLOC(ctx, next, t->n_vertices);
  FS_ALLOC(ctx, made, 1);
  FS_TRY(find_next(ctx, t, next));
  for (int32_t v = 0; v < t->n_vertices; v++) n_vertices += next[v] != FS_NONE;
  made->n_vertices = n_vertices;
  FS_ALLOC(ctx, made->vertex, n_vertices);
  FS_ALLOC(ctx, made->start, (size_t)n_vertices + 1);
  collect_loops(t->n_vertices, next, made);
  *rim = made;
  made = NULL;
done:
  fs_rim_free(ctx, made);
  fs_release(ctx, next);
  return status;
}

void fs_rim_free(fs_context *ctx, fs_rim *rim) {
  if (rim == NULL) return;
  fs_release(ctx, rim->start);
  fs_release(ctx, rim->vertex);
  fs_release(ctx, rim);
}

double fs_triangles_volume(const fs_triangles *t) {
  double sum = 0;
  for (size_t i = 0; i < 3 * (size_t)t->n_triangles; i += 3) {
    /* from a vertex, so that a place far from the origin costs no digits */
    fs_vec3 a = fs_vec3_sub(t->position[t->corner[i]], t->position[0]);
    fs_vec3 b = fs_vec3_sub(t->position[t->corner[i + 1]], t->position[0]);
    fs_vec3 c = fs_vec3_sub(t->position[t->corner[i + 2]], t->position[0]);
    sum += fs_vec3_dot(a, fs_vec3_cross(b, c));
  }
  return sum / 6;
}

int32_t fs_triangles_flat(const fs_triangles *t, double *shortest) {
  int32_t flat = FS_NONE;
  *shortest = INFINITY;
  for (int32_t i = 0; i < t->n_triangles; i++) {
    const int32_t *corner = t->corner + 3 * (size_t)i;
    fs_vec3 a = t->position[corner[0]], b = t->position[corner[1]], c = t->position[corner[2]];
    double ab = fs_vec3_distance(a, b), bc = fs_vec3_distance(b, c), ca = fs_vec3_distance(c, a);
    double longest = fmax(ab, fmax(bc, ca)), area = fs_vec3_length(fs_vec3_cross(fs_vec3_sub(b, a), fs_vec3_sub(c, a)));
    *shortest = fmin(*shortest, fmin(ab, fmin(bc, ca)));
    if (flat == FS_NONE && !(area > 2e-12 * longest * longest)) flat = i;
  }
  return flat;
}
