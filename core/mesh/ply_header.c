/* SPDX-License-Identifier: MIT */
/* Single role: the header of a PLY file. Read twice: to count elements and properties, then to fill arrays of that size. */
#include "mesh/ply.h"

static ply_type find_type(fs_word word) {
  static const struct {
    const char *name;
    ply_type type;
  } known[] = {{"char", PLY_INT8},     {"int8", PLY_INT8},       {"uchar", PLY_UINT8},    {"uint8", PLY_UINT8},
               {"short", PLY_INT16},   {"int16", PLY_INT16},     {"ushort", PLY_UINT16},  {"uint16", PLY_UINT16},
               {"int", PLY_INT32},     {"int32", PLY_INT32},     {"uint", PLY_UINT32},    {"uint32", PLY_UINT32},
               {"float", PLY_FLOAT32}, {"float32", PLY_FLOAT32}, {"double", PLY_FLOAT64}, {"float64", PLY_FLOAT64}};
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (fs_word_is(word, known[i].name)) return known[i].type;
  return PLY_NONE;
}

/* The next word of the line, empty where there is none. */
static fs_word next_word(fs_text *text) {
  fs_word word = {text->at, 0};
  fs_text_word(text, &word);
  return word;
}

static fs_status read_format(fs_text *text, bool *is_binary) {
  char quote[FS_QUOTE_SIZE];
  fs_word word;
  if (!fs_word_is(next_word(text), "ply")) return fs_text_fail(text, "the file does not start with ply");
  do {
    if (!fs_text_line(text)) return fs_text_fail(text, "the header has no line format");
    word = next_word(text);
  } while (fs_word_is(word, "comment") || fs_word_is(word, "obj_info"));
  if (!fs_word_is(word, "format"))
    return fs_text_fail(text, "%s stands where format is needed", fs_word_quote(word, quote));
  word = next_word(text);
  *is_binary = fs_word_is(word, "binary_little_endian");
  if (!*is_binary && !fs_word_is(word, "ascii"))
    return fs_text_fail(text, "the format is %s, but only ascii and binary_little_endian are read",
                        fs_word_quote(word, quote));
  word = next_word(text);
  if (!fs_word_is(word, "1.0"))
    return fs_text_fail(text, "the version of the format is %s instead of 1.0", fs_word_quote(word, quote));
  return FS_OK;
}

/* Numbers of elements and properties up to end_header. */
static fs_status count_lines(fs_text text, ply_header *header) {
  while (fs_text_line(&text)) {
    fs_word word = next_word(&text);
    if (fs_word_is(word, "end_header")) return FS_OK;
    if (header->n_elements == INT32_MAX || header->n_properties == INT32_MAX) break;
    header->n_elements += fs_word_is(word, "element");
    header->n_properties += fs_word_is(word, "property");
  }
  return fs_text_fail(&text, "the header has no end (end_header)");
}

static fs_status read_element(fs_text *text, ply_header *header, int32_t property_start) {
  char quote[FS_QUOTE_SIZE];
  fs_word name = next_word(text);
  ply_element *element = &header->element[header->n_elements];
  fs_status status = fs_text_integer(text, next_word(text), &element->count);
  if (status != FS_OK) return status;
  if (element->count < 0) return fs_text_fail(text, "there are %d of %s", element->count, fs_word_quote(name, quote));
  element->kind = fs_word_is(name, "vertex")     ? PLY_VERTEX
                  : fs_word_is(name, "face")     ? PLY_FACE
                  : fs_word_is(name, FS_PLY_CAP) ? PLY_CAP
                                                 : PLY_OTHER;
  element->property_start = property_start;
  if (element->kind != PLY_OTHER) {
    for (int32_t i = 0; i < header->n_elements; i++)
      if (header->element[i].kind == element->kind)
        return fs_text_fail(text, "the element %s is there twice", fs_word_quote(name, quote));
    header->count[element->kind] = element->count;
  }
  header->n_elements++;
  return FS_OK;
}

static ply_role find_cap_role(bool is_list, fs_word name) {
  static const char *const names[] = {"vertex", "spoke", "valence", "basis"};
  for (int32_t i = 0; i < 4 && !is_list; i++)
    if (fs_word_is(name, names[i])) return (ply_role)(PLY_CAP_VERTEX + i);
  return is_list && fs_word_is(name, "coefficients") ? PLY_CAP_COEFFICIENTS : PLY_SKIPPED;
}

static ply_role find_role(ply_kind kind, bool is_list, fs_word name) {
  if (kind == PLY_VERTEX && !is_list && name.size == 1 && *name.at >= 'x' && *name.at <= 'z')
    return (ply_role)(PLY_X + (*name.at - 'x'));
  if (kind == PLY_FACE && is_list && (fs_word_is(name, "vertex_indices") || fs_word_is(name, "vertex_index")))
    return PLY_CORNERS;
  if (kind == PLY_CAP) return find_cap_role(is_list, name);
  return PLY_SKIPPED;
}

static fs_status read_property(fs_text *text, ply_header *header) {
  char quote[FS_QUOTE_SIZE];
  ply_property *property = &header->property[header->n_properties];
  ply_element *element;
  fs_word word = next_word(text), name;
  bool is_list = fs_word_is(word, "list");
  if (header->n_elements == 0) return fs_text_fail(text, "a property stands before the first element");
  element = &header->element[header->n_elements - 1];
  if (is_list) {
    word = next_word(text);
    property->count_type = find_type(word);
    if (property->count_type == PLY_NONE)
      return fs_text_fail(text, "%s is no type of a property", fs_word_quote(word, quote));
    word = next_word(text);
  }
  property->type = find_type(word);
  if (property->type == PLY_NONE) return fs_text_fail(text, "%s is no type of a property", fs_word_quote(word, quote));
  name = next_word(text);
  if (name.size == 0) return fs_text_fail(text, "a property has no name");
  property->role = find_role(element->kind, is_list, name);
  for (int32_t i = element->property_start; i < header->n_properties && property->role != PLY_SKIPPED; i++)
    if (header->property[i].role == property->role)
      return fs_text_fail(text, "the property %s is there twice", fs_word_quote(name, quote));
  element->n_properties++;
  header->n_properties++;
  return FS_OK;
}

/* Elements and properties; the counts of the header start at 0 and grow. */
static fs_status read_lines(fs_text *text, ply_header *header) {
  char quote[FS_QUOTE_SIZE];
  fs_status status = FS_OK;
  while (status == FS_OK && fs_text_line(text)) {
    fs_word word = next_word(text);
    if (fs_word_is(word, "end_header")) break;
    if (fs_word_is(word, "element"))
      status = read_element(text, header, header->n_properties);
    else if (fs_word_is(word, "property"))
      status = read_property(text, header);
    else if (word.size > 0 && !fs_word_is(word, "comment") && !fs_word_is(word, "obj_info"))
      status = fs_text_fail(text, "%s is no line of a header", fs_word_quote(word, quote));
  }
  return status;
}

static fs_status check_roles(fs_context *ctx, const ply_header *header) {
  bool has[PLY_SKIPPED + 1] = {false};
  for (int32_t i = 0; i < header->n_properties; i++) has[header->property[i].role] = true;
  if (!has[PLY_X] || !has[PLY_Y] || !has[PLY_Z])
    return fs_fail(ctx, FS_ERR_FORMAT, "the file has no element vertex with x, y and z");
  if (!has[PLY_CORNERS]) return fs_fail(ctx, FS_ERR_FORMAT, "the file has no element face with a list vertex_indices");
  if (header->count[PLY_VERTEX] == 0 || header->count[PLY_FACE] == 0)
    return fs_fail(ctx, FS_ERR_FORMAT, "%d vertices and %d faces are not a mesh", header->count[PLY_VERTEX],
                   header->count[PLY_FACE]);
  for (int32_t role = PLY_CAP_VERTEX; role <= PLY_CAP_COEFFICIENTS; role++)
    if (header->count[PLY_CAP] > 0 && !has[role])
      return fs_fail(ctx, FS_ERR_FORMAT,
                     "the element " FS_PLY_CAP " needs vertex, spoke, valence, basis and a list coefficients");
  return FS_OK;
}

fs_status fs_ply_read_header(fs_text *text, ply_header *header) {
  fs_status status = FS_OK;
  ply_header h = {0};
  FS_TRY(read_format(text, &h.is_binary));
  FS_TRY(count_lines(*text, &h));
  FS_ALLOC(text->ctx, h.element, h.n_elements);
  FS_ALLOC(text->ctx, h.property, h.n_properties);
  h.n_elements = h.n_properties = 0;
  FS_TRY(read_lines(text, &h));
  FS_TRY(check_roles(text->ctx, &h));
  fs_text_line(text);
  *header = h;
  h = (ply_header){0};
done:
  fs_ply_header_clear(text->ctx, &h);
  return status;
}

void fs_ply_header_clear(fs_context *ctx, ply_header *header) {
  fs_release(ctx, header->element);
  fs_release(ctx, header->property);
  *header = (ply_header){0};
}
