/* SPDX-License-Identifier: MIT */
/* Single role: bytes in memory that grow. */
#include "blob.h"
#include "base/base.h"

#include <string.h>

enum { FIRST_ROOM = 4096 };

fs_status fs_blob_append(fs_blob *blob, const void *bytes, size_t size) {
  fs_context *ctx = blob->ctx;
  char *larger = NULL;
  fs_status status = FS_OK;
  if (size > blob->room - blob->size) {
    size_t room = blob->room < FIRST_ROOM ? FIRST_ROOM : 2 * blob->room;
    if (room - blob->size < size) room = blob->size + size;
    FS_ALLOC(ctx, larger, room);
    if (blob->size > 0) memcpy(larger, blob->bytes, blob->size);
    fs_release(ctx, blob->bytes);
    blob->bytes = larger;
    blob->room = room;
  }
  if (size > 0) memcpy(blob->bytes + blob->size, bytes, size);
  blob->size += size;
done:
  return status;
}

fs_status fs_blob_pad(fs_blob *blob, size_t multiple, char with) {
  fs_status status = FS_OK;
  while (blob->size % multiple != 0) FS_TRY(fs_blob_append(blob, &with, 1));
done:
  return status;
}

void fs_blob_clear(fs_blob *blob) {
  fs_release(blob->ctx, blob->bytes);
  *blob = (fs_blob){.ctx = blob->ctx};
}

static fs_status sink_write(void *user, const void *bytes, size_t size) { return fs_blob_append(user, bytes, size); }

static fs_status open_blob(void *user, const char *extension, fs_sink *sink) {
  (void)extension;
  *sink = (fs_sink){.write = sink_write, .user = user};
  return FS_OK;
}

fs_output fs_blob_output(fs_blob *blob) { return (fs_output){.open = open_blob, .user = blob}; }
