/* SPDX-License-Identifier: MIT */
/* Single role: the surface that a file stands for: patches as they are, or those over a control net, refined where its space
   needs it. */
#include "cli.h"

#include <string.h>
#include <strings.h>

static bool holds_patches(const char *path) {
  const char *dot = strrchr(path, '.');
  for (int i = 0; dot != NULL && fs_surface_readers[i] != NULL; i++)
    if (strcasecmp(dot + 1, fs_surface_readers[i]->extension) == 0) return true;
  return false;
}

static fs_status load_net(fs_context *ctx, const arguments *a, const char *path, loaded_surface *loaded) {
  fs_mesh *mesh = NULL;
  const fs_mesh *fine;
  fs_mesh_notes notes = {0};
  fs_refinement *step[FS_MAX_REFINEMENTS] = {NULL};
  int32_t n_steps = 0;
  fs_space *space = NULL;
  fs_status status = fs_mesh_read_notes(ctx, path, &mesh, &notes);
  if (status == FS_OK) status = fs_space_prepare(ctx, mesh, a->refine, step, &n_steps);
  fine = n_steps > 0 ? step[n_steps - 1]->mesh : mesh;
  if (status == FS_OK) status = create_space(ctx, a, fine, notes.caps, n_steps > 0, &space);
  if (status == FS_OK) status = fs_surface_create(ctx, space, space->start, &loaded->surface);
  if (status == FS_OK) status = fs_mesh_copy(ctx, fine, &loaded->control);
  if (status == FS_OK) status = fs_space_keep_caps(ctx, loaded->control, space, space->start, &loaded->caps);
  fs_space_free(ctx, space);
  for (int32_t i = 0; i < n_steps; i++) fs_refinement_free(ctx, step[i]);
  fs_mesh_notes_clear(ctx, &notes);
  fs_mesh_free(ctx, mesh);
  if (status != FS_OK) free_loaded(ctx, loaded);
  return status;
}

fs_status load_with_net(fs_context *ctx, const arguments *a, const char *path, loaded_surface *loaded) {
  return holds_patches(path) ? fs_surface_read(ctx, path, &loaded->surface) : load_net(ctx, a, path, loaded);
}

void free_loaded(fs_context *ctx, loaded_surface *loaded) {
  fs_surface_free(ctx, loaded->surface);
  fs_mesh_free(ctx, loaded->control);
  fs_cap_notes_free(ctx, loaded->caps);
  *loaded = (loaded_surface){0};
}

fs_status load_surface(fs_context *ctx, const arguments *a, const char *path, fs_surface **surface) {
  loaded_surface loaded = {0};
  fs_status status = load_with_net(ctx, a, path, &loaded);
  if (status == FS_OK) *surface = loaded.surface;
  loaded.surface = NULL;
  free_loaded(ctx, &loaded);
  return status;
}
