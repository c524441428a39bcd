/* SPDX-License-Identifier: MIT */
/* The rational function of Gregory patches, phi(x, y) = x^2 y / (x + y), x and y the distances from a corner.

   An inner point that is q on the side y = 0 and p on the side x = 0 of its corner, (x q + y p) / (x + y), times the Bernstein
   polynomials x y ... beside it, is p x y ... + (q - p) phi ...: the patch is polynomial with p, and phi carries the rest.
   With a = x / (x + y), b = y / (x + y), s = x + y all derivatives are products, without cancellation:
     phi = x y a            phi_x = (x + 2 y) a b        phi_y = x a^2
     phi_xx = 2 b^3         phi_xy = a^2 (a + 3 b)       phi_yy = -2 a^3
     phi_xxx = -6 b^3 / s   phi_xxy = 6 a b^2 / s        phi_xyy = -6 a^2 b / s     phi_yyy = 6 a^3 / s
   At the corner itself, s = 0, the second derivatives are those along the line x = y, and the third ones do not exist. */
#ifndef FS_SURFACE_GREGORY_H
#define FS_SURFACE_GREGORY_H

#include <fairsurf/surface.h>
#include <math.h>

static inline void fs_gregory_phi(double x, double y, double *phi) {
  double s = x + y, a = s != 0 ? x / s : 0.5, b = s != 0 ? y / s : 0.5;
  double six = s != 0 ? 6 / s : (double)NAN;
  phi[FS_D] = x * y * a;
  phi[FS_DU] = (x + 2 * y) * a * b;
  phi[FS_DV] = x * a * a;
  phi[FS_DUU] = 2 * b * b * b;
  phi[FS_DUV] = a * a * (a + 3 * b);
  phi[FS_DVV] = -2 * a * a * a;
  phi[FS_DUUU] = -six * b * b * b;
  phi[FS_DUUV] = six * a * b * b;
  phi[FS_DUVV] = -six * a * a * b;
  phi[FS_DVVV] = six * a * a * a;
}

#endif
