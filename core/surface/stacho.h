/* SPDX-License-Identifier: MIT */
/* Where the numbers of a corrected triangle of Stacho lie: the control points of its Bezier triangle of degree n, then a
   block for each of its sides. Along side s, from corner s to s + 1, t is the barycentric coordinate of corner s. */
#ifndef FS_SURFACE_STACHO_H
#define FS_SURFACE_STACHO_H

#include <fairsurf/surface.h>

enum { FS_STACHO_LOWEST = 5, FS_STACHO_HIGHEST = 7 }; /* degrees */

/* Offsets in the block of a side, and its size. The correction is V = - delta W / (N . W). */
static inline size_t fs_stacho_block(int32_t n) { return 9 * (size_t)n - 4; }
enum {
  FS_STACHO_IS_CORRECTED = 0, /* 0 or 1; where 0 the rest is not used */
  FS_STACHO_IS_FIXED = 1,     /* 1: W is the constant below; 0: W = N */
  FS_STACHO_W = 2,            /* [3] */
  FS_STACHO_DELTA = 5         /* [3 n - 6] of degree 3 n - 7; behind it N[2 n - 1][3] of degree 2 n - 2 */
};
static inline size_t fs_stacho_n(int32_t n) { return FS_STACHO_DELTA + 3 * (size_t)n - 6; }

/* Where the block of a side starts, from the first number of the patch. */
static inline size_t fs_stacho_side(int32_t n, int32_t side) {
  return 3 * (size_t)((n + 1) * (n + 2) / 2) + (size_t)side * fs_stacho_block(n);
}

/* V and its derivatives by t up to order 3, from the block of a side: V[order][component]. */
void fs_stacho_correction(const double *block, int32_t n, double t, double V[4][3]);

#endif
