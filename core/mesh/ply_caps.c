/* SPDX-License-Identifier: MIT */
/* Single role: the inner coefficients of caps in PLY files. Whether they fit the mesh is for the space to say. */
#include "mesh/ply.h"

#include <math.h>
#include <string.h>

fs_status fs_ply_allocate_caps(ply_file *p, int32_t n_caps) {
  fs_status status = FS_OK;
  FS_ALLOC(p->text->ctx, p->cap, n_caps);
done:
  return status;
}

static fs_status read_number(ply_file *p, const ply_property *property, int32_t cap, int32_t *number) {
  double value = 0;
  fs_status status = fs_ply_value(p, property->type, &value);
  if (status != FS_OK) return status;
  if (!(fabs(value) <= INT32_MAX) || value != floor(value))
    return fs_ply_fail(p, "%.10g of cap %d is no whole number of 32 bits", value, cap);
  *number = (int32_t)value;
  return FS_OK;
}

/* Room for n more; that many are in the file, so it stays within a small multiple of its size. */
static fs_status make_room(ply_file *p, int32_t n) {
  fs_status status = FS_OK;
  fs_vec3 *grown = NULL;
  int64_t room = 2 * (int64_t)p->room + n;
  if (n <= p->room - p->n_coefficients) return FS_OK;
  if (room > INT32_MAX) return fs_ply_fail(p, "the caps have more inner coefficients than 32 bits can number");
  FS_ALLOC(p->text->ctx, grown, room);
  if (p->n_coefficients > 0) memcpy(grown, p->coefficient, (size_t)p->n_coefficients * sizeof *grown);
  fs_release(p->text->ctx, p->coefficient);
  p->coefficient = grown;
  p->room = (int32_t)room;
done:
  return status;
}

static fs_status read_coefficients(ply_file *p, const ply_property *property, int32_t number) {
  fs_status status = FS_OK;
  int32_t n = 0;
  FS_TRY(fs_ply_length(p, property, &n));
  if (n % 3 != 0) return fs_ply_fail(p, "cap %d has %d numbers, but its coefficients take three each", number, n);
  FS_TRY(make_room(p, n / 3));
  p->cap[number].first = p->n_coefficients;
  p->cap[number].n = n / 3;
  for (int32_t i = 0; i < n; i += 3) {
    double x[3] = {0};
    for (int k = 0; k < 3; k++) FS_TRY(fs_ply_value(p, property->type, &x[k]));
    if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2]))
      return fs_ply_fail(p, "inner coefficient %d of cap %d is not finite", i / 3, number);
    p->coefficient[p->n_coefficients++] = (fs_vec3){x[0], x[1], x[2]};
  }
done:
  return status;
}

fs_status fs_ply_read_cap(ply_file *p, const ply_property *property, int32_t number) {
  int32_t basis = p->basis;
  fs_status status;
  switch (property->role) {
  case PLY_CAP_VERTEX:
    return read_number(p, property, number, &p->cap[number].vertex);
  case PLY_CAP_SPOKE:
    return read_number(p, property, number, &p->cap[number].spoke);
  case PLY_CAP_VALENCE:
    return read_number(p, property, number, &p->cap[number].valence);
  case PLY_CAP_BASIS:
    status = read_number(p, property, number, &p->basis);
    if (status == FS_OK && number > 0 && p->basis != basis)
      return fs_ply_fail(p, "cap %d belongs to version %d of the functions, those before to %d", number, p->basis,
                         basis);
    return status;
  default:
    return read_coefficients(p, property, number);
  }
}

fs_status fs_ply_take_caps(const ply_file *p, fs_cap_notes **notes) {
  fs_status status = FS_OK;
  fs_cap_notes *caps = NULL;
  int32_t n_caps = p->header.count[PLY_CAP];
  if (n_caps > 0) {
    FS_TRY(fs_cap_notes_create(p->text->ctx, n_caps, p->n_coefficients, &caps));
    caps->basis = p->basis;
    memcpy(caps->cap, p->cap, (size_t)n_caps * sizeof *p->cap);
    if (p->n_coefficients > 0)
      memcpy(caps->coefficient, p->coefficient, (size_t)p->n_coefficients * sizeof *p->coefficient);
  }
  *notes = caps;
done:
  return status;
}
