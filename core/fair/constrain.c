/* SPDX-License-Identifier: MIT */
/* Single role: base and solved equations become the map from the unknowns y to the free dofs.

   c = c0 + B z, and z is either a free number, one of y, or right - sum of free numbers. Groups of z of which no number is
   free vanish; in others what is not free becomes idle. */
#include "fair/constrain.h"

#include <string.h>

/* What one row of the result needs. */
typedef struct composer {
  const fs_base *base;
  const fs_elimination *elimination;
  const int32_t *group; /* [base columns] of y, or FS_NONE */
  int32_t *place;       /* [columns] 1 + entry of the row, or 0 */
  int32_t n, *column;   /* the row: [columns] */
  double *block, x0[3]; /* [columns][9] */
} composer;

/* Adds the column of a block by which the row depends on number z of the base. */
static void add_number(composer *c, int32_t number, double factor, const double *from) {
  int32_t column = c->group[number / 3], component = number % 3;
  if (c->place[column] == 0) {
    c->column[c->n++] = column;
    c->place[column] = c->n;
    memset(c->block + 9 * (size_t)(c->n - 1), 0, 9 * sizeof *c->block);
  }
  double *to = c->block + 9 * (size_t)(c->place[column] - 1) + component;
  for (int a = 0; a < 3; a++) to[3 * a] += factor * from[3 * a];
}

static void compose(composer *c, int32_t dof) {
  const fs_reduction *map = c->base->map;
  c->n = 0;
  memcpy(c->x0, map->x0 + 3 * (size_t)dof, sizeof c->x0);
  for (int32_t e = map->row_start[dof]; e < map->row_start[dof + 1]; e++)
    for (int b = 0; b < 3; b++) {
      int32_t number = 3 * map->column[e] + b;
      const double *block = map->block + 9 * (size_t)e + b;
      const fs_row *row = c->elimination->solved[number];
      if (map->is_idle[number]) continue;
      if (row == NULL) {
        add_number(c, number, 1, block);
        continue;
      }
      for (int a = 0; a < 3; a++) c->x0[a] += row->right * block[3 * a];
      for (int32_t k = 0; k < row->n; k++) add_number(c, row->column[k], -row->value[k], block);
    }
  for (int32_t k = 0; k < c->n; k++) c->place[c->column[k]] = 0;
}

/* group[base columns]: the groups of z that keep a free number, in their order; returns how many. */
static int32_t number_groups(const fs_base *base, const fs_elimination *elimination, int32_t *group) {
  int32_t n = 0;
  for (int32_t g = 0; g < base->map->n_columns; g++) {
    bool is_free = false;
    for (int b = 0; b < 3; b++) is_free |= !base->map->is_idle[3 * g + b] && elimination->solved[3 * g + b] == NULL;
    group[g] = is_free ? n++ : FS_NONE;
  }
  return n;
}

static fs_status create_map(fs_context *ctx, const fs_base *base, const fs_elimination *elimination,
                            const int32_t *group, int32_t n_rows, int32_t n_columns, fs_reduction **map, double **y) {
  fs_status status = FS_OK;
  FS_ALLOC(ctx, *map, 1);
  (*map)->n_rows = n_rows;
  (*map)->n_columns = n_columns;
  FS_ALLOC(ctx, (*map)->row_start, (size_t)n_rows + 1);
  FS_ALLOC(ctx, (*map)->x0, 3 * (size_t)n_rows);
  FS_ALLOC(ctx, (*map)->is_idle, 3 * (size_t)n_columns);
  FS_ALLOC(ctx, *y, 3 * (size_t)n_columns);
  for (int32_t g = 0; g < base->map->n_columns; g++)
    for (int b = 0; b < 3 && group[g] != FS_NONE; b++) {
      bool is_free = !base->map->is_idle[3 * g + b] && elimination->solved[3 * g + b] == NULL;
      (*map)->is_idle[3 * group[g] + b] = !is_free;
      (*y)[3 * group[g] + b] = is_free ? base->z[3 * g + b] : 0;
    }
done:
  return status;
}

fs_status fs_constrain_reduce(fs_context *ctx, const fs_space *space, const fs_base *base,
                              const fs_elimination *elimination, int32_t n_free, const int32_t *unknown,
                              fs_reduction **reduction, double **start) {
  fs_status status = FS_OK;
  composer c = {.base = base, .elimination = elimination};
  fs_reduction *map = NULL;
  int32_t *group = NULL, n_columns, n_entries = 0;
  double *y = NULL;
  FS_ALLOC(ctx, group, base->map->n_columns);
  n_columns = number_groups(base, elimination, group);
  FS_TRY(create_map(ctx, base, elimination, group, n_free, n_columns, &map, &y));
  c.group = group;
  FS_ALLOC(ctx, c.place, n_columns);
  FS_ALLOC(ctx, c.column, n_columns);
  FS_ALLOC(ctx, c.block, 9 * (size_t)n_columns);
  for (int pass = 0; pass < 2; pass++) { /* counts, then fills; free dofs are numbered in their order */
    for (int32_t d = 0; d < space->n_dofs; d++) {
      int32_t row = unknown[d];
      if (row == FS_NONE) continue;
      compose(&c, d);
      if (c.n > INT32_MAX - n_entries) {
        status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "the constraints couple too many of the %d free points", n_free);
        goto done;
      }
      if (pass == 0) {
        n_entries += c.n;
        map->row_start[row + 1] = n_entries;
        continue;
      }
      memcpy(map->column + map->row_start[row], c.column, (size_t)c.n * sizeof *c.column);
      memcpy(map->block + 9 * (size_t)map->row_start[row], c.block, 9 * (size_t)c.n * sizeof *c.block);
      memcpy(map->x0 + 3 * (size_t)row, c.x0, sizeof c.x0);
    }
    if (pass == 1) break;
    FS_ALLOC(ctx, map->column, n_entries);
    FS_ALLOC(ctx, map->block, 9 * (size_t)n_entries);
  }
  *reduction = map;
  *start = y;
  map = NULL;
  y = NULL;
done:
  fs_release(ctx, group);
  fs_release(ctx, c.place);
  fs_release(ctx, c.column);
  fs_release(ctx, c.block);
  fs_release(ctx, y);
  fs_reduction_free(ctx, map);
  return status;
}
