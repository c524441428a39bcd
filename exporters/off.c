/* SPDX-License-Identifier: MIT */
/* Single role: Geomview OFF. A control net keeps its polygons and reads back with the same doubles; a surface becomes
   triangles. */
#include "caps_json.h"
#include "writer.h"

enum { STEPS, CAPS_FILE };

static void write_start(fs_writer *writer, const fs_model *model) {
  fs_writer_text(writer, "OFF\n# ");
  fs_writer_line_text(writer, model->made_with != NULL ? model->made_with : "fairsurf");
  fs_writer_text(writer, "\n");
}

static void write_counts(fs_writer *writer, int32_t n_vertices, int32_t n_faces) {
  fs_writer_printf(writer, "%d %d 0\n", n_vertices, n_faces);
}

static void write_positions(fs_writer *writer, int32_t n, const fs_vec3 *position) {
  for (int32_t v = 0; v < n; v++) {
    fs_writer_vec3(writer, position[v], " ");
    fs_writer_text(writer, "\n");
  }
}

static void write_net(fs_writer *writer, const fs_model *model, bool has_caps_file) {
  const fs_mesh *mesh = model->control;
  write_start(writer, model);
  fs_caps_json_comment(writer, model, has_caps_file);
  write_counts(writer, mesh->n_vertices, mesh->n_faces);
  write_positions(writer, mesh->n_vertices, mesh->position);
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    fs_writer_integer(writer, fs_mesh_face_size(mesh, f));
    for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; h++) {
      fs_writer_text(writer, " ");
      fs_writer_integer(writer, mesh->origin[h]);
    }
    fs_writer_text(writer, "\n");
  }
}

static void write_triangles(fs_writer *writer, const fs_model *model, const fs_triangles *t) {
  write_start(writer, model);
  write_counts(writer, t->n_vertices, t->n_triangles);
  write_positions(writer, t->n_vertices, t->position);
  for (int32_t i = 0; i < t->n_triangles; i++) {
    fs_writer_text(writer, "3");
    for (size_t j = 3 * (size_t)i; j < 3 * (size_t)i + 3; j++) {
      fs_writer_text(writer, " ");
      fs_writer_integer(writer, t->corner[j]);
    }
    fs_writer_text(writer, "\n");
  }
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_triangles *triangles = NULL;
  fs_writer writer;
  fs_status status = FS_OK;
  if (model->surface != NULL) status = fs_tessellate(ctx, model->surface, (int32_t)param[STEPS], &triangles);
  if (status != FS_OK) return status;
  fs_writer_start(&writer, ctx, output, "off");
  if (triangles != NULL)
    write_triangles(&writer, model, triangles);
  else
    write_net(&writer, model, param[CAPS_FILE] == 1);
  status = fs_writer_finish(&writer);
  if (status == FS_OK && triangles == NULL) status = fs_caps_json_write(ctx, model, param[CAPS_FILE] == 1, output);
  fs_triangles_free(ctx, triangles);
  return status;
}

const fs_exporter fs_exporter_off = {
    .name = "off",
    .extension = "off",
    .summary = "Geomview OFF: the control net with its polygons, or the surface as triangles",
    .params = (const fs_param[]){FS_PARAM_STEPS, FS_PARAM_CAPS_FILE, {.name = NULL}},
    .what = FS_EXPORT_BOTH,
    .write = write,
};
