/* SPDX-License-Identifier: MIT */
/* Single role: all dofs by fewer numbers z, under symmetry and with some dofs fixed.

     free vertex, no symmetry              c = z
     vertex and its image                  c = z,  image = R z + 2 offset n      R = 1 - 2 n n^T
     vertex on the plane                   c = offset n + z_0 t_0 + z_1 t_1      z_2 idle
     fixed vertex, or image of one         constant */
#include "fair/constrain.h"
#include "math/vec3.h"
#include "space/symmetry.h"

#include <string.h>

static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

void fs_tangents(fs_vec3 n, fs_vec3 t[2]) {
  fs_vec3 axis = {0, 0, 0};
  double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
  /* the axis after the largest component: the tangents of an axis are axes */
  *(x >= y && x >= z ? &axis.y : y >= z ? &axis.z : &axis.x) = 1;
  t[0] = fs_vec3_add_scaled(axis, n, -fs_vec3_dot(axis, n));
  t[0] = fs_vec3_scale(t[0], 1 / fs_vec3_length(t[0]));
  t[1] = fs_vec3_cross(n, t[0]);
}

fs_status fs_map_add(fs_map_builder *b, int32_t column, const double block[9]) {
  fs_status status = FS_OK;
  fs_reduction *map = b->base->map;
  int32_t n = map->row_start[b->row + 1], *columns = NULL, capacity = 2 * b->capacity + 64;
  double *blocks = NULL;
  if (n == b->capacity) {
    FS_ALLOC(b->ctx, columns, capacity);
    FS_ALLOC(b->ctx, blocks, 9 * (size_t)capacity);
    if (n > 0) {
      memcpy(columns, map->column, (size_t)n * sizeof *columns);
      memcpy(blocks, map->block, 9 * (size_t)n * sizeof *blocks);
    }
    fs_release(b->ctx, map->column);
    fs_release(b->ctx, map->block);
    map->column = columns;
    map->block = blocks;
    columns = NULL;
    blocks = NULL;
    b->capacity = capacity;
  }
  map->column[n] = column;
  memcpy(map->block + 9 * (size_t)n, block, 9 * sizeof *block);
  map->row_start[b->row + 1]++;
done:
  fs_release(b->ctx, columns);
  fs_release(b->ctx, blocks);
  return status;
}

void fs_map_end_row(fs_map_builder *b) {
  fs_reduction *map = b->base->map;
  b->row++;
  if (b->row < map->n_rows) map->row_start[b->row + 1] = map->row_start[b->row];
}

/* ---- vertices ---------------------------------------------------------------------------------------------------- */

static void set_constant(fs_base *base, int32_t dof) {
  memcpy(base->map->x0 + 3 * (size_t)dof, &base->c[dof], sizeof base->c[dof]);
}

/* A new group of z, with its value at the start. */
static int32_t new_column(fs_base *base, fs_vec3 z) {
  int32_t column = base->map->n_columns++;
  memcpy(base->z + 3 * (size_t)column, &z, sizeof z);
  return column;
}

static fs_status add_on_plane(fs_map_builder *b, const fs_symmetry *s, int32_t dof) {
  fs_base *base = b->base;
  fs_vec3 t[2], c = base->c[dof], x0 = fs_vec3_scale(s->normal, s->offset);
  fs_tangents(s->normal, t);
  const double block[9] = {t[0].x, t[1].x, 0, t[0].y, t[1].y, 0, t[0].z, t[1].z, 0};
  int32_t column = new_column(base, (fs_vec3){fs_vec3_dot(t[0], c), fs_vec3_dot(t[1], c), 0});
  memcpy(base->map->x0 + 3 * (size_t)dof, &x0, sizeof x0);
  base->map->is_idle[3 * (size_t)column + 2] = true;
  return fs_map_add(b, column, block);
}

static fs_status add_image(fs_map_builder *b, const fs_symmetry *s, int32_t dof, int32_t column) {
  fs_vec3 n = s->normal, x0 = fs_vec3_scale(n, 2 * s->offset);
  const double block[9] = {1 - 2 * n.x * n.x, -2 * n.x * n.y, -2 * n.x * n.z, -2 * n.y * n.x,   1 - 2 * n.y * n.y,
                           -2 * n.y * n.z,    -2 * n.z * n.x, -2 * n.z * n.y, 1 - 2 * n.z * n.z};
  memcpy(b->base->map->x0 + 3 * (size_t)dof, &x0, sizeof x0);
  return fs_map_add(b, column, block);
}

static fs_status add_vertices(fs_map_builder *b, const fs_space *space, const bool *used, const fs_symmetry *s) {
  fs_status status = FS_OK;
  fs_base *base = b->base;
  int32_t *column_of = NULL; /* [n_vertices] */
  FS_ALLOC(b->ctx, column_of, space->n_vertices);
  for (int32_t v = 0; v < space->n_vertices; v++) {
    int32_t image = s != NULL ? s->vertex[v] : FS_NONE;
    if (!used[v] || base->is_constant[v]) {
      set_constant(base, v);
    } else if (image == v) {
      FS_TRY(add_on_plane(b, s, v));
    } else if (image != FS_NONE && !fs_symmetry_is_first(s, v)) {
      FS_TRY(add_image(b, s, v, column_of[image]));
    } else {
      column_of[v] = new_column(base, base->c[v]);
      FS_TRY(fs_map_add(b, column_of[v], unit));
    }
    fs_map_end_row(b);
  }
done:
  fs_release(b->ctx, column_of);
  return status;
}

static fs_status add_plain_offsets(fs_map_builder *b, const fs_space *space) {
  fs_status status = FS_OK;
  for (int32_t d = space->n_vertices; d < space->n_dofs; d++) {
    if (b->base->is_constant[d])
      set_constant(b->base, d);
    else
      FS_TRY(fs_map_add(b, new_column(b->base, b->base->c[d]), unit));
    fs_map_end_row(b);
  }
done:
  return status;
}

/* ---- the base ---------------------------------------------------------------------------------------------------- */

static double measure(const fs_space *space, const fs_vec3 *c) {
  fs_vec3 low = c[0], high = c[0];
  for (int32_t v = 1; v < space->n_vertices; v++) {
    low = fs_vec3_min(low, c[v]);
    high = fs_vec3_max(high, c[v]);
  }
  return fs_vec3_distance(low, high);
}

fs_status fs_base_create(fs_context *ctx, const fs_space *space, const bool *fixed, const fs_symmetry *s,
                         const fs_vec3 *c, fs_base *base) {
  fs_status status = FS_OK;
  size_t n = (size_t)space->n_dofs;
  fs_map_builder builder = {.ctx = ctx, .base = base};
  bool *used = NULL; /* a dof that no element sees stays */
  *base = (fs_base){.size = measure(space, c)};
  if (s != NULL && (s->n_vertices != space->n_vertices || s->n_elements != space->n_elements))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a symmetry of %d vertices does not fit a space of %d", s->n_vertices,
                   space->n_vertices);
  FS_ALLOC(ctx, used, n);
  FS_ALLOC(ctx, base->c, n);
  FS_ALLOC(ctx, base->is_constant, n);
  FS_ALLOC(ctx, base->z, 3 * n);
  FS_ALLOC(ctx, base->map, 1);
  base->map->n_rows = space->n_dofs;
  FS_ALLOC(ctx, base->map->row_start, n + 1);
  FS_ALLOC(ctx, base->map->x0, 3 * n);
  FS_ALLOC(ctx, base->map->is_idle, 3 * n);
  memcpy(base->c, c, n * sizeof *c);
  if (s != NULL) fs_symmetry_apply(s, base->c);
  for (int64_t i = 0; i < space->n_element_dofs; i++) used[space->dof[i]] = true;
  for (int32_t d = 0; d < space->n_dofs; d++)
    base->is_constant[d] = fixed != NULL && (fixed[d] || (s != NULL && d < space->n_vertices && fixed[s->vertex[d]]));
  FS_TRY(add_vertices(&builder, space, used, s));
  if (s == NULL)
    FS_TRY(add_plain_offsets(&builder, space));
  else
    FS_TRY(fs_base_add_caps(&builder, space, fixed, s));
done:
  fs_release(ctx, used);
  return status;
}

void fs_base_free(fs_context *ctx, fs_base *base) {
  fs_release(ctx, base->c);
  fs_release(ctx, base->is_constant);
  fs_release(ctx, base->z);
  fs_reduction_free(ctx, base->map);
  *base = (fs_base){0};
}
