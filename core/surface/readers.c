/* SPDX-License-Identifier: MIT */
/* Single role: the table of readers of surfaces and the choice among them by extension. */
#include "surface/spline.h"

#include <stdio.h>

const fs_surface_reader *const fs_surface_readers[] = {&fs_surface_reader_bv, &fs_surface_reader_spl,
                                                       &fs_surface_reader_step, &fs_surface_reader_stp, NULL};

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c + ('a' - 'A')) : c; }

static bool equals(const char *a, const char *b) {
  while (*a != '\0' && lower(*a) == lower(*b)) a++, b++;
  return lower(*a) == lower(*b);
}

fs_status fs_surface_parse(fs_context *ctx, const char *extension, const char *bytes, size_t size,
                           fs_surface **surface) {
  char known[64] = "";
  size_t used = 0;
  for (const fs_surface_reader *const *reader = fs_surface_readers; *reader != NULL; reader++) {
    if (equals((*reader)->extension, extension)) {
      fs_surface *made = NULL;
      fs_status status = (*reader)->parse(ctx, bytes, size, &made);
      if (status == FS_OK) status = fs_surface_stitch(ctx, made, 1e-9, NULL);
      if (status == FS_OK)
        *surface = made;
      else
        fs_surface_free(ctx, made);
      return status;
    }
    used += (size_t)snprintf(known + used, sizeof known - used, " .%s", (*reader)->extension);
    if (used >= sizeof known) used = sizeof known - 1;
  }
  return fs_fail(ctx, FS_ERR_UNSUPPORTED, "no reader of surfaces for '.%.20s'; there are readers for%s", extension,
                 known);
}
