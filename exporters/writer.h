/* SPDX-License-Identifier: MIT */
/* What the exporters share: buffered writing of text and little-endian numbers, and the surface as triangles.
   The first failure sticks: later calls do nothing, and fs_writer_finish returns it. */
#ifndef FS_EXPORTERS_WRITER_H
#define FS_EXPORTERS_WRITER_H

#include <fairsurf/export.h>

enum { FS_WRITER_BUFFER = 16384 };

typedef struct fs_writer {
  fs_context *ctx;
  fs_sink sink;
  fs_status status;
  size_t used;
  char buffer[FS_WRITER_BUFFER];
} fs_writer;

/* Opens the file of that extension. Nothing to free afterwards, whatever happens. */
void fs_writer_start(fs_writer *writer, fs_context *ctx, const fs_output *output, const char *extension);
/* Hands the rest to the sink; the status of all of it. */
fs_status fs_writer_finish(fs_writer *writer);

void fs_writer_bytes(fs_writer *writer, const void *bytes, size_t size);
void fs_writer_text(fs_writer *writer, const char *text);
/* At most FS_WRITER_BUFFER - 1 bytes per call; not for floating point, whose decimal point follows the locale. */
void fs_writer_printf(fs_writer *writer, const char *format, ...) FS_PRINTF(2, 3);
/* Any text in one line: control characters become spaces. */
void fs_writer_line_text(fs_writer *writer, const char *text);

/* The shortest text that reads back as the same double. FS_ERR_NUMERIC if it is not finite. */
void fs_writer_number(fs_writer *writer, double number);
/* As "%.{digits}g" does in the C locale, with 0 for -0. FS_ERR_NUMERIC if it is not finite. */
void fs_writer_rounded(fs_writer *writer, double number, int32_t digits);
void fs_writer_integer(fs_writer *writer, int64_t number);
/* Three of them with separator between. */
void fs_writer_vec3(fs_writer *writer, fs_vec3 p, const char *separator);
void fs_writer_rounded_vec3(fs_writer *writer, fs_vec3 p, const char *separator, int32_t digits);

/* Little-endian. A float that is not finite, or too large for single precision, is FS_ERR_NUMERIC. */
void fs_writer_uint8(fs_writer *writer, uint8_t number);
void fs_writer_uint16(fs_writer *writer, uint16_t number);
void fs_writer_uint32(fs_writer *writer, uint32_t number);
void fs_writer_float32(fs_writer *writer, double number);
void fs_writer_float64(fs_writer *writer, double number);

/* The parameter "steps" of exporters that write triangles. */
#define FS_PARAM_STEPS                                                                                      \
  {                                                                                                         \
    .name = "steps", .summary = "quadrilaterals along a patch side of the surface", .initial = 8, .min = 1, \
    .max = 1024                                                                                             \
  }

extern const fs_exporter fs_exporter_obj, fs_exporter_off, fs_exporter_ply, fs_exporter_stl;

#endif
