/* SPDX-License-Identifier: MIT */
/* Single role: Stacho's G1 surface over a triangle mesh with normals: tangents and second derivatives at the vertices,
   a Bezier triangle for each face, a correction for each inner edge.

     q = d - (d . n_i) n_i,  d = p_j - p_i;   g_ij = q, or q / |q| times |d| or 2 |d| / (1 + |q| / |d|)
     h^i_ab = (g_ia . T_i g_ib) n_i,  T_i the tensor of curvature
     alpha_k = 1/2; where the triangles of an edge fall on one side of it, as obtuse ones do, the foot of the height,
     alpha_k = 1 - (p_k - p_i) . (p_j - p_i) / |p_j - p_i|^2, which changes nothing at the other edges */
#include "construct/stacho.h"
#include <fairsurf/construct.h>
#include "math/vec3.h"
#include "surface/stacho.h"

#include <string.h>

enum { CHUNK = 4096 };

typedef struct build {
  const fs_mesh *mesh;
  const fs_vec3 *normal;
  const double *shape; /* [n_vertices][6]; or NULL */
  const fs_stacho_options *options;
  uint8_t *is_upright; /* [n_halfedges] alpha is that of the height */
  uint8_t *has_failed; /* [n_halfedges] no correction yet */
  int32_t degree, first;
  fs_surface *surface;
} build;

/* ---- checks ---- */

static fs_status check_faces(fs_context *ctx, const fs_mesh *mesh) {
  for (int32_t f = 0; f < mesh->n_faces; f++)
    if (fs_mesh_face_size(mesh, f) != 3)
      return fs_fail(ctx, FS_ERR_UNSUPPORTED, "face %d has %d vertices: this construction needs a mesh of triangles",
                     (int)f, (int)fs_mesh_face_size(mesh, f));
  return FS_OK;
}

static fs_status check_edges(fs_context *ctx, const build *b) {
  const fs_mesh *mesh = b->mesh;
  for (int32_t h = 0; h < mesh->n_halfedges; h++)
    for (int end = 0; end < 2; end++) {
      int32_t i = mesh->origin[h], j = fs_mesh_target(mesh, h), v = end == 0 ? i : j;
      fs_vec3 d = fs_vec3_sub(mesh->position[j], mesh->position[i]), n = b->normal[v], q;
      double length = fs_vec3_length(d);
      if (!(fabs(fs_vec3_length(n) - 1) <= 1e-9))
        return fs_fail(ctx, FS_ERR_ARGUMENT, "the normal of vertex %d has length %g instead of 1", (int)v,
                       fs_vec3_length(n));
      if (!(length > 0))
        return fs_fail(ctx, FS_ERR_ARGUMENT, "the edge between vertices %d and %d has no length", (int)i, (int)j);
      q = fs_vec3_add_scaled(d, n, -fs_vec3_dot(d, n));
      if (!(fs_vec3_length(q) >= 1e-9 * length))
        return fs_fail(ctx, FS_ERR_ARGUMENT,
                       "the edge between vertices %d and %d is parallel to the normal at vertex %d", (int)i, (int)j,
                       (int)v);
    }
  return FS_OK;
}

/* Projected to the tangent plane at its vertex, every corner must open to the left. */
static fs_status check_corners(fs_context *ctx, const build *b) {
  const fs_mesh *mesh = b->mesh;
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    int32_t v = mesh->origin[h];
    fs_vec3 d = fs_vec3_sub(mesh->position[fs_mesh_target(mesh, h)], mesh->position[v]);
    fs_vec3 e = fs_vec3_sub(mesh->position[mesh->origin[fs_mesh_previous(mesh, h)]], mesh->position[v]);
    if (!(fs_vec3_dot(fs_vec3_cross(d, e), b->normal[v]) > 1e-9 * fs_vec3_length(d) * fs_vec3_length(e)))
      return fs_fail(ctx, FS_ERR_ARGUMENT,
                     "the corner of triangle %d at vertex %d has no area, or shows its back, seen along "
                     "the normal there",
                     (int)mesh->face[h], (int)v);
  }
  return FS_OK;
}

/* ---- triangles ---- */

static fs_vec3 tangent(const build *b, int32_t i, int32_t j) {
  fs_vec3 d = fs_vec3_sub(b->mesh->position[j], b->mesh->position[i]);
  fs_vec3 q = fs_vec3_add_scaled(d, b->normal[i], -fs_vec3_dot(d, b->normal[i]));
  double l = fs_vec3_length(q), length = fs_vec3_length(d);
  if (b->options->tangent == FS_STACHO_CHORD) return fs_vec3_scale(q, length / l);
  if (b->options->tangent == FS_STACHO_ARC) return fs_vec3_scale(q, 2 * length / (1 + l / length) / l);
  return q;
}

static void set(double *to, fs_vec3 from) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

static double apply_tensor(const double *T, const double *a, const double *b) {
  const double row[3] = {T[0] * b[0] + T[1] * b[1] + T[2] * b[2], T[1] * b[0] + T[3] * b[1] + T[4] * b[2],
                         T[2] * b[0] + T[4] * b[1] + T[5] * b[2]};
  return a[0] * row[0] + a[1] * row[1] + a[2] * row[2];
}

/* alpha of the edge from corner s to s + 1 of face f */
static double alpha(const build *b, int32_t f, int32_t s) {
  const int32_t *vertex = b->mesh->origin + b->mesh->face_start[f];
  fs_vec3 p = b->mesh->position[vertex[s]];
  fs_vec3 d = fs_vec3_sub(b->mesh->position[vertex[(s + 1) % 3]], p);
  if (!b->is_upright[b->mesh->face_start[f] + s]) return 0.5;
  return 1 - fs_vec3_dot(fs_vec3_sub(b->mesh->position[vertex[(s + 2) % 3]], p), d) / fs_vec3_dot(d, d);
}

static void set_corners(const build *b, int32_t f, fs_stacho_corners *c) {
  const int32_t *vertex = b->mesh->origin + b->mesh->face_start[f];
  *c = (fs_stacho_corners){.width = 3};
  for (int i = 0; i < 3; i++) {
    double n[3];
    c->alpha[(i + 2) % 3] = alpha(b, f, i);
    set(n, b->normal[vertex[i]]);
    set(c->p[i], b->mesh->position[vertex[i]]);
    for (int j = 0; j < 3; j++)
      if (j != i) set(c->g[i][j], tangent(b, vertex[i], vertex[j]));
    if (b->shape == NULL) continue;
    for (int j = 0; j < 3; j++)
      for (int k = 0; k < 3; k++)
        for (int w = 0; w < 3 && j != i && k != i; w++)
          c->h[i][j][k][w] = n[w] * apply_tensor(b->shape + 6 * (size_t)vertex[i], c->g[i][j], c->g[i][k]);
  }
}

static void set_points(const build *b, int32_t f) {
  fs_stacho_corners corners;
  set_corners(b, f, &corners);
  fs_stacho_bezier(&corners, b->options->variant, b->surface->data + b->surface->patch[f].data_start);
}

static fs_status build_faces(void *user, int32_t begin, int32_t end, int32_t worker) {
  const build *b = user;
  (void)worker;
  for (int32_t f = b->first + begin; f < b->first + end; f++) {
    fs_patch *patch = &b->surface->patch[f];
    *patch = (fs_patch){.kind = FS_PATCH_STACHO_TRIANGLE,
                        .n_sides = 3,
                        .degree_u = b->degree,
                        .degree_v = b->degree,
                        .data_start = (size_t)f * fs_stacho_side(b->degree, 3),
                        .face = f,
                        .valence = 4,
                        .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
    for (int32_t s = 0; s < 3; s++) {
      int32_t twin = b->mesh->twin[b->mesh->face_start[f] + s];
      if (twin == FS_NONE) continue;
      patch->neighbour[s] = b->mesh->face[twin];
      patch->neighbour_side[s] = (uint8_t)(twin - b->mesh->face_start[b->mesh->face[twin]]);
    }
    set_points(b, f);
  }
  return FS_OK;
}

/* ---- corrections ---- */

static fs_status correct(fs_context *ctx, const build *b, int32_t h) {
  const fs_mesh *mesh = b->mesh;
  const int32_t twin = mesh->twin[h], pair[2] = {h, twin};
  int32_t i = mesh->origin[h], j = fs_mesh_target(mesh, h);
  fs_stacho_half half[2];
  double fixed[3];
  if (twin < h) return FS_OK; /* at the boundary, or the other half does it */
  for (int w = 0; w < 2; w++) {
    int32_t f = mesh->face[pair[w]];
    half[w] = (fs_stacho_half){f, pair[w] - mesh->face_start[f], b->surface->data + b->surface->patch[f].data_start};
  }
  if (b->options->is_fixed_direction) {
    fs_vec3 sum = fs_vec3_add(b->normal[i], b->normal[j]);
    double length = fs_vec3_length(sum);
    if (!(length > 1e-9))
      return fs_fail(ctx, FS_ERR_NUMERIC, "the normals at vertices %d and %d are opposite", (int)i, (int)j);
    set(fixed, fs_vec3_scale(sum, 1 / length));
  }
  return fs_stacho_correct(ctx, b->degree, half, i, j, b->options->is_fixed_direction ? fixed : NULL);
}

static fs_status correct_edges(void *user, int32_t begin, int32_t end, int32_t worker) {
  const build *b = user;
  fs_context own = {0}; /* takes the sentence of a failure, which need not be the last word */
  (void)worker;
  for (int32_t h = b->first + begin; h < b->first + end; h++) b->has_failed[h] = correct(&own, b, h) != FS_OK;
  return FS_OK;
}

/* Runs a body on 0 .. n - 1 in chunks, between which progress is told. */
static fs_status run(fs_context *ctx, build *b, int32_t n, fs_parallel_body body, const char *stage) {
  fs_status status = FS_OK;
  for (b->first = 0; b->first < n; b->first += CHUNK) {
    FS_TRY(fs_progress(ctx, stage, (double)b->first / n));
    FS_TRY(fs_parallel_for(ctx, n - b->first < CHUNK ? n - b->first : CHUNK, body, b));
  }
done:
  return status;
}

static fs_status correct_all(fs_context *ctx, build *b) {
  const fs_mesh *mesh = b->mesh;
  fs_status status = FS_OK;
  FS_TRY(run(ctx, b, mesh->n_halfedges, correct_edges, "correct edges"));
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    const int32_t pair[2] = {h, mesh->twin[h]};
    if (!b->has_failed[h]) continue;
    for (int w = 0; w < 2; w++) {
      b->is_upright[pair[w]] = 1;
      set_points(b, mesh->face[pair[w]]);
    }
    FS_TRY(correct(ctx, b, h));
  }
done:
  return status;
}

static fs_status build_surface(fs_context *ctx, build *b, fs_surface **surface) {
  fs_status status = FS_OK;
  fs_surface *made = NULL;
  FS_ALLOC(ctx, made, 1);
  made->n_patches = b->mesh->n_faces;
  made->n_data = (size_t)b->mesh->n_faces * fs_stacho_side(b->degree, 3);
  FS_ALLOC(ctx, made->patch, made->n_patches);
  FS_ALLOC(ctx, made->data, made->n_data);
  b->surface = made;
  FS_TRY(run(ctx, b, b->mesh->n_faces, build_faces, "build triangles"));
  FS_TRY(correct_all(ctx, b));
  *surface = made;
  made = NULL;
done:
  fs_surface_free(ctx, made);
  return status;
}

fs_status fs_stacho_surface(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, const double *shape,
                            const fs_stacho_options *options, fs_surface **surface) {
  static const fs_stacho_options defaults = {0};
  fs_status status = FS_OK;
  fs_vec3 *own_normal = NULL;
  double *own_shape = NULL;
  build b = {.mesh = mesh, .normal = normal, .options = options != NULL ? options : &defaults};
  FS_TRY(check_faces(ctx, mesh));
  if (normal == NULL) {
    FS_ALLOC(ctx, own_normal, mesh->n_vertices);
    FS_TRY(fs_vertex_normals(ctx, mesh, own_normal));
    b.normal = own_normal;
  }
  FS_TRY(check_edges(ctx, &b));
  FS_TRY(check_corners(ctx, &b));
  if (b.options->variant == FS_STACHO_SECOND_ORDER) {
    if (shape == NULL) {
      FS_ALLOC(ctx, own_shape, 6 * (size_t)mesh->n_vertices);
      FS_TRY(fs_mesh_shape_tensors(ctx, mesh, b.normal, own_shape));
    }
    b.shape = shape != NULL ? shape : own_shape;
  }
  b.degree = fs_stacho_degree(b.options->variant);
  FS_ALLOC(ctx, b.is_upright, mesh->n_halfedges);
  FS_ALLOC(ctx, b.has_failed, mesh->n_halfedges);
  FS_TRY(build_surface(ctx, &b, surface));
done:
  fs_release(ctx, own_normal);
  fs_release(ctx, own_shape);
  fs_release(ctx, b.is_upright);
  fs_release(ctx, b.has_failed);
  return status;
}
