/* SPDX-License-Identifier: MIT */
/* A functional on a space with some dofs fixed: values, gradients and Hessians by the free ones. */
#ifndef FS_FAIR_PROBLEM_H
#define FS_FAIR_PROBLEM_H

#include <fairsurf/fair.h>
#include "fair/kernels.h"
#include "fair/reduce.h"
#include "solve/sparse.h"
#include "space/basis.h"

typedef enum fs_order { FS_VALUE, FS_GRADIENT, FS_HESSIAN } fs_order;

/* Results of one element, made in parallel and added in the order of the elements. */
typedef struct fs_element_result {
  fs_order order;                    /* what was asked for, FS_VALUE where no dof is free */
  double integral[FS_MAX_TERMS + 2]; /* of each term, unweighted */
  double *gradient;                  /* [n_dofs][3] */
  double *hessian;       /* [6][n_padded][n_padded]: component pairs xx xy xz yy yz zz; xx, yy, zz: upper part only */
  double *reduced;       /* the same by the unknowns of a reduction, n_list of them */
  int32_t n_list;        /* unknowns of the element */
  int32_t *list, *place; /* [n_list] ascending, and the rows of the matrix where they stand */
  const double *matrix;  /* hessian or reduced */
  int32_t n_matrix;      /* its rows */
} fs_element_result;

/* How many quadrature nodes: all; few, for steps far from the end; still fewer, for displacements of coarser meshes; and nearly
   all, for the Hessians of the last steps, whose gradients see all. */
enum { FS_NODES_ALL, FS_NODES_FEW, FS_NODES_LEAST, FS_NODES_NEARLY_ALL, FS_N_NODES };

typedef struct fs_problem {
  fs_context *ctx;
  const fs_space *space;
  int32_t n_terms;
  const fs_density *term[FS_MAX_TERMS + 2];
  fs_sum_kernel *sum[FS_MAX_TERMS + 2]; /* that adds the term by (u, v), or NULL */
  double weight[FS_MAX_TERMS + 2];
  const fs_kernels *kernels;
  int32_t level;                                /* one of fs_nodes */
  fs_basis_table **tables[FS_N_NODES], **table; /* [space->n_extractions] each; table: those of the level */
  int32_t n_nodes_square, n_nodes_cap;
  int32_t n_free;
  int32_t *unknown;              /* [n_dofs] number among the free dofs, or FS_NONE */
  fs_sparse *pattern;            /* of the Hessian */
  const fs_reduction *reduction; /* borrowed: Hessians are those by its unknowns; NULL: by the free dofs */
  double *square_axis;        /* with coarse squares: [n_side][FS_TENSOR_KEPT_ROWS][4][4], functions of its unknowns */
  size_t n_largest, n_listed; /* the most dofs of an element, padded; the unknowns that a list has room for */
  fs_vec3 *c;                 /* [n_dofs] the dofs at the last x */
  int32_t n_batch;            /* elements whose results are kept at once */
  fs_element_result *result;  /* [n_batch] */
  void **scratch;             /* [workers] */
  double **work;              /* [workers] with a reduction: [2 n_largest][the most of its unknowns in an element] */
} fs_problem;

/* fixed[n_dofs] or NULL. n_nodes: Gauss nodes per direction on squares and in caps. Weights are the caller's to set later. */
fs_status fs_problem_create(fs_context *ctx, const fs_space *space, int32_t n_terms, const fs_density *const *term,
                            const bool *fixed, int32_t n_nodes_square, int32_t n_nodes_cap, const fs_vec3 *c,
                            fs_problem **problem);

/* Changes the quadrature; the tables of other levels than 0 are made at first use. */
fs_status fs_problem_set_level(fs_problem *problem, int32_t level);
void fs_problem_free(fs_context *ctx, fs_problem *problem); /* NULL is allowed */

/* Hessians are made by the unknowns of a reduction with weights, element by element; its pattern must be that of the Hessian.
   NULL: by the free dofs. */
fs_status fs_problem_reduce(fs_problem *problem, const fs_reduction *reduction);

/* Integrals of the terms at problem->c, all elements (integral[n_terms]) and those on caps; with order above FS_VALUE also the
   gradient g[3 n_free] and the Hessian of the weighted sum. Unused outputs may be NULL; a Hessian by the unknowns of a reduction
   comes without gradient, g NULL. */
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
