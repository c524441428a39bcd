/* SPDX-License-Identifier: MIT */
/* Single role: STL, binary or ascii. Single precision; the normal of a facet follows from the order of its corners by the
   right-hand rule: (b - a) x (c - a), made a unit vector; zero for a facet without area. */
#include "writer.h"

#include <math.h>

enum { STEPS, FORMAT };
enum { BINARY, ASCII };
enum { HEADER_SIZE = 80 };

static fs_vec3 facet_normal(fs_vec3 a, fs_vec3 b, fs_vec3 c) {
  fs_vec3 p = {b.x - a.x, b.y - a.y, b.z - a.z}, q = {c.x - a.x, c.y - a.y, c.z - a.z};
  double scale = fmax(fmax(fmax(fabs(p.x), fabs(p.y)), fabs(p.z)), fmax(fmax(fabs(q.x), fabs(q.y)), fabs(q.z)));
  fs_vec3 n;
  double length;
  if (!(scale > 0)) return (fs_vec3){0, 0, 0};
  /* Scaled first, so that products of tiny or huge sides neither vanish nor overflow. */
  p = (fs_vec3){p.x / scale, p.y / scale, p.z / scale};
  q = (fs_vec3){q.x / scale, q.y / scale, q.z / scale};
  n = (fs_vec3){p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
  length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  if (!(length > 0)) return (fs_vec3){0, 0, 0};
  return (fs_vec3){n.x / length, n.y / length, n.z / length};
}

static void write_float3(fs_writer *writer, fs_vec3 p) {
  fs_writer_float32(writer, p.x);
  fs_writer_float32(writer, p.y);
  fs_writer_float32(writer, p.z);
}

static void write_binary(fs_writer *writer, const fs_triangles *t) {
  static const char header[HEADER_SIZE] = "binary STL by fairsurf"; /* must not begin with "solid" */
  fs_writer_bytes(writer, header, sizeof header);
  fs_writer_uint32(writer, (uint32_t)t->n_triangles);
  for (int32_t i = 0; i < t->n_triangles; i++) {
    const int32_t *corner = t->corner + 3 * (size_t)i;
    fs_vec3 a = t->position[corner[0]], b = t->position[corner[1]], c = t->position[corner[2]];
    write_float3(writer, facet_normal(a, b, c));
    write_float3(writer, a);
    write_float3(writer, b);
    write_float3(writer, c);
    fs_writer_uint16(writer, 0);
  }
}

static void write_ascii_vec3(fs_writer *writer, const char *before, fs_vec3 p) {
  fs_writer_text(writer, before);
  fs_writer_vec3(writer, p, " ");
  fs_writer_text(writer, "\n");
}

static void write_ascii(fs_writer *writer, const char *name, const fs_triangles *t) {
  fs_writer_text(writer, "solid ");
  fs_writer_line_text(writer, name);
  fs_writer_text(writer, "\n");
  for (int32_t i = 0; i < t->n_triangles; i++) {
    const int32_t *corner = t->corner + 3 * (size_t)i;
    fs_vec3 a = t->position[corner[0]], b = t->position[corner[1]], c = t->position[corner[2]];
    write_ascii_vec3(writer, "facet normal ", facet_normal(a, b, c));
    fs_writer_text(writer, "  outer loop\n");
    write_ascii_vec3(writer, "    vertex ", a);
    write_ascii_vec3(writer, "    vertex ", b);
    write_ascii_vec3(writer, "    vertex ", c);
    fs_writer_text(writer, "  endloop\nendfacet\n");
  }
  fs_writer_text(writer, "endsolid ");
  fs_writer_line_text(writer, name);
  fs_writer_text(writer, "\n");
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_triangles *triangles = NULL;
  fs_writer writer;
  fs_status status = fs_tessellate(ctx, model->surface, (int32_t)param[STEPS], &triangles);
  if (status != FS_OK) return status;
  fs_writer_start(&writer, ctx, output, "stl");
  if (param[FORMAT] == ASCII)
    write_ascii(&writer, model->name, triangles);
  else
    write_binary(&writer, triangles);
  status = fs_writer_finish(&writer);
  fs_triangles_free(ctx, triangles);
  return status;
}

const fs_exporter fs_exporter_stl = {
    .name = "stl",
    .extension = "stl",
    .summary = "STL: the surface as triangles, for printing",
    .params = (const fs_param[]){FS_PARAM_STEPS,
                                 {.name = "format",
                                  .summary = "binary: little-endian",
                                  .initial = BINARY,
                                  .min = BINARY,
                                  .max = ASCII,
                                  .choices = (const char *const[]){"binary", "ascii", NULL}},
                                 {.name = NULL}},
    .what = FS_EXPORT_SURFACE,
    .write = write,
};
