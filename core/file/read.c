/* SPDX-License-Identifier: MIT */
/* Single role: a whole file into memory, and what it holds: a control mesh, a surface, splines. */
#include "file/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Larger files are refused: no mesh of 32 bit indices needs them, and devices without an end must stop somewhere. */
#define MAX_SIZE ((size_t)1 << 32)
enum { FIRST_SIZE = 65536 };

static fs_status open_to_read(fs_context *ctx, const char *path, int *descriptor, size_t *expected) {
  struct stat info;
  int opened = open(path, O_RDONLY | O_CLOEXEC);
  if (opened < 0) return fs_fail_file(ctx, "read", path, errno);
  if (fstat(opened, &info) != 0 || S_ISDIR(info.st_mode)) {
    fs_status status = fs_fail_file(ctx, "read", path, S_ISDIR(info.st_mode) ? EISDIR : errno);
    close(opened);
    return status;
  }
  *expected = S_ISREG(info.st_mode) && info.st_size > 0 ? (size_t)info.st_size : 0;
  *descriptor = opened;
  return FS_OK;
}

static fs_status fail_size(fs_context *ctx, const char *path) {
  return fs_fail(ctx, FS_ERR_IO, "cannot read %s: it is larger than %zu bytes", fs_path_shown(path), MAX_SIZE);
}

/* Twice the room, the used bytes kept. */
static fs_status grow(fs_context *ctx, const char *path, char **bytes, size_t used, size_t *room) {
  char *larger = NULL;
  fs_status status = FS_OK;
  if (*room >= MAX_SIZE) return fail_size(ctx, path);
  FS_ALLOC(ctx, larger, 2 * *room + 1);
  memcpy(larger, *bytes, used);
  fs_release(ctx, *bytes);
  *bytes = larger;
  *room *= 2;
done:
  return status;
}

fs_status fs_file_read(fs_context *ctx, const char *path, char **bytes, size_t *size) {
  int descriptor = -1;
  char *buffer = NULL;
  size_t used = 0, room, expected;
  fs_status status = FS_OK;
  FS_TRY(open_to_read(ctx, path, &descriptor, &expected));
  if (expected > MAX_SIZE) {
    status = fail_size(ctx, path);
    goto done;
  }
  room = expected > 0 ? expected + 1 : FIRST_SIZE; /* one more byte shows the end without growing */
  FS_ALLOC(ctx, buffer, room + 1);
  for (;;) {
    ssize_t n = read(descriptor, buffer + used, room - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      status = fs_fail_file(ctx, "read", path, errno);
      goto done;
    }
    if (n == 0) break;
    used += (size_t)n;
    if (used == room) FS_TRY(grow(ctx, path, &buffer, used, &room));
  }
  buffer[used] = '\0';
  *bytes = buffer;
  *size = used;
  buffer = NULL;
done:
  fs_release(ctx, buffer);
  if (descriptor >= 0) close(descriptor);
  return status;
}

void fs_file_free(fs_context *ctx, char *bytes) { fs_release(ctx, bytes); }

enum { EXTENSION_SIZE = 16 };

/* In lower case, cut: a longer one is none we know, and its beginning is enough for the sentence. */
static void take_extension(const char *path, char extension[EXTENSION_SIZE]) {
  const char *given = fs_path_extension(path);
  size_t i = 0;
  for (; given[i] != '\0' && i < EXTENSION_SIZE - 1; i++)
    extension[i] = given[i] >= 'A' && given[i] <= 'Z' ? (char)(given[i] - 'A' + 'a') : given[i];
  extension[i] = '\0';
}

static bool has_own_notes(const char *extension) {
  for (const fs_reader *const *reader = fs_readers; *reader != NULL; reader++)
    if (strcmp((*reader)->extension, extension) == 0) return (*reader)->parse_notes != NULL;
  return false;
}

/* notes may be NULL: then nothing else is looked at. */
static fs_status read_mesh(fs_context *ctx, const char *path, fs_mesh **mesh, fs_mesh_notes *notes) {
  char extension[EXTENSION_SIZE], *bytes = NULL;
  size_t size = 0;
  fs_mesh *made = NULL;
  fs_mesh_notes found = {0};
  fs_status status = FS_OK;
  take_extension(path, extension);
  FS_TRY(fs_file_read(ctx, path, &bytes, &size));
  status = fs_mesh_parse_notes(ctx, extension, bytes, size, &made, notes != NULL ? &found : NULL);
  if (status != FS_OK) {
    fs_fail_named(ctx, path);
    goto done;
  }
  if (notes != NULL && !has_own_notes(extension)) FS_TRY(fs_file_read_caps(ctx, path, made, &found.caps));
  *mesh = made;
  if (notes != NULL) *notes = found;
  made = NULL;
  found = (fs_mesh_notes){0};
done:
  fs_mesh_free(ctx, made);
  fs_mesh_notes_clear(ctx, &found);
  fs_file_free(ctx, bytes);
  return status;
}

fs_status fs_mesh_read_notes(fs_context *ctx, const char *path, fs_mesh **mesh, fs_mesh_notes *notes) {
  return read_mesh(ctx, path, mesh, notes);
}

fs_status fs_mesh_read(fs_context *ctx, const char *path, fs_mesh **mesh) { return read_mesh(ctx, path, mesh, NULL); }

fs_status fs_surface_read(fs_context *ctx, const char *path, fs_surface **surface) {
  char extension[EXTENSION_SIZE], *bytes = NULL;
  size_t size = 0;
  fs_status status = FS_OK;
  take_extension(path, extension);
  FS_TRY(fs_file_read(ctx, path, &bytes, &size));
  status = fs_surface_parse(ctx, extension, bytes, size, surface);
  if (status != FS_OK) fs_fail_named(ctx, path);
done:
  fs_file_free(ctx, bytes);
  return status;
}

fs_status fs_splines_read(fs_context *ctx, const char *path, fs_splines **splines) {
  char *bytes = NULL;
  size_t size = 0;
  fs_status status = FS_OK;
  FS_TRY(fs_file_read(ctx, path, &bytes, &size));
  status = fs_splines_parse(ctx, bytes, size, splines);
  if (status != FS_OK) fs_fail_named(ctx, path);
done:
  fs_file_free(ctx, bytes);
  return status;
}
