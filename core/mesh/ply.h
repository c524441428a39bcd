/* SPDX-License-Identifier: MIT */
/* The header of a PLY file: elements, each with a count and properties, in the order of the data. */
#ifndef FS_MESH_PLY_H
#define FS_MESH_PLY_H

#include "mesh/read.h"

typedef enum ply_type {
  PLY_NONE,
  PLY_INT8,
  PLY_UINT8,
  PLY_INT16,
  PLY_UINT16,
  PLY_INT32,
  PLY_UINT32,
  PLY_FLOAT32,
  PLY_FLOAT64
} ply_type;

typedef enum ply_role { PLY_X, PLY_Y, PLY_Z, PLY_CORNERS, PLY_SKIPPED } ply_role;

typedef struct ply_property {
  ply_type count_type; /* of the length of a list; PLY_NONE: one value */
  ply_type type;
  ply_role role;
} ply_property;

typedef enum ply_kind { PLY_VERTEX, PLY_FACE, PLY_OTHER } ply_kind;

typedef struct ply_element {
  ply_kind kind;
  int32_t count, property_start, n_properties;
} ply_element;

typedef struct ply_header {
  bool is_binary;
  int32_t n_elements, n_properties;
  int32_t count[2];       /* of PLY_VERTEX and PLY_FACE */
  ply_element *element;   /* [n_elements] */
  ply_property *property; /* [n_properties] */
} ply_header;

/* Reads up to the end of the line end_header. x, y, z and a list vertex_indices are sure to be there. */
fs_status fs_ply_read_header(fs_text *text, ply_header *header);
void fs_ply_header_clear(fs_context *ctx, ply_header *header); /* all zero is allowed */

#endif
