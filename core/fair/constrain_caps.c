/* SPDX-License-Identifier: MIT */
/* Single role: inner coefficients of caps under a mirror symmetry. They are vectors, and those of the image of a cap are
   M R c (space/symmetry.h), R the reflection of vectors. M maps sets of coefficients onto sets: the smooth ones of a cap,
   and the local ones of each of its sectors.

     a set and another one, its image      c = z,  image = M R z
     a set that is its own image           c = V+ a + V- b,  M V+ = V+,  M V- = -V-:  a along the plane, b along its normal */
#include "fair/constrain.h"
#include "math/dense.h"
#include "math/vec3.h"
#include "space/symmetry.h"

#include <math.h>
#include <string.h>

enum { N_LOCAL = 16 };

typedef struct caps {
  const fs_space *space;
  const fs_symmetry *symmetry;
  int32_t *first;     /* [n_caps] elements of sectors 0 */
  int32_t *column_of; /* [n_dofs] of z, for dofs that are c = z */
  double *M;          /* of the cap that is being made */
} caps;

/* A set of inner coefficients of a cap, numbered from the first of the cap. */
typedef struct set {
  int32_t start, n;
} set;

static set set_of(const fs_cap *cap, int32_t number) { /* 0: the smooth ones, 1 + s: those of sector s */
  int32_t n_local = cap->n_dofs > N_LOCAL * cap->valence ? N_LOCAL : 0, n_smooth = cap->n_dofs - n_local * cap->valence;
  return number == 0 ? (set){0, n_smooth} : (set){n_smooth + n_local * (number - 1), n_local};
}

static int32_t find_cap(const fs_space *space, int32_t vertex) {
  int32_t low = 0, high = space->n_caps;
  while (low < high) {
    int32_t middle = low + (high - low) / 2;
    if (space->cap[middle].vertex < vertex)
      low = middle + 1;
    else
      high = middle;
  }
  return low < space->n_caps && space->cap[low].vertex == vertex ? low : FS_NONE;
}

static int32_t image_of_set(const caps *k, int32_t cap, int32_t image, int32_t number) {
  return number == 0 ? 0 : 1 + k->symmetry->element[k->first[cap] + number - 1] - k->first[image];
}

/* Row i of a set whose image it is: sum over j of M_ij R z_j; M is that of the cap from. */
static fs_status add_image_row(fs_map_builder *b, const caps *k, const fs_cap *from, set original, int32_t i) {
  fs_status status = FS_OK;
  fs_vec3 n = k->symmetry->normal;
  const double normal[3] = {n.x, n.y, n.z};
  for (int32_t j = original.start; j < original.start + original.n; j++) {
    double weight = k->M[(size_t)i * (size_t)from->n_dofs + (size_t)j], block[9];
    if (fabs(weight) < 1e-12) continue;
    for (int a = 0; a < 9; a++) block[a] = weight * ((a / 3 == a % 3) - 2 * normal[a / 3] * normal[a % 3]);
    FS_TRY(fs_map_add(b, k->column_of[from->first_dof + j], block));
  }
done:
  return status;
}

/* V[n_found][m] = orthonormal solutions of M v = sign v for the block of M that belongs to a set. */
static fs_status eigenvectors(fs_context *ctx, const caps *k, int32_t n_dofs, set of, double sign, int32_t n_found,
                              double *V) {
  fs_status status = FS_OK;
  double *A = NULL;
  FS_ALLOC(ctx, A, (size_t)of.n * (size_t)of.n);
  for (int32_t i = 0; i < of.n; i++)
    for (int32_t j = 0; j < of.n; j++)
      A[i * of.n + j] = k->M[(size_t)(of.start + i) * (size_t)n_dofs + (size_t)(of.start + j)] - (i == j ? sign : 0);
  if (n_found > 0) FS_TRY(fs_dense_null_space(ctx, of.n, of.n, A, of.n - n_found, V));
done:
  fs_release(ctx, A);
  return status;
}

/* The coefficients of a set that is its own image. */
static fs_status add_own_image(fs_map_builder *b, const caps *k, const fs_cap *cap, set of) {
  fs_status status = FS_OK;
  fs_base *base = b->base;
  fs_reduction *map = base->map;
  double trace = 0, *even = NULL, *odd = NULL; /* V+[n_even][n], V-[n_odd][n] */
  int32_t n = of.n, n_even, n_odd, n_columns, first = map->n_columns;
  fs_vec3 t[2], normal = k->symmetry->normal;
  for (int32_t i = of.start; i < of.start + n; i++) trace += k->M[(size_t)i * (size_t)cap->n_dofs + (size_t)i];
  n_even = (int32_t)lround((n + trace) / 2);
  n_odd = n - n_even;
  n_columns = n_even > n_odd ? n_even : n_odd;
  FS_ALLOC(b->ctx, even, n_even * n);
  FS_ALLOC(b->ctx, odd, n_odd * n);
  FS_TRY(eigenvectors(b->ctx, k, cap->n_dofs, of, 1, n_even, even));
  FS_TRY(eigenvectors(b->ctx, k, cap->n_dofs, of, -1, n_odd, odd));
  fs_tangents(normal, t);
  map->n_columns += n_columns;
  for (int32_t j = 0; j < n_columns; j++) {
    double *z = base->z + 3 * (size_t)(first + j);
    bool *is_idle = map->is_idle + 3 * (size_t)(first + j);
    is_idle[0] = is_idle[1] = j >= n_even;
    is_idle[2] = j >= n_odd;
    for (int32_t i = 0; i < n; i++) {
      fs_vec3 c = base->c[cap->first_dof + of.start + i];
      if (j < n_even) z[0] += even[j * n + i] * fs_vec3_dot(t[0], c), z[1] += even[j * n + i] * fs_vec3_dot(t[1], c);
      if (j < n_odd) z[2] += odd[j * n + i] * fs_vec3_dot(normal, c);
    }
  }
  for (int32_t i = 0; i < n; i++) {
    for (int32_t j = 0; j < n_columns; j++) {
      double p = j < n_even ? even[j * n + i] : 0, q = j < n_odd ? odd[j * n + i] : 0;
      const double block[9] = {p * t[0].x,   p * t[1].x, q * normal.x, p * t[0].y,  p * t[1].y,
                               q * normal.y, p * t[0].z, p * t[1].z,   q * normal.z};
      FS_TRY(fs_map_add(b, first + j, block));
    }
    fs_map_end_row(b);
  }
done:
  fs_release(b->ctx, even);
  fs_release(b->ctx, odd);
  return status;
}

static fs_status add_free(fs_map_builder *b, caps *k, const fs_cap *cap, set of) {
  static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  fs_status status = FS_OK;
  fs_base *base = b->base;
  for (int32_t d = cap->first_dof + of.start; d < cap->first_dof + of.start + of.n; d++) {
    int32_t column = base->map->n_columns++;
    memcpy(base->z + 3 * (size_t)column, &base->c[d], sizeof base->c[d]);
    k->column_of[d] = column;
    FS_TRY(fs_map_add(b, column, unit));
    fs_map_end_row(b);
  }
done:
  return status;
}

/* Coefficients that stay: those of the start where the cap comes first, else their images. */
static void add_constant(fs_map_builder *b, const caps *k, const fs_cap *cap, const fs_cap *from) {
  fs_base *base = b->base;
  for (int32_t i = 0; i < cap->n_dofs; i++) {
    fs_vec3 *c = &base->c[cap->first_dof + i];
    if (cap != from) *c = (fs_vec3){0, 0, 0};
    for (int32_t j = 0; j < from->n_dofs && cap != from; j++) {
      fs_vec3 p = base->c[from->first_dof + j];
      p = fs_vec3_add_scaled(p, k->symmetry->normal, -2 * fs_vec3_dot(k->symmetry->normal, p));
      *c = fs_vec3_add_scaled(*c, p, k->M[i * from->n_dofs + j]);
    }
    base->is_constant[cap->first_dof + i] = true;
    memcpy(base->map->x0 + 3 * (size_t)(cap->first_dof + i), c, sizeof *c);
    fs_map_end_row(b);
  }
}

static int32_t count_fixed(const fs_cap *cap, const bool *fixed) {
  int32_t n = 0;
  for (int32_t i = 0; fixed != NULL && i < cap->n_dofs; i++) n += fixed[cap->first_dof + i];
  return n;
}

static fs_status add_cap(fs_map_builder *b, caps *k, const bool *fixed, int32_t number, int32_t image) {
  fs_status status = FS_OK;
  const fs_cap *cap = &k->space->cap[number], *other = &k->space->cap[image];
  const fs_cap *from = image < number ? other : cap; /* the one whose coefficients are z */
  int32_t n_fixed = count_fixed(cap, fixed), n_other = count_fixed(other, fixed);
  int32_t n_sets = cap->n_dofs > N_LOCAL * cap->valence ? 1 + cap->valence : 1;
  if ((n_fixed > 0 && n_fixed < cap->n_dofs) || (n_other > 0 && n_other < other->n_dofs))
    return fs_fail(b->ctx, FS_ERR_UNSUPPORTED,
                   "with a symmetry the cap of vertex %d has all inner coefficients fixed or none", cap->vertex);
  FS_ALLOC(b->ctx, k->M, (size_t)cap->n_dofs * (size_t)cap->n_dofs);
  if (image <= number) FS_TRY(fs_symmetry_cap(b->ctx, k->space, k->symmetry, k->first, image, number, k->M));
  if (n_fixed > 0 || n_other > 0) {
    add_constant(b, k, cap, from);
    goto done;
  }
  for (int32_t i = 0; i < n_sets; i++) {
    set of = set_of(cap, i);
    int32_t j = image_of_set(k, number, image, i);
    if (image > number || (image == number && j > i)) {
      FS_TRY(add_free(b, k, cap, of));
    } else if (image == number && i == j) {
      FS_TRY(add_own_image(b, k, cap, of));
    } else {
      for (int32_t row = of.start; row < of.start + of.n; row++) {
        FS_TRY(add_image_row(b, k, from, set_of(from, j), row));
        fs_map_end_row(b);
      }
    }
  }
done:
  fs_release(b->ctx, k->M);
  k->M = NULL;
  return status;
}

fs_status fs_base_add_caps(fs_map_builder *b, const fs_space *space, const bool *fixed, const fs_symmetry *symmetry) {
  fs_status status = FS_OK;
  caps k = {.space = space, .symmetry = symmetry};
  FS_ALLOC(b->ctx, k.first, space->n_caps);
  FS_ALLOC(b->ctx, k.column_of, space->n_dofs);
  fs_cap_elements(space, k.first);
  for (int32_t i = 0; i < space->n_caps; i++) {
    int32_t image = find_cap(space, symmetry->vertex[space->cap[i].vertex]);
    if (space->cap[i].n_dofs == 0) continue;
    if (image == FS_NONE || space->cap[image].n_dofs != space->cap[i].n_dofs) {
      status = fs_fail(b->ctx, FS_ERR_ARGUMENT, "the cap of vertex %d and that of its image differ in kind",
                       space->cap[i].vertex);
      goto done;
    }
    FS_TRY(add_cap(b, &k, fixed, i, image));
  }
done:
  fs_release(b->ctx, k.first);
  fs_release(b->ctx, k.column_of);
  return status;
}
