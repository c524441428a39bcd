/* SPDX-License-Identifier: MIT */
/* Minimisation of a smooth function of many numbers. Knows no geometry. */
#ifndef FS_OPTIMISE_MINIMISE_H
#define FS_OPTIMISE_MINIMISE_H

#include "solve/solver.h"

/* What a method sees of a problem: 3 n unknowns in groups of three, whose Hessian has the pattern of a block matrix.
   A value that is not finite means "not in the domain" and is never accepted; at the start it is an error. */
typedef struct fs_objective {
  int32_t n;                /* groups of three */
  const fs_sparse *pattern; /* of the Hessian */
  fs_solver *solver;        /* made for that pattern */
  void *self;
  fs_status (*gradient)(void *self, const double *x, double *f, double *g);
  /* The Hessian, or something near to it; f and g[3 n] are room for by-products that nobody uses. */
  fs_status (*hessian)(void *self, const double *x, double *f, double *g, fs_sparse *hessian);
  /* A vector v[3 n] to which steps stay orthogonal; NULL: none. The Hessian need only be right on such steps. */
  fs_status (*normal)(void *self, const double *x, double *v);
  /* The matrix by which steps from x are damped, semidefinite, on the pattern of the Hessian, valid until the next call; NULL:
     the diagonal of the Hessian. */
  fs_status (*metric)(void *self, const double *x, const fs_sparse **metric);
} fs_objective;

typedef enum fs_minimise_stop {
  FS_MINIMISE_GRADIENT,
  FS_MINIMISE_STEP,
  FS_MINIMISE_DECREASE,
  FS_MINIMISE_ITERATIONS,
  FS_MINIMISE_CANCELLED
} fs_minimise_stop;

typedef struct fs_minimise_step {
  int32_t number, n_factorisations;
  double value, gradient, damping, length, gain;
} fs_minimise_step;

/* The damping that the next step begins with, relative to the metric: 1 far from a minimum, 0 near. */
typedef struct fs_damping {
  double nu, nu_failed; /* nu_failed: memory of damping that did not suffice, 0 at first */
  double nu_factored;   /* that of the last factorisation */
  bool is_factored; /* the solver holds a factorisation of a similar function from near the start: it is tried first */
} fs_damping;

typedef struct fs_minimise_options {
  int32_t max_iterations;    /* accepted steps */
  double gradient_tolerance; /* |g| relative to gradient_start; 0: stop by the decrease alone */
  double gradient_start;     /* 0: the gradient at x */
  double decrease_tolerance; /* predicted decrease relative to |f| */
  fs_damping *damping;       /* in and out */
  bool is_newton;            /* every step has a Hessian of its own: quadratic convergence near the minimum */
  double least_damping;      /* relative to the diagonal; above 0 where the minimum is not isolated: rigid motions */
  bool (*monitor)(void *user, const fs_minimise_step *step); /* after every accepted step; false cancels; may be NULL */
  void *user;
} fs_minimise_options;

typedef struct fs_minimise_report {
  fs_minimise_stop stop;
  int32_t n_steps, n_hessians, n_factorisations;
  double value, gradient;
} fs_minimise_report;

/* x[3 n]: in the start, out the minimum, or the best point met. */
fs_status fs_minimise(fs_context *ctx, const fs_objective *objective, const fs_minimise_options *options, double *x,
                      fs_minimise_report *report);

/* A Hessian that this much of its diagonal makes positive definite counts as definite. */
#define FS_DEFINITE_DAMPING 1e-9

/* What fs_leave_saddle found. */
typedef struct fs_saddle_report {
  bool has_moved;   /* x was no minimum: it lies lower now */
  double curvature; /* least eigenvalue of the Hessian relative to its diagonal; 0: not looked for, none is negative */
  double decrease;  /* of the value */
  int32_t n_factorisations;
} fs_saddle_report;

/* At a stationary point x[3 n]: moves along the direction of least curvature where that is negative, so that a minimisation
   may go on from there with a damping of *nu. A minimum stays. The solver's factorisation is lost. */
fs_status fs_leave_saddle(fs_context *ctx, const fs_objective *objective, double *nu, double *x,
                          fs_saddle_report *report);

#endif
