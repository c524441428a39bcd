/* SPDX-License-Identifier: MIT */
/* Single role: keeps the caps and inner functions that calls have asked for in the context, one per valence. */
#include "space/g2cap.h"

struct fs_caps {
  fs_g2cap *cap[FS_G2CAP_MAX_VALENCE + 1]; /* by valence; NULL: not made yet */
  fs_g2cap_inner *inner[FS_G2CAP_MAX_VALENCE + 1];
};

static bool is_in_range(int32_t valence) { return valence >= 0 && valence <= FS_G2CAP_MAX_VALENCE; }

static fs_status open_cache(fs_context *ctx) {
  if (ctx->caps == NULL) ctx->caps = fs_allocate(ctx, 1, sizeof *ctx->caps);
  return ctx->caps != NULL ? FS_OK : FS_ERR_MEMORY;
}

fs_status fs_g2cap_get(fs_context *ctx, int32_t valence, const fs_g2cap **cap) {
  fs_status status = FS_OK;
  fs_g2cap *made = is_in_range(valence) && ctx->caps != NULL ? ctx->caps->cap[valence] : NULL;
  if (made == NULL) {
    FS_TRY(open_cache(ctx));
    FS_TRY(fs_g2cap_create(ctx, valence, NULL, &made)); /* fails where the valence is out of range */
    ctx->caps->cap[valence] = made;
  }
  *cap = made;
done:
  return status;
}

fs_status fs_g2cap_get_inner(fs_context *ctx, int32_t valence, const fs_g2cap_inner **inner) {
  fs_status status = FS_OK;
  fs_g2cap_inner *made = is_in_range(valence) && ctx->caps != NULL ? ctx->caps->inner[valence] : NULL;
  if (made == NULL) {
    FS_TRY(open_cache(ctx));
    FS_TRY(fs_g2cap_inner_create(ctx, valence, &made));
    ctx->caps->inner[valence] = made;
  }
  *inner = made;
done:
  return status;
}

void fs_context_clear(fs_context *ctx) {
  if (ctx->caps == NULL) return;
  for (int32_t valence = 0; valence <= FS_G2CAP_MAX_VALENCE; valence++) {
    fs_g2cap_free(ctx, ctx->caps->cap[valence]);
    fs_g2cap_inner_free(ctx, ctx->caps->inner[valence]);
  }
  fs_release(ctx, ctx->caps);
  ctx->caps = NULL;
}
