/* SPDX-License-Identifier: MIT */
/* Data of Coons patches from a surface that is known in closed form:
   F(u, v) = (u + .3 sin 1.3u sin 1.7v, v + .2 e^(.7u) sin 1.1v, .5 e^(.9u - .6v) + .4 sin 2u e^(.8v)). */
#ifndef FS_TEST_COONS_SAMPLES_H
#define FS_TEST_COONS_SAMPLES_H

#include <fairsurf/construct.h>
#include "math/vec3.h"

/* Derivatives of order k of e^(a t) and sin(a t), and of t. */
static inline double sample_exp(double a, double t, int k) { return pow(a, k) * exp(a * t); }
static inline double sample_sin(double a, double t, int k) {
  return pow(a, k) * sin(a * t + k * 1.57079632679489661923);
}
static inline double sample_linear(double t, int k) { return k == 0 ? t : k == 1; }

/* Derivative of order (p, q) of F. */
static inline fs_vec3 sample_F(double u, double v, int p, int q) {
  return (fs_vec3){(q == 0) * sample_linear(u, p) + 0.3 * sample_sin(1.3, u, p) * sample_sin(1.7, v, q),
                   (p == 0) * sample_linear(v, q) + 0.2 * sample_exp(0.7, u, p) * sample_sin(1.1, v, q),
                   0.5 * sample_exp(0.9, u, p) * sample_exp(-0.6, v, q) +
                       0.4 * sample_sin(2, u, p) * sample_exp(0.8, v, q)};
}

/* The square corner + size [0, 1]^2 of a surface, moved by an affine map. */
typedef struct sample_square {
  fs_vec3 (*surface)(double u, double v, int p, int q);
  double u, v, size;
  fs_vec3 column[3], shift; /* of the map; all zero: the identity */
} sample_square;

static inline fs_vec3 sample_value(const sample_square *s, double u, double v, int p, int q) {
  fs_vec3 x = fs_vec3_scale(s->surface(s->u + s->size * u, s->v + s->size * v, p, q), pow(s->size, p + q));
  if (fs_vec3_length(s->column[0]) == 0) return x;
  fs_vec3 y = fs_vec3_add_scaled(fs_vec3_scale(s->column[0], x.x), s->column[1], x.y);
  y = fs_vec3_add_scaled(y, s->column[2], x.z);
  return p + q == 0 ? fs_vec3_add(y, s->shift) : y;
}

typedef struct sample_line {
  const sample_square *square;
  int a; /* number of the data */
  bool is_v;
  fs_vec3 bump; /* times t (1 - t)^2 is added */
} sample_line;

static inline void sample_line_evaluate(const void *user, double t, fs_vec3 x[4]) {
  const sample_line *l = user;
  const double bump[4] = {t * (1 - t) * (1 - t), (1 - t) * (1 - t) - 2 * t * (1 - t), -4 * (1 - t) + 2 * t, 6};
  for (int k = 0; k < 4; k++) {
    x[k] =
        l->is_v ? sample_value(l->square, t, l->a % 2, k, l->a / 2) : sample_value(l->square, l->a % 2, t, l->a / 2, k);
    x[k] = fs_vec3_add_scaled(x[k], l->bump, bump[k]);
  }
}

/* line[2][6]: of at_u, of at_v; square must outlive them. */
static inline fs_coons_data sample_coons(const sample_square *square, int n_data, sample_line line[2][6]) {
  fs_coons_data data = {.n_data = n_data};
  for (int a = 0; a < n_data; a++) {
    line[0][a] = (sample_line){.square = square, .a = a};
    line[1][a] = (sample_line){.square = square, .a = a, .is_v = true};
    data.at_u[a] = (fs_curve){sample_line_evaluate, &line[0][a]};
    data.at_v[a] = (fs_curve){sample_line_evaluate, &line[1][a]};
  }
  return data;
}

#endif
