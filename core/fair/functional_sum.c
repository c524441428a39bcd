/* SPDX-License-Identifier: MIT */
/* Single role: weighted sums of the integrals there are, each made free of units by the size D of what is fixed, so that
   weights mean the same for a ring and for a ship:

     a S D^2 + b W + c A / D^2 + d P / D^2 + e T / D^2 + C n^2 Q / D^2
   S curvature variation, W Willmore, A area, P thin plate, T triharmonic, Q keeps the parametrisation even; n squares. Where
   nothing is fixed the area takes the place of D^2; its own term is then constant and says nothing. */
#include "fair/functional_sum.h"

enum { BY_C, BY_S, BY_W, BY_A, BY_P, BY_T };             /* parameters */
enum { TERM_S, TERM_Q, TERM_W, TERM_P, TERM_T, TERM_A }; /* integrals */

static void sum(const double *param, const fs_scale *scale, const double *integral, double *value, double *derivative) {
  double n = scale->n_squares, d2 = scale->diameter * scale->diameter, by_d2 = d2 > 0 ? 1 / d2 : 0;
  derivative[TERM_S] = param[BY_S] * d2;
  derivative[TERM_Q] = param[BY_C] * n * n * by_d2;
  derivative[TERM_W] = param[BY_W];
  derivative[TERM_P] = param[BY_P] * by_d2;
  derivative[TERM_T] = param[BY_T] * by_d2;
  derivative[TERM_A] = param[BY_A] * by_d2;
  *value = 0;
  for (int t = TERM_S; t <= TERM_A; t++) *value += derivative[t] * integral[t];
}

static void scale_free_sum(const double *param, const fs_scale *scale, const double *integral, double *value,
                           double *derivative) {
  double n = scale->n_squares, A = integral[TERM_A];
  double by_A =
      (param[BY_C] * n * n * integral[TERM_Q] + param[BY_P] * integral[TERM_P] + param[BY_T] * integral[TERM_T]) / A;
  derivative[TERM_S] = param[BY_S] * A;
  derivative[TERM_Q] = param[BY_C] * n * n / A;
  derivative[TERM_W] = param[BY_W];
  derivative[TERM_P] = param[BY_P] / A;
  derivative[TERM_T] = param[BY_T] / A;
  derivative[TERM_A] = param[BY_S] * integral[TERM_S] - by_A / A;
  *value = param[BY_S] * integral[TERM_S] * A + param[BY_W] * integral[TERM_W] + by_A;
}

static const fs_param params[] = {
    {"C", "weight of Q, which keeps the parametrisation even; lowered to this in steps", 1e-4, 0, 1e6, NULL},
    {"curvature-variation", "weight of S", 1, 0, 1e9, NULL},
    {"willmore", "weight of the integral of H^2", 0, 0, 1e9, NULL},
    {"area", "weight of the area", 0, 0, 1e9, NULL},
    {"thin-plate", "weight of the thin plate energy", 0, 0, 1e9, NULL},
    {"triharmonic", "weight of the triharmonic energy", 0, 0, 1e9, NULL},
    {0}};

#define TERMS                                                                                              \
  {                                                                                                        \
    &fs_density_curvature_variation, &fs_density_tangential, &fs_density_willmore, &fs_density_thin_plate, \
        &fs_density_triharmonic, &fs_density_area                                                          \
  }

const fs_functional fs_functional_scale_free_sum = {
    .name = "scale-free-sum",
    .summary = "the same for surfaces of which nothing is fixed, keeps the area",
    .params = params,
    .n_terms = 6,
    .term = TERMS,
    .combine = scale_free_sum,
    .is_scale_free = true,
    .is_continued = true};
const fs_functional fs_functional_sum = {
    .name = "sum",
    .summary = "weighted sum of curvature variation, Willmore, area, thin plate, triharmonic; free of units",
    .params = params,
    .n_terms = 6,
    .term = TERMS,
    .combine = sum,
    .is_linear = true,
    .is_continued = true,
    .when_nothing_is_fixed = &fs_functional_scale_free_sum};
