/* SPDX-License-Identifier: MIT */
/* A soft wall at a given distance from a target: forces at samples of the surface that are beyond it, which are learnt until
   they hold it there; and the distance of the whole surface, measured. */
#ifndef FS_FAIR_WALL_H
#define FS_FAIR_WALL_H

#include "fair/problem.h"

/* Values of the functions of an extraction on a grid. */
typedef struct fs_grid_table {
  int32_t n;     /* points per direction, the ends included */
  double *basis; /* [n n][n_dofs] */
} fs_grid_table;

typedef struct fs_wall {
  fs_problem *problem;
  const fs_target *target;
  double limit, stiffness; /* distance of the wall; force per length beyond it */
  fs_grid_table *table;    /* [n_extractions] */
  int64_t *start;          /* [n_elements] first sample of each */
  fs_vec3 *known;          /* [samples] where the distance was found last, */
  double *distance;        /* and what it was; known[].x is NAN before */
  double *force;           /* [samples] at the wall, 0 at first */
  double *value;           /* [n_batch] of the elements of a batch */
  double *number;          /* [n_batch][n_numbers]: gradient [n_dofs][3], then Hessian [n_dofs][n_dofs][6] */
  int32_t n_batch, n_numbers;
} fs_wall;

/* The problem is borrowed. */
fs_status fs_wall_create(fs_problem *problem, const fs_target *target, double limit, fs_wall **wall);
void fs_wall_free(fs_wall *wall); /* NULL is allowed */

/* Adds the function at problem->c to *f, with order above FS_VALUE its derivatives to g[3 n_free] and the Hessian. */
fs_status fs_wall_add(fs_wall *wall, fs_order order, double *f, double *g, fs_sparse *hessian);

/* The forces become those that act at problem->c; *excess is how far a sample is beyond the wall at most. */
fs_status fs_wall_learn(fs_wall *wall, double *excess);

/* The largest distance from the target of the surface at problem->c, on a finer grid and followed to its maximum; and the
   face where it is. */
fs_status fs_wall_measure(fs_wall *wall, double *distance, int32_t *face);

#endif
