/* SPDX-License-Identifier: MIT */
/* Single role: the life of the inner coefficients that are kept with a mesh. */
#include "mesh/mesh.h"

fs_status fs_cap_notes_create(fs_context *ctx, int32_t n_caps, int32_t n_coefficients, fs_cap_notes **notes) {
  fs_status status = FS_OK;
  fs_cap_notes *result = NULL;
  if (n_caps < 0 || n_coefficients < 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d caps with %d coefficients are none", n_caps, n_coefficients);
  FS_ALLOC(ctx, result, 1);
  *result = (fs_cap_notes){.basis = FS_CAP_BASIS, .n_caps = n_caps, .n_coefficients = n_coefficients};
  FS_ALLOC(ctx, result->cap, n_caps);
  FS_ALLOC(ctx, result->coefficient, n_coefficients);
  *notes = result;
  result = NULL;
done:
  fs_cap_notes_free(ctx, result);
  return status;
}

void fs_cap_notes_free(fs_context *ctx, fs_cap_notes *notes) {
  if (notes == NULL) return;
  fs_release(ctx, notes->cap);
  fs_release(ctx, notes->coefficient);
  fs_release(ctx, notes);
}
