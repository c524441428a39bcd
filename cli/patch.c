/* SPDX-License-Identifier: MIT */
/* The command patch: a surface made directly from a mesh or splines by one of the constructions, written to files. */
#include "cli.h"

#include <stdlib.h>
#include <string.h>

/* Reads "x y z" lines, one per vertex in their order; # starts a comment. */
static fs_status parse_normals(fs_context *ctx, const char *path, const char *text, int32_t n, fs_vec3 *normal) {
  int32_t count = 0, line = 1;
  for (; *text != '\0'; line++) {
    const char *end = text + strcspn(text, "\n");
    fs_vec3 v;
    int used = 0;
    size_t blank = strspn(text, " \t\r");
    if (text + blank < end && text[blank] != '#') {
      bool is_read = sscanf(text, "%lf %lf %lf %n", &v.x, &v.y, &v.z, &used) == 3 && text + used >= end;
      if (!is_read || count == n) {
        snprintf(ctx->message, sizeof ctx->message,
                 is_read ? "%s:%d: more normals than the %d vertices" : "%s:%d: three numbers are needed", path,
                 (int)line, (int)n);
        return FS_ERR_FORMAT;
      }
      normal[count++] = v;
    }
    text = *end == '\0' ? end : end + 1;
  }
  if (count == n) return FS_OK;
  snprintf(ctx->message, sizeof ctx->message, "%s: %d normals for %d vertices", path, (int)count, (int)n);
  return FS_ERR_FORMAT;
}

/* normal stays NULL without a file. */
static fs_status read_normals(fs_context *ctx, const char *path, int32_t n, fs_vec3 **normal) {
  char *text;
  size_t size;
  fs_status status;
  if (path == NULL) return FS_OK;
  *normal = malloc((size_t)n * sizeof **normal);
  if (*normal == NULL) {
    snprintf(ctx->message, sizeof ctx->message, "out of memory");
    return FS_ERR_MEMORY;
  }
  status = fs_file_read(ctx, path, &text, &size);
  if (status != FS_OK) return status;
  status = parse_normals(ctx, path, text, n, *normal);
  fs_file_free(ctx, text);
  return status;
}

static fs_status write_outputs(fs_context *ctx, const arguments *a, const fs_surface *surface) {
  char made_with[200];
  int used = snprintf(made_with, sizeof made_with, "fairsurf %s, %s", fs_version(), a->construction->name);
  const fs_param *params = a->construction->params;
  for (int i = 0; params != NULL && params[i].name != NULL && used < (int)sizeof made_with; i++) {
    const char *const *choices = params[i].choices;
    if (choices != NULL)
      used += snprintf(made_with + used, sizeof made_with - (size_t)used, " %s=%s", params[i].name,
                       choices[(int)a->construction_param[i]]);
    else
      used += snprintf(made_with + used, sizeof made_with - (size_t)used, " %s=%g", params[i].name,
                       a->construction_param[i]);
  }
  for (int32_t i = 0; i < a->n_outputs; i++) {
    const output_request *o = &a->output[i];
    fs_model model = {.name = a->name, .surface = surface, .colour = o->colour, .made_with = made_with};
    fs_status status = FS_OK;
    if (o->exporter->what == FS_EXPORT_NET) {
      snprintf(ctx->message, sizeof ctx->message,
               "%.100s: a .%s file is made from a control net, and patches have none", o->path, o->exporter->extension);
      status = FS_ERR_UNSUPPORTED;
    }
    if (status == FS_OK) status = fs_export_file(ctx, &model, o->param, o->path);
    if (status != FS_OK) return status;
  }
  return FS_OK;
}

static fs_status build_from_mesh(fs_context *ctx, const arguments *a, fs_surface **surface) {
  fs_mesh *mesh = NULL;
  fs_vec3 *normal = NULL;
  fs_status status = fs_mesh_read(ctx, a->mesh, &mesh);
  if (status == FS_OK) status = read_normals(ctx, a->normals, mesh->n_vertices, &normal);
  fs_construction_input input = {.mesh = mesh, .normal = normal};
  if (status == FS_OK) status = fs_construct(ctx, a->construction, &input, a->construction_param, surface);
  fs_mesh_free(ctx, mesh);
  free(normal);
  return status;
}

static fs_status build_from_splines(fs_context *ctx, const arguments *a, fs_surface **surface) {
  fs_splines *splines = NULL;
  fs_status status = fs_splines_read(ctx, a->mesh, &splines);
  fs_construction_input input = {.splines = splines};
  if (status == FS_OK) status = fs_construct(ctx, a->construction, &input, a->construction_param, surface);
  fs_splines_free(ctx, splines);
  return status;
}

fs_status construct_surface(fs_context *ctx, const arguments *a, fs_surface **surface) {
  return a->construction->takes == FS_TAKES_SPLINES ? build_from_splines(ctx, a, surface)
                                                    : build_from_mesh(ctx, a, surface);
}

fs_status run_patch(fs_context *ctx, const arguments *a) {
  fs_surface *surface = NULL;
  fs_status status = construct_surface(ctx, a, &surface);
  if (status == FS_OK) status = write_outputs(ctx, a, surface);
  fs_surface_free(ctx, surface);
  return status;
}
