/* SPDX-License-Identifier: MIT */
/* What the tests of Draco files share: exporting to memory, the allowed error, and points found by their places, since the
   format renumbers them. */
#ifndef FS_TEST_DRACO_SAMPLES_H
#define FS_TEST_DRACO_SAMPLES_H

#include "memory_output.h"
#include "../support/support.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>

/* bits: of the parameter of that name, unless it is NULL. */
static inline memory_output draco_export(fs_context *ctx, const fs_model *model, const char *extension,
                                         const char *name, double bits) {
  const fs_exporter *exporter = fs_exporter_find(extension);
  memory_output file = {0};
  fs_output output = memory_output_of(&file);
  double param[32] = {0};
  assert_non_null(exporter);
  for (int k = 0; exporter->params[k].name != NULL; k++) param[k] = exporter->params[k].initial;
  if (name != NULL) memory_output_set(exporter, param, name, bits);
  if (fs_export(ctx, model, exporter, param, &output) != FS_OK) fail_msg("%s: %s", extension, ctx->message);
  return file;
}

static inline double draco_coordinate(fs_vec3 p, int c) { return c == 0 ? p.x : c == 1 ? p.y : p.z; }

static inline double draco_distance(fs_vec3 a, fs_vec3 b) {
  return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

/* 0.87 steps of the grid (half a step in all three directions) and 2 units in the last place of the largest coordinate. */
static inline double draco_tolerance(int32_t n, const fs_vec3 *p, int bits) {
  double size = 0, largest = 0;
  for (int c = 0; c < 3; c++) {
    double min = INFINITY, max = -INFINITY;
    for (int32_t i = 0; i < n; i++) {
      double x = draco_coordinate(p[i], c);
      min = fmin(min, x), max = fmax(max, x);
    }
    size = fmax(size, max - min);
    largest = fmax(largest, fmax(fabs(min), fabs(max)));
  }
  double ulp = (double)nextafterf((float)largest, INFINITY) - (double)(float)largest;
  return (bits > 0 ? 0.87 * size / (pow(2, bits) - 1) : 0) + 2 * ulp;
}

/* Points in cells of the given size. */
typedef struct draco_cells {
  int32_t n;
  const fs_vec3 *point;
  double cell;
  int32_t *first, *next;
} draco_cells;

static inline size_t draco_cell(const draco_cells *cells, const int64_t k[3]) {
  uint64_t h = (uint64_t)k[0] * 73856093u ^ (uint64_t)k[1] * 19349663u ^ (uint64_t)k[2] * 83492791u;
  return (size_t)(h % (uint64_t)cells->n);
}

static inline draco_cells draco_cells_of(int32_t n, const fs_vec3 *point, double tolerance) {
  draco_cells cells = {.n = n, .point = point, .cell = tolerance};
  cells.first = malloc((size_t)n * sizeof(int32_t));
  cells.next = malloc((size_t)n * sizeof(int32_t));
  for (int32_t i = 0; i < n; i++) cells.first[i] = FS_NONE;
  for (int32_t i = 0; i < n; i++) {
    int64_t k[3];
    for (int c = 0; c < 3; c++) k[c] = (int64_t)floor(draco_coordinate(point[i], c) / cells.cell);
    size_t at = draco_cell(&cells, k);
    cells.next[i] = cells.first[at];
    cells.first[at] = i;
  }
  return cells;
}

static inline void draco_cells_free(draco_cells *cells) {
  free(cells->first);
  free(cells->next);
}

/* The nearest point within the size of a cell, or FS_NONE. */
static inline int32_t draco_find_point(const draco_cells *cells, fs_vec3 p) {
  double best = cells->cell;
  int32_t found = FS_NONE;
  for (int i = -1; i <= 1; i++)
    for (int j = -1; j <= 1; j++)
      for (int l = -1; l <= 1; l++) {
        const int64_t k[3] = {(int64_t)floor(p.x / cells->cell) + i, (int64_t)floor(p.y / cells->cell) + j,
                              (int64_t)floor(p.z / cells->cell) + l};
        for (int32_t v = cells->first[draco_cell(cells, k)]; v != FS_NONE; v = cells->next[v]) {
          double distance = draco_distance(cells->point[v], p);
          if (distance <= best) best = distance, found = v;
        }
      }
  return found;
}

#endif
