/* SPDX-License-Identifier: MIT */
/* A functional on a space, ready to be minimised: what fs_fair and fs_fair_energy share. */
#ifndef FS_FAIR_SETUP_H
#define FS_FAIR_SETUP_H

#include "fair/wall.h"
#include "fair/problem.h"
#include "fair/reduce.h"
#include "fair/volume.h"
#include "optimise/minimise.h"

enum { FS_MAX_FUNCTIONAL_PARAMS = 8 };

typedef struct fs_setup {
  const fs_functional *functional;
  double param[FS_MAX_FUNCTIONAL_PARAMS];
  fs_scale scale;
  fs_problem *problem;            /* its terms: those of the functional, then what is only measured */
  int32_t term_S, term_Q, term_A; /* numbers of these terms; term_A: FS_NONE where the functional has no area */
  fs_reduction *reduction;        /* of the free dofs to fewer unknowns; NULL: the unknowns are the free dofs */
  fs_sparse *reduced;             /* pattern of their Hessian */
  /* Where the functional sees all nodes, Hessians may be integrated with fewer, since gradients correct the steps: so many with
     few nodes, and those after them with nearly all. */
  bool has_near_hessians;
  int32_t n_cheap_hessians;
  bool has_metric;  /* steps are damped by the Hessian of Q; only where fs_setup_metric_weight is above 0 */
  fs_sparse metric; /* that of the unknowns, made at first use; value NULL: not yet */
  fs_costs costs;
  fs_volume *volume; /* where it is kept, V^(2/3) times volume_factor stands for the area in the functional; or NULL */
  double volume_sign, volume_factor;
  fs_wall *wall;      /* added to the functional; or NULL */
  fs_volume *normals; /* where dofs move along normals: these are gradients of it; or NULL */
  double *x, *g;      /* [3 n_free] with a reduction: the free dofs and their gradient */
} fs_setup;

/* The scale of the problem, and whether places are given at all: then the functional may depend on size and place, else it
   must not. FS_ERR_UNSUPPORTED where constraints give places, but not the size. */
fs_status fs_scale_find(fs_context *ctx, const fs_space *space, const fs_fair_options *options, const fs_vec3 *c,
                        fs_scale *scale, bool *is_fixed);

/* The functional that options ask for. */
const fs_functional *fs_setup_functional(const fs_fair_options *options);

/* Chooses the functional (also by whether anything is fixed), checks options and parameters, makes the problem at c. */
fs_status fs_setup_create(fs_context *ctx, const fs_space *space, const fs_fair_options *options,
                          const fs_functional *functional, const fs_vec3 *c, fs_setup *setup);
void fs_setup_free(fs_context *ctx, fs_setup *setup);

/* From now on the unknowns are those of the reduction, whose rows are the free dofs of the problem; the setup owns it, also
   on failure. NULL: the free dofs again. */
fs_status fs_setup_reduce(fs_setup *setup, fs_reduction *reduction);

/* Borrows the reduction of another setup with the same free dofs; from NULL: gives it back. */
void fs_setup_share(fs_setup *setup, const fs_setup *from);

/* Groups of three unknowns, and the pattern of their Hessian. */
int32_t fs_setup_n(const fs_setup *setup);
const fs_sparse *fs_setup_pattern(const fs_setup *setup);

/* problem->c at the unknowns y[3 fs_setup_n]. */
void fs_setup_place(fs_setup *setup, const double *y);

/* Energies at problem->c; g[3 n_free] receives the gradient. */
fs_status fs_setup_measure(fs_setup *setup, double *g, fs_energy *energy);

/* Weight of Q in the metric by which steps may be damped (docs/decisions/0017); 0: there is none. */
double fs_setup_metric_weight(const fs_setup *setup);

/* The setup as an objective for fs_minimise; solver may be NULL where only values are wanted. */
fs_objective fs_setup_objective(fs_setup *setup, fs_solver *solver);

/* Keeps the volume at problem->c instead of the area. */
fs_status fs_setup_keep_volume(fs_setup *setup);

/* The area at problem->c, with more nodes than the functional has; or the volume where that is kept. */
fs_status fs_setup_size(fs_setup *setup, double *size);

/* Scales the surface at problem->c about its centre of vertices so that its area or volume is this again. */
fs_status fs_setup_restore_size(fs_setup *setup, double size);

/* Weight of Q in the functional at problem->c. */
double fs_setup_c(const fs_setup *setup);

#endif
