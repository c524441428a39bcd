/* SPDX-License-Identifier: MIT */
/* Single role: curves along which a field on a surface has one value.

   Every patch is cut into n x n cells. The field at their corners says through which sides of cells curves pass; where, is
   found on the side by bracketing, to rounding; within a cell with four such points the value at its middle decides which
   two belong together. Between two points of a cell further ones are put, moved onto the curve by Newton steps along the
   gradient, until the chords stay within the tolerance. At shared sides both patches find the same points. */
#include "analyse/curves.h"
#include "math/vec3.h"

enum { MAX_DEPTH = 10, NEWTON_STEPS = 30 };

/* Where a curve crosses a side of a cell. */
typedef struct crossing {
  int32_t patch;
  double u, v;
  int32_t segment[2]; /* that end in it, or FS_NONE */
  int32_t twin;       /* the same point on the neighbour, or FS_NONE */
  bool is_passed;
} crossing;

/* Sides of cells of a patch: side (i, j) along u from corner (i, j) is number i + n j, j = 0 .. n; along v
   n (n + 1) + i + (n + 1) j, i = 0 .. n. */
typedef struct grid {
  fs_context *ctx;
  const fs_surface *surface;
  const fs_field *field;
  double level, tolerance;
  int32_t n, n_crossings, n_segments, segment_room;
  const double *values;        /* of all patches, or NULL */
  double *value;               /* [(n + 1)^2] of the patch at work, less the level */
  int32_t *at;                 /* [n_patches][2 n (n + 1)] crossing on that side, or FS_NONE */
  crossing *crossing;          /* [room] */
  int32_t room, (*segment)[2]; /* [n_segments] crossings at its ends */
} grid;

static int32_t along_u(const grid *g, int32_t i, int32_t j) { return i + g->n * j; }
static int32_t along_v(const grid *g, int32_t i, int32_t j) { return g->n * (g->n + 1) + i + (g->n + 1) * j; }
static int32_t *at(const grid *g, int32_t patch, int32_t side) {
  return &g->at[(size_t)patch * (size_t)(2 * g->n * (g->n + 1)) + (size_t)side];
}

static double value_at(const grid *g, int32_t patch, double u, double v) {
  return fs_field_at(g->surface, g->field, patch, u, v) - g->level;
}

/* ---- crossings --------------------------------------------------------------------------------------------------- */

static fs_status add_crossing(grid *g, int32_t patch, int32_t side, double u, double v) {
  fs_status status = FS_OK;
  crossing *larger = NULL;
  if (g->n_crossings == g->room) {
    FS_ALLOC(g->ctx, larger, 2 * (size_t)g->room + 64);
    for (int32_t i = 0; i < g->n_crossings; i++) larger[i] = g->crossing[i];
    fs_release(g->ctx, g->crossing);
    g->crossing = larger;
    g->room = 2 * g->room + 64;
  }
  g->crossing[g->n_crossings] =
      (crossing){.patch = patch, .u = u, .v = v, .segment = {FS_NONE, FS_NONE}, .twin = FS_NONE};
  *at(g, patch, side) = g->n_crossings++;
done:
  return status;
}

/* The zero between two points with values of opposite sign, by regula falsi of the Illinois kind with bisections. */
static double find_zero(const grid *g, int32_t patch, const double *a, const double *b, double fa, double fb) {
  double s = 0, t = 1, best = fabs(fa) < fabs(fb) ? 0 : 1, least = fmin(fabs(fa), fabs(fb));
  for (int k = 0; k < 100 && t - s > 1e-15 && least > 0; k++) {
    double r = k % 3 == 2 ? 0.5 * (s + t) : s + (t - s) * fa / (fa - fb), f;
    if (!(r > s && r < t)) r = 0.5 * (s + t);
    f = value_at(g, patch, a[0] + r * (b[0] - a[0]), a[1] + r * (b[1] - a[1]));
    if (!isfinite(f)) break;
    if (fabs(f) < least) least = fabs(f), best = r;
    if ((f >= 0) == (fa >= 0))
      s = r, fa = f;
    else
      t = r, fb = f;
  }
  return best;
}

static fs_status cross_side(grid *g, int32_t patch, int32_t side, int32_t i, int32_t j, int32_t di, int32_t dj) {
  double fa = g->value[i + (g->n + 1) * j], fb = g->value[i + di + (g->n + 1) * (j + dj)], t;
  const double a[2] = {(double)i / g->n, (double)j / g->n}, b[2] = {(double)(i + di) / g->n, (double)(j + dj) / g->n};
  *at(g, patch, side) = FS_NONE;
  if (!isfinite(fa) || !isfinite(fb) || (fa >= 0) == (fb >= 0)) return FS_OK;
  t = find_zero(g, patch, a, b, fa, fb);
  return add_crossing(g, patch, side, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]));
}

/* ---- segments ---------------------------------------------------------------------------------------------------- */

static fs_status add_segment(grid *g, int32_t a, int32_t b) {
  fs_status status = FS_OK;
  int32_t(*larger)[2] = NULL;
  if (g->n_segments == g->segment_room) {
    FS_ALLOC(g->ctx, larger, 2 * (size_t)g->segment_room + 64);
    for (int32_t i = 0; i < g->n_segments; i++) larger[i][0] = g->segment[i][0], larger[i][1] = g->segment[i][1];
    fs_release(g->ctx, g->segment);
    g->segment = larger;
    g->segment_room = 2 * g->segment_room + 64;
  }
  g->segment[g->n_segments][0] = a, g->segment[g->n_segments][1] = b;
  for (int k = 0; k < 2; k++) {
    crossing *c = &g->crossing[k == 0 ? a : b];
    c->segment[c->segment[0] == FS_NONE ? 0 : 1] = g->n_segments;
  }
  g->n_segments++;
done:
  return status;
}

static fs_status connect_cell(grid *g, int32_t patch, int32_t i, int32_t j) {
  const int32_t side[4] = {along_u(g, i, j), along_v(g, i + 1, j), along_u(g, i, j + 1), along_v(g, i, j)};
  int32_t found[4], n = 0;
  for (int s = 0; s < 4; s++)
    if (*at(g, patch, side[s]) != FS_NONE) found[n++] = *at(g, patch, side[s]);
  if (n == 2) return add_segment(g, found[0], found[1]);
  if (n != 4) return FS_OK; /* 0; or a corner without a value */
  /* the corner (i, j) and the middle are on the same side of the level: the curves cut off the two other corners */
  double middle = value_at(g, patch, (i + 0.5) / g->n, (j + 0.5) / g->n);
  bool is_joined = (middle >= 0) == (g->value[i + (g->n + 1) * j] >= 0);
  fs_status status = add_segment(g, found[0], found[is_joined ? 1 : 3]);
  return status == FS_OK ? add_segment(g, found[2], found[is_joined ? 3 : 1]) : status;
}

static fs_status search_patch(grid *g, int32_t patch) {
  fs_status status = FS_OK;
  int32_t n = g->n;
  const double *known = g->values != NULL ? g->values + (size_t)patch * (size_t)((n + 1) * (n + 1)) : NULL;
  for (int32_t k = 0; k < (n + 1) * (n + 1); k++) {
    double u = (double)(k % (n + 1)) / n, v = (double)(k / (n + 1)) / n;
    g->value[k] = known != NULL ? known[k] - g->level : value_at(g, patch, u, v);
  }
  for (int32_t j = 0; j <= n; j++)
    for (int32_t i = 0; i < n; i++) {
      FS_TRY(cross_side(g, patch, along_u(g, i, j), i, j, 1, 0));
      FS_TRY(cross_side(g, patch, along_v(g, j, i), j, i, 0, 1));
    }
  for (int32_t j = 0; j < n; j++)
    for (int32_t i = 0; i < n; i++) FS_TRY(connect_cell(g, patch, i, j));
done:
  return status;
}

/* Side of a cell at part k of side s of a patch, k counted along the side. */
static int32_t rim_side(const grid *g, int32_t s, int32_t k) {
  switch (s) {
  case 0:
    return along_u(g, k, 0);
  case 1:
    return along_v(g, g->n, k);
  case 2:
    return along_u(g, g->n - 1 - k, g->n);
  default:
    return along_v(g, 0, g->n - 1 - k);
  }
}

static fs_vec3 position_of(const grid *g, const crossing *c) {
  fs_vec3 x[FS_JET_SIZE];
  fs_surface_evaluate(g->surface, c->patch, c->u, c->v, x);
  return x[FS_D];
}

static void join_patches(grid *g) {
  for (int32_t p = 0; p < g->surface->n_patches; p++)
    for (int32_t s = 0; s < 4; s++) {
      const fs_patch *patch = &g->surface->patch[p];
      int32_t q = patch->neighbour[s], r = patch->neighbour_side[s];
      for (int32_t k = 0; q != FS_NONE && k < g->n; k++) {
        int32_t a = *at(g, p, rim_side(g, s, k)), b = *at(g, q, rim_side(g, r, g->n - 1 - k));
        if (a == FS_NONE || b == FS_NONE || a == b) continue;
        if (fs_vec3_distance(position_of(g, &g->crossing[a]), position_of(g, &g->crossing[b])) <= g->tolerance)
          g->crossing[a].twin = b, g->crossing[b].twin = a;
      }
    }
}

/* ---- points between crossings ------------------------------------------------------------------------------------ */

/* Moves (u, v) onto the curve along the gradient; false where that fails, or leaves a box around the start or the patch. */
static bool move_onto(const grid *g, int32_t patch, double reach, double *u, double *v) {
  double start[2] = {*u, *v}, f = value_at(g, patch, *u, *v), slope = 1;
  const double h = 1e-6;
  for (int k = 0; k < NEWTON_STEPS && f != 0; k++) {
    double du = (value_at(g, patch, *u + h, *v) - value_at(g, patch, *u - h, *v)) / (2 * h);
    double dv = (value_at(g, patch, *u, *v + h) - value_at(g, patch, *u, *v - h)) / (2 * h);
    double square = du * du + dv * dv, a, b, next;
    if (!(square > 0) || !isfinite(square)) return false;
    slope = sqrt(square);
    a = *u - f * du / square, b = *v - f * dv / square;
    if (fabs(a - start[0]) > reach || fabs(b - start[1]) > reach) return false;
    next = value_at(g, patch, a, b);
    if (!(fabs(next) < fabs(f))) break; /* rounding */
    *u = a, *v = b, f = next;
  }
  return fabs(f) <= 1e-11 * slope && *u >= 0 && *u <= 1 && *v >= 0 && *v <= 1;
}

static double deviation(fs_vec3 a, fs_vec3 b, fs_vec3 p) {
  fs_vec3 chord = fs_vec3_sub(b, a), d = fs_vec3_sub(p, a);
  double length = fs_vec3_length(chord);
  return length > 0 ? fs_vec3_length(fs_vec3_cross(chord, d)) / length : fs_vec3_length(d);
}

/* Adds the points strictly between two places of a patch, in order. */
static fs_status add_between(grid *g, fs_curve_list *list, const fs_curve_point *a, const fs_curve_point *b,
                             int depth) {
  fs_status status = FS_OK;
  double u = 0.5 * (a->place.u + b->place.u), v = 0.5 * (a->place.v + b->place.v);
  double reach = 0.51 * (fabs(a->place.u - b->place.u) + fabs(a->place.v - b->place.v));
  fs_curve_point middle;
  if (depth == MAX_DEPTH || !move_onto(g, a->place.patch, reach, &u, &v)) return FS_OK;
  middle = fs_curve_point_at(g->surface, a->place.patch, u, v);
  if (deviation(a->position, b->position, middle.position) <= g->tolerance && depth > 0) return FS_OK;
  FS_TRY(add_between(g, list, a, &middle, depth + 1));
  FS_TRY(fs_curve_list_add(g->ctx, list, &middle));
  FS_TRY(add_between(g, list, &middle, b, depth + 1));
done:
  return status;
}

/* ---- curves ------------------------------------------------------------------------------------------------------ */

/* Follows segments from crossing c, leaving it by segment s, to the end or around. */
static fs_status follow(grid *g, fs_curve_list *list, int32_t c, int32_t s, double label) {
  fs_status status = FS_OK;
  int32_t start = c;
  bool is_closed = false;
  fs_curve_point here = fs_curve_point_at(g->surface, g->crossing[c].patch, g->crossing[c].u, g->crossing[c].v);
  FS_TRY(fs_curve_list_begin(g->ctx, list, label));
  FS_TRY(fs_curve_list_add(g->ctx, list, &here));
  g->crossing[c].is_passed = true;
  while (s != FS_NONE) {
    int32_t next = g->segment[s][0] == c ? g->segment[s][1] : g->segment[s][0];
    crossing *there = &g->crossing[next];
    fs_curve_point point = fs_curve_point_at(g->surface, there->patch, there->u, there->v);
    FS_TRY(add_between(g, list, &here, &point, 0));
    FS_TRY(fs_curve_list_add(g->ctx, list, &point));
    there->is_passed = true;
    is_closed = next == start || there->twin == start;
    if (is_closed) break;
    if (there->twin != FS_NONE) { /* go on across the side of the patch */
      c = there->twin;
      if (g->crossing[c].is_passed) break;
      g->crossing[c].is_passed = true;
      s = g->crossing[c].segment[0];
      here = fs_curve_point_at(g->surface, g->crossing[c].patch, g->crossing[c].u, g->crossing[c].v);
    } else {
      int32_t back = s;
      c = next;
      s = there->segment[0] == back ? there->segment[1] : there->segment[0];
      here = point;
    }
  }
  fs_curve_list_end(list, is_closed);
done:
  return status;
}

static bool is_end(const grid *g, const crossing *c) {
  (void)g;
  return c->segment[0] != FS_NONE && c->segment[1] == FS_NONE && c->twin == FS_NONE;
}

/* Open curves from their ends, then what is left: closed ones. */
static fs_status follow_all(grid *g, fs_curve_list *list, double label) {
  fs_status status = FS_OK;
  for (int pass = 0; pass < 2; pass++)
    for (int32_t c = 0; c < g->n_crossings; c++) {
      const crossing *x = &g->crossing[c];
      if (x->is_passed || x->segment[0] == FS_NONE || (pass == 0 && !is_end(g, x))) continue;
      FS_TRY(follow(g, list, c, x->segment[0], label));
    }
done:
  return status;
}

fs_status fs_field_values(fs_context *ctx, const fs_surface *surface, const fs_field *field, int32_t n_cells,
                          double **values) {
  fs_status status = FS_OK;
  double *value = NULL;
  const int32_t n = n_cells, n_corners = (n + 1) * (n + 1);
  FS_ALLOC(ctx, value, (size_t)surface->n_patches * (size_t)n_corners);
  for (int32_t p = 0; p < surface->n_patches; p++) {
    for (int32_t k = 0; k < n_corners; k++)
      value[(size_t)p * (size_t)n_corners + (size_t)k] =
          fs_field_at(surface, field, p, (double)(k % (n + 1)) / n, (double)(k / (n + 1)) / n);
    FS_TRY(fs_progress(ctx, "evaluate", (double)p / surface->n_patches));
  }
  *values = value;
  value = NULL;
done:
  fs_release(ctx, value);
  return status;
}

fs_status fs_levels_append(fs_context *ctx, const fs_surface *surface, const fs_field *field, const double *values,
                           double level, double label, const fs_trace_options *options, fs_curve_list *list) {
  fs_status status = FS_OK;
  fs_trace_options o = fs_trace_options_complete(surface, options);
  int32_t n = o.n_cells;
  grid g = {.ctx = ctx,
            .surface = surface,
            .field = field,
            .values = values,
            .level = level,
            .tolerance = o.tolerance,
            .n = n};
  FS_ALLOC(ctx, g.value, (size_t)(n + 1) * (size_t)(n + 1));
  FS_ALLOC(ctx, g.at, (size_t)surface->n_patches * (size_t)(2 * n * (n + 1)));
  for (int32_t p = 0; p < surface->n_patches; p++) {
    FS_TRY(search_patch(&g, p));
    FS_TRY(fs_progress(ctx, "trace", (double)p / surface->n_patches));
  }
  join_patches(&g);
  FS_TRY(follow_all(&g, list, label));
done:
  fs_release(ctx, g.value);
  fs_release(ctx, g.at);
  fs_release(ctx, g.crossing);
  fs_release(ctx, g.segment);
  return status;
}

fs_status fs_trace_levels(fs_context *ctx, const fs_surface *surface, const fs_field *field, int32_t n_levels,
                          const double *level, const fs_trace_options *options, fs_curves **curves) {
  fs_status status = FS_OK;
  fs_surface *quads = NULL;
  fs_curve_list list = {0};
  double *values = NULL;
  FS_TRY(fs_surface_to_quads(ctx, surface, &quads));
  FS_TRY(fs_curve_list_start(ctx, &list));
  FS_TRY(fs_field_values(ctx, quads, field, fs_trace_options_complete(quads, options).n_cells, &values));
  for (int32_t i = 0; i < n_levels; i++)
    FS_TRY(fs_levels_append(ctx, quads, field, values, level[i], level[i], options, &list));
  *curves = list.curves;
  list.curves = NULL;
done:
  fs_release(ctx, values);
  fs_curves_free(ctx, list.curves);
  fs_surface_free(ctx, quads);
  return status;
}
