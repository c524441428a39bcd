/* SPDX-License-Identifier: MIT */
/* Exporters: a model in, bytes out. They write to an output, never to a path, and start no other program. */
#ifndef FAIRSURF_EXPORT_H
#define FAIRSURF_EXPORT_H

#include <fairsurf/analyse.h>
#include <fairsurf/analyse_curves.h>
#include <fairsurf/fair.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What there is to write; a part that an exporter does not use may be NULL. */
typedef struct fs_model {
  const char *name;       /* stem of the file, made an identifier by exporters that need one */
  const char *file;       /* stem of the files, by which they name each other; NULL: name */
  const fs_mesh *control; /* the control net, with the positions to write */
  const fs_surface *surface;
  const fs_measure *colour;
  const fs_curves *curves; /* on the surface, for exporters that draw; or NULL */
  const uint8_t *fixed;    /* [n_vertices] of control: 1 where fairing kept the vertex */
  const fs_cap_notes
      *caps;             /* inner coefficients that make the surface together with control; NULL: its caps are linear */
  const char *made_with; /* one line for comments: version, functional, parameters; or NULL */
  const char *functional; /* that the control net minimises, with its parameters; NULL: it was not faired */
  int32_t n_refinements;  /* from the mesh of the user to the control net */
} fs_model;

typedef struct fs_sink {
  fs_status (*write)(void *user, const void *bytes, size_t size);
  void *user;
} fs_sink;

/* Where an export goes: one file or several that belong together (NAME.pov and NAME.inc); memory in tests.
   open starts the file with that extension; what was opened before is complete. The sink lives until the next open. */
typedef struct fs_output {
  fs_status (*open)(void *user, const char *extension, fs_sink *sink);
  void *user;
} fs_output;

typedef enum fs_export_what { FS_EXPORT_NET, FS_EXPORT_SURFACE, FS_EXPORT_BOTH } fs_export_what;

typedef struct fs_exporter {
  const char *name, *extension, *summary;
  const fs_param *params;
  fs_export_what what; /* what it can write; BOTH: model->surface when there is one, else model->control */
  fs_status (*write)(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output);
  bool has_curves; /* writes model->curves too, where there are some */
} fs_exporter;
FS_API extern const fs_exporter *const fs_exporters[];             /* ends with NULL */
FS_API const fs_exporter *fs_exporter_find(const char *extension); /* "pov"; NULL: unknown */

/* Writes with param, or the initial values of the exporter's params where param is NULL. */
FS_API fs_status fs_export(fs_context *ctx, const fs_model *model, const fs_exporter *exporter, const double *param,
                           const fs_output *output);

#ifdef __cplusplus
}
#endif
#endif
