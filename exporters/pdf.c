/* SPDX-License-Identifier: MIT */
/* The PDF exporter: a drawing of the surface and the curves on it, by cairo. */
#include "drawing.h"

#include <cairo-pdf.h>

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  return fs_drawing_write(ctx, model, param, output, "pdf", cairo_pdf_surface_create_for_stream);
}

const fs_exporter fs_exporter_pdf = {
    "pdf", "pdf", "PDF drawing: orthographic views of the surface and of curves on it, hidden lines removed",
    fs_drawing_params, FS_EXPORT_SURFACE, write,
};
