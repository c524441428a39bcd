/* SPDX-License-Identifier: MIT */
/* Single role: curves on the surface in a GLB file: a mesh of lines with colours, in the chunk as indices, positions, colours.
   Positions lie a little above the outside, by 0.0005 of the diagonal, or the triangles would cover them. */
#include "glb.h"
#include "strokes.h"
#include "writer.h"
#include "base/base.h"
#include "math/vec3.h"

enum { UINT32 = 5125, FLOAT32 = 5126, VERTICES = 34962, INDICES = 34963 };

static fs_vec3 lifted(const fs_strokes *s, int32_t i, double lift) {
  return fs_vec3_add_scaled(s->position[i], s->normal[i], lift);
}

fs_status fs_glb_append_lines(fs_context *ctx, const fs_model *model, double diagonal, fs_blob *chunk,
                              fs_glb_lines *lines) {
  fs_strokes *s = NULL;
  fs_output output = fs_blob_output(chunk);
  fs_status status = FS_OK;
  fs_writer w;
  double lift = 5e-4 * diagonal;
  FS_TRY(fs_strokes_create(ctx, model->curves, 1e-3 * diagonal, 0.01 * diagonal, &s));
  if (s->n_lines == 0) goto done;
  FS_TRY(fs_blob_pad(chunk, 4, 0));
  lines->start = chunk->size;
  lines->n_points = s->n_points, lines->n_lines = s->n_lines;
  for (int32_t i = 0; i < s->n_points; i++) {
    fs_vec3 p = lifted(s, i, lift);
    const float x[3] = {(float)p.x, (float)p.y, (float)p.z};
    for (int k = 0; k < 3; k++) {
      lines->min[k] = i == 0 || x[k] < lines->min[k] ? x[k] : lines->min[k];
      lines->max[k] = i == 0 || x[k] > lines->max[k] ? x[k] : lines->max[k];
    }
  }
  fs_writer_start(&w, ctx, &output, "bin");
  for (int32_t i = 0; i < s->n_lines; i++)
    for (int k = 0; k < 2; k++) fs_writer_uint32(&w, (uint32_t)s->line[i][k]);
  for (int32_t i = 0; i < s->n_points; i++) {
    fs_vec3 p = lifted(s, i, lift);
    fs_writer_float32(&w, p.x);
    fs_writer_float32(&w, p.y);
    fs_writer_float32(&w, p.z);
  }
  for (int32_t i = 0; i < s->n_points; i++) /* the format wants them linear */
    for (int k = 0; k < 3; k++) fs_writer_float32(&w, pow(s->colour[i][k], 2.2));
  FS_TRY(fs_writer_finish(&w));
done:
  fs_strokes_free(ctx, s);
  return status;
}

/* ---- JSON ---- */

void fs_glb_write_lines_mesh(fs_writer *w, int32_t first) {
  fs_writer_printf(w,
                   ",{\"name\":\"curves\",\"primitives\":[{\"mode\":1,\"material\":1,\"indices\":%d,\"attributes\":"
                   "{\"POSITION\":%d,\"COLOR_0\":%d}}]}",
                   (int)first, (int)first + 1, (int)first + 2);
}

void fs_glb_write_lines_views(fs_writer *w, const fs_glb_lines *lines) {
  const size_t size[3] = {8 * (size_t)lines->n_lines, 12 * (size_t)lines->n_points, 12 * (size_t)lines->n_points};
  size_t at = lines->start;
  for (int k = 0; k < 3; at += size[k++])
    fs_writer_printf(w, ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":%d}", at, size[k],
                     k == 0 ? INDICES : VERTICES);
}

void fs_glb_write_lines_accessors(fs_writer *w, const fs_glb_lines *lines, int32_t view) {
  fs_writer_printf(w, ",{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"SCALAR\"}", (int)view, UINT32,
                   (int)(2 * lines->n_lines));
  for (int k = 1; k < 3; k++) {
    fs_writer_printf(w, ",{\"bufferView\":%d,\"componentType\":%d,\"count\":%d,\"type\":\"VEC3\"", (int)view + k,
                     FLOAT32, (int)lines->n_points);
    for (int end = 0; k == 1 && end < 2; end++) {
      const float *x = end == 0 ? lines->min : lines->max;
      fs_writer_text(w, end == 0 ? ",\"min\":[" : ",\"max\":[");
      fs_writer_vec3(w, (fs_vec3){x[0], x[1], x[2]}, ",");
      fs_writer_text(w, "]");
    }
    fs_writer_text(w, "}");
  }
}
