/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The formats that File > Export gains: lines of the library's table of exporters, and their options. */
#ifndef FS_MESHLAB_FORMATS_H
#define FS_MESHLAB_FORMATS_H

#include "filters.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Exporter number i, or NULL past the last one. Formats that the library was built without are left out. */
const fs_exporter *format_exporter(int32_t number);
const fs_exporter *format_find(const char *extension); /* of those; whatever its case */

/* params: the options of the save dialog, those that all formats have before those of the exporter; ends with a NULL name. */
enum { MAX_FORMAT_PARAMS = 24 };
void format_list_params(const fs_exporter *exporter, filter_param params[MAX_FORMAT_PARAMS]);

/* Writes a layer in the format of the extension of path; param: values in that order. */
fs_status format_write(fs_context *ctx, const fs_exporter *exporter, const layer *l, const double *param,
                       const char *path);

#ifdef __cplusplus
}
#endif
#endif
