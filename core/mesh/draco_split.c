/* SPDX-License-Identifier: MIT */
/* Single role: polygons as fans of triangles, whose added edges are marked, so that they can be joined again. Triangle i
   of a fan has the corners a, b(i), b(i + 1); the edges from a to all but the first and the last b are added, and marked on
   both sides: one mark would do, but then more marks differ from their neighbours, and files are larger. For the same
   reason fans begin, where they may, at vertices of one of two colours that alternate along edges: in a net of
   quadrilaterals all marks around a vertex are then alike. */
#include "mesh/draco_polygons.h"

enum { MOST_ATTEMPTS = 16 }; /* corners tried for the centre of a fan */

/* Pairs of vertices that a diagonal joins: an open table of keys, 0 where empty. */
typedef struct pairs {
  uint64_t *key;
  size_t mask;
} pairs;

static uint64_t key_of(int32_t a, int32_t b) {
  return a < b ? (uint64_t)a << 32 | (uint32_t)b : (uint64_t)b << 32 | (uint32_t)a; /* never 0, as a is not b */
}

static size_t find(const pairs *p, uint64_t key) {
  size_t i = (size_t)((key * 0x9E3779B97F4A7C15u) >> 20) & p->mask;
  while (p->key[i] != 0 && p->key[i] != key) i = (i + 1) & p->mask;
  return i;
}

/* Whether the fan around corner a of face f joins vertices that are joined already. near_apex[n_vertices] is set to
   1 + the half-edge a for neighbours of its vertex: their marks need no clearing. */
static bool has_conflict(const fs_mesh *mesh, const pairs *diagonals, int32_t f, int32_t a, int32_t *near_apex) {
  int32_t first = mesh->outgoing[mesh->origin[a]], h = first;
  do {
    near_apex[fs_mesh_target(mesh, h)] = a + 1;
    near_apex[mesh->origin[fs_mesh_previous(mesh, h)]] = a + 1;
    h = fs_mesh_rotate(mesh, h);
  } while (h != first && h != FS_NONE);
  h = fs_mesh_next(mesh, fs_mesh_next(mesh, a));
  for (int32_t i = 0; i < fs_mesh_face_size(mesh, f) - 3; i++, h = fs_mesh_next(mesh, h)) {
    int32_t v = mesh->origin[h];
    if (near_apex[v] == a + 1 || diagonals->key[find(diagonals, key_of(mesh->origin[a], v))] != 0) return true;
  }
  return false;
}

/* is_second[n_vertices], so that it alternates along edges wherever that can be; breadth first from vertex to vertex. */
static fs_status colour_vertices(fs_context *ctx, const fs_mesh *mesh, uint8_t *is_second) {
  int32_t *queue = NULL;
  uint8_t *is_done = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, queue, mesh->n_vertices);
  FS_ALLOC(ctx, is_done, mesh->n_vertices);
  for (int32_t v = 0, head = 0, tail = 0; v < mesh->n_vertices; v++) {
    if (is_done[v]) continue;
    is_done[v] = 1;
    for (queue[tail++] = v; head < tail; head++) {
      int32_t from = queue[head], first = mesh->outgoing[from], h = first;
      do {
        const int32_t near[2] = {fs_mesh_target(mesh, h), mesh->origin[fs_mesh_previous(mesh, h)]};
        for (int i = 0; i < 2; i++) {
          if (is_done[near[i]]) continue;
          is_done[near[i]] = 1;
          is_second[near[i]] = !is_second[from];
          queue[tail++] = near[i];
        }
        h = fs_mesh_rotate(mesh, h);
      } while (h != first && h != FS_NONE);
    }
  }
done:
  fs_release(ctx, queue);
  fs_release(ctx, is_done);
  return status;
}

static fs_status choose_apex(fs_context *ctx, const fs_mesh *mesh, const pairs *diagonals, const uint8_t *is_second,
                             int32_t f, int32_t *near_apex, int32_t *apex) {
  int32_t start = mesh->face_start[f], size = fs_mesh_face_size(mesh, f), shift = 0;
  while (shift < size - 1 && is_second[mesh->origin[start + shift]]) shift++;
  for (int32_t i = 0; i < size && i < MOST_ATTEMPTS; i++) {
    *apex = start + (i + shift) % size;
    if (size == 3 || !has_conflict(mesh, diagonals, f, *apex, near_apex)) return FS_OK;
  }
  return fs_fail(ctx, FS_ERR_UNSUPPORTED,
                 "face %d cannot be kept in triangles: each of its diagonals joins vertices that are joined already",
                 f);
}

static void split(const fs_mesh *mesh, int32_t f, int32_t apex, pairs *diagonals, int32_t *corner, uint8_t *is_added) {
  int32_t n = fs_mesh_face_size(mesh, f) - 2, a = mesh->origin[apex], h = fs_mesh_next(mesh, apex);
  for (int32_t i = 0; i < n; i++, h = fs_mesh_next(mesh, h)) {
    int32_t b = mesh->origin[h], c = fs_mesh_target(mesh, h);
    corner[3 * i] = a, corner[3 * i + 1] = b, corner[3 * i + 2] = c;
    is_added[3 * i] = 0;
    is_added[3 * i + 1] = i < n - 1; /* the edge from c to a */
    is_added[3 * i + 2] = i > 0;     /* the edge from a to b */
    if (i > 0) diagonals->key[find(diagonals, key_of(a, b))] = key_of(a, b);
  }
}

fs_status fs_mesh_split_polygons(fs_context *ctx, const fs_mesh *mesh, int32_t *corner, uint8_t *is_added) {
  pairs diagonals = {.mask = 1};
  int32_t *near_apex = NULL, apex = 0;
  size_t n_diagonals = 0, t = 0;
  uint8_t *is_second = NULL;
  fs_status status = FS_OK;
  for (int32_t f = 0; f < mesh->n_faces; f++) n_diagonals += (size_t)fs_mesh_face_size(mesh, f) - 3;
  while (diagonals.mask < 2 * n_diagonals) diagonals.mask = 2 * diagonals.mask + 1;
  FS_ALLOC(ctx, diagonals.key, diagonals.mask + 1);
  FS_ALLOC(ctx, near_apex, mesh->n_vertices);
  FS_ALLOC(ctx, is_second, mesh->n_vertices);
  FS_TRY(colour_vertices(ctx, mesh, is_second));
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    FS_TRY(choose_apex(ctx, mesh, &diagonals, is_second, f, near_apex, &apex));
    split(mesh, f, apex, &diagonals, corner + 3 * t, is_added + 3 * t);
    t += (size_t)fs_mesh_face_size(mesh, f) - 2;
  }
done:
  fs_release(ctx, diagonals.key);
  fs_release(ctx, near_apex);
  fs_release(ctx, is_second);
  return status;
}
