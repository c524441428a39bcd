/* SPDX-License-Identifier: MIT */
/* Single role: inner coefficients of caps from the file beside a net whose format has no place for them. */
#include "file/file.h"
#include "mesh/cap_json.h"

#include <stdio.h>
#include <sys/stat.h>

/* NAME.caps.json beside the path; the caller frees. */
static fs_status make_caps_path(fs_context *ctx, const char *path, char **result) {
  const char *extension = fs_path_extension(path);
  size_t stem = (size_t)(extension - path) - (*extension != '\0'), size = stem + sizeof "." FS_CAPS_EXTENSION;
  char *caps_path = NULL;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, caps_path, size);
  snprintf(caps_path, size, "%.*s.%s", (int)stem, path, FS_CAPS_EXTENSION);
  *result = caps_path;
done:
  return status;
}

fs_status fs_file_read_caps(fs_context *ctx, const char *path, const fs_mesh *mesh, fs_cap_notes **notes) {
  char *caps_path = NULL, *bytes = NULL;
  size_t size = 0;
  fs_caps_file file = {0};
  struct stat info;
  fs_status status = FS_OK;
  FS_TRY(make_caps_path(ctx, path, &caps_path));
  if (stat(caps_path, &info) != 0 || !S_ISREG(info.st_mode)) goto done;
  FS_TRY(fs_file_read(ctx, caps_path, &bytes, &size));
  status = fs_caps_file_parse(ctx, bytes, size, &file);
  if (status != FS_OK) {
    fs_fail_named(ctx, caps_path);
    goto done;
  }
  if (file.n_vertices == mesh->n_vertices && file.n_faces == mesh->n_faces && file.checksum == fs_mesh_checksum(mesh)) {
    *notes = file.notes;
    file.notes = NULL;
  } else {
    fs_note(ctx, "%s was written for another net than %s: left out", fs_path_shown(caps_path), fs_path_shown(path));
  }
done:
  fs_cap_notes_free(ctx, file.notes);
  fs_file_free(ctx, bytes);
  fs_release(ctx, caps_path);
  return status;
}
