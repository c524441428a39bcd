/* SPDX-License-Identifier: MIT */
/* Single role: every iterate of a fairing as a file, DIR/iter0000.ply, … */
#include "cli.h"

#include <string.h>

fs_status begin_iterates(fs_context *ctx, const iterates *it) {
  fs_status status = make_folder(ctx, it->folder);
  return status == FS_OK ? make_folder(ctx, it->film) : status;
}

static fs_status write(fs_context *ctx, const iterates *it, int32_t number, const fs_vec3 *c) {
  fs_status status;
  fs_mesh *control = NULL;
  fs_cap_notes *caps = NULL;
  char name[32], file[40];
  snprintf(name, sizeof name, "iter%04d", number);
  snprintf(file, sizeof file, "%s.ply", name);
  status = fs_mesh_copy(ctx, it->mesh, &control);
  if (status == FS_OK) {
    memcpy(control->position, c, (size_t)control->n_vertices * sizeof *c);
    status = fs_space_keep_caps(ctx, control, it->space, c, &caps);
  }
  if (status == FS_OK)
    status = export_into(ctx, &(fs_model){.name = name, .control = control, .caps = caps}, NULL, it->folder, file);
  fs_cap_notes_free(ctx, caps);
  fs_mesh_free(ctx, control);
  return status;
}

bool write_iterate(fs_context *ctx, iterates *it, const fs_step *step, const fs_vec3 *c) {
  if (it->folder != NULL && it->status == FS_OK) it->status = write(ctx, it, step->number, c);
  if (it->film != NULL && it->status == FS_OK) it->status = write_frame(ctx, it, c);
  return it->status == FS_OK;
}
