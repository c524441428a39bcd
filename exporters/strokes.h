/* SPDX-License-Identifier: MIT */
/* Curves on a surface as coloured pieces of straight lines, for formats of space. */
#ifndef FS_EXPORTERS_STROKES_H
#define FS_EXPORTERS_STROKES_H

#include <fairsurf/export.h>

/* Colours of curves, 0 .. 1: by the level where it is graded, from blue over grey to red. */
typedef struct fs_stroke_colours {
  bool is_graded;
  double low, high; /* of the levels */
} fs_stroke_colours;
fs_stroke_colours fs_stroke_colours_of(const fs_curves *curves); /* NULL is allowed */
void fs_stroke_colour(const fs_stroke_colours *colours, double level, double rgb[3]);
extern const double fs_tooth_colour[3], fs_mark_colour[3];

/* Lines between points. Those of a curve come one after the other, each from the point where the last one ends. Then the
   teeth of combs and the lines along their tips; umbilics are crosses. */
typedef struct fs_strokes {
  int32_t n_points, n_lines;
  fs_vec3 *position, *normal; /* [n_points] normals of the surface */
  double *level;              /* [n_points] */
  double (*colour)[3];        /* [n_points] */
  int32_t (*line)[2];         /* [n_lines] */
} fs_strokes;

/* Points closer to the last one than spacing are left out; arms of crosses are as long as size. */
fs_status fs_strokes_create(fs_context *ctx, const fs_curves *curves, double spacing, double size,
                            fs_strokes **strokes);
double fs_strokes_extent(const fs_vec3 *position, int32_t n); /* diagonal of the box of points */
void fs_strokes_free(fs_context *ctx, fs_strokes *strokes);   /* NULL is allowed */

#endif
