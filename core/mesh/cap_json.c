/* SPDX-License-Identifier: MIT */
/* Single role: reads the file of inner coefficients beside a net (cap_json.h). Whether they fit the mesh is for the space
   to say. */
#include "mesh/cap_json.h"

#include <string.h>

enum { BASIS = 1, N_VERTICES = 2, N_FACES = 4, CHECKSUM = 8, CAPS = 16, ALL_OF_FILE = 31 };
enum { VERTEX = 1, SPOKE = 2, VALENCE = 4, COEFFICIENTS = 8, ALL_OF_CAP = 15 };

/* What is read; arrays grow. */
typedef struct reading {
  fs_text text;
  fs_caps_file file;
  int32_t basis, n_caps, caps_room, n_coefficients, coefficients_room;
  fs_cap_note *cap;
  fs_vec3 *coefficient;
} reading;

/* ---- JSON ---- */

/* The next character that is no space; 0 at the end. */
static char peek(fs_text *text) {
  for (; text->at < text->end; text->at++) {
    char c = *text->at;
    if (c == '\n') text->line++;
    if (c != ' ' && c != '\t' && c != '\n' && c != '\r') return c;
  }
  return 0;
}

static fs_status expect(fs_text *text, char c) {
  char found = peek(text), quote[FS_QUOTE_SIZE];
  if (found == 0) return fs_text_fail(text, "the file ends where '%c' is needed", c);
  if (found != c) return fs_text_fail(text, "'%c' is needed, not %s", c, fs_word_quote((fs_word){text->at, 1}, quote));
  text->at++;
  return FS_OK;
}

/* Whether another member follows in an object or a list: a comma, or the end of it, which is passed. */
static fs_status go_on(fs_text *text, char end, bool *is_more) {
  *is_more = peek(text) == ',';
  if (*is_more) {
    text->at++;
    return FS_OK;
  }
  return expect(text, end);
}

/* A string without escapes. */
static fs_status read_string(fs_text *text, fs_word *string) {
  fs_status status = expect(text, '"');
  if (status != FS_OK) return status;
  *string = (fs_word){text->at, 0};
  while (text->at < text->end && *text->at != '"' && *text->at >= ' ' && *text->at != '\\') text->at++;
  string->size = (size_t)(text->at - string->at);
  if (text->at == text->end || *text->at != '"') return fs_text_fail(text, "a string does not end, or has escapes");
  text->at++;
  return FS_OK;
}

static fs_status read_key(fs_text *text, fs_word *key) {
  fs_status status = read_string(text, key);
  return status == FS_OK ? expect(text, ':') : status;
}

static bool is_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || (c | 32) == 'e';
}

/* Up to what cannot be part of a number; at least one character, to be shown where it is none. */
static fs_status read_word(fs_text *text, fs_word *word) {
  if (peek(text) == 0) return fs_text_fail(text, "the file ends where a number is needed");
  *word = (fs_word){text->at, 1};
  while (word->size < (size_t)(text->end - word->at) && is_of_number(word->at[word->size])) word->size++;
  text->at += word->size;
  return FS_OK;
}

static fs_status read_real(fs_text *text, double *x) {
  fs_word word;
  fs_status status = read_word(text, &word);
  return status == FS_OK ? fs_text_real(text, word, x) : status;
}

static fs_status read_integer(fs_text *text, int32_t *i) {
  fs_word word;
  fs_status status = read_word(text, &word);
  return status == FS_OK ? fs_text_integer(text, word, i) : status;
}

static fs_status fail_key(fs_text *text, fs_word key, const char *of) {
  char quote[FS_QUOTE_SIZE];
  return fs_text_fail(text, "%s is no part of %s, or is there twice", fs_word_quote(key, quote), of);
}

/* ---- the file ---- */

static fs_status read_coefficient(reading *r) {
  fs_status status = FS_OK;
  fs_vec3 *grown = NULL, c = {0, 0, 0};
  double *const x[3] = {&c.x, &c.y, &c.z};
  for (int k = 0; k < 3; k++) {
    FS_TRY(expect(&r->text, k == 0 ? '[' : ','));
    FS_TRY(read_real(&r->text, x[k]));
  }
  FS_TRY(expect(&r->text, ']'));
  if (r->n_coefficients == r->coefficients_room) {
    if (r->coefficients_room > INT32_MAX / 2 - 64) return fs_text_fail(&r->text, "there are too many coefficients");
    FS_ALLOC(r->text.ctx, grown, 2 * r->coefficients_room + 64);
    if (r->n_coefficients > 0) memcpy(grown, r->coefficient, (size_t)r->n_coefficients * sizeof *grown);
    fs_release(r->text.ctx, r->coefficient);
    r->coefficient = grown;
    r->coefficients_room = 2 * r->coefficients_room + 64;
  }
  r->coefficient[r->n_coefficients++] = c;
done:
  return status;
}

static fs_status read_coefficients(reading *r, fs_cap_note *cap) {
  fs_status status;
  bool is_more = true;
  cap->first = r->n_coefficients;
  FS_TRY(expect(&r->text, '['));
  while (is_more) {
    FS_TRY(read_coefficient(r));
    FS_TRY(go_on(&r->text, ']', &is_more));
  }
  cap->n = r->n_coefficients - cap->first;
done:
  return status;
}

static fs_status read_cap(reading *r, fs_cap_note *cap) {
  static const char *const names[] = {"vertex", "spoke", "valence", "coefficients"};
  int32_t *const number[] = {&cap->vertex, &cap->spoke, &cap->valence};
  fs_status status;
  int32_t seen = 0;
  bool is_more = true;
  FS_TRY(expect(&r->text, '{'));
  while (is_more) {
    fs_word key;
    int32_t k = 0;
    FS_TRY(read_key(&r->text, &key));
    while (k < 4 && !fs_word_is(key, names[k])) k++;
    if (k == 4 || (seen & 1 << k) != 0) return fail_key(&r->text, key, "a cap");
    seen |= 1 << k;
    FS_TRY(k < 3 ? read_integer(&r->text, number[k]) : read_coefficients(r, cap));
    FS_TRY(go_on(&r->text, '}', &is_more));
  }
  if (seen != ALL_OF_CAP) return fs_text_fail(&r->text, "a cap needs vertex, spoke, valence and coefficients");
done:
  return status;
}

static fs_status read_caps(reading *r) {
  fs_status status;
  bool is_more = true;
  fs_cap_note *grown = NULL;
  FS_TRY(expect(&r->text, '['));
  while (is_more) {
    if (r->n_caps == r->caps_room) {
      FS_ALLOC(r->text.ctx, grown, 2 * (size_t)r->caps_room + 8);
      if (r->n_caps > 0) memcpy(grown, r->cap, (size_t)r->n_caps * sizeof *grown);
      fs_release(r->text.ctx, r->cap);
      r->cap = grown;
      r->caps_room = 2 * r->caps_room + 8;
    }
    FS_TRY(read_cap(r, &r->cap[r->n_caps]));
    r->n_caps++;
    FS_TRY(go_on(&r->text, ']', &is_more));
  }
done:
  return status;
}

static fs_status read_checksum(fs_text *text, uint64_t *checksum) {
  fs_word word;
  fs_status status = read_string(text, &word);
  uint64_t value = 0;
  if (status != FS_OK) return status;
  for (size_t i = 0; i < word.size; i++) {
    char c = word.at[i];
    if (!((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f')))
      return fs_text_fail(text, "the checksum has other than hexadecimal digits");
    value = value << 4 | (uint64_t)(c <= '9' ? c - '0' : c - 'a' + 10);
  }
  if (word.size != 16) return fs_text_fail(text, "the checksum has %zu digits instead of 16", word.size);
  *checksum = value;
  return FS_OK;
}

static fs_status read_member(reading *r, int32_t k) {
  switch (1 << k) {
  case BASIS:
    return read_integer(&r->text, &r->basis);
  case N_VERTICES:
    return read_integer(&r->text, &r->file.n_vertices);
  case N_FACES:
    return read_integer(&r->text, &r->file.n_faces);
  case CHECKSUM:
    return read_checksum(&r->text, &r->file.checksum);
  default:
    return read_caps(r);
  }
}

static fs_status read_file(reading *r) {
  static const char *const names[] = {"basis", "vertices", "faces", "checksum", "caps"};
  fs_status status;
  int32_t seen = 0;
  bool is_more = true;
  FS_TRY(expect(&r->text, '{'));
  while (is_more) {
    fs_word key;
    int32_t k = 0;
    FS_TRY(read_key(&r->text, &key));
    while (k < 5 && !fs_word_is(key, names[k])) k++;
    if (k == 5 || (seen & 1 << k) != 0) return fail_key(&r->text, key, "a file of inner coefficients");
    seen |= 1 << k;
    FS_TRY(read_member(r, k));
    FS_TRY(go_on(&r->text, '}', &is_more));
  }
  if (seen != ALL_OF_FILE) return fs_text_fail(&r->text, "the file needs basis, vertices, faces, checksum and caps");
  if (peek(&r->text) != 0) return fs_text_fail(&r->text, "something follows the end");
done:
  return status;
}

fs_status fs_caps_file_parse(fs_context *ctx, const char *bytes, size_t size, fs_caps_file *file) {
  fs_status status = FS_OK;
  reading r = {0};
  FS_TRY(fs_text_open(ctx, bytes, size, &r.text));
  FS_TRY(read_file(&r));
  FS_TRY(fs_cap_notes_create(ctx, r.n_caps, r.n_coefficients, &r.file.notes));
  r.file.notes->basis = r.basis;
  memcpy(r.file.notes->cap, r.cap, (size_t)r.n_caps * sizeof *r.cap);
  memcpy(r.file.notes->coefficient, r.coefficient, (size_t)r.n_coefficients * sizeof *r.coefficient);
  *file = r.file;
done:
  fs_text_close(&r.text);
  fs_release(ctx, r.cap);
  fs_release(ctx, r.coefficient);
  return status;
}

/* ---- which net ---- */

static uint64_t mix(uint64_t sum, const void *bytes, size_t size) {
  for (const unsigned char *b = bytes; size > 0; size--) sum = (sum ^ *b++) * UINT64_C(0x100000001b3);
  return sum;
}

uint64_t fs_mesh_checksum(const fs_mesh *mesh) {
  uint64_t sum = UINT64_C(0xcbf29ce484222325);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    const double x[3] = {mesh->position[v].x + 0.0, mesh->position[v].y + 0.0, mesh->position[v].z + 0.0};
    sum = mix(sum, x, sizeof x);
  }
  sum = mix(sum, mesh->face_start, ((size_t)mesh->n_faces + 1) * sizeof *mesh->face_start);
  return mix(sum, mesh->origin, (size_t)mesh->n_halfedges * sizeof *mesh->origin);
}
