/* SPDX-License-Identifier: MIT */
/* What the files of this room share: paths taken apart and named in messages. */
#ifndef FS_FILE_FILE_H
#define FS_FILE_FILE_H

#include <fairsurf/file.h>
#include "base/base.h"

/* Where the extension of a path starts, behind its dot; the end of the path where it has none. A dot that begins the name
   of a file starts none. */
const char *fs_path_extension(const char *path);

/* The path as messages show it: the whole or, if that leaves no room for a sentence, its last part. */
const char *fs_path_shown(const char *path);

/* FS_ERR_IO with the sentence "cannot VERB PATH: what the system says about error_number". */
fs_status fs_fail_file(fs_context *ctx, const char *verb, const char *path, int error_number);

/* Puts the path before the sentence that is there. */
void fs_fail_named(fs_context *ctx, const char *path);

/* Inner coefficients from NAME.caps.json beside the path, if there is one and it was written for this net: others are left
   out, with a note, as the net has been written again since. *notes stays where there is nothing. */
fs_status fs_file_read_caps(fs_context *ctx, const char *path, const fs_mesh *mesh, fs_cap_notes **notes);

#endif
