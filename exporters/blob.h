/* SPDX-License-Identifier: MIT */
/* Bytes in memory that grow: for formats whose first bytes tell how many follow. */
#ifndef FS_EXPORTERS_BLOB_H
#define FS_EXPORTERS_BLOB_H

#include <fairsurf/export.h>

/* All zero but for ctx: empty. */
typedef struct fs_blob {
  fs_context *ctx;
  char *bytes;
  size_t size, room;
} fs_blob;

fs_status fs_blob_append(fs_blob *blob, const void *bytes, size_t size);
fs_status fs_blob_pad(fs_blob *blob, size_t multiple, char with); /* until the size is a multiple */
void fs_blob_clear(fs_blob *blob);

/* What a writer may be pointed at, whatever the extension. blob must outlive it. */
fs_output fs_blob_output(fs_blob *blob);

#endif
