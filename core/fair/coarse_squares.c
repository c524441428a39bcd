/* SPDX-License-Identifier: MIT */
/* Single role: finds the squares of a coarser mesh within which displacements are bicubic B-splines.

   Refined depth times, a uniform bicubic B-spline has 2^depth + 3 rows of dofs over a square, each a combination of four rows of
   the coarse net, the same for u and v. Going from one depth to the next, with m the position in half steps of the old rows:
     row (m even) = (old - 1 + 6 old + old + 1) / 8,   row (m odd) = (old + next) / 2. */
#include "fair/coarse.h"
#include "fair/coarse_squares.h"

#include <math.h>
#include <string.h>

static const double rounding = 1e-12; /* of weights, which are products of fractions of 8 */

void fs_coarse_squares_free(fs_context *ctx, fs_coarse_squares *q) {
  if (q == NULL) return;
  fs_release(ctx, q->unknown);
  fs_release(ctx, q->element);
  fs_release(ctx, q->turn);
  fs_release(ctx, q->loose);
  fs_release(ctx, q->mask);
  fs_release(ctx, q);
}

static void fill_mask(int32_t depth, double (*mask)[4]) {
  enum { MAX_OLD = (1 << (FS_MAX_COARSE - 1)) + 3 };
  double old[MAX_OLD][4];
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) mask[i][j] = i == j;
  for (int32_t side = 1; side < 1 << depth; side *= 2) {
    memcpy(old, mask, ((size_t)side + 3) * sizeof *old);
    for (int32_t k = 0; k < 2 * side + 3; k++) { /* row 1 stays where it is: m = k - 1 */
      const double(*at)[4] = (const double(*)[4]) & old[(k + 1) / 2];
      for (int i = 0; i < 4; i++)
        mask[k][i] = k % 2 == 1 ? (at[-1][i] + 6 * at[0][i] + at[1][i]) / 8 : (at[0][i] + at[1][i]) / 2;
    }
  }
}

/* ---- walking ----------------------------------------------------------------------------------------------------- */

/* Across the end of h, straight on, if the vertex there is interior and has four quadrilaterals; else FS_NONE. */
static int32_t step(const fs_mesh *mesh, int32_t h) {
  int32_t vertex = fs_mesh_target(mesh, h);
  if (fs_mesh_is_boundary(mesh, vertex) || fs_mesh_valence(mesh, vertex) != 4) return FS_NONE;
  return fs_mesh_next(mesh, mesh->twin[fs_mesh_next(mesh, h)]);
}

/* The half-edge that leaves `from` and gets to `to` in so many steps; or FS_NONE. */
static int32_t find_way(const fs_mesh *mesh, int32_t from, int32_t to, int32_t n_steps) {
  int32_t h = mesh->outgoing[from];
  if (fs_mesh_is_boundary(mesh, from) || fs_mesh_valence(mesh, from) != 4) return FS_NONE;
  for (int k = 0; k < 4; k++, h = fs_mesh_rotate(mesh, h)) {
    int32_t g = h;
    for (int32_t i = 1; i < n_steps && g != FS_NONE; i++) g = step(mesh, g);
    if (g != FS_NONE && fs_mesh_target(mesh, g) == to) return h;
  }
  return FS_NONE;
}

typedef struct finder {
  const fs_problem *problem;
  const fs_mesh *mesh;
  const int32_t *origin, *number;
  const fs_reduction *reduction;
  const int32_t *element_of_face; /* regular ones */
  double *row;                    /* [n_columns] zeros in between */
} finder;

/* The elements of the square of the coarse half-edge h, and their turns. */
static bool collect_elements(const finder *f, const fs_mesh *coarse, int32_t h, fs_coarse_squares *q) {
  const fs_mesh *m = f->mesh;
  int32_t *element = q->element + (size_t)q->n * (size_t)(q->n_side * q->n_side);
  uint8_t *turn = q->turn + (size_t)q->n * (size_t)(q->n_side * q->n_side);
  int32_t first = find_way(m, f->origin[coarse->origin[h]], f->origin[fs_mesh_target(coarse, h)], q->n_side);
  for (int32_t b = 0; b < q->n_side && first != FS_NONE; b++) {
    int32_t g = first;
    for (int32_t a = 0; a < q->n_side; a++, element++, turn++) {
      int32_t side = g;
      if (g == FS_NONE || f->element_of_face[m->face[g]] == FS_NONE) return false;
      *element = f->element_of_face[m->face[g]];
      for (*turn = 0; side != f->problem->space->element[*element].halfedge; ++*turn) side = fs_mesh_next(m, side);
      if (a + 1 < q->n_side) g = fs_walk_right(m, g); /* regular elements are surrounded by quadrilaterals */
    }
    if (b + 1 < q->n_side) first = fs_walk_up(m, first);
  }
  return first != FS_NONE;
}

/* Whether the dofs of its elements are combinations of the unknowns of the square as they should be. */
static bool are_rows_regular(const finder *f, const fs_coarse_squares *q) {
  const fs_problem *p = f->problem;
  const fs_reduction *r = f->reduction;
  const int32_t *unknown = q->unknown[q->n];
  bool is_regular = true;
  for (int32_t e = 0; e < q->n_side * q->n_side && is_regular; e++) {
    size_t at = (size_t)q->n * (size_t)(q->n_side * q->n_side) + (size_t)e;
    const int32_t *dof = p->space->dof + p->space->element[q->element[at]].dof_start;
    for (int32_t place = 0; place < 16 && is_regular; place++) {
      const double *u = q->mask[e % q->n_side + place % 4], *v = q->mask[e / q->n_side + place / 4];
      int32_t i = p->unknown[dof[fs_turned_place(place, q->turn[at])]];
      if (i == FS_NONE) return false;
      for (int32_t k = r->row_start[i]; k < r->row_start[i + 1]; k++) f->row[r->column[k]] += r->weight[k];
      for (int k = 0; k < 16; k++)
        if (unknown[k] != FS_NONE) f->row[unknown[k]] -= u[k % 4] * v[k / 4];
      for (int32_t k = r->row_start[i]; k < r->row_start[i + 1]; k++) {
        if (fabs(f->row[r->column[k]]) > rounding) is_regular = false;
        f->row[r->column[k]] = 0;
      }
      for (int k = 0; k < 16; k++) {
        if (unknown[k] == FS_NONE) continue;
        if (fabs(f->row[unknown[k]]) > rounding) is_regular = false;
        f->row[unknown[k]] = 0;
      }
    }
  }
  return is_regular;
}

/* ---- the squares ------------------------------------------------------------------------------------------------- */

static fs_status find_squares(finder *f, const fs_mesh *coarse, fs_coarse_squares *q) {
  fs_status status = FS_OK;
  fs_context *ctx = f->problem->ctx;
  const fs_space *space = f->problem->space;
  size_t n_elements = (size_t)(q->n_side * q->n_side);
  bool *is_in = NULL;
  FS_ALLOC(ctx, is_in, space->n_elements);
  for (int32_t face = 0; face < coarse->n_faces; face++) {
    int32_t net[16], h = coarse->face_start[face];
    bool has_unknown = false;
    if (!fs_face_is_regular(coarse, face) || !collect_elements(f, coarse, h, q)) continue;
    fs_collect_net(coarse, h, net);
    for (int k = 0; k < 16; k++) {
      q->unknown[q->n][k] = f->number[net[k]];
      has_unknown |= f->number[net[k]] != FS_NONE;
    }
    if (!has_unknown || !are_rows_regular(f, q)) continue;
    for (size_t e = 0; e < n_elements; e++) is_in[q->element[(size_t)q->n * n_elements + e]] = true;
    q->n++;
  }
  for (int32_t e = 0; e < space->n_elements; e++) q->n_loose += !is_in[e];
  FS_ALLOC(ctx, q->loose, q->n_loose);
  for (int32_t e = 0, n = 0; e < space->n_elements; e++)
    if (!is_in[e]) q->loose[n++] = e;
done:
  fs_release(ctx, is_in);
  return status;
}

fs_status fs_coarse_squares_find(const fs_problem *p, const fs_mesh *mesh, const fs_mesh *coarse, int32_t depth,
                                 const int32_t *origin, const int32_t *number, const fs_reduction *reduction,
                                 fs_coarse_squares **squares) {
  fs_status status = FS_OK;
  fs_context *ctx = p->ctx;
  fs_coarse_squares *q = NULL;
  int32_t *element_of_face = NULL;
  finder f = {p, mesh, origin, number, reduction, NULL, NULL};
  FS_ALLOC(ctx, q, 1);
  q->n_side = 1 << depth;
  FS_ALLOC(ctx, q->mask, (size_t)q->n_side + 3);
  fill_mask(depth, q->mask);
  FS_ALLOC(ctx, q->unknown, coarse->n_faces);
  FS_ALLOC(ctx, q->element, (size_t)coarse->n_faces * (size_t)(q->n_side * q->n_side));
  FS_ALLOC(ctx, q->turn, (size_t)coarse->n_faces * (size_t)(q->n_side * q->n_side));
  FS_ALLOC(ctx, element_of_face, mesh->n_faces);
  for (int32_t i = 0; i < mesh->n_faces; i++) element_of_face[i] = FS_NONE;
  for (int32_t e = 0; e < p->space->n_elements; e++) {
    const fs_element *element = &p->space->element[e];
    const fs_extraction *x = &p->space->extraction[element->extraction];
    if (x->segment != NULL && x->n_dofs == 16 && x->chart == NULL) element_of_face[element->face] = e;
  }
  f.element_of_face = element_of_face;
  FS_ALLOC(ctx, f.row, reduction->n_columns);
  FS_TRY(find_squares(&f, coarse, q));
  *squares = q;
  q = NULL;
done:
  fs_release(ctx, element_of_face);
  fs_release(ctx, f.row);
  fs_coarse_squares_free(ctx, q);
  return status;
}
