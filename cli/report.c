/* SPDX-License-Identifier: MIT */
/* Single role: what fairing did, for people and as JSON. */
#include "cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double peak_bytes(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * (double)usage.ru_maxrss;
}

static void put_number(FILE *file, const char *name, double value, const char *separator) {
  if (isfinite(value))
    fprintf(file, "\"%s\": %.17g%s", name, value, separator);
  else
    fprintf(file, "\"%s\": null%s", name, separator);
}

static void put_energy(FILE *file, const char *name, const fs_energy *e, double c) {
  fprintf(file, "  \"%s\": {", name);
  put_number(file, "F", e->F, ", ");
  put_number(file, "S", e->S, ", ");
  put_number(file, "S_caps", e->S_caps, ", ");
  put_number(file, "Q", e->Q, ", ");
  put_number(file, "cQ", c * e->Q, ", ");
  put_number(file, "gradient", e->gradient, "},\n");
}

void put_string(FILE *file, const char *text) {
  fputc('"', file);
  for (; *text != '\0'; text++) {
    unsigned char c = (unsigned char)*text;
    if (c == '"' || c == '\\')
      fprintf(file, "\\%c", c);
    else if (c < 0x20)
      fprintf(file, "\\u%04x", c);
    else
      fputc(c, file);
  }
  fputc('"', file);
}

static void put_report(FILE *file, const arguments *a, const fs_fair_report *r, const timings *t) {
  fprintf(file, "{\n  \"version\": \"%s\",\n  \"mesh\": ", fs_version());
  put_string(file, a->mesh);
  fprintf(file, ",\n  \"functional\": \"%s\",\n", r->functional->name);
  fprintf(file, "  \"free\": %d,\n  \"free_inner\": %d,\n  \"squares\": %d,\n  \"caps\": %d,\n  ", r->n_free,
          r->n_free_inner, r->n_squares, r->n_caps);
  put_number(file, "c", r->c, ",\n");
  if (r->n_unknowns != r->n_free) fprintf(file, "  \"unknowns\": %d,\n", r->n_unknowns);
  if (a->constraints.stay_within > 0) {
    fprintf(file, "  ");
    put_number(file, "distance", r->distance, ",\n");
  }
  put_energy(file, "start", &r->start, r->c);
  put_energy(file, "end", &r->end, r->c);
  fprintf(file, "  \"quality\": {\"nodes_square\": %d, \"nodes_cap\": %d, ", r->quality.n_nodes_square,
          r->quality.n_nodes_cap);
  put_number(file, "S", r->quality.S, ", ");
  put_number(file, "S_caps", r->quality.S_caps, ", ");
  put_number(file, "area", r->quality.area, ", ");
  put_number(file, "least_density", r->quality.least_density, ", ");
  fprintf(file, "\"face\": %d},\n", r->quality.face);
  fprintf(file,
          "  \"steps\": %d,\n  \"hessians\": %d,\n  \"factorisations\": %d,\n  \"saddles\": %d,\n  \"stop\": \"%s\",\n",
          r->n_steps, r->n_hessians, r->n_factorisations, r->n_saddles, fs_stop_text(r->stop));
  fprintf(file, "  \"trace\": [");
  for (int32_t i = 0; i < r->n_trace; i++) {
    const fs_step *s = &r->trace[i];
    fprintf(file, "%s\n    {\"step\": %d, ", i > 0 ? "," : "", s->number);
    put_number(file, "F", s->value, ", ");
    put_number(file, "c", s->c, ", ");
    put_number(file, "gradient", s->gradient, ", ");
    put_number(file, "damping", s->damping, ", ");
    put_number(file, "length", s->length, ", ");
    put_number(file, "gain", s->gain, ", ");
    fprintf(file, "\"factorisations\": %d, ", s->n_factorisations);
    put_number(file, "seconds", s->seconds, "}");
  }
  fprintf(file, "\n  ],\n  \"seconds\": {");
  put_number(file, "read", t->read, ", ");
  put_number(file, "space", t->space, ", ");
  put_number(file, "fair", t->fair, ", ");
  put_number(file, "export", t->export, ", ");
  put_number(file, "gradients", r->costs.gradients, ", "); /* processor seconds */
  put_number(file, "hessians", r->costs.hessians, ", ");
  put_number(file, "analysis", r->costs.analysis, ", ");
  put_number(file, "factorisations", r->costs.factorisations, ", ");
  put_number(file, "total", t->total, "},\n  ");
  put_number(file, "peak_bytes", peak_bytes(), "\n}\n");
}

fs_status write_report(fs_context *ctx, const char *path, const arguments *a, const fs_fair_report *r,
                       const timings *t) {
  char *text = NULL;
  size_t size = 0;
  fs_files *files = NULL;
  fs_output output;
  fs_sink sink;
  fs_status status;
  const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
  FILE *memory = open_memstream(&text, &size);
  if (memory == NULL) {
    snprintf(ctx->message, sizeof ctx->message, "out of memory for the report");
    return FS_ERR_MEMORY;
  }
  put_report(memory, a, r, t);
  if (fclose(memory) != 0) {
    free(text);
    snprintf(ctx->message, sizeof ctx->message, "out of memory for the report");
    return FS_ERR_MEMORY;
  }
  status = fs_files_create(ctx, path, &files, &output);
  if (status == FS_OK) {
    status = output.open(output.user, dot != NULL && (slash == NULL || dot > slash) ? dot + 1 : "", &sink);
    if (status == FS_OK) status = sink.write(sink.user, text, size);
    if (status == FS_OK)
      status = fs_files_commit(ctx, files);
    else
      fs_files_discard(ctx, files);
  }
  free(text);
  return status;
}

static void print_energy(FILE *file, const char *name, const fs_energy *e) {
  fprintf(file, "%-6s F %-16.10g S %-16.10g (caps %.6g)  Q %-14.8g gradient %.3g\n", name, e->F, e->S, e->S_caps, e->Q,
          e->gradient);
}

void print_report(FILE *file, const arguments *a, const fs_fair_report *r, const timings *t) {
  fprintf(file, "%d free vertices, %d squares, %d caps", r->n_free - r->n_free_inner, r->n_squares, r->n_caps);
  if (r->n_free_inner > 0) fprintf(file, " with %d free inner coefficients", r->n_free_inner);
  fputc('\n', file);
  if (r->n_unknowns != r->n_free) fprintf(file, "%d unknown points under the constraints\n", r->n_unknowns);
  print_energy(file, "start", &r->start);
  print_energy(file, "end", &r->end);
  fprintf(file,
          "cQ %.6g; S %.10g with %d nodes on squares and %d in caps; least |p_u x p_v| %.3g of its mean, on face %d\n",
          r->c * r->end.Q, r->quality.S, r->quality.n_nodes_square, r->quality.n_nodes_cap, r->quality.least_density,
          r->quality.face);
  if (a->constraints.stay_within > 0)
    fprintf(file, "largest distance from %s: %.6g of %.6g\n",
            a->constraints.stay_near != NULL ? a->constraints.stay_near : "the start", r->distance,
            a->constraints.stay_within);
  fprintf(file, "%d steps, %d Hessians, %d factorisations, stopped by %s, %.2f s of %.2f s\n", r->n_steps,
          r->n_hessians, r->n_factorisations, fs_stop_text(r->stop), t->fair, t->total);
}
