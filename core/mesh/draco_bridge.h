/* SPDX-License-Identifier: MIT */
/* The Draco library behind functions of C: triangles with attributes to bytes and back. Nothing of C++ is seen here, and
   no exception leaves it. Arrays are the caller's; the library keeps its own memory to itself, outside the context. */
#ifndef FS_MESH_DRACO_BRIDGE_H
#define FS_MESH_DRACO_BRIDGE_H

#include <fairsurf/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum fs_draco_kind { FS_DRACO_POSITION, FS_DRACO_NORMAL, FS_DRACO_TEXTURE, FS_DRACO_GENERIC } fs_draco_kind;

/* Values at points. Points are what triangles join: several of them may share one value, which makes a value per corner
   (a point for each pair) as possible as one per vertex. */
typedef struct fs_draco_attribute {
  fs_draco_kind kind;
  const char *name; /* of a generic one, kept as its metadata "name" */
  bool is_byte;     /* values are uint8_t; else float */
  int32_t n_components, n_values;
  const void *values;            /* [n_values][n_components] */
  const int32_t *value_of_point; /* [n_points]; NULL: value i is that of point i */
  int32_t bits;                  /* of quantisation; 0: kept as they are */
  const float *grid;             /* NULL: the box of the values; else the least corner and the size of a cube, [4] */
} fs_draco_attribute;

typedef struct fs_draco_entry {
  const char *key, *text; /* at most 255 bytes of key */
  size_t size;            /* of text as bytes; 0: it ends with a zero byte */
} fs_draco_entry;

typedef struct fs_draco_geometry {
  int32_t n_points, n_triangles;
  const int32_t *corner; /* [3 n_triangles] points */
  int32_t n_attributes;
  const fs_draco_attribute *attribute;
  int32_t n_entries;
  const fs_draco_entry *entry; /* metadata of the whole */
} fs_draco_geometry;

/* Compresses by Edgebreaker, which renumbers points and triangles. id[n_attributes]: the numbers by which the bytes know
   the attributes. The caller releases the bytes. */
fs_status fs_draco_encode(fs_context *ctx, const fs_draco_geometry *geometry, int32_t *id, char **bytes, size_t *size);

/* A decoded mesh: every corner is a point, every point has one value of every attribute. */
typedef struct fs_draco_mesh fs_draco_mesh;

/* Refuses, before it asks for memory, bytes that claim more triangles or points than FS_DRACO_MOST_PER_BYTE times their
   number. */
enum { FS_DRACO_MOST_PER_BYTE = 64 };
fs_status fs_draco_decode(fs_context *ctx, const char *bytes, size_t size, fs_draco_mesh **mesh);
void fs_draco_free(fs_draco_mesh *mesh); /* NULL is allowed */

int32_t fs_draco_n_points(const fs_draco_mesh *mesh);
int32_t fs_draco_n_triangles(const fs_draco_mesh *mesh);
void fs_draco_corners(const fs_draco_mesh *mesh, int32_t *corner); /* [3 n_triangles] */

/* The first attribute of a kind, generic ones by name; FS_NONE: there is none. */
int32_t fs_draco_find(const fs_draco_mesh *mesh, fs_draco_kind kind, const char *name);
int32_t fs_draco_find_id(const fs_draco_mesh *mesh, int32_t id);
int32_t fs_draco_n_components(const fs_draco_mesh *mesh, int32_t attribute);
int32_t fs_draco_n_values(const fs_draco_mesh *mesh, int32_t attribute);
void fs_draco_values_of_points(const fs_draco_mesh *mesh, int32_t attribute, int32_t *value); /* [n_points] */
/* x[n_values][n_components], whatever the type in the bytes is. */
void fs_draco_values(const fs_draco_mesh *mesh, int32_t attribute, float *x);

/* Metadata of the whole, as bytes; NULL: there is no such key. They live until the next call. */
const char *fs_draco_entry_find(fs_draco_mesh *mesh, const char *key, size_t *size);

/* The counts that the head of the bytes claims (in draco_head.c). FS_ERR_FORMAT: no head of a mesh that can be read. */
fs_status fs_draco_check_head(fs_context *ctx, const char *bytes, size_t size);

#ifdef __cplusplus
}
#endif
#endif
