/* SPDX-License-Identifier: MIT */
/* Single role: which caps the space has, from --caps, the functional and what the file keeps. */
#include "cli.h"

static void note(fs_context *ctx, const char *format, int32_t n) {
  char text[200];
  if (ctx->note == NULL) return;
  snprintf(text, sizeof text, format, n);
  ctx->note(ctx->user, text);
}

/* Inner coefficients pay where the penalty on the parametrisation becomes small, and are not determined without any. */
static bool wants_full(const arguments *a) {
  return a->command == COMMAND_FAIR && !a->along_normals && a->functional->is_continued &&
         a->functional->term[0] == &fs_density_curvature_variation;
}

/* More than the functions of the whole cap, of which there are 3 k + 7 at most. */
static int32_t count_full(const fs_cap_notes *notes) {
  int32_t n = 0;
  for (int32_t i = 0; i < notes->n_caps; i++) n += notes->cap[i].n > 3 * notes->cap[i].valence + 7;
  return n;
}

void note_lost_caps(fs_context *ctx, const fs_cap_notes *kept) {
  if (kept != NULL)
    note(ctx, "the inner coefficients of the %d caps in the file are lost: after refinement they start at zero",
         kept->n_caps);
}

fs_status create_space(fs_context *ctx, const arguments *a, const fs_mesh *mesh, const fs_cap_notes *kept,
                       bool is_refined, fs_space **space) {
  fs_space_options options = {.caps = FS_CAPS_LINEAR};
  if (is_refined) {
    note_lost_caps(ctx, kept);
    kept = NULL;
  }
  if (a->caps >= 0)
    options.caps = (fs_cap_inner)a->caps;
  else if (kept != NULL || wants_full(a))
    options.caps = FS_CAPS_FULL;
  options.kept = kept;
  if (kept != NULL && options.caps == FS_CAPS_LINEAR)
    note(ctx, "the inner coefficients of the %d caps in the file are left out: --caps linear", kept->n_caps);
  if (kept != NULL && options.caps == FS_CAPS_SMOOTH && count_full(kept) > 0)
    note(ctx, "the inner coefficients in the sectors of %d caps in the file are left out: --caps smooth",
         count_full(kept));
  return fs_space_create_with(ctx, mesh, &options, space);
}
