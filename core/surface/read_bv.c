/* SPDX-License-Identifier: MIT */
/* Single role: BezierView files, .bv (docs/formats/bv.md): a sequence of patches, each a number that says its kind, its
   degrees and its control points. Read are kinds 3 (Bezier triangle), 4, 5 (tensor Bezier), 8 with equal weights, and 1
   (polyhedra) of triangles and quadrilaterals as patches of degree 1; "Group …" lines are skipped. */
#include "surface/spline.h"
#include "mesh/read.h"

#include <math.h>
#include <string.h>

typedef struct parser {
  fs_context *ctx;
  fs_text text;
  fs_surface *surface;
  int32_t patch_room;
  size_t data_room;
} parser;

static fs_status next_integer(parser *p, const char *what, int32_t *i) {
  fs_word word;
  if (!fs_text_any_word(&p->text, &word)) return fs_text_fail(&p->text, "the file ends where %s is needed", what);
  return fs_text_integer(&p->text, word, i);
}

static fs_status next_numbers(parser *p, int32_t n, double *x) {
  fs_word word;
  for (int32_t i = 0; i < n; i++) {
    fs_status status;
    if (!fs_text_any_word(&p->text, &word))
      return fs_text_fail(&p->text, "the file ends within patch %d", (int)p->surface->n_patches);
    status = fs_text_real(&p->text, word, &x[i]);
    if (status != FS_OK) return status;
  }
  return FS_OK;
}

static fs_status next_degree(parser *p, int32_t *degree) {
  fs_status status = next_integer(p, "a degree", degree);
  if (status == FS_OK && (*degree < 1 || *degree > FS_MAX_DEGREE))
    return fs_text_fail(&p->text, "patch %d has degree %d, which is not between 1 and %d", (int)p->surface->n_patches,
                        (int)*degree, FS_MAX_DEGREE);
  return status;
}

/* Room for one more patch of n_points points. */
static fs_status add_patch(parser *p, int32_t kind, int32_t degree_u, int32_t degree_v, int32_t n_points,
                           fs_patch **patch) {
  fs_context *ctx = p->ctx;
  fs_status status = FS_OK;
  fs_surface *s = p->surface;
  fs_patch *patches = NULL;
  double *data = NULL;
  size_t n_numbers = 3 * (size_t)n_points;
  if (s->n_patches == INT32_MAX / 8) return fs_text_fail(&p->text, "the file has more patches than can be numbered");
  if (s->n_patches == p->patch_room) {
    FS_ALLOC(ctx, patches, 2 * p->patch_room + 16);
    if (s->n_patches > 0) memcpy(patches, s->patch, (size_t)s->n_patches * sizeof *patches);
    fs_release(ctx, s->patch);
    s->patch = patches;
    p->patch_room = 2 * p->patch_room + 16;
  }
  if (s->n_data + n_numbers > p->data_room) {
    FS_ALLOC(ctx, data, 2 * (s->n_data + n_numbers));
    if (s->n_data > 0) memcpy(data, s->data, s->n_data * sizeof *data);
    fs_release(ctx, s->data);
    s->data = data;
    p->data_room = 2 * (s->n_data + n_numbers);
  }
  *patch = &s->patch[s->n_patches++];
  **patch = (fs_patch){.kind = kind,
                       .n_sides = kind == FS_PATCH_BEZIER_TRIANGLE ? 3 : 4,
                       .degree_u = degree_u,
                       .degree_v = degree_v,
                       .data_start = s->n_data,
                       .face = FS_NONE,
                       .valence = 4,
                       .neighbour = {FS_NONE, FS_NONE, FS_NONE, FS_NONE}};
  s->n_data += n_numbers;
done:
  return status;
}

static fs_status refuse_too_many(parser *p, int32_t n_points, int32_t width) {
  /* a coordinate and a space take 2 bytes */
  if (2 * (int64_t)width * n_points <= (int64_t)fs_text_rest(&p->text) + 1) return FS_OK;
  return fs_text_fail(&p->text, "patch %d has %d control points, more than the %zu bytes that follow hold",
                      (int)p->surface->n_patches, (int)n_points, fs_text_rest(&p->text));
}

/* Kinds 4, 5, 8. The file runs along v first. */
static fs_status take_tensor(parser *p, int32_t kind) {
  fs_status status = FS_OK;
  int32_t width = kind == 8 ? 4 : 3, n, m;
  double x[4], weight = 0;
  fs_patch *patch;
  FS_TRY(next_degree(p, &n));
  m = n;
  if (kind != 4) FS_TRY(next_degree(p, &m));
  FS_TRY(refuse_too_many(p, (n + 1) * (m + 1), width));
  FS_TRY(add_patch(p, FS_PATCH_TENSOR_BEZIER, n, m, (n + 1) * (m + 1), &patch));
  for (int32_t i = 0; i <= n; i++)
    for (int32_t j = 0; j <= m; j++) {
      double *point = p->surface->data + patch->data_start + 3 * (size_t)(i + (n + 1) * j);
      FS_TRY(next_numbers(p, width, x));
      if (width == 4) {
        if (i + j == 0) weight = x[3];
        if (!(x[3] > 0) || fabs(x[3] - weight) > 1e-12 * weight) {
          status = fs_text_fail(&p->text, "patch %d is rational with different weights, and such patches are not read",
                                (int)p->surface->n_patches - 1);
          goto done;
        }
      }
      for (int w = 0; w < 3; w++) point[w] = width == 4 ? x[w] / weight : x[w];
    }
done:
  return status;
}

static fs_status take_triangle(parser *p) {
  fs_status status = FS_OK;
  int32_t n, n_points;
  fs_patch *patch;
  FS_TRY(next_degree(p, &n));
  n_points = (n + 1) * (n + 2) / 2;
  FS_TRY(refuse_too_many(p, n_points, 3));
  FS_TRY(add_patch(p, FS_PATCH_BEZIER_TRIANGLE, n, n, n_points, &patch));
  FS_TRY(next_numbers(p, 3 * n_points, p->surface->data + patch->data_start));
done:
  return status;
}

static fs_status take_face(parser *p, int32_t f, int32_t n_vertices, const double *vertex) {
  static const int8_t place[2][4] = {{0, 1, 2}, {0, 1, 3, 2}}; /* of corner k of a triangle, of a quadrilateral */
  fs_status status = FS_OK;
  int32_t n, v;
  fs_patch *patch;
  FS_TRY(next_integer(p, "a face", &n));
  if (n != 3 && n != 4)
    return fs_text_fail(&p->text, "face %d of the polyhedron has %d vertices; 3 or 4 can be read", (int)f, (int)n);
  FS_TRY(add_patch(p, n == 3 ? FS_PATCH_BEZIER_TRIANGLE : FS_PATCH_TENSOR_BEZIER, 1, 1, n, &patch));
  for (int32_t k = 0; k < n; k++) {
    FS_TRY(next_integer(p, "a vertex of a face", &v));
    if (v < 0 || v >= n_vertices)
      return fs_text_fail(&p->text, "face %d of the polyhedron uses vertex %d, but there are only %d", (int)f, (int)v,
                          (int)n_vertices);
    memcpy(p->surface->data + patch->data_start + 3 * place[n - 3][k], vertex + 3 * (size_t)v, 3 * sizeof *vertex);
  }
done:
  return status;
}

static fs_status take_polyhedron(parser *p) {
  fs_context *ctx = p->ctx;
  fs_status status = FS_OK;
  int32_t n_vertices, n_faces;
  double *vertex = NULL;
  FS_TRY(next_integer(p, "the number of vertices", &n_vertices));
  FS_TRY(next_integer(p, "the number of faces", &n_faces));
  if (n_vertices < 0 || n_faces < 0)
    return fs_text_fail(&p->text, "a polyhedron cannot have %d vertices and %d faces", (int)n_vertices, (int)n_faces);
  FS_TRY(refuse_too_many(p, n_vertices, 3));
  FS_ALLOC(ctx, vertex, 3 * (size_t)n_vertices);
  for (int32_t v = 0; v < n_vertices; v++) FS_TRY(next_numbers(p, 3, vertex + 3 * (size_t)v));
  for (int32_t f = 0; f < n_faces; f++) FS_TRY(take_face(p, f, n_vertices, vertex));
done:
  fs_release(ctx, vertex);
  return status;
}

static fs_status take_segment(parser *p, fs_word word) {
  fs_status status = FS_OK;
  int32_t kind;
  if (fs_word_is(word, "Group") ||
      fs_word_is(word, "group")) { /* its colour, its name, "#" and steps: all on this line */
    fs_text_line(&p->text);
    return FS_OK;
  }
  FS_TRY(fs_text_integer(&p->text, word, &kind));
  switch (kind) {
  case 1:
    return take_polyhedron(p);
  case 3:
    return take_triangle(p);
  case 4:
  case 5:
  case 8:
    return take_tensor(p, kind);
  default:
    return fs_text_fail(&p->text, "patch %d is of kind %d; 1, 3, 4, 5 and 8 can be read", (int)p->surface->n_patches,
                        (int)kind);
  }
done:
  return status;
}

static fs_status parse(fs_context *ctx, const char *bytes, size_t size, fs_surface **surface) {
  fs_status status = FS_OK;
  parser p = {.ctx = ctx};
  fs_word word;
  FS_TRY(fs_text_open(ctx, bytes, size, &p.text));
  FS_ALLOC(ctx, p.surface, 1);
  while (fs_text_any_word(&p.text, &word)) FS_TRY(take_segment(&p, word));
  if (p.surface->n_patches == 0) {
    status = fs_text_fail(&p.text, "the file has no patch");
    goto done;
  }
  *surface = p.surface;
  p.surface = NULL;
done:
  fs_text_close(&p.text);
  fs_surface_free(ctx, p.surface);
  return status;
}

const fs_surface_reader fs_surface_reader_bv = {
    "bezierview", "bv", "BezierView: Bezier triangles and tensor Bezier patches, text (docs/formats/bv.md)", parse};
