/* SPDX-License-Identifier: MIT */
/* The Gregory construction: a mesh and its normals become a surface of one patch per face with one tangent plane. */
#include "construct/construct.h"
#include "construct/gregory.h"
#include "math/vec3.h"

#include <stdio.h>

/* ---- normals ---- */

/* made[n_vertices]: those given, of length 1 to rounding, or those of the mesh. */
static fs_status make_normals(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *given, fs_vec3 *made) {
  if (given == NULL) return fs_vertex_normals(ctx, mesh, made);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    double length = fs_vec3_length(given[v]);
    if (!(fabs(length - 1) <= 1e-3))
      return fs_fail(ctx, FS_ERR_NUMERIC, "the normal of vertex %d has length %g, not 1", (int)v, length);
    made[v] = fs_vec3_scale(given[v], 1 / length);
  }
  return FS_OK;
}

/* ---- patches ---- */

typedef struct builder {
  const fs_mesh *mesh; /* of triangles and quads */
  const fs_vec3 *normal;
  fs_edge_rule rule;
  fs_surface *surface;
  uint8_t *fault, *side; /* [n_faces] */
} builder;

/* One patch per face, without its points. face: of the user's mesh, or NULL: the same. */
static void lay_out(const builder *b, const int32_t *face) {
  size_t start = 0;
  for (int32_t f = 0; f < b->mesh->n_faces; f++) {
    int32_t first = b->mesh->face_start[f], n = fs_mesh_face_size(b->mesh, f) == 3 ? 3 : 4;
    fs_patch *patch = &b->surface->patch[f];
    *patch = (fs_patch){.kind = n == 3 ? FS_PATCH_GREGORY_TRIANGLE : FS_PATCH_GREGORY_QUAD,
                        .n_sides = n,
                        .degree_u = n == 3 ? 4 : 3,
                        .degree_v = n == 3 ? 4 : 3,
                        .data_start = start,
                        .face = face != NULL ? face[f] : f,
                        .valence = 4,
                        .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
    for (int32_t s = 0; s < n; s++) {
      int32_t twin = b->mesh->twin[first + s];
      if (twin == FS_NONE) continue;
      patch->neighbour[s] = b->mesh->face[twin];
      patch->neighbour_side[s] = (uint8_t)(twin - b->mesh->face_start[b->mesh->face[twin]]);
    }
    start += fs_patch_kinds[patch->kind].n_numbers(patch);
  }
}

static fs_status fill(void *user, int32_t begin, int32_t end, int32_t worker) {
  const builder *b = user;
  (void)worker;
  for (int32_t f = begin; f < end; f++) {
    const fs_patch *patch = &b->surface->patch[f];
    const int32_t *vertex = b->mesh->origin + b->mesh->face_start[f];
    fs_vec3 corner[4], normal[4], point[20];
    int32_t side = 0, n = patch->n_sides;
    for (int32_t k = 0; k < n; k++) corner[k] = b->mesh->position[vertex[k]], normal[k] = b->normal[vertex[k]];
    b->fault[f] = (uint8_t)(n == 3 ? fs_gregory_triangle(corner, normal, vertex, b->rule, point, &side)
                                   : fs_gregory_quad(corner, normal, vertex, b->rule, point, &side));
    b->side[f] = (uint8_t)side;
    if (b->fault[f] != FS_GREGORY_FINE) continue;
    double *to = b->surface->data + patch->data_start;
    for (int32_t k = 0; k < (n == 3 ? 18 : 20); k++)
      to[3 * k] = point[k].x, to[3 * k + 1] = point[k].y, to[3 * k + 2] = point[k].z;
  }
  return FS_OK;
}

/* ---- what went wrong ---- */

enum { NAME_SIZE = 40 };

/* "vertex 7"; vertices from n_vertices on are middles of faces. */
static void name_vertex(int32_t v, int32_t n_vertices, char *name) {
  if (v < n_vertices)
    snprintf(name, NAME_SIZE, "vertex %d", (int)v);
  else
    snprintf(name, NAME_SIZE, "the middle");
}

static fs_status report(fs_context *ctx, const builder *b, int32_t n_vertices) {
  for (int32_t f = 0; f < b->mesh->n_faces; f++) {
    if (b->fault[f] == FS_GREGORY_FINE) continue;
    int32_t h = b->mesh->face_start[f] + b->side[f], face = b->surface->patch[f].face;
    char from[NAME_SIZE], to[NAME_SIZE];
    name_vertex(b->mesh->origin[h], n_vertices, from);
    name_vertex(fs_mesh_target(b->mesh, h), n_vertices, to);
    switch ((fs_gregory_fault)b->fault[f]) {
    case FS_GREGORY_NO_LENGTH:
      return fs_fail(ctx, FS_ERR_NUMERIC, "face %d: the edge from %s to %s has no length", (int)face, from, to);
    case FS_GREGORY_ALONG_NORMAL:
      return fs_fail(ctx, FS_ERR_NUMERIC, "face %d: the edge from %s to %s runs along the normal of one of them",
                     (int)face, from, to);
    case FS_GREGORY_REFLEX_START:
      return fs_fail(ctx, FS_ERR_NUMERIC, "face %d: the corner at %s is reflex or has no angle", (int)face, from);
    case FS_GREGORY_REFLEX_END:
      return fs_fail(ctx, FS_ERR_NUMERIC, "face %d: the corner at %s is reflex or has no angle", (int)face, to);
    default:
      return fs_fail(ctx, FS_ERR_NUMERIC, "face %d: the tangent plane turns over along the edge from %s to %s",
                     (int)face, from, to);
    }
  }
  return FS_OK;
}

/* ---- the construction ---- */

fs_status fs_gregory_create(fs_context *ctx, const fs_mesh *mesh, const fs_vec3 *normal, fs_edge_rule rule,
                            fs_surface **surface) {
  fs_status status = FS_OK;
  fs_mesh *split = NULL;
  fs_vec3 *normals = NULL, *split_normals = NULL;
  int32_t *face = NULL;
  builder b = {.rule = rule};
  if (rule < FS_EDGE_ARC || rule > FS_EDGE_WM)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "there is no edge rule number %d", (int)rule);
  FS_ALLOC(ctx, normals, mesh->n_vertices);
  FS_TRY(make_normals(ctx, mesh, normal, normals));
  FS_TRY(fs_gregory_split(ctx, mesh, normals, &split, &split_normals, &face));
  b.mesh = split != NULL ? split : mesh;
  b.normal = split != NULL ? split_normals : normals;
  FS_ALLOC(ctx, b.fault, b.mesh->n_faces);
  FS_ALLOC(ctx, b.side, b.mesh->n_faces);
  FS_ALLOC(ctx, b.surface, 1);
  FS_ALLOC(ctx, b.surface->patch, b.mesh->n_faces);
  b.surface->n_patches = b.mesh->n_faces;
  for (int32_t f = 0; f < b.mesh->n_faces; f++) b.surface->n_data += fs_mesh_face_size(b.mesh, f) == 3 ? 54 : 60;
  FS_ALLOC(ctx, b.surface->data, b.surface->n_data);
  lay_out(&b, face);
  FS_TRY(fs_progress(ctx, "construct", 0));
  FS_TRY(fs_parallel_for(ctx, b.mesh->n_faces, fill, &b));
  FS_TRY(report(ctx, &b, mesh->n_vertices));
  FS_TRY(fs_progress(ctx, "construct", 1));
  *surface = b.surface;
  b.surface = NULL;
done:
  fs_surface_free(ctx, b.surface);
  fs_release(ctx, b.fault);
  fs_release(ctx, b.side);
  fs_release(ctx, face);
  fs_release(ctx, split_normals);
  fs_mesh_free(ctx, split);
  fs_release(ctx, normals);
  return status;
}

/* ---- the line of the table ---- */

static fs_status build(fs_context *ctx, const fs_construction_input *input, const double *param, fs_surface **surface) {
  return fs_gregory_create(ctx, input->mesh, input->normal, (fs_edge_rule)param[0], surface);
}

static const char *const rules[] = {"arc", "pn", "wm", NULL};
static const fs_param params[] = {{"edge-rule", "rule for the cubics over edges", FS_EDGE_ARC, 0, 2, rules}, {0}};

const fs_construction fs_construction_gregory = {
    "gregory", "G1 surface through vertices and normals of a mesh, a patch per triangle or quad", FS_TAKES_MESH, params,
    build,
};
