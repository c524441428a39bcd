/* SPDX-License-Identifier: MIT */
/* Single role: the table of exporters, and the ways into it: by extension, with checks, to a path. */
#include "writer.h"
#include "base/base.h"
#include "file/file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

extern const fs_exporter fs_exporter_povray, fs_exporter_openscad, fs_exporter_threemf, fs_exporter_html,
    fs_exporter_step, fs_exporter_bezierview, fs_exporter_splines;
extern const fs_exporter fs_exporter_draco, fs_exporter_glb, fs_exporter_svg, fs_exporter_pdf;

const fs_exporter *const fs_exporters[] = {&fs_exporter_povray,
                                           &fs_exporter_obj,
                                           &fs_exporter_off,
                                           &fs_exporter_ply,
                                           &fs_exporter_stl,
                                           &fs_exporter_openscad,
                                           &fs_exporter_step,
                                           &fs_exporter_bezierview,
                                           &fs_exporter_splines,
                                           &fs_exporter_glb,
#ifdef FS_HAVE_DRACO
                                           &fs_exporter_draco,
#endif
#ifdef FS_HAVE_THREEMF
                                           &fs_exporter_threemf,
#endif
#ifdef FS_HAVE_HTML
                                           &fs_exporter_html,
#endif
#ifdef FS_HAVE_CAIRO
                                           &fs_exporter_svg,
                                           &fs_exporter_pdf,
#endif
                                           NULL};

enum { MAX_PARAMS = 32, STEM_SIZE = 256 };

static char lower(char c) { return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c; }

static bool equals_any_case(const char *a, const char *b) {
  for (; lower(*a) == lower(*b); a++, b++)
    if (*a == '\0') return true;
  return false;
}

const fs_exporter *fs_exporter_find(const char *extension) {
  for (int32_t i = 0; fs_exporters[i] != NULL; i++)
    if (equals_any_case(fs_exporters[i]->extension, extension)) return fs_exporters[i];
  return NULL;
}

static fs_status fail_unknown(fs_context *ctx, const char *extension) {
  char known[128] = "";
  for (int32_t i = 0; fs_exporters[i] != NULL; i++) {
    size_t used = strlen(known);
    snprintf(known + used, sizeof known - used, "%s%s", i > 0 ? ", " : "", fs_exporters[i]->extension);
  }
  if (*extension == '\0')
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "a path without an extension says no format to write; known are: %s",
                   known);
  return fs_fail(ctx, FS_ERR_UNSUPPORTED, "no exporter writes .%.40s files; known are: %s", extension, known);
}

/* The given numbers, or the initial ones, checked against their ranges; choices must be whole. */
static fs_status take_params(fs_context *ctx, const fs_exporter *exporter, const double *given, double *param) {
  const fs_param *list = exporter->params;
  for (int32_t i = 0; list != NULL && list[i].name != NULL; i++) {
    if (i == MAX_PARAMS)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "the %s exporter has more than %d parameters", exporter->name, MAX_PARAMS);
    param[i] = given != NULL ? given[i] : list[i].initial;
    if (!(param[i] >= list[i].min && param[i] <= list[i].max))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%s of the %s exporter is %g, not between %g and %g", list[i].name,
                     exporter->name, param[i], list[i].min, list[i].max);
    if (list[i].choices != NULL && param[i] != floor(param[i]))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%s of the %s exporter is %g, not the number of a choice", list[i].name,
                     exporter->name, param[i]);
  }
  return FS_OK;
}

static fs_status check_parts(fs_context *ctx, const fs_model *model, const fs_exporter *exporter) {
  if (exporter->what == FS_EXPORT_SURFACE && model->surface == NULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the %s exporter writes surfaces, and the model has none", exporter->name);
  if (exporter->what == FS_EXPORT_NET && model->control == NULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the %s exporter writes control nets, and the model has none", exporter->name);
  if (model->surface == NULL && model->control == NULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the model has neither a surface nor a control net to write");
  return FS_OK;
}

fs_status fs_export(fs_context *ctx, const fs_model *model, const fs_exporter *exporter, const double *param,
                    const fs_output *output) {
  double checked[MAX_PARAMS] = {0};
  fs_model named = *model;
  fs_status status = take_params(ctx, exporter, param, checked);
  if (status == FS_OK) status = check_parts(ctx, model, exporter);
  if (status != FS_OK) return status;
  if (named.name == NULL || *named.name == '\0') named.name = "surface";
  ctx->message[0] = '\0';
  status = exporter->write(ctx, &named, checked, output);
  /* Outputs of callers need not know about messages. */
  if (status != FS_OK && ctx->message[0] == '\0')
    return fs_fail(ctx, status, "the output of the %s exporter refused to take more bytes", exporter->name);
  return status;
}

/* The last part of the path without folders and extension. */
static void take_stem(const char *path, char stem[STEM_SIZE]) {
  const char *slash = strrchr(path, '/'), *name = slash != NULL ? slash + 1 : path;
  const char *extension = fs_path_extension(path);
  size_t size = *extension != '\0' ? (size_t)(extension - 1 - name) : strlen(name);
  if (size > STEM_SIZE - 1) size = STEM_SIZE - 1;
  memcpy(stem, name, size);
  stem[size] = '\0';
}

fs_status fs_export_file(fs_context *ctx, const fs_model *model, const double *param, const char *path) {
  const char *extension = fs_path_extension(path);
  const fs_exporter *exporter = fs_exporter_find(extension);
  char stem[STEM_SIZE];
  fs_model named = *model;
  fs_files *files = NULL;
  fs_output output;
  fs_status status;
  if (exporter == NULL) return fail_unknown(ctx, extension);
  take_stem(path, stem);
  if (named.name == NULL) named.name = stem;
  named.file = stem;
  status = fs_files_create(ctx, path, &files, &output);
  if (status != FS_OK) return status;
  status = fs_export(ctx, &named, exporter, param, &output);
  if (status == FS_OK) return fs_files_commit(ctx, files);
  fs_files_discard(ctx, files);
  return status;
}
