/* SPDX-License-Identifier: MIT */
/* Single role: scattered points, .xyz: x, y and z a line, # starts a comment. They become the triangle mesh of their Delaunay
   triangulation, seen along z. */
#include "mesh/delaunay.h"
#include "mesh/read.h"

#include <string.h>

/* Three numbers and no more on a line that has any. */
static fs_status read_point(fs_text *text, fs_word word, fs_vec3 *point) {
  char quote[FS_QUOTE_SIZE];
  double x[3];
  for (int i = 0; i < 3; i++) {
    fs_status status = fs_text_real(text, word, &x[i]);
    if (status != FS_OK) return status;
    if (i < 2 && !fs_text_word(text, &word)) return fs_text_fail(text, "a point needs x, y and z");
  }
  if (fs_text_word(text, &word))
    return fs_text_fail(text, "%s stands behind x, y and z of a point", fs_word_quote(word, quote));
  *point = (fs_vec3){x[0], x[1], x[2]};
  return FS_OK;
}

static fs_status read_points(fs_text *text, int32_t room, fs_vec3 *point, int32_t *n) {
  fs_status status = FS_OK;
  fs_word word;
  for (*n = 0; fs_text_any_word(text, &word) && status == FS_OK; ++*n) {
    if (*n == room) return fs_text_fail(text, "the file has more points than can be numbered");
    status = read_point(text, word, &point[*n]);
  }
  return status;
}

static fs_status parse(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh) {
  fs_status status = FS_OK;
  fs_text text = {0};
  fs_polygons p = {0};
  size_t most = size / 6 + 1; /* "0 0 0" and the end of a line */
  if (most > INT32_MAX / 8) most = INT32_MAX / 8;
  FS_TRY(fs_text_open(ctx, bytes, size, &text));
  text.comment = '#';
  FS_ALLOC(ctx, p.position, most);
  FS_TRY(read_points(&text, (int32_t)most, p.position, &p.n_vertices));
  FS_ALLOC(ctx, p.corner, 6 * (size_t)p.n_vertices);
  FS_TRY(fs_delaunay(ctx, p.n_vertices, p.position, p.corner, &p.n_faces));
  FS_ALLOC(ctx, p.face_start, (size_t)p.n_faces + 1);
  for (int32_t f = 0; f <= p.n_faces; f++) p.face_start[f] = 3 * f;
  FS_TRY(fs_mesh_create(ctx, p.n_vertices, p.position, p.n_faces, p.face_start, p.corner, mesh));
done:
  fs_text_close(&text);
  fs_polygons_clear(ctx, &p);
  return status;
}

const fs_reader fs_reader_xyz = {
    "xyz", "xyz", "scattered points, x y z a line: their Delaunay triangulation over x and y", parse, NULL};
