/* SPDX-License-Identifier: MIT */
/* Single role: statuses in words, and the four doors of a context: message, note, progress, memory. */
#include "base/base.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *fs_version(void) { return FS_VERSION; }

const char *fs_status_text(fs_status status) {
  switch (status) {
#define X(name, text) \
  case FS_##name:     \
    return text;
    FS_STATUS_LIST(X)
#undef X
  }
  return "unknown status";
}

fs_status fs_fail(fs_context *ctx, fs_status status, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(ctx->message, sizeof ctx->message, format, arguments);
  va_end(arguments);
  return status;
}

void fs_note(fs_context *ctx, const char *format, ...) {
  char text[512];
  va_list arguments;
  if (ctx->note == NULL) return;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  ctx->note(ctx->user, text);
}

fs_status fs_progress(fs_context *ctx, const char *stage, double fraction) {
  if (ctx->progress == NULL || ctx->progress(ctx->user, stage, fraction)) return FS_OK;
  return fs_fail(ctx, FS_ERR_CANCELLED, "cancelled during %s", stage);
}

/* A block is handed out at the first multiple of ALIGNMENT that leaves room for the address of the raw block before it. */
enum { ALIGNMENT = 64 };

void *fs_allocate(fs_context *ctx, size_t count, size_t size) {
  char *raw, *block;
  size_t bytes = count * size;
  if (size != 0 && count > (SIZE_MAX - 2 * ALIGNMENT) / size) {
    fs_fail(ctx, FS_ERR_MEMORY, "out of memory: %zu elements of %zu bytes are more than can be addressed", count, size);
    return NULL;
  }
  raw = ctx->allocate != NULL ? ctx->allocate(ctx->user, bytes + 2 * ALIGNMENT) : malloc(bytes + 2 * ALIGNMENT);
  if (raw == NULL) {
    fs_fail(ctx, FS_ERR_MEMORY, "out of memory: no room for %zu bytes", bytes);
    return NULL;
  }
  block = raw + 2 * ALIGNMENT - (uintptr_t)raw % ALIGNMENT;
  memcpy(block - sizeof raw, &raw, sizeof raw);
  memset(block, 0, bytes);
  return block;
}

void fs_release(fs_context *ctx, void *block) {
  char *raw;
  if (block == NULL) return;
  memcpy(&raw, (char *)block - sizeof raw, sizeof raw);
  if (ctx->release != NULL)
    ctx->release(ctx->user, raw);
  else
    free(raw);
}
