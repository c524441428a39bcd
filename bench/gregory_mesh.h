/* SPDX-License-Identifier: MIT */
/* The mesh of the Gregory benchmarks, for C and C++: a bumpy torus of triangles, each cut into three quads around its middle,
   so that every quad has a vertex of valence 3 and one of valence 6. */
#ifndef FS_BENCH_GREGORY_MESH_H
#define FS_BENCH_GREGORY_MESH_H

#include <math.h>
#include <stdlib.h>

enum { BENCH_ROWS = 128, BENCH_COLUMNS = 130, BENCH_POINTS = 100 }; /* 99 840 quads; points per quad */

typedef struct bench_mesh {
  int n_vertices, n_quads;
  double (*position)[3];
  int (*corner)[4];
} bench_mesh;

/* i along the tube, j around it; both may be any multiple of 1/6. */
static void bench_point(double i, double j, double *p) {
  const double a = 2 * 3.14159265358979323846 * i / BENCH_COLUMNS, b = 2 * 3.14159265358979323846 * j / BENCH_ROWS;
  const double r = 1 + 0.2 * sin(7 * a) * sin(4 * b), R = 3 + r * cos(b);
  p[0] = R * cos(a), p[1] = R * sin(a), p[2] = r * sin(b);
}

/* Vertices: grid, middles of edges (right, up, diagonal), middles of triangles. */
static int bench_vertex(int kind, int i, int j) {
  return kind * BENCH_ROWS * BENCH_COLUMNS + (i % BENCH_COLUMNS) + BENCH_COLUMNS * (j % BENCH_ROWS);
}

static bench_mesh bench_make_mesh(void) {
  static const double offset[6][2] = {{0, 0}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}, {2.0 / 3, 1.0 / 3}, {1.0 / 3, 2.0 / 3}};
  const int n = BENCH_ROWS * BENCH_COLUMNS;
  bench_mesh m;
  int f = 0;
  m.n_vertices = 6 * n;
  m.n_quads = 6 * n;
  m.position = (double(*)[3])malloc((size_t)m.n_vertices * sizeof *m.position);
  m.corner = (int(*)[4])malloc((size_t)m.n_quads * sizeof *m.corner);
  if (m.position == NULL || m.corner == NULL) abort();
  for (int kind = 0; kind < 6; kind++)
    for (int k = 0; k < n; k++)
      bench_point(k % BENCH_COLUMNS + offset[kind][0], k / BENCH_COLUMNS + offset[kind][1], m.position[kind * n + k]);
  for (int j = 0; j < BENCH_ROWS; j++)
    for (int i = 0; i < BENCH_COLUMNS; i++) {
      const int a = bench_vertex(0, i, j), b = bench_vertex(0, i + 1, j), c = bench_vertex(0, i + 1, j + 1);
      const int d = bench_vertex(0, i, j + 1), ab = bench_vertex(1, i, j), bc = bench_vertex(2, i + 1, j);
      const int ac = bench_vertex(3, i, j), dc = bench_vertex(1, i, j + 1), ad = bench_vertex(2, i, j);
      const int low = bench_vertex(4, i, j), high = bench_vertex(5, i, j);
      const int quad[6][4] = {{a, ab, low, ac},  {b, bc, low, ab},  {c, ac, low, bc},
                              {a, ac, high, ad}, {c, dc, high, ac}, {d, ad, high, dc}};
      for (int q = 0; q < 6; q++, f++)
        for (int k = 0; k < 4; k++) m.corner[f][k] = quad[q][k];
    }
  return m;
}

/* Parameters of point k of a quad. */
static void bench_parameters(int k, double *u, double *v) {
  *u = (k % 10 + 0.5) / 10;
  *v = (k / 10 + 0.5) / 10;
}

#endif
