/* SPDX-License-Identifier: MIT */
/* Single role: the nearest of many triangles, by a tree of boxes [Ericson 2005, sections 5.1.5 and 6.2]. A node is halved at
   the middle of its pieces along its longest side; a search enters the nearer child first and leaves out boxes that are
   farther than what is found. */
#include "surface/nearest_tree.h"
#include "math/vec3.h"

enum { LEAF = 4, MAX_DEPTH = 64 };

static double component(fs_vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/* Three times the coordinate of the centre of a piece. */
static double middle_of(const fs_piece *piece, int axis) {
  return component(piece->corner[0], axis) + component(piece->corner[1], axis) + component(piece->corner[2], axis);
}

/* Partial sort: the k smallest come first [Hoare 1961]. */
static void select_smallest(fs_piece *piece, int32_t n, int32_t k, int axis) {
  int32_t low = 0, high = n - 1;
  while (low < high) {
    double pivot = middle_of(&piece[low + (high - low) / 2], axis);
    int32_t i = low, j = high;
    while (i <= j) {
      while (middle_of(&piece[i], axis) < pivot) i++;
      while (middle_of(&piece[j], axis) > pivot) j--;
      if (i > j) break;
      fs_piece swap = piece[i];
      piece[i++] = piece[j];
      piece[j--] = swap;
    }
    if (k <= j)
      high = j;
    else if (k >= i)
      low = i;
    else
      return;
  }
}

static void set_box(const fs_piece *piece, fs_tree_node *node) {
  node->low = node->high = piece[node->first].corner[0];
  for (int32_t i = node->first; i < node->first + node->n; i++)
    for (int k = 0; k < 3; k++) {
      node->low = fs_vec3_min(node->low, piece[i].corner[k]);
      node->high = fs_vec3_max(node->high, piece[i].corner[k]);
    }
}

static void split(fs_tree *tree, int32_t number) {
  fs_tree_node *node = &tree->node[number], *child = &tree->node[tree->n_nodes];
  fs_vec3 size = fs_vec3_sub(node->high, node->low);
  int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  int32_t half = node->n / 2;
  select_smallest(tree->piece + node->first, node->n, half, axis);
  child[0] = (fs_tree_node){.first = node->first, .n = half};
  child[1] = (fs_tree_node){.first = node->first + half, .n = node->n - half};
  node->first = tree->n_nodes;
  node->n = 0;
  tree->n_nodes += 2;
}

fs_status fs_tree_create(fs_context *ctx, int32_t n_pieces, fs_piece *piece, fs_tree **result) {
  fs_status status = FS_OK;
  fs_tree *tree = NULL;
  FS_ALLOC(ctx, tree, 1);
  tree->piece = piece;
  piece = NULL;
  tree->n_pieces = n_pieces;
  FS_ALLOC(ctx, tree->node, 2 * (size_t)n_pieces + 1);
  tree->node[0] = (fs_tree_node){.first = 0, .n = n_pieces};
  tree->n_nodes = 1;
  for (int32_t i = 0; i < tree->n_nodes; i++) {
    set_box(tree->piece, &tree->node[i]);
    if (tree->node[i].n > LEAF) split(tree, i);
  }
  *result = tree;
  tree = NULL;
done:
  fs_release(ctx, piece);
  fs_tree_free(ctx, tree);
  return status;
}

void fs_tree_free(fs_context *ctx, fs_tree *tree) {
  if (tree == NULL) return;
  fs_release(ctx, tree->piece);
  fs_release(ctx, tree->node);
  fs_release(ctx, tree);
}

/* ---- search ------------------------------------------------------------------------------------------------------ */

/* Weights of the corners at the point of a triangle nearest to p, by the region that p lies in [Ericson 2005, 5.1.5]. */
static void triangle_weights(const fs_vec3 *corner, fs_vec3 p, double weight[3]) {
  fs_vec3 ab = fs_vec3_sub(corner[1], corner[0]), ac = fs_vec3_sub(corner[2], corner[0]);
  fs_vec3 ap = fs_vec3_sub(p, corner[0]), bp = fs_vec3_sub(p, corner[1]), cp = fs_vec3_sub(p, corner[2]);
  double d1 = fs_vec3_dot(ab, ap), d2 = fs_vec3_dot(ac, ap), d3 = fs_vec3_dot(ab, bp), d4 = fs_vec3_dot(ac, bp);
  double d5 = fs_vec3_dot(ab, cp), d6 = fs_vec3_dot(ac, cp), v = 0, w = 0;
  double of_a = d3 * d6 - d5 * d4, of_b = d5 * d2 - d1 * d6, of_c = d1 * d4 - d3 * d2, sum;
  if (d1 <= 0 && d2 <= 0) { /* at a */
  } else if (d3 >= 0 && d4 <= d3) {
    v = 1;
  } else if (d6 >= 0 && d5 <= d6) {
    w = 1;
  } else if (of_c <= 0 && d1 >= 0 && d3 <= 0) { /* on ab */
    v = d1 > d3 ? d1 / (d1 - d3) : 0;
  } else if (of_b <= 0 && d2 >= 0 && d6 <= 0) { /* on ac */
    w = d2 > d6 ? d2 / (d2 - d6) : 0;
  } else if (of_a <= 0 && d4 >= d3 && d5 >= d6) { /* on bc */
    w = (d4 - d3) + (d5 - d6) > 0 ? (d4 - d3) / ((d4 - d3) + (d5 - d6)) : 0;
    v = 1 - w;
  } else {
    sum = of_a + of_b + of_c;
    v = sum > 0 ? of_b / sum : 0;
    w = sum > 0 ? of_c / sum : 0;
  }
  weight[0] = 1 - v - w, weight[1] = v, weight[2] = w;
}

static double outside(double x, double low, double high) { return x < low ? low - x : x > high ? x - high : 0; }

static double box_distance_squared(const fs_tree_node *node, fs_vec3 p) {
  double x = outside(p.x, node->low.x, node->high.x), y = outside(p.y, node->low.y, node->high.y);
  double z = outside(p.z, node->low.z, node->high.z);
  return x * x + y * y + z * z;
}

const fs_piece *fs_tree_find(const fs_tree *tree, fs_vec3 p, fs_vec3 *position, double weight[3]) {
  const fs_piece *found = &tree->piece[0];
  int32_t stack[MAX_DEPTH], n = 1;
  double best = INFINITY;
  stack[0] = 0;
  *position = found->corner[0];
  weight[0] = 1, weight[1] = weight[2] = 0;
  while (n > 0) {
    const fs_tree_node *node = &tree->node[stack[--n]];
    if (box_distance_squared(node, p) >= best) continue;
    for (int32_t i = node->first; i < node->first + node->n; i++) {
      const fs_piece *piece = &tree->piece[i];
      double w[3], distance;
      fs_vec3 at = {0, 0, 0};
      triangle_weights(piece->corner, p, w);
      for (int k = 0; k < 3; k++) at = fs_vec3_add_scaled(at, piece->corner[k], w[k]);
      distance = fs_vec3_dot(fs_vec3_sub(at, p), fs_vec3_sub(at, p));
      if (distance >= best) continue;
      best = distance;
      found = piece;
      *position = at;
      for (int k = 0; k < 3; k++) weight[k] = w[k];
    }
    if (node->n == 0) { /* the nearer child is looked at first; halving keeps the depth below 32 */
      bool is_first_nearer =
          box_distance_squared(&tree->node[node->first], p) <= box_distance_squared(&tree->node[node->first + 1], p);
      stack[n++] = node->first + is_first_nearer;
      stack[n++] = node->first + !is_first_nearer;
    }
  }
  return found;
}
