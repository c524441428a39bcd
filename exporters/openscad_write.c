/* SPDX-License-Identifier: MIT */
/* Single role: the text of NAME.scad: comments, variables for the customizer, the arrays, one function and one module.

   Faces are written clockwise seen from outside, as polyhedron() wants them. An open surface becomes a solid: two copies
   of its points, moved along the exact normals, joined by two triangles per side of the rim. */
#include "openscad.h"

enum { POINT_DIGITS = 9, NORMAL_DIGITS = 7 };

static void text(fs_writer *w, const char *string) { fs_writer_text(w, string); }
static void number(fs_writer *w, double value, int32_t digits) { fs_writer_rounded(w, value, digits); }

static void vector(fs_writer *w, fs_vec3 value, int32_t digits) {
  text(w, "[");
  fs_writer_rounded_vec3(w, value, ",", digits);
  text(w, "]");
}

static void comment_line(fs_writer *w, const char *before, const char *line, const char *after) {
  text(w, before);
  fs_writer_line_text(w, line);
  text(w, after);
}

static void write_use(fs_writer *w, const fs_openscad_file *f) {
  const char *name = f->name;
  comment_line(w, "//\n//   use <", f->model->file != NULL ? f->model->file : f->model->name, ".scad>\n");
  if (f->rim->n_loops == 0) {
    fs_writer_printf(w, "//   %s();          // a solid\n", name);
    fs_writer_printf(w, "//   %s(size = 2);  // twice as large\n", name);
    fs_writer_printf(w, "//   %s_vnf()       // [points, faces], as BOSL2 takes them\n//\n", name);
    return;
  }
  fs_writer_printf(w, "//   %s();  // a solid with the wall below\n//   %s(wall = ", name, name);
  number(w, f->wall / 2, 3);
  text(w, ", side = 0);  // a thinner wall, half of it on each side of the surface\n");
  fs_writer_printf(w, "//   %s_vnf()  // [points, faces] of the solid, as BOSL2 takes them\n", name);
  fs_writer_printf(w, "//   %s_vnf(wall = 0)  // the surface alone\n//\n", name);
}

static void write_radius(fs_writer *w, const fs_survey *s, int32_t direction, const char *where) {
  if (s->patch[direction] == FS_NONE) return;
  text(w, "//   ");
  text(w, where);
  text(w, ": ");
  number(w, s->radius[direction], 4);
  text(w, " at ");
  vector(w, s->place[direction], 6);
  text(w, "\n");
}

static void write_facts(fs_writer *w, const fs_openscad_file *f) {
  const fs_survey *s = f->survey;
  fs_writer_printf(w, "// %d patches as %d triangles, %d x %d cells per patch, within about ",
                   (int)f->model->surface->n_patches, (int)f->triangles->n_triangles, (int)f->n_steps, (int)f->n_steps);
  number(w, fs_survey_deviation(s, f->n_steps), 2);
  text(w, " of the surface.\n// Lengths are millimetres. Box: ");
  vector(w, s->min, 6);
  text(w, " .. ");
  vector(w, s->max, 6);
  text(w, "\n");
  if (f->rim->n_loops == 0) return;
  text(w, "// The wall must be thinner than the smallest radius of curvature on its side, or the solid folds:\n");
  write_radius(w, s, FS_INWARDS, "inwards");
  write_radius(w, s, FS_OUTWARDS, "outwards");
}

/* Variables with ranges that the customizer shows as sliders. */
static void write_variables(fs_writer *w, const fs_openscad_file *f) {
  if (f->rim->n_loops > 0) {
    text(w, "\n/* [Wall] */\n// thickness of the wall\nwall = ");
    number(w, f->wall, 6);
    text(w, "; // [");
    number(w, f->wall / 10, 6);
    text(w, ":");
    number(w, f->wall / 10, 6);
    text(w, ":");
    number(w, f->wall * 10, 6);
    text(w, "]\n// where the wall grows from the surface\nside = ");
    number(w, f->side, 6);
    text(w, "; // [-1:inwards, 0:both sides, 1:outwards]\n");
  }
  text(w, "\n/* [Size] */\n// factor of the size of the surface");
  text(w, f->rim->n_loops > 0 ? ", the wall stays\n" : "\n");
  text(w, "size = 1; // [0.1:0.1:10]\n\n/* [Hidden] */\n");
}

static void write_vectors(fs_writer *w, const char *name, const char *what, int32_t n, const fs_vec3 *value,
                          int32_t digits) {
  fs_writer_printf(w, "%s_%s = [\n", name, what);
  for (int32_t k = 0; k < n; k++) {
    vector(w, value[k], digits);
    text(w, k + 1 < n ? ",\n" : "\n];\n");
  }
}

static void write_faces(fs_writer *w, const fs_openscad_file *f) {
  const fs_triangles *t = f->triangles;
  int32_t second = f->is_reversed ? 1 : 2;
  fs_writer_printf(w, "%s_faces = [\n", f->name);
  for (int32_t k = 0; k < t->n_triangles; k++) {
    const int32_t *corner = t->corner + 3 * (size_t)k;
    text(w, "[");
    fs_writer_integer(w, corner[0]);
    text(w, ",");
    fs_writer_integer(w, corner[second]);
    text(w, ",");
    fs_writer_integer(w, corner[3 - second]);
    text(w, k + 1 < t->n_triangles ? "],\n" : "]\n];\n");
  }
}

static void write_border(fs_writer *w, const char *name, const fs_rim *rim) {
  fs_writer_printf(w, "%s_border = [ // loops, the surface at the left seen from outside\n", name);
  for (int32_t i = 0; i < rim->n_loops; i++) {
    for (int32_t k = rim->start[i]; k < rim->start[i + 1]; k++) {
      text(w, k == rim->start[i] ? "[" : ",");
      fs_writer_integer(w, rim->vertex[k]);
    }
    text(w, i + 1 < rim->n_loops ? "],\n" : "]\n];\n");
  }
}

/* Folds are told of where the wall is chosen: in OpenSCAD. */
static void write_fold_warning(fs_writer *w, const fs_openscad_file *f, int32_t direction) {
  const fs_survey *s = f->survey;
  bool is_inwards = direction == FS_INWARDS;
  if (s->patch[direction] == FS_NONE) return;
  fs_writer_printf(w, "  if (wall * (1 %c side) / 2 >= size * ", is_inwards ? '-' : '+');
  number(w, s->radius[direction], 6);
  fs_writer_printf(w, ")\n    echo(str(\"WARNING: %s: the wall folds %s: its radius of curvature is \", size * ",
                   f->name, is_inwards ? "inwards" : "outwards");
  number(w, s->radius[direction], 6);
  text(w, ", \" near \", size * ");
  vector(w, s->place[direction], 6);
  text(w, "));\n");
}

static void write_open_code(fs_writer *w, const fs_openscad_file *f) {
  const char *n = f->name;
  fs_writer_printf(w,
                   "\n// [points, faces] of the solid; of the surface alone where wall is 0\n"
                   "function %s_vnf(wall = wall, side = side, size = size) =\n"
                   "  wall == 0 ? [size * %s_points, %s_faces] :\n"
                   "  let (n = len(%s_points), outer = (1 + side) / 2 * wall, inner = (side - 1) / 2 * wall) [\n"
                   "    [for (d = [outer, inner]) for (i = [0 : n - 1]) size * %s_points[i] + d * %s_normals[i]],\n"
                   "    concat(\n"
                   "      %s_faces,\n"
                   "      [for (f = %s_faces) [n + f[2], n + f[1], n + f[0]]],\n"
                   "      [for (loop = %s_border) let (m = len(loop)) for (i = [0 : m - 1])\n"
                   "        let (a = loop[i], b = loop[(i + 1) %% m]) each [[a, b, n + b], [a, n + b, n + a]]])\n"
                   "  ];\n",
                   n, n, n, n, n, n, n, n, n);
  fs_writer_printf(w,
                   "\nmodule %s(wall = wall, side = side, size = size, convexity = 10) {\n"
                   "  assert(wall > 0, \"%s: wall must be positive\");\n"
                   "  assert(side >= -1 && side <= 1, \"%s: side must be between -1 and 1\");\n",
                   n, n, n);
  write_fold_warning(w, f, FS_INWARDS);
  write_fold_warning(w, f, FS_OUTWARDS);
  fs_writer_printf(w,
                   "  vnf = %s_vnf(wall, side, size);\n"
                   "  polyhedron(points = vnf[0], faces = vnf[1], convexity = convexity);\n}\n",
                   n);
}

static void write_closed_code(fs_writer *w, const fs_openscad_file *f) {
  const char *n = f->name;
  fs_writer_printf(w,
                   "\nfunction %s_vnf(size = size) = [size * %s_points, %s_faces];\n"
                   "\nmodule %s(size = size, convexity = 10) {\n"
                   "  polyhedron(points = size * %s_points, faces = %s_faces, convexity = convexity);\n}\n",
                   n, n, n, n, n, n);
}

fs_status fs_openscad_write(fs_context *ctx, const fs_openscad_file *f, const fs_output *output) {
  const fs_triangles *t = f->triangles;
  bool is_open = f->rim->n_loops > 0;
  fs_writer writer, *w = &writer;
  fs_writer_start(w, ctx, output, "scad");
  fs_writer_printf(w, "// %s: a smooth surface made by fairsurf %s\n", f->name, fs_version());
  if (f->model->made_with != NULL) comment_line(w, "// ", f->model->made_with, "\n");
  write_use(w, f);
  write_facts(w, f);
  write_variables(w, f);
  write_vectors(w, f->name, "points", t->n_vertices, t->position, POINT_DIGITS);
  if (is_open) write_vectors(w, f->name, "normals", t->n_vertices, t->normal, NORMAL_DIGITS);
  write_faces(w, f);
  if (is_open) write_border(w, f->name, f->rim);
  if (is_open)
    write_open_code(w, f);
  else
    write_closed_code(w, f);
  fs_writer_printf(w, "\n%s(); // shown when this file is opened, not where it is used\n", f->name);
  return fs_writer_finish(w);
}
