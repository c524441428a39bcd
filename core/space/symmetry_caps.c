/* SPDX-License-Identifier: MIT */
/* Single role: the linear map between the inner coefficients of a cap and of its mirror image.

     A  Bezier points of the inner functions of the image cap, all sectors below each other
     B  those of the inner functions of the cap itself, its patches put where their images are
     A M = B, solved by least squares: M = (A^T A)^-1 A^T B, then improved twice by what is left,
     M += (A^T A)^-1 A^T (B - A M), since A^T A has the square of the condition of A. */
#include "math/dense.h"
#include "space/symmetry.h"

#include <math.h>

enum { N_POINTS = 100, LAST = 9 };

void fs_cap_elements(const fs_space *space, int32_t *first) {
  int32_t cap = 0;
  for (int32_t i = 0; i < space->n_elements && cap < space->n_caps; i++)
    if (space->extraction[space->element[i].extraction].valence != 4 &&
        space->dof[space->element[i].dof_start] == space->cap[cap].vertex) {
      first[cap] = i;
      i += space->cap[cap].valence - 1;
      cap++;
    }
}

/* The row of the point in the image that lies where point (i, j) of an element has its image. */
static int32_t image_row(int side, int32_t i, int32_t j) {
  switch (side) {
  case 0:
    return LAST - i + (LAST + 1) * j;
  case 1:
    return LAST - j + (LAST + 1) * (LAST - i);
  case 2:
    return i + (LAST + 1) * (LAST - j);
  default:
    return j + (LAST + 1) * i;
  }
}

/* Adds the rows of the inner functions of one element; row r of the element goes to row to[r] of matrix. */
static void add_rows(const fs_space *space, int32_t element, int32_t first_dof, const int32_t *to, int32_t n,
                     double *matrix) {
  const fs_element *e = &space->element[element];
  const fs_extraction *x = &space->extraction[e->extraction];
  for (int32_t r = 0; r < N_POINTS; r++)
    for (int32_t d = x->n_dofs - x->n_offsets; d < x->n_dofs; d++)
      matrix[(size_t)to[r] * (size_t)n + (size_t)(space->dof[e->dof_start + d] - first_dof)] = x->E[r * x->n_dofs + d];
}

static void fill(const fs_space *space, const fs_symmetry *s, const int32_t *first, int32_t cap, int32_t image,
                 double *A, double *B) {
  const fs_cap *from = &space->cap[cap], *onto = &space->cap[image];
  int32_t to[N_POINTS], n = from->n_dofs;
  for (int32_t sector = 0; sector < from->valence; sector++) {
    int32_t e = first[cap] + sector, place = N_POINTS * (s->element[e] - first[image]);
    for (int32_t r = 0; r < N_POINTS; r++) to[r] = N_POINTS * sector + r;
    add_rows(space, first[image] + sector, onto->first_dof, to, n, A);
    for (int32_t r = 0; r < N_POINTS; r++) to[r] = place + image_row(s->side[e], r % (LAST + 1), r / (LAST + 1));
    add_rows(space, e, from->first_dof, to, n, B);
  }
}

fs_status fs_symmetry_cap(fs_context *ctx, const fs_space *space, const fs_symmetry *s, const int32_t *first,
                          int32_t cap, int32_t image, double *M) {
  fs_status status = FS_OK;
  int32_t n = space->cap[cap].n_dofs, rows = N_POINTS * space->cap[cap].valence;
  double *A = NULL, *B = NULL, *R = NULL, *X = NULL, left = 0, largest = 0;
  if (space->cap[image].n_dofs != n || space->cap[image].valence != space->cap[cap].valence)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the caps of vertex %d and of its mirror image, vertex %d, differ in kind",
                   space->cap[cap].vertex, space->cap[image].vertex);
  FS_ALLOC(ctx, A, (size_t)rows * (size_t)n);
  FS_ALLOC(ctx, B, (size_t)rows * (size_t)n);
  FS_ALLOC(ctx, R, (size_t)n * (size_t)n);
  FS_ALLOC(ctx, X, (size_t)n * (size_t)n);
  fill(space, s, first, cap, image, A, B);
  for (int64_t i = 0; i < (int64_t)rows * n; i++) largest = fmax(largest, fabs(B[i]));
  fs_dense_add_gram(rows, n, A, n, 1, R, n);
  FS_TRY(fs_dense_cholesky(ctx, n, R, n));
  for (int32_t i = 0; i < n * n; i++) M[i] = 0;
  for (int pass = 0; pass < 3; pass++) { /* B holds what is left */
    for (int32_t i = 0; i < n * n; i++) X[i] = 0;
    fs_dense_add_product_transposed(n, rows, n, 1, A, n, B, n, X, n);
    fs_dense_solve_transposed(n, R, n, n, X, n);
    fs_dense_solve_upper(n, R, n, n, X, n);
    for (int32_t i = 0; i < n * n; i++) M[i] += X[i];
    fs_dense_add_product(rows, n, n, -1, A, n, X, n, B, n);
  }
  for (int64_t i = 0; i < (int64_t)rows * n; i++) left = fmax(left, fabs(B[i]));
  if (!(left <= 1e-9 * largest))
    status = fs_fail(ctx, FS_ERR_NUMERIC, "the inner functions of the cap of vertex %d have no mirror images",
                     space->cap[cap].vertex);
done:
  fs_release(ctx, A);
  fs_release(ctx, B);
  fs_release(ctx, R);
  fs_release(ctx, X);
  return status;
}
