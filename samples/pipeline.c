/* SPDX-License-Identifier: MIT */
/* The main job in seven calls: control mesh in, fair surface out. Usage: pipeline INPUT OUTPUT */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <fairsurf/fairsurf.h>

#define TRY(call)                   \
  do {                              \
    status = (call);                \
    if (status != FS_OK) goto done; \
  } while (0)

static void print_note(void *user, const char *text) {
  (void)user;
  fprintf(stderr, "note: %s\n", text);
}

int main(int argc, char **argv) {
  if (argc != 3) {
    fprintf(stderr, "usage: %s INPUT OUTPUT\n", argv[0]);
    return 2;
  }
  fs_context context = {.note = print_note}, *ctx = &context;
  fs_status status = FS_OK;
  fs_mesh *mesh = NULL;
  fs_refinement *steps[FS_MAX_REFINEMENTS] = {NULL};
  int32_t n_steps = 0;
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  bool *fixed = NULL;
  fs_vec3 *c = NULL;
  fs_fair_report *report = NULL;

  TRY(fs_mesh_read(ctx, argv[1], &mesh));
  TRY(fs_space_prepare(ctx, mesh, 0, steps, &n_steps));
  const fs_mesh *fine = n_steps > 0 ? steps[n_steps - 1]->mesh : mesh;
  TRY(fs_space_create(ctx, fine, &space));

  size_t n = (size_t)space->n_dofs;
  fixed = calloc(n, sizeof *fixed);
  c = malloc(n * sizeof *c);
  report = malloc(sizeof *report);
  if (fixed == NULL || c == NULL || report == NULL) TRY(FS_ERR_MEMORY);
  memcpy(c, space->start, n * sizeof *c);

  TRY(fs_space_rim(ctx, fine, space, fixed));
  TRY(fs_fair(ctx, space, &(fs_fair_options){.fixed = fixed}, c, report));
  TRY(fs_surface_create(ctx, space, c, &surface));
  TRY(fs_export_file(ctx, &(fs_model){.control = fine, .surface = surface}, NULL, argv[2]));
  printf("%d free points, %d steps: F %.6g -> %.6g (%s)\n", (int)report->n_free, (int)report->n_steps, report->start.F,
         report->end.F, fs_stop_text(report->stop));

done:
  if (status != FS_OK) fprintf(stderr, "%s\n", context.message[0] ? context.message : fs_status_text(status));
  free(report);
  free(c);
  free(fixed);
  fs_surface_free(ctx, surface);
  fs_space_free(ctx, space);
  for (int32_t i = 0; i < n_steps; i++) fs_refinement_free(ctx, steps[i]);
  fs_mesh_free(ctx, mesh);
  fs_context_clear(ctx);
  return status == FS_OK ? 0 : 1;
}
