/* SPDX-License-Identifier: MIT */
/* Single role: what check has found as JSON, 17 digits; what is no number is null. */
#include "check.h"

#include <math.h>

static void put(FILE *f, const char *name, double value, const char *end) {
  if (isfinite(value))
    fprintf(f, "\"%s\": %.17g%s", name, value, end);
  else
    fprintf(f, "\"%s\": null%s", name, end);
}

static void put_point(FILE *f, const char *name, fs_vec3 p, const char *end) {
  fprintf(f, "\"%s\": [%.17g, %.17g, %.17g]%s", name, p.x, p.y, p.z, end);
}

static void put_place(FILE *f, const char *name, const fs_surface *s, const fs_place *p, const char *end) {
  fs_vec3 x[FS_JET_SIZE];
  if (p->patch == FS_NONE) {
    fprintf(f, "\"%s\": null%s", name, end);
    return;
  }
  fs_surface_evaluate(s, p->patch, p->u, p->v, x);
  fprintf(f, "\"%s\": {\"patch\": %d, \"u\": %.17g, \"v\": %.17g, ", name, p->patch, p->u, p->v);
  put_point(f, "point", x[FS_D], "}");
  fprintf(f, "%s", end);
}

static void put_jumps(FILE *f, const char *name, const double *jump) {
  fprintf(f, "\"%s\": {", name);
  for (int k = 0; k < FS_N_JUMPS; k++) put(f, fs_jump_names[k], jump[k], k + 1 < FS_N_JUMPS ? ", " : "}");
}

static void put_number_or_null(FILE *f, const char *name, int32_t number) {
  if (number == FS_NONE)
    fprintf(f, "\"%s\": null, ", name);
  else
    fprintf(f, "\"%s\": %d, ", name, number);
}

static void put_worst(FILE *f, const check_result *r, int by, bool *is_first) {
  for (int32_t i = 0; i < r->continuity->n_worst[by]; i++) {
    const fs_worst *w = &r->continuity->worst[by][i];
    fprintf(f, "%s\n    {\"by\": \"%s\", ", *is_first ? "" : ",", fs_jump_names[by]);
    put_number_or_null(f, "edge", w->edge);
    put_number_or_null(f, "vertex", w->vertex);
    if (w->edge != FS_NONE) {
      const fs_edge *e = &r->edges->edge[w->edge];
      put(f, "parameter", w->t, ", ");
      fprintf(f, "\"patches\": [%d, %d], \"sides\": [%d, %d], ", e->patch[0], e->patch[1], e->side[0], e->side[1]);
    } else {
      fprintf(f, "\"parameter\": null, ");
    }
    put_point(f, "point", w->point, ", ");
    put_jumps(f, "values", w->jump);
    fprintf(f, "}");
    *is_first = false;
  }
}

/* Those of the required order come first. */
static void put_all_worst(FILE *f, const check_result *r) {
  bool is_first = true;
  fprintf(f, "  \"worst\": [");
  for (int k = 0; k < FS_N_JUMPS; k++) put_worst(f, r, (r->order + k) % FS_N_JUMPS, &is_first);
  fprintf(f, "\n  ],\n");
}

static void put_histograms(FILE *f, const fs_continuity *c) {
  fprintf(f, "  \"histogram\": {\"from\": \"1e-18\", \"step\": \"decade\"");
  for (int k = 0; k < FS_N_JUMPS; k++) {
    fprintf(f, ", \"%s\": [", fs_jump_names[k]);
    for (int i = 0; i < FS_N_DECADES; i++) fprintf(f, "%s%d", i > 0 ? ", " : "", c->histogram[k][i]);
    fprintf(f, "]");
  }
  fprintf(f, "},\n");
}

static void put_distribution(FILE *f, const char *name, const fs_surface *s, const fs_distribution *d) {
  fprintf(f, "    \"%s\": {", name);
  put(f, "min", d->min, ", ");
  put(f, "max", d->max, ", ");
  for (int k = 0; k < FS_N_PERCENTILES; k++) {
    char key[16];
    snprintf(key, sizeof key, "p%g", fs_percentiles[k]);
    put(f, key, d->percentile[k], ", ");
  }
  put_place(f, "at_min", s, &d->at_min, ", ");
  put_place(f, "at_max", s, &d->at_max, "},\n");
}

static void put_shape(FILE *f, const char *name, const fs_surface *s, const fs_shape *h) {
  fprintf(f, "  \"%s\": {\n    ", name);
  put(f, "S", h->S, ", ");
  put(f, "willmore", h->willmore, ", ");
  put(f, "area", h->area, ", ");
  put(f, "volume", h->volume, ", ");
  put(f, "diameter", h->diameter, ",\n");
  fprintf(f, "    \"errors\": {");
  put(f, "S", h->S_error, ", ");
  put(f, "willmore", h->willmore_error, ", ");
  put(f, "area", h->area_error, ", ");
  put(f, "volume", h->volume_error, "},\n");
  put_distribution(f, "H", s, &h->H);
  put_distribution(f, "K", s, &h->K);
  put_distribution(f, "gradient_H", s, &h->gradient);
  fprintf(f, "    ");
  put(f, "largest_curvature", h->curvature, ", ");
  put(f, "smallest_radius", h->curvature > 0 ? 1 / h->curvature : (double)NAN, ", ");
  put(f, "tool_radius", h->hollow > 0 ? 1 / h->hollow : (double)NAN, ", ");
  put(f, "inner_radius", h->ridge < 0 ? -1 / h->ridge : (double)NAN, ",\n    ");
  put_place(f, "at_smallest_radius", s, &h->at_curvature, ",\n    ");
  put_place(f, "at_tool_radius", s, &h->at_hollow, ",\n    ");
  fprintf(f, "\"regularity\": {");
  put(f, "least", h->regularity, ", ");
  put_place(f, "at", s, &h->at_regularity, ", ");
  fprintf(f, "\"singular_patches\": %d}\n  },\n", h->n_singular);
}

static void put_crossings(FILE *f, const check_result *r) {
  fprintf(f, "  \"self_intersections\": {\"pairs\": %d, \"places\": [", r->crossings->n);
  for (int32_t i = 0; i < r->crossings->n_listed; i++) {
    const fs_crossing *c = &r->crossings->crossing[i];
    fprintf(f, "%s\n    {", i > 0 ? "," : "");
    put_point(f, "point", c->point, ", ");
    fprintf(f, "\"patches\": [%d, %d], \"parameters\": [[%.17g, %.17g], [%.17g, %.17g]]}", c->place[0].patch,
            c->place[1].patch, c->place[0].u, c->place[0].v, c->place[1].u, c->place[1].v);
  }
  fprintf(f, "]},\n");
}

static void put_comparison(FILE *f, const arguments *a, const check_result *r) {
  const fs_shape *h = &r->shape, *s = &r->start_shape;
  if (!r->has_start) return;
  put_shape(f, "start", r->start, s);
  fprintf(f, "  \"compared\": {\"with\": ");
  put_string(f, a->compare);
  fprintf(f, ", ");
  put(f, "S", h->S / s->S, ", ");
  put(f, "willmore", h->willmore / s->willmore, ", ");
  put(f, "area", h->area / s->area, ", ");
  put(f, "volume", h->volume / s->volume, ", ");
  put(f, "gradient_H_max", h->gradient.max / s->gradient.max, ", ");
  put(f, "largest_curvature", h->curvature / s->curvature, ", ");
  put(f, "largest_distance", r->distance, "},\n");
}

/* Edges between patches that look opposite ways. */
static int32_t count_flipped(const fs_edges *e) {
  int32_t n = 0;
  for (int32_t i = 0; i < e->n_edges; i++) n += e->edge[i].is_flipped;
  return n;
}

void print_check_json(FILE *f, const arguments *a, const check_result *r) {
  fprintf(f, "{\n  \"version\": \"%s\",\n  \"surface\": ", fs_version());
  put_string(f, a->mesh);
  fprintf(f, ",\n  \"patches\": %d,\n  \"edges\": %d,\n  \"edges_found_by_geometry\": %d,\n", r->surface->n_patches,
          r->edges->n_edges, r->edges->n_found);
  fprintf(f, "  \"edges_between_opposite_outsides\": %d,\n", count_flipped(r->edges));
  fprintf(f, "  \"borders\": %d,\n  \"vertices\": %d,\n  \"irregular\": %d,\n  ", r->edges->n_borders,
          r->edges->n_vertices, r->continuity->n_irregular);
  put_jumps(f, "max", r->continuity->max);
  fprintf(f, ",\n  ");
  put(f, "curvature_scale", r->continuity->curvature_scale, ",\n");
  put_all_worst(f, r);
  put_histograms(f, r->continuity);
  put_shape(f, "shape", r->surface, &r->shape);
  put_comparison(f, a, r);
  put_crossings(f, r);
  fprintf(f, "  \"smoothness\": %d,\n  \"require\": \"g%d\",\n  ", r->smoothness, r->order);
  put(f, "tolerance", r->tolerance, ",\n");
  fprintf(f, "  \"pass\": %s\n}\n", r->passes ? "true" : "false");
}
