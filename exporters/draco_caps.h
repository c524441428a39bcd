/* SPDX-License-Identifier: MIT */
/* Inner coefficients of caps on their way to Draco. */
#ifndef FS_EXPORTERS_DRACO_CAPS_H
#define FS_EXPORTERS_DRACO_CAPS_H

#include "blob.h"

/* The bytes of the metadata FS_DRACO_CAPS. */
fs_status fs_draco_caps_append(const fs_cap_notes *notes, fs_blob *blob);

/* bytes[n_caps + 1][FS_DRACO_CAP_BYTES]: the values of the attribute FS_DRACO_CAP. */
void fs_draco_caps_values(int32_t n_caps, uint8_t *bytes);

/* cap_of_halfedge[n_halfedges]: 1 + the number of the cap at its spoke, 0 elsewhere. FS_ERR_ARGUMENT where a spoke is no edge. */
fs_status fs_draco_caps_spokes(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes,
                               int32_t *cap_of_halfedge);

#endif
