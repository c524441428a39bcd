/* SPDX-License-Identifier: MIT */
/* The SVG exporter: a drawing of the surface and the curves on it, by cairo. */
#include "drawing.h"

#include <cairo-svg.h>

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  return fs_drawing_write(ctx, model, param, output, "svg", cairo_svg_surface_create_for_stream);
}

const fs_exporter fs_exporter_svg = {
    .name = "svg",
    .extension = "svg",
    .summary = "SVG drawing: orthographic views of the surface and of curves on it, hidden lines removed",
    .params = fs_drawing_params,
    .what = FS_EXPORT_SURFACE,
    .write = write,
    .has_curves = true,
};
