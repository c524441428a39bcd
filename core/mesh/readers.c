/* SPDX-License-Identifier: MIT */
/* Single role: the table of readers and the choice among them by extension. */
#include "mesh/read.h"

#include <stdio.h>

const fs_reader *const fs_readers[] = {&fs_reader_obj,
                                       &fs_reader_off,
                                       &fs_reader_ply,
                                       &fs_reader_xyz,
#ifdef FS_HAVE_DRACO
                                       &fs_reader_drc,
#endif
                                       NULL};

void fs_polygons_clear(fs_context *ctx, fs_polygons *polygons) {
  fs_release(ctx, polygons->position);
  fs_release(ctx, polygons->face_start);
  fs_release(ctx, polygons->corner);
  *polygons = (fs_polygons){0};
}

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c + ('a' - 'A')) : c; }

static bool equals(const char *a, const char *b) {
  while (*a != '\0' && lower(*a) == lower(*b)) a++, b++;
  return lower(*a) == lower(*b);
}

void fs_mesh_notes_clear(fs_context *ctx, fs_mesh_notes *notes) {
  fs_release(ctx, notes->fixed);
  fs_release(ctx, notes->made_with);
  fs_release(ctx, notes->functional);
  fs_cap_notes_free(ctx, notes->caps);
  *notes = (fs_mesh_notes){0};
}

static fs_status parse(fs_context *ctx, const fs_reader *reader, const char *bytes, size_t size, fs_mesh **mesh,
                       fs_mesh_notes *notes) {
  fs_status status;
  if (notes != NULL && reader->parse_notes != NULL) return reader->parse_notes(ctx, bytes, size, mesh, notes);
  status = reader->parse(ctx, bytes, size, mesh);
  if (status == FS_OK && notes != NULL) *notes = (fs_mesh_notes){0};
  return status;
}

fs_status fs_mesh_parse(fs_context *ctx, const char *extension, const char *bytes, size_t size, fs_mesh **mesh) {
  return fs_mesh_parse_notes(ctx, extension, bytes, size, mesh, NULL);
}

fs_status fs_mesh_parse_notes(fs_context *ctx, const char *extension, const char *bytes, size_t size, fs_mesh **mesh,
                              fs_mesh_notes *notes) {
  char known[128] = "";
  size_t used = 0;
  for (const fs_reader *const *reader = fs_readers; *reader != NULL; reader++) {
    if (equals((*reader)->extension, extension)) return parse(ctx, *reader, bytes, size, mesh, notes);
    used += (size_t)snprintf(known + used, sizeof known - used, " .%s", (*reader)->extension);
    if (used >= sizeof known) used = sizeof known - 1;
  }
  return fs_fail(ctx, FS_ERR_UNSUPPORTED, "no reader for '.%.20s'; there are readers for%s", extension, known);
}
