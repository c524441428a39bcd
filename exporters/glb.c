/* SPDX-License-Identifier: MIT */
/* Single role: GLB, the binary form of glTF 2.0: a head, a chunk of JSON padded with spaces, a chunk of numbers padded with
   zeros. The numbers are plain, or compressed by Draco, all parts on one grid so that no gap opens between them. */
#include "glb.h"
#include "draco_params.h"
#include "writer.h"
#include "base/base.h"

#include <math.h>
#include <string.h>

enum { STEPS, DRACO, POSITION_BITS, NORMAL_BITS, MEASURE_BITS };
enum { MAGIC = 0x46546C67, VERSION = 2, JSON = 0x4E4F534A, BIN = 0x004E4942, HEAD = 12, CHUNK_HEAD = 8 };

#ifdef FS_HAVE_DRACO
enum { HAS_DRACO = 1 };
#else
enum { HAS_DRACO = 0 };
fs_status fs_glb_append_compressed(fs_context *ctx, const fs_glb_mesh *mesh, const fs_glb_part *part,
                                   const fs_glb_bits *bits, fs_blob *chunk, fs_glb_stored *stored) {
  (void)mesh, (void)part, (void)bits, (void)chunk, (void)stored;
  return fs_fail(ctx, FS_ERR_UNSUPPORTED, "this library was built without Draco: GLB is written with draco=no");
}
#endif

static void find_box(const float *position, int32_t n, fs_glb_stored *stored) {
  for (size_t i = 0; i < 3 * (size_t)n; i++) {
    if (i < 3 || position[i] < stored->min[i % 3]) stored->min[i % 3] = position[i];
    if (i < 3 || position[i] > stored->max[i % 3]) stored->max[i % 3] = position[i];
  }
}

static void write_floats(fs_writer *w, const float *x, size_t n) {
  for (size_t i = 0; i < n; i++) fs_writer_float32(w, x[i]);
}

/* Corners, then the attributes in their order. */
static fs_status append_plain(const fs_glb_mesh *mesh, const fs_glb_part *part, fs_blob *chunk, fs_glb_stored *stored) {
  const size_t first = (size_t)part->first_vertex, n = (size_t)part->n_vertices;
  const int32_t *corner = mesh->corner + 3 * (size_t)part->first_triangle;
  fs_output output = fs_blob_output(chunk);
  fs_status status = FS_OK;
  fs_writer w;
  stored->start = chunk->size;
  stored->n_vertices = part->n_vertices;
  stored->n_triangles = part->n_triangles;
  find_box(mesh->position + 3 * first, part->n_vertices, stored);
  fs_writer_start(&w, chunk->ctx, &output, "bin");
  for (size_t i = 0; i < 3 * (size_t)part->n_triangles; i++) fs_writer_uint32(&w, (uint32_t)corner[i]);
  write_floats(&w, mesh->position + 3 * first, 3 * n);
  write_floats(&w, mesh->normal + 3 * first, 3 * n);
  if (mesh->measure != NULL) {
    write_floats(&w, mesh->texture + 2 * first, 2 * n);
    write_floats(&w, mesh->measure + first, n);
  }
  FS_TRY(fs_writer_finish(&w));
  stored->size = chunk->size - stored->start;
done:
  return status;
}

static fs_status write_file(fs_context *ctx, const fs_blob *json, const fs_blob *chunk, const fs_output *output) {
  const size_t size = HEAD + 2 * CHUNK_HEAD + json->size + chunk->size;
  fs_writer w;
  if (size > UINT32_MAX)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "a GLB file of %zu bytes is larger than its head can say", size);
  fs_writer_start(&w, ctx, output, "glb");
  fs_writer_uint32(&w, MAGIC);
  fs_writer_uint32(&w, VERSION);
  fs_writer_uint32(&w, (uint32_t)size);
  fs_writer_uint32(&w, (uint32_t)json->size);
  fs_writer_uint32(&w, JSON);
  fs_writer_bytes(&w, json->bytes, json->size);
  fs_writer_uint32(&w, (uint32_t)chunk->size);
  fs_writer_uint32(&w, BIN);
  fs_writer_bytes(&w, chunk->bytes, chunk->size);
  return fs_writer_finish(&w);
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  const fs_glb_bits bits = {.position = (int32_t)param[POSITION_BITS],
                            .normal = (int32_t)param[NORMAL_BITS],
                            .measure = (int32_t)param[MEASURE_BITS]};
  fs_blob json = {.ctx = ctx}, chunk = {.ctx = ctx};
  fs_glb_mesh *mesh = NULL;
  fs_glb_stored *stored = NULL;
  fs_glb_scene scene = {.model = model, .is_compressed = param[DRACO] != 0};
  fs_status status = FS_OK;
  FS_TRY(fs_glb_mesh_create(ctx, model, (int32_t)param[STEPS], &mesh));
  FS_ALLOC(ctx, stored, mesh->n_parts);
  for (int32_t p = 0; p < mesh->n_parts; p++) {
    if (scene.is_compressed)
      FS_TRY(fs_glb_append_compressed(ctx, mesh, &mesh->part[p], &bits, &chunk, &stored[p]));
    else
      FS_TRY(append_plain(mesh, &mesh->part[p], &chunk, &stored[p]));
  }
  if (model->curves != NULL) FS_TRY(fs_glb_append_lines(ctx, model, sqrt(3) * mesh->grid[3], &chunk, &scene.lines));
  scene.mesh = mesh;
  scene.stored = stored;
  scene.ramp_start = chunk.size;
  if (mesh->measure != NULL) FS_TRY(fs_glb_append_ramp(&chunk));
  scene.ramp_size = chunk.size - scene.ramp_start;
  FS_TRY(fs_blob_pad(&chunk, 4, 0));
  scene.chunk_size = chunk.size;
  FS_TRY(fs_glb_append_scene(&scene, &json));
  FS_TRY(fs_blob_pad(&json, 4, ' '));
  FS_TRY(write_file(ctx, &json, &chunk, output));
done:
  fs_blob_clear(&json);
  fs_blob_clear(&chunk);
  fs_release(ctx, stored);
  fs_glb_mesh_free(ctx, mesh);
  return status;
}

const fs_exporter fs_exporter_glb = {
    .name = "glb",
    .extension = "glb",
    .summary = "GLB (binary glTF 2.0): the surface as triangles with normals, and a measure as colours",
    .params = (const fs_param[]){FS_PARAM_STEPS,
                                 {.name = "draco",
                                  .summary = "compress by Draco: some 20 times smaller, but not every viewer reads it",
                                  .initial = HAS_DRACO,
                                  .min = 0,
                                  .max = 1,
                                  .choices = (const char *const[]){"no", "yes", NULL}},
                                 FS_PARAM_POSITION_BITS,
                                 FS_PARAM_NORMAL_BITS,
                                 FS_PARAM_MEASURE_BITS,
                                 {.name = NULL}},
    .what = FS_EXPORT_SURFACE,
    .write = write,
    .has_curves = true,
};
