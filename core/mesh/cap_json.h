/* SPDX-License-Identifier: MIT */
/* The file of inner coefficients beside a net whose format has no place for them: NAME.caps.json. */
#ifndef FS_MESH_CAP_JSON_H
#define FS_MESH_CAP_JSON_H

#include "mesh/read.h"

#define FS_CAPS_EXTENSION "caps.json"

/* { "basis": 1, "vertices": V, "faces": F, "checksum": "0123456789abcdef",
     "caps": [ {"vertex": v, "spoke": s, "valence": k, "coefficients": [[x, y, z], …]}, … ] }
   The counts and the checksum tell which net it belongs to. */
typedef struct fs_caps_file {
  int32_t n_vertices, n_faces;
  uint64_t checksum;
  fs_cap_notes *notes;
} fs_caps_file;

/* FS_ERR_FORMAT names the line. The caller frees notes. */
fs_status fs_caps_file_parse(fs_context *ctx, const char *bytes, size_t size, fs_caps_file *file);

/* Of all positions and corners, in bits; zeros of both signs count as one [Fowler Noll Vo, FNV-1a, 64 bits]. */
uint64_t fs_mesh_checksum(const fs_mesh *mesh);

#endif
