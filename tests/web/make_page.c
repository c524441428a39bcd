/* SPDX-License-Identifier: MIT */
/* Writes a page for the browser tests, and what the library says about the same net, as JSON on standard output: how the
   surface bends at 100 vertices of its triangles. Usage: make_page MESH OUT.html STEPS ITERATIONS
   ITERATIONS: of fairing, with full caps; 0: the net as it is, with linear ones. Numbers are those of the measures, which the page does not use. */
#include <fairsurf/fairsurf.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N_POINTS = 100 };

typedef struct job {
  fs_mesh *mesh, *control;
  fs_refinement *step[FS_MAX_REFINEMENTS];
  int32_t n_steps;
  fs_space *space;
  fs_surface *surface;
  fs_triangles *triangles;
  fs_vec3 *c;
  fs_cap_notes *caps;
  bool *fixed;
} job;

#define TRY(call)                         \
  do {                                    \
    fs_status status_ = (call);           \
    if (status_ != FS_OK) return status_; \
  } while (0)

static fs_status make(fs_context *ctx, job *j, const char *path, int32_t n_steps, int32_t n_iterations) {
  const fs_mesh *fine;
  fs_fair_report report;
  TRY(fs_mesh_read(ctx, path, &j->mesh));
  TRY(fs_space_prepare(ctx, j->mesh, 0, j->step, &j->n_steps));
  fine = j->n_steps > 0 ? j->step[j->n_steps - 1]->mesh : j->mesh;
  TRY(fs_space_create_with(ctx, fine, &(fs_space_options){.caps = n_iterations > 0 ? FS_CAPS_FULL : FS_CAPS_LINEAR},
                           &j->space));
  j->c = malloc((size_t)j->space->n_dofs * sizeof *j->c);
  j->fixed = calloc((size_t)j->space->n_dofs, sizeof *j->fixed);
  if (j->c == NULL || j->fixed == NULL) return FS_ERR_MEMORY;
  memcpy(j->c, j->space->start, (size_t)j->space->n_dofs * sizeof *j->c);
  if (n_iterations > 0) {
    TRY(fs_space_rim(ctx, fine, j->space, j->fixed));
    fs_fair_options options = {
        .functional = fs_functional_find("penalised"), .fixed = j->fixed, .max_iterations = n_iterations};
    TRY(fs_fair(ctx, j->space, &options, j->c, &report));
  }
  TRY(fs_mesh_copy(ctx, fine, &j->control));
  memcpy(j->control->position, j->c, (size_t)j->control->n_vertices * sizeof *j->c);
  TRY(fs_space_keep_caps(ctx, j->control, j->space, j->c, &j->caps));
  TRY(fs_surface_create(ctx, j->space, j->c, &j->surface));
  return fs_tessellate(ctx, j->surface, n_steps, &j->triangles);
}

static double measure(const char *name, const fs_vec3 *x) {
  double param[8] = {0};
  return fs_measure_find(name)->value(param, x);
}

static void print_points(const job *j) {
  static const char *const names[] = {"mean", "gaussian", "maximum", "minimum"};
  const fs_triangles *t = j->triangles;
  fs_vec3 x[FS_JET_SIZE];
  double largest = 0;
  for (int32_t v = 0; v < t->n_vertices; v++) {
    fs_surface_evaluate(j->surface, t->vertex_patch[v], t->vertex_uv[2 * v], t->vertex_uv[2 * v + 1], x);
    largest = fmax(largest, fmax(fabs(measure("maximum", x)), fabs(measure("minimum", x))));
  }
  printf("{\"vertices\": %d, \"triangles\": %d, \"coefficients\": %d, \"largest\": %.17g, \"points\": [", t->n_vertices,
         t->n_triangles, j->caps != NULL ? j->caps->n_coefficients : 0, largest);
  for (int32_t k = 0; k < N_POINTS; k++) {
    int32_t v = (int32_t)((int64_t)k * (t->n_vertices - 1) / (N_POINTS - 1));
    fs_vec3 p = t->position[v], n = t->normal[v];
    fs_surface_evaluate(j->surface, t->vertex_patch[v], t->vertex_uv[2 * v], t->vertex_uv[2 * v + 1], x);
    printf(
        "%s\n{\"vertex\": %d, \"position\": [%.17g, %.17g, %.17g], \"normal\": [%.17g, %.17g, %.17g], \"curvature\": [",
        k > 0 ? "," : "", v, p.x, p.y, p.z, n.x, n.y, n.z);
    for (int i = 0; i < 4; i++) printf("%s%.17g", i > 0 ? ", " : "", measure(names[i], x));
    printf("]}");
  }
  printf("\n]}\n");
}

int main(int argc, char **argv) {
  fs_context ctx = {0};
  job j = {0};
  fs_status status;
  if (argc != 5) return fprintf(stderr, "usage: %s MESH OUT.html STEPS ITERATIONS\n", argv[0]), 2;
  status = make(&ctx, &j, argv[1], atoi(argv[3]), atoi(argv[4]));
  if (status == FS_OK) {
    fs_model model = {.control = j.control, .surface = j.surface, .caps = j.caps, .made_with = "make_page"};
    status = fs_export_file(&ctx, &model, NULL, argv[2]);
  }
  if (status == FS_OK)
    print_points(&j);
  else
    fprintf(stderr, "%s\n", ctx.message[0] != '\0' ? ctx.message : fs_status_text(status));
  fs_cap_notes_free(&ctx, j.caps);
  fs_triangles_free(&ctx, j.triangles);
  fs_surface_free(&ctx, j.surface);
  fs_space_free(&ctx, j.space);
  for (int32_t i = 0; i < j.n_steps; i++) fs_refinement_free(&ctx, j.step[i]);
  fs_mesh_free(&ctx, j.control);
  fs_mesh_free(&ctx, j.mesh);
  free(j.c);
  free(j.fixed);
  fs_context_clear(&ctx);
  return status == FS_OK ? 0 : 1;
}
