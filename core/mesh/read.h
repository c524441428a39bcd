/* SPDX-License-Identifier: MIT */
/* What the readers share: words and numbers of a text in memory, and polygons on their way to a mesh. */
#ifndef FS_MESH_READ_H
#define FS_MESH_READ_H

#include "mesh/mesh.h"

#include <locale.h>

/* A text in memory, read word by word; it need not end with a zero byte. Lines end with LF, CR LF or CR. */
typedef struct fs_text {
  fs_context *ctx;
  const char *at, *end;
  int64_t line;       /* from 1 */
  char comment;       /* starts a comment up to the end of the line where a word could begin; 0: no such character */
  bool has_backslash; /* a backslash before the end of a line joins it with the next */
  locale_t c_locale;  /* numbers have a decimal point whatever the locale of the program */
} fs_text;

typedef struct fs_word {
  const char *at;
  size_t size;
} fs_word;

fs_status fs_text_open(fs_context *ctx, const char *bytes, size_t size, fs_text *text); /* "the file is empty" */
void fs_text_close(fs_text *text); /* of a text that was opened, or is all zero */

bool fs_text_word(fs_text *text, fs_word *word);     /* the next word of this line; false: the line has no more */
bool fs_text_line(fs_text *text);                    /* to the next line; false: there is none */
bool fs_text_any_word(fs_text *text, fs_word *word); /* the next word, on this line or a later one */
size_t fs_text_rest(const fs_text *text);            /* bytes that were not read yet */

bool fs_word_is(fs_word word, const char *string);

/* The word in single quotes, cut and with ? for characters that do not print, for messages. */
enum { FS_QUOTE_SIZE = 28 };
const char *fs_word_quote(fs_word word, char quote[FS_QUOTE_SIZE]);

/* FS_ERR_FORMAT and "line 12: " with the sentence. */
fs_status fs_text_fail(fs_text *text, const char *format, ...) FS_PRINTF(2, 3);

/* Numbers, exact to the last bit; what overflows, nan and inf are refused, with the line. */
fs_status fs_text_real(fs_text *text, fs_word word, double *x);
fs_status fs_text_integer(fs_text *text, fs_word word, int32_t *i);

/* Polygons with arrays as fs_mesh_create takes them. */
typedef struct fs_polygons {
  int32_t n_vertices, n_faces;
  fs_vec3 *position;
  int32_t *face_start, *corner;
} fs_polygons;
void fs_polygons_clear(fs_context *ctx, fs_polygons *polygons); /* all zero is allowed */

extern const fs_reader fs_reader_obj, fs_reader_off, fs_reader_ply, fs_reader_xyz, fs_reader_drc;

#endif
