/* SPDX-License-Identifier: MIT */
/* The HTML exporter: one page that works from a file, without a network. It holds the control net as base64 of
   little-endian numbers and makes the surface from it, by the core of this library as WebAssembly (web/).
   Layout of the net: float64 position[vertices][3], float64 offset[offsets][3], int32 face_start[faces + 1],
   int32 corner[corners]. Offsets are the inner coefficients of caps; a control net alone has none. */
#include "html.h"
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
  FS_TRY(fs_space_create(ctx, model->control, &space));
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

static void write_net(fs_writer *writer, const fs_model *model, int32_t scene) {
  const fs_mesh *net = model->control;
  fs_base64 base64 = {0};
  fs_writer_printf(writer,
                   "<script type=\"text/plain\" id=\"net\" data-vertices=\"%d\" data-faces=\"%d\" data-corners=\"%d\" "
                   "data-caps=\"0\" data-offsets=\"0\" data-scene=\"%d\" data-made-with=\"",
                   (int)net->n_vertices, (int)net->n_faces, (int)net->n_halfedges, (int)scene);
  fs_html_write_text(writer, model->made_with != NULL ? model->made_with : "");
  fs_writer_text(writer, "\">");
  for (int32_t v = 0; v < net->n_vertices; v++) {
    fs_base64_float64(&base64, writer, net->position[v].x);
    fs_base64_float64(&base64, writer, net->position[v].y);
    fs_base64_float64(&base64, writer, net->position[v].z);
  }
  for (int32_t f = 0; f <= net->n_faces; f++) fs_base64_int32(&base64, writer, net->face_start[f]);
  for (int32_t h = 0; h < net->n_halfedges; h++) fs_base64_int32(&base64, writer, net->origin[h]);
  fs_base64_finish(&base64, writer);
  fs_writer_text(writer, "</script>");
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_writer writer;
  fs_status status = check(ctx, model);
  if (status != FS_OK) return status;
  fs_writer_start(&writer, ctx, output, "html");
  write_piece(&writer, FS_HTML_TITLE);
  fs_html_write_text(&writer, model->name);
  write_piece(&writer, FS_HTML_NET);
  write_net(&writer, model, (int32_t)param[SCENE]);
  write_piece(&writer, FS_HTML_NET + 1);
  return fs_writer_finish(&writer);
}

const fs_exporter fs_exporter_html = {
    "html", "html", "web page that shows the surface: one file, no network", params, FS_EXPORT_NET, write,
};
