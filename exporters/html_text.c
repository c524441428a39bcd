/* SPDX-License-Identifier: MIT */
/* Single role: text and numbers in the form in which a page holds them: escaped UTF-8, and base64. */
#include "html.h"

#include <string.h>

/* Bytes of the valid UTF-8 sequence at text (zero-terminated), 0 where there is none: no overlong forms, no surrogates,
   nothing above U+10FFFF [RFC 3629, section 4]. */
static size_t utf8_size(const unsigned char *text) {
  unsigned char first = text[0], low = 0x80, high = 0xBF;
  size_t size = first < 0x80                     ? 1
                : first >= 0xC2 && first <= 0xDF ? 2
                : (first & 0xF0) == 0xE0         ? 3
                : first >= 0xF0 && first <= 0xF4 ? 4
                                                 : 0;
  if (first == 0xE0) low = 0xA0;
  if (first == 0xED) high = 0x9F;
  if (first == 0xF0) low = 0x90;
  if (first == 0xF4) high = 0x8F;
  for (size_t i = 1; i < size; i++, low = 0x80, high = 0xBF)
    if (text[i] < low || text[i] > high) return 0;
  return size;
}

void fs_html_write_text(fs_writer *writer, const char *text) {
  const unsigned char *c = (const unsigned char *)text;
  while (*c != '\0') {
    size_t size = utf8_size(c);
    if (size == 0)
      fs_writer_text(writer, "\xEF\xBF\xBD");
    else if (*c == '&')
      fs_writer_text(writer, "&amp;");
    else if (*c == '<')
      fs_writer_text(writer, "&lt;");
    else if (*c == '>')
      fs_writer_text(writer, "&gt;");
    else if (*c == '"')
      fs_writer_text(writer, "&quot;");
    else if (*c < 0x20 || *c == 0x7F)
      fs_writer_text(writer, " ");
    else
      fs_writer_bytes(writer, c, size);
    c += size > 0 ? size : 1;
  }
}

/* n = 1 .. 3 bytes in the upper part of a group of 24 bits. */
static void write_group(fs_writer *writer, uint32_t group, int32_t n) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  char text[4];
  for (int k = 0; k < 4; k++) text[k] = k <= n ? digits[group >> (18 - 6 * k) & 63] : '=';
  fs_writer_bytes(writer, text, sizeof text);
}

void fs_base64_uint8(fs_base64 *base64, fs_writer *writer, uint8_t byte) {
  base64->waiting = base64->waiting << 8 | byte;
  if (++base64->n_waiting < 3) return;
  write_group(writer, base64->waiting, 3);
  *base64 = (fs_base64){0};
}

void fs_base64_int32(fs_base64 *base64, fs_writer *writer, int32_t number) {
  for (int k = 0; k < 4; k++) fs_base64_uint8(base64, writer, (uint8_t)((uint32_t)number >> 8 * k));
}

void fs_base64_float64(fs_base64 *base64, fs_writer *writer, double number) {
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  for (int k = 0; k < 8; k++) fs_base64_uint8(base64, writer, (uint8_t)(bits >> 8 * k));
}

void fs_base64_finish(fs_base64 *base64, fs_writer *writer) {
  if (base64->n_waiting > 0) write_group(writer, base64->waiting << 8 * (3 - base64->n_waiting), base64->n_waiting);
  *base64 = (fs_base64){0};
}
