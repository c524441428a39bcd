/* SPDX-License-Identifier: MIT */
/* Single role: every point written once, found again by the bits of its coordinates in a table with open addressing. */
#include "step.h"
#include "base/base.h"

#include <string.h>

/* Where a point is, or the empty slot where it belongs. */
static struct fs_step_slot *find(const fs_step_points *points, fs_vec3 point) {
  const double coordinate[3] = {point.x, point.y, point.z};
  uint64_t hash = 0;
  for (int32_t k = 0; k < 3; k++) {
    uint64_t bits;
    memcpy(&bits, &coordinate[k], sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15u; /* multiplicative hashing: golden ratio [Knuth, TAOCP 3, 6.4] */
    hash ^= hash >> 32;
  }
  for (size_t k = (size_t)hash & (points->n_slots - 1);; k = (k + 1) & (points->n_slots - 1)) {
    struct fs_step_slot *slot = &points->slot[k];
    if (slot->entity == 0 || memcmp(&slot->point, &point, sizeof point) == 0) return slot;
  }
}

static fs_status grow(fs_context *ctx, fs_step_points *points) {
  fs_step_points larger = {.n = points->n, .n_slots = points->n_slots > 0 ? 2 * points->n_slots : 256};
  fs_status status = FS_OK;
  FS_ALLOC(ctx, larger.slot, larger.n_slots);
  for (size_t k = 0; k < points->n_slots; k++)
    if (points->slot[k].entity != 0) *find(&larger, points->slot[k].point) = points->slot[k];
  fs_release(ctx, points->slot);
  *points = larger;
done:
  return status;
}

fs_status fs_step_point_entity(fs_context *ctx, fs_step_points *points, fs_step_file *step, fs_vec3 point,
                               int64_t *entity) {
  fs_status status = FS_OK;
  struct fs_step_slot *slot;
  point = (fs_vec3){point.x + 0., point.y + 0., point.z + 0.}; /* one zero only */
  if (2 * points->n >= points->n_slots) FS_TRY(grow(ctx, points));
  slot = find(points, point);
  if (slot->entity == 0) {
    int64_t made = fs_step_begin(step, "CARTESIAN_POINT('',(");
    fs_step_real(step, point.x);
    fs_writer_text(&step->writer, ",");
    fs_step_real(step, point.y);
    fs_writer_text(&step->writer, ",");
    fs_step_real(step, point.z);
    fs_writer_text(&step->writer, ")");
    fs_step_end(step);
    *slot = (struct fs_step_slot){point, made};
    points->n++;
  }
  *entity = slot->entity;
done:
  return status;
}

void fs_step_points_clear(fs_context *ctx, fs_step_points *points) {
  fs_release(ctx, points->slot);
  *points = (fs_step_points){0};
}
