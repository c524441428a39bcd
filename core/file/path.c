/* SPDX-License-Identifier: MIT */
/* Single role: parts of a path, and failures that name one. */
#include "file/file.h"

#include <string.h>

enum { SHOWN_SIZE = 150 };

const char *fs_path_extension(const char *path) {
  const char *slash = strrchr(path, '/'), *name = slash != NULL ? slash + 1 : path;
  const char *dot = strrchr(name, '.');
  return dot != NULL && dot != name ? dot + 1 : path + strlen(path);
}

const char *fs_path_shown(const char *path) {
  size_t size = strlen(path);
  return size > SHOWN_SIZE ? path + size - SHOWN_SIZE : path;
}

fs_status fs_fail_file(fs_context *ctx, const char *verb, const char *path, int error_number) {
  char text[80];
  /* The GNU form of strerror_r: it returns the text, which may lie elsewhere. */
  return fs_fail(ctx, FS_ERR_IO, "cannot %s %s: %s", verb, fs_path_shown(path),
                 strerror_r(error_number, text, sizeof text));
}

void fs_fail_named(fs_context *ctx, const char *path) {
  char sentence[sizeof ctx->message];
  memcpy(sentence, ctx->message, sizeof sentence);
  fs_fail(ctx, FS_OK, "%s: %s", fs_path_shown(path), sentence);
}
