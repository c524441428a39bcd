/* SPDX-License-Identifier: MIT */
/* Single role: Wavefront OBJ: statements v and f; the other statements of polygon files are skipped, and so are the tags
   ("t crease …") of OpenSubdiv's test shapes, with a note. Read twice: to count, then to fill arrays of just that size. */
#include "mesh/read.h"

typedef struct obj_counts {
  int64_t n_vertices, n_faces, n_corners, n_creases, n_tags;
} obj_counts;

static obj_counts count_statements(fs_text text) {
  obj_counts n = {0};
  fs_word word;
  do {
    if (!fs_text_word(&text, &word)) continue;
    if (fs_word_is(word, "v")) n.n_vertices++;
    if (fs_word_is(word, "t")) {
      n.n_tags++;
      if (fs_text_word(&text, &word) && fs_word_is(word, "crease")) n.n_creases++;
    } else if (fs_word_is(word, "f")) {
      n.n_faces++;
      while (fs_text_word(&text, &word)) n.n_corners++;
    }
  } while (fs_text_line(&text));
  return n;
}

static fs_status check_counts(fs_context *ctx, const obj_counts *n) {
  if (n->n_vertices == 0) return fs_fail(ctx, FS_ERR_FORMAT, "the file has no vertices (lines that start with v)");
  if (n->n_faces == 0) return fs_fail(ctx, FS_ERR_FORMAT, "the file has no faces (lines that start with f)");
  if (n->n_vertices >= INT32_MAX || n->n_faces >= INT32_MAX || n->n_corners >= INT32_MAX)
    return fs_fail(ctx, FS_ERR_FORMAT, "the file has more vertices, faces or corners than 32 bits can number");
  return FS_OK;
}

/* x y z, then perhaps a weight or colours, which must be numbers but are not kept. */
static fs_status read_vertex(fs_text *text, fs_vec3 *position) {
  fs_status status;
  fs_word word;
  double x[3] = {0}, ignored;
  int32_t n = 0;
  for (; fs_text_word(text, &word); n++) {
    status = fs_text_real(text, word, n < 3 ? &x[n] : &ignored);
    if (status != FS_OK) return status;
  }
  if (n < 3) return fs_text_fail(text, "the vertex has %d coordinates instead of 3", n);
  *position = (fs_vec3){x[0], x[1], x[2]};
  return FS_OK;
}

/* The texture and normal of a corner, "/7", "//7" or "/7/7", are looked at only for their form. */
static bool is_corner_tail(const char *p, const char *end) {
  int n_slashes = 0;
  for (; p < end; p++) {
    n_slashes += *p == '/';
    if (*p != '/' && *p != '-' && (*p < '0' || *p > '9')) return false;
  }
  return n_slashes <= 2;
}

/* A corner counts from 1, or from -1 backwards through the vertices before this line. */
static fs_status read_corner(fs_text *text, fs_word word, int32_t n_before, int32_t n_vertices, int32_t *corner) {
  char quote[FS_QUOTE_SIZE];
  fs_word index = {word.at, 0};
  int32_t i = 0;
  fs_status status;
  while (index.size < word.size && word.at[index.size] != '/') index.size++;
  if (!is_corner_tail(word.at + index.size, word.at + word.size))
    return fs_text_fail(text, "%s is not a corner of a face", fs_word_quote(word, quote));
  status = fs_text_integer(text, index, &i);
  if (status != FS_OK) return status;
  if (i == 0) return fs_text_fail(text, "the face uses vertex 0, but vertices count from 1");
  if (i > n_vertices) return fs_text_fail(text, "the face uses vertex %d, but there are only %d", i, n_vertices);
  if (i < -n_before) return fs_text_fail(text, "the face uses vertex %d, but there are only %d before it", i, n_before);
  *corner = i > 0 ? i - 1 : n_before + i;
  return FS_OK;
}

static bool is_skipped(fs_word word) {
  static const char *const names[] = {"vt",       "vn",       "vp",     "o",      "g",          "s",         "l",
                                      "p",        "usemtl",   "mtllib", "usemap", "maplib",     "mg",        "lod",
                                      "c_interp", "d_interp", "bevel",  "t",      "shadow_obj", "trace_obj", "vc"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (fs_word_is(word, names[i])) return true;
  return false;
}

/* One line into the polygons; their counts are those before it and grow. */
static fs_status read_statement(fs_text *text, fs_word word, int32_t n_vertices, fs_polygons *p) {
  char quote[FS_QUOTE_SIZE];
  fs_status status = FS_OK;
  if (fs_word_is(word, "v")) return read_vertex(text, &p->position[p->n_vertices++]);
  if (fs_word_is(word, "f")) {
    int32_t start = p->face_start[p->n_faces], n = start;
    while (status == FS_OK && fs_text_word(text, &word))
      status = read_corner(text, word, p->n_vertices, n_vertices, &p->corner[n++]);
    if (status == FS_OK && n - start < 3)
      status = fs_text_fail(text, "the face has %d vertices, but a face needs 3 or more", n - start);
    p->face_start[++p->n_faces] = n;
    return status;
  }
  if (is_skipped(word)) return FS_OK;
  return fs_text_fail(text, "%s is no statement of a polygon file", fs_word_quote(word, quote));
}

static void note_tags(fs_context *ctx, const obj_counts *n) {
  long long creases = (long long)n->n_creases, others = (long long)(n->n_tags - n->n_creases);
  if (creases > 0 && others == 0) fs_note(ctx, "%lld crease tags were ignored", creases);
  if (creases > 0 && others > 0) fs_note(ctx, "%lld crease tags and %lld other tags were ignored", creases, others);
  if (creases == 0 && others > 0) fs_note(ctx, "%lld tags were ignored", others);
}

static fs_status parse(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh) {
  fs_status status = FS_OK;
  fs_text text = {0};
  fs_polygons p = {0};
  obj_counts n;
  fs_word word;
  FS_TRY(fs_text_open(ctx, bytes, size, &text));
  text.comment = '#';
  text.has_backslash = true;
  n = count_statements(text);
  FS_TRY(check_counts(ctx, &n));
  FS_ALLOC(ctx, p.position, n.n_vertices);
  FS_ALLOC(ctx, p.face_start, n.n_faces + 1);
  FS_ALLOC(ctx, p.corner, n.n_corners);
  do {
    if (fs_text_word(&text, &word)) FS_TRY(read_statement(&text, word, (int32_t)n.n_vertices, &p));
  } while (fs_text_line(&text));
  FS_TRY(fs_mesh_create(ctx, p.n_vertices, p.position, p.n_faces, p.face_start, p.corner, mesh));
  note_tags(ctx, &n);
done:
  fs_text_close(&text);
  fs_polygons_clear(ctx, &p);
  return status;
}

const fs_reader fs_reader_obj = {"obj", "obj", "Wavefront OBJ: vertices and polygons", parse, NULL};
