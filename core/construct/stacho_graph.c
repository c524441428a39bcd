/* SPDX-License-Identifier: MIT */
/* Single role: Stacho's C1 graph over a triangulation of the plane, as Bezier triangles.

   Across edge k the derivative is prescribed along u_k = e_k - alpha_k e_i - (1 - alpha_k) e_j in barycentrics, which must
   be the same direction of the plane for both triangles of the edge:
     perpendicular  alpha_k = 1 - (x_k - x_i) . (x_j - x_i) / |x_j - x_i|^2
     opposite       u = (opposite corner of the neighbour) - x_k, tau = ((x_k - x_i) x u) / ((x_j - x_i) x u),
                    alpha_k = 1 - tau; 1/2 at the boundary                                       [docs/stacho.md] */
#include "construct/stacho.h"
#include "math/triangle.h"
#include "mesh/mesh.h"

#include <math.h>
#include <string.h>

typedef struct plane_vector {
  double x, y;
} plane_vector;

typedef struct graph {
  const fs_mesh *mesh;
  const double *gradient, *hessian; /* [n_vertices][2], [n_vertices][3] or NULL */
  fs_stacho_graph_options options;
  int32_t degree;
} graph;

static plane_vector between(const fs_mesh *mesh, int32_t a, int32_t b) {
  return (plane_vector){mesh->position[b].x - mesh->position[a].x, mesh->position[b].y - mesh->position[a].y};
}

static double cross(plane_vector a, plane_vector b) { return a.x * b.y - a.y * b.x; }
static double dot(plane_vector a, plane_vector b) { return a.x * b.x + a.y * b.y; }

static fs_status check_faces(fs_context *ctx, const fs_mesh *mesh) {
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    const int32_t *v = mesh->origin + mesh->face_start[f];
    if (fs_mesh_face_size(mesh, f) != 3)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "face %d has %d vertices: a graph needs a mesh of triangles", (int)f,
                     (int)fs_mesh_face_size(mesh, f));
    plane_vector a = between(mesh, v[0], v[1]), b = between(mesh, v[0], v[2]);
    double size = dot(a, a) + dot(b, b), area = cross(a, b);
    if (!(area > 1e-14 * size))
      return fs_fail(
          ctx, FS_ERR_ARGUMENT,
          "triangle %d (vertices %d, %d, %d) is not anticlockwise in the (x, y) plane: twice its area there is "
          "%g",
          (int)f, (int)v[0], (int)v[1], (int)v[2], area);
  }
  return FS_OK;
}

/* alpha of the edge from corner s to s + 1 of face f, which is edge k = s + 2. */
static double alpha(const graph *g, int32_t f, int32_t s) {
  const fs_mesh *mesh = g->mesh;
  int32_t start = mesh->face_start[f], twin = mesh->twin[start + s];
  int32_t i = mesh->origin[start + s], j = mesh->origin[start + (s + 1) % 3], k = mesh->origin[start + (s + 2) % 3];
  plane_vector d = between(mesh, i, j), to_k = between(mesh, i, k), u;
  if (g->options.direction == FS_STACHO_PERPENDICULAR) return 1 - dot(to_k, d) / dot(d, d);
  if (twin == FS_NONE) return 0.5;
  u = between(mesh, k, mesh->origin[fs_mesh_previous(mesh, twin)]);
  return 1 - cross(to_k, u) / cross(d, u);
}

static void set_corners(const graph *g, int32_t f, fs_stacho_corners *c) {
  const int32_t *vertex = g->mesh->origin + g->mesh->face_start[f];
  *c = (fs_stacho_corners){.width = 1};
  for (int i = 0; i < 3; i++) {
    const double *A = g->gradient + 2 * (size_t)vertex[i];
    c->p[i][0] = g->mesh->position[vertex[i]].z;
    for (int j = 0; j < 3; j++) {
      plane_vector a = between(g->mesh, vertex[i], vertex[j]);
      c->g[i][j][0] = A[0] * a.x + A[1] * a.y;
      for (int k = 0; k < 3 && g->hessian != NULL; k++) {
        const double *H = g->hessian + 3 * (size_t)vertex[i];
        plane_vector b = between(g->mesh, vertex[i], vertex[k]);
        c->h[i][j][k][0] = H[0] * a.x * b.x + H[1] * (a.x * b.y + a.y * b.x) + H[2] * a.y * b.y;
      }
    }
    c->alpha[(i + 2) % 3] = alpha(g, f, i);
  }
}

/* Points of face f: x and y are linear, z is Stacho's polynomial. */
static void set_points(const graph *g, int32_t f, double *point) {
  enum { MAX = (FS_MAX_TRIANGLE_DEGREE + 1) * (FS_MAX_TRIANGLE_DEGREE + 2) / 2 };
  const int32_t *vertex = g->mesh->origin + g->mesh->face_start[f];
  fs_stacho_corners corners;
  double height[MAX];
  int32_t n = g->degree;
  set_corners(g, f, &corners);
  if (g->options.shape != NULL)
    fs_stacho_shaped_bezier(&corners, g->options.shape, height);
  else
    fs_stacho_bezier(&corners, g->options.variant, height);
  for (int32_t k = 0; k <= n; k++)
    for (int32_t j = 0; j <= n - k; j++) {
      int32_t e[3] = {n - j - k, j, k}, index = fs_triangle_index(n, j, k);
      double x = 0, y = 0;
      for (int i = 0; i < 3; i++) {
        x += e[i] * g->mesh->position[vertex[i]].x / n;
        y += e[i] * g->mesh->position[vertex[i]].y / n;
      }
      point[3 * index] = x, point[3 * index + 1] = y, point[3 * index + 2] = height[index];
    }
}

static void set_patch(const graph *g, int32_t f, fs_patch *patch) {
  const fs_mesh *mesh = g->mesh;
  *patch = (fs_patch){.kind = FS_PATCH_BEZIER_TRIANGLE,
                      .n_sides = 3,
                      .degree_u = g->degree,
                      .degree_v = g->degree,
                      .data_start = 3 * (size_t)f * (size_t)fs_triangle_size(g->degree),
                      .face = f,
                      .valence = 4,
                      .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  for (int32_t s = 0; s < 3; s++) {
    int32_t twin = mesh->twin[mesh->face_start[f] + s];
    if (twin == FS_NONE) continue;
    patch->neighbour[s] = mesh->face[twin];
    patch->neighbour_side[s] = (uint8_t)(twin - mesh->face_start[mesh->face[twin]]);
  }
}

static fs_status build_surface(fs_context *ctx, const graph *g, fs_surface **surface) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  FS_ALLOC(ctx, made, 1);
  made->n_patches = g->mesh->n_faces;
  made->n_data = 3 * (size_t)g->mesh->n_faces * (size_t)fs_triangle_size(g->degree);
  FS_ALLOC(ctx, made->patch, made->n_patches);
  FS_ALLOC(ctx, made->data, made->n_data);
  for (int32_t f = 0; f < g->mesh->n_faces; f++) {
    if (f % 1024 == 0) FS_TRY(fs_progress(ctx, "build triangles", (double)f / g->mesh->n_faces));
    set_patch(g, f, &made->patch[f]);
    set_points(g, f, made->data + made->patch[f].data_start);
  }
  *surface = made;
  made = NULL;
done:
  fs_surface_free(ctx, made);
  return status;
}

static fs_status check_finite(fs_context *ctx, const char *what, int32_t n, int32_t width, const double *values) {
  for (int32_t v = 0; v < n; v++)
    for (int32_t w = 0; w < width; w++)
      if (!isfinite(values[(size_t)v * (size_t)width + (size_t)w]))
        return fs_fail(ctx, FS_ERR_ARGUMENT, "the %s at vertex %d is not finite", what, (int)v);
  return FS_OK;
}

fs_status fs_stacho_graph(fs_context *ctx, const fs_mesh *mesh, const double *gradient, const double *hessian,
                          const fs_stacho_graph_options *options, fs_surface **surface) {
  fs_status status = FS_OK;
  double *own_gradient = NULL, *own_hessian = NULL;
  graph g = {.mesh = mesh, .gradient = gradient};
  if (options != NULL) g.options = *options;
  bool needs_hessian = g.options.shape == NULL && g.options.variant == FS_STACHO_SECOND_ORDER;
  FS_TRY(check_faces(ctx, mesh));
  if (g.options.shape != NULL) FS_TRY(fs_stacho_shape_check(ctx, g.options.shape));
  if (gradient == NULL) FS_ALLOC(ctx, own_gradient, 2 * (size_t)mesh->n_vertices);
  if (needs_hessian && hessian == NULL) FS_ALLOC(ctx, own_hessian, 3 * (size_t)mesh->n_vertices);
  if (own_gradient != NULL || own_hessian != NULL) FS_TRY(fs_graph_derivatives(ctx, mesh, own_gradient, own_hessian));
  if (gradient == NULL) g.gradient = own_gradient;
  if (needs_hessian) g.hessian = hessian != NULL ? hessian : own_hessian;
  FS_TRY(check_finite(ctx, "gradient", mesh->n_vertices, 2, g.gradient));
  if (g.hessian != NULL) FS_TRY(check_finite(ctx, "Hessian", mesh->n_vertices, 3, g.hessian));
  g.degree = g.options.shape != NULL ? fs_stacho_shape_degree(g.options.shape) : fs_stacho_degree(g.options.variant);
  FS_TRY(build_surface(ctx, &g, surface));
done:
  fs_release(ctx, own_gradient);
  fs_release(ctx, own_hessian);
  return status;
}
