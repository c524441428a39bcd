/* SPDX-License-Identifier: MIT */
/* Single role: the largest jumps of a whole surface: all edges roughly, those that may be the worst again and precisely, and
   all pairs of corners at vertices. */
#include "analyse/analyse.h"
#include "math/vec3.h"

#include <stdlib.h>

enum { N_WORST = 10, MAX_WORST = 10000 };
static const double rough = 1e-2, precise = 1e-6, flat = 1e-4;

typedef struct job {
  const fs_surface *surface;
  const fs_edges *edges;
  fs_continuity *result;
  double *curvature;  /* [n_edges + n_vertices] largest there */
  uint8_t *irregular; /* the same; 1: a point without a normal, 2: nothing finite */
} job;

typedef struct edge_line {
  const fs_surface *surface;
  const fs_edge *edge;
} edge_line;

static void evaluate_line(void *user, double t, fs_vec3 *x, fs_vec3 *y) {
  const edge_line *line = user;
  fs_edge_point point;
  fs_edge_evaluate(line->surface, line->edge, t, &point);
  for (int k = 0; k < FS_JET_SIZE; k++) x[k] = point.jet[0][k], y[k] = point.jet[1][k];
}

static int32_t degree_along(const job *j, int32_t e) {
  int32_t degree = 0;
  for (int k = 0; k < 2; k++) {
    const fs_patch *patch = &j->surface->patch[j->edges->edge[e].patch[k]];
    degree = patch->degree_u > degree ? patch->degree_u : degree;
    degree = patch->degree_v > degree ? patch->degree_v : degree;
  }
  return degree;
}

static void search_edge(const job *j, int32_t e, double precision, fs_line_jumps *jumps) {
  edge_line line = {j->surface, &j->edges->edge[e]};
  int32_t n_start = precision == rough && degree_along(j, e) <= 3 ? 5 : degree_along(j, e) <= 9 ? 9 : 17;
  fs_line_largest(&(fs_line){evaluate_line, &line, line.edge->is_flipped, n_start}, precision, jumps);
}

static fs_status measure_edges(void *user, int32_t begin, int32_t end, int32_t worker) {
  job *j = user;
  (void)worker;
  for (int32_t e = begin; e < end; e++) {
    fs_line_jumps jumps;
    search_edge(j, e, rough, &jumps);
    for (int k = 0; k < FS_N_JUMPS; k++) j->result->edge[e][k] = jumps.value[k];
    j->curvature[e] = jumps.largest_curvature;
    j->irregular[e] = isnan(jumps.value[FS_JUMP_POSITION]) ? 2 : jumps.n_irregular > 0;
  }
  return FS_OK;
}

/* ---- vertices ---- */

/* Patches that see the same vertex in opposite ways are compared with the better of both signs. */
static void compare_places(const fs_vec3 *x, const fs_vec3 *y, double *jump, double *curvature) {
  double flipped[FS_N_JUMPS];
  fs_jumps_between(x, y, false, jump, curvature);
  if (!(jump[FS_JUMP_NORMAL] > 1.5707963267948966)) return;
  fs_jumps_between(x, y, true, flipped, curvature);
  for (int k = 0; k < FS_N_JUMPS; k++) jump[k] = flipped[k];
}

static void measure_vertex(job *j, int32_t v) {
  enum { ALL_PAIRS = 64 }; /* up to so many places; beyond, all with the first */
  const fs_edges *e = j->edges;
  const int32_t first = e->place_start[v], n = e->place_start[v + 1] - first;
  double *most = j->result->vertex[v];
  for (int k = 0; k < FS_N_JUMPS; k++) most[k] = NAN;
  fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
  for (int32_t a = 0; a < (n <= ALL_PAIRS ? n : 1); a++) {
    const fs_place *p = &e->place[first + a];
    fs_surface_evaluate(j->surface, p->patch, p->u, p->v, x);
    for (int32_t b = a + 1; b < n; b++) {
      const fs_place *q = &e->place[first + b];
      double jump[FS_N_JUMPS], curvature;
      fs_surface_evaluate(j->surface, q->patch, q->u, q->v, y);
      compare_places(x, y, jump, &curvature);
      for (int k = 0; k < FS_N_JUMPS; k++) most[k] = fmax(most[k], jump[k]);
      j->curvature[e->n_edges + v] = fmax(j->curvature[e->n_edges + v], curvature);
      if (isnan(jump[FS_JUMP_NORMAL])) j->irregular[e->n_edges + v] = 1;
      if (isnan(jump[FS_JUMP_POSITION])) j->irregular[e->n_edges + v] = 2;
    }
  }
}

static fs_status measure_vertices(void *user, int32_t begin, int32_t end, int32_t worker) {
  (void)worker;
  for (int32_t v = begin; v < end; v++) measure_vertex(user, v);
  return FS_OK;
}

/* ---- lists ---- */

/* Numbers below n_edges are edges, then vertices. */
typedef struct ranked {
  double value;
  int32_t number;
} ranked;

static int compare_ranked(const void *a, const void *b) {
  const ranked *p = a, *q = b;
  if (p->value != q->value) return p->value > q->value ? -1 : 1;
  return p->number < q->number ? -1 : p->number > q->number;
}

/* The place of the largest jump k of an edge, and all jumps there; its rough values become precise. */
static void detail_edge(const job *j, int32_t e, int k, double precision, fs_worst *w) {
  fs_line_jumps jumps;
  fs_edge_point point;
  double curvature;
  search_edge(j, e, precision, &jumps);
  for (int i = 0; i < FS_N_JUMPS; i++) j->result->edge[e][i] = fmax(j->result->edge[e][i], jumps.value[i]);
  *w = (fs_worst){.edge = e, .vertex = FS_NONE, .t = jumps.t[k]};
  fs_edge_evaluate(j->surface, &j->edges->edge[e], w->t, &point);
  w->point = point.jet[0][FS_D];
  fs_jumps_between(point.jet[0], point.jet[1], j->edges->edge[e].is_flipped, w->jump, &curvature);
}

static void detail_vertex(const job *j, int32_t v, fs_worst *w) {
  const fs_place *p = &j->edges->place[j->edges->place_start[v]];
  fs_vec3 x[FS_JET_SIZE];
  *w = (fs_worst){.edge = FS_NONE, .vertex = v};
  fs_surface_evaluate(j->surface, p->patch, p->u, p->v, x);
  w->point = x[FS_D];
  for (int k = 0; k < FS_N_JUMPS; k++) w->jump[k] = j->result->vertex[v][k];
}

/* Vertices whose jump is larger than on all their edges, and all edges that have it. room: [n_edges + n_vertices] */
static int32_t rank(const job *j, int k, double *on_edges, ranked *room) {
  const fs_edges *e = j->edges;
  int32_t n = 0;
  for (int32_t v = 0; v < e->n_vertices; v++) on_edges[v] = 0;
  for (int32_t i = 0; i < e->n_edges; i++) {
    double value = j->result->edge[i][k];
    if (isnan(value)) continue;
    room[n++] = (ranked){value, i};
    for (int end = 0; end < 2; end++) on_edges[e->edge[i].vertex[end]] = fmax(on_edges[e->edge[i].vertex[end]], value);
  }
  for (int32_t v = 0; v < e->n_vertices; v++)
    if (j->result->vertex[v][k] > on_edges[v] * (1 + 1e-9))
      room[n++] = (ranked){j->result->vertex[v][k], e->n_edges + v};
  if (n > 1) qsort(room, (size_t)n, sizeof *room, compare_ranked);
  return n;
}

static fs_status list_worst(fs_context *ctx, const job *j, int k, int32_t n_wanted, double precision, double *on_edges,
                            ranked *room) {
  fs_continuity *result = j->result;
  fs_worst *candidate = NULL;
  int32_t n_all = rank(j, k, on_edges, room), n = n_all < n_wanted ? n_all : n_wanted, n_candidates = n;
  fs_status status = FS_OK;
  /* rough values may be too small by the part rough */
  while (n > 0 && n_candidates < n_all && n_candidates < 2 * n_wanted + 10 &&
         room[n_candidates].value * (1 + 2 * rough) >= room[n - 1].value)
    n_candidates++;
  FS_ALLOC(ctx, candidate, n_candidates);
  FS_ALLOC(ctx, result->worst[k], n);
  for (int32_t i = 0; i < n_candidates; i++) {
    if (room[i].number < j->edges->n_edges)
      detail_edge(j, room[i].number, k, precision, &candidate[i]);
    else
      detail_vertex(j, room[i].number - j->edges->n_edges, &candidate[i]);
    room[i] = (ranked){candidate[i].jump[k], i};
  }
  if (n_candidates > 1) qsort(room, (size_t)n_candidates, sizeof *room, compare_ranked);
  for (int32_t i = 0; i < n; i++) result->worst[k][i] = candidate[room[i].number];
  result->n_worst[k] = n;
done:
  fs_release(ctx, candidate);
  return status;
}

/* ---- all of it ---- */

static fs_status check_finite(fs_context *ctx, const job *j) {
  for (int32_t i = 0; i < j->edges->n_edges; i++)
    if (j->irregular[i] == 2)
      return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d or patch %d has points that are not finite",
                     (int)j->edges->edge[i].patch[0], (int)j->edges->edge[i].patch[1]);
  return FS_OK;
}

static void find_scales(const job *j, const fs_continuity_options *o) {
  fs_continuity *r = j->result;
  fs_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY}, x[FS_JET_SIZE];
  r->diameter = o->diameter;
  for (int32_t v = 0; v < j->edges->n_vertices && !(o->diameter > 0); v++) {
    const fs_place *p = &j->edges->place[j->edges->place_start[v]];
    fs_surface_evaluate(j->surface, p->patch, p->u, p->v, x);
    low = fs_vec3_min(low, x[FS_D]), high = fs_vec3_max(high, x[FS_D]);
    r->diameter = fs_vec3_distance(low, high);
  }
  r->curvature_scale = o->curvature_scale;
  for (int32_t i = 0; i < j->edges->n_edges + j->edges->n_vertices && !(o->curvature_scale > 0); i++)
    r->curvature_scale = fmax(r->curvature_scale, j->curvature[i]);
  if (r->diameter > 0) r->curvature_scale = fmax(r->curvature_scale, flat / r->diameter);
}

/* Curvatures become relative; the histogram and the largest values. */
static void summarise(const job *j) {
  fs_continuity *r = j->result;
  const double scale = r->curvature_scale > 0 ? 1 / r->curvature_scale : 1;
  for (int k = 0; k < FS_N_JUMPS; k++) {
    r->max[k] = NAN;
    for (int32_t i = 0; i < r->n_worst[k]; i++) r->worst[k][i].jump[FS_JUMP_CURVATURE] *= scale;
  }
  for (int32_t i = 0; i < j->edges->n_edges; i++) {
    r->edge[i][FS_JUMP_CURVATURE] *= scale;
    for (int k = 0; k < FS_N_JUMPS; k++) {
      double value = r->edge[i][k];
      if (isnan(value)) continue;
      int32_t decade = value > 0 ? (int32_t)floor(log10(value)) + 18 : 0;
      r->histogram[k][decade < 0 ? 0 : decade < FS_N_DECADES ? decade : FS_N_DECADES - 1]++;
      r->max[k] = fmax(r->max[k], value);
    }
  }
  for (int32_t v = 0; v < j->edges->n_vertices; v++) {
    r->vertex[v][FS_JUMP_CURVATURE] *= scale;
    for (int k = 0; k < FS_N_JUMPS; k++) r->max[k] = fmax(r->max[k], r->vertex[v][k]);
  }
  for (int32_t i = 0; i < j->edges->n_edges + j->edges->n_vertices; i++) r->n_irregular += j->irregular[i] == 1;
}

static fs_status measure_parts(fs_context *ctx, job *j) {
  /* in parts, so that the caller sees progress and may cancel */
  enum { PART = 8192 };
  const fs_edges *e = j->edges;
  fs_status status = FS_OK;
  for (int32_t from = 0; from < e->n_edges; from += PART) {
    job part = *j;
    fs_edges shifted = *e;
    fs_continuity result = *j->result;
    shifted.edge += from, result.edge += from;
    part.edges = &shifted, part.result = &result, part.curvature += from, part.irregular += from;
    FS_TRY(fs_progress(ctx, "continuity", (double)from / e->n_edges));
    FS_TRY(fs_parallel_for(ctx, e->n_edges - from < PART ? e->n_edges - from : PART, measure_edges, &part));
  }
  FS_TRY(fs_parallel_for(ctx, e->n_vertices, measure_vertices, j));
done:
  return status;
}

fs_status fs_continuity_measure(fs_context *ctx, const fs_surface *surface, const fs_edges *edges,
                                const fs_continuity_options *options, fs_continuity **continuity) {
  const fs_continuity_options o = options != NULL ? *options : (fs_continuity_options){0};
  const int32_t n_wanted = o.n_worst == 0 ? N_WORST : o.n_worst;
  const size_t n_all = (size_t)edges->n_edges + (size_t)edges->n_vertices;
  job j = {.surface = surface, .edges = edges};
  double *on_edges = NULL;
  ranked *room = NULL;
  fs_status status = FS_OK;
  if (n_wanted < 0 || n_wanted > MAX_WORST)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a list of %d worst edges is not between 1 and %d", (int)n_wanted, MAX_WORST);
  FS_ALLOC(ctx, j.result, 1);
  FS_ALLOC(ctx, j.result->edge, edges->n_edges);
  FS_ALLOC(ctx, j.result->vertex, edges->n_vertices);
  FS_ALLOC(ctx, j.curvature, n_all);
  FS_ALLOC(ctx, j.irregular, n_all);
  FS_ALLOC(ctx, on_edges, edges->n_vertices);
  FS_ALLOC(ctx, room, n_all);
  FS_TRY(measure_parts(ctx, &j));
  FS_TRY(check_finite(ctx, &j));
  find_scales(&j, &o);
  for (int k = 0; k < FS_N_JUMPS; k++)
    FS_TRY(list_worst(ctx, &j, k, n_wanted, o.precision > 0 ? o.precision : precise, on_edges, room));
  summarise(&j);
  *continuity = j.result;
  j.result = NULL;
done:
  fs_continuity_free(ctx, j.result);
  fs_release(ctx, j.curvature);
  fs_release(ctx, j.irregular);
  fs_release(ctx, on_edges);
  fs_release(ctx, room);
  return status;
}

void fs_continuity_free(fs_context *ctx, fs_continuity *continuity) {
  if (continuity == NULL) return;
  for (int k = 0; k < FS_N_JUMPS; k++) fs_release(ctx, continuity->worst[k]);
  fs_release(ctx, continuity->edge);
  fs_release(ctx, continuity->vertex);
  fs_release(ctx, continuity);
}

bool fs_continuity_passes(const fs_continuity *c, int32_t order, double tolerance) {
  const double k = c->curvature_scale > 0 ? c->curvature_scale : 1;
  const double relative[FS_N_JUMPS] = {
      c->diameter > 0 ? c->max[FS_JUMP_POSITION] / c->diameter : c->max[FS_JUMP_POSITION], c->max[FS_JUMP_NORMAL],
      c->max[FS_JUMP_CURVATURE], c->max[FS_JUMP_GRADIENT] / (k * k)};
  if (order > 0 && c->n_irregular > 0) return false;
  for (int32_t i = 0; i <= order && i < FS_N_JUMPS; i++)
    if (relative[i] > tolerance) return false; /* NAN: nothing was to be compared */
  return true;
}
