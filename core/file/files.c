/* SPDX-License-Identifier: MIT */
/* Single role: an output of files that appear under their names only when all of them are complete. Each is written to
   NAME.EXT.xxxxxx in the same folder, and renamed at the end. */
#include "file/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { BUFFER_SIZE = 65536, SUFFIX_SIZE = 7, MAX_ATTEMPTS = 1000 };

/* One file, newest first. */
typedef struct entry {
  char *path, *temporary;
  struct entry *older;
  bool is_renamed;
} entry;

struct fs_files {
  fs_context *ctx;
  char *path;
  size_t stem; /* length of the path without dot and extension */
  entry *newest;
  int descriptor; /* of the newest file, or -1 */
  size_t used;
  char buffer[BUFFER_SIZE];
};

static fs_status write_all(fs_files *files, const char *bytes, size_t size) {
  while (size > 0) {
    ssize_t n = write(files->descriptor, bytes, size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return fs_fail_file(files->ctx, "write", files->newest->path, errno);
    bytes += n;
    size -= (size_t)n;
  }
  return FS_OK;
}

static fs_status sink_write(void *user, const void *bytes, size_t size) {
  fs_files *files = user;
  fs_status status = FS_OK;
  if (size > BUFFER_SIZE - files->used) {
    FS_TRY(write_all(files, files->buffer, files->used));
    files->used = 0;
  }
  if (size > BUFFER_SIZE) return write_all(files, bytes, size);
  memcpy(files->buffer + files->used, bytes, size);
  files->used += size;
done:
  return status;
}

/* Brings the open file to the disk, where a full one shows at the latest. File systems without fsync are no failure. */
static fs_status close_file(fs_files *files) {
  int descriptor = files->descriptor;
  fs_status status = FS_OK;
  if (descriptor < 0) return FS_OK;
  FS_TRY(write_all(files, files->buffer, files->used));
  if (fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS)
    status = fs_fail_file(files->ctx, "write", files->newest->path, errno);
done:
  files->used = 0;
  files->descriptor = -1;
  if (close(descriptor) != 0 && errno != EINTR && status == FS_OK)
    status = fs_fail_file(files->ctx, "write", files->newest->path, errno);
  return status;
}

/* Room for stem.extension and, in temporary, for a suffix. */
static fs_status make_entry(fs_files *files, const char *extension, entry **made) {
  fs_context *ctx = files->ctx;
  const char *own = fs_path_extension(files->path);
  size_t size;
  entry *result = NULL;
  fs_status status = FS_OK;
  if (strcasecmp(own, extension) == 0) extension = own; /* as the caller spells it */
  size = files->stem + 1 + strlen(extension) + 1;
  FS_ALLOC(ctx, result, 1);
  FS_ALLOC(ctx, result->path, size);
  FS_ALLOC(ctx, result->temporary, size + SUFFIX_SIZE);
  snprintf(result->path, size, "%.*s.%s", (int)files->stem, files->path, extension);
  *made = result;
  return FS_OK;
done:
  if (result != NULL) fs_release(ctx, result->path);
  fs_release(ctx, result);
  return status;
}

static void free_entry(fs_context *ctx, entry *e) {
  fs_release(ctx, e->path);
  fs_release(ctx, e->temporary);
  fs_release(ctx, e);
}

/* Creates a file that was not there, with the permissions the process gives to new files. */
static int create_beside(entry *e) {
  struct timespec now = {0};
  uint64_t random;
  size_t size = strlen(e->path) + 1 + SUFFIX_SIZE;
  clock_gettime(CLOCK_MONOTONIC, &now);
  random = (uint64_t)now.tv_nsec * 0x9E3779B97F4A7C15u + (uint64_t)now.tv_sec + ((uint64_t)getpid() << 32);
  for (int32_t attempt = 0; attempt < MAX_ATTEMPTS; attempt++) {
    int descriptor;
    random = random * 6364136223846793005u + 1442695040888963407u;
    snprintf(e->temporary, size, "%s.%06x", e->path, (unsigned)(random >> 40));
    descriptor = open(e->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  errno = EEXIST;
  return -1;
}

static fs_status output_open(void *user, const char *extension, fs_sink *sink) {
  fs_files *files = user;
  struct stat info;
  entry *made = NULL;
  fs_status status = FS_OK;
  FS_TRY(close_file(files));
  FS_TRY(make_entry(files, extension, &made));
  if (stat(made->path, &info) == 0 && S_ISDIR(info.st_mode)) {
    status = fs_fail_file(files->ctx, "write", made->path, EISDIR);
    goto done;
  }
  files->descriptor = create_beside(made);
  if (files->descriptor < 0) {
    status = fs_fail_file(files->ctx, "write", made->path, errno);
    goto done;
  }
  made->older = files->newest;
  files->newest = made;
  made = NULL;
  *sink = (fs_sink){.write = sink_write, .user = files};
done:
  if (made != NULL) free_entry(files->ctx, made);
  return status;
}

fs_status fs_files_create(fs_context *ctx, const char *path, fs_files **files, fs_output *output) {
  const char *extension = fs_path_extension(path), *slash = strrchr(path, '/');
  size_t size = strlen(path);
  fs_files *result = NULL;
  fs_status status = FS_OK;
  if (size == 0 || (slash != NULL && slash[1] == '\0'))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the path \"%s\" names no file", fs_path_shown(path));
  if (size > INT16_MAX) return fs_fail(ctx, FS_ERR_ARGUMENT, "a path of %zu bytes is too long", size);
  FS_ALLOC(ctx, result, 1);
  result->ctx = ctx;
  result->descriptor = -1;
  FS_ALLOC(ctx, result->path, size + 1);
  memcpy(result->path, path, size + 1);
  result->stem = *extension != '\0' ? (size_t)(extension - path) - 1 : size;
  *files = result;
  *output = (fs_output){.open = output_open, .user = result};
  result = NULL;
done:
  fs_release(ctx, result);
  return status;
}

/* In the order of writing, so that a file comes after what it includes. */
static fs_status rename_all(fs_context *ctx, entry *e) {
  fs_status status = FS_OK;
  if (e == NULL) return FS_OK;
  FS_TRY(rename_all(ctx, e->older));
  if (rename(e->temporary, e->path) != 0) return fs_fail_file(ctx, "write", e->path, errno);
  e->is_renamed = true;
done:
  return status;
}

/* Removes what has not got its name; the message of a failure before is kept. */
static void free_files(fs_context *ctx, fs_files *files) {
  if (files->descriptor >= 0) close(files->descriptor);
  while (files->newest != NULL) {
    entry *e = files->newest;
    files->newest = e->older;
    if (!e->is_renamed) unlink(e->temporary);
    free_entry(ctx, e);
  }
  fs_release(ctx, files->path);
  fs_release(ctx, files);
}

fs_status fs_files_commit(fs_context *ctx, fs_files *files) {
  fs_status status = FS_OK;
  FS_TRY(close_file(files));
  FS_TRY(rename_all(ctx, files->newest));
done:
  free_files(ctx, files);
  return status;
}

void fs_files_discard(fs_context *ctx, fs_files *files) {
  if (files != NULL) free_files(ctx, files);
}
