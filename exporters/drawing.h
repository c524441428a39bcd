/* SPDX-License-Identifier: MIT */
/* What the exporters of drawings share: orthographic views of a surface and the curves on it, hidden lines removed, drawn by
   cairo on a surface that writes to a sink. */
#ifndef FS_EXPORTERS_DRAWING_H
#define FS_EXPORTERS_DRAWING_H

#include <fairsurf/export.h>
#include <cairo.h>

/* Parameters of all drawings, in this order. */
enum {
  FS_DRAWING_VIEWS,
  FS_DRAWING_AZIMUTH,
  FS_DRAWING_ELEVATION,
  FS_DRAWING_HIDDEN,
  FS_DRAWING_WIDTH,
  FS_N_DRAWING_PARAMS
};
extern const fs_param fs_drawing_params[FS_N_DRAWING_PARAMS + 1];

/* A cairo surface of that size in points that writes with write and closure: SVG, PDF, … */
typedef cairo_surface_t *(*fs_drawing_open)(cairo_write_func_t write, void *closure, double width, double height);

/* The whole of an exporter of drawings. */
fs_status fs_drawing_write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output,
                           const char *extension, fs_drawing_open open);

/* ---- a view (drawing_view.c) ---- */

/* Coordinates of the paper: x to the right, y up, z towards the viewer. */
typedef struct fs_view {
  fs_vec3 right, up, towards;
  double low[2], high[2]; /* what the surface covers */
  int32_t n;              /* depth[n][n]: z of the surface in cells of the square around it, -infinity beside it */
  double *depth, origin[2], cell, bias;
} fs_view;

fs_status fs_view_create(fs_context *ctx, const fs_triangles *triangles, double azimuth, double elevation,
                         fs_view *view);
void fs_view_clear(fs_context *ctx, fs_view *view);
fs_vec3 fs_view_project(const fs_view *view, fs_vec3 p);
/* Whether nothing of the surface is before a point of it, given on the paper. */
bool fs_view_sees(const fs_view *view, fs_vec3 projected);

#endif
