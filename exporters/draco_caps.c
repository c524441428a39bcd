/* SPDX-License-Identifier: MIT */
/* Single role: inner coefficients of caps in the forms in which Draco keeps them (mesh/draco_polygons.h). */
#include "draco_caps.h"
#include "base/base.h"
#include "mesh/draco_polygons.h"

#include <string.h>

static fs_status append_int(fs_blob *blob, int32_t number) {
  unsigned char bytes[4];
  for (int k = 0; k < 4; k++) bytes[k] = (unsigned char)((uint32_t)number >> 8 * k);
  return fs_blob_append(blob, bytes, sizeof bytes);
}

static fs_status append_double(fs_blob *blob, double number) {
  unsigned char bytes[8];
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  for (int k = 0; k < 8; k++) bytes[k] = (unsigned char)(bits >> 8 * k);
  return fs_blob_append(blob, bytes, sizeof bytes);
}

fs_status fs_draco_caps_append(const fs_cap_notes *notes, fs_blob *blob) {
  fs_status status = FS_OK;
  FS_TRY(append_int(blob, notes->basis));
  FS_TRY(append_int(blob, notes->n_caps));
  for (int32_t i = 0; i < notes->n_caps; i++) {
    FS_TRY(append_int(blob, notes->cap[i].valence));
    FS_TRY(append_int(blob, notes->cap[i].n));
  }
  for (int32_t i = 0; i < notes->n_caps; i++)
    for (int32_t c = notes->cap[i].first; c < notes->cap[i].first + notes->cap[i].n; c++) {
      FS_TRY(append_double(blob, notes->coefficient[c].x));
      FS_TRY(append_double(blob, notes->coefficient[c].y));
      FS_TRY(append_double(blob, notes->coefficient[c].z));
    }
done:
  return status;
}

void fs_draco_caps_values(int32_t n_caps, uint8_t *bytes) {
  for (int32_t i = 0; i <= n_caps; i++)
    for (int k = 0; k < FS_DRACO_CAP_BYTES; k++) *bytes++ = (uint8_t)((uint32_t)i >> 8 * k);
}

static int32_t find_halfedge(const fs_mesh *mesh, int32_t from, int32_t to) {
  int32_t first, h;
  if (from < 0 || from >= mesh->n_vertices) return FS_NONE;
  first = h = mesh->outgoing[from];
  do {
    if (fs_mesh_target(mesh, h) == to) return h;
    h = fs_mesh_rotate(mesh, h);
  } while (h != first && h != FS_NONE);
  return FS_NONE;
}

fs_status fs_draco_caps_spokes(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes,
                               int32_t *cap_of_halfedge) {
  for (int32_t i = 0; i < notes->n_caps; i++) {
    int32_t h = find_halfedge(mesh, notes->cap[i].vertex, notes->cap[i].spoke);
    if (h == FS_NONE)
      return fs_fail(ctx, FS_ERR_ARGUMENT,
                     "the sectors of the cap at vertex %d begin at vertex %d, to which no edge leads",
                     notes->cap[i].vertex, notes->cap[i].spoke);
    cap_of_halfedge[h] = i + 1;
  }
  return FS_OK;
}
