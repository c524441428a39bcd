/* SPDX-License-Identifier: MIT */
/* Words of the scene language that the POV-Ray exporter needs besides plain text. */
#include "povray.h"

void fs_povray_number(fs_writer *writer, double value, int digits) { fs_writer_rounded(writer, value, digits); }

void fs_povray_vector(fs_writer *writer, fs_vec3 value, int digits) {
  fs_writer_text(writer, "<");
  fs_writer_rounded_vec3(writer, value, ",", digits);
  fs_writer_text(writer, ">");
}

/* Quotes and backslashes are escaped. */
void fs_povray_file(fs_writer *writer, const char *stem, const char *extension) {
  fs_writer_text(writer, "\"");
  for (; *stem != '\0'; stem++) {
    if (*stem == '"' || *stem == '\\') fs_writer_text(writer, "\\");
    fs_writer_bytes(writer, stem, 1);
  }
  fs_writer_printf(writer, ".%s\"", extension);
}
