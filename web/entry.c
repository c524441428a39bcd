/* SPDX-License-Identifier: MIT */
/* Single role: what the page of the HTML exporter calls, compiled to WebAssembly with the portable rooms of core/: a surface
   from a control net, triangles of it at a chosen density, and how it bends at their vertices. Pointers that it returns
   hold until the next call; the page copies what they point to. */
#include "base/base.h"
#include "math/diffgeo.h"

#include <fairsurf/surface.h>

#include <math.h>

#define EXPORT(name) __attribute__((export_name(name), used))

enum { N_CURVATURES = 4 }; /* mean, Gaussian, larger and smaller principal curvature, in this order */

typedef struct web_page {
  fs_context ctx;
  fs_surface *surface;
  fs_triangles *triangles;
  double *curvature; /* [n_vertices][N_CURVATURES]; NaN where p_u x p_v = 0 */
} web_page;

EXPORT("allocate") void *web_allocate(size_t size) {
  fs_context ctx = {0};
  return fs_allocate(&ctx, size, 1);
}

EXPORT("release") void web_release(void *block) {
  fs_context ctx = {0};
  fs_release(&ctx, block);
}

/* NULL where memory is short. */
EXPORT("page_create") web_page *web_page_create(void) { return web_allocate(sizeof(web_page)); }

EXPORT("page_message") const char *web_page_message(const web_page *page) { return page->ctx.message; }

static fs_status take_offsets(web_page *page, const fs_space *space, int32_t n_offsets, const fs_vec3 *offset,
                              fs_vec3 *c) {
  if (space->n_dofs - space->n_vertices != n_offsets)
    return fs_fail(&page->ctx, FS_ERR_FORMAT, "the page holds %d inner coefficients of caps, its net needs %d",
                   (int)n_offsets, (int)(space->n_dofs - space->n_vertices));
  for (int32_t i = 0; i < space->n_vertices; i++) c[i] = space->start[i];
  for (int32_t i = 0; i < n_offsets; i++) c[space->n_vertices + i] = offset[i];
  return FS_OK;
}

/* Makes the surface of the net; caps is one of fs_cap_inner, offset[n_offsets] are the dofs behind those of the vertices. */
EXPORT("page_open")
fs_status web_page_open(web_page *page, int32_t n_vertices, const fs_vec3 *position, int32_t n_faces,
                        const int32_t *face_start, const int32_t *corner, int32_t caps, int32_t n_offsets,
                        const fs_vec3 *offset) {
  fs_status status;
  fs_mesh *mesh = NULL;
  fs_space *space = NULL;
  fs_vec3 *c = NULL;
  fs_space_options options = {.caps = (fs_cap_inner)caps};
  FS_TRY(fs_mesh_create(&page->ctx, n_vertices, position, n_faces, face_start, corner, &mesh));
  FS_TRY(fs_space_create_with(&page->ctx, mesh, &options, &space));
  FS_ALLOC(&page->ctx, c, space->n_dofs);
  FS_TRY(take_offsets(page, space, n_offsets, offset, c));
  FS_TRY(fs_surface_create(&page->ctx, space, c, &page->surface));
done:
  fs_release(&page->ctx, c);
  fs_space_free(&page->ctx, space);
  fs_mesh_free(&page->ctx, mesh);
  fs_context_clear(&page->ctx);
  return status;
}

EXPORT("page_n_patches") int32_t web_page_n_patches(const web_page *page) { return page->surface->n_patches; }

static void bend_at(const fs_surface *surface, int32_t patch, const double *uv, double *curvature) {
  fs_vec3 x[FS_JET_SIZE];
  fs_geometry g;
  fs_principal principal;
  fs_surface_evaluate(surface, patch, uv[0], uv[1], x);
  if (!fs_geometry_compute(x, &g)) {
    for (int k = 0; k < N_CURVATURES; k++) curvature[k] = (double)NAN;
    return;
  }
  fs_geometry_principal(&g, &principal);
  curvature[0] = g.H, curvature[1] = g.K, curvature[2] = principal.maximum, curvature[3] = principal.minimum;
}

/* n_steps x n_steps quadrilaterals per patch; what was there before stays on failure. */
EXPORT("page_tessellate") fs_status web_page_tessellate(web_page *page, int32_t n_steps) {
  fs_status status;
  fs_triangles *t = NULL;
  double *curvature = NULL;
  FS_TRY(fs_tessellate(&page->ctx, page->surface, n_steps, &t));
  FS_ALLOC(&page->ctx, curvature, (size_t)t->n_vertices * N_CURVATURES);
  for (int32_t v = 0; v < t->n_vertices; v++)
    bend_at(page->surface, t->vertex_patch[v], &t->vertex_uv[2 * v], &curvature[N_CURVATURES * v]);
  fs_triangles_free(&page->ctx, page->triangles);
  fs_release(&page->ctx, page->curvature);
  page->triangles = t, t = NULL;
  page->curvature = curvature, curvature = NULL;
done:
  fs_triangles_free(&page->ctx, t);
  fs_release(&page->ctx, curvature);
  return status;
}

EXPORT("page_n_vertices") int32_t web_page_n_vertices(const web_page *page) { return page->triangles->n_vertices; }
EXPORT("page_n_triangles") int32_t web_page_n_triangles(const web_page *page) { return page->triangles->n_triangles; }
EXPORT("page_positions") const fs_vec3 *web_page_positions(const web_page *page) { return page->triangles->position; }
EXPORT("page_normals") const fs_vec3 *web_page_normals(const web_page *page) { return page->triangles->normal; }
EXPORT("page_corners") const int32_t *web_page_corners(const web_page *page) { return page->triangles->corner; }
EXPORT("page_curvatures") const double *web_page_curvatures(const web_page *page) { return page->curvature; }
