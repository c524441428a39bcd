/* SPDX-License-Identifier: MIT */
/* What the files of the GLB exporter share. */
#ifndef FS_EXPORTERS_GLB_H
#define FS_EXPORTERS_GLB_H

#include "blob.h"
#include "writer.h"

/* A connected part of the triangles; corners count from its first vertex. */
typedef struct fs_glb_part {
  int32_t first_vertex, n_vertices, first_triangle, n_triangles;
} fs_glb_part;

/* A surface as triangles, part by part, in the numbers of the format. */
typedef struct fs_glb_mesh {
  int32_t n_vertices, n_triangles, n_parts;
  fs_glb_part *part;
  float *position, *normal; /* [n_vertices][3] */
  float *measure, *texture; /* [n_vertices] and [n_vertices][2], the place in the ramp; NULL: no measure */
  int32_t *corner;          /* [n_triangles][3] */
  double low, high;         /* values of the measure at the ends of the ramp */
  float grid[4];            /* least corner and size of the cube that all parts share */
  bool is_closed;
} fs_glb_mesh;
fs_status fs_glb_mesh_create(fs_context *ctx, const fs_model *model, int32_t steps, fs_glb_mesh **mesh);
void fs_glb_mesh_free(fs_context *ctx, fs_glb_mesh *mesh); /* NULL is allowed */

/* The picture of the ramp of colours, as PNG: FS_GLB_RAMP wide, 1 high. */
enum { FS_GLB_RAMP = 256 };
fs_status fs_glb_append_ramp(fs_blob *blob);

/* Attributes of a part, in this order everywhere; the last two only where there is a measure. */
enum { FS_GLB_POSITION, FS_GLB_NORMAL, FS_GLB_TEXTURE, FS_GLB_MEASURE, FS_GLB_ATTRIBUTES };

/* A part as it is in the binary chunk. A decoder gets these counts and this box, which are not those of the input. */
typedef struct fs_glb_stored {
  size_t start, size; /* in the chunk; plain: positions, normals, …, then corners, without gaps */
  int32_t n_vertices, n_triangles;
  float min[3], max[3];
  int32_t id[FS_GLB_ATTRIBUTES]; /* of a compressed part: numbers of its attributes */
} fs_glb_stored;

typedef struct fs_glb_bits {
  int32_t position, normal, measure;
} fs_glb_bits;

/* FS_ERR_UNSUPPORTED in a library built without Draco. */
fs_status fs_glb_append_compressed(fs_context *ctx, const fs_glb_mesh *mesh, const fs_glb_part *part,
                                   const fs_glb_bits *bits, fs_blob *chunk, fs_glb_stored *stored);

/* Curves in the chunk, plain; n_lines 0: none. Indices, positions, colours without gaps. */
typedef struct fs_glb_lines {
  size_t start;
  int32_t n_points, n_lines;
  float min[3], max[3];
} fs_glb_lines;
fs_status fs_glb_append_lines(fs_context *ctx, const fs_model *model, double diagonal, fs_blob *chunk,
                              fs_glb_lines *lines);
/* Their three accessors are first, first + 1, first + 2, their views view, … */
void fs_glb_write_lines_mesh(fs_writer *writer, int32_t first);
void fs_glb_write_lines_views(fs_writer *writer, const fs_glb_lines *lines);
void fs_glb_write_lines_accessors(fs_writer *writer, const fs_glb_lines *lines, int32_t view);

/* The text of the JSON chunk. stored[n_parts]; the ramp, where there is a measure, lies in the chunk at ramp_start. */
typedef struct fs_glb_scene {
  const fs_model *model;
  const fs_glb_mesh *mesh;
  const fs_glb_stored *stored;
  bool is_compressed;
  fs_glb_lines lines;
  size_t chunk_size, ramp_start, ramp_size;
} fs_glb_scene;
fs_status fs_glb_append_scene(const fs_glb_scene *scene, fs_blob *json);

extern const fs_exporter fs_exporter_glb;

#endif
