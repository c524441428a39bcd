/* SPDX-License-Identifier: MIT */
/* Single role: the chain rule between the derivatives at a block of points and the dofs of an element (kernels.h). */
#include "fair/lanes.h"
#include "fair/kernels.h"

void FS_KERNEL(fs_jets)(int32_t m, const double *table, const double *c, double *x) {
  for (int i = 0; i < N_DERIVATIVES; i++)
    for (int l = 0; l < FS_BLOCK; l += FS_LANES) {
      const double *t = table + (size_t)i * m * FS_BLOCK + l;
      lanes x0 = {0}, x1 = {0}, x2 = {0};
      for (int32_t k = 0; k < m; k++) {
        lanes basis = lanes_load(t + (size_t)k * FS_BLOCK);
        x0 += basis * c[3 * k];
        x1 += basis * c[3 * k + 1];
        x2 += basis * c[3 * k + 2];
      }
      lanes_store(x + (3 * i + 0) * FS_BLOCK + l, x0);
      lanes_store(x + (3 * i + 1) * FS_BLOCK + l, x1);
      lanes_store(x + (3 * i + 2) * FS_BLOCK + l, x2);
    }
}

void FS_KERNEL(fs_add_scaled)(int32_t n, const double *scale, const double *from, bool is_first, double *to) {
  for (int l = 0; l < FS_BLOCK; l += FS_LANES) {
    lanes factor = lanes_load(scale + l);
    for (int32_t i = l; i < n * FS_BLOCK; i += FS_BLOCK) {
      lanes x = factor * lanes_load(from + i);
      lanes_store(to + i, is_first ? x : lanes_load(to + i) + x);
    }
  }
}

void FS_KERNEL(fs_gradient)(int32_t m, const double *table, const double *df, double *g) {
  for (int32_t k = 0; k < m; k++) {
    lanes g0 = {0}, g1 = {0}, g2 = {0};
    for (int i = 0; i < N_DERIVATIVES; i++)
      for (int l = 0; l < FS_BLOCK; l += FS_LANES) {
        lanes basis = lanes_load(table + ((size_t)i * m + k) * FS_BLOCK + l);
        g0 += basis * lanes_load(df + (3 * i + 0) * FS_BLOCK + l);
        g1 += basis * lanes_load(df + (3 * i + 1) * FS_BLOCK + l);
        g2 += basis * lanes_load(df + (3 * i + 2) * FS_BLOCK + l);
      }
    g[3 * k] += lanes_sum(g0);
    g[3 * k + 1] += lanes_sum(g1);
    g[3 * k + 2] += lanes_sum(g2);
  }
}

/* D[i][j] = the second derivatives by component a of derivative i and component b of derivative j, at point q. */
static inline void unpack(const double *ddf, int a, int b, int q, double (*D)[N_DERIVATIVES]) {
  for (int i = 0; i < N_DERIVATIVES; i++)
    for (int j = i; j < N_DERIVATIVES; j++) {
      const double *block = ddf + (size_t)pair_of(i, j) * 9 * FS_BLOCK + q;
      D[i][j] = block[(3 * a + b) * FS_BLOCK];
      D[j][i] = block[(3 * b + a) * FS_BLOCK];
    }
}

enum { TILE_ROWS = 4, TILE_COLUMNS = 2 * FS_LANES };

/* h[row .. row + 3][column .. ] += sum over r of left[r][row ..] right[r][column ..]; n_vectors of columns, 1 or 2. */
static inline __attribute__((always_inline)) void add_tile(int32_t m, int n_rows, int n_vectors, const double *left,
                                                           const double *right, double *h) {
  lanes sum[TILE_ROWS][2];
  for (int i = 0; i < TILE_ROWS; i++)
    for (int j = 0; j < n_vectors; j++) sum[i][j] = lanes_load(h + (size_t)i * m + j * FS_LANES);
  for (int r = 0; r < n_rows; r++) {
    lanes from[2];
    for (int j = 0; j < n_vectors; j++) from[j] = lanes_load(right + (size_t)r * m + j * FS_LANES);
    for (int i = 0; i < TILE_ROWS; i++) {
      double x = left[(size_t)r * m + i];
      for (int j = 0; j < n_vectors; j++) sum[i][j] += x * from[j];
    }
  }
  for (int i = 0; i < TILE_ROWS; i++)
    for (int j = 0; j < n_vectors; j++) lanes_store(h + (size_t)i * m + j * FS_LANES, sum[i][j]);
}

/* DN[q][i][m] = sum over j of D_q[i][j] N[q][j][m] */
static inline void times_basis(int32_t m, double (*D)[N_DERIVATIVES], const double *N, double *DN) {
  for (int32_t k = 0; k < m; k += FS_LANES) {
    lanes basis[N_DERIVATIVES];
    for (int j = 0; j < N_DERIVATIVES; j++) basis[j] = lanes_load(N + (size_t)j * m + k);
    for (int i = 0; i < N_DERIVATIVES; i++) {
      lanes sum = D[i][0] * basis[0];
      for (int j = 1; j < N_DERIVATIVES; j++) sum += D[i][j] * basis[j];
      lanes_store(DN + (size_t)i * m + k, sum);
    }
  }
}

enum { MAX_DOFS = 240, N_ROWS = FS_BLOCK * N_DERIVATIVES };

void FS_KERNEL(fs_hessian)(int32_t m, const double *by_point, const double *ddf, double *h) {
  static const signed char pairs[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  double DN[N_ROWS * MAX_DOFS] __attribute__((aligned(64))), D[N_DERIVATIVES][N_DERIVATIVES];
  for (int pair = 0; pair < 6; pair++) {
    int a = pairs[pair][0], b = pairs[pair][1];
    double *out = h + (size_t)pair * m * m;
    for (int q = 0; q < FS_BLOCK; q++) {
      size_t start = (size_t)q * N_DERIVATIVES * m;
      unpack(ddf, a, b, q, D);
      times_basis(m, D, by_point + start, DN + start);
    }
    for (int32_t row = 0; row < m; row += TILE_ROWS)
      for (int32_t column = 0; column < m; column += TILE_COLUMNS) {
        if (a == b && column + TILE_COLUMNS <= row) continue; /* below the diagonal of a symmetric matrix */
        double *tile = out + (size_t)row * m + column;
        if (column + TILE_COLUMNS <= m)
          add_tile(m, N_ROWS, 2, by_point + row, DN + column, tile);
        else /* m is a multiple of 8: half a tile of the widest vectors is left */
          add_tile(m, N_ROWS, 1, by_point + row, DN + column, tile);
      }
  }
}

/* out[n_rows][n] = A B for A[n_rows][m], whose element (i, j) is at i * by_row + j * by_column, and B[m][n], n a multiple of 8;
   four rows of two vectors at once. */
static inline void multiply(int32_t n_rows, int32_t m, int32_t n, const double *A, size_t by_row, size_t by_column,
                            const double *B, double *out) {
  enum { ROWS = 4, VECTORS = FS_LANES == 8 ? 1 : 2 };
  for (int32_t first = 0; first < n_rows; first += ROWS)
    for (int32_t k = 0; k < n; k += VECTORS * FS_LANES) {
      lanes sum[ROWS][VECTORS] = {{{0}}};
      size_t row[ROWS]; /* beyond the end: the last one again */
      for (int i = 0; i < ROWS; i++) row[i] = (size_t)(first + i < n_rows ? first + i : n_rows - 1) * by_row;
      for (int32_t j = 0; j < m; j++) {
        const double *from = B + (size_t)j * (size_t)n + k, *a = A + (size_t)j * by_column;
        for (int v = 0; v < VECTORS; v++) {
          lanes b = lanes_load(from + v * FS_LANES);
          for (int i = 0; i < ROWS; i++) sum[i][v] += a[row[i]] * b;
        }
      }
      for (int i = 0; i < ROWS && first + i < n_rows; i++)
        for (int v = 0; v < VECTORS; v++)
          lanes_store(out + (size_t)(first + i) * (size_t)n + k + v * FS_LANES, sum[i][v]);
    }
}

/* work = h T, out = T^T work; lower triangles are filled in before where only the upper one is there. */
void FS_KERNEL(fs_congruence)(int32_t m, int32_t m_padded, int32_t n, const double *T, double *h, double *work,
                              double *out) {
  for (int pair = 0; pair < 6; pair++, h += (size_t)m_padded * m_padded, out += (size_t)n * n) {
    bool is_symmetric = pair == 0 || pair == 3 || pair == 5;
    for (int32_t i = 0; is_symmetric && i < m; i++)
      for (int32_t j = 0; j < i; j++) h[(size_t)i * m_padded + j] = h[(size_t)j * m_padded + i];
    multiply(m, m, n, h, (size_t)m_padded, 1, T, work);
    multiply(n, m, n, T, 1, (size_t)n, work, out);
  }
}
