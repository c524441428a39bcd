/* SPDX-License-Identifier: MIT */
/* Single role: lines of curvature that cover a surface evenly.

   A line is followed both ways from a seed until it meets a border or an umbilic, closes, or comes closer than half the
   spacing to another line of its family or to itself. New seeds lie one spacing beside each line, reached along the other family, and
   count when no line is nearer than 0.9 of the spacing [after Jobard and Lefer 1997]. The first seeds are the middles of
   patches. Nearness is looked up in a hash of cells with the size of the spacing; points whose normals differ by more than a
   right angle are other sheets of the surface. */
#include "analyse/walk.h"
#include "math/vec3.h"

#include <string.h>

typedef struct sample {
  fs_vec3 position, normal;
  int32_t line, next; /* next sample of the hash chain, or FS_NONE */
} sample;

typedef struct cover {
  fs_context *ctx;
  const fs_surface *surface;
  fs_curve_list *list;
  double spacing, tolerance;
  int32_t family, n_lines;
  int32_t n_samples, sample_room, n_seeds, seed_room, *head; /* head[n_heads] */
  sample *sample;
  fs_place *seed;
  fs_curve_point *way[2]; /* points of the line at work, forwards and backwards */
  int32_t n_way[2], way_room[2];
} cover;

enum { N_HEADS = 1 << 14, MAX_STEPS = 20000 };

static int32_t hash_of(int64_t x, int64_t y, int64_t z) {
  uint64_t h = (uint64_t)x * 73856093u ^ (uint64_t)y * 19349663u ^ (uint64_t)z * 83492791u;
  return (int32_t)(h & (N_HEADS - 1));
}

static fs_status grow(fs_context *ctx, void **block, int32_t n, int32_t *room, size_t size) {
  void *larger;
  if (n < *room) return FS_OK;
  larger = fs_allocate(ctx, 2 * (size_t)n + 64, size);
  if (larger == NULL) return FS_ERR_MEMORY;
  if (n > 0) memcpy(larger, *block, (size_t)n * size);
  fs_release(ctx, *block);
  *block = larger;
  *room = 2 * n + 64;
  return FS_OK;
}

/* Whether a sample of another line is within reach. */
static bool is_near(const cover *c, fs_vec3 p, fs_vec3 normal, double reach, int32_t line) {
  int64_t x = (int64_t)floor(p.x / c->spacing), y = (int64_t)floor(p.y / c->spacing),
          z = (int64_t)floor(p.z / c->spacing);
  for (int64_t k = -1; k <= 1; k++)
    for (int64_t j = -1; j <= 1; j++)
      for (int64_t i = -1; i <= 1; i++)
        for (int32_t s = c->head[hash_of(x + i, y + j, z + k)]; s != FS_NONE; s = c->sample[s].next) {
          const sample *other = &c->sample[s];
          if (other->line != line && fs_vec3_distance(other->position, p) < reach &&
              fs_vec3_dot(other->normal, normal) > 0)
            return true;
        }
  return false;
}

static fs_status add_sample(cover *c, const fs_curve_point *p, int32_t line) {
  void *block = c->sample;
  fs_status status = grow(c->ctx, &block, c->n_samples, &c->sample_room, sizeof *c->sample);
  int32_t h = hash_of((int64_t)floor(p->position.x / c->spacing), (int64_t)floor(p->position.y / c->spacing),
                      (int64_t)floor(p->position.z / c->spacing));
  c->sample = block;
  if (status != FS_OK) return status;
  c->sample[c->n_samples] = (sample){.position = p->position, .normal = p->normal, .line = line, .next = c->head[h]};
  c->head[h] = c->n_samples++;
  return FS_OK;
}

static fs_status add_seed(cover *c, fs_place place) {
  void *block = c->seed;
  fs_status status = grow(c->ctx, &block, c->n_seeds, &c->seed_room, sizeof *c->seed);
  c->seed = block;
  if (status == FS_OK) c->seed[c->n_seeds++] = place;
  return status;
}

static fs_status add_way(cover *c, int side, const fs_walker *w) {
  void *block = c->way[side];
  fs_status status = grow(c->ctx, &block, c->n_way[side], &c->way_room[side], sizeof *c->way[side]);
  c->way[side] = block;
  if (status == FS_OK)
    c->way[side][c->n_way[side]++] = (fs_curve_point){.position = w->position, .normal = w->normal, .place = w->place};
  return status;
}

/* A point that the walker has just passed; those before it are left for the line to close. */
static bool is_beside(const cover *c, const fs_walker *w, const fs_curve_point *p) {
  fs_vec3 d = fs_vec3_sub(p->position, w->position);
  double along = fs_vec3_dot(d, w->direction), square = fs_vec3_dot(d, d);
  return square < 0.25 * c->spacing * c->spacing && along <= 0 && along > -0.25 * c->spacing &&
         fs_vec3_dot(p->normal, w->normal) > 0;
}

/* Whether a line has wound around and runs beside itself; arc: of this way so far. Its last three spacings do not count. */
static bool is_spiral(const cover *c, const fs_walker *w, int side, double arc) {
  double since = 0;
  for (int32_t i = c->n_way[side] - 1; i > 0; i--) {
    since += fs_vec3_distance(c->way[side][i].position, c->way[side][i - 1].position);
    if (since > 3 * c->spacing && is_beside(c, w, &c->way[side][i - 1])) return true;
  }
  since = arc;
  for (int32_t i = 1; side == 1 && i < c->n_way[0]; i++) {
    since += fs_vec3_distance(c->way[0][i].position, c->way[0][i - 1].position);
    if (since > 3 * c->spacing && is_beside(c, w, &c->way[0][i])) return true;
  }
  return false;
}

/* One of the two ways from the seed. is_closed: it came back to the seed. */
static fs_status walk_way(cover *c, const fs_walker *seed, int side, bool *is_closed) {
  fs_status status = FS_OK;
  fs_walker w = *seed;
  double length = 0.1 * c->spacing, arc = 0;
  *is_closed = false;
  c->n_way[side] = 0;
  if (side == 1) w.direction = fs_vec3_scale(w.direction, -1);
  for (int32_t k = 0; k < MAX_STEPS; k++) {
    double done = 0;
    fs_vec3 before = w.position;
    length = fmin(length, 0.25 * c->spacing);
    fs_walk_end end = fs_walker_step(&w, &length, &done);
    arc += done;
    if (end == FS_WALK_UMBILIC) break;
    if (is_near(c, w.position, w.normal, 0.5 * c->spacing, c->n_lines)) break;
    fs_vec3 step = fs_vec3_sub(w.position, before), back = fs_vec3_sub(seed->position, before);
    double along = fs_vec3_dot(step, back), square = fs_vec3_dot(step, step);
    if (arc > 2 * c->spacing && along >= 0 && along <= square && square > 0 &&
        fs_vec3_distance(fs_vec3_scale(step, along / square), back) < 0.02 * c->spacing) {
      *is_closed = true;
      break;
    }
    if (is_spiral(c, &w, side, arc)) break;
    FS_TRY(add_way(c, side, &w));
    if (end == FS_WALK_BORDER) break;
  }
done:
  return status;
}

/* Seeds beside a point of a line, on both sides. */
static fs_status seed_beside(cover *c, const fs_curve_point *p) {
  fs_status status = FS_OK;
  for (int side = 0; side < 2; side++) {
    fs_walker w = {.surface = c->surface, .family = 1 - c->family, .tolerance = c->tolerance};
    double length = 0.1 * c->spacing, left = c->spacing;
    fs_walk_end end = FS_WALK_GOES_ON;
    if (!fs_walker_start(&w, p->place, (fs_vec3){0})) return FS_OK;
    if (side == 1) w.direction = fs_vec3_scale(w.direction, -1);
    while (left > 1e-3 * c->spacing && end == FS_WALK_GOES_ON) {
      double done = 0;
      length = fmin(length, left);
      end = fs_walker_step(&w, &length, &done);
      left -= done;
    }
    if (end == FS_WALK_GOES_ON) FS_TRY(add_seed(c, w.place));
  }
done:
  return status;
}

static fs_status keep_line(cover *c, const fs_walker *seed, bool is_closed) {
  fs_status status = FS_OK;
  fs_curve_point at = {.position = seed->position, .normal = seed->normal, .place = seed->place};
  double since = 0;
  int32_t first;
  if (c->n_way[0] + c->n_way[1] < 2) return FS_OK;
  FS_TRY(fs_curve_list_begin(c->ctx, c->list, 0));
  for (int32_t i = c->n_way[1] - 1; i >= 0; i--) FS_TRY(fs_curve_list_add(c->ctx, c->list, &c->way[1][i]));
  FS_TRY(fs_curve_list_add(c->ctx, c->list, &at));
  for (int32_t i = 0; i < c->n_way[0]; i++) FS_TRY(fs_curve_list_add(c->ctx, c->list, &c->way[0][i]));
  if (is_closed) FS_TRY(fs_curve_list_add(c->ctx, c->list, &at));
  first = c->list->curves->curve[c->list->curves->n_curves - 1].first;
  fs_curve_list_end(c->list, is_closed);
  for (int32_t i = first; i < c->list->curves->n_points; i++) {
    const fs_curve_point p = c->list->curves->point[i];
    FS_TRY(add_sample(c, &p, c->n_lines));
    if (i > first) since += fs_vec3_distance(p.position, c->list->curves->point[i - 1].position);
    if (since >= c->spacing || i == first) {
      FS_TRY(seed_beside(c, &p));
      since = 0;
    }
  }
  c->n_lines++;
done:
  return status;
}

static fs_status try_seed(cover *c, fs_place place) {
  fs_status status = FS_OK;
  fs_walker seed = {.surface = c->surface, .family = c->family, .tolerance = c->tolerance};
  bool is_closed = false;
  if (!fs_walker_start(&seed, place, (fs_vec3){0})) return FS_OK;
  if (is_near(c, seed.position, seed.normal, 0.9 * c->spacing, FS_NONE)) return FS_OK;
  c->n_way[1] = 0;
  FS_TRY(walk_way(c, &seed, 0, &is_closed));
  if (!is_closed) {
    bool unused;
    FS_TRY(walk_way(c, &seed, 1, &unused));
  }
  FS_TRY(keep_line(c, &seed, is_closed));
done:
  return status;
}

static fs_status cover_family(cover *c) {
  fs_status status = FS_OK;
  int32_t n_patches = c->surface->n_patches;
  c->n_samples = c->n_seeds = c->n_lines = 0;
  for (int32_t i = 0; i < N_HEADS; i++) c->head[i] = FS_NONE;
  for (int32_t p = 0; p < n_patches; p++) {
    FS_TRY(fs_progress(c->ctx, "curvature lines", (double)p / n_patches));
    FS_TRY(try_seed(c, (fs_place){p, 0.5, 0.5}));
    while (c->n_seeds > 0) {
      fs_place place = c->seed[--c->n_seeds];
      FS_TRY(try_seed(c, place));
    }
  }
done:
  return status;
}

fs_status fs_trace_curvature_lines(fs_context *ctx, const fs_surface *surface, int32_t which, double spacing,
                                   const fs_trace_options *options, fs_curves **curves) {
  fs_status status = FS_OK;
  fs_trace_options o = fs_trace_options_complete(surface, options);
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  double diagonal = fs_surface_diagonal(surface, NULL);
  cover c = {
      .ctx = ctx, .list = &list, .spacing = spacing > 0 ? spacing : diagonal / 30, .tolerance = o.tolerance / 10};
  FS_TRY(fs_surface_to_quads(ctx, surface, &quads));
  c.surface = quads;
  FS_TRY(fs_curve_list_start(ctx, &list));
  FS_ALLOC(ctx, c.head, N_HEADS);
  for (c.family = 0; c.family < 2 && diagonal > 0; c.family++)
    if (which == 0 || which == c.family + 1) FS_TRY(cover_family(&c));
  FS_TRY(fs_umbilics_append(ctx, quads, o.n_cells, diagonal, &list));
  *curves = list.curves;
  list.curves = NULL;
done:
  fs_curves_free(ctx, list.curves);
  fs_surface_free(ctx, quads);
  fs_release(ctx, c.head);
  fs_release(ctx, c.sample);
  fs_release(ctx, c.seed);
  fs_release(ctx, c.way[0]);
  fs_release(ctx, c.way[1]);
  return status;
}

static const char *const families[] = {"both", "larger", "smaller", NULL};
static const fs_param params[] = {{.name = "family",
                                   .summary = "lines of the larger or the smaller principal curvature",
                                   .max = 2,
                                   .choices = families},
                                  {.name = "spacing",
                                   .summary = "distance of lines in diagonals of the surface",
                                   .initial = 0.03,
                                   .min = 0.001,
                                   .max = 1},
                                  {0}};

static fs_status trace(fs_context *ctx, const fs_surface *surface, const double *param, const fs_trace_options *options,
                       fs_curves **curves) {
  return fs_trace_curvature_lines(ctx, surface, (int32_t)param[0], param[1] * fs_surface_diagonal(surface, NULL),
                                  options, curves);
}

const fs_plot fs_plot_curvature_lines = {"curvature-lines", "lines of principal curvature, and umbilics", params,
                                         trace};
