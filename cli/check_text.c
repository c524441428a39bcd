/* SPDX-License-Identifier: MIT */
/* Single role: what check has found, for people. */
#include "check.h"

#include <math.h>

static void print_point(FILE *f, fs_vec3 p) { fprintf(f, "<%.6g, %.6g, %.6g>", p.x, p.y, p.z); }

static void print_place(FILE *f, const fs_surface *s, const fs_place *p) {
  fs_vec3 x[FS_JET_SIZE];
  if (p->patch == FS_NONE) return;
  fs_surface_evaluate(s, p->patch, p->u, p->v, x);
  fprintf(f, " at ");
  print_point(f, x[FS_D]);
}

static const char *const titles[FS_N_JUMPS] = {"gap", "angle of normals", "jump of curvature", "jump of grad H"};
static const char *const units[FS_N_JUMPS] = {"", " rad", " of the largest", ""};

static void print_jumps(FILE *f, const check_result *r) {
  const fs_continuity *c = r->continuity;
  for (int k = 0; k < FS_N_JUMPS; k++) {
    if (isnan(c->max[k])) {
      fprintf(f, "%-18s none\n", titles[k]);
      continue;
    }
    fprintf(f, "%-18s %.6g%s", titles[k], c->max[k], units[k]);
    if (c->n_worst[k] > 0 && c->max[k] > 0) {
      const fs_worst *w = &c->worst[k][0];
      if (w->edge != FS_NONE)
        fprintf(f, ", edge %d (patches %d and %d) at %.6g, ", w->edge, r->edges->edge[w->edge].patch[0],
                r->edges->edge[w->edge].patch[1], w->t);
      else
        fprintf(f, ", vertex %d, ", w->vertex);
      print_point(f, w->point);
    }
    fprintf(f, "\n");
  }
}

/* One line per decade that has edges, of the jumps of the required order. */
static void print_histogram(FILE *f, const check_result *r) {
  enum { WIDTH = 50 };
  const int32_t *n = r->continuity->histogram[r->order];
  int32_t most = 1;
  for (int i = 0; i < FS_N_DECADES; i++) most = n[i] > most ? n[i] : most;
  fprintf(f, "edges by %s:\n", titles[r->order]);
  for (int i = 0; i < FS_N_DECADES; i++) {
    if (n[i] == 0) continue;
    fprintf(f, "  %s1e%+03d %8d ", i == 0 ? "< " : ">=", i == 0 ? -17 : i - 18, n[i]);
    for (int32_t k = 0; k < (int32_t)ceil((double)WIDTH * n[i] / most); k++) fputc('#', f);
    fputc('\n', f);
  }
}

static void print_distribution(FILE *f, const char *name, const fs_surface *s, const fs_distribution *d) {
  fprintf(f, "%-18s %.6g to %.6g", name, d->min, d->max);
  print_place(f, s, &d->at_max);
  fprintf(f, "; 5%% below %.6g, half below %.6g, 95%% below %.6g\n", d->percentile[1], d->percentile[2],
          d->percentile[3]);
}

static void print_shape(FILE *f, const fs_surface *s, const fs_shape *h) {
  fprintf(f, "S                  %.10g (error about %.1g)\n", h->S, h->S_error);
  fprintf(f, "Willmore energy    %.10g\n", h->willmore);
  fprintf(f, "area               %.12g\n", h->area);
  fprintf(f, "volume             %.12g\n", h->volume);
  fprintf(f, "diameter           %.10g\n", h->diameter);
  print_distribution(f, "H", s, &h->H);
  print_distribution(f, "K", s, &h->K);
  print_distribution(f, "|grad H|", s, &h->gradient);
  if (h->curvature > 0) {
    fprintf(f, "smallest radius    %.10g", 1 / h->curvature);
    print_place(f, s, &h->at_curvature);
    fprintf(f, "\n");
  }
  if (h->hollow > 0) {
    fprintf(f, "tool radius        %.10g", 1 / h->hollow);
    print_place(f, s, &h->at_hollow);
    fprintf(f, "\n");
  }
  fprintf(f, "least |pu x pv|    %.6g of the average of its patch", h->regularity);
  print_place(f, s, &h->at_regularity);
  fprintf(f, h->n_singular > 0 ? "; %d patches are singular\n" : "\n", h->n_singular);
}

static void print_crossings(FILE *f, const fs_crossings *c) {
  fprintf(f, "self-intersections %d pairs of patches\n", c->n);
  for (int32_t i = 0; i < c->n_listed; i++) {
    fprintf(f, "  patches %d and %d at ", c->crossing[i].place[0].patch, c->crossing[i].place[1].patch);
    print_point(f, c->crossing[i].point);
    fprintf(f, "\n");
  }
}

static void print_comparison(FILE *f, const arguments *a, const check_result *r) {
  const fs_shape *h = &r->shape, *s = &r->start_shape;
  if (!r->has_start) return;
  fprintf(f, "compared with %s: S times %.6g, Willmore energy times %.6g, area times %.6g, volume times %.6g,\n",
          a->compare, h->S / s->S, h->willmore / s->willmore, h->area / s->area, h->volume / s->volume);
  fprintf(f, "  largest |grad H| times %.6g, largest curvature times %.6g", h->gradient.max / s->gradient.max,
          h->curvature / s->curvature);
  if (!isnan(r->distance)) fprintf(f, ", moved by up to %.6g", r->distance);
  fprintf(f, "\n");
}

void print_check(FILE *f, const arguments *a, const check_result *r) {
  fprintf(f, "%s: %d patches, %d edges (%d found by geometry), %d of the border, %d vertices\n", a->mesh,
          r->surface->n_patches, r->edges->n_edges, r->edges->n_found, r->edges->n_borders, r->edges->n_vertices);
  int32_t n_flipped = 0;
  for (int32_t i = 0; i < r->edges->n_edges; i++) n_flipped += r->edges->edge[i].is_flipped;
  if (n_flipped > 0) fprintf(f, "%d edges are between patches with opposite outsides\n", n_flipped);
  if (r->continuity->n_irregular > 0)
    fprintf(f, "%d edges and vertices have points without a normal\n", r->continuity->n_irregular);
  print_jumps(f, r);
  print_histogram(f, r);
  print_shape(f, r->surface, &r->shape);
  print_comparison(f, a, r);
  print_crossings(f, r->crossings);
  if (r->smoothness < 0)
    fprintf(f, "not continuous with the tolerance %g\n", r->tolerance);
  else
    fprintf(f, "G%d with the tolerance %g\n", r->smoothness, r->tolerance);
  if (a->require >= 0) fprintf(f, "G%d is required: %s\n", r->order, r->passes ? "passed" : "failed");
}
