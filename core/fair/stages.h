/* SPDX-License-Identifier: MIT */
/* What a fairing is made of: minimisations of growing precision. */
#ifndef FS_FAIR_STAGES_H
#define FS_FAIR_STAGES_H

#include "fair/coarse.h"
#include "fair/setup.h"

enum { FS_MAX_STAGES = 24 + FS_MAX_COARSE };

typedef struct fs_stage {
  double C;         /* first parameter of the functional */
  int32_t depth;    /* refinements before the mesh whose displacements are the unknowns; 0: all unknowns */
  int32_t level;    /* of quadrature: 2 and 1 few nodes, 0 all */
  double tolerance; /* predicted decrease, relative */
  bool is_last;
  bool is_minimum; /* it must not end at a saddle */
} fs_stage;

/* Polishing lowers C this much further. */
#define FS_POLISH_FACTOR 1e-2

/* The stages of a setup over so many coarse meshes, the coarsest first; how many there are. */
int32_t fs_stages_plan(const fs_setup *setup, const fs_fair_options *options, int32_t n_coarse,
                       fs_stage stages[FS_MAX_STAGES]);

/* One Newton step reaches the minimum. */
bool fs_is_quadratic(const fs_functional *functional);

#endif
