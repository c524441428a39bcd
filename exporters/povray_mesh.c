/* SPDX-License-Identifier: MIT */
/* NAME.inc as mesh2: triangles with exact normals and, for a measure, its value as texture coordinate.

   Faces are written clockwise from outside: where the three normals of a triangle are equal the renderer takes the
   outside from the order of its corners, opposite to the usual sense; where they differ, from the normals. */
#include "povray.h"
#include "measured.h"
#include "base/base.h"
#include "math/vec3.h"

static void write_vectors(fs_writer *w, const char *keyword, const fs_vec3 *vector, int32_t n, int digits) {
  fs_writer_printf(w, "%s { %d,\n", keyword, (int)n);
  for (int32_t k = 0; k < n; k++) {
    fs_povray_vector(w, vector[k], digits);
    fs_writer_text(w, k + 1 < n ? ",\n" : "\n}\n");
  }
}

/* The gradient of the scene wraps at 0 and 1, hence strictly between. */
static void write_colours(fs_writer *w, const double *value, int32_t n, double low, double high) {
  fs_writer_printf(w, "uv_vectors { %d,\n", (int)n);
  for (int32_t k = 0; k < n; k++) {
    double u = (value[k] - low) / (high - low);
    fs_writer_text(w, "<");
    fs_povray_number(w, isnan(u) ? 0.5 : fmin(fmax(u, 0.001), 0.999), 5);
    fs_writer_text(w, k + 1 < n ? ",0.5>,\n" : ",0.5>\n}\n");
  }
}

static void write_faces(fs_writer *w, const fs_triangles *t) {
  fs_writer_printf(w, "face_indices { %d,\n", (int)t->n_triangles);
  for (int32_t k = 0; k < t->n_triangles; k++) {
    const int32_t *corner = t->corner + 3 * (size_t)k;
    fs_writer_text(w, "<");
    fs_writer_integer(w, corner[0]);
    fs_writer_text(w, ",");
    fs_writer_integer(w, corner[2]);
    fs_writer_text(w, ",");
    fs_writer_integer(w, corner[1]);
    fs_writer_text(w, k + 1 < t->n_triangles ? ">,\n" : ">\n}\n");
  }
}

static bool is_closed(const fs_surface *surface) {
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int s = 0; s < surface->patch[p].n_sides; s++)
      if (surface->patch[p].neighbour[s] == FS_NONE) return false;
  return true;
}

static void write_range(fs_writer *w, const char *name, const fs_measure *colour, double low, double high) {
  fs_writer_printf(w, "// the first coordinate of uv_vectors is %s from %s_Low (0) to %s_High (1)\n", colour->name,
                   name, name);
  fs_writer_printf(w, "#declare %s_Low = ", name);
  fs_povray_number(w, low, 7);
  fs_writer_printf(w, ";\n#declare %s_High = ", name);
  fs_povray_number(w, high, 7);
  fs_writer_printf(w, ";\n");
}

fs_status fs_povray_write_mesh(fs_context *ctx, const fs_povray_model *model, const fs_measure *colour,
                               const fs_output *output) {
  fs_status status = FS_OK;
  const fs_surface *surface = model->model->surface;
  fs_triangles *t = NULL;
  double *value = NULL, low = 0, high = 1;
  fs_writer writer, *w = &writer;
  FS_TRY(fs_tessellate(ctx, surface, (int32_t)1 << model->steps, &t));
  if (colour != NULL) {
    FS_ALLOC(ctx, value, t->n_vertices);
    FS_TRY(fs_measure_vertices(ctx, surface, colour, t, value));
    FS_TRY(fs_measure_range(ctx, value, (size_t)t->n_vertices, &low, &high));
  }
  fs_writer_start(w, ctx, output, "inc");
  fs_povray_write_head(w, model);
  fs_writer_printf(w, "// %d patches as %d triangles, %d x %d cells per patch, with the normals of the patches\n",
                   (int)surface->n_patches, (int)t->n_triangles, 1 << model->steps, 1 << model->steps);
  if (colour != NULL) write_range(w, model->name, colour, low, high);
  fs_writer_printf(w, "#declare %s = mesh2 {\n", model->name);
  write_vectors(w, "vertex_vectors", t->position, t->n_vertices, 10);
  write_vectors(w, "normal_vectors", t->normal, t->n_vertices, 7);
  if (colour != NULL) write_colours(w, value, t->n_vertices, low, high);
  write_faces(w, t);
  /* no direction of an edge, so that the ray that decides what is inside meets none */
  if (is_closed(surface)) fs_writer_printf(w, "inside_vector <0.1357, 0.2468, 0.9595>\n");
  fs_writer_printf(w, "}\n#end\n");
  FS_TRY(fs_writer_finish(w));
done:
  fs_release(ctx, value);
  fs_triangles_free(ctx, t);
  return status;
}
