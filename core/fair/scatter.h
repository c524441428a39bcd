/* SPDX-License-Identifier: MIT */
/* From Hessians of elements to that of all unknowns. */
#ifndef FS_FAIR_SCATTER_H
#define FS_FAIR_SCATTER_H

#include "fair/problem.h"

/* Fills list and place of an element: its unknowns, those of the reduction where there is one, ascending. */
void fs_element_list(const fs_problem *problem, const fs_element *element, int32_t n_dofs, fs_element_result *result);

/* result->matrix = result->reduced = T^T result->hessian T with the rows of the reduction for the dofs of the element;
   work[n_dofs * (n_list padded to 8) + m_padded * (n_list padded to 8)]. */
void fs_element_reduce(const fs_problem *problem, const fs_element *element, int32_t n_dofs, int32_t m_padded,
                       double *work, fs_element_result *result);

/* The same as fs_element_list for the unknowns of a coarse square, FS_NONE: none. */
void fs_square_list(const int32_t unknown[16], fs_element_result *result);

/* Adds the first n results of the problem to the Hessian. */
fs_status fs_scatter_hessians(const fs_problem *problem, int32_t n, fs_sparse *hessian);

#endif
