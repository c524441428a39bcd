/* SPDX-License-Identifier: MIT */
/* Single role: 3MF (3D Manufacturing Format, core specification 1.3): a zip archive, made by libzip, of three XML files. The
   surface as one object in millimetres; an open one is marked as a surface, which slicers do not fill. */
#include "base/base.h"
#include "solid.h"
#include "writer.h"

#include <stdio.h>
#include <string.h>
#include <zip.h>

enum { STEPS };
enum { POINT_DIGITS = 9 };

static const char content_types[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "</Types>\n";
static const char relationships[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n"
    "</Relationships>\n";

/* ---- bytes in memory, as an output ---- */

typedef struct memory {
  fs_context *ctx;
  char *bytes;
  size_t size, room;
} memory;

static fs_status memory_write(void *user, const void *bytes, size_t size) {
  memory *m = user;
  if (m->room - m->size < size) {
    size_t room = 2 * m->room + size;
    char *larger = fs_allocate(m->ctx, room, 1);
    if (larger == NULL) return FS_ERR_MEMORY;
    if (m->size > 0) memcpy(larger, m->bytes, m->size);
    fs_release(m->ctx, m->bytes);
    m->bytes = larger;
    m->room = room;
  }
  memcpy(m->bytes + m->size, bytes, size);
  m->size += size;
  return FS_OK;
}

static fs_status memory_open(void *user, const char *extension, fs_sink *sink) {
  (void)extension;
  *sink = (fs_sink){memory_write, user};
  return FS_OK;
}

/* ---- the model ---- */

/* Whole sequences of UTF-8 pass; bytes that begin none, and characters that XML forbids, become "_". */
static size_t sequence_size(const unsigned char *s) {
  size_t n = s[0] < 0x80                   ? 1
             : s[0] >= 0xc2 && s[0] < 0xe0 ? 2
             : s[0] >= 0xe0 && s[0] < 0xf0 ? 3
             : s[0] >= 0xf0 && s[0] < 0xf5 ? 4
                                           : 0;
  for (size_t i = 1; i < n; i++)
    if ((s[i] & 0xc0) != 0x80) return 0;
  if (n == 3 && ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] >= 0xa0))) return 0;
  if (n == 3 && s[0] == 0xef && s[1] == 0xbf && s[2] >= 0xbe) return 0;
  if (n == 4 && ((s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] >= 0x90))) return 0;
  return n == 1 && s[0] < 32 ? 0 : n;
}

static void write_escaped(fs_writer *w, const char *text) {
  for (const unsigned char *s = (const unsigned char *)text; *s != '\0';) {
    size_t n = sequence_size(s);
    if (*s == '&')
      fs_writer_text(w, "&amp;");
    else if (*s == '<')
      fs_writer_text(w, "&lt;");
    else if (*s == '>')
      fs_writer_text(w, "&gt;");
    else if (*s == '"')
      fs_writer_text(w, "&quot;");
    else
      fs_writer_bytes(w, n > 0 ? (const char *)s : "_", n > 0 ? n : 1);
    s += n > 0 ? n : 1;
  }
}

static void write_metadata(fs_writer *w, const char *name, const char *value) {
  fs_writer_text(w, " <metadata name=\"");
  fs_writer_text(w, name);
  fs_writer_text(w, "\">");
  write_escaped(w, value);
  fs_writer_text(w, "</metadata>\n");
}

static void write_coordinate(fs_writer *w, const char *before, double value) {
  fs_writer_text(w, before);
  fs_writer_rounded(w, value, POINT_DIGITS);
}

static void write_corner(fs_writer *w, const char *before, int32_t vertex) {
  fs_writer_text(w, before);
  fs_writer_integer(w, vertex);
}

static void write_mesh(fs_writer *w, const fs_triangles *t, bool is_reversed) {
  fs_writer_text(w, "   <mesh>\n    <vertices>\n");
  for (int32_t v = 0; v < t->n_vertices; v++) {
    write_coordinate(w, "     <vertex x=\"", t->position[v].x);
    write_coordinate(w, "\" y=\"", t->position[v].y);
    write_coordinate(w, "\" z=\"", t->position[v].z);
    fs_writer_text(w, "\"/>\n");
  }
  fs_writer_text(w, "    </vertices>\n    <triangles>\n");
  for (int32_t i = 0; i < t->n_triangles; i++) {
    const int32_t *corner = t->corner + 3 * (size_t)i;
    write_corner(w, "     <triangle v1=\"", corner[0]);
    write_corner(w, "\" v2=\"", corner[is_reversed ? 2 : 1]);
    write_corner(w, "\" v3=\"", corner[is_reversed ? 1 : 2]);
    fs_writer_text(w, "\"/>\n");
  }
  fs_writer_text(w, "    </triangles>\n   </mesh>\n");
}

static fs_status write_model(fs_context *ctx, const fs_model *model, const fs_triangles *t, bool is_open, memory *m) {
  fs_output output = {memory_open, m};
  fs_writer writer, *w = &writer;
  bool is_reversed = !is_open && fs_triangles_volume(t) < 0;
  char program[32];
  snprintf(program, sizeof program, "fairsurf %s", fs_version());
  if (is_reversed) fs_note(ctx, "the closed surface is inside out; its triangles are turned round");
  fs_writer_start(w, ctx, &output, "model");
  fs_writer_text(w, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" "
                    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n");
  write_metadata(w, "Title", model->name);
  write_metadata(w, "Application", program);
  if (model->made_with != NULL) write_metadata(w, "Description", model->made_with);
  fs_writer_text(w, " <resources>\n  <object id=\"1\" name=\"");
  write_escaped(w, model->name);
  fs_writer_printf(w, "\" type=\"%s\">\n", is_open ? "surface" : "model");
  write_mesh(w, t, is_reversed);
  fs_writer_text(w, "  </object>\n </resources>\n <build>\n  <item objectid=\"1\"/>\n </build>\n</model>\n");
  return fs_writer_finish(w);
}

/* ---- the archive ---- */

static fs_status fail_zip(fs_context *ctx, const zip_error_t *error) {
  if (zip_error_code_zip(error) == ZIP_ER_MEMORY) return fs_fail(ctx, FS_ERR_MEMORY, "out of memory");
  return fs_fail(ctx, FS_ERR_IO, "the zip archive could not be made: error %d of libzip", zip_error_code_zip(error));
}

/* bytes must live until the archive is closed. The date is the first of the format, so that equal input gives equal bytes. */
static fs_status add_file(fs_context *ctx, zip_t *archive, const char *name, const void *bytes, size_t size) {
  zip_source_t *source = zip_source_buffer(archive, bytes, size, 0);
  zip_int64_t index = source != NULL ? zip_file_add(archive, name, source, ZIP_FL_ENC_UTF_8) : -1;
  if (index < 0) {
    zip_source_free(source);
    return fail_zip(ctx, zip_get_error(archive));
  }
  if (zip_file_set_dostime(archive, (zip_uint64_t)index, 0, 0x21, 0) < 0) return fail_zip(ctx, zip_get_error(archive));
  return FS_OK;
}

/* Makes the archive inside the source and keeps that open for reading. */
static fs_status pack(fs_context *ctx, zip_source_t *source, const memory *model) {
  fs_status status = FS_OK;
  zip_error_t error;
  zip_t *archive;
  zip_error_init(&error);
  archive = zip_open_from_source(source, ZIP_TRUNCATE, &error);
  if (archive == NULL) status = fail_zip(ctx, &error);
  zip_error_fini(&error);
  if (archive == NULL) return status;
  zip_source_keep(source); /* closing the archive gives one reference up */
  FS_TRY(add_file(ctx, archive, "[Content_Types].xml", content_types, sizeof content_types - 1));
  FS_TRY(add_file(ctx, archive, "_rels/.rels", relationships, sizeof relationships - 1));
  FS_TRY(add_file(ctx, archive, "3D/3dmodel.model", model->bytes, model->size));
  if (zip_close(archive) < 0)
    status = fail_zip(ctx, zip_get_error(archive));
  else
    archive = NULL;
done:
  if (archive != NULL) zip_discard(archive);
  return status;
}

static fs_status copy_out(fs_context *ctx, zip_source_t *source, const fs_output *output) {
  char piece[4096];
  zip_int64_t n;
  fs_writer writer;
  if (zip_source_open(source) < 0) return fail_zip(ctx, zip_source_error(source));
  fs_writer_start(&writer, ctx, output, "3mf");
  while ((n = zip_source_read(source, piece, sizeof piece)) > 0) fs_writer_bytes(&writer, piece, (size_t)n);
  if (n < 0 && writer.status == FS_OK) writer.status = fail_zip(ctx, zip_source_error(source));
  zip_source_close(source);
  return fs_writer_finish(&writer);
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_status status = FS_OK;
  memory text = {.ctx = ctx};
  fs_triangles *triangles = NULL;
  fs_rim *rim = NULL;
  zip_source_t *source = NULL;
  zip_error_t error;
  zip_error_init(&error);
  FS_TRY(fs_tessellate(ctx, model->surface, (int32_t)param[STEPS], &triangles));
  FS_TRY(fs_rim_create(ctx, triangles, &rim));
  FS_TRY(write_model(ctx, model, triangles, rim->n_loops > 0, &text));
  source = zip_source_buffer_create(NULL, 0, 0, &error);
  if (source == NULL) FS_TRY(fail_zip(ctx, &error));
  FS_TRY(pack(ctx, source, &text));
  FS_TRY(copy_out(ctx, source, output));
done:
  zip_source_free(source);
  zip_error_fini(&error);
  fs_release(ctx, text.bytes);
  fs_rim_free(ctx, rim);
  fs_triangles_free(ctx, triangles);
  return status;
}

const fs_exporter fs_exporter_threemf = {
    .name = "3mf",
    .extension = "3mf",
    .summary = "3MF: the surface as triangles in millimetres, for printing",
    .params = (const fs_param[]){FS_PARAM_STEPS, {.name = NULL}},
    .what = FS_EXPORT_SURFACE,
    .write = write,
};
