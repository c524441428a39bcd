/* SPDX-License-Identifier: MIT */
/* Single role: the energies of a surface as it is, and the small answers about a fairing. */
#include "fair/setup.h"

const fs_functional *fs_setup_functional(const fs_fair_options *options) {
  return options->functional != NULL ? options->functional : fs_functionals[0];
}

fs_status fs_fair_energy(fs_context *ctx, const fs_space *space, const fs_fair_options *options, const fs_vec3 *c,
                         fs_energy *energy) {
  fs_status status = FS_OK;
  fs_setup s = {0};
  double *g = NULL;
  FS_TRY(fs_setup_create(ctx, space, options, fs_setup_functional(options), c, &s));
  FS_ALLOC(ctx, g, 3 * (size_t)s.problem->n_free);
  FS_TRY(fs_setup_measure(&s, g, energy));
done:
  fs_release(ctx, g);
  fs_setup_free(ctx, &s);
  return status;
}

const char *fs_stop_text(fs_stop stop) {
  static const char *const text[] = {"gradient", "step", "decrease", "iterations", "cancelled", "time"};
  return text[stop];
}
