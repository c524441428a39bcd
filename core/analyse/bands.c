/* SPDX-License-Identifier: MIT */
/* Single role: the parts of a surface where a field exceeds a level, as triangles: every cell of an n x n grid per patch
   is cut along the straight lines between the points of its sides where the field has the level. */
#include "analyse/curves.h"
#include "math/vec3.h"

#include <stdlib.h>

typedef struct corner {
  double u, v, f;
} corner;

/* The parameter between two corners of opposite sign where the field vanishes, by bisection with secants. */
static corner cut(const fs_surface *surface, const fs_field *field, double level, int32_t patch, corner a, corner b) {
  corner m = a;
  for (int k = 0; k < 40; k++) {
    double t = k % 2 == 0 ? a.f / (a.f - b.f) : 0.5;
    t = fmin(fmax(t, 0.01), 0.99);
    m.u = a.u + t * (b.u - a.u), m.v = a.v + t * (b.v - a.v);
    m.f = fs_field_at(surface, field, patch, m.u, m.v) - level;
    if (!isfinite(m.f) || fabs(m.f) < 1e-12) break;
    if ((m.f > 0) == (a.f > 0))
      a = m;
    else
      b = m;
  }
  return m;
}

static fs_status fill_triangle(fs_context *ctx, const fs_surface *surface, int32_t patch, const corner *c,
                               fs_curve_list *list) {
  fs_vec3 fill[2][3];
  for (int k = 0; k < 3; k++) {
    fs_curve_point p = fs_curve_point_at(surface, patch, c[k].u, c[k].v);
    fill[0][k] = p.position, fill[1][k] = p.normal;
  }
  return fs_curve_list_fill(ctx, list, fill);
}

static fs_status fill_part(fs_context *ctx, const fs_surface *surface, const fs_field *field, double level,
                           int32_t patch, const corner c[3], fs_curve_list *list) {
  fs_status status = FS_OK;
  corner inside[4];
  int n = 0;
  for (int k = 0; k < 3; k++) {
    const corner *a = &c[k], *b = &c[(k + 1) % 3];
    if (!isfinite(a->f)) return FS_OK;
    if (a->f > 0) inside[n++] = *a;
    if (isfinite(b->f) && (a->f > 0) != (b->f > 0)) inside[n++] = cut(surface, field, level, patch, *a, *b);
  }
  for (int k = 2; k < n; k++)
    FS_TRY(fill_triangle(ctx, surface, patch, (const corner[]){inside[0], inside[k - 1], inside[k]}, list));
done:
  return status;
}

fs_status fs_bands_append(fs_context *ctx, const fs_surface *surface, const fs_field *field, double level,
                          int32_t n_cells, fs_curve_list *list) {
  fs_status status = FS_OK;
  int32_t n = n_cells;
  corner *grid = NULL;
  FS_ALLOC(ctx, grid, (size_t)(n + 1) * (size_t)(n + 1));
  for (int32_t p = 0; p < surface->n_patches; p++) {
    for (int32_t k = 0; k < (n + 1) * (n + 1); k++) {
      corner *c = &grid[k];
      c->u = (double)(k % (n + 1)) / n, c->v = (double)(k / (n + 1)) / n;
      c->f = fs_field_at(surface, field, p, c->u, c->v) - level;
    }
    for (int32_t k = 0; k < n * n; k++) {
      const corner *c = &grid[k % n + (n + 1) * (k / n)];
      FS_TRY(fill_part(ctx, surface, field, level, p, (const corner[]){c[0], c[1], c[n + 2]}, list));
      FS_TRY(fill_part(ctx, surface, field, level, p, (const corner[]){c[0], c[n + 2], c[n + 1]}, list));
    }
  }
done:
  fs_release(ctx, grid);
  return status;
}
