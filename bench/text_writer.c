/* SPDX-License-Identifier: MIT */
/* Single role: how fast the exporters write text, in MB of text per second of one core, beside fprintf with "%.9g".

   An exporter's time runs from its opening the first file, when the triangles are made, to its end; the least of five. The
   first argument, a speed, makes the program fail where an exporter is slower. */
#include <fairsurf/fairsurf.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { N_PATCHES = 40, STEPS = 8, N_REPEATS = 5 }; /* 102 400 cells, 204 800 triangles */

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- a surface: N x N bicubic patches of a wavy plane ---- */

static fs_surface *make_surface(void) {
  fs_surface *s = calloc(1, sizeof *s);
  s->n_patches = N_PATCHES * N_PATCHES;
  s->n_data = 48 * (size_t)s->n_patches;
  s->patch = calloc((size_t)s->n_patches, sizeof *s->patch);
  s->data = calloc(s->n_data, sizeof *s->data);
  for (int p = 0; p < s->n_patches; p++) {
    int a = p % N_PATCHES, b = p / N_PATCHES;
    double *point = s->data + 48 * (size_t)p;
    s->patch[p] = (fs_patch){.n_sides = 4,
                             .degree_u = 3,
                             .degree_v = 3,
                             .data_start = 48 * (size_t)p,
                             .face = p,
                             .valence = 4,
                             .neighbour = {b > 0 ? p - N_PATCHES : FS_NONE, a + 1 < N_PATCHES ? p + 1 : FS_NONE,
                                           b + 1 < N_PATCHES ? p + N_PATCHES : FS_NONE, a > 0 ? p - 1 : FS_NONE},
                             .neighbour_side = {2, 3, 0, 1}};
    for (int k = 0; k < 16; k++, point += 3) {
      point[0] = a + (k % 4) / 3.0;
      point[1] = b + (k / 4) / 3.0;
      point[2] = sin(0.7 * point[0]) * cos(0.5 * point[1]);
    }
  }
  return s;
}

/* ---- outputs ---- */

typedef struct counter {
  size_t n_bytes;
  double opened; /* 0: no file so far */
} counter;

static fs_status count_bytes(void *user, const void *bytes, size_t size) {
  counter *c = user;
  (void)bytes;
  c->n_bytes += size;
  return FS_OK;
}

static fs_status open_counter(void *user, const char *extension, fs_sink *sink) {
  counter *c = user;
  (void)extension;
  if (c->opened == 0) c->opened = now();
  *sink = (fs_sink){count_bytes, user};
  return FS_OK;
}

/* ---- what is timed ---- */

static void set(const fs_exporter *exporter, double *param, const char *name, double value) {
  for (int k = 0; exporter->params[k].name != NULL; k++)
    if (strcmp(exporter->params[k].name, name) == 0) param[k] = value;
}

/* MB/s; choice is set to value where it is not NULL. */
static double run(const char *title, const fs_model *model, const char *extension, int steps, const char *choice,
                  double value) {
  const fs_exporter *exporter = fs_exporter_find(extension);
  fs_context ctx = {0};
  double param[32] = {0}, best = INFINITY, speed;
  counter c = {0};
  fs_output output = {open_counter, &c};
  for (int k = 0; exporter->params[k].name != NULL; k++) param[k] = exporter->params[k].initial;
  set(exporter, param, "steps", steps);
  if (choice != NULL) set(exporter, param, choice, value);
  for (int i = 0; i < N_REPEATS; i++) {
    c = (counter){0};
    if (fs_export(&ctx, model, exporter, param, &output) != FS_OK) {
      fprintf(stderr, "%s: %s\n", title, ctx.message);
      exit(EXIT_FAILURE);
    }
    best = fmin(best, now() - c.opened);
  }
  speed = (double)c.n_bytes / 1e6 / best;
  printf("%-32s %7.1f MB %7.0f MB/s\n", title, (double)c.n_bytes / 1e6, speed);
  return speed;
}

/* The positions and normals of the same triangles by the C library. */
static void run_fprintf(const fs_surface *surface) {
  fs_context ctx = {0};
  fs_triangles *t = NULL;
  FILE *file = fopen("/dev/null", "w");
  double best = INFINITY;
  size_t n_bytes = 0;
  if (file == NULL || fs_tessellate(&ctx, surface, STEPS, &t) != FS_OK) exit(EXIT_FAILURE);
  for (int i = 0; i < N_REPEATS; i++) {
    double start = now();
    n_bytes = 0;
    for (int32_t k = 0; k < t->n_vertices; k++) {
      fs_vec3 p = t->position[k], n = t->normal[k];
      n_bytes += (size_t)fprintf(file, "v %.9g %.9g %.9g\n", p.x, p.y, p.z);
      n_bytes += (size_t)fprintf(file, "vn %.9g %.9g %.9g\n", n.x, n.y, n.z);
    }
    best = fmin(best, now() - start);
  }
  printf("%-32s %7.1f MB %7.0f MB/s\n", "fprintf \"%.9g\"", (double)n_bytes / 1e6, (double)n_bytes / 1e6 / best);
  fs_triangles_free(&ctx, t);
  fclose(file);
}

/* A net of the corners of all cells. */
static fs_mesh *make_net(const fs_surface *surface) {
  fs_context ctx = {0};
  fs_triangles *t = NULL;
  fs_mesh *mesh = NULL;
  int32_t *start;
  if (fs_tessellate(&ctx, surface, STEPS, &t) != FS_OK) exit(EXIT_FAILURE);
  start = malloc(((size_t)t->n_triangles + 1) * sizeof *start);
  for (int32_t f = 0; start != NULL && f <= t->n_triangles; f++) start[f] = 3 * f;
  if (start == NULL ||
      fs_mesh_create(&ctx, t->n_vertices, t->position, t->n_triangles, start, t->corner, &mesh) != FS_OK)
    exit(EXIT_FAILURE);
  free(start);
  fs_triangles_free(&ctx, t);
  return mesh;
}

int main(int argc, char **argv) {
  double least = argc > 1 ? atof(argv[1]) : 0, slowest = INFINITY;
  fs_surface *surface = make_surface();
  fs_mesh *mesh = make_net(surface);
  fs_model skin = {.name = "skin", .surface = surface}, net = {.name = "net", .control = mesh};
  run_fprintf(surface);
  slowest = fmin(slowest, run("obj, net", &net, "obj", STEPS, NULL, 0));
  slowest = fmin(slowest, run("off, net", &net, "off", STEPS, NULL, 0));
  slowest = fmin(slowest, run("ply ascii, net", &net, "ply", STEPS, "format", 1));
  slowest = fmin(slowest, run("obj, triangles with normals", &skin, "obj", STEPS, NULL, 0));
  slowest = fmin(slowest, run("off, triangles", &skin, "off", STEPS, NULL, 0));
  slowest = fmin(slowest, run("ply ascii, triangles", &skin, "ply", STEPS, "format", 1));
  slowest = fmin(slowest, run("stl ascii", &skin, "stl", STEPS, "format", 1));
  slowest = fmin(slowest, run("scad", &skin, "scad", STEPS, NULL, 0));
  slowest = fmin(slowest, run("pov, mesh2", &skin, "pov", 3, "pov", 1)); /* 2^3 steps */
  printf("slowest %.0f MB/s%s\n", slowest, slowest < least ? ": too slow" : "");
  fs_mesh_free(&(fs_context){0}, mesh);
  free(surface->patch);
  free(surface->data);
  free(surface);
  return slowest < least ? EXIT_FAILURE : EXIT_SUCCESS;
}
