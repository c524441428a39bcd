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

/* What the page holds of a cap. */
typedef struct web_cap {
  int32_t vertex, spoke, valence, n;
} web_cap;

/* NULL where there are no caps. The coefficients lie one after the other, cap by cap. */
static fs_status take_caps(web_page *page, int32_t n_caps, const web_cap *cap, int32_t n_offsets, const fs_vec3 *offset,
                           fs_cap_notes **result) {
  fs_status status = FS_OK;
  fs_cap_notes *notes = NULL;
  int32_t first = 0;
  if (n_caps == 0 && n_offsets == 0) return FS_OK;
  FS_TRY(fs_cap_notes_create(&page->ctx, n_caps, n_offsets, &notes));
  for (int32_t i = 0; i < n_offsets; i++) notes->coefficient[i] = offset[i];
  for (int32_t i = 0; i < n_caps; i++) {
    notes->cap[i] = (fs_cap_note){cap[i].vertex, cap[i].spoke, cap[i].valence, first, cap[i].n};
    if (cap[i].n < 0 || cap[i].n > n_offsets - first) break;
    first += cap[i].n;
  }
  if (first != n_offsets) {
    status = fs_fail(&page->ctx, FS_ERR_FORMAT,
                     "the page holds %d inner coefficients of caps, but its caps need others", (int)n_offsets);
    goto done;
  }
  *result = notes;
  notes = NULL;
done:
  fs_cap_notes_free(&page->ctx, notes);
  return status;
}

/* Makes the surface of the net with the inner coefficients offset[n_offsets] of its caps. */
EXPORT("page_open")
fs_status web_page_open(web_page *page, int32_t n_vertices, const fs_vec3 *position, int32_t n_faces,
                        const int32_t *face_start, const int32_t *corner, int32_t n_caps, const web_cap *cap,
                        int32_t n_offsets, const fs_vec3 *offset) {
  fs_status status;
  fs_mesh *mesh = NULL;
  fs_space *space = NULL;
  fs_cap_notes *notes = NULL;
  FS_TRY(fs_mesh_create(&page->ctx, n_vertices, position, n_faces, face_start, corner, &mesh));
  FS_TRY(take_caps(page, n_caps, cap, n_offsets, offset, &notes));
  const fs_space_options options = {.caps = notes != NULL ? FS_CAPS_FULL : FS_CAPS_LINEAR, .kept = notes};
  FS_TRY(fs_space_create_with(&page->ctx, mesh, &options, &space));
  FS_TRY(fs_surface_create(&page->ctx, space, space->start, &page->surface));
done:
  fs_cap_notes_free(&page->ctx, notes);
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
