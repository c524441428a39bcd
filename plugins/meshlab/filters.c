/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the table of filters, and what all of them have in common. */
#include "filters.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const filter *const filters[] = {&filter_refine,    &filter_fair,      &filter_patches,
                                 &filter_curvature, &filter_fill_hole, NULL};

const char *colour_choice(int32_t number) {
  if (number == 0) return "none";
  return fs_measures[number - 1] != NULL ? fs_measures[number - 1]->name : NULL;
}

const char *param_choice(const filter_param *p, int32_t number) {
  return p->choice != NULL ? p->choice(number) : p->choices[number];
}

fs_status params_check(fs_context *ctx, const filter_param *params, const double *value) {
  for (const filter_param *p = params; p->name != NULL; p++, value++) {
    double max = p->max;
    if (p->kind == PARAM_CHOICE)
      for (max = 0; param_choice(p, (int32_t)max + 1) != NULL;) max++;
    if (*value >= p->min && *value <= max) continue;
    return refuse(ctx, FS_ERR_ARGUMENT, "%s is %g, but it must lie between %g and %g", p->name, *value, p->min, max);
  }
  return FS_OK;
}

fs_status filter_run(fs_context *ctx, const filter *f, const layer *l, const double *param, outcome *o) {
  outcome made = {0};
  fs_status status = params_check(ctx, f->params, param);
  if (status == FS_OK) status = f->run(ctx, l, param, &made);
  if (status == FS_OK)
    *o = made;
  else
    outcome_clear(&made);
  if (status != FS_OK && ctx->message[0] == '\0') refuse(ctx, status, "%s", fs_status_text(status));
  return status;
}
