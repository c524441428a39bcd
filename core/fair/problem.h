/* SPDX-License-Identifier: MIT */
/* A functional on a space with some dofs fixed: values, gradients and Hessians by the free ones. */
#ifndef FS_FAIR_PROBLEM_H
#define FS_FAIR_PROBLEM_H

#include <fairsurf/fair.h>
#include "fair/kernels.h"
#include "solve/sparse.h"
#include "space/basis.h"

/* Results of one element, made in parallel and added in the order of the elements. */
typedef struct fs_element_result {
  double integral[FS_MAX_TERMS + 2]; /* of each term, unweighted */
  double *gradient;                  /* [n_dofs][3] */
  double *hessian; /* [6][n_padded][n_padded]: component pairs xx xy xz yy yz zz; xx, yy, zz: upper part only */
} fs_element_result;

typedef struct fs_problem {
  fs_context *ctx;
  const fs_space *space;
  int32_t n_terms;
  const fs_density *term[FS_MAX_TERMS + 2];
  double weight[FS_MAX_TERMS + 2];
  const fs_kernels *kernels;
  int32_t level;                       /* 0: all nodes; 1: few, for steps far from the end */
  fs_basis_table **tables[2], **table; /* [space->n_extractions] each; table: those of the level */
  int32_t n_nodes_square, n_nodes_cap;
  int32_t n_free;
  int32_t *unknown;          /* [n_dofs] number among the free dofs, or FS_NONE */
  fs_sparse *pattern;        /* of the Hessian */
  fs_vec3 *c;                /* [n_dofs] the dofs at the last x */
  int32_t n_batch;           /* elements whose results are kept at once */
  fs_element_result *result; /* [n_batch] */
  void **scratch;            /* [workers] */
} fs_problem;

typedef enum fs_order { FS_VALUE, FS_GRADIENT, FS_HESSIAN } fs_order;

/* fixed[n_dofs] or NULL. n_nodes: Gauss nodes per direction on squares and in caps. Weights are the caller's to set later. */
fs_status fs_problem_create(fs_context *ctx, const fs_space *space, int32_t n_terms, const fs_density *const *term,
                            const bool *fixed, int32_t n_nodes_square, int32_t n_nodes_cap, const fs_vec3 *c,
                            fs_problem **problem);

/* Changes the quadrature; the tables of level 1 are made at first use. */
fs_status fs_problem_set_level(fs_problem *problem, int32_t level);
void fs_problem_free(fs_context *ctx, fs_problem *problem); /* NULL is allowed */

/* Integrals of the terms at problem->c, all elements (integral[n_terms]) and those on caps; with order above FS_VALUE also the
   gradient g[3 n_free] and the Hessian of the weighted sum. Unused outputs may be NULL. */
fs_status fs_problem_evaluate(fs_problem *problem, fs_order order, double *integral, double *integral_caps, double *g,
                              fs_sparse *hessian);

/* The free dofs of each element as sets for fs_sparse_create, FS_NONE in the place of others; the caller releases both. */
fs_status fs_problem_sets(fs_problem *problem, int64_t **set_start, int32_t **member);

/* problem->c from the unknowns x[3 n_free], and back. */
void fs_problem_set(fs_problem *problem, const double *x);
void fs_problem_get(const fs_problem *problem, double *x);

/* The face of the first element whose integrals are not finite at problem->c, or FS_NONE. */
fs_status fs_problem_find_singular(fs_problem *problem, int32_t *face);

#endif
