/* SPDX-License-Identifier: MIT */
/* Single role: identifiers of OpenSCAD: a name for the module that is legal and replaces nothing of the language.

   The words are the keywords, modules, functions and constants of OpenSCAD 2021.01 and of its development versions since,
   and those kept from before for old files. */
#include "openscad.h"

#include <stdio.h>
#include <string.h>

static const char words[] =
    " abs acos asin assert assign atan atan2 ceil child children chr circle color concat cos cross cube cylinder "
    "difference dxf_cross dxf_dim dxf_linear_extrude dxf_rotate_extrude each echo else exp false fill floor "
    "fontmetrics "
    "for function group hull if import import_dxf import_off import_stl include inf intersection intersection_for "
    "is_bool is_function is_list is_num is_object is_string is_undef len let linear_extrude ln log lookup max min "
    "minkowski mirror module multmatrix nan norm object offset ord parent_module PI polygon polyhedron pow projection "
    "rands render resize roof rotate rotate_extrude round scale search select sign sin sphere sqrt square str surface "
    "tan text textmetrics translate true undef union use version version_num ";

static bool is_word(const char *name) {
  char between_spaces[FS_OPENSCAD_NAME + 2];
  snprintf(between_spaces, sizeof between_spaces, " %s ", name);
  return strstr(words, between_spaces) != NULL;
}

static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
static bool is_digit(char c) { return c >= '0' && c <= '9'; }

void fs_openscad_name(const char *stem, char name[FS_OPENSCAD_NAME]) {
  static const char suffix[] = "_surface";
  size_t n = 0;
  if (is_digit(*stem)) name[n++] = '_';
  for (; *stem != '\0' && n + 1 < FS_OPENSCAD_NAME; stem++)
    name[n++] = is_letter(*stem) || is_digit(*stem) ? *stem : '_';
  name[n] = '\0';
  /* every word leaves room for the suffix */
  if (n == 0 || is_word(name)) memcpy(name + n, suffix, sizeof suffix);
}
