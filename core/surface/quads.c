/* SPDX-License-Identifier: MIT */
/* Single role: a surface with patches of three sides as one of patches of four, each patch cut into the parts at its
   corners: the vertices of the parts are corners, middles of sides and centres, so that parts of neighbours meet side to
   side. Tensor Bezier patches are cut by halving their control net [Farin 2002, 16.5]; others become parts by reference. */
#include "surface/surface.h"
#include "math/vec3.h"

#include <string.h>

/* ---- neighbours ---- */

/* Part c of patch p; first[p] is the number of its part 0. */
static void connect(const fs_surface *surface, const int32_t *first, int32_t p, int32_t c, fs_patch *part) {
  const fs_patch *whole = &surface->patch[p];
  int32_t n = whole->n_sides, before = (c + n - 1) % n;
  int32_t ahead = whole->neighbour[c], behind = whole->neighbour[before];
  part->neighbour[1] = first[p] + (c + 1) % n, part->neighbour_side[1] = 2;
  part->neighbour[2] = first[p] + before, part->neighbour_side[2] = 1;
  part->neighbour[0] = part->neighbour[3] = FS_NONE;
  part->neighbour_side[0] = part->neighbour_side[3] = 0;
  if (ahead != FS_NONE) { /* the first half of our side is the second one of the side that meets it */
    part->neighbour[0] = first[ahead] + (whole->neighbour_side[c] + 1) % surface->patch[ahead].n_sides;
    part->neighbour_side[0] = 3;
  }
  if (behind != FS_NONE) part->neighbour[3] = first[behind] + whole->neighbour_side[before];
}

/* ---- tensor Bezier patches ---- */

/* The net turned so that corner c comes first; degrees of the result. */
static void turn(const double *b, int32_t n, int32_t m, int32_t c, fs_vec3 *out, int32_t *n_out, int32_t *m_out) {
  *n_out = c % 2 == 0 ? n : m;
  *m_out = c % 2 == 0 ? m : n;
  for (int32_t j = 0; j <= *m_out; j++)
    for (int32_t i = 0; i <= *n_out; i++) {
      int32_t k = c == 0   ? i
                  : c == 1 ? n - j
                  : c == 2 ? n - i
                           : j,
              l = c == 0   ? j
                  : c == 1 ? i
                  : c == 2 ? m - j
                           : m - i;
      const double *point = b + 3 * (k + (n + 1) * l);
      out[i + (*n_out + 1) * j] = (fs_vec3){point[0], point[1], point[2]};
    }
}

/* The first half of a curve of degree n. */
static void halve(fs_vec3 *b, int32_t n, int32_t stride) {
  for (int32_t step = 0; step < n; step++)
    for (int32_t i = n; i > step; i--)
      b[i * stride] = fs_vec3_scale(fs_vec3_add(b[i * stride], b[(i - 1) * stride]), 0.5);
}

static void cut_tensor_bezier(const double *b, int32_t c, fs_patch *part, double *out) {
  fs_vec3 net[(FS_MAX_DEGREE + 1) * (FS_MAX_DEGREE + 1)];
  turn(b, part->degree_u, part->degree_v, c, net, &part->degree_u, &part->degree_v);
  for (int32_t j = 0; j <= part->degree_v; j++) halve(net + j * (part->degree_u + 1), part->degree_u, 1);
  for (int32_t i = 0; i <= part->degree_u; i++) halve(net + i, part->degree_v, part->degree_u + 1);
  for (int32_t k = 0; k < (part->degree_u + 1) * (part->degree_v + 1); k++)
    out[3 * k] = net[k].x, out[3 * k + 1] = net[k].y, out[3 * k + 2] = net[k].z;
}

/* ---- the surface ---- */

static fs_status copy(fs_context *ctx, const fs_surface *surface, fs_surface **out) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, made->patch, surface->n_patches);
  FS_ALLOC(ctx, made->data, surface->n_data);
  made->n_patches = surface->n_patches;
  made->n_data = surface->n_data;
  if (made->n_patches > 0) memcpy(made->patch, surface->patch, (size_t)made->n_patches * sizeof *made->patch);
  if (made->n_data > 0) memcpy(made->data, surface->data, made->n_data * sizeof *made->data);
  *out = made;
  made = NULL;
done:
  fs_surface_free(ctx, made);
  return status;
}

/* first[n_patches + 1]: numbers of the parts; n_data: room for the data of both. */
static fs_status plan(fs_context *ctx, const fs_surface *surface, int32_t *first, size_t *n_data) {
  int64_t n = 0;
  *n_data = surface->n_data;
  for (int32_t p = 0; p < surface->n_patches; p++) {
    const fs_patch *patch = &surface->patch[p];
    if (patch->part != 0) return fs_fail(ctx, FS_ERR_UNSUPPORTED, "patch %d is a part and cannot be cut", (int)p);
    first[p] = (int32_t)n;
    n += patch->n_sides;
    if (n > INT32_MAX / 4)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%d patches have more parts than can be numbered", (int)surface->n_patches);
    if (patch->kind == FS_PATCH_TENSOR_BEZIER) *n_data += 4 * fs_tensor_bezier_numbers(patch);
  }
  first[surface->n_patches] = (int32_t)n;
  return FS_OK;
}

static fs_status cut(fs_context *ctx, const fs_surface *surface, fs_surface **quads) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  int32_t *first = NULL;
  size_t start = surface->n_data;
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, first, (size_t)surface->n_patches + 1);
  FS_TRY(plan(ctx, surface, first, &made->n_data));
  FS_ALLOC(ctx, made->patch, first[surface->n_patches]);
  FS_ALLOC(ctx, made->data, made->n_data);
  made->n_patches = first[surface->n_patches];
  if (surface->n_data > 0) memcpy(made->data, surface->data, surface->n_data * sizeof *made->data);
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t c = 0; c < surface->patch[p].n_sides; c++) {
      fs_patch *part = &made->patch[first[p] + c];
      *part = surface->patch[p];
      part->n_sides = 4;
      part->part = (uint8_t)(c + 1);
      part->valence = 4;
      connect(surface, first, p, c, part);
      if (part->kind != FS_PATCH_TENSOR_BEZIER) continue;
      part->part = 0;
      part->data_start = start;
      cut_tensor_bezier(surface->data + surface->patch[p].data_start, c, part, made->data + start);
      start += fs_tensor_bezier_numbers(part);
    }
  *quads = made;
  made = NULL;
done:
  fs_release(ctx, first);
  fs_surface_free(ctx, made);
  return status;
}

fs_status fs_surface_to_quads(fs_context *ctx, const fs_surface *surface, fs_surface **quads) {
  for (int32_t p = 0; p < surface->n_patches; p++)
    if (surface->patch[p].n_sides == 3) return cut(ctx, surface, quads);
  return copy(ctx, surface, quads);
}
