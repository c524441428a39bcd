/* SPDX-License-Identifier: MIT */
/* Single role: the tokens of the exchange structure: entities, references, reals, strings [ISO 10303-21:2002, 6 and 7]. */
#include "step.h"
#include "decimal.h"

#include <math.h>
#include <string.h>

int64_t fs_step_begin(fs_step_file *step, const char *text) {
  fs_step_reference(step, ++step->n_entities);
  fs_writer_text(&step->writer, "=");
  fs_writer_text(&step->writer, text);
  return step->n_entities;
}

void fs_step_end(fs_step_file *step) { fs_writer_text(&step->writer, ");\n"); }

int64_t fs_step_entity(fs_step_file *step, const char *text, const int64_t *reference) {
  int64_t entity = fs_step_begin(step, "");
  for (const char *percent; (percent = strchr(text, '%')) != NULL; text = percent + 1) {
    fs_writer_bytes(&step->writer, text, (size_t)(percent - text));
    fs_step_reference(step, *reference++);
  }
  fs_writer_text(&step->writer, text);
  fs_writer_text(&step->writer, ";\n");
  return entity;
}

void fs_step_reference(fs_step_file *step, int64_t entity) {
  fs_writer_bytes(&step->writer, "#", 1);
  fs_writer_integer(&step->writer, entity);
}

void fs_step_list(fs_step_file *step, int64_t n, const int64_t *entity) {
  for (int64_t k = 0; k < n; k++) {
    fs_writer_text(&step->writer, k == 0 ? "(" : k % 16 == 0 ? ",\n" : ",");
    fs_step_reference(step, entity[k]);
  }
  fs_writer_text(&step->writer, ")");
}

/* A real has a point, and its exponent a capital E: 1e-05 becomes 1.E-05. */
void fs_step_real(fs_step_file *step, double number) {
  char text[FS_DECIMAL_SIZE];
  size_t n, whole = 0;
  if (!isfinite(number)) {
    fs_writer_number(&step->writer, number);
    return;
  }
  n = fs_decimal_shortest(text, number == 0 ? 0 : number);
  while (whole < n && text[whole] != '.' && text[whole] != 'e') whole++;
  fs_writer_bytes(&step->writer, text, whole);
  if (whole == n || text[whole] == 'e') fs_writer_text(&step->writer, ".");
  for (size_t k = whole; k < n; k++) fs_writer_bytes(&step->writer, text[k] == 'e' ? "E" : &text[k], 1);
}

/* The code point at text and where the next one starts; 0xFFFFFFFF for bytes that are no UTF-8. */
static uint32_t take_code_point(const unsigned char **text) {
  static const uint32_t smallest[4] = {0, 0x80, 0x800, 0x10000};
  const unsigned char *c = *text;
  int n = *c < 0x80 ? 0 : *c >= 0xC2 && *c < 0xE0 ? 1 : *c >= 0xE0 && *c < 0xF0 ? 2 : *c >= 0xF0 && *c < 0xF5 ? 3 : -1;
  uint32_t point = n <= 0 ? *c : *c & (0x3Fu >> n);
  ++*text;
  if (n < 0) return UINT32_MAX;
  for (int k = 1; k <= n; k++) {
    if ((c[k] & 0xC0) != 0x80) return UINT32_MAX;
    point = point << 6 | (c[k] & 0x3Fu);
  }
  if (point < smallest[n] || point > 0x10FFFF || (point >= 0xD800 && point < 0xE000)) return UINT32_MAX;
  *text = c + n + 1;
  return point;
}

void fs_step_string(fs_step_file *step, const char *utf8) {
  fs_writer *writer = &step->writer;
  const unsigned char *text = (const unsigned char *)utf8;
  fs_writer_text(writer, "'");
  while (*text != '\0') {
    uint32_t point = take_code_point(&text);
    char c = (char)point;
    if (point == UINT32_MAX)
      fs_writer_text(writer, "?");
    else if (point < 32 || point == 127)
      fs_writer_text(writer, " ");
    else if (point == '\'' || point == '\\')
      fs_writer_printf(writer, "%c%c", c, c);
    else if (point < 127)
      fs_writer_bytes(writer, &c, 1);
    else if (point < 0x10000)
      fs_writer_printf(writer, "\\X2\\%04X\\X0\\", (unsigned)point);
    else
      fs_writer_printf(writer, "\\X4\\%08X\\X0\\", (unsigned)point);
  }
  fs_writer_text(writer, "'");
}
