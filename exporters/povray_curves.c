/* SPDX-License-Identifier: MIT */
/* NAME.curves.inc: curves on the surface as thin tubes through their points, and the dark parts of a zebra as triangles just
   above both sides of the surface. */
#include "povray.h"
#include "strokes.h"
#include "base/base.h"
#include "math/vec3.h"

/* Long sweeps are slow: the renderer tests all parts of one against every ray that meets its box. */
enum { SWEEP = 16 };

static void write_pigment(fs_writer *w, const double rgb[3]) {
  fs_writer_text(w, " pigment { rgb ");
  fs_povray_vector(w, (fs_vec3){rgb[0], rgb[1], rgb[2]}, 4);
  fs_writer_text(w, " }");
}

/* Lines first .. first + n - 1, each of which goes on where the last one ends. */
static void write_sweep(fs_writer *w, const char *name, const fs_strokes *s, int32_t first, int32_t n) {
  fs_writer_printf(w, "sphere_sweep { linear_spline %d\n", (int)n + 1);
  for (int32_t i = 0; i <= n; i++) {
    int32_t point = i == 0 ? s->line[first][0] : s->line[first + i - 1][1];
    fs_povray_vector(w, s->position[point], 10);
    fs_writer_printf(w, ",%s_Width\n", name);
  }
  write_pigment(w, s->colour[s->line[first][1]]);
  fs_writer_text(w, " }\n");
}

static void write_strokes(fs_writer *w, const char *name, const fs_strokes *s) {
  for (int32_t i = 0, n; i < s->n_lines; i += n) {
    n = 1;
    while (n < SWEEP && i + n < s->n_lines && s->line[i + n][0] == s->line[i + n - 1][1]) n++;
    write_sweep(w, name, s, i, n);
  }
}

static void write_fill(fs_writer *w, const fs_curves *curves, double lift) {
  fs_writer_text(w, "mesh {\n");
  for (int32_t i = 0; i < curves->n_fill; i++)
    for (int side = -1; side <= 1; side += 2) {
      fs_writer_text(w, "triangle { ");
      for (int k = 0; k < 3; k++) {
        fs_povray_vector(w, fs_vec3_add_scaled(curves->fill[i][0][k], curves->fill[i][1][k], side * lift), 10);
        fs_writer_text(w, k < 2 ? "," : " }\n");
      }
    }
  fs_writer_text(w, "pigment { rgb 0.02 } }\n");
}

fs_status fs_povray_write_curves(fs_context *ctx, const fs_povray_model *model, const fs_output *output) {
  const fs_curves *curves = model->model->curves;
  const char *name = model->name;
  double diagonal = fs_vec3_distance(model->min, model->max);
  fs_strokes *strokes = NULL;
  fs_writer writer, *w = &writer;
  fs_status status = FS_OK;
  FS_TRY(fs_strokes_create(ctx, curves, 3e-3 * diagonal, 0.01 * diagonal, &strokes));
  fs_writer_start(w, ctx, output, "curves.inc");
  fs_writer_printf(w, "// curves on %s: object { %s_Curves }; %s_Width is the radius of their tubes\n", name, name,
                   name);
  fs_writer_printf(w, "#ifndef (%s_Width) #declare %s_Width = ", name, name);
  fs_povray_number(w, 1.2e-3 * diagonal, 4);
  fs_writer_printf(w, "; #end\n#declare %s_Curves = union {\n", name);
  /* a union needs something */
  if (strokes->n_lines == 0 && curves->n_fill == 0) fs_writer_printf(w, "sphere { %s_Min, 0 }\n", name);
  write_strokes(w, name, strokes);
  if (curves->n_fill > 0) write_fill(w, curves, 3e-4 * diagonal);
  fs_writer_text(w, "no_shadow }\n");
  status = fs_writer_finish(w);
done:
  fs_strokes_free(ctx, strokes);
  return status;
}
