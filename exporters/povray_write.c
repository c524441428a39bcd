/* SPDX-License-Identifier: MIT */
/* Words of the scene language that the POV-Ray exporter needs besides plain text. */
#include "povray.h"
#include <stdio.h>
#include <string.h>

void fs_povray_number(fs_writer *writer, double value, int digits) {
  char text[64];
  bool is_point = false; /* the decimal point of a locale may be several bytes */
  snprintf(text, sizeof text, "%.*g", digits, value == 0 ? 0.0 : value);
  for (const char *c = text; *c != '\0'; c++) {
    bool is_plain = strchr("0123456789+-e", *c) != NULL;
    if (is_plain)
      fs_writer_bytes(writer, c, 1);
    else if (!is_point)
      fs_writer_bytes(writer, ".", 1);
    is_point = !is_plain;
  }
}

void fs_povray_vector(fs_writer *writer, fs_vec3 value, int digits) {
  fs_writer_text(writer, "<");
  fs_povray_number(writer, value.x, digits);
  fs_writer_text(writer, ",");
  fs_povray_number(writer, value.y, digits);
  fs_writer_text(writer, ",");
  fs_povray_number(writer, value.z, digits);
  fs_writer_text(writer, ">");
}

/* Quotes and backslashes are escaped. */
void fs_povray_include(fs_writer *writer, const char *stem) {
  fs_writer_text(writer, "#include \"");
  for (; *stem != '\0'; stem++) {
    if (*stem == '"' || *stem == '\\') fs_writer_text(writer, "\\");
    fs_writer_bytes(writer, stem, 1);
  }
  fs_writer_text(writer, ".inc\"\n");
}
