/* SPDX-License-Identifier: MIT */
/* The HTML exporter: one page that works from a file, without a network. It holds the control net as base64 of
   little-endian numbers and makes the surface from it, by the core of this library as WebAssembly (web/).
   Layout of the net: float64 position[vertices][3], float64 offset[offsets][3], int32 face_start[faces + 1],
   int32 corner[corners], int32 cap[caps][4]. Offsets are the inner coefficients of caps, cap by cap; each cap has its vertex,
   spoke, valence and number of coefficients. A control net alone has none. */
#include "html.h"
#include "strokes.h"
#include "base/base.h"
#include "math/vec3.h"

static const char *const scene_names[] = {"shaded", "zebra", "isophote", "curvature", NULL};

enum { SCENE, N_PARAMS };

static const fs_param params[] = {
    [SCENE] = {"scene", "how the page shows the surface at first", 0, 0, 3, scene_names},
    [N_PARAMS] = {0},
};

/* Largest distance of the Bezier points of two surfaces over the same elements; infinite where these differ. */
static double distance(const fs_surface *a, const fs_surface *b) {
  double largest = 0;
  if (a->n_patches != b->n_patches || a->n_data != b->n_data) return (double)INFINITY;
  for (size_t i = 0; i < a->n_data; i++) largest = fmax(largest, fabs(a->data[i] - b->data[i]));
  return largest;
}

/* The page makes the surface from the net alone, so the net must have one, and it must be that of the model. */
static fs_status check(fs_context *ctx, const fs_model *model) {
  fs_status status;
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  double size = 0;
  const fs_space_options options = {.caps = model->caps != NULL ? FS_CAPS_FULL : FS_CAPS_LINEAR, .kept = model->caps};
  FS_TRY(fs_space_create_with(ctx, model->control, &options, &space));
  if (model->surface == NULL) goto done;
  FS_TRY(fs_surface_create(ctx, space, space->start, &surface));
  for (size_t i = 0; i < surface->n_data; i++) size = fmax(size, fabs(surface->data[i]));
  if (!(distance(surface, model->surface) <= 1e-9 * size))
    status = fs_fail(ctx, FS_ERR_UNSUPPORTED,
                     "the page makes its surface from the control net, and that is not the surface of the model");
done:
  fs_surface_free(ctx, surface);
  fs_space_free(ctx, space);
  return status;
}

static void write_piece(fs_writer *writer, int32_t number) {
  fs_writer_bytes(writer, fs_html_piece[number], fs_html_piece_size[number]);
}

static void write_points(fs_writer *writer, fs_base64 *base64, int32_t n, const fs_vec3 *point) {
  for (int32_t i = 0; i < n; i++) {
    fs_base64_float64(base64, writer, point[i].x);
    fs_base64_float64(base64, writer, point[i].y);
    fs_base64_float64(base64, writer, point[i].z);
  }
}

static void write_net(fs_writer *writer, const fs_model *model, int32_t scene) {
  static const fs_cap_notes none = {0};
  const fs_mesh *net = model->control;
  const fs_cap_notes *caps = model->caps != NULL ? model->caps : &none;
  fs_base64 base64 = {0};
  int32_t n_offsets = 0;
  for (int32_t i = 0; i < caps->n_caps; i++) n_offsets += caps->cap[i].n;
  fs_writer_printf(writer,
                   "<script type=\"text/plain\" id=\"net\" data-vertices=\"%d\" data-faces=\"%d\" data-corners=\"%d\" "
                   "data-caps=\"%d\" data-offsets=\"%d\" data-scene=\"%d\" data-made-with=\"",
                   (int)net->n_vertices, (int)net->n_faces, (int)net->n_halfedges, (int)caps->n_caps, (int)n_offsets,
                   (int)scene);
  fs_html_write_text(writer, model->made_with != NULL ? model->made_with : "");
  fs_writer_text(writer, "\">");
  write_points(writer, &base64, net->n_vertices, net->position);
  for (int32_t i = 0; i < caps->n_caps; i++)
    write_points(writer, &base64, caps->cap[i].n, caps->coefficient + caps->cap[i].first);
  for (int32_t f = 0; f <= net->n_faces; f++) fs_base64_int32(&base64, writer, net->face_start[f]);
  for (int32_t h = 0; h < net->n_halfedges; h++) fs_base64_int32(&base64, writer, net->origin[h]);
  for (int32_t i = 0; i < caps->n_caps; i++) {
    fs_base64_int32(&base64, writer, caps->cap[i].vertex);
    fs_base64_int32(&base64, writer, caps->cap[i].spoke);
    fs_base64_int32(&base64, writer, caps->cap[i].valence);
    fs_base64_int32(&base64, writer, caps->cap[i].n);
  }
  fs_base64_finish(&base64, writer);
  fs_writer_text(writer, "</script>");
}

/* Behind the net, in base64: float64 position[points][3], int32 line[lines][2], uint8 colour[points][3]. Positions lie a little
   above the outside, or triangles would cover them. */
static void write_curves(fs_writer *writer, const fs_strokes *s, double lift) {
  fs_base64 base64 = {0};
  fs_writer_printf(writer, "<script type=\"text/plain\" id=\"curves\" data-points=\"%d\" data-lines=\"%d\">",
                   (int)s->n_points, (int)s->n_lines);
  for (int32_t i = 0; i < s->n_points; i++) {
    const fs_vec3 p = fs_vec3_add_scaled(s->position[i], s->normal[i], lift);
    write_points(writer, &base64, 1, &p);
  }
  for (int32_t i = 0; i < s->n_lines; i++)
    for (int k = 0; k < 2; k++) fs_base64_int32(&base64, writer, s->line[i][k]);
  for (int32_t i = 0; i < s->n_points; i++)
    for (int k = 0; k < 3; k++) fs_base64_uint8(&base64, writer, (uint8_t)lround(255 * s->colour[i][k]));
  fs_base64_finish(&base64, writer);
  fs_writer_text(writer, "</script>");
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_writer writer;
  fs_strokes *strokes = NULL;
  double diagonal = 0;
  fs_status status = check(ctx, model);
  if (status != FS_OK) return status;
  if (model->curves != NULL) {
    diagonal = fs_strokes_extent(model->control->position, model->control->n_vertices);
    status = fs_strokes_create(ctx, model->curves, 1e-3 * diagonal, 0.01 * diagonal, &strokes);
    if (status != FS_OK) return status;
  }
  fs_writer_start(&writer, ctx, output, "html");
  write_piece(&writer, FS_HTML_TITLE);
  fs_html_write_text(&writer, model->name);
  write_piece(&writer, FS_HTML_NET);
  write_net(&writer, model, (int32_t)param[SCENE]);
  if (strokes != NULL) write_curves(&writer, strokes, 5e-4 * diagonal);
  write_piece(&writer, FS_HTML_NET + 1);
  fs_strokes_free(ctx, strokes);
  return fs_writer_finish(&writer);
}

const fs_exporter fs_exporter_html = {
    .name = "html",
    .extension = "html",
    .summary = "web page that shows the surface: one file, no network",
    .params = params,
    .what = FS_EXPORT_NET,
    .write = write,
    .has_curves = true,
};
