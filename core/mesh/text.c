/* SPDX-License-Identifier: MIT */
/* Single role: lines and words of a text in memory. */
#include "mesh/read.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

fs_status fs_text_open(fs_context *ctx, const char *bytes, size_t size, fs_text *text) {
  static const char byte_order_mark[] = "\xEF\xBB\xBF";
  if (size == 0) return fs_fail(ctx, FS_ERR_FORMAT, "the file is empty");
  *text = (fs_text){.ctx = ctx, .at = bytes, .end = bytes + size, .line = 1, .c_locale = (locale_t)0};
  if (size >= 3 && memcmp(bytes, byte_order_mark, 3) == 0) text->at += 3;
  text->c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (text->c_locale == (locale_t)0) return fs_fail(ctx, FS_ERR_MEMORY, "out of memory: no room for a locale");
  return FS_OK;
}

void fs_text_close(fs_text *text) {
  if (text->c_locale != (locale_t)0) freelocale(text->c_locale);
  text->c_locale = (locale_t)0;
}

/* Length of the end of line at p: 0 where there is none. */
static size_t line_end(const fs_text *text, const char *p) {
  if (p == text->end) return 0;
  if (*p == '\n') return 1;
  if (*p != '\r') return 0;
  return p + 1 < text->end && p[1] == '\n' ? 2 : 1;
}

static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

static bool joins_lines(const fs_text *text, const char *p) {
  return text->has_backslash && *p == '\\' && line_end(text, p + 1) > 0;
}

/* Past spaces and joined line ends, up to a word, a comment, the end of the line or of the text. */
static void skip_space(fs_text *text) {
  while (text->at < text->end) {
    if (is_space(*text->at)) {
      text->at++;
    } else if (joins_lines(text, text->at)) {
      text->at += 1 + line_end(text, text->at + 1);
      text->line++;
    } else {
      break;
    }
  }
}

bool fs_text_word(fs_text *text, fs_word *word) {
  const char *begin;
  skip_space(text);
  begin = text->at;
  if (begin == text->end || line_end(text, begin) > 0 || (text->comment != 0 && *begin == text->comment)) return false;
  while (text->at < text->end && !is_space(*text->at) && line_end(text, text->at) == 0 && !joins_lines(text, text->at))
    text->at++;
  *word = (fs_word){begin, (size_t)(text->at - begin)};
  return true;
}

bool fs_text_line(fs_text *text) {
  fs_word word;
  while (fs_text_word(text, &word)) continue;
  while (text->at < text->end && line_end(text, text->at) == 0) text->at++; /* a comment */
  if (text->at == text->end) return false;
  text->at += line_end(text, text->at);
  text->line++;
  return true;
}

bool fs_text_any_word(fs_text *text, fs_word *word) {
  while (!fs_text_word(text, word))
    if (!fs_text_line(text)) return false;
  return true;
}

size_t fs_text_rest(const fs_text *text) { return (size_t)(text->end - text->at); }

bool fs_word_is(fs_word word, const char *string) {
  return strlen(string) == word.size && memcmp(word.at, string, word.size) == 0;
}

const char *fs_word_quote(fs_word word, char quote[FS_QUOTE_SIZE]) {
  size_t room = FS_QUOTE_SIZE - 6, n = word.size <= room ? word.size : room; /* two quotes, dots, zero */
  char *next = quote;
  *next++ = '\'';
  for (size_t i = 0; i < n; i++) *next++ = word.at[i] > ' ' && word.at[i] <= '~' ? word.at[i] : '?';
  memcpy(next, n < word.size ? "...'" : "'", n < word.size ? 5 : 2);
  return quote;
}

fs_status fs_text_fail(fs_text *text, const char *format, ...) {
  char sentence[224];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(sentence, sizeof sentence, format, arguments);
  va_end(arguments);
  return fs_fail(text->ctx, FS_ERR_FORMAT, "line %lld: %s", (long long)text->line, sentence);
}
