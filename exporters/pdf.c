/* SPDX-License-Identifier: MIT */
/* The PDF exporter: a drawing of the surface and the curves on it, by cairo. */
#include "drawing.h"

#include <cairo-pdf.h>

/* Equal surfaces give equal files: no date of today. */
static cairo_surface_t *open_undated(cairo_write_func_t write, void *closure, double width, double height) {
  cairo_surface_t *paper = cairo_pdf_surface_create_for_stream(write, closure, width, height);
  cairo_pdf_surface_set_metadata(paper, CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
  return paper;
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  return fs_drawing_write(ctx, model, param, output, "pdf", open_undated);
}

const fs_exporter fs_exporter_pdf = {
    .name = "pdf",
    .extension = "pdf",
    .summary = "PDF drawing: orthographic views of the surface and of curves on it, hidden lines removed",
    .params = fs_drawing_params,
    .what = FS_EXPORT_SURFACE,
    .write = write,
    .has_curves = true,
};
