/* SPDX-License-Identifier: MIT */
/* Single role: the order in which a functional is minimised over coarse and fine unknowns, with few and all quadrature nodes. */
#include "fair/stages.h"

#include <math.h>

bool fs_is_quadratic(const fs_functional *functional) {
  if (!functional->is_linear) return false;
  for (int32_t t = 0; t < functional->n_terms; t++)
    if (!functional->term[t]->is_quadratic) return false;
  return true;
}

/* Coarse displacements come first, with C lowered at every refinement: n^2 grows sixteenfold there, and with one C for all
   meshes Q would rule on the fine ones. */
int32_t fs_stages_plan(const fs_setup *s, int32_t n_coarse, fs_stage stages[FS_MAX_STAGES]) {
  int32_t n = 0;
  double last = s->param[0], C = s->functional->is_continued && last < 1e-2 ? 1e-2 : last;
  if (fs_is_quadratic(s->functional)) {
    stages[n++] = (fs_stage){last, 0, 0, 1e-12, true};
    return n;
  }
  for (int32_t depth = n_coarse; depth > 0; depth--) {
    stages[n++] = (fs_stage){C, depth, 2, 1e-3, false};
    C = fmax(0.25 * C, last);
  }
  stages[n++] = (fs_stage){C, 0, 1, C > last ? 1e-3 : 1e-6, false};
  for (C /= 10; C > 2 * last && n < FS_MAX_STAGES - 2; C /= 10) stages[n++] = (fs_stage){C, 0, 1, 1e-3, false};
  if (stages[n - 1].C > last) stages[n++] = (fs_stage){last, 0, 1, 1e-6, false};
  stages[n++] = (fs_stage){last, 0, 0, 1e-12, true};
  return n;
}
