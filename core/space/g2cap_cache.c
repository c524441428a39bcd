/* SPDX-License-Identifier: MIT */
/* Single role: keeps the caps that calls have asked for in the context, one per valence. */
#include "space/g2cap.h"

struct fs_caps {
  fs_g2cap *cap[FS_G2CAP_MAX_VALENCE + 1]; /* by valence; NULL: not made yet */
};

fs_status fs_g2cap_get(fs_context *ctx, int32_t valence, const fs_g2cap **cap) {
  fs_status status = FS_OK;
  bool is_in_range = valence >= 0 && valence <= FS_G2CAP_MAX_VALENCE;
  fs_g2cap *made = is_in_range && ctx->caps != NULL ? ctx->caps->cap[valence] : NULL;
  if (made == NULL) {
    FS_TRY(fs_g2cap_create(ctx, valence, NULL, &made)); /* fails where the valence is out of range */
    if (ctx->caps == NULL) ctx->caps = fs_allocate(ctx, 1, sizeof *ctx->caps);
    if (ctx->caps == NULL) {
      fs_g2cap_free(ctx, made);
      status = FS_ERR_MEMORY;
      goto done;
    }
    ctx->caps->cap[valence] = made;
  }
  *cap = made;
done:
  return status;
}

void fs_context_clear(fs_context *ctx) {
  if (ctx->caps == NULL) return;
  for (int32_t valence = 0; valence <= FS_G2CAP_MAX_VALENCE; valence++) fs_g2cap_free(ctx, ctx->caps->cap[valence]);
  fs_release(ctx, ctx->caps);
  ctx->caps = NULL;
}
