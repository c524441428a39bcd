/* SPDX-License-Identifier: MIT */
/* Single role: volume and area of the surface over a mesh by Gauss quadrature on its patches, to compare files with.

   Usage: measure MESH      With the inner coefficients of caps that the file of the mesh keeps. Prints "volume V", "area A", "size D" (diagonal of the box) and "patches N".
   V = 1/3 integral p . (p_u x p_v) du dv, exact with 16 nodes per direction up to degree 10; A = integral |p_u x p_v|. */
#include <math.h>
#include <stdio.h>

#include <fairsurf/fairsurf.h>

#define TRY(call)                   \
  do {                              \
    status = (call);                \
    if (status != FS_OK) goto done; \
  } while (0)

enum { N = 16 };

/* Nodes and weights on [0, 1]: zeros of the Legendre polynomial P_N by Newton's method, w = 2 / ((1 - x^2) P_N'(x)^2). */
static void find_nodes(double node[N], double weight[N]) {
  for (int i = 0; i < N; i++) {
    double x = cos(3.14159265358979323846 * (i + 0.75) / (N + 0.5)), slope = 1;
    for (int step = 0; step < 20; step++) {
      double p = 1, q = 0; /* P_k, P_k-1 */
      for (int k = 0; k < N; k++) {
        double next = ((2 * k + 1) * x * p - k * q) / (k + 1);
        q = p, p = next;
      }
      slope = N * (x * p - q) / (x * x - 1);
      x -= p / slope;
    }
    node[i] = (1 + x) / 2;
    weight[i] = 1 / ((1 - x * x) * slope * slope);
  }
}

static void measure(const fs_surface *surface) {
  double node[N], weight[N], volume = 0, area = 0, min[3], max[3];
  fs_vec3 x[FS_JET_SIZE];
  find_nodes(node, weight);
  for (int k = 0; k < 3; k++) min[k] = INFINITY, max[k] = -INFINITY;
  for (int32_t patch = 0; patch < surface->n_patches; patch++)
    for (int j = 0; j < N; j++)
      for (int i = 0; i < N; i++) {
        fs_surface_evaluate(surface, patch, node[i], node[j], x);
        fs_vec3 p = x[FS_D], u = x[FS_DU], v = x[FS_DV];
        fs_vec3 n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        const double coordinate[3] = {p.x, p.y, p.z};
        volume += weight[i] * weight[j] * (p.x * n.x + p.y * n.y + p.z * n.z) / 3;
        area += weight[i] * weight[j] * sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        for (int k = 0; k < 3; k++) min[k] = fmin(min[k], coordinate[k]), max[k] = fmax(max[k], coordinate[k]);
      }
  printf("volume %.15g\narea %.15g\nsize %.6g\npatches %d\n", volume, area,
         sqrt(pow(max[0] - min[0], 2) + pow(max[1] - min[1], 2) + pow(max[2] - min[2], 2)), surface->n_patches);
}

int main(int argc, char **argv) {
  fs_context context = {0}, *ctx = &context;
  fs_status status = FS_OK;
  fs_mesh *mesh = NULL;
  fs_refinement *steps[FS_MAX_REFINEMENTS] = {NULL};
  int32_t n_steps = 0;
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  fs_mesh_notes notes = {0};
  if (argc != 2) {
    fprintf(stderr, "usage: %s MESH\n", argv[0]);
    return 2;
  }
  TRY(fs_mesh_read_notes(ctx, argv[1], &mesh, &notes));
  TRY(fs_space_prepare(ctx, mesh, 0, steps, &n_steps));
  const fs_mesh *fine = n_steps > 0 ? steps[n_steps - 1]->mesh : mesh;
  fs_space_options options = {.caps = notes.caps != NULL ? FS_CAPS_FULL : FS_CAPS_LINEAR, .kept = notes.caps};
  TRY(fs_space_create_with(ctx, fine, &options, &space));
  TRY(fs_surface_create(ctx, space, space->start, &surface));
  measure(surface);
done:
  if (status != FS_OK) fprintf(stderr, "%s\n", context.message[0] != '\0' ? context.message : fs_status_text(status));
  fs_surface_free(ctx, surface);
  fs_space_free(ctx, space);
  for (int32_t i = 0; i < n_steps; i++) fs_refinement_free(ctx, steps[i]);
  fs_mesh_notes_clear(ctx, &notes);
  fs_mesh_free(ctx, mesh);
  fs_context_clear(ctx);
  return status == FS_OK ? 0 : 1;
}
