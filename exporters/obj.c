/* SPDX-License-Identifier: MIT */
/* Single role: Wavefront OBJ. A control net keeps its polygons and reads back with the same doubles; a surface becomes
   triangles with the exact normals at their corners. */
#include "caps_json.h"
#include "writer.h"

enum { STEPS, CAPS_FILE };

static void write_net(fs_writer *writer, const fs_mesh *mesh) {
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    fs_writer_text(writer, "v ");
    fs_writer_vec3(writer, mesh->position[v], " ");
    fs_writer_text(writer, "\n");
  }
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    fs_writer_text(writer, "f");
    for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; h++) {
      fs_writer_text(writer, " ");
      fs_writer_integer(writer, mesh->origin[h] + (int64_t)1);
    }
    fs_writer_text(writer, "\n");
  }
}

static void write_triangles(fs_writer *writer, const fs_triangles *t) {
  for (int32_t v = 0; v < t->n_vertices; v++) {
    fs_writer_text(writer, "v ");
    fs_writer_vec3(writer, t->position[v], " ");
    fs_writer_text(writer, "\n");
  }
  for (int32_t v = 0; v < t->n_vertices; v++) {
    fs_writer_text(writer, "vn ");
    fs_writer_vec3(writer, t->normal[v], " ");
    fs_writer_text(writer, "\n");
  }
  for (int32_t i = 0; i < t->n_triangles; i++) {
    fs_writer_text(writer, "f");
    for (size_t j = 3 * (size_t)i; j < 3 * (size_t)i + 3; j++) {
      fs_writer_text(writer, " ");
      fs_writer_integer(writer, t->corner[j] + (int64_t)1);
      fs_writer_text(writer, "//");
      fs_writer_integer(writer, t->corner[j] + (int64_t)1);
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
  fs_writer_start(&writer, ctx, output, "obj");
  fs_writer_text(&writer, "# ");
  fs_writer_line_text(&writer, model->made_with != NULL ? model->made_with : "fairsurf");
  fs_writer_text(&writer, "\no ");
  fs_writer_line_text(&writer, model->name);
  fs_writer_text(&writer, "\n");
  if (triangles == NULL) fs_caps_json_comment(&writer, model, param[CAPS_FILE] == 1);
  if (triangles != NULL)
    write_triangles(&writer, triangles);
  else
    write_net(&writer, model->control);
  status = fs_writer_finish(&writer);
  if (status == FS_OK && triangles == NULL) status = fs_caps_json_write(ctx, model, param[CAPS_FILE] == 1, output);
  fs_triangles_free(ctx, triangles);
  return status;
}

const fs_exporter fs_exporter_obj = {
    .name = "obj",
    .extension = "obj",
    .summary = "Wavefront OBJ: the control net with its polygons, or the surface as triangles with normals",
    .params = (const fs_param[]){FS_PARAM_STEPS, FS_PARAM_CAPS_FILE, {.name = NULL}},
    .what = FS_EXPORT_BOTH,
    .write = write,
};
