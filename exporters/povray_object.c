/* SPDX-License-Identifier: MIT */
/* NAME.inc as native patches: a union of bicubic_patch, rows of points along u, so that outside is p_u x p_v. */
#include "povray.h"
#include "math/vec3.h"

void fs_povray_write_head(fs_writer *w, const fs_povray_model *m) {
  const char *name = m->name;
  fs_writer_printf(w, "// %s: a smooth surface made by fairsurf %s\n", name, fs_version());
  if (m->model->made_with != NULL) {
    fs_writer_text(w, "// ");
    fs_writer_line_text(w, m->model->made_with);
    fs_writer_text(w, "\n");
  }
  fs_writer_printf(w, "// Object only, z up, right-handed: object { %s texture { ... } }\n", name);
  fs_writer_printf(w, "#ifndef (%s_Included)\n#declare %s_Included = 1;\n", name, name);
  fs_writer_printf(w, "#declare %s_Min = ", name);
  fs_povray_vector(w, m->min, 10);
  fs_writer_printf(w, ";\n#declare %s_Max = ", name);
  fs_povray_vector(w, m->max, 10);
  fs_writer_printf(w, ";\n");
}

static void write_facts(fs_writer *w, const fs_povray_model *model, const fs_povray_pieces *pieces) {
  fs_writer_printf(w, "// %d patches: %d of degree 3 or less, exact", (int)pieces->n_patches, (int)pieces->n_whole);
  if (pieces->n_divided == 0) {
    fs_writer_printf(w, "\n");
    return;
  }
  fs_writer_printf(w, pieces->is_tensor ? "; %d of higher degree (caps),\n" : "; %d of other kinds,\n",
                   (int)pieces->n_divided);
  fs_writer_printf(
      w,
      "//   each approximated by 4^m bicubic pieces, m = %d: position, derivatives and twist at their corners\n"
      "//   tolerance ",
      (int)pieces->m);
  fs_povray_number(w, model->tolerance, 4);
  fs_writer_printf(w, ", largest deviation ");
  fs_povray_number(w, pieces->deviation, 4);
  fs_writer_printf(w, "\n//   largest angle between normals across %s: ",
                   pieces->is_tensor ? "the sides of caps, spokes included" : "their sides");
  fs_povray_number(w, pieces->angle * (180 / 3.14159265358979323846), 4);
  fs_writer_printf(w, " degrees\n");
}

/* Pieces of divided patches are drawn with m steps less, so that shared sides have the same vertices. */
static void write_steps(fs_writer *w, const fs_povray_model *model, const fs_povray_pieces *pieces) {
  const char *name = model->name;
  fs_writer_printf(w, "// %s_Steps = k draws each patch as 2^k x 2^k cells; declare it before including this file\n",
                   name);
  fs_writer_printf(w, "#ifndef (%s_Steps) #declare %s_Steps = %d; #end\n", name, name, (int)model->steps);
  if (pieces->n_divided == 0) return;
  fs_writer_printf(w, "#if (%s_Steps < %d) #error \"%s_Steps must be %d or more\\n\" #end\n", name, (int)pieces->m + 1,
                   name, (int)pieces->m + 1);
  fs_writer_printf(w, "#declare %s_Less = %s_Steps - %d;\n", name, name, (int)pieces->m);
}

/* A ray that meets a side of two triangles exactly is lost where rounding puts it beside both, which symmetric views along
   the spokes of a cap, or along the diagonal of a sector, do show. So patches are drawn over slightly wider parameters:
   neighbours overlap by less than can be seen, and as the four amounts differ, no line of the cells lies on a symmetry. */
static const double wider_u[2] = {-1e-6, 1 + 1.7e-6}, wider_v[2] = {-2.3e-6, 1 + 0.6e-6};

static fs_vec3 between(fs_vec3 a, fs_vec3 b, double t) {
  return fs_vec3_add(fs_vec3_scale(a, 1 - t), fs_vec3_scale(b, t));
}

/* The four points of a cubic over the wider interval: its blossom at (t0, t0, t0), (t0, t0, t1), … */
static void widen(fs_vec3 *line, int stride, const double wider[2]) {
  fs_vec3 out[4];
  for (int k = 0; k < 4; k++) {
    fs_vec3 b[4] = {line[0], line[stride], line[2 * stride], line[3 * stride]};
    for (int step = 0; step < 3; step++)
      for (int i = 0; i < 3 - step; i++) b[i] = between(b[i], b[i + 1], wider[step >= 3 - k]);
    out[k] = b[0];
  }
  for (int k = 0; k < 4; k++) line[k * stride] = out[k];
}

/* Pieces take the parameters of their patch, a square per patch. The renderer wants the corners in the order of points
   1, 4, 16, 13: u along the rows' numbers, v within a row. */
static void write_parameters(fs_writer *w, double u, double v, double size) {
  const double corner[4][2] = {{u, v}, {u, v + size}, {u + size, v + size}, {u + size, v}};
  for (int k = 0; k < 4; k++) {
    fs_writer_text(w, k == 0 ? "uv_vectors <" : ",<");
    fs_povray_number(w, corner[k][0], 5);
    fs_writer_text(w, ",");
    fs_povray_number(w, corner[k][1], 5);
    fs_writer_text(w, ">");
  }
  fs_writer_text(w, "\n");
}

/* Piece `number` of the n x n of a patch; is_part: of one that is divided, maybe into one. */
static void write_piece(fs_writer *w, const char *name, bool is_part, size_t number, size_t n, const fs_vec3 *exact) {
  const char *steps = is_part ? "Less" : "Steps";
  fs_vec3 point[16];
  for (int k = 0; k < 16; k++) point[k] = exact[k];
  for (int j = 0; j < 4; j++) widen(point + 4 * j, 1, wider_u);
  for (int i = 0; i < 4; i++) widen(point + i, 4, wider_v);
  fs_writer_printf(w, "bicubic_patch { type 1 flatness 0 u_steps %s_%s v_steps %s_%s\n", name, steps, name, steps);
  write_parameters(w, (double)(number % n) / (double)n, (double)(number / n) / (double)n, 1 / (double)n);
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) {
      fs_povray_vector(w, point[i + 4 * j], 12);
      fs_writer_printf(w, i == 3 && j == 3 ? " }\n" : j == 3 ? ",\n" : ",");
    }
}

fs_status fs_povray_write_bicubic(fs_context *ctx, const fs_povray_model *model, const fs_povray_pieces *pieces,
                                  const fs_output *output) {
  fs_writer writer, *w = &writer;
  fs_writer_start(w, ctx, output, "inc");
  fs_povray_write_head(w, model);
  write_facts(w, model, pieces);
  write_steps(w, model, pieces);
  bool is_union = pieces->n_pieces > 1; /* a union of one object is warned of */
  fs_writer_printf(w, "#declare %s =%s\n", model->name, is_union ? " union {" : "");
  for (int32_t p = 0; p < pieces->n_patches; p++) {
    bool is_part = !fs_povray_is_whole(&model->model->surface->patch[p]);
    size_t first = pieces->first[p], n = is_part ? (size_t)1 << pieces->m : 1;
    for (size_t k = first; k < pieces->first[p + 1] && w->status == FS_OK; k++)
      write_piece(w, model->name, is_part, k - first, n, pieces->point + 16 * k);
  }
  fs_writer_printf(w, "%s#end\n", is_union ? "}\n" : "");
  return fs_writer_finish(w);
}
