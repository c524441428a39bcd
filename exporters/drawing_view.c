/* SPDX-License-Identifier: MIT */
/* Single role: what a viewer far away sees: projection, and a depth buffer of the triangles of a surface. */
#include "drawing.h"
#include "base/base.h"
#include "analyse/curves.h"
#include "math/vec3.h"

enum { N_CELLS = 1000 };

fs_vec3 fs_view_project(const fs_view *view, fs_vec3 p) {
  return (fs_vec3){fs_vec3_dot(p, view->right), fs_vec3_dot(p, view->up), fs_vec3_dot(p, view->towards)};
}

/* The z of the triangle in all cells whose middles it covers. */
static void raster(fs_view *v, const fs_vec3 q[3]) {
  double area = (q[1].x - q[0].x) * (q[2].y - q[0].y) - (q[2].x - q[0].x) * (q[1].y - q[0].y);
  double low_x = fmin(q[0].x, fmin(q[1].x, q[2].x)), high_x = fmax(q[0].x, fmax(q[1].x, q[2].x));
  double low_y = fmin(q[0].y, fmin(q[1].y, q[2].y)), high_y = fmax(q[0].y, fmax(q[1].y, q[2].y));
  int32_t i0 = (int32_t)fmax(0, floor((low_x - v->origin[0]) / v->cell)),
          i1 = (int32_t)fmin(v->n - 1, ceil((high_x - v->origin[0]) / v->cell));
  int32_t j0 = (int32_t)fmax(0, floor((low_y - v->origin[1]) / v->cell)),
          j1 = (int32_t)fmin(v->n - 1, ceil((high_y - v->origin[1]) / v->cell));
  if (!(fabs(area) > 0)) return;
  for (int32_t j = j0; j <= j1; j++)
    for (int32_t i = i0; i <= i1; i++) {
      double x = v->origin[0] + (i + 0.5) * v->cell, y = v->origin[1] + (j + 0.5) * v->cell;
      double b = ((x - q[0].x) * (q[2].y - q[0].y) - (q[2].x - q[0].x) * (y - q[0].y)) / area;
      double c = ((q[1].x - q[0].x) * (y - q[0].y) - (x - q[0].x) * (q[1].y - q[0].y)) / area;
      if (b < 0 || c < 0 || b + c > 1) continue;
      double z = q[0].z + b * (q[1].z - q[0].z) + c * (q[2].z - q[0].z);
      double *depth = &v->depth[i + (size_t)v->n * (size_t)j];
      *depth = fmax(*depth, z);
    }
}

fs_status fs_view_create(fs_context *ctx, const fs_triangles *triangles, double azimuth, double elevation,
                         fs_view *view) {
  fs_status status = FS_OK;
  double radians = azimuth * acos(-1.0) / 180, size, low_z = INFINITY, high_z = -INFINITY;
  *view = (fs_view){.towards = fs_direction_of(azimuth, elevation), .right = {-sin(radians), cos(radians), 0}};
  view->up = fs_vec3_cross(view->towards, view->right);
  view->low[0] = view->low[1] = INFINITY;
  view->high[0] = view->high[1] = -INFINITY;
  for (int32_t i = 0; i < triangles->n_vertices; i++) {
    fs_vec3 q = fs_view_project(view, triangles->position[i]);
    view->low[0] = fmin(view->low[0], q.x), view->high[0] = fmax(view->high[0], q.x);
    view->low[1] = fmin(view->low[1], q.y), view->high[1] = fmax(view->high[1], q.y);
    low_z = fmin(low_z, q.z), high_z = fmax(high_z, q.z);
  }
  size = fmax(view->high[0] - view->low[0], view->high[1] - view->low[1]);
  view->n = N_CELLS;
  view->cell = size > 0 ? 1.002 * size / N_CELLS : 1;
  view->origin[0] = view->low[0] - 0.001 * size, view->origin[1] = view->low[1] - 0.001 * size;
  view->bias = 4e-3 * fmax(size, high_z - low_z);
  FS_ALLOC(ctx, view->depth, (size_t)view->n * (size_t)view->n);
  for (size_t i = 0; i < (size_t)view->n * (size_t)view->n; i++) view->depth[i] = -INFINITY;
  for (int32_t t = 0; t < triangles->n_triangles; t++) {
    const int32_t *corner = &triangles->corner[3 * t];
    const fs_vec3 q[3] = {fs_view_project(view, triangles->position[corner[0]]),
                          fs_view_project(view, triangles->position[corner[1]]),
                          fs_view_project(view, triangles->position[corner[2]])};
    raster(view, q);
  }
done:
  return status;
}

void fs_view_clear(fs_context *ctx, fs_view *view) {
  fs_release(ctx, view->depth);
  view->depth = NULL;
}

/* The farthest of the cells around it counts: a point on a contour has the surface on one side only. */
bool fs_view_sees(const fs_view *v, fs_vec3 q) {
  int32_t i = (int32_t)floor((q.x - v->origin[0]) / v->cell), j = (int32_t)floor((q.y - v->origin[1]) / v->cell);
  double farthest = INFINITY;
  for (int32_t b = j - 1; b <= j + 1; b++)
    for (int32_t a = i - 1; a <= i + 1; a++) {
      if (a < 0 || b < 0 || a >= v->n || b >= v->n) return true;
      farthest = fmin(farthest, v->depth[a + (size_t)v->n * (size_t)b]);
    }
  return q.z + v->bias >= farthest;
}
