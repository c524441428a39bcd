/* SPDX-License-Identifier: MIT */
/* Triangles in a tree of boxes, for the nearest one to a point. */
#ifndef FS_SURFACE_NEAREST_TREE_H
#define FS_SURFACE_NEAREST_TREE_H

#include "base/base.h"

/* A triangle and what it is a piece of. */
typedef struct fs_piece {
  fs_vec3 corner[3];
  double uv[3][2]; /* parameters of the corners */
  int32_t patch;
} fs_piece;

typedef struct fs_tree_node {
  fs_vec3 low, high;
  int32_t first, n; /* pieces of a leaf; n = 0: children first and first + 1 */
} fs_tree_node;

typedef struct fs_tree {
  int32_t n_pieces, n_nodes;
  fs_piece *piece; /* [n_pieces] in the order of the leaves */
  fs_tree_node *node;
} fs_tree;

/* Takes the pieces, also on failure. */
fs_status fs_tree_create(fs_context *ctx, int32_t n_pieces, fs_piece *piece, fs_tree **tree);
void fs_tree_free(fs_context *ctx, fs_tree *tree); /* NULL is allowed */

/* The nearest piece, its nearest point, and the weights of its corners there. */
const fs_piece *fs_tree_find(const fs_tree *tree, fs_vec3 p, fs_vec3 *position, double weight[3]);

#endif
