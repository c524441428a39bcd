/* SPDX-License-Identifier: MIT */
/* Arithmetic of vectors in space. */
#ifndef FS_MATH_VEC3_H
#define FS_MATH_VEC3_H

#include <fairsurf/base.h>
#include <math.h>

static inline fs_vec3 fs_vec3_add(fs_vec3 a, fs_vec3 b) { return (fs_vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline fs_vec3 fs_vec3_sub(fs_vec3 a, fs_vec3 b) { return (fs_vec3){a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline fs_vec3 fs_vec3_scale(fs_vec3 a, double s) { return (fs_vec3){s * a.x, s * a.y, s * a.z}; }

/* a + s b */
static inline fs_vec3 fs_vec3_add_scaled(fs_vec3 a, fs_vec3 b, double s) {
  return (fs_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static inline double fs_vec3_dot(fs_vec3 a, fs_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline fs_vec3 fs_vec3_cross(fs_vec3 a, fs_vec3 b) {
  return (fs_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double fs_vec3_length(fs_vec3 a) { return sqrt(fs_vec3_dot(a, a)); }
static inline double fs_vec3_distance(fs_vec3 a, fs_vec3 b) { return fs_vec3_length(fs_vec3_sub(a, b)); }
static inline bool fs_vec3_is_finite(fs_vec3 a) { return isfinite(a.x) && isfinite(a.y) && isfinite(a.z); }

/* Angle between two vectors in [0, pi], precise near both ends; 0 where one of them is zero. */
static inline double fs_vec3_angle(fs_vec3 a, fs_vec3 b) {
  return atan2(fs_vec3_length(fs_vec3_cross(a, b)), fs_vec3_dot(a, b));
}

static inline fs_vec3 fs_vec3_min(fs_vec3 a, fs_vec3 b) {
  return (fs_vec3){fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z)};
}
static inline fs_vec3 fs_vec3_max(fs_vec3 a, fs_vec3 b) {
  return (fs_vec3){fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z)};
}

#endif
