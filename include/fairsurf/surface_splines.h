/* SPDX-License-Identifier: MIT */
/* B-spline patches, curves and functions: what the constructions that start from given patches read, and may write. */
#ifndef FAIRSURF_SURFACE_SPLINES_H
#define FAIRSURF_SURFACE_SPLINES_H

#include <fairsurf/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { FS_SPLINE_NAME = 32, FS_MAX_SPLINE_DEGREE = 15 };

/* A tensor product B-spline of one or two parameters. Knots are nondecreasing and clamped: the first and the last
   degree + 1 are equal, no other occurs more than degree times. */
typedef struct fs_spline {
  char name[FS_SPLINE_NAME];
  int32_t n_parameters;    /* 2: a patch; 1: a curve or a function */
  int32_t width;           /* 3: points; 1: numbers, of a function */
  int32_t degree[2], n[2]; /* by u and v: n coefficients, n + degree + 1 knots; of one parameter: degree[1] 0, n[1] 1 */
  double *knot[2];         /* of one parameter: knot[1] is 0, 1 */
  double *c;               /* [n[1]][n[0]][width], u fastest */
} fs_spline;

typedef struct fs_splines {
  int32_t n;
  fs_spline *spline; /* [n] */
} fs_splines;

/* A copy of what the arguments say, where they are valid; FS_ERR_ARGUMENT names the knot or the coefficient that is not.
   name: at most 31 letters, digits, '_', '-' or '.'; longer ones are cut. */
FS_API fs_status fs_spline_create(fs_context *ctx, const fs_spline *like, fs_spline **spline);
FS_API void fs_spline_free(fs_context *ctx, fs_spline *spline); /* NULL is allowed */
FS_API void fs_splines_free(fs_context *ctx, fs_splines *splines);

/* The first of that name, or NULL. */
FS_API const fs_spline *fs_splines_find(const fs_splines *splines, const char *name);

/* value[width] = the derivative of orders (order_u, order_v) at (u, v); v is not used by curves and functions. */
FS_API void fs_spline_evaluate(const fs_spline *spline, double u, double v, int32_t order_u, int32_t order_v,
                               double *value);

/* The text format of docs/formats/splines.md. Messages name the line. */
FS_API fs_status fs_splines_parse(fs_context *ctx, const char *bytes, size_t size, fs_splines **splines);

/* The patches in Bezier form, one Bezier patch for every nonempty span in u and v, u fastest, joined within a spline and,
   by fs_surface_stitch with 1e-9, with those of the others. */
FS_API fs_status fs_splines_surface(fs_context *ctx, int32_t n_splines, const fs_spline *const *spline,
                                    fs_surface **surface);

/* Makes neighbours of sides that have none and agree in five points within tolerance times the size of the surface, where
   they run opposite ways and no third side is there; sides without length stay alone. n_joined: pairs, may be NULL. */
FS_API fs_status fs_surface_stitch(fs_context *ctx, fs_surface *surface, double tolerance, int32_t *n_joined);

/* A file format of surfaces. parse reads from memory and writes nothing but the surface. */
typedef struct fs_surface_reader {
  const char *name, *extension, *summary;
  fs_status (*parse)(fs_context *ctx, const char *bytes, size_t size, fs_surface **surface);
} fs_surface_reader;
FS_API extern const fs_surface_reader *const fs_surface_readers[]; /* ends with NULL: bv, spl, step, stp */

/* Parses a surface in the format whose extension is given ("bv"), and joins the sides of its patches that agree within
   1e-9 of its size. FS_ERR_UNSUPPORTED lists the known formats. Memory stays within a small multiple of size. */
FS_API fs_status fs_surface_parse(fs_context *ctx, const char *extension, const char *bytes, size_t size,
                                  fs_surface **surface);

#ifdef __cplusplus
}
#endif
#endif
