/* SPDX-License-Identifier: MIT */
/* Single role: small meshes for tests, made from arrays. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

fs_mesh *test_mesh(int32_t n_vertices, const fs_vec3 *position, int32_t n_faces, const int32_t *face_start,
                   const int32_t *corner) {
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  if (fs_mesh_create(&ctx, n_vertices, position, n_faces, face_start, corner, &mesh) != FS_OK) {
    fprintf(stderr, "a mesh for tests is refused: %s\n", ctx.message);
    exit(EXIT_FAILURE);
  }
  return mesh;
}

static void *array(int32_t n, size_t size) {
  void *block = calloc((size_t)n, size);
  if (block == NULL) abort();
  return block;
}

/* A mesh of quads, which takes over the two arrays. */
static fs_mesh *quads(int32_t n_vertices, fs_vec3 *position, int32_t n_faces, int32_t *corner) {
  int32_t *face_start = array(n_faces + 1, sizeof *face_start);
  fs_mesh *mesh;
  for (int32_t f = 0; f <= n_faces; f++) face_start[f] = 4 * f;
  mesh = test_mesh(n_vertices, position, n_faces, face_start, corner);
  free(position);
  free(face_start);
  free(corner);
  return mesh;
}

static int32_t *put_quad(int32_t *corner, int32_t a, int32_t b, int32_t c, int32_t d) {
  corner[0] = a, corner[1] = b, corner[2] = c, corner[3] = d;
  return corner + 4;
}

fs_mesh *test_cube(void) {
  static const int32_t corner[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  static const int32_t face_start[7] = {0, 4, 8, 12, 16, 20, 24};
  fs_vec3 position[8];
  for (int v = 0; v < 8; v++) position[v] = (fs_vec3){v & 1 ? 1 : -1, v & 2 ? 1 : -1, v & 4 ? 1 : -1};
  return test_mesh(8, position, 6, face_start, corner);
}

fs_mesh *test_prism(int32_t k) {
  fs_vec3 *position = array(2 * k, sizeof *position);
  int32_t *face_start = array(k + 3, sizeof *face_start), *corner = array(6 * k, sizeof *corner), *next = corner;
  fs_mesh *mesh;
  for (int32_t i = 0; i < k; i++) {
    double angle = 2 * PI * i / k;
    position[i] = (fs_vec3){cos(angle), sin(angle), -0.5};
    position[k + i] = (fs_vec3){cos(angle), sin(angle), 0.5};
    next = put_quad(next, i, (i + 1) % k, k + (i + 1) % k, k + i);
    face_start[i + 1] = face_start[i] + 4;
  }
  for (int32_t i = 0; i < k; i++) {
    next[i] = k - 1 - i;
    next[k + i] = k + i;
  }
  face_start[k + 1] = 5 * k;
  face_start[k + 2] = 6 * k;
  mesh = test_mesh(2 * k, position, k + 2, face_start, corner);
  free(position);
  free(face_start);
  free(corner);
  return mesh;
}

fs_mesh *test_grid(int32_t nx, int32_t ny, double (*z)(double x, double y)) {
  int32_t n = (nx + 1) * (ny + 1);
  fs_vec3 *position = array(n, sizeof *position);
  int32_t *corner = array(4 * nx * ny, sizeof *corner), *next = corner;
  for (int32_t v = 0; v < n; v++) {
    double x = v % (nx + 1), y = (double)(v / (nx + 1));
    position[v] = (fs_vec3){x, y, z == NULL ? 0 : z(x, y)};
  }
  for (int32_t j = 0; j < ny; j++)
    for (int32_t i = 0; i < nx; i++) {
      int32_t v = i + (nx + 1) * j;
      next = put_quad(next, v, v + 1, v + nx + 2, v + nx + 1);
    }
  return quads(n, position, nx * ny, corner);
}

fs_mesh *test_torus(int32_t n, int32_t m, double R, double r) {
  fs_vec3 *position = array(n * m, sizeof *position);
  int32_t *corner = array(4 * n * m, sizeof *corner), *next = corner;
  for (int32_t i = 0; i < n; i++)
    for (int32_t j = 0; j < m; j++) {
      double a = 2 * PI * i / n, b = 2 * PI * j / m;
      int32_t east = (i + 1) % n, up = (j + 1) % m;
      position[i * m + j] = (fs_vec3){(R + r * cos(b)) * cos(a), (R + r * cos(b)) * sin(a), r * sin(b)};
      next = put_quad(next, i * m + j, east * m + j, east * m + up, i * m + up);
    }
  return quads(n * m, position, n * m, corner);
}

/* Number of the star's vertex at i e(s) + j e(s + 1); the line i = 0 belongs to the next sector. */
static int32_t star_vertex(int32_t k, int32_t rings, int32_t s, int32_t i, int32_t j) {
  if (i == 0 && j == 0) return 0;
  if (i == 0) return star_vertex(k, rings, (s + 1) % k, j, 0);
  return 1 + (s * rings + i - 1) * (rings + 1) + j;
}

fs_mesh *test_star(int32_t k, int32_t rings) {
  int32_t n = 1 + k * rings * (rings + 1);
  fs_vec3 *position = array(n, sizeof *position);
  int32_t *corner = array(4 * k * rings * rings, sizeof *corner), *next = corner;
  for (int32_t s = 0; s < k; s++) {
    double a = 2 * PI * s / k, b = 2 * PI * (s + 1) / k;
    for (int32_t i = 1; i <= rings; i++)
      for (int32_t j = 0; j <= rings; j++) {
        double x = i * cos(a) + j * cos(b), y = i * sin(a) + j * sin(b);
        position[star_vertex(k, rings, s, i, j)] = (fs_vec3){x, y, (x * x - y * y) / (5 * rings)};
      }
    for (int32_t i = 0; i < rings; i++)
      for (int32_t j = 0; j < rings; j++)
        next = put_quad(next, star_vertex(k, rings, s, i, j), star_vertex(k, rings, s, i + 1, j),
                        star_vertex(k, rings, s, i + 1, j + 1), star_vertex(k, rings, s, i, j + 1));
  }
  return quads(n, position, k * rings * rings, corner);
}

void test_mesh_disturb(fs_mesh *mesh, double amount, uint64_t *state) {
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    mesh->position[v].x += test_random_real(state, -amount, amount);
    mesh->position[v].y += test_random_real(state, -amount, amount);
    mesh->position[v].z += test_random_real(state, -amount, amount);
  }
}

static fs_mesh *random_shape(uint64_t *state) {
  int32_t n = test_random_integer(state, 3, 9), m = test_random_integer(state, 3, 9);
  switch (test_random_integer(state, 0, 4)) {
  case 0:
    return test_cube();
  case 1:
    return test_grid(n, m, NULL);
  case 2:
    return test_torus(n, m, 3, 1);
  case 3:
    return test_star(n, test_random_integer(state, 1, 5));
  default:
    return test_prism(m);
  }
}

fs_mesh *test_random_mesh(uint64_t seed) {
  uint64_t state = seed;
  fs_mesh *mesh = random_shape(&state);
  if (test_random_integer(&state, 0, 3) > 0) test_mesh_disturb(mesh, 0.1, &state);
  return mesh;
}
