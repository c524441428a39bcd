/* SPDX-License-Identifier: MIT */
/* How the damping nu of H + nu D follows what was tried. */
#ifndef FS_OPTIMISE_DAMPING_H
#define FS_OPTIMISE_DAMPING_H

#include <stdbool.h>

typedef struct fs_nu {
  double now, least;
  double failed;  /* memory of what did not suffice, 0: nothing */
  double good;    /* of a metric: that of the last accepted step */
  double growth;  /* by which the next rejected step raises it */
  bool of_metric; /* D is the metric of the objective, not the diagonal of its Hessian */
} fs_nu;

/* After an accepted step. has_failed: it took several factorisations; is_near: little more is to be gained. */
void fs_nu_lower(fs_nu *nu, double gain, bool has_failed, bool is_near);

/* The matrix was not definite, or the step was rejected. */
void fs_nu_raise_indefinite(fs_nu *nu);
void fs_nu_raise_rejected(fs_nu *nu);

#endif
