/* SPDX-License-Identifier: MIT */
/* Squares of a coarser mesh under displacements of it: where all is regular, the elements within one square depend on its
   sixteen unknowns alone, and their Hessians add up before any other sum. */
#ifndef FS_FAIR_COARSE_SQUARES_H
#define FS_FAIR_COARSE_SQUARES_H

#include "fair/problem.h"

typedef struct fs_coarse_squares {
  int32_t n, n_side;      /* squares, and elements along a side of one: 2^depth */
  int32_t (*unknown)[16]; /* [n] columns of the reduction, u fastest, or FS_NONE */
  int32_t *element;       /* [n][n_side][n_side], u fastest */
  uint8_t *turn;          /* the same shape: quarter turns from the element to the square */
  int32_t n_loose;
  int32_t *loose;    /* [n_loose] elements that are in no square, ascending */
  double (*mask)[4]; /* [n_side + 3] a row of dofs of the mesh within the square by four of the coarser mesh */
} fs_coarse_squares;

/* The squares of a coarser mesh, depth refinements before the mesh of the problem: origin[coarse->n_vertices] are the numbers
   of its vertices there, number[] those of its unknowns, or FS_NONE. A square is only one if the rows of the reduction say so,
   to rounding. */
fs_status fs_coarse_squares_find(const fs_problem *problem, const fs_mesh *mesh, const fs_mesh *coarse, int32_t depth,
                                 const int32_t *origin, const int32_t *number, const fs_reduction *reduction,
                                 fs_coarse_squares **squares);
void fs_coarse_squares_free(fs_context *ctx, fs_coarse_squares *squares); /* NULL is allowed */

/* The place in an element of dof (i, j) of the square's orientation, both as i + 4 j. */
static inline int32_t fs_turned_place(int32_t place, int32_t turn) {
  int32_t i = place % 4, j = place / 4;
  for (; turn > 0; turn--) {
    int32_t old = i;
    i = j;
    j = 3 - old;
  }
  return i + 4 * j;
}

#endif
