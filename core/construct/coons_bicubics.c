/* SPDX-License-Identifier: MIT */
/* Single role: a Coons patch of any curves as n x n bicubic Hermite patches (surface/approximate.c says how). */
#include "construct/coons.h"
#include "math/vec3.h"
#include "surface/surface.h"

/* Piece (a, b) of n x n. */
static void make_piece(const fs_coons *coons, int32_t n, int32_t a, int32_t b, fs_vec3 *piece) {
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t corner = 0; corner < 4; corner++) {
    fs_coons_evaluate(coons, (double)(a + corner % 2) / n, (double)(b + corner / 2) / n, x);
    fs_hermite_corner(x, 1.0 / n, corner % 2, corner / 2, piece);
  }
}

static double measure(const fs_coons *coons, int32_t n, double enough) {
  enum { N = 8 };
  double largest = 0;
  fs_vec3 piece[16], x[FS_JET_SIZE];
  for (int32_t k = 0; k < n * n; k++) {
    make_piece(coons, n, k % n, k / n, piece);
    for (int32_t i = 0; i < N * N; i++) {
      double u = (i % N + 0.5) / N, v = (i / N + 0.5) / N;
      fs_coons_evaluate(coons, (k % n + u) / n, (k / n + v) / n, x);
      double distance = fs_vec3_distance(x[FS_D], fs_bicubic_point(piece, u, v));
      if (!(distance <= largest)) largest = distance;
      if (!(largest <= enough)) return largest;
    }
  }
  return largest;
}

static fs_status make(fs_context *ctx, const fs_coons *coons, int32_t n, fs_surface **surface) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  FS_ALLOC(ctx, made, 1);
  made->n_patches = n * n;
  made->n_data = 48 * (size_t)(n * n);
  FS_ALLOC(ctx, made->patch, made->n_patches);
  FS_ALLOC(ctx, made->data, made->n_data);
  for (int32_t k = 0; k < n * n; k++) {
    int32_t a = k % n, b = k / n;
    fs_vec3 piece[16];
    made->patch[k] = (fs_patch){.kind = FS_PATCH_TENSOR_BEZIER,
                                .n_sides = 4,
                                .degree_u = 3,
                                .degree_v = 3,
                                .data_start = 48 * (size_t)k,
                                .face = FS_NONE,
                                .valence = 4,
                                .neighbour = {b > 0 ? k - n : FS_NONE, a + 1 < n ? k + 1 : FS_NONE,
                                              b + 1 < n ? k + n : FS_NONE, a > 0 ? k - 1 : FS_NONE},
                                .neighbour_side = {2, 3, 0, 1}};
    make_piece(coons, n, a, b, piece);
    double *to = made->data + made->patch[k].data_start;
    for (int i = 0; i < 16; i++) to[3 * i] = piece[i].x, to[3 * i + 1] = piece[i].y, to[3 * i + 2] = piece[i].z;
  }
  *surface = made;
  made = NULL;
done:
  fs_surface_free(ctx, made);
  return status;
}

fs_status fs_coons_to_bicubics(fs_context *ctx, const fs_coons *coons, double tolerance, int32_t max_m,
                               fs_surface **surface, double *deviation) {
  int32_t m = 0;
  double largest;
  fs_status status;
  if (max_m < 0 || max_m > 10)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a patch can be split 0 to 10 times, not %d", (int)max_m);
  for (;; m++) {
    largest = measure(coons, (int32_t)1 << m, m < max_m ? tolerance : (double)INFINITY);
    if (largest <= tolerance || m == max_m) break;
    status = fs_progress(ctx, "approximate", (double)m / max_m);
    if (status != FS_OK) return status;
  }
  if (!isfinite(largest)) return fs_fail(ctx, FS_ERR_NUMERIC, "the sides of the patch have points that are not finite");
  status = make(ctx, coons, (int32_t)1 << m, surface);
  if (status == FS_OK) *deviation = largest;
  return status;
}
