/* SPDX-License-Identifier: MIT */
/* What the files that trace curves share: sets of curves that grow, and evaluation within quadrilaterals. */
#ifndef FS_ANALYSE_CURVES_H
#define FS_ANALYSE_CURVES_H

#include <fairsurf/analyse_curves.h>
#include "base/base.h"

/* A growing fs_curves. */
typedef struct fs_curve_list {
  fs_curves *curves;
  int32_t curve_room, point_room, mark_room, fill_room;
} fs_curve_list;

fs_status fs_curve_list_start(fs_context *ctx, fs_curve_list *list);
fs_status fs_curve_list_begin(fs_context *ctx, fs_curve_list *list, double level); /* a curve without points */
fs_status fs_curve_list_add(fs_context *ctx, fs_curve_list *list, const fs_curve_point *point);
/* Ends the curve; one of fewer than two points is taken back. */
void fs_curve_list_end(fs_curve_list *list, bool is_closed);
fs_status fs_curve_list_mark(fs_context *ctx, fs_curve_list *list, const fs_mark *mark);
fs_status fs_curve_list_fill(fs_context *ctx, fs_curve_list *list, fs_vec3 fill[2][3]);

/* The field at the corners of n_cells x n_cells cells of every patch, [n_patches][(n_cells + 1)^2], for many levels of one
   field. */
fs_status fs_field_values(fs_context *ctx, const fs_surface *surface, const fs_field *field, int32_t n_cells,
                          double **values);

/* Appends the curves of a field at one level. surface has patches of four sides only. values: of fs_field_values with the
   n_cells of options, or NULL: they are computed. */
fs_status fs_levels_append(fs_context *ctx, const fs_surface *surface, const fs_field *field, const double *values,
                           double level, double label, const fs_trace_options *options, fs_curve_list *list);

/* Appends the parts of the surface where the field exceeds level, as fill. */
fs_status fs_bands_append(fs_context *ctx, const fs_surface *surface, const fs_field *field, double level,
                          int32_t n_cells, fs_curve_list *list);

/* Appends umbilics as marks; surface of patches of four sides. */
fs_status fs_umbilics_append(fs_context *ctx, const fs_surface *surface, int32_t n_cells, double diagonal,
                             fs_curve_list *list);

/* Diagonal of the box of the corners of the patches, and their centre. */
double fs_surface_diagonal(const fs_surface *surface, fs_vec3 *centre);

/* The defaults filled in. */
fs_trace_options fs_trace_options_complete(const fs_surface *surface, const fs_trace_options *options);

/* Value of a field at a place, and the point of a curve there. */
double fs_field_at(const fs_surface *surface, const fs_field *field, int32_t patch, double u, double v);
fs_curve_point fs_curve_point_at(const fs_surface *surface, int32_t patch, double u, double v);

/* Unit vector by angles in degrees: azimuth from x towards y, elevation above the xy plane. */
fs_vec3 fs_direction_of(double azimuth, double elevation);

extern const fs_plot fs_plot_isophotes, fs_plot_reflection, fs_plot_highlight, fs_plot_zebra, fs_plot_mean,
    fs_plot_gaussian, fs_plot_curvature_lines, fs_plot_sections;

#endif
