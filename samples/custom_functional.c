/* SPDX-License-Identifier: MIT */
/* A functional of one's own, handed to fairing by pointer: the area plus a little of the Dirichlet integral, whose minimum
   is the soap film through the rim. Usage: custom_functional INPUT OUTPUT

   Area density sqrt(D), D = E G - F^2 with E = x1.x1, F = x1.x2, G = x2.x2 [any text on differential geometry]:
     d sqrt(D) / dx1 = (G x1 - F x2) / sqrt(D) = a           d / dx2 = (E x2 - F x1) / sqrt(D) = b
     d2 / dx1 dx1 = (G I - x2 x2^T - a a^T) / sqrt(D)        d2 / dx2 dx2 = (E I - x1 x1^T - b b^T) / sqrt(D)
     d2 / dx1 dx2 = (2 x1 x2^T - x2 x1^T - F I - a b^T) / sqrt(D)
   The area does not change when a surface slides within itself; the Dirichlet integral 1/2 (E + G) makes the minimum one. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <fairsurf/fairsurf.h>

#define TRY(call)                   \
  do {                              \
    status = (call);                \
    if (status != FS_OK) goto done; \
  } while (0)

enum { N_VECTORS = 2, N_PAIRS = 3 }; /* x1 = p_u, x2 = p_v; pairs (0, 0), (0, 1), (1, 1) */

/* One point: x[2][3] -> f, df[2][3], ddf[3][3][3]. */
static double area_at(double x[2][3], double df[2][3], double ddf[3][3][3]) {
  double E = 0, F = 0, G = 0;
  for (int i = 0; i < 3; i++) {
    E += x[0][i] * x[0][i];
    F += x[0][i] * x[1][i];
    G += x[1][i] * x[1][i];
  }
  double root = sqrt(E * G - F * F);
  for (int i = 0; i < 3; i++) {
    df[0][i] = (G * x[0][i] - F * x[1][i]) / root;
    df[1][i] = (E * x[1][i] - F * x[0][i]) / root;
  }
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      double same = i == j;
      ddf[0][i][j] = (G * same - x[1][i] * x[1][j] - df[0][i] * df[0][j]) / root;
      ddf[1][i][j] = (2 * x[0][i] * x[1][j] - x[1][i] * x[0][j] - F * same - df[0][i] * df[1][j]) / root;
      ddf[2][i][j] = (E * same - x[0][i] * x[0][j] - df[1][i] * df[1][j]) / root;
    }
  }
  return root;
}

static void area_evaluate(const double *x, double *f, double *df, double *ddf) {
  for (int k = 0; k < FS_BLOCK; k++) {
    double point[2][3], first[2][3], second[3][3][3];
    for (int i = 0; i < N_VECTORS * 3; i++) point[i / 3][i % 3] = x[i * FS_BLOCK + k];
    f[k] = area_at(point, first, second);
    if (df != NULL)
      for (int i = 0; i < N_VECTORS * 3; i++) df[i * FS_BLOCK + k] = first[i / 3][i % 3];
    if (ddf != NULL)
      for (int i = 0; i < N_PAIRS * 9; i++) ddf[i * FS_BLOCK + k] = second[i / 9][i / 3 % 3][i % 3];
  }
}

static void dirichlet_evaluate(const double *x, double *f, double *df, double *ddf) {
  for (int k = 0; k < FS_BLOCK; k++) {
    f[k] = 0;
    for (int i = 0; i < N_VECTORS * 3; i++) {
      double value = x[i * FS_BLOCK + k];
      f[k] += 0.5 * value * value;
      if (df != NULL) df[i * FS_BLOCK + k] = value;
    }
    if (ddf == NULL) continue;
    for (int i = 0; i < N_PAIRS * 9; i++) ddf[i * FS_BLOCK + k] = i / 9 != 1 && i / 3 % 3 == i % 3;
  }
}

static const fs_density area = {
    .name = "area", .summary = "area of the surface", .order = 1, .is_geometric = true, .evaluate = area_evaluate};
static const fs_density dirichlet = {.name = "dirichlet",
                                     .summary = "half of |p_u|^2 + |p_v|^2",
                                     .order = 1,
                                     .is_quadratic = true,
                                     .evaluate = dirichlet_evaluate};

static void film_combine(const double *param, const fs_scale *scale, const double *integral, double *value,
                         double *derivative) {
  (void)scale;
  *value = integral[0] + param[0] * integral[1];
  derivative[0] = 1;
  derivative[1] = param[0];
}

static const fs_param film_params[] = {
    {"grip", "weight of the Dirichlet integral", 0.1, 0, 1e6, NULL},
    {NULL, NULL, 0, 0, 0, NULL},
};
static const fs_functional film = {.name = "film",
                                   .summary = "soap film: the area and a little of the Dirichlet integral",
                                   .params = film_params,
                                   .n_terms = 2,
                                   .term = {&area, &dirichlet},
                                   .combine = film_combine,
                                   .is_linear = true};

int main(int argc, char **argv) {
  if (argc != 3) {
    fprintf(stderr, "usage: %s INPUT OUTPUT\n", argv[0]);
    return 2;
  }
  fs_context context = {0}, *ctx = &context;
  fs_status status = FS_OK;
  fs_mesh *mesh = NULL;
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  bool *fixed = NULL;
  fs_vec3 *c = NULL;
  fs_fair_report *report = NULL;
  bool is_smaller = false;

  TRY(fs_mesh_read(ctx, argv[1], &mesh));
  TRY(fs_space_create(ctx, mesh, &space));
  size_t n = (size_t)space->n_dofs;
  fixed = calloc(n, sizeof *fixed);
  c = malloc(n * sizeof *c);
  report = malloc(sizeof *report);
  if (fixed == NULL || c == NULL || report == NULL) TRY(FS_ERR_MEMORY);
  memcpy(c, space->start, n * sizeof *c);
  TRY(fs_space_rim(ctx, mesh, space, fixed));
  TRY(fs_fair(ctx, space, &(fs_fair_options){.functional = &film, .fixed = fixed}, c, report));
  TRY(fs_surface_create(ctx, space, c, &surface));
  TRY(fs_export_file(ctx, &(fs_model){.control = mesh, .surface = surface}, NULL, argv[2]));
  is_smaller = report->end.F < report->start.F && report->end.gradient <= 1e-6 * report->start.gradient;
  printf("area %.6f -> %.6f in %d steps (%s)\n", report->start.integral[0], report->end.integral[0],
         (int)report->n_steps, fs_stop_text(report->stop));
  if (!is_smaller) fprintf(stderr, "the minimum was not reached\n");

done:
  if (status != FS_OK) fprintf(stderr, "%s\n", context.message[0] ? context.message : fs_status_text(status));
  free(report);
  free(c);
  free(fixed);
  fs_surface_free(ctx, surface);
  fs_space_free(ctx, space);
  fs_mesh_free(ctx, mesh);
  fs_context_clear(ctx);
  return status == FS_OK && is_smaller ? 0 : 1;
}
