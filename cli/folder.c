/* SPDX-License-Identifier: MIT */
/* Single role: files of several names in one folder. */
#include "cli.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_PATH = 4096 };

fs_status make_folder(fs_context *ctx, const char *path) {
  if (path == NULL || mkdir(path, 0777) == 0 || errno == EEXIST) return FS_OK;
  snprintf(ctx->message, sizeof ctx->message, "%.200s: %s", path, strerror(errno));
  return FS_ERR_IO;
}

static fs_status join(fs_context *ctx, const char *folder, const char *name, char path[MAX_PATH]) {
  if (snprintf(path, MAX_PATH, "%s/%s", folder, name) < MAX_PATH) return FS_OK;
  snprintf(ctx->message, sizeof ctx->message, "the path of %.200s is too long", folder);
  return FS_ERR_IO;
}

fs_status export_into(fs_context *ctx, const fs_model *model, const double *param, const char *folder,
                      const char *name) {
  char path[MAX_PATH];
  fs_status status = join(ctx, folder, name, path);
  return status == FS_OK ? fs_export_file(ctx, model, param, path) : status;
}

fs_status write_text(fs_context *ctx, const char *folder, const char *name, const char *text) {
  char path[MAX_PATH];
  fs_status status = join(ctx, folder, name, path);
  fs_files *files = NULL;
  fs_output output;
  fs_sink sink;
  if (status == FS_OK) status = fs_files_create(ctx, path, &files, &output);
  if (status != FS_OK) return status;
  status = output.open(output.user, strrchr(name, '.') + 1, &sink);
  if (status == FS_OK) status = sink.write(sink.user, text, strlen(text));
  if (status == FS_OK) return fs_files_commit(ctx, files);
  fs_files_discard(ctx, files);
  return status;
}
