/* SPDX-License-Identifier: MIT */
/* Single role: buffered writing of text and little-endian numbers to a sink, whatever the locale and the machine. */
#include "writer.h"
#include "decimal.h"
#include "base/base.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void fail(fs_writer *writer, fs_status status, const char *text) {
  if (writer->status == FS_OK) writer->status = fs_fail(writer->ctx, status, "%s", text);
}

void fs_writer_start(fs_writer *writer, fs_context *ctx, const fs_output *output, const char *extension) {
  writer->ctx = ctx;
  writer->used = 0;
  writer->sink = (fs_sink){0};
  writer->status = output->open(output->user, extension, &writer->sink);
}

static void flush(fs_writer *writer) {
  if (writer->status == FS_OK && writer->used > 0)
    writer->status = writer->sink.write(writer->sink.user, writer->buffer, writer->used);
  writer->used = 0;
}

fs_status fs_writer_finish(fs_writer *writer) {
  flush(writer);
  return writer->status;
}

void fs_writer_bytes(fs_writer *writer, const void *bytes, size_t size) {
  const char *from = bytes;
  while (size > 0 && writer->status == FS_OK) {
    size_t room = sizeof writer->buffer - writer->used, n = size < room ? size : room;
    memcpy(writer->buffer + writer->used, from, n);
    writer->used += n;
    from += n;
    size -= n;
    if (writer->used == sizeof writer->buffer) flush(writer);
  }
}

void fs_writer_text(fs_writer *writer, const char *text) { fs_writer_bytes(writer, text, strlen(text)); }

void fs_writer_printf(fs_writer *writer, const char *format, ...) {
  /* A second try with the whole buffer where the first does not fit behind what waits there. */
  for (int32_t attempt = 0; attempt < 2 && writer->status == FS_OK; attempt++) {
    size_t room = sizeof writer->buffer - writer->used;
    va_list arguments;
    int n;
    va_start(arguments, format);
    n = vsnprintf(writer->buffer + writer->used, room, format, arguments);
    va_end(arguments);
    if (n >= 0 && (size_t)n < room) {
      writer->used += (size_t)n;
      return;
    }
    flush(writer);
  }
  fail(writer, FS_ERR_ARGUMENT, "a piece of text is too long to be written");
}

void fs_writer_line_text(fs_writer *writer, const char *text) {
  for (; *text != '\0'; text++) {
    char c = *text;
    if ((unsigned char)c < 32 || c == 127) c = ' ';
    fs_writer_bytes(writer, &c, 1);
  }
}

/* Room for so many bytes at buffer + used; whoever fills it adds to used. */
static char *make_room(fs_writer *writer, size_t size) {
  if (sizeof writer->buffer - writer->used < size) flush(writer);
  if (writer->status != FS_OK) writer->used = 0; /* nobody will see what is put there */
  return writer->buffer + writer->used;
}

static bool is_number(fs_writer *writer, double number) {
  if (!isfinite(number)) fail(writer, FS_ERR_NUMERIC, "a number to write is not finite");
  return isfinite(number);
}

void fs_writer_number(fs_writer *writer, double number) {
  if (is_number(writer, number)) writer->used += fs_decimal_shortest(make_room(writer, FS_DECIMAL_SIZE), number);
}

void fs_writer_rounded(fs_writer *writer, double number, int32_t digits) {
  if (!is_number(writer, number)) return;
  writer->used += fs_decimal_rounded(make_room(writer, FS_DECIMAL_SIZE), number == 0 ? 0 : number, digits);
}

void fs_writer_integer(fs_writer *writer, int64_t number) {
  writer->used += fs_decimal_integer(make_room(writer, FS_DECIMAL_SIZE), number);
}

void fs_writer_vec3(fs_writer *writer, fs_vec3 p, const char *separator) {
  fs_writer_number(writer, p.x);
  fs_writer_text(writer, separator);
  fs_writer_number(writer, p.y);
  fs_writer_text(writer, separator);
  fs_writer_number(writer, p.z);
}

void fs_writer_rounded_vec3(fs_writer *writer, fs_vec3 p, const char *separator, int32_t digits) {
  fs_writer_rounded(writer, p.x, digits);
  fs_writer_text(writer, separator);
  fs_writer_rounded(writer, p.y, digits);
  fs_writer_text(writer, separator);
  fs_writer_rounded(writer, p.z, digits);
}

static void write_little_endian(fs_writer *writer, uint64_t bits, size_t size) {
  unsigned char bytes[8];
  for (size_t i = 0; i < size; i++) bytes[i] = (unsigned char)(bits >> (8 * i));
  fs_writer_bytes(writer, bytes, size);
}

void fs_writer_uint8(fs_writer *writer, uint8_t number) { write_little_endian(writer, number, 1); }

void fs_writer_uint16(fs_writer *writer, uint16_t number) { write_little_endian(writer, number, 2); }

void fs_writer_uint32(fs_writer *writer, uint32_t number) { write_little_endian(writer, number, 4); }

void fs_writer_float32(fs_writer *writer, double number) {
  uint32_t bits;
  float single;
  if (!(fabs(number) <= FLT_MAX)) {
    fail(writer, FS_ERR_NUMERIC, "a number to write is not finite or too large for single precision");
    return;
  }
  single = (float)number;
  memcpy(&bits, &single, sizeof bits);
  write_little_endian(writer, bits, 4);
}

void fs_writer_float64(fs_writer *writer, double number) {
  uint64_t bits;
  if (!isfinite(number)) {
    fail(writer, FS_ERR_NUMERIC, "a number to write is not finite");
    return;
  }
  memcpy(&bits, &number, sizeof bits);
  write_little_endian(writer, bits, 8);
}
