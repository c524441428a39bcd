/* SPDX-License-Identifier: MIT */
/* Single role: the table of functionals, and the densities they are made of. */
#include "fair/functional_sum.h"
#include "fair/kernels.h"
#include "fair/low_order.h"

#include <string.h>

/* ---- densities: the kernels of this processor ---- */

static void curvature_variation(const double *x, double *f, double *df, double *ddf) {
  fs_kernels_choose()->curvature_variation(x, f, df, ddf);
}
static void tangential(const double *x, double *f, double *df, double *ddf) {
  fs_kernels_choose()->tangential(x, f, df, ddf);
}
static void tangential_held(const double *x, double *f, double *df, double *ddf) {
  fs_kernels_choose()->tangential_held(x, f, df, ddf);
}
static void triharmonic(const double *x, double *f, double *df, double *ddf) {
  fs_kernels_choose()->triharmonic(x, f, df, ddf);
}

const fs_density fs_density_curvature_variation = {.name = "curvature-variation",
                                                   .summary = "|grad_M H|^2 dM, H = mean curvature",
                                                   .order = 3,
                                                   .is_geometric = true,
                                                   .evaluate = curvature_variation};
const fs_density fs_density_tangential = {.name = "tangential",
                                          .summary =
                                              "tangential part of |grad Laplace p|^2: keeps the parametrisation even",
                                          .order = 3,
                                          .zero_pairs = ~(FS_PAIRS_TANGENTIAL),
                                          .evaluate = tangential};
const fs_density fs_density_tangential_held = {.name = "tangential-held",
                                               .summary = "the same with the normals held",
                                               .order = 3,
                                               .zero_pairs = ~(FS_PAIRS_TRIHARMONIC),
                                               .evaluate = tangential_held};
const fs_density fs_density_triharmonic = {.name = "triharmonic",
                                           .summary = "|grad Laplace p|^2",
                                           .order = 3,
                                           .is_quadratic = true,
                                           .zero_pairs = ~(FS_PAIRS_TRIHARMONIC),
                                           .evaluate = triharmonic};

const fs_density fs_density_thin_plate = {.name = "thin-plate",
                                          .summary = "|p_uu|^2 + 2 |p_uv|^2 + |p_vv|^2",
                                          .order = 2,
                                          .is_quadratic = true,
                                          .evaluate = fs_thin_plate};
const fs_density fs_density_willmore = {
    .name = "willmore", .summary = "H^2 dM", .order = 2, .is_geometric = true, .evaluate = fs_willmore};
const fs_density fs_density_area = {
    .name = "area", .summary = "dM", .order = 1, .is_geometric = true, .evaluate = fs_area};

/* ---- functionals ---- */

static void only_the_first(const double *param, const fs_scale *scale, const double *integral, double *value,
                           double *derivative) {
  (void)param, (void)scale;
  *value = integral[0];
  derivative[0] = 1;
}

/* F = S + c Q, c = C n^2 / D^4: n squares, D the largest distance between fixed vertices [Kiciak 2013]. */
static void penalised(const double *param, const fs_scale *scale, const double *integral, double *value,
                      double *derivative) {
  double n = scale->n_squares, d2 = scale->diameter * scale->diameter;
  derivative[0] = 1;
  derivative[1] = d2 > 0 ? param[0] * n * n / (d2 * d2) : 0;
  *value = integral[0] + derivative[1] * integral[1];
}

/* The same with Q scaled to the dimension of the first integral: length^0 for Willmore, length^2 for the area. */
static void willmore_penalised(const double *param, const fs_scale *scale, const double *integral, double *value,
                               double *derivative) {
  double n = scale->n_squares, d2 = scale->diameter * scale->diameter;
  derivative[0] = 1;
  derivative[1] = d2 > 0 ? param[0] * n * n / d2 : 0;
  *value = integral[0] + derivative[1] * integral[1];
}
static void area_penalised(const double *param, const fs_scale *scale, const double *integral, double *value,
                           double *derivative) {
  double n = scale->n_squares;
  derivative[0] = 1;
  derivative[1] = param[0] * n * n;
  *value = integral[0] + derivative[1] * integral[1];
}

/* F = S A + C n^2 Q / A */
static void scale_free(const double *param, const fs_scale *scale, const double *integral, double *value,
                       double *derivative) {
  double S = integral[0], Q = integral[1], A = integral[2], n = scale->n_squares, c = param[0] * n * n / A;
  *value = S * A + c * Q;
  derivative[0] = A;
  derivative[1] = c;
  derivative[2] = S - c * Q / A;
}

/* F = W + C n^2 Q / A */
static void scale_free_willmore(const double *param, const fs_scale *scale, const double *integral, double *value,
                                double *derivative) {
  double n = scale->n_squares, c = param[0] * n * n / integral[2];
  *value = integral[0] + c * integral[1];
  derivative[0] = 1;
  derivative[1] = c;
  derivative[2] = -c * integral[1] / integral[2];
}

static const char C_summary[] =
    "weight of Q, times (squares)^2 / (largest distance of fixed vertices)^4, or / area where nothing is fixed";
static const fs_param penalty[] = {{"C", C_summary, 0.01, 0, 1e6, NULL}, {0}};
static const fs_param small_penalty[] = {{"C", C_summary, 1e-4, 0, 1e6, NULL}, {0}};

static const fs_functional functional_scale_free = {
    .name = "scale-free",
    .summary = "S A + C n^2 Q / A for surfaces of which nothing is fixed; C lowered in steps, keeps the area",
    .params = small_penalty,
    .n_terms = 3,
    .term = {&fs_density_curvature_variation, &fs_density_tangential, &fs_density_area},
    .combine = scale_free,
    .is_scale_free = true,
    .is_continued = true};
static const fs_functional functional_scale_free_penalised = {
    .name = "scale-free-penalised",
    .summary = "S A + C n^2 Q / A with C as given",
    .params = penalty,
    .n_terms = 3,
    .term = {&fs_density_curvature_variation, &fs_density_tangential, &fs_density_area},
    .combine = scale_free,
    .is_scale_free = true};
static const fs_functional functional_penalised = {
    .name = "penalised",
    .summary = "F = S + c Q: curvature variation and a penalty on uneven parametrisation",
    .params = penalty,
    .n_terms = 2,
    .term = {&fs_density_curvature_variation, &fs_density_tangential},
    .combine = penalised,
    .is_linear = true,
    .when_nothing_is_fixed = &functional_scale_free_penalised};
static const fs_functional functional_curvature_variation = {
    .name = "curvature-variation",
    .summary = "S, the integral of |grad_M H|^2: F with C lowered in steps",
    .params = small_penalty,
    .n_terms = 2,
    .term = {&fs_density_curvature_variation, &fs_density_tangential},
    .combine = penalised,
    .is_linear = true,
    .is_continued = true,
    .when_nothing_is_fixed = &functional_scale_free};
static const fs_functional functional_triharmonic = {
    .name = "triharmonic",
    .summary = "the integral of |grad Laplace p|^2: linear, depends on the parametrisation",
    .n_terms = 1,
    .term = {&fs_density_triharmonic},
    .combine = only_the_first,
    .is_linear = true};
static const fs_functional functional_thin_plate = {
    .name = "thin-plate",
    .summary = "the integral of |p_uu|^2 + 2 |p_uv|^2 + |p_vv|^2: linear, depends on the parametrisation",
    .n_terms = 1,
    .term = {&fs_density_thin_plate},
    .combine = only_the_first,
    .is_linear = true};
static const fs_functional functional_scale_free_willmore = {
    .name = "scale-free-willmore",
    .summary = "the integral of H^2 and C n^2 Q / A for surfaces of which nothing is fixed; keeps the area",
    .params = penalty,
    .n_terms = 3,
    .term = {&fs_density_willmore, &fs_density_tangential, &fs_density_area},
    .combine = scale_free_willmore,
    .is_scale_free = true,
    .is_continued = true};
static const fs_functional functional_willmore = {.name = "willmore",
                                                  .summary =
                                                      "the integral of H^2, and a penalty on uneven parametrisation",
                                                  .params = penalty,
                                                  .n_terms = 2,
                                                  .term = {&fs_density_willmore, &fs_density_tangential},
                                                  .combine = willmore_penalised,
                                                  .is_linear = true,
                                                  .is_continued = true,
                                                  .when_nothing_is_fixed = &functional_scale_free_willmore};
static const fs_functional functional_area = {.name = "area",
                                              .summary = "the area, and a penalty on uneven parametrisation",
                                              .params = penalty,
                                              .n_terms = 2,
                                              .term = {&fs_density_area, &fs_density_tangential},
                                              .combine = area_penalised,
                                              .is_linear = true,
                                              .is_continued = true};

const fs_functional *const fs_functionals[] = {&functional_curvature_variation,
                                               &functional_penalised,
                                               &functional_scale_free,
                                               &functional_scale_free_penalised,
                                               &functional_willmore,
                                               &functional_scale_free_willmore,
                                               &functional_area,
                                               &functional_triharmonic,
                                               &functional_thin_plate,
                                               &fs_functional_sum,
                                               &fs_functional_scale_free_sum,
                                               NULL};

const fs_functional *fs_functional_find(const char *name) {
  for (int i = 0; fs_functionals[i] != NULL; i++)
    if (strcmp(fs_functionals[i]->name, name) == 0) return fs_functionals[i];
  return NULL;
}
