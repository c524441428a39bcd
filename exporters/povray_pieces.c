/* SPDX-License-Identifier: MIT */
/* A surface as bicubic Bezier patches whose shared sides are the same numbers on both sides.

   POV-Ray draws a patch with u_steps = k as 2^k x 2^k cells found by repeated halving. Two patches that meet show no
   crack when their common side has the same vertices: the same four points and equal steps, or the four points of a
   cubic on one side and those of its 2^m parts, made by halving too, with m steps less on the other. */
#include "povray.h"
#include "base/base.h"
#include "math/vec3.h"
#include "surface/surface.h"

bool fs_povray_is_whole(const fs_patch *patch) {
  return fs_patch_is_tensor_bezier(patch) && patch->degree_u <= 3 && patch->degree_v <= 3;
}

static int32_t n_parts(const fs_povray_pieces *pieces, const fs_surface *surface, int32_t p) {
  return fs_povray_is_whole(&surface->patch[p]) ? 1 : (int32_t)1 << pieces->m;
}

/* Point k = 0 .. 3 of part e along side s of patch p, which has n parts per direction. */
static fs_vec3 *side_point(const fs_povray_pieces *pieces, int32_t p, int32_t n, int32_t s, int32_t e, int32_t k) {
  int32_t a = 0, b = 0, i = 0, j = 0;
  switch (s) {
  case 0:
    a = e, i = k;
    break;
  case 1:
    a = n - 1, b = e, i = 3, j = k;
    break;
  case 2:
    a = n - 1 - e, b = n - 1, i = 3 - k, j = 3;
    break;
  default:
    b = n - 1 - e, j = 3 - k;
    break;
  }
  return &pieces->point[16 * (pieces->first[p] + (size_t)(a + n * b)) + (size_t)(i + 4 * j)];
}

static void copy_patch(const fs_surface *surface, const fs_patch *patch, fs_vec3 *bezier) {
  const double *b = surface->data + patch->data_start;
  for (int k = 0; k < 16; k++) bezier[k] = (fs_vec3){b[3 * k], b[3 * k + 1], b[3 * k + 2]};
}

/* Every patch on its own. Of degree below 3 the Hermite interpolant is the patch itself. */
static fs_status fill(fs_context *ctx, const fs_surface *surface, fs_povray_pieces *pieces) {
  for (int32_t p = 0; p < surface->n_patches; p++) {
    const fs_patch *patch = &surface->patch[p];
    fs_vec3 *bezier = pieces->point + 16 * pieces->first[p];
    if (fs_patch_is_tensor_bezier(patch) && patch->degree_u == 3 && patch->degree_v == 3)
      copy_patch(surface, patch, bezier);
    else
      fs_surface_hermite_bicubics(surface, p, fs_povray_is_whole(patch) ? 0 : pieces->m, bezier);
    for (size_t k = 0; k < 16 * (pieces->first[p + 1] - pieces->first[p]); k++)
      if (!fs_vec3_is_finite(bezier[k]))
        return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)p);
  }
  return FS_OK;
}

/* The lowest patch at a corner says where it is. */
static fs_status join_corners(fs_context *ctx, const fs_surface *surface, fs_povray_pieces *pieces) {
  fs_status status = FS_OK;
  int32_t *corner = NULL, n_corners = 0, n_seen = 0;
  fs_vec3 *position = NULL;
  FS_ALLOC(ctx, corner, 4 * (size_t)surface->n_patches);
  FS_ALLOC(ctx, position, 4 * (size_t)surface->n_patches);
  FS_TRY(fs_surface_corners(ctx, surface, corner, &n_corners));
  for (int32_t c = 0; c < 4 * surface->n_patches; c++) {
    fs_vec3 *point = side_point(pieces, c / 4, n_parts(pieces, surface, c / 4), c % 4, 0, 0);
    if (corner[c] == n_seen) position[n_seen++] = *point;
    *point = position[corner[c]];
  }
done:
  fs_release(ctx, corner);
  fs_release(ctx, position);
  return status;
}

/* Left and right halves of a cubic, by midpoints as the renderer makes them; line[7] with line[0 .. 3] given. */
static void halve(fs_vec3 *line) {
  fs_vec3 a = line[0], b = line[1], c = line[2], d = line[3];
  fs_vec3 ab = fs_vec3_scale(fs_vec3_add(a, b), 0.5), bc = fs_vec3_scale(fs_vec3_add(b, c), 0.5);
  fs_vec3 cd = fs_vec3_scale(fs_vec3_add(c, d), 0.5);
  fs_vec3 abc = fs_vec3_scale(fs_vec3_add(ab, bc), 0.5), bcd = fs_vec3_scale(fs_vec3_add(bc, cd), 0.5);
  line[1] = ab, line[2] = abc, line[3] = fs_vec3_scale(fs_vec3_add(abc, bcd), 0.5);
  line[4] = bcd, line[5] = cd, line[6] = d;
}

/* line[3 n + 1] from line[0 .. 3]: n = 2^m parts of a cubic. */
static void divide(fs_vec3 *line, int32_t n) {
  if (n == 1) return;
  halve(line);
  fs_vec3 right[4] = {line[3], line[4], line[5], line[6]};
  divide(line, n / 2);
  fs_vec3 *half = line + 3 * (n / 2);
  for (int k = 0; k < 4; k++) half[k] = right[k];
  divide(half, n / 2);
}

/* One side of two that meet gives its points to the other: a whole patch to a divided one, else the lower number.
   line is room for 3 2^m + 1 points. */
static void join_side(const fs_surface *surface, fs_povray_pieces *pieces, int32_t p, int32_t s, fs_vec3 *line) {
  int32_t other = fs_side_across(surface, p, s), own = 4 * p + s;
  if (other == FS_NONE) return;
  int32_t q = other / 4, r = other % 4;
  int32_t n = n_parts(pieces, surface, p), n_other = n_parts(pieces, surface, q);
  bool is_whole = fs_povray_is_whole(&surface->patch[p]), is_other_whole = fs_povray_is_whole(&surface->patch[q]);
  if (is_whole != is_other_whole ? is_other_whole : other < own) return;
  for (int32_t e = 0; e < n; e++)
    for (int32_t k = 0; k < 4; k++) line[3 * e + k] = *side_point(pieces, p, n, s, e, k);
  if (n == 1) divide(line, n_other);
  for (int32_t e = 0; e < n_other; e++)
    for (int32_t k = 0; k < 4; k++) *side_point(pieces, q, n_other, r, e, k) = line[3 * n_other - 3 * e - k];
}

/* Position, p_u, p_v of a bicubic. */
static void evaluate_bicubic(const fs_vec3 *piece, double u, double v, fs_vec3 x[3]) {
  const double t[2] = {u, v};
  double B[2][4], D[2][4];
  for (int k = 0; k < 2; k++) {
    double a = t[k], b = 1 - a;
    B[k][0] = b * b * b, B[k][1] = 3 * a * b * b, B[k][2] = 3 * a * a * b, B[k][3] = a * a * a;
    D[k][0] = -3 * b * b, D[k][1] = 3 * b * b - 6 * a * b, D[k][2] = 6 * a * b - 3 * a * a, D[k][3] = 3 * a * a;
  }
  for (int k = 0; k < 3; k++) x[k] = (fs_vec3){0, 0, 0};
  for (int j = 0; j < 4; j++)
    for (int i = 0; i < 4; i++) {
      x[0] = fs_vec3_add_scaled(x[0], piece[i + 4 * j], B[0][i] * B[1][j]);
      x[1] = fs_vec3_add_scaled(x[1], piece[i + 4 * j], D[0][i] * B[1][j]);
      x[2] = fs_vec3_add_scaled(x[2], piece[i + 4 * j], B[0][i] * D[1][j]);
    }
}

/* p_u x p_v, and position, of the pieces of patch p at (u, v). */
static fs_vec3 evaluate_pieces(const fs_surface *surface, const fs_povray_pieces *pieces, int32_t p, double u, double v,
                               fs_vec3 *position) {
  int32_t n = n_parts(pieces, surface, p);
  int32_t a = (int32_t)fmin(u * n, n - 1), b = (int32_t)fmin(v * n, n - 1);
  fs_vec3 x[3];
  evaluate_bicubic(pieces->point + 16 * (pieces->first[p] + (size_t)(a + n * b)), u * n - a, v * n - b, x);
  *position = x[0];
  return fs_vec3_cross(x[1], x[2]);
}

static void measure_angles(const fs_surface *surface, fs_povray_pieces *pieces, int32_t p) {
  enum { N = 8 };
  fs_vec3 position;
  int32_t n = N << pieces->m;
  for (int32_t s = 0; s < 4; s++) {
    int32_t other = fs_side_across(surface, p, s);
    if (other == FS_NONE) continue;
    for (int32_t k = 0; k <= n; k++) {
      double u, v;
      fs_side_parameters(4, s, (double)k / n, &u, &v);
      fs_vec3 here = evaluate_pieces(surface, pieces, p, u, v, &position);
      fs_side_parameters(4, other % 4, 1 - (double)k / n, &u, &v);
      fs_vec3 there = evaluate_pieces(surface, pieces, other / 4, u, v, &position);
      pieces->angle = fmax(pieces->angle, fs_vec3_angle(here, there));
    }
  }
}

static void measure_deviation(const fs_surface *surface, fs_povray_pieces *pieces, int32_t p) {
  enum { N = 8 };
  fs_vec3 position, x[FS_JET_SIZE];
  int32_t n = N << pieces->m;
  for (int32_t j = 0; j < n; j++)
    for (int32_t i = 0; i < n; i++) {
      double u = (i + 0.5) / n, v = (j + 0.5) / n;
      fs_surface_evaluate(surface, p, u, v, x);
      evaluate_pieces(surface, pieces, p, u, v, &position);
      pieces->deviation = fmax(pieces->deviation, fs_vec3_distance(x[FS_D], position));
    }
}

/* Counts, and the depth that the worst of the patches to divide needs. */
static fs_status plan(fs_context *ctx, const fs_surface *surface, double tolerance, int32_t max_m,
                      fs_povray_pieces *pieces) {
  fs_status status = FS_OK;
  pieces->n_patches = surface->n_patches;
  pieces->is_tensor = true;
  FS_ALLOC(ctx, pieces->first, (size_t)surface->n_patches + 1);
  for (int32_t p = 0; p < surface->n_patches; p++) {
    int32_t m = 0;
    double deviation = 0;
    if (fs_povray_is_whole(&surface->patch[p])) {
      pieces->n_whole++;
      continue;
    }
    pieces->n_divided++;
    pieces->is_tensor &= fs_patch_is_tensor_bezier(&surface->patch[p]);
    if (pieces->m == max_m) continue;
    FS_TRY(fs_surface_hermite_depth(ctx, surface, p, tolerance, max_m, &m, &deviation));
    if (m > pieces->m) pieces->m = m;
  }
  for (int32_t p = 0; p < surface->n_patches; p++) {
    size_t n = (size_t)n_parts(pieces, surface, p);
    pieces->first[p + 1] = pieces->first[p] + n * n;
  }
  pieces->n_pieces = pieces->first[surface->n_patches];
done:
  return status;
}

fs_status fs_povray_pieces_create(fs_context *ctx, const fs_surface *surface, double tolerance, int32_t max_m,
                                  fs_povray_pieces **pieces) {
  fs_status status = FS_OK;
  fs_povray_pieces *made = NULL;
  fs_vec3 *line = NULL;
  FS_ALLOC(ctx, made, 1);
  FS_TRY(plan(ctx, surface, tolerance, max_m, made));
  FS_ALLOC(ctx, made->point, 16 * made->n_pieces);
  FS_ALLOC(ctx, line, (3 << made->m) + 1);
  FS_TRY(fill(ctx, surface, made));
  FS_TRY(join_corners(ctx, surface, made));
  for (int32_t i = 0; i < 4 * surface->n_patches; i++) join_side(surface, made, i / 4, i % 4, line);
  for (int32_t p = 0; p < surface->n_patches; p++) {
    if (fs_povray_is_whole(&surface->patch[p])) continue;
    measure_deviation(surface, made, p);
    measure_angles(surface, made, p);
  }
  *pieces = made;
  made = NULL;
done:
  fs_release(ctx, line);
  fs_povray_pieces_free(ctx, made);
  return status;
}

void fs_povray_pieces_free(fs_context *ctx, fs_povray_pieces *pieces) {
  if (pieces == NULL) return;
  fs_release(ctx, pieces->first);
  fs_release(ctx, pieces->point);
  fs_release(ctx, pieces);
}
