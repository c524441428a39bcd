/* SPDX-License-Identifier: MIT */
/* Single role: the order in which a functional is minimised over coarse and fine unknowns, with few and all quadrature nodes.

   Coarse displacements come first, with C lowered at every refinement: n^2 grows sixteenfold there, and with one C for all
   meshes Q would rule on the fine ones. */
#include "fair/stages.h"

#include <math.h>

/* Below the last value whose minimum is unique steps are many and bring little: the last two stages of polishing end when a step
   promises less than this; between, a stage that ends early leaves more to the next than it spares. */
#define UNIQUE 0.99e-4
#define POLISH_TOLERANCE 1e-4
#define BETWEEN_TOLERANCE 1e-5

/* Of closed surfaces the first minimum, which is unique, is found to rounding: what noise would be left there leads to different
   minima by the saddles at lower C. */
#define CLOSED_TOLERANCE 1e-16

/* Down to this C closed surfaces come to forks. C is halved there, and saddles are left at once, so that all starts take the same
   way: from 1e-2 to 1e-3 in one step, one of five noisy bitori or bodies of genus 3 ends in another minimum. */
#define FORKS_C 1e-3
#define FORKS_TOLERANCE 1e-10

bool fs_is_quadratic(const fs_functional *functional) {
  if (!functional->is_linear) return false;
  for (int32_t t = 0; t < functional->n_terms; t++)
    if (!functional->term[t]->is_quadratic) return false;
  return true;
}

int32_t fs_stages_plan(const fs_setup *s, const fs_fair_options *options, int32_t n_coarse,
                       fs_stage stages[FS_MAX_STAGES]) {
  int32_t n = 0;
  double between = s->functional->is_scale_free ? CLOSED_TOLERANCE : 1e-3;
  double last = s->param[0], C = s->functional->is_continued && last < 1e-2 ? 1e-2 : last;
  if (fs_is_quadratic(s->functional)) {
    stages[n++] = (fs_stage){.C = last, .tolerance = 1e-12, .is_last = true};
    return n;
  }
  for (int32_t depth = n_coarse; depth > 0; depth--, C = fmax(0.25 * C, last))
    stages[n++] = (fs_stage){.C = C, .depth = depth, .level = 2, .tolerance = 1e-3};
  stages[n++] = (fs_stage){.C = C, .level = 1, .tolerance = C > last ? between : 1e-6};
  for (double c = C / 2; s->functional->is_scale_free && c > 1.2 * fmax(last, FORKS_C); c /= 2)
    stages[n++] = (fs_stage){.C = c, .level = 1, .tolerance = FORKS_TOLERANCE, .is_minimum = true};
  for (C /= 10; C > 2 * last && n < FS_MAX_STAGES - 2; C /= 10)
    stages[n++] =
        (fs_stage){.C = C, .level = 1, .tolerance = C < UNIQUE ? BETWEEN_TOLERANCE : 1e-3, .is_minimum = C < UNIQUE};
  if (stages[n - 1].C > last)
    stages[n++] = (fs_stage){
        .C = last, .level = 1, .tolerance = last < UNIQUE ? POLISH_TOLERANCE : 1e-6, .is_minimum = last < UNIQUE};
  stages[n++] = (fs_stage){
      .C = last, .tolerance = options->polish ? POLISH_TOLERANCE : 1e-12, .is_last = true, .is_minimum = true};
  for (int32_t i = 0; i < n; i++) {
    if (stages[i].tolerance >= options->decrease_tolerance) continue;
    stages[i].tolerance = options->decrease_tolerance;
    stages[i].is_minimum = false; /* who asks for less does not want to pay for the search for saddles */
  }
  return n;
}
