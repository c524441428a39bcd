/* SPDX-License-Identifier: MIT */
/* Single role: Stanford PLY, binary little-endian or ascii. A control net keeps its polygons, its doubles and the inner
   coefficients of its caps; a surface becomes triangles with doubles for positions and floats for the exact normals at their
   corners, and for the values of the measure to colour by. Curves on it are further vertices, and edges with colours. */
#include "writer.h"
#include "base/base.h"
#include "measured.h"
#include "strokes.h"
#include "mesh/ply.h"

#include <float.h>
#include <math.h>

enum { STEPS, FORMAT };
enum { BINARY, ASCII };

typedef struct ply {
  fs_writer writer;
  bool is_ascii;
} ply;

/* Separates numbers of a line; binary files need none. */
static void separate(ply *p, const char *text) {
  if (p->is_ascii) fs_writer_text(&p->writer, text);
}

static void write_double(ply *p, double number) {
  if (p->is_ascii)
    fs_writer_number(&p->writer, number);
  else
    fs_writer_float64(&p->writer, number);
}

/* 9 digits tell all floats apart. */
static void write_float(ply *p, double number) {
  if (p->is_ascii)
    fs_writer_rounded(&p->writer, number, 9);
  else
    fs_writer_float32(&p->writer, number);
}

static void write_int(ply *p, int32_t number) {
  if (p->is_ascii)
    fs_writer_integer(&p->writer, number);
  else
    fs_writer_uint32(&p->writer, (uint32_t)number);
}

static void write_size(ply *p, int32_t size, bool is_byte) {
  if (is_byte && !p->is_ascii)
    fs_writer_uint8(&p->writer, (uint8_t)size);
  else
    write_int(p, size);
}

static void write_position(ply *p, fs_vec3 position) {
  write_double(p, position.x);
  separate(p, " ");
  write_double(p, position.y);
  separate(p, " ");
  write_double(p, position.z);
}

/* The measure stands under its own name and again as "quality", by which viewers colour. */
static void write_measure_header(fs_writer *writer, const fs_measure *measure) {
  fs_writer_printf(writer, "property float %s\nproperty float quality\n", measure->name);
}

/* normals: whether the vertices have them. Sizes of faces are bytes where they fit, as most readers expect. */
static void write_header(ply *p, const fs_model *model, int32_t n_vertices, bool normals, int32_t n_faces, bool is_byte,
                         int32_t n_caps, int32_t n_edges) {
  fs_writer *writer = &p->writer;
  fs_writer_printf(writer, "ply\nformat %s 1.0\ncomment ", p->is_ascii ? "ascii" : "binary_little_endian");
  fs_writer_line_text(writer, model->made_with != NULL ? model->made_with : "fairsurf");
  if (normals && model->colour != NULL) {
    fs_writer_printf(writer, "\ncomment %s and quality: ", model->colour->name);
    fs_writer_line_text(writer, model->colour->summary != NULL ? model->colour->summary : model->colour->name);
  }
  fs_writer_printf(writer, "\nelement vertex %d\n", n_vertices);
  fs_writer_text(writer, "property double x\nproperty double y\nproperty double z\n");
  if (normals) fs_writer_text(writer, "property float nx\nproperty float ny\nproperty float nz\n");
  if (normals && model->colour != NULL) write_measure_header(writer, model->colour);
  fs_writer_printf(writer, "element face %d\nproperty list %s int vertex_indices\n", n_faces,
                   is_byte ? "uchar" : "int");
  if (n_caps > 0)
    fs_writer_printf(writer,
                     "element " FS_PLY_CAP " %d\nproperty int vertex\nproperty int spoke\nproperty int valence\n"
                     "property int basis\nproperty list int double coefficients\n",
                     n_caps);
  if (n_edges > 0)
    fs_writer_printf(writer,
                     "element edge %d\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\n"
                     "property uchar green\nproperty uchar blue\nproperty float level\n",
                     n_edges);
  fs_writer_text(writer, "end_header\n");
}

static void write_caps(ply *p, const fs_cap_notes *notes) {
  for (int32_t i = 0; i < notes->n_caps; i++) {
    const fs_cap_note *cap = &notes->cap[i];
    const int32_t number[] = {cap->vertex, cap->spoke, cap->valence, notes->basis, 3 * cap->n};
    for (size_t k = 0; k < sizeof number / sizeof *number; k++) {
      if (k > 0) separate(p, " ");
      write_int(p, number[k]);
    }
    for (int32_t c = cap->first; c < cap->first + cap->n; c++) {
      separate(p, " ");
      write_position(p, notes->coefficient[c]);
    }
    separate(p, "\n");
  }
}

static void write_net(ply *p, const fs_model *model) {
  const fs_mesh *mesh = model->control;
  bool is_byte = true;
  for (int32_t f = 0; f < mesh->n_faces; f++) is_byte = is_byte && fs_mesh_face_size(mesh, f) <= 255;
  write_header(p, model, mesh->n_vertices, false, mesh->n_faces, is_byte, model->caps != NULL ? model->caps->n_caps : 0,
               0);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    write_position(p, mesh->position[v]);
    separate(p, "\n");
  }
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    write_size(p, fs_mesh_face_size(mesh, f), is_byte);
    for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; h++) {
      separate(p, " ");
      write_int(p, mesh->origin[h]);
    }
    separate(p, "\n");
  }
  if (model->caps != NULL) write_caps(p, model->caps);
}

static void write_normal(ply *p, fs_vec3 normal) {
  separate(p, " ");
  write_float(p, normal.x);
  separate(p, " ");
  write_float(p, normal.y);
  separate(p, " ");
  write_float(p, normal.z);
}

/* Vertices of curves have the same properties as the others; the measure is 0 there. */
static void write_stroke_points(ply *p, const fs_strokes *s, bool has_measure) {
  for (int32_t i = 0; i < s->n_points; i++) {
    write_position(p, s->position[i]);
    write_normal(p, s->normal[i]);
    for (int32_t k = 0; has_measure && k < 2; k++) {
      separate(p, " ");
      write_float(p, 0);
    }
    separate(p, "\n");
  }
}

/* first: number of the first vertex of the curves. */
static void write_edges(ply *p, const fs_strokes *s, int32_t first) {
  for (int32_t i = 0; i < s->n_lines; i++) {
    const int32_t *end = s->line[i];
    write_int(p, first + end[0]);
    separate(p, " ");
    write_int(p, first + end[1]);
    for (int k = 0; k < 3; k++) {
      separate(p, " ");
      write_size(p, (int32_t)lround(255 * s->colour[end[1]][k]), true);
    }
    separate(p, " ");
    write_float(p, s->level[end[1]]);
    separate(p, "\n");
  }
}

/* value[n_vertices] of the measure, or NULL. Where the measure has none, or one too large, the file says 0: readers know no NaN. */
static void write_triangles(ply *p, const fs_model *model, const fs_triangles *t, const double *value,
                            const fs_strokes *strokes) {
  write_header(p, model, t->n_vertices + (strokes != NULL ? strokes->n_points : 0), true, t->n_triangles, true, 0,
               strokes != NULL ? strokes->n_lines : 0);
  for (int32_t v = 0; v < t->n_vertices; v++) {
    write_position(p, t->position[v]);
    write_normal(p, t->normal[v]);
    for (int32_t k = 0; value != NULL && k < 2; k++) {
      separate(p, " ");
      write_float(p, fabs(value[v]) <= FLT_MAX ? value[v] : 0);
    }
    separate(p, "\n");
  }
  if (strokes != NULL) write_stroke_points(p, strokes, value != NULL);
  for (int32_t i = 0; i < t->n_triangles; i++) {
    write_size(p, 3, true);
    for (int32_t j = 0; j < 3; j++) {
      separate(p, " ");
      write_int(p, t->corner[3 * i + j]);
    }
    separate(p, "\n");
  }
  if (strokes != NULL) write_edges(p, strokes, t->n_vertices);
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  ply p = {.is_ascii = param[FORMAT] == ASCII};
  fs_triangles *triangles = NULL;
  fs_strokes *strokes = NULL;
  double *value = NULL;
  fs_status status = FS_OK;
  if (model->surface != NULL) FS_TRY(fs_tessellate(ctx, model->surface, (int32_t)param[STEPS], &triangles));
  if (triangles != NULL && model->colour != NULL) {
    FS_ALLOC(ctx, value, triangles->n_vertices);
    FS_TRY(fs_measure_vertices(ctx, model->surface, model->colour, triangles, value));
  }
  if (triangles != NULL && model->curves != NULL) {
    double size = fs_strokes_extent(triangles->position, triangles->n_vertices);
    FS_TRY(fs_strokes_create(ctx, model->curves, 0, 0.01 * size, &strokes));
    if (strokes->n_points > INT32_MAX - triangles->n_vertices) {
      status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "the curves and triangles have more points than a PLY file can number");
      goto done;
    }
  }
  fs_writer_start(&p.writer, ctx, output, "ply");
  if (triangles != NULL)
    write_triangles(&p, model, triangles, value, strokes);
  else
    write_net(&p, model);
  status = fs_writer_finish(&p.writer);
done:
  fs_strokes_free(ctx, strokes);
  fs_release(ctx, value);
  fs_triangles_free(ctx, triangles);
  return status;
}

const fs_exporter fs_exporter_ply = {
    .name = "ply",
    .extension = "ply",
    .summary = "Stanford PLY: the control net with its polygons and caps, or the surface as triangles with normals and "
               "a measure",
    .params = (const fs_param[]){FS_PARAM_STEPS,
                                 {.name = "format",
                                  .summary = "binary: little-endian",
                                  .initial = BINARY,
                                  .min = BINARY,
                                  .max = ASCII,
                                  .choices = (const char *const[]){"binary", "ascii", NULL}},
                                 {.name = NULL}},
    .what = FS_EXPORT_BOTH,
    .write = write,
    .has_curves = true,
};
