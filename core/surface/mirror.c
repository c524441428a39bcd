/* SPDX-License-Identifier: MIT */
/* Single role: patches become exact mirror images of each other. Dofs that are images give Bezier points that are images to
   rounding only, since the sums run in another order, and since bases of caps are no images. */
#include "surface/surface.h"
#include "math/vec3.h"

/* The number of the point in the image at which point (i, j) of a patch of degree (n, m) has its image. */
static int32_t image_point(int side, int32_t n, int32_t m, int32_t i, int32_t j) {
  switch (side) {
  case 0:
    return n - i + (n + 1) * j;
  case 1:
    return m - j + (m + 1) * (n - i);
  case 2:
    return i + (n + 1) * (m - j);
  default:
    return j + (m + 1) * i;
  }
}

static fs_vec3 get(const double *b) { return (fs_vec3){b[0], b[1], b[2]}; }
static void put(double *b, fs_vec3 p) { b[0] = p.x, b[1] = p.y, b[2] = p.z; }

static void reflect_points(const fs_symmetry *s, const fs_patch *patch, int side, const double *from, double *to) {
  int32_t n = patch->degree_u, m = patch->degree_v;
  for (int32_t j = 0; j <= m; j++)
    for (int32_t i = 0; i <= n; i++)
      put(to + 3 * image_point(side, n, m, i, j), fs_symmetry_reflect(s, get(from + 3 * (i + (n + 1) * j))));
}

/* b becomes the mean of itself and its image; of each pair one is the mean, the other the image of that. */
static void average_points(const fs_symmetry *s, const fs_patch *patch, int side, double *b) {
  int32_t n = patch->degree_u, m = patch->degree_v;
  for (int32_t j = 0; j <= m; j++)
    for (int32_t i = 0; i <= n; i++) {
      int32_t here = i + (n + 1) * j, there = image_point(side, n, m, i, j);
      fs_vec3 p = get(b + 3 * here), q = fs_symmetry_reflect(s, get(b + 3 * there)), mean;
      if (there < here) continue;
      mean = fs_vec3_scale(fs_vec3_add(p, q), 0.5);
      put(b + 3 * here, mean);
      if (there > here) put(b + 3 * there, fs_symmetry_reflect(s, mean));
    }
}

fs_status fs_surface_mirror(fs_context *ctx, const fs_symmetry *s, fs_surface *surface) {
  if (surface->n_patches != s->n_elements)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a symmetry of %d elements does not fit a surface of %d patches",
                   s->n_elements, surface->n_patches);
  for (int32_t i = 0; i < surface->n_patches; i++) {
    const fs_patch *patch = &surface->patch[i], *image = &surface->patch[s->element[i]];
    bool is_turned = s->side[i] % 2 == 1;
    if (!fs_patch_is_tensor_bezier(patch) || !fs_patch_is_tensor_bezier(image) ||
        image->degree_u != (is_turned ? patch->degree_v : patch->degree_u) ||
        image->degree_v != (is_turned ? patch->degree_u : patch->degree_v))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "patch %d and its image, patch %d, differ in kind", i, s->element[i]);
  }
  for (int32_t i = 0; i < surface->n_patches; i++) {
    double *from = surface->data + surface->patch[i].data_start;
    if (s->element[i] > i)
      reflect_points(s, &surface->patch[i], s->side[i], from, surface->data + surface->patch[s->element[i]].data_start);
    else if (s->element[i] == i)
      average_points(s, &surface->patch[i], s->side[i], from);
  }
  return FS_OK;
}
