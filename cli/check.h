/* SPDX-License-Identifier: MIT */
/* What the command check has found, and the ways it is shown. */
#ifndef FS_CLI_CHECK_H
#define FS_CLI_CHECK_H

#include "cli.h"

typedef struct check_result {
  int32_t order; /* required: 0 .. 3 */
  double tolerance;
  bool passes;        /* the required order */
  int32_t smoothness; /* highest order that holds with the tolerance; -1: not even G0 */
  fs_surface *surface, *start;
  fs_edges *edges;
  fs_shape shape, start_shape;
  fs_continuity *continuity;
  fs_crossings *crossings;
  bool has_start;
  double distance; /* largest from the start at equal parameters; NAN: the patches do not correspond */
} check_result;

void print_check(FILE *file, const arguments *arguments, const check_result *result);
void print_check_json(FILE *file, const arguments *arguments, const check_result *result);

#endif
