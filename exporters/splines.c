/* SPDX-License-Identifier: MIT */
/* Single role: the text format of B-splines, .spl (docs/formats/splines.md): a patch without knots for every tensor Bezier
   patch, other patches as bicubic pieces. */
#include "bezier.h"
#include "base/base.h"

#include <fairsurf/surface_splines.h>

static void write_patch(fs_writer *writer, const fs_surface *surface, int32_t p) {
  const fs_patch *patch = &surface->patch[p];
  const double *point = surface->data + patch->data_start;
  fs_writer_printf(writer, "\npatch p%d\ndegree %d %d\npoints\n", (int)p, (int)patch->degree_u, (int)patch->degree_v);
  for (int32_t i = 0; i < (patch->degree_u + 1) * (patch->degree_v + 1); i++, point += 3) {
    fs_writer_vec3(writer, (fs_vec3){point[0], point[1], point[2]}, " ");
    fs_writer_text(writer, "\n");
  }
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  const fs_surface *surface;
  fs_surface *made;
  fs_writer writer;
  fs_status status = fs_bezier_surface(ctx, model->surface, false, param[0], &surface, &made);
  if (status != FS_OK) return status;
  for (int32_t p = 0; p < surface->n_patches && status == FS_OK; p++) {
    const fs_patch *patch = &surface->patch[p];
    if (patch->degree_u > FS_MAX_SPLINE_DEGREE || patch->degree_v > FS_MAX_SPLINE_DEGREE)
      status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "patch %d has degree (%d, %d), and .spl files go up to %d", (int)p,
                       (int)patch->degree_u, (int)patch->degree_v, FS_MAX_SPLINE_DEGREE);
  }
  if (status == FS_OK) {
    fs_writer_start(&writer, ctx, output, "spl");
    fs_writer_text(&writer, "fairsurf-splines 1\n# ");
    fs_writer_line_text(&writer, model->made_with != NULL ? model->made_with : "fairsurf");
    fs_writer_text(&writer, "\n");
    for (int32_t p = 0; p < surface->n_patches; p++) write_patch(&writer, surface, p);
    status = fs_writer_finish(&writer);
  }
  fs_surface_free(ctx, made);
  return status;
}

const fs_exporter fs_exporter_splines = {
    .name = "splines",
    .extension = "spl",
    .summary = "fairsurf's text of B-spline patches: Bezier patches by their control points",
    .params = (const fs_param[]){FS_PARAM_BEZIER_TOLERANCE, {.name = NULL}},
    .what = FS_EXPORT_SURFACE,
    .write = write,
};
