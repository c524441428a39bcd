/* SPDX-License-Identifier: MIT */
/* The command plot: curves on the surface that a file stands for, written to files. */
#include "cli.h"

#include <string.h>

static fs_status write_outputs(fs_context *ctx, const arguments *a, const loaded_surface *loaded,
                               const fs_curves *curves) {
  char made_with[200];
  snprintf(made_with, sizeof made_with, "fairsurf %s, %s", fs_version(), a->plot->name);
  for (int32_t i = 0; i < a->n_outputs; i++) {
    const output_request *o = &a->output[i];
    fs_model model = {.name = a->name,
                      .control = loaded->control,
                      .caps = loaded->caps,
                      .surface = loaded->surface,
                      .colour = o->colour,
                      .curves = curves,
                      .made_with = made_with};
    fs_status status = FS_OK;
    if (!o->exporter->has_curves) {
      snprintf(ctx->message, sizeof ctx->message, "%.100s: a .%s file holds no curves on surfaces", o->path,
               o->exporter->extension);
      status = FS_ERR_UNSUPPORTED;
    }
    if (status == FS_OK) status = fs_export_file(ctx, &model, o->param, o->path);
    if (status != FS_OK) return status;
  }
  return FS_OK;
}

fs_status run_plot(fs_context *ctx, const arguments *a) {
  loaded_surface loaded = {0};
  fs_curves *curves = NULL;
  fs_status status = load_with_net(ctx, a, a->mesh, &loaded);
  if (status == FS_OK) status = fs_plot_trace(ctx, a->plot, loaded.surface, a->plot_param, NULL, &curves);
  if (status == FS_OK) status = write_outputs(ctx, a, &loaded, curves);
  fs_curves_free(ctx, curves);
  free_loaded(ctx, &loaded);
  return status;
}
