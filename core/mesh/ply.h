/* SPDX-License-Identifier: MIT */
/* A PLY file: its header, elements with a count and properties in the order of the data, and the values behind it. */
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

typedef enum ply_role {
  PLY_X,
  PLY_Y,
  PLY_Z,
  PLY_CORNERS,
  PLY_CAP_VERTEX,
  PLY_CAP_SPOKE,
  PLY_CAP_VALENCE,
  PLY_CAP_BASIS,
  PLY_CAP_COEFFICIENTS,
  PLY_SKIPPED
} ply_role;

typedef struct ply_property {
  ply_type count_type; /* of the length of a list; PLY_NONE: one value */
  ply_type type;
  ply_role role;
} ply_property;

typedef enum ply_kind { PLY_VERTEX, PLY_FACE, PLY_CAP, PLY_OTHER } ply_kind;

/* The element of inner coefficients, one per cap: int vertex, spoke, valence, basis and a list of doubles coefficients,
   three each. */
#define FS_PLY_CAP "fairsurf_cap"

typedef struct ply_element {
  ply_kind kind;
  int32_t count, property_start, n_properties;
} ply_element;

typedef struct ply_header {
  bool is_binary;
  int32_t n_elements, n_properties;
  int32_t count[PLY_OTHER]; /* of PLY_VERTEX, PLY_FACE, PLY_CAP */
  ply_element *element;     /* [n_elements] */
  ply_property *property;   /* [n_properties] */
} ply_header;

/* Reads up to the end of the line end_header. x, y, z and a list vertex_indices are sure to be there, and where there are
   caps, all that they need. */
fs_status fs_ply_read_header(fs_text *text, ply_header *header);
void fs_ply_header_clear(fs_context *ctx, ply_header *header); /* all zero is allowed */

/* What is read, on its way to a mesh. */
typedef struct ply_file {
  fs_text *text;
  const char *begin; /* of the file, for byte offsets */
  ply_header header;
  fs_polygons polygons;
  fs_cap_note *cap;     /* [count of PLY_CAP] or NULL */
  fs_vec3 *coefficient; /* grows */
  int32_t n_coefficients, room, basis;
} ply_file;

/* FS_ERR_FORMAT and "line 12: …" or "byte 345: …"; of the item being read. */
fs_status fs_ply_fail(ply_file *p, const char *format, ...) FS_PRINTF(2, 3);
fs_status fs_ply_value(ply_file *p, ply_type type, double *value);
/* Length of a list, which the rest of the file has room for. */
fs_status fs_ply_length(ply_file *p, const ply_property *property, int32_t *n);

/* Makes room for all caps; reads one property of a cap; hands over what was read, NULL where there are no caps. */
fs_status fs_ply_allocate_caps(ply_file *p, int32_t n_caps);
fs_status fs_ply_read_cap(ply_file *p, const ply_property *property, int32_t number);
fs_status fs_ply_take_caps(const ply_file *p, fs_cap_notes **notes);

#endif
