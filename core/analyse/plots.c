/* SPDX-License-Identifier: MIT */
/* The table of plots, and its calls. */
#include "analyse/curves.h"

#include <string.h>

const fs_plot *const fs_plots[] = {&fs_plot_isophotes,       &fs_plot_reflection, &fs_plot_highlight,
                                   &fs_plot_zebra,           &fs_plot_mean,       &fs_plot_gaussian,
                                   &fs_plot_curvature_lines, &fs_plot_sections,   NULL};

const fs_plot *fs_plot_find(const char *name) {
  for (const fs_plot *const *plot = fs_plots; *plot != NULL; plot++)
    if (strcmp((*plot)->name, name) == 0) return *plot;
  return NULL;
}

enum { MAX_PARAMS = 16 };

fs_status fs_plot_trace(fs_context *ctx, const fs_plot *plot, const fs_surface *surface, const double *param,
                        const fs_trace_options *options, fs_curves **curves) {
  double checked[MAX_PARAMS] = {0};
  for (int i = 0; plot->params != NULL && plot->params[i].name != NULL && i < MAX_PARAMS; i++) {
    const fs_param *p = &plot->params[i];
    checked[i] = param != NULL ? param[i] : p->initial;
    if (!(checked[i] >= p->min && checked[i] <= p->max))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "parameter %s of the plot %s is %g: %g to %g are possible", p->name,
                     plot->name, checked[i], p->min, p->max);
  }
  return plot->trace(ctx, surface, checked, options, curves);
}
