/* SPDX-License-Identifier: MIT */
/* Polygons kept in triangles by a mark per corner. */
#ifndef FS_MESH_DRACO_POLYGONS_H
#define FS_MESH_DRACO_POLYGONS_H

#include "mesh/draco_bridge.h"
#include "mesh/read.h"

/* Names of attributes and keys of metadata. FS_DRACO_ADDED_EDGES is the one that the tools of the library use: 1 at a
   corner of a triangle whose opposite edge is no edge of the polygon. */
#define FS_DRACO_ADDED_EDGES "added_edges"
#define FS_DRACO_FIXED "fixed"
#define FS_DRACO_MADE_WITH "made_with"
#define FS_DRACO_FUNCTIONAL "functional"
#define FS_DRACO_REFINEMENTS "refinements"

/* Inner coefficients of caps. FS_DRACO_CAP is an attribute of 4 bytes, little-endian: 1 + the number of the cap at the corners
   of its vertex in the face of sector 0, 0 elsewhere: numbers of vertices do not survive. The metadata FS_DRACO_CAPS holds
   int32 basis, caps; for each cap int32 valence, coefficients; then float64 coefficient[…][3]; all little-endian. */
#define FS_DRACO_CAP "cap"
#define FS_DRACO_CAPS "caps"
enum { FS_DRACO_CAP_BYTES = 4 };

/* Decoded triangles: corners [3 n_triangles] as points and as vertices, and is_added for each. */
typedef struct fs_draco_triangles {
  fs_draco_mesh *draco;
  int32_t n_points, n_triangles;
  const int32_t *point, *corner;
  const uint8_t *is_added;
} fs_draco_triangles;

/* NULL where the file has none. */
fs_status fs_draco_read_caps(fs_context *ctx, const fs_draco_triangles *triangles, fs_cap_notes **notes);

/* n_triangles = sum over the faces of their vertices less two; corner[3 n_triangles] vertices, and is_added for each. Every
   face becomes a fan; where a diagonal would join vertices that an edge or a diagonal joins already, another corner is
   tried for its centre. FS_ERR_UNSUPPORTED names a face where each of them would. */
fs_status fs_mesh_split_polygons(fs_context *ctx, const fs_mesh *mesh, int32_t *corner, uint8_t *is_added);

/* The polygons again: face_start and corner of polygons, which has its vertices; the caller clears it. FS_ERR_FORMAT where
   the marks make no polygons. */
fs_status fs_mesh_join_triangles(fs_context *ctx, int32_t n_triangles, const int32_t *corner, const uint8_t *is_added,
                                 fs_polygons *polygons);

#endif
