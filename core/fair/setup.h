/* SPDX-License-Identifier: MIT */
/* A functional on a space, ready to be minimised: what fs_fair and fs_fair_energy share. */
#ifndef FS_FAIR_SETUP_H
#define FS_FAIR_SETUP_H

#include "fair/problem.h"
#include "optimise/minimise.h"

enum { FS_MAX_FUNCTIONAL_PARAMS = 8 };

typedef struct fs_setup {
  const fs_functional *functional;
  double param[FS_MAX_FUNCTIONAL_PARAMS];
  fs_scale scale;
  fs_problem *problem;            /* its terms: those of the functional, then what is only measured */
  int32_t term_S, term_Q, term_A; /* numbers of these terms; term_A: FS_NONE where the functional has no area */
} fs_setup;

/* Chooses the functional (also by whether anything is fixed), checks options and parameters, makes the problem at c. */
fs_status fs_setup_create(fs_context *ctx, const fs_space *space, const fs_fair_options *options,
                          const fs_functional *functional, const fs_vec3 *c, fs_setup *setup);
void fs_setup_free(fs_context *ctx, fs_setup *setup);

/* Energies at problem->c; g[3 n_free] receives the gradient. */
fs_status fs_setup_measure(fs_setup *setup, double *g, fs_energy *energy);

/* The setup as an objective for fs_minimise; solver may be NULL where only values are wanted. */
fs_objective fs_setup_objective(fs_setup *setup, fs_solver *solver);

/* Scales the surface at problem->c about its centre of vertices so that its area is this again. */
fs_status fs_setup_restore_area(fs_setup *setup, double area);

/* Weight of Q in the functional at problem->c. */
double fs_setup_c(const fs_setup *setup);

#endif
