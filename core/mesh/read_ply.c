/* SPDX-License-Identifier: MIT */
/* Single role: the data of PLY files, ascii and binary_little_endian: positions, polygons and inner coefficients of caps are
   kept, the other elements and properties are stepped over. Sizes are held against the bytes that are there before memory
   is asked for. */
#include "mesh/ply.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static size_t type_size(ply_type type) {
  static const uint8_t size[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
  return size[type];
}

fs_status fs_ply_fail(ply_file *p, const char *format, ...) {
  char sentence[160];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(sentence, sizeof sentence, format, arguments);
  va_end(arguments);
  if (!p->header.is_binary) return fs_text_fail(p->text, "%s", sentence);
  return fs_fail(p->text->ctx, FS_ERR_FORMAT, "byte %zu: %s", (size_t)(p->text->at - p->begin), sentence);
}

static double decode(const char *bytes, ply_type type) {
  const unsigned char *b = (const unsigned char *)bytes;
  uint64_t bits = 0;
  uint32_t low;
  float single;
  double value;
  for (size_t i = type_size(type); i > 0; i--) bits = bits << 8 | b[i - 1];
  low = (uint32_t)bits;
  switch (type) {
  case PLY_INT8:
    return (int8_t)low;
  case PLY_INT16:
    return (int16_t)low;
  case PLY_INT32:
    return (int32_t)low;
  case PLY_FLOAT32:
    memcpy(&single, &low, sizeof single);
    return single;
  case PLY_FLOAT64:
    memcpy(&value, &bits, sizeof value);
    return value;
  default:
    return low;
  }
}

fs_status fs_ply_value(ply_file *p, ply_type type, double *value) {
  fs_text *text = p->text;
  fs_word word;
  if (p->header.is_binary) {
    if (fs_text_rest(text) < type_size(type)) return fs_ply_fail(p, "the file ends too early");
    *value = decode(text->at, type);
    text->at += type_size(type);
    return FS_OK;
  }
  if (!fs_text_any_word(text, &word)) return fs_ply_fail(p, "the file ends too early");
  return fs_text_real(text, word, value);
}

static fs_status skip_values(ply_file *p, ply_type type, int32_t n) {
  fs_word word;
  if (p->header.is_binary) { /* the caller knows that they are there, or it is one */
    if (fs_text_rest(p->text) < type_size(type) * (size_t)n) return fs_ply_fail(p, "the file ends too early");
    p->text->at += type_size(type) * (size_t)n;
    return FS_OK;
  }
  for (int32_t i = 0; i < n; i++)
    if (!fs_text_any_word(p->text, &word)) return fs_ply_fail(p, "the file ends too early");
  return FS_OK;
}

fs_status fs_ply_length(ply_file *p, const ply_property *property, int32_t *n) {
  size_t bytes = p->header.is_binary ? type_size(property->type) : 2; /* per value */
  double value = 0;
  fs_status status = fs_ply_value(p, property->count_type, &value);
  if (status != FS_OK) return status;
  if (!(value >= 0) || value > INT32_MAX || value != floor(value) ||
      value * (double)bytes > (double)fs_text_rest(p->text))
    return fs_ply_fail(p, "a list of %.10g values does not fit into the %zu bytes that follow", value,
                       fs_text_rest(p->text));
  *n = (int32_t)value;
  return FS_OK;
}

static fs_status read_corners(ply_file *p, const ply_property *property, int32_t f) {
  int32_t n = 0, start = p->polygons.face_start[f], n_vertices = p->header.count[PLY_VERTEX];
  fs_status status = fs_ply_length(p, property, &n);
  if (status != FS_OK) return status;
  if (n < 3) return fs_ply_fail(p, "face %d has %d vertices, but a face needs 3 or more", f, n);
  for (int32_t i = 0; i < n; i++) {
    double value = 0;
    status = fs_ply_value(p, property->type, &value);
    if (status != FS_OK) return status;
    if (!(value >= 0) || value >= n_vertices || value != floor(value))
      return fs_ply_fail(p, "face %d uses vertex %.10g, but there are only %d", f, value, n_vertices);
    p->polygons.corner[start + i] = (int32_t)value;
  }
  p->polygons.face_start[f + 1] = start + n;
  return FS_OK;
}

static fs_status read_coordinate(ply_file *p, const ply_property *property, int32_t v) {
  double value = 0;
  fs_vec3 *x = &p->polygons.position[v];
  fs_status status = fs_ply_value(p, property->type, &value);
  if (status != FS_OK) return status;
  if (!isfinite(value)) return fs_ply_fail(p, "vertex %d has a coordinate that is not finite", v);
  if (property->role == PLY_X) x->x = value;
  if (property->role == PLY_Y) x->y = value;
  if (property->role == PLY_Z) x->z = value;
  return FS_OK;
}

static fs_status read_item(ply_file *p, const ply_element *element, int32_t number) {
  fs_status status = FS_OK;
  fs_word word;
  for (int32_t i = 0; i < element->n_properties && status == FS_OK; i++) {
    const ply_property *property = &p->header.property[element->property_start + i];
    int32_t n = 1;
    if (property->role == PLY_CORNERS) {
      status = read_corners(p, property, number);
    } else if (property->role >= PLY_CAP_VERTEX && property->role <= PLY_CAP_COEFFICIENTS) {
      status = fs_ply_read_cap(p, property, number);
    } else if (property->role != PLY_SKIPPED) {
      status = read_coordinate(p, property, number);
    } else {
      if (property->count_type != PLY_NONE) status = fs_ply_length(p, property, &n);
      if (status == FS_OK) status = skip_values(p, property->type, n);
    }
  }
  if (status == FS_OK && !p->header.is_binary && fs_text_word(p->text, &word))
    return fs_ply_fail(p, "the line has more values than the header says");
  return status;
}

/* Every item takes a known least number of bytes: one list length or value each, with a separator in ascii. */
static fs_status check_room(ply_file *p, const ply_element *element) {
  int64_t least = 0, rest = (int64_t)fs_text_rest(p->text) + !p->header.is_binary;
  for (int32_t i = 0; i < element->n_properties; i++) {
    const ply_property *property = &p->header.property[element->property_start + i];
    ply_type type = property->count_type != PLY_NONE ? property->count_type : property->type;
    least += p->header.is_binary ? (int64_t)type_size(type) : 2;
  }
  if (least == 0 || element->count <= rest / least) return FS_OK;
  return fs_ply_fail(p, "%d elements of %lld bytes or more do not fit into the %zu that follow", element->count,
                     (long long)least, fs_text_rest(p->text));
}

/* Corners take a byte or more each, so their number is bounded before it is known. */
static fs_status allocate_corners(ply_file *p, const ply_element *element) {
  fs_status status = FS_OK;
  size_t bytes = 2, n;
  for (int32_t i = 0; i < element->n_properties && p->header.is_binary; i++)
    if (p->header.property[element->property_start + i].role == PLY_CORNERS)
      bytes = type_size(p->header.property[element->property_start + i].type);
  n = fs_text_rest(p->text) / bytes;
  if (n >= INT32_MAX) return fs_ply_fail(p, "the faces may have more corners than 32 bits can number");
  p->polygons.n_faces = element->count;
  FS_ALLOC(p->text->ctx, p->polygons.face_start, (size_t)element->count + 1);
  FS_ALLOC(p->text->ctx, p->polygons.corner, n);
done:
  return status;
}

static fs_status read_element(ply_file *p, const ply_element *element) {
  fs_status status = FS_OK;
  if (element->n_properties == 0) return FS_OK;
  FS_TRY(check_room(p, element));
  if (element->kind == PLY_CAP) FS_TRY(fs_ply_allocate_caps(p, element->count));
  if (element->kind == PLY_FACE) FS_TRY(allocate_corners(p, element));
  if (element->kind == PLY_VERTEX) {
    p->polygons.n_vertices = element->count;
    FS_ALLOC(p->text->ctx, p->polygons.position, element->count);
  }
  for (int32_t i = 0; i < element->count; i++) FS_TRY(read_item(p, element, i));
done:
  return status;
}

static fs_status parse_notes(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh, fs_mesh_notes *notes) {
  fs_status status = FS_OK;
  fs_text text = {0};
  ply_file p = {.text = &text, .begin = bytes};
  fs_cap_notes *caps = NULL;
  FS_TRY(fs_text_open(ctx, bytes, size, &text));
  FS_TRY(fs_ply_read_header(&text, &p.header));
  for (int32_t i = 0; i < p.header.n_elements; i++) FS_TRY(read_element(&p, &p.header.element[i]));
  if (notes != NULL) FS_TRY(fs_ply_take_caps(&p, &caps));
  FS_TRY(fs_mesh_create(ctx, p.polygons.n_vertices, p.polygons.position, p.polygons.n_faces, p.polygons.face_start,
                        p.polygons.corner, mesh));
  if (notes != NULL) *notes = (fs_mesh_notes){.caps = caps};
  caps = NULL;
done:
  fs_cap_notes_free(ctx, caps);
  fs_text_close(&text);
  fs_ply_header_clear(ctx, &p.header);
  fs_polygons_clear(ctx, &p.polygons);
  fs_release(ctx, p.cap);
  fs_release(ctx, p.coefficient);
  return status;
}

static fs_status parse(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh) {
  return parse_notes(ctx, bytes, size, mesh, NULL);
}

const fs_reader fs_reader_ply = {"ply", "ply",
                                 "PLY, ascii and binary_little_endian: vertices, polygons, inner coefficients of caps",
                                 parse, parse_notes};
