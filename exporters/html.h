/* SPDX-License-Identifier: MIT */
/* The page of the HTML exporter, made while building by web/build.mjs: its pieces around the title and the net. */
#ifndef FS_EXPORTERS_HTML_H
#define FS_EXPORTERS_HTML_H

#include "writer.h"

enum { FS_HTML_TITLE, FS_HTML_NET, FS_HTML_N_PIECES = 3 }; /* what follows the piece of that number */

extern const unsigned char *const fs_html_piece[FS_HTML_N_PIECES];
extern const size_t fs_html_piece_size[FS_HTML_N_PIECES];

/* Text for a place between tags or in a quoted attribute: valid UTF-8 and no markup, whatever the bytes. Control characters
   become spaces, bytes that are no UTF-8 become U+FFFD. */
void fs_html_write_text(fs_writer *writer, const char *text);

/* base64 [RFC 4648, section 4] of little-endian numbers, written as they come. All zero is a start. */
typedef struct fs_base64 {
  uint32_t waiting; /* bytes that make no group of three yet */
  int32_t n_waiting;
} fs_base64;
void fs_base64_uint8(fs_base64 *base64, fs_writer *writer, uint8_t byte);
void fs_base64_int32(fs_base64 *base64, fs_writer *writer, int32_t number);
void fs_base64_float64(fs_base64 *base64, fs_writer *writer, double number);
void fs_base64_finish(fs_base64 *base64, fs_writer *writer);

#endif
