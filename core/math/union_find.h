/* SPDX-License-Identifier: MIT */
/* Sets of numbers that are joined, union-find with path halving [Tarjan 1975]: parent[i] = i for all i at first. */
#ifndef FS_MATH_UNION_FIND_H
#define FS_MATH_UNION_FIND_H

#include <stdint.h>

/* The lowest number of the set of i. */
static inline int32_t fs_union_find(int32_t *parent, int32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/* The lower root becomes the root of both, so that a root comes before its followers. */
static inline void fs_union_join(int32_t *parent, int32_t i, int32_t j) {
  i = fs_union_find(parent, i), j = fs_union_find(parent, j);
  if (i < j)
    parent[j] = i;
  else
    parent[i] = j;
}

#endif
