/* SPDX-License-Identifier: MIT */
/* Single role: OFF of Geomview, text: a keyword, counts, a vertex a line, a face a line. Normals, colours and texture
   coordinates behind the position of a vertex or the corners of a face are skipped. */
#include "mesh/read.h"

/* OFF with the prefixes ST, C, N; those that change what a position is (4, n) are refused. */
static fs_status read_keyword(fs_text *text) {
  static const char *const known[] = {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
  char quote[FS_QUOTE_SIZE];
  fs_word word;
  if (!fs_text_any_word(text, &word)) return fs_text_fail(text, "the file has no keyword OFF");
  for (size_t i = 0; i < sizeof known / sizeof *known; i++)
    if (fs_word_is(word, known[i])) return FS_OK;
  return fs_text_fail(text, "%s stands where OFF, COFF, NOFF or STOFF is needed", fs_word_quote(word, quote));
}

static fs_status next_integer(fs_text *text, const char *what, int32_t *i) {
  fs_word word;
  if (!fs_text_any_word(text, &word)) return fs_text_fail(text, "the file ends where %s is needed", what);
  if (fs_word_is(word, "BINARY")) return fs_text_fail(text, "binary OFF files are not read");
  return fs_text_integer(text, word, i);
}

static fs_status read_counts(fs_text *text, int32_t *n_vertices, int32_t *n_faces) {
  fs_status status = next_integer(text, "the number of vertices", n_vertices);
  if (status == FS_OK) status = next_integer(text, "the number of faces", n_faces);
  if (status != FS_OK) return status;
  if (*n_vertices < 1 || *n_faces < 1)
    return fs_text_fail(text, "%d vertices and %d faces are not a mesh", *n_vertices, *n_faces);
  fs_text_line(text); /* the number of edges, which nobody needs */
  /* "0 0 0" and "3 0 1 2" with a line end take at least 6 and 8 bytes; the last one may lack its line end */
  if (6 * (int64_t)*n_vertices + 8 * (int64_t)*n_faces > (int64_t)fs_text_rest(text) + 1)
    return fs_text_fail(text, "%d vertices and %d faces do not fit into the %zu bytes that follow", *n_vertices,
                        *n_faces, fs_text_rest(text));
  return FS_OK;
}

static fs_status read_vertex(fs_text *text, int32_t v, fs_vec3 *position) {
  double x[3];
  fs_word word;
  for (int i = 0; i < 3; i++) {
    fs_status status;
    if (!fs_text_any_word(text, &word)) return fs_text_fail(text, "the file ends within vertex %d", v);
    status = fs_text_real(text, word, &x[i]);
    if (status != FS_OK) return status;
  }
  fs_text_line(text);
  *position = (fs_vec3){x[0], x[1], x[2]};
  return FS_OK;
}

/* Corners of face f to corner[], of which no more than the rest of the text can hold. */
static fs_status read_face(fs_text *text, int32_t f, int32_t n_vertices, int32_t *n, int32_t *corner) {
  fs_status status = next_integer(text, "a face", n);
  if (status != FS_OK) return status;
  if (*n < 3) return fs_text_fail(text, "face %d has %d vertices, but a face needs 3 or more", f, *n);
  if (2 * (int64_t)*n > (int64_t)fs_text_rest(text))
    return fs_text_fail(text, "face %d has %d vertices, but only %zu bytes follow", f, *n, fs_text_rest(text));
  for (int32_t i = 0; i < *n; i++) {
    status = next_integer(text, "a vertex of a face", &corner[i]);
    if (status != FS_OK) return status;
    if (corner[i] < 0 || corner[i] >= n_vertices)
      return fs_text_fail(text, "face %d uses vertex %d, but there are only %d", f, corner[i], n_vertices);
  }
  fs_text_line(text);
  return FS_OK;
}

static fs_status parse(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh) {
  fs_status status = FS_OK;
  fs_text text = {0};
  fs_polygons p = {0};
  int32_t n;
  FS_TRY(fs_text_open(ctx, bytes, size, &text));
  text.comment = '#';
  FS_TRY(read_keyword(&text));
  FS_TRY(read_counts(&text, &p.n_vertices, &p.n_faces));
  FS_ALLOC(ctx, p.position, p.n_vertices);
  for (int32_t v = 0; v < p.n_vertices; v++) FS_TRY(read_vertex(&text, v, &p.position[v]));
  if (fs_text_rest(&text) / 2 >= INT32_MAX) {
    status = fs_text_fail(&text, "the faces may have more corners than 32 bits can number");
    goto done;
  }
  FS_ALLOC(ctx, p.face_start, (size_t)p.n_faces + 1);
  FS_ALLOC(ctx, p.corner, fs_text_rest(&text) / 2 + 1); /* a corner takes 2 bytes */
  for (int32_t f = 0; f < p.n_faces; f++) {
    FS_TRY(read_face(&text, f, p.n_vertices, &n, p.corner + p.face_start[f]));
    p.face_start[f + 1] = p.face_start[f] + n;
  }
  FS_TRY(fs_mesh_create(ctx, p.n_vertices, p.position, p.n_faces, p.face_start, p.corner, mesh));
done:
  fs_text_close(&text);
  fs_polygons_clear(ctx, &p);
  return status;
}

const fs_reader fs_reader_off = {"off", "off", "OFF of Geomview, text: vertices and polygons", parse, NULL};
