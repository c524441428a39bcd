/* SPDX-License-Identifier: MIT */
/* Single role: the inner coefficients of caps in Draco files (mesh/draco_polygons.h). Sizes are held against the bytes that
   are there before memory is asked for; whether the coefficients fit the mesh is for the space to say. */
#include "mesh/draco_polygons.h"

#include <math.h>
#include <string.h>

/* Little-endian numbers one after the other; the caller knows that they are there. */
typedef struct numbers {
  const unsigned char *at;
  size_t rest;
} numbers;

static uint64_t take(numbers *from, int size) {
  uint64_t bits = 0;
  for (int k = size - 1; k >= 0; k--) bits = bits << 8 | from->at[k];
  from->at += size;
  from->rest -= (size_t)size;
  return bits;
}

static int32_t take_int(numbers *from) { return (int32_t)(uint32_t)take(from, 4); }

static double take_double(numbers *from) {
  uint64_t bits = take(from, 8);
  double number;
  memcpy(&number, &bits, sizeof number);
  return number;
}

static fs_status fail_size(fs_context *ctx) {
  return fs_fail(ctx, FS_ERR_FORMAT,
                 "the Draco file is damaged: its inner coefficients of caps are not as many as it says");
}

/* The numbers of all caps, then all coefficients. */
static fs_status take_caps(fs_context *ctx, numbers from, fs_cap_notes **result) {
  fs_status status = FS_OK;
  fs_cap_notes *notes = NULL;
  int32_t basis, n_caps;
  int64_t n = 0;
  if (from.rest < 8) return fail_size(ctx);
  basis = take_int(&from);
  n_caps = take_int(&from);
  if (n_caps < 0 || (size_t)n_caps > from.rest / 8) return fail_size(ctx);
  for (int32_t i = 0; i < n_caps; i++) {
    numbers one = {from.at + 8 * (size_t)i + 4, 4};
    int32_t n_here = take_int(&one);
    if (n_here < 0) return fail_size(ctx);
    n += n_here;
  }
  if (n > INT32_MAX || 8 * (size_t)n_caps + 24 * (size_t)n != from.rest) return fail_size(ctx);
  FS_TRY(fs_cap_notes_create(ctx, n_caps, (int32_t)n, &notes));
  notes->basis = basis;
  n = 0;
  for (int32_t i = 0; i < n_caps; i++) {
    fs_cap_note *cap = &notes->cap[i];
    *cap = (fs_cap_note){.vertex = FS_NONE, .spoke = FS_NONE, .first = (int32_t)n};
    cap->valence = take_int(&from);
    cap->n = take_int(&from);
    n += cap->n;
  }
  for (int32_t i = 0; i < (int32_t)n; i++) {
    fs_vec3 *c = &notes->coefficient[i];
    c->x = take_double(&from);
    c->y = take_double(&from);
    c->z = take_double(&from);
  }
  *result = notes;
done:
  return status;
}

/* cap_of_point[n_points]: 1 + the number of a cap, or 0; NULL where the file has no such attribute. */
static fs_status read_numbers(fs_context *ctx, const fs_draco_triangles *t, double **cap_of_point) {
  fs_status status = FS_OK;
  int32_t attribute = fs_draco_find(t->draco, FS_DRACO_GENERIC, FS_DRACO_CAP), *value = NULL;
  float *bytes = NULL;
  double *number = NULL;
  if (attribute == FS_NONE || fs_draco_n_components(t->draco, attribute) != FS_DRACO_CAP_BYTES) return FS_OK;
  FS_ALLOC(ctx, value, t->n_points);
  FS_ALLOC(ctx, bytes, FS_DRACO_CAP_BYTES * (size_t)fs_draco_n_values(t->draco, attribute));
  FS_ALLOC(ctx, number, t->n_points);
  fs_draco_values_of_points(t->draco, attribute, value);
  fs_draco_values(t->draco, attribute, bytes);
  for (int32_t p = 0; p < t->n_points; p++)
    for (int k = FS_DRACO_CAP_BYTES - 1; k >= 0; k--)
      number[p] = 256 * number[p] + (double)bytes[FS_DRACO_CAP_BYTES * (size_t)value[p] + (size_t)k];
  *cap_of_point = number;
  number = NULL;
done:
  fs_release(ctx, value);
  fs_release(ctx, bytes);
  fs_release(ctx, number);
  return status;
}

/* In the face of sector 0 the spoke is the edge of the polygon that leaves the marked corner: of all triangles there one
   has it as its own edge. */
static fs_status find_spokes(fs_context *ctx, const fs_draco_triangles *t, const double *cap_of_point,
                             fs_cap_notes *notes) {
  for (int32_t h = 0; h < 3 * t->n_triangles; h++) {
    double number = cap_of_point != NULL ? cap_of_point[t->point[h]] : 0;
    int32_t next = h % 3 == 2 ? h - 2 : h + 1, previous = h % 3 == 0 ? h + 2 : h - 1;
    fs_cap_note *cap;
    if (number == 0 || t->is_added[previous]) continue;
    if (!(number >= 1 && number <= notes->n_caps))
      return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file is damaged: a corner is marked for cap %.10g of %d", number,
                     notes->n_caps);
    cap = &notes->cap[(int32_t)number - 1];
    if (cap->vertex != FS_NONE)
      return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file is damaged: cap %d of %d is there twice", (int32_t)number,
                     notes->n_caps);
    cap->vertex = t->corner[h];
    cap->spoke = t->corner[next];
  }
  for (int32_t i = 0; i < notes->n_caps; i++)
    if (notes->cap[i].vertex == FS_NONE)
      return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file is damaged: no corner is marked for cap %d of %d", i + 1,
                     notes->n_caps);
  return FS_OK;
}

fs_status fs_draco_read_caps(fs_context *ctx, const fs_draco_triangles *t, fs_cap_notes **result) {
  fs_status status = FS_OK;
  fs_cap_notes *notes = NULL;
  double *cap_of_point = NULL;
  size_t size = 0;
  const char *bytes = fs_draco_entry_find(t->draco, FS_DRACO_CAPS, &size);
  if (bytes == NULL) {
    *result = NULL;
    return FS_OK;
  }
  FS_TRY(take_caps(ctx, (numbers){(const unsigned char *)bytes, size}, &notes));
  FS_TRY(read_numbers(ctx, t, &cap_of_point));
  FS_TRY(find_spokes(ctx, t, cap_of_point, notes));
  *result = notes;
  notes = NULL;
done:
  fs_release(ctx, cap_of_point);
  fs_cap_notes_free(ctx, notes);
  return status;
}
