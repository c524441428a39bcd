/* SPDX-License-Identifier: MIT */
/* Single role: writes the file of inner coefficients beside a net (mesh/cap_json.h), and says in the net what it lacks. */
#include "caps_json.h"
#include "base/base.h"
#include "mesh/cap_json.h"

#include <inttypes.h>

void fs_caps_json_comment(fs_writer *writer, const fs_model *model, bool is_written) {
  if (model->caps == NULL) return;
  if (is_written) {
    fs_writer_printf(writer, "# the inner coefficients of %d caps are in ", model->caps->n_caps);
    fs_writer_line_text(writer, model->file != NULL ? model->file : model->name);
    fs_writer_text(writer, "." FS_CAPS_EXTENSION "\n");
  } else {
    fs_writer_printf(writer, "# without the inner coefficients of %d caps: alone it makes another surface\n",
                     model->caps->n_caps);
  }
}

static void write_cap(fs_writer *writer, const fs_cap_notes *notes, const fs_cap_note *cap) {
  fs_writer_printf(writer, "{\"vertex\": %d, \"spoke\": %d, \"valence\": %d, \"coefficients\": [", (int)cap->vertex,
                   (int)cap->spoke, (int)cap->valence);
  for (int32_t i = 0; i < cap->n; i++) {
    fs_writer_text(writer, i > 0 ? ",\n[" : "\n[");
    fs_writer_vec3(writer, notes->coefficient[cap->first + i], ", ");
    fs_writer_text(writer, "]");
  }
  fs_writer_text(writer, "]}");
}

fs_status fs_caps_json_write(fs_context *ctx, const fs_model *model, bool is_written, const fs_output *output) {
  const fs_mesh *net = model->control;
  const fs_cap_notes *notes = model->caps;
  fs_writer writer;
  if (notes == NULL) return FS_OK;
  if (!is_written) {
    fs_note(ctx, "%s is written without the inner coefficients of its %d caps: alone it makes another surface",
            model->name, notes->n_caps);
    return FS_OK;
  }
  fs_writer_start(&writer, ctx, output, FS_CAPS_EXTENSION);
  fs_writer_printf(&writer,
                   "{\"basis\": %d, \"vertices\": %d, \"faces\": %d, \"checksum\": \"%016" PRIx64 "\",\n\"caps\": [\n",
                   (int)notes->basis, (int)net->n_vertices, (int)net->n_faces, fs_mesh_checksum(net));
  for (int32_t i = 0; i < notes->n_caps; i++) {
    if (i > 0) fs_writer_text(&writer, ",\n");
    write_cap(&writer, notes, &notes->cap[i]);
  }
  fs_writer_text(&writer, "]}\n");
  return fs_writer_finish(&writer);
}
