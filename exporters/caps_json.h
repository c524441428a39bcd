/* SPDX-License-Identifier: MIT */
/* Inner coefficients in a file beside a net whose format has no place for them. */
#ifndef FS_EXPORTERS_CAPS_JSON_H
#define FS_EXPORTERS_CAPS_JSON_H

#include "writer.h"

#define FS_PARAM_CAPS_FILE                                                                                      \
  {                                                                                                             \
    .name = "caps-file", .summary = "write inner coefficients of a net's caps to NAME.caps.json", .initial = 1, \
    .min = 0, .max = 1, .choices = (const char *const[]) {                                                      \
      "no", "yes", NULL                                                                                         \
    }                                                                                                           \
  }

/* A comment, with the end of its line: where the coefficients are, or that they are lost. Nothing where there are none. */
void fs_caps_json_comment(fs_writer *writer, const fs_model *model, bool is_written);

/* Opens and writes NAME.caps.json where there are coefficients; or notes that they are lost. */
fs_status fs_caps_json_write(fs_context *ctx, const fs_model *model, bool is_written, const fs_output *output);

#endif
