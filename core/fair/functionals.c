/* SPDX-License-Identifier: MIT */
/* Single role: the table of functionals, and the densities they are made of. */
#include "fair/kernels.h"

#include <string.h>

/* ---- densities: the kernels of this processor ---- */

static void curvature_variation(const double *x, double *f, double *df, double *ddf) {
  fs_kernels_choose()->curvature_variation(x, f, df, ddf);
}
static void tangential(const double *x, double *f, double *df, double *ddf) {
  fs_kernels_choose()->tangential(x, f, df, ddf);
}
static void triharmonic(const double *x, double *f, double *df, double *ddf) {
  fs_kernels_choose()->triharmonic(x, f, df, ddf);
}

/* Pairs of second derivatives that can differ from zero: those of p_uuu + p_uvv, of p_uuv + p_vvv, and with p_u, p_v. */
#define PAIR(i, j) (UINT64_C(1) << ((i)*9 - (i) * ((i)-1) / 2 + (j) - (i)))
#define OF_SUMS (PAIR(5, 5) | PAIR(5, 7) | PAIR(7, 7) | PAIR(6, 6) | PAIR(6, 8) | PAIR(8, 8))
#define WITH(i) (PAIR(i, 5) | PAIR(i, 6) | PAIR(i, 7) | PAIR(i, 8))
#define OF_NORMAL (PAIR(0, 0) | PAIR(0, 1) | PAIR(1, 1) | WITH(0) | WITH(1))

const fs_density fs_density_curvature_variation = {.name = "curvature-variation",
                                                   .summary = "|grad_M H|^2 dM, H = mean curvature",
                                                   .order = 3,
                                                   .is_geometric = true,
                                                   .evaluate = curvature_variation};
const fs_density fs_density_tangential = {.name = "tangential",
                                          .summary =
                                              "tangential part of |grad Laplace p|^2: keeps the parametrisation even",
                                          .order = 3,
                                          .zero_pairs = ~(OF_SUMS | OF_NORMAL),
                                          .evaluate = tangential};
const fs_density fs_density_triharmonic = {.name = "triharmonic",
                                           .summary = "|grad Laplace p|^2",
                                           .order = 3,
                                           .is_quadratic = true,
                                           .zero_pairs = ~OF_SUMS,
                                           .evaluate = triharmonic};

/* ---- functionals ---- */

static void weight_one(const double *param, const fs_scale *scale, double *weight) {
  (void)param, (void)scale;
  weight[0] = 1;
}

/* F = S + c Q, c = C n^2 / D^4: n squares, D the largest distance between fixed vertices [Kiciak 2013]. */
static void weight_penalised(const double *param, const fs_scale *scale, double *weight) {
  double n = scale->n_squares, d2 = scale->diameter * scale->diameter;
  weight[0] = 1;
  weight[1] = d2 > 0 ? param[0] * n * n / (d2 * d2) : 0;
}

static const fs_param no_params[] = {{0}};
static const fs_param penalised_params[] = {
    {"C", "weight of Q before scaling by (number of squares)^2 / (largest distance of fixed vertices)^4", 0.01, 0, 1e6, NULL},
    {0}};

static const fs_functional penalised = {"penalised",
                                        "F = S + c Q: curvature variation and a penalty on uneven parametrisation",
                                        penalised_params,
                                        2,
                                        {&fs_density_curvature_variation, &fs_density_tangential},
                                        weight_penalised};
static const fs_functional curvature = {"curvature-variation",
                                        "S: the integral of |grad_M H|^2; depends on the shape only",
                                        no_params,
                                        1,
                                        {&fs_density_curvature_variation},
                                        weight_one};
static const fs_functional harmonic = {"triharmonic",
                                       "the integral of |grad Laplace p|^2: quadratic, depends on the parametrisation",
                                       no_params,
                                       1,
                                       {&fs_density_triharmonic},
                                       weight_one};

const fs_functional *const fs_functionals[] = {&penalised, &curvature, &harmonic, NULL};

const fs_functional *fs_functional_find(const char *name) {
  for (int i = 0; fs_functionals[i] != NULL; i++)
    if (strcmp(fs_functionals[i]->name, name) == 0) return fs_functionals[i];
  return NULL;
}
