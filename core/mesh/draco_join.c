/* SPDX-License-Identifier: MIT */
/* Single role: polygons from triangles, some of whose edges are marked as added. Half-edge 3 t + c runs from corner c of
   triangle t to the next; the mark of a corner belongs to the edge opposite, which is half-edge 3 t + (c + 1) % 3. */
#include "mesh/draco_polygons.h"

static int32_t next(int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

static bool is_marked(const uint8_t *is_added, int32_t h) {
  return is_added[h % 3 == 0 ? h + 2 : h - 1] != 0; /* the corner opposite */
}

static size_t hash(int32_t from, int32_t to, size_t mask) {
  uint64_t x = ((uint64_t)(uint32_t)from << 32 | (uint32_t)to) * 0x9E3779B97F4A7C15u;
  return (size_t)(x >> 20) & mask;
}

/* The marked half-edge from one vertex to another: its place in the table [mask + 1], which holds half-edges or FS_NONE. */
static size_t find(const int32_t *table, size_t mask, const int32_t *corner, int32_t from, int32_t to) {
  size_t i = hash(from, to, mask);
  while (table[i] != FS_NONE && !(corner[table[i]] == from && corner[next(table[i])] == to)) i = (i + 1) & mask;
  return i;
}

static fs_status fail_twice(fs_context *ctx, int32_t from, int32_t to) {
  return fs_fail(ctx, FS_ERR_FORMAT, "two triangles have the same added edge from vertex %d to vertex %d", from, to);
}

/* twin[3 n_triangles] across added edges, which may be marked on one side or on both; FS_NONE for other half-edges. */
static fs_status find_twins(fs_context *ctx, int32_t n_halfedges, const int32_t *corner, const uint8_t *is_added,
                            int32_t *twin) {
  fs_status status = FS_OK;
  int32_t *table = NULL;
  size_t n = 0, mask = 1;
  for (int32_t h = 0; h < n_halfedges; h++) n += is_marked(is_added, h);
  while (mask < 2 * n) mask = 2 * mask + 1;
  FS_ALLOC(ctx, table, mask + 1);
  for (size_t i = 0; i <= mask; i++) table[i] = FS_NONE;
  for (int32_t h = 0; h < n_halfedges; h++) {
    size_t i;
    twin[h] = FS_NONE;
    if (!is_marked(is_added, h)) continue;
    i = find(table, mask, corner, corner[h], corner[next(h)]);
    if (table[i] != FS_NONE) {
      status = fail_twice(ctx, corner[h], corner[next(h)]);
      goto done;
    }
    table[i] = h;
  }
  for (int32_t h = 0; h < n_halfedges; h++) {
    int32_t opposite = table[find(table, mask, corner, corner[next(h)], corner[h])];
    if (opposite == FS_NONE) continue;
    if (twin[opposite] != FS_NONE && twin[opposite] != h) {
      status = fail_twice(ctx, corner[h], corner[next(h)]);
      goto done;
    }
    twin[opposite] = h;
    twin[h] = opposite;
  }
done:
  fs_release(ctx, table);
  return status;
}

/* The half-edge of the polygon that follows: across added edges to the next one that is none. Going back is as unique
   as going on, so this ends. */
static int32_t follow(const int32_t *twin, int32_t h) {
  h = next(h);
  while (twin[h] != FS_NONE) h = next(twin[h]);
  return h;
}

fs_status fs_mesh_join_triangles(fs_context *ctx, int32_t n_triangles, const int32_t *corner, const uint8_t *is_added,
                                 fs_polygons *polygons) {
  int32_t *twin = NULL, *start = NULL, *joined = NULL;
  uint8_t *is_done = NULL;
  int32_t n = 3 * n_triangles, n_faces = 0, n_corners = 0;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, twin, n);
  FS_TRY(find_twins(ctx, n, corner, is_added, twin));
  FS_ALLOC(ctx, is_done, n);
  FS_ALLOC(ctx, start, (size_t)n_triangles + 1);
  FS_ALLOC(ctx, joined, n);
  for (int32_t h = 0; h < n; h++) {
    if (twin[h] != FS_NONE || is_done[h]) continue;
    if (n_faces == n_triangles) break; /* more outlines than triangles: the count below tells */
    for (int32_t g = h; !is_done[g]; g = follow(twin, g)) {
      is_done[g] = 1;
      joined[n_corners++] = corner[g];
    }
    start[++n_faces] = n_corners;
  }
  /* A polygon of k corners without vertices inside takes k - 2 triangles; anything else takes more. */
  if (n_corners - 2 * n_faces != n_triangles) {
    status = fs_fail(ctx, FS_ERR_FORMAT, "the added edges leave %d outlines with %d corners for %d triangles", n_faces,
                     n_corners, n_triangles);
    goto done;
  }
  polygons->n_faces = n_faces;
  polygons->face_start = start;
  polygons->corner = joined;
  start = NULL, joined = NULL;
done:
  fs_release(ctx, twin);
  fs_release(ctx, is_done);
  fs_release(ctx, start);
  fs_release(ctx, joined);
  return status;
}
