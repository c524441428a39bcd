/* SPDX-License-Identifier: MIT */
/* Between bytes and paths: the only room that opens files. */
#ifndef FAIRSURF_FILE_H
#define FAIRSURF_FILE_H

#include <fairsurf/export.h>
#include <fairsurf/surface_splines.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The whole file, with a zero byte behind it that size does not count. Free with fs_file_free. */
FS_API fs_status fs_file_read(fs_context *ctx, const char *path, char **bytes, size_t *size);
FS_API void fs_file_free(fs_context *ctx, char *bytes);

/* Reads a control mesh; the format follows the extension of the path, whatever its case. */
FS_API fs_status fs_mesh_read(fs_context *ctx, const char *path, fs_mesh **mesh);
/* The same, and what the file says besides the polygons. Beside formats that keep nothing else, inner coefficients of caps
   come from NAME.caps.json, if there is one and it was written for this net. notes is overwritten, for fs_mesh_notes_clear. */
FS_API fs_status fs_mesh_read_notes(fs_context *ctx, const char *path, fs_mesh **mesh, fs_mesh_notes *notes);

/* Reads a surface or splines; a surface in the format that the extension of the path says, splines from .spl. */
FS_API fs_status fs_surface_read(fs_context *ctx, const char *path, fs_surface **surface);
FS_API fs_status fs_splines_read(fs_context *ctx, const char *path, fs_splines **splines);

/* An output that writes beside the final files (same folder, temporary names) and renames them all at the end, so that no
   half-written file is ever seen under its name. path: "dir/name.pov"; other extensions go to "dir/name.EXT". */
typedef struct fs_files fs_files;
FS_API fs_status fs_files_create(fs_context *ctx, const char *path, fs_files **files, fs_output *output);
FS_API fs_status fs_files_commit(fs_context *ctx,
                                 fs_files *files);              /* flushes, closes, renames; frees files in any case */
FS_API void fs_files_discard(fs_context *ctx, fs_files *files); /* removes what was written, frees; NULL is allowed */

/* All of it: picks the exporter by the extension of path, writes, renames. FS_ERR_UNSUPPORTED lists the known ones.
   The name of the model is the stem of the path where model->name is NULL. */
FS_API fs_status fs_export_file(fs_context *ctx, const fs_model *model, const double *param, const char *path);

#ifdef __cplusplus
}
#endif
#endif
