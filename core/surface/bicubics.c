/* SPDX-License-Identifier: MIT */
/* Single role: a surface of any patches as one of bicubic patches: the pieces of fs_surface_hermite_bicubics for the
   smallest common depth, with their neighbours. */
#include "surface/surface.h"
#include "math/vec3.h"

/* Depth that the worst patch needs, and what is left of its deviation; an exact bicubic needs none. */
static fs_status find_depth(fs_context *ctx, const fs_surface *quads, double tolerance, int32_t max_m, int32_t *m,
                            double *deviation) {
  fs_status status = FS_OK;
  int32_t depth = 0;
  double largest = 0;
  for (int32_t p = 0; p < quads->n_patches; p++) {
    int32_t needed = 0;
    double measured = 0;
    FS_TRY(fs_surface_hermite_depth(ctx, quads, p, tolerance, max_m, &needed, &measured));
    if (needed > depth) depth = needed;
    largest = fmax(largest, measured);
    if (p % 64 == 0) FS_TRY(fs_progress(ctx, "approximate", (double)p / quads->n_patches));
  }
  *m = depth;
  *deviation = largest;
done:
  return status;
}

/* Number of the piece that holds part e of side s, counted anticlockwise, among n x n. */
static int32_t side_piece(int32_t n, int32_t s, int32_t e) {
  switch (s) {
  case 0:
    return e;
  case 1:
    return n - 1 + n * e;
  case 2:
    return n - 1 - e + n * (n - 1);
  default:
    return n * (n - 1 - e);
  }
}

/* The neighbours of the pieces of patch p; those inside, then those across its sides. */
static void connect(const fs_surface *quads, int32_t p, int32_t n, fs_patch *piece) {
  int32_t first = p * n * n;
  for (int32_t b = 0; b < n; b++)
    for (int32_t a = 0; a < n; a++) {
      int32_t k = a + n * b;
      const int32_t around[4] = {b > 0 ? k - n : FS_NONE, a + 1 < n ? k + 1 : FS_NONE, b + 1 < n ? k + n : FS_NONE,
                                 a > 0 ? k - 1 : FS_NONE};
      for (int s = 0; s < 4; s++) {
        piece[k].neighbour[s] = around[s] == FS_NONE ? FS_NONE : first + around[s];
        piece[k].neighbour_side[s] = (uint8_t)((s + 2) % 4);
      }
    }
  for (int32_t s = 0; s < 4; s++) {
    int32_t other = fs_side_across(quads, p, s);
    if (other == FS_NONE) continue;
    for (int32_t e = 0; e < n; e++) {
      int32_t k = side_piece(n, s, e);
      piece[k].neighbour[s] = other / 4 * n * n + side_piece(n, other % 4, n - 1 - e);
      piece[k].neighbour_side[s] = (uint8_t)(other % 4);
    }
  }
}

static fs_status make(fs_context *ctx, const fs_surface *quads, int32_t m, fs_surface **bicubics) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  fs_vec3 *bezier = NULL;
  int32_t n = (int32_t)1 << m;
  if ((int64_t)quads->n_patches * n * n > INT32_MAX / 4)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d patches of %d bicubic pieces each are more than can be numbered",
                   (int)quads->n_patches, (int)(n * n));
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, bezier, (size_t)16 << (2 * m));
  made->n_patches = quads->n_patches * n * n;
  made->n_data = 48 * (size_t)made->n_patches;
  FS_ALLOC(ctx, made->patch, made->n_patches);
  FS_ALLOC(ctx, made->data, made->n_data);
  for (int32_t p = 0; p < quads->n_patches; p++) {
    fs_surface_hermite_bicubics(quads, p, m, bezier);
    for (int32_t k = 0; k < n * n; k++) {
      size_t start = 48 * ((size_t)p * (size_t)(n * n) + (size_t)k);
      made->patch[p * n * n + k] = (fs_patch){.kind = FS_PATCH_TENSOR_BEZIER,
                                              .n_sides = 4,
                                              .degree_u = 3,
                                              .degree_v = 3,
                                              .data_start = start,
                                              .face = quads->patch[p].face,
                                              .valence = 4};
      for (int i = 0; i < 16; i++) {
        const fs_vec3 point = bezier[16 * k + i];
        double *to = made->data + start + 3 * i;
        to[0] = point.x, to[1] = point.y, to[2] = point.z;
      }
    }
    connect(quads, p, n, made->patch + (size_t)p * (size_t)(n * n));
  }
  *bicubics = made;
  made = NULL;
done:
  fs_release(ctx, bezier);
  fs_surface_free(ctx, made);
  return status;
}

fs_status fs_surface_to_bicubics(fs_context *ctx, const fs_surface *surface, double tolerance, int32_t max_m,
                                 fs_surface **bicubics, double *deviation) {
  fs_status status = FS_OK;
  fs_surface *quads = NULL;
  int32_t m = 0;
  double measured = 0;
  FS_TRY(fs_surface_to_quads(ctx, surface, &quads));
  FS_TRY(find_depth(ctx, quads, tolerance, max_m, &m, &measured));
  FS_TRY(make(ctx, quads, m, bicubics));
  *deviation = measured;
done:
  fs_surface_free(ctx, quads);
  return status;
}
