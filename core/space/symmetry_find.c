/* SPDX-License-Identifier: MIT */
/* Single role: a plane of symmetry of a mesh.

   Every such plane contains the centre of the vertices. Coordinate planes come first. Then vertices are taken one after
   the other, those whose distance from the centre is rarest first: the image of a vertex has the same distance from the
   centre, so that the plane halves the way to one of those; or the vertex lies on the plane, and so does every vertex
   taken before it. Two of these and the centre determine the plane. */
#include "space/symmetry.h"
#include "math/vec3.h"

#include <stdlib.h>

typedef struct ranked {
  double radius;          /* distance from the centre */
  int32_t vertex, n_like; /* n_like: vertices of the same distance */
} ranked;

typedef struct search {
  const fs_mesh *mesh;
  fs_keyed_vertex *sorted;
  ranked *by_radius, *by_rarity; /* [n_vertices] */
  int32_t *image, *halfedge;
  double tolerance;
  fs_vec3 centre;
} search;

static int compare_radius(const void *a, const void *b) {
  const ranked *x = a, *y = b;
  if (x->radius != y->radius) return x->radius < y->radius ? -1 : 1;
  return (x->vertex > y->vertex) - (x->vertex < y->vertex);
}

static int compare_rarity(const void *a, const void *b) {
  const ranked *x = a, *y = b;
  if (x->n_like != y->n_like) return x->n_like < y->n_like ? -1 : 1;
  return (x->vertex > y->vertex) - (x->vertex < y->vertex);
}

static fs_status search_create(fs_context *ctx, const fs_mesh *mesh, search *s) {
  fs_status status = FS_OK;
  int32_t n = mesh->n_vertices;
  *s = (search){.mesh = mesh, .tolerance = fs_symmetry_tolerance(mesh)};
  FS_ALLOC(ctx, s->by_radius, n);
  FS_ALLOC(ctx, s->by_rarity, n);
  FS_ALLOC(ctx, s->image, n);
  FS_ALLOC(ctx, s->halfedge, mesh->n_halfedges);
  FS_TRY(fs_sorted_vertices_create(ctx, mesh, &s->sorted));
  for (int32_t v = 0; v < n; v++) s->centre = fs_vec3_add_scaled(s->centre, mesh->position[v], 1.0 / n);
  for (int32_t v = 0; v < n; v++) s->by_radius[v] = (ranked){fs_vec3_distance(mesh->position[v], s->centre), v, 0};
  qsort(s->by_radius, (size_t)n, sizeof *s->by_radius, compare_radius);
  for (int32_t i = 0, low = 0, high = 0; i < n; i++) { /* within twice the tolerance on both sides */
    while (s->by_radius[low].radius < s->by_radius[i].radius - 2 * s->tolerance) low++;
    while (high < n && s->by_radius[high].radius <= s->by_radius[i].radius + 2 * s->tolerance) high++;
    s->by_rarity[i] = s->by_radius[i];
    s->by_rarity[i].n_like = high - low;
  }
  qsort(s->by_rarity, (size_t)n, sizeof *s->by_rarity, compare_rarity);
done:
  return status;
}

static void search_free(fs_context *ctx, search *s) {
  fs_release(ctx, s->sorted);
  fs_release(ctx, s->by_radius);
  fs_release(ctx, s->by_rarity);
  fs_release(ctx, s->image);
  fs_release(ctx, s->halfedge);
}

/* A plane within rounding of a coordinate plane becomes exactly that, so that reflections are exact. */
static void snap(const search *s, fs_vec3 *normal, double *offset) {
  double *n = &normal->x, largest = 0;
  int axis = 0;
  for (int k = 0; k < 3; k++)
    if (fabs(n[k]) > largest) largest = fabs(n[k]), axis = k;
  if (1 - largest < 1e-12) {
    *offset *= n[axis] < 0 ? -1 : 1;
    *normal = (fs_vec3){axis == 0, axis == 1, axis == 2};
  }
  if (fabs(*offset) < 1e-3 * s->tolerance) *offset = 0;
}

/* Is this a plane of symmetry? Then it is made exact. */
static bool is_symmetric(search *s, fs_vec3 *normal, double *offset) {
  fs_vec3 exact = *normal;
  double exact_offset = *offset;
  if (fs_plane_map_vertices(s->mesh, s->sorted, *normal, *offset, s->tolerance, s->image) != FS_NONE) return false;
  if (fs_plane_map_halfedges(s->mesh, s->image, s->halfedge) != FS_NONE) return false;
  snap(s, &exact, &exact_offset);
  if (fs_plane_map_vertices(s->mesh, s->sorted, exact, exact_offset, s->tolerance, s->image) == FS_NONE)
    *normal = exact, *offset = exact_offset;
  return true;
}

static bool try_coordinate_planes(search *s, fs_vec3 *normal, double *offset) {
  const double *centre = &s->centre.x;
  for (int through_centre = 0; through_centre < 2; through_centre++)
    for (int axis = 0; axis < 3; axis++) {
      *normal = (fs_vec3){axis == 0, axis == 1, axis == 2};
      *offset = through_centre ? centre[axis] : 0;
      if (is_symmetric(s, normal, offset)) return true;
    }
  return false;
}

/* The plane halfway between a vertex and each vertex of its distance from the centre; on[n_on]: directions from the
   centre that it must contain. */
static bool try_images(search *s, const ranked *of, const fs_vec3 *on, int n_on, fs_vec3 *normal, double *offset) {
  fs_vec3 p = s->mesh->position[of->vertex];
  int32_t low = 0, high = s->mesh->n_vertices;
  while (low < high) {
    int32_t middle = low + (high - low) / 2;
    if (s->by_radius[middle].radius < of->radius - 2 * s->tolerance)
      low = middle + 1;
    else
      high = middle;
  }
  for (; low < s->mesh->n_vertices && s->by_radius[low].radius <= of->radius + 2 * s->tolerance; low++) {
    fs_vec3 q = s->mesh->position[s->by_radius[low].vertex], way = fs_vec3_sub(p, q);
    double length = fs_vec3_length(way);
    bool contains = true;
    if (length <= 4 * s->tolerance) continue;
    *normal = fs_vec3_scale(way, 1 / length);
    *offset = fs_vec3_dot(*normal, fs_vec3_scale(fs_vec3_add(p, q), 0.5));
    for (int k = 0; k < n_on; k++) contains &= fabs(fs_vec3_dot(*normal, on[k])) < 4 * s->tolerance;
    if (contains && is_symmetric(s, normal, offset)) return true;
  }
  return false;
}

static bool try_all_planes(search *s, fs_vec3 *normal, double *offset) {
  fs_vec3 on[2];
  int n_on = 0;
  for (int32_t i = 0; i < s->mesh->n_vertices; i++) {
    const ranked *r = &s->by_rarity[i];
    fs_vec3 way = fs_vec3_sub(s->mesh->position[r->vertex], s->centre);
    if (r->radius <= 1e3 * s->tolerance) continue; /* at the centre it says nothing */
    if (n_on == 1 && fs_vec3_length(fs_vec3_cross(on[0], way)) <= 1e3 * s->tolerance * fs_vec3_length(on[0])) continue;
    if (try_images(s, r, on, n_on, normal, offset)) return true;
    on[n_on++] = way;
    if (n_on == 2) break;
  }
  if (n_on < 2) return false;
  *normal = fs_vec3_cross(on[0], on[1]);
  *normal = fs_vec3_scale(*normal, 1 / fs_vec3_length(*normal));
  *offset = fs_vec3_dot(*normal, s->centre);
  return is_symmetric(s, normal, offset);
}

fs_status fs_symmetry_find(fs_context *ctx, const fs_mesh *mesh, fs_vec3 *normal, double *offset) {
  fs_status status = FS_OK;
  search s;
  FS_TRY(search_create(ctx, mesh, &s));
  if (!try_coordinate_planes(&s, normal, offset) && !try_all_planes(&s, normal, offset))
    status = fs_fail(ctx, FS_ERR_ARGUMENT, "the mesh has no plane of symmetry");
done:
  search_free(ctx, &s);
  return status;
}
