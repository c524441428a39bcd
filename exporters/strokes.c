/* SPDX-License-Identifier: MIT */
/* Single role: curves on a surface as coloured pieces of straight lines. */
#include "strokes.h"
#include "base/base.h"
#include "math/vec3.h"

const double fs_tooth_colour[3] = {0.55, 0.1, 0.1}, fs_mark_colour[3] = {0.8, 0.1, 0.1};

fs_stroke_colours fs_stroke_colours_of(const fs_curves *curves) {
  fs_stroke_colours c = {.low = INFINITY, .high = -INFINITY};
  if (curves == NULL) return c;
  c.is_graded = curves->is_graded;
  for (int32_t i = 0; i < curves->n_curves; i++) {
    c.low = fmin(c.low, curves->curve[i].level);
    c.high = fmax(c.high, curves->curve[i].level);
  }
  return c;
}

void fs_stroke_colour(const fs_stroke_colours *c, double level, double rgb[3]) {
  double t = c->high > c->low ? (level - c->low) / (c->high - c->low) : 0.5;
  const double plain[3] = {0.05, 0.15, 0.5};
  const double graded[3] = {fmin(0.85, 1.6 * t), 0.35 * (1 - fabs(2 * t - 1)), fmin(0.85, 1.6 * (1 - t))};
  for (int i = 0; i < 3; i++) rgb[i] = c->is_graded ? graded[i] : plain[i];
}

/* Adds a point, and a line to it from the one before where is_joined. There is room. */
static void add(fs_strokes *s, fs_vec3 position, fs_vec3 normal, double level, const double colour[3], bool is_joined) {
  int32_t n = s->n_points++;
  s->position[n] = position, s->normal[n] = normal, s->level[n] = level;
  for (int i = 0; i < 3; i++) s->colour[n][i] = colour[i];
  if (is_joined) s->line[s->n_lines][0] = n - 1, s->line[s->n_lines++][1] = n;
}

static void add_curve(fs_strokes *s, const fs_surface_curve *c, const fs_curve_point *p, double spacing,
                      const double colour[3]) {
  fs_vec3 last = p[0].position;
  for (int32_t i = 0; i < c->n_points; i++) {
    if (i > 0 && i < c->n_points - 1 && fs_vec3_distance(p[i].position, last) < spacing) continue;
    last = p[i].position;
    add(s, last, p[i].normal, c->level, colour, i > 0);
  }
}

static void add_comb(fs_strokes *s, const fs_surface_curve *c, const fs_curve_point *p, double spacing) {
  int32_t kept = 0;
  for (int pass = 0; pass < 2; pass++) /* the line along the tips, then teeth */
    for (int32_t i = 0; i < c->n_points; i++) {
      fs_vec3 tip = fs_vec3_add(p[i].position, p[i].tooth);
      if (i > 0 && i < c->n_points - 1 && fs_vec3_distance(p[i].position, p[kept].position) < spacing) continue;
      kept = i;
      if (pass == 1) add(s, p[i].position, p[i].normal, c->level, fs_tooth_colour, false);
      add(s, tip, p[i].normal, c->level, fs_tooth_colour, pass == 1 || i > 0);
    }
}

static void add_mark(fs_strokes *s, const fs_mark *mark, double size) {
  fs_vec3 n = mark->point.normal;
  fs_vec3 a = fs_vec3_cross(n, fabs(n.z) < 0.9 ? (fs_vec3){0, 0, 1} : (fs_vec3){1, 0, 0});
  double length = fs_vec3_length(a);
  if (!(length > 0)) return;
  a = fs_vec3_scale(a, size / length);
  fs_vec3 arm[2] = {a, fs_vec3_cross(n, a)};
  for (int k = 0; k < 2; k++)
    for (int end = -1; end <= 1; end += 2)
      add(s, fs_vec3_add_scaled(mark->point.position, arm[k], end), n, mark->index, fs_mark_colour, end > 0);
}

fs_status fs_strokes_create(fs_context *ctx, const fs_curves *curves, double spacing, double size,
                            fs_strokes **strokes) {
  fs_status status = FS_OK;
  fs_strokes *s = NULL;
  fs_stroke_colours colours = fs_stroke_colours_of(curves);
  /* at most, a point stands in its curve, at the foot and at the tip of its tooth, and in the line of tips */
  const size_t room = 4 * (size_t)curves->n_points + 4 * (size_t)curves->n_marks + 1;
  FS_ALLOC(ctx, s, 1);
  FS_ALLOC(ctx, s->position, room);
  FS_ALLOC(ctx, s->normal, room);
  FS_ALLOC(ctx, s->level, room);
  FS_ALLOC(ctx, s->colour, room);
  FS_ALLOC(ctx, s->line, room);
  for (int32_t i = 0; i < curves->n_curves; i++) {
    const fs_surface_curve *c = &curves->curve[i];
    const fs_curve_point *p = &curves->point[c->first];
    double rgb[3];
    fs_stroke_colour(&colours, c->level, rgb);
    add_curve(s, c, p, spacing, rgb);
    if (fs_vec3_length(p[c->n_points / 2].tooth) > 0) add_comb(s, c, p, 4 * spacing);
  }
  for (int32_t i = 0; i < curves->n_marks; i++) add_mark(s, &curves->mark[i], size);
  *strokes = s;
  s = NULL;
done:
  fs_strokes_free(ctx, s);
  return status;
}

double fs_strokes_extent(const fs_vec3 *position, int32_t n) {
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  for (int32_t v = 0; v < n; v++) low = fs_vec3_min(low, position[v]), high = fs_vec3_max(high, position[v]);
  return n > 0 ? fs_vec3_distance(low, high) : 0;
}

void fs_strokes_free(fs_context *ctx, fs_strokes *s) {
  if (s == NULL) return;
  fs_release(ctx, s->position);
  fs_release(ctx, s->normal);
  fs_release(ctx, s->level);
  fs_release(ctx, s->colour);
  fs_release(ctx, s->line);
  fs_release(ctx, s);
}
