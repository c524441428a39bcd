/* SPDX-License-Identifier: MIT */
/* Single role: arithmetic of polynomials over a triangle in Bernstein form.

     partial of orders (a, b, c)   sum n! / ((i-a)! (j-b)! (k-c)!) l0^(i-a) l1^(j-b) l2^(k-c) c_ijk
     product                       (f g)_z = sum_(x+y=z) [n!/x!] [m!/y!] / [(n+m)!/z!] f_x g_y,   x! = x0! x1! x2!
                                                                                             [Farin 2002, ch. 17] */
#include "math/triangle.h"
#include "math/bernstein.h"

#include <string.h>

/* n! / (i! j! k!) */
static double multinomial(int32_t i, int32_t j, int32_t k) { return fs_binomial(i + j + k, i) * fs_binomial(j + k, j); }

/* power[e] = d-th derivative of x^e / (what the multinomial lacks), e = 0 .. n: e! / (e - d)! x^(e - d) */
static void powers(int32_t n, double x, int32_t d, double *power) {
  double value = 1;
  for (int32_t e = 0; e <= n; e++) {
    double falling = 1;
    for (int32_t f = 0; f < d; f++) falling *= e - f;
    power[e] = falling * value;
    if (e >= d) value *= x;
  }
}

void fs_triangle_evaluate(int32_t n, int32_t width, const double *c, const double l[3], const int32_t d[3],
                          double *value) {
  double power[3][FS_MAX_TRIANGLE_DEGREE + 1];
  for (int v = 0; v < 3; v++) powers(n, l[v], d[v], power[v]);
  memset(value, 0, (size_t)width * sizeof *value);
  for (int32_t k = 0; k <= n; k++)
    for (int32_t j = 0; j <= n - k; j++) {
      int32_t i = n - j - k;
      double weight = multinomial(i, j, k) * power[0][i] * power[1][j] * power[2][k];
      const double *point = c + fs_triangle_index(n, j, k) * width;
      for (int32_t w = 0; w < width; w++) value[w] += weight * point[w];
    }
}

void fs_triangle_add_product(int32_t n, const double *a, int32_t m, int32_t width, const double *b, double *out) {
  for (int32_t k = 0; k <= n; k++)
    for (int32_t j = 0; j <= n - k; j++) {
      double factor = a[fs_triangle_index(n, j, k)] * multinomial(n - j - k, j, k);
      if (factor == 0) continue;
      for (int32_t r = 0; r <= m; r++)
        for (int32_t q = 0; q <= m - r; q++) {
          double weight = factor * multinomial(m - q - r, q, r) / multinomial(n + m - j - q - k - r, j + q, k + r);
          const double *from = b + fs_triangle_index(m, q, r) * width;
          double *to = out + fs_triangle_index(n + m, j + q, k + r) * width;
          for (int32_t w = 0; w < width; w++) to[w] += weight * from[w];
        }
    }
}

void fs_triangle_elevate(int32_t n, int32_t width, const double *c, int32_t to, double *out) {
  double one[(FS_MAX_TRIANGLE_DEGREE + 1) * (FS_MAX_TRIANGLE_DEGREE + 2) / 2];
  for (int32_t i = 0; i < fs_triangle_size(to - n); i++) one[i] = 1;
  memset(out, 0, (size_t)(fs_triangle_size(to) * width) * sizeof *out);
  fs_triangle_add_product(to - n, one, n, width, c, out);
}

void fs_triangle_of_coordinate(int32_t n, const double *f, int32_t corner, double *out) {
  for (int32_t k = 0; k <= n; k++)
    for (int32_t j = 0; j <= n - k; j++) {
      const int32_t e[3] = {n - j - k, j, k};
      out[fs_triangle_at(e)] = f[e[corner]];
    }
}

void fs_triangle_edge_rows(int32_t n, int32_t width, const double *c, int32_t k, double *row0, double *row1) {
  for (int32_t m = 0; m <= n; m++) {
    int32_t e[3];
    e[k] = 0, e[(k + 1) % 3] = m, e[(k + 2) % 3] = n - m;
    memcpy(row0 + m * width, c + fs_triangle_at(e) * width, (size_t)width * sizeof *c);
    if (m == n) break;
    e[k] = 1, e[(k + 2) % 3] = n - 1 - m;
    memcpy(row1 + m * width, c + fs_triangle_at(e) * width, (size_t)width * sizeof *c);
  }
}
