/* SPDX-License-Identifier: MIT */
/* Curves that people judge surfaces by: isophotes, reflection and highlight lines, zebra stripes, lines of curvature,
   lines of equal curvature, plane sections with curvature combs [docs/plots.md]. They are traced on the patches. */
#ifndef FAIRSURF_ANALYSE_CURVES_H
#define FAIRSURF_ANALYSE_CURVES_H

#include <fairsurf/analyse.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct fs_curve_point {
  fs_vec3 position, normal; /* of the surface */
  fs_vec3 tooth;            /* of a curvature comb, from position to its tip; zero elsewhere */
  fs_place place;           /* on fs_surface_to_quads of the surface: the same patches where all have four sides */
} fs_curve_point;

typedef struct fs_surface_curve {
  int32_t first, n_points; /* point[first] .. point[first + n_points - 1]; a closed one repeats its first point */
  bool is_closed;
  double level; /* what is the same along it: an angle in degrees, a curvature, a coordinate; or 0 */
} fs_surface_curve;

/* A place of its own: an umbilic. */
typedef struct fs_mark {
  fs_curve_point point;
  int32_t index; /* twice the index of the field of directions around it: 1 lemon or monstar, -1 star */
} fs_mark;

typedef struct fs_curves {
  int32_t n_curves, n_points, n_marks;
  fs_surface_curve *curve;
  fs_curve_point *point;
  fs_mark *mark;
  bool is_graded;        /* levels are values to compare, to be coloured */
  int32_t n_fill;        /* triangles that are dark: the stripes of zebra; */
  fs_vec3 (*fill)[2][3]; /* [n_fill] positions, normals */
} fs_curves;
FS_API void fs_curves_free(fs_context *ctx, fs_curves *curves); /* NULL is allowed */

/* A function on a surface: of the derivatives of the position at one point; NaN where it has no value there. */
typedef struct fs_field {
  double (*value)(const void *user, const fs_vec3 x[FS_JET_SIZE]);
  const void *user;
} fs_field;

typedef struct fs_trace_options {
  double
      tolerance; /* largest distance of the chords from the curve; 0: 1e-5 of the diagonal of the box of the corners */
  int32_t
      n_cells; /* along a side of a patch, for the search of curves; closed ones within a cell are not found. 0: 8 */
} fs_trace_options;

/* The points where a field has the given values: every point of every curve satisfies it to rounding. Curves go on across
   shared sides where the field is the same on both; a jump of the field ends them. options may be NULL. */
FS_API fs_status fs_trace_levels(fs_context *ctx, const fs_surface *surface, const fs_field *field, int32_t n_levels,
                                 const double *level, const fs_trace_options *options, fs_curves **curves);

/* Lines of principal curvature, at most about spacing apart (0: a thirtieth of the diagonal), followed by Runge-Kutta steps
   with error control across the patches; and the umbilics. which: 0 both families, 1 those of the larger curvature, 2 of
   the smaller. They end at borders, where they come close to another line of their family, and before umbilics. */
FS_API fs_status fs_trace_curvature_lines(fs_context *ctx, const fs_surface *surface, int32_t which, double spacing,
                                          const fs_trace_options *options, fs_curves **curves);

/* Points where both principal curvatures are equal, as marks. Regions of them (spheres, planes) are not reported. */
FS_API fs_status fs_trace_umbilics(fs_context *ctx, const fs_surface *surface, const fs_trace_options *options,
                                   fs_curves **curves);

/* A way of looking at a surface. Lines of a table. */
typedef struct fs_plot {
  const char *name, *summary;
  const fs_param *params; /* ends with a NULL name */
  fs_status (*trace)(fs_context *ctx, const fs_surface *surface, const double *param, const fs_trace_options *options,
                     fs_curves **curves);
} fs_plot;
FS_API extern const fs_plot *const fs_plots[];        /* ends with NULL */
FS_API const fs_plot *fs_plot_find(const char *name); /* NULL: unknown */

/* Traces with param, or the initial values of the params of the plot where it is NULL. */
FS_API fs_status fs_plot_trace(fs_context *ctx, const fs_plot *plot, const fs_surface *surface, const double *param,
                               const fs_trace_options *options, fs_curves **curves);

#ifdef __cplusplus
}
#endif
#endif
