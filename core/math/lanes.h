/* SPDX-License-Identifier: MIT */
/* Vectors of points. Kernels are compiled once per instruction set, with FS_LANES doubles in a vector and FS_SUFFIX at the
   end of each public name; a file of the room chooses at run time. */
#ifndef FS_MATH_LANES_H
#define FS_MATH_LANES_H

#include <math.h>
#include <string.h>

#ifndef FS_LANES
#define FS_LANES 2
#define FS_SUFFIX _base
#endif

#define FS_JOIN_(name, suffix) name##suffix
#define FS_JOIN(name, suffix) FS_JOIN_(name, suffix)
#define FS_KERNEL(name) FS_JOIN(name, FS_SUFFIX)

typedef double lanes __attribute__((vector_size(8 * FS_LANES)));

static inline lanes lanes_load(const double *p) {
  lanes x;
  memcpy(&x, p, sizeof x);
  return x;
}
static inline void lanes_store(double *p, lanes x) { memcpy(p, &x, sizeof x); }
static inline lanes lanes_spread(double x) { return x - (lanes){0}; }
static inline lanes lanes_sqrt(lanes x) {
  for (int l = 0; l < FS_LANES; l++) x[l] = sqrt(x[l]);
  return x;
}

static inline double lanes_sum(lanes x) {
  double sum = x[0];
  for (int l = 1; l < FS_LANES; l++) sum += x[l];
  return sum;
}

static inline lanes lanes_dot(const lanes *a, const lanes *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* out = scale * a, out += a x b, out = a x b */
static inline void lanes_scale(lanes *out, lanes scale, const lanes *a) {
  for (int i = 0; i < 3; i++) out[i] = scale * a[i];
}
static inline void lanes_add_cross(lanes *out, const lanes *a, const lanes *b) {
  out[0] += a[1] * b[2] - a[2] * b[1];
  out[1] += a[2] * b[0] - a[0] * b[2];
  out[2] += a[0] * b[1] - a[1] * b[0];
}
static inline void lanes_cross(lanes *out, const lanes *a, const lanes *b) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

#endif
