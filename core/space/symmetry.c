/* SPDX-License-Identifier: MIT */
/* Single role: a mirror symmetry of positions becomes one of vertices, half-edges and elements.

   Images of vertices are found by position, in an order along a direction that no plane of interest contains. Images of
   half-edges follow: a -> b goes to image(b) -> image(a), and the image of the next half-edge is the previous one. */
#include "space/symmetry.h"
#include "math/vec3.h"

#include <stdlib.h>

static const fs_vec3 direction = {0.57735, 0.41421, 0.70462}; /* of the order, nearly of unit length */

fs_vec3 fs_plane_reflect(fs_vec3 normal, double offset, fs_vec3 p) {
  return fs_vec3_add_scaled(p, normal, -2 * (fs_vec3_dot(normal, p) - offset));
}

fs_vec3 fs_symmetry_reflect(const fs_symmetry *s, fs_vec3 p) { return fs_plane_reflect(s->normal, s->offset, p); }

void fs_symmetry_parameters(const fs_symmetry *s, int32_t element, double u, double v, double *image_u,
                            double *image_v) {
  switch (s->side[element]) {
  case 0:
    *image_u = 1 - u, *image_v = v;
    break;
  case 1:
    *image_u = 1 - v, *image_v = 1 - u;
    break;
  case 2:
    *image_u = u, *image_v = 1 - v;
    break;
  default:
    *image_u = v, *image_v = u;
    break;
  }
}

void fs_symmetry_apply(const fs_symmetry *s, fs_vec3 *c) {
  for (int32_t v = 0; v < s->n_vertices; v++) {
    double height = fs_vec3_dot(s->normal, c[v]) - s->offset;
    int32_t image = s->vertex[v];
    if (image == v)
      c[v] = fs_vec3_add_scaled(c[v], s->normal, -height);
    else if (fs_symmetry_is_first(s, v))
      c[image] = fs_symmetry_reflect(s, c[v]);
  }
}

/* ---- vertices ---------------------------------------------------------------------------------------------------- */

static int compare(const void *a, const void *b) {
  const fs_keyed_vertex *x = a, *y = b;
  if (x->key != y->key) return x->key < y->key ? -1 : 1;
  return (x->vertex > y->vertex) - (x->vertex < y->vertex);
}

fs_status fs_sorted_vertices_create(fs_context *ctx, const fs_mesh *mesh, fs_keyed_vertex **sorted) {
  fs_status status = FS_OK;
  fs_keyed_vertex *s = NULL;
  FS_ALLOC(ctx, s, mesh->n_vertices);
  for (int32_t v = 0; v < mesh->n_vertices; v++) s[v] = (fs_keyed_vertex){fs_vec3_dot(direction, mesh->position[v]), v};
  qsort(s, (size_t)mesh->n_vertices, sizeof *s, compare);
  *sorted = s;
done:
  return status;
}

/* The vertex nearest to p within tolerance, or FS_NONE. */
static int32_t find_at(const fs_mesh *mesh, const fs_keyed_vertex *sorted, fs_vec3 p, double tolerance) {
  double key = fs_vec3_dot(direction, p), nearest = tolerance;
  int32_t low = 0, high = mesh->n_vertices, found = FS_NONE;
  while (low < high) {
    int32_t middle = low + (high - low) / 2;
    if (sorted[middle].key < key - 2 * tolerance)
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < mesh->n_vertices && sorted[low].key <= key + 2 * tolerance; low++) {
    double distance = fs_vec3_distance(p, mesh->position[sorted[low].vertex]);
    if (distance <= nearest) nearest = distance, found = sorted[low].vertex;
  }
  return found;
}

int32_t fs_plane_map_vertices(const fs_mesh *mesh, const fs_keyed_vertex *sorted, fs_vec3 normal, double offset,
                              double tolerance, int32_t *image) {
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    image[v] = find_at(mesh, sorted, fs_plane_reflect(normal, offset, mesh->position[v]), tolerance);
    if (image[v] == FS_NONE || (image[v] < v && image[image[v]] != v)) return v;
  }
  for (int32_t v = 0; v < mesh->n_vertices; v++)
    if (image[image[v]] != v) return v;
  return FS_NONE;
}

/* ---- half-edges -------------------------------------------------------------------------------------------------- */

static int32_t find_halfedge(const fs_mesh *mesh, int32_t from, int32_t to) {
  int32_t first = mesh->outgoing[from], h = first;
  do {
    if (fs_mesh_target(mesh, h) == to) return h;
    h = fs_mesh_rotate(mesh, h);
  } while (h != FS_NONE && h != first);
  return FS_NONE;
}

int32_t fs_plane_map_halfedges(const fs_mesh *mesh, const int32_t *vertex, int32_t *halfedge) {
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    halfedge[h] = find_halfedge(mesh, vertex[fs_mesh_target(mesh, h)], vertex[mesh->origin[h]]);
    if (halfedge[h] == FS_NONE) return mesh->face[h];
  }
  for (int32_t h = 0; h < mesh->n_halfedges; h++)
    if (halfedge[fs_mesh_next(mesh, h)] != fs_mesh_previous(mesh, halfedge[h])) return mesh->face[h];
  return FS_NONE;
}

/* ---- the symmetry ------------------------------------------------------------------------------------------------ */

double fs_symmetry_tolerance(const fs_mesh *mesh) {
  fs_vec3 low = mesh->position[0], high = low;
  for (int32_t v = 1; v < mesh->n_vertices; v++) {
    low = fs_vec3_min(low, mesh->position[v]);
    high = fs_vec3_max(high, mesh->position[v]);
  }
  return 1e-6 * fs_vec3_distance(low, high);
}

static fs_status set_plane(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, double offset, fs_symmetry *s) {
  double length = normal != NULL ? fs_vec3_length(*normal) : 1, *component;
  if (normal == NULL) return fs_symmetry_find(ctx, mesh, &s->normal, &s->offset);
  if (!(length > 0) || !isfinite(length) || !isfinite(offset))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the plane of symmetry has the normal (%g, %g, %g) and the offset %g",
                   normal->x, normal->y, normal->z, offset);
  s->normal = fs_vec3_scale(*normal, 1 / length);
  s->offset = offset / length;
  component = &s->normal.x;
  for (int k = 0; k < 3; k++)
    if (fabs(fabs(component[k]) - 1) < 1e-15) component[(k + 1) % 3] = component[(k + 2) % 3] = 0;
  return FS_OK;
}

static fs_status map_elements(fs_context *ctx, const fs_mesh *mesh, const fs_space *space, const int32_t *halfedge,
                              fs_symmetry *s) {
  fs_status status = FS_OK;
  int32_t *element_of = NULL; /* [n_faces] */
  FS_ALLOC(ctx, element_of, mesh->n_faces);
  for (int32_t f = 0; f < mesh->n_faces; f++) element_of[f] = FS_NONE;
  for (int32_t i = 0; i < space->n_elements; i++) element_of[space->element[i].face] = i;
  for (int32_t i = 0; i < space->n_elements; i++) {
    int32_t h = halfedge[space->element[i].halfedge], face = mesh->face[h], image = element_of[face];
    if (image == FS_NONE) {
      status = fs_fail(ctx, FS_ERR_ARGUMENT, "the mirror image of face %d is face %d, which carries no patch",
                       space->element[i].face, face);
      goto done;
    }
    s->element[i] = image;
    s->side[i] = (uint8_t)((h - space->element[image].halfedge + 4) % 4);
  }
done:
  fs_release(ctx, element_of);
  return status;
}

fs_status fs_symmetry_create(fs_context *ctx, const fs_mesh *mesh, const fs_space *space, const fs_vec3 *normal,
                             double offset, fs_symmetry **symmetry) {
  fs_status status = FS_OK;
  fs_symmetry *s = NULL;
  fs_keyed_vertex *sorted = NULL;
  int32_t *halfedge = NULL, bad;
  FS_ALLOC(ctx, s, 1);
  s->n_vertices = mesh->n_vertices;
  s->n_elements = space->n_elements;
  FS_TRY(set_plane(ctx, mesh, normal, offset, s));
  FS_ALLOC(ctx, s->vertex, mesh->n_vertices);
  FS_ALLOC(ctx, s->element, space->n_elements);
  FS_ALLOC(ctx, s->side, space->n_elements);
  FS_ALLOC(ctx, halfedge, mesh->n_halfedges);
  FS_TRY(fs_sorted_vertices_create(ctx, mesh, &sorted));
  bad = fs_plane_map_vertices(mesh, sorted, s->normal, s->offset, fs_symmetry_tolerance(mesh), s->vertex);
  if (bad != FS_NONE) {
    status = fs_fail(ctx, FS_ERR_ARGUMENT, "the mesh is not symmetric: vertex %d has no mirror image", bad);
    goto done;
  }
  bad = fs_plane_map_halfedges(mesh, s->vertex, halfedge);
  if (bad != FS_NONE) {
    status = fs_fail(ctx, FS_ERR_ARGUMENT, "the mesh is not symmetric: face %d has no mirror image", bad);
    goto done;
  }
  for (int32_t v = 0; v < mesh->n_vertices; v++)
    s->deviation =
        fmax(s->deviation, fs_vec3_distance(fs_symmetry_reflect(s, mesh->position[v]), mesh->position[s->vertex[v]]));
  FS_TRY(map_elements(ctx, mesh, space, halfedge, s));
  *symmetry = s;
  s = NULL;
done:
  fs_release(ctx, sorted);
  fs_release(ctx, halfedge);
  fs_symmetry_free(ctx, s);
  return status;
}

void fs_symmetry_free(fs_context *ctx, fs_symmetry *s) {
  if (s == NULL) return;
  fs_release(ctx, s->vertex);
  fs_release(ctx, s->element);
  fs_release(ctx, s->side);
  fs_release(ctx, s);
}
