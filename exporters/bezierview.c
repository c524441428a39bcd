/* SPDX-License-Identifier: MIT */
/* Single role: BezierView files, .bv (docs/formats/bv.md): tensor Bezier patches (kinds 4 and 5, v fastest) and Bezier
   triangles (kind 3) exactly, other patches as bicubic pieces. */
#include "bezier.h"

#include <string.h>

static void write_point(fs_writer *writer, const double *p) {
  fs_writer_vec3(writer, (fs_vec3){p[0], p[1], p[2]}, " ");
  fs_writer_text(writer, "\n");
}

static void write_patch(fs_writer *writer, const fs_surface *surface, const fs_patch *patch) {
  const double *point = surface->data + patch->data_start;
  int32_t n = patch->degree_u, m = patch->degree_v;
  if (patch->kind == FS_PATCH_BEZIER_TRIANGLE) {
    fs_writer_printf(writer, "3\n%d\n", (int)n);
    for (int32_t i = 0; i < (n + 1) * (n + 2) / 2; i++) write_point(writer, point + 3 * i);
    return;
  }
  if (n == m)
    fs_writer_printf(writer, "4\n%d\n", (int)n);
  else
    fs_writer_printf(writer, "5\n%d %d\n", (int)n, (int)m);
  for (int32_t i = 0; i <= n; i++)
    for (int32_t j = 0; j <= m; j++) write_point(writer, point + 3 * (i + (n + 1) * j));
}

/* A group has a colour, a name without spaces, and no more on its line. */
static void write_group(fs_writer *writer, const char *name) {
  char word[64];
  size_t n = 0;
  for (; name[n] != '\0' && n < sizeof word - 1; n++) word[n] = name[n] > ' ' && name[n] <= '~' ? name[n] : '_';
  word[n] = '\0';
  fs_writer_printf(writer, "Group 0 %s\n", n > 0 ? word : "surface");
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  const fs_surface *surface;
  fs_surface *made;
  fs_writer writer;
  fs_status status = fs_bezier_surface(ctx, model->surface, true, param[0], &surface, &made);
  if (status != FS_OK) return status;
  fs_writer_start(&writer, ctx, output, "bv");
  write_group(&writer, model->name);
  for (int32_t p = 0; p < surface->n_patches; p++) write_patch(&writer, surface, &surface->patch[p]);
  status = fs_writer_finish(&writer);
  fs_surface_free(ctx, made);
  return status;
}

const fs_exporter fs_exporter_bezierview = {
    .name = "bezierview",
    .extension = "bv",
    .summary = "BezierView: Bezier patches and triangles by their control points",
    .params = (const fs_param[]){FS_PARAM_BEZIER_TOLERANCE, {.name = NULL}},
    .what = FS_EXPORT_SURFACE,
    .write = write,
};
