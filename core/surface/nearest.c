/* SPDX-License-Identifier: MIT */
/* Single role: nearest points of surfaces and meshes. A tree of triangles gives the place to begin; on a surface the
   distance is then minimised over the parameters, and over those of the next patch where the minimum lies on a side:

     f(u, v) = |p(u, v) - q|^2 / 2,   f_a = r . p_a,   f_ab = p_a . p_b + r . p_ab,   r = p - q,

   by Newton steps, without the second part of f_ab where that is not positive definite, halved until f falls. */
#include "surface/nearest_tree.h"
#include "surface/surface.h"
#include "math/vec3.h"

#include <string.h>

enum { N_STEPS = 4, MAX_NEWTON = 40, MAX_HALVINGS = 30, MAX_PATCHES = 8 };

struct fs_nearest {
  const fs_surface *surface; /* NULL: a mesh */
  fs_tree *tree;
};

/* ---- triangles --------------------------------------------------------------------------------------------------- */

static fs_piece make_piece(const fs_vec3 (*at)[N_STEPS + 1], const int (*ij)[2], int32_t patch) {
  fs_piece piece = {.patch = patch};
  for (int k = 0; k < 3; k++) {
    piece.corner[k] = at[ij[k][1]][ij[k][0]];
    piece.uv[k][0] = (double)ij[k][0] / N_STEPS;
    piece.uv[k][1] = (double)ij[k][1] / N_STEPS;
  }
  return piece;
}

/* Adds the triangles of a patch; *n counts them. */
static fs_status add_patch(fs_context *ctx, const fs_surface *surface, int32_t patch, fs_piece *piece, int32_t *n) {
  fs_vec3 at[N_STEPS + 1][N_STEPS + 1], x[FS_JET_SIZE];
  int n_sides = surface->patch[patch].n_sides;
  memset(at, 0, sizeof at);
  for (int j = 0; j <= N_STEPS; j++)
    for (int i = 0; i <= (n_sides == 4 ? N_STEPS : N_STEPS - j); i++) {
      fs_surface_evaluate(surface, patch, (double)i / N_STEPS, (double)j / N_STEPS, x);
      if (!fs_vec3_is_finite(x[FS_D]))
        return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)patch);
      at[j][i] = x[FS_D];
    }
  for (int j = 0; j < N_STEPS; j++)
    for (int i = 0; i < (n_sides == 4 ? N_STEPS : N_STEPS - j); i++) {
      const int low[3][2] = {{i, j}, {i + 1, j}, {i, j + 1}}, high[3][2] = {{i + 1, j}, {i + 1, j + 1}, {i, j + 1}};
      piece[(*n)++] = make_piece((const fs_vec3(*)[N_STEPS + 1]) at, low, patch);
      if (n_sides == 4 || i + j + 2 <= N_STEPS)
        piece[(*n)++] = make_piece((const fs_vec3(*)[N_STEPS + 1]) at, high, patch);
    }
  return FS_OK;
}

fs_status fs_nearest_create(fs_context *ctx, const fs_surface *surface, fs_nearest **nearest) {
  fs_status status = FS_OK;
  fs_nearest *made = NULL;
  fs_piece *piece = NULL;
  int32_t n = 0;
  if (surface->n_patches < 1 || surface->n_patches > INT32_MAX / (4 * N_STEPS * N_STEPS))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "nearest points of %d patches cannot be found", (int)surface->n_patches);
  FS_ALLOC(ctx, made, 1);
  made->surface = surface;
  FS_ALLOC(ctx, piece, 2 * N_STEPS * N_STEPS * (size_t)surface->n_patches);
  for (int32_t i = 0; i < surface->n_patches; i++) FS_TRY(add_patch(ctx, surface, i, piece, &n));
  status = fs_tree_create(ctx, n, piece, &made->tree);
  piece = NULL;
  if (status != FS_OK) goto done;
  *nearest = made;
  made = NULL;
done:
  fs_release(ctx, piece);
  fs_nearest_free(ctx, made);
  return status;
}

fs_status fs_nearest_create_for_mesh(fs_context *ctx, const fs_mesh *mesh, fs_nearest **nearest) {
  fs_status status = FS_OK;
  fs_nearest *made = NULL;
  fs_piece *piece = NULL;
  int32_t n = 0;
  if (mesh->n_halfedges - 2 * mesh->n_faces > INT32_MAX / 4 || mesh->n_faces < 1)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "nearest points of %d faces cannot be found", mesh->n_faces);
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, piece, (size_t)(mesh->n_halfedges - 2 * mesh->n_faces));
  for (int32_t f = 0; f < mesh->n_faces; f++)
    for (int32_t h = mesh->face_start[f] + 1; h + 1 < mesh->face_start[f + 1]; h++)
      piece[n++] = (fs_piece){.corner = {mesh->position[mesh->origin[mesh->face_start[f]]],
                                         mesh->position[mesh->origin[h]], mesh->position[mesh->origin[h + 1]]},
                              .patch = f};
  status = fs_tree_create(ctx, n, piece, &made->tree);
  piece = NULL;
  if (status != FS_OK) goto done;
  *nearest = made;
  made = NULL;
done:
  fs_release(ctx, piece);
  fs_nearest_free(ctx, made);
  return status;
}

void fs_nearest_free(fs_context *ctx, fs_nearest *nearest) {
  if (nearest == NULL) return;
  fs_tree_free(ctx, nearest->tree);
  fs_release(ctx, nearest);
}

/* ---- minimum over a patch ---------------------------------------------------------------------------------------- */

/* Where a search stands. */
typedef struct place {
  int32_t patch;
  double u, v, f; /* half the squared distance */
  fs_vec3 x[FS_JET_SIZE];
} place;

static void set_place(const fs_surface *surface, fs_vec3 q, int32_t patch, double u, double v, place *at) {
  fs_vec3 r;
  at->patch = patch, at->u = u, at->v = v;
  fs_surface_evaluate(surface, patch, u, v, at->x);
  r = fs_vec3_sub(at->x[FS_D], q);
  at->f = 0.5 * fs_vec3_dot(r, r);
}

/* The nearest parameters in the domain. */
static void clamp(int32_t n_sides, double *u, double *v) {
  *u = fmin(fmax(*u, 0), 1);
  *v = fmin(fmax(*v, 0), 1);
  if (n_sides == 3 && *u + *v > 1) {
    double excess = 0.5 * (*u + *v - 1);
    *u = fmin(fmax(*u - excess, 0), 1);
    *v = 1 - *u;
  }
}

/* The direction (du, dv) of a step from a place; only along the side where it would leave the domain. */
static void find_step(const place *at, int32_t n_sides, fs_vec3 q, double *du, double *dv) {
  const fs_vec3 *x = at->x;
  fs_vec3 r = fs_vec3_sub(x[FS_D], q);
  double gu = fs_vec3_dot(r, x[FS_DU]), gv = fs_vec3_dot(r, x[FS_DV]);
  double E = fs_vec3_dot(x[FS_DU], x[FS_DU]), F = fs_vec3_dot(x[FS_DU], x[FS_DV]), G = fs_vec3_dot(x[FS_DV], x[FS_DV]);
  double huu = E + fs_vec3_dot(r, x[FS_DUU]), huv = F + fs_vec3_dot(r, x[FS_DUV]), hvv = G + fs_vec3_dot(r, x[FS_DVV]);
  bool stays_u = (at->u <= 0 && gu >= 0) || (at->u >= 1 && gu <= 0);
  bool stays_v = (at->v <= 0 && gv >= 0) || (at->v >= 1 && gv <= 0);
  if (!(huu > 1e-3 * E && hvv > 1e-3 * G && huu * hvv - huv * huv > 1e-3 * (E * G - F * F))) huu = E, huv = F, hvv = G;
  *du = *dv = 0;
  if (n_sides == 3 && at->u + at->v >= 1 && gu + gv <= 0 && !stays_u && !stays_v) { /* along the third side */
    double curvature = huu - 2 * huv + hvv;
    if (curvature > 0) *du = -(gu - gv) / curvature, *dv = -*du;
  } else if (stays_u || stays_v) {
    if (!stays_u && huu > 0) *du = -gu / huu;
    if (!stays_v && hvv > 0) *dv = -gv / hvv;
  } else if (huu * hvv - huv * huv > 0) {
    double det = huu * hvv - huv * huv;
    *du = -(gu * hvv - gv * huv) / det;
    *dv = -(gv * huu - gu * huv) / det;
  }
}

static void minimise(const fs_surface *surface, fs_vec3 q, place *at) {
  int32_t n_sides = surface->patch[at->patch].n_sides;
  for (int step = 0; step < MAX_NEWTON; step++) {
    double du, dv, scale = 1;
    bool is_lower = false, is_last;
    find_step(at, n_sides, q, &du, &dv);
    if (!(fabs(du) + fabs(dv) > 1e-15)) return;
    is_last = fabs(du) + fabs(dv) < 1e-7; /* the next one would be of the size of rounding */
    for (int k = 0; k < (is_last ? 1 : MAX_HALVINGS) && !is_lower; k++, scale *= 0.5) {
      double u = at->u + scale * du, v = at->v + scale * dv;
      place next;
      clamp(n_sides, &u, &v);
      set_place(surface, q, at->patch, u, v, &next);
      is_lower = next.f < at->f;
      if (is_lower) *at = next;
    }
    if (!is_lower || is_last) return;
  }
}

/* The same point in the patch across the side that it lies on; false: it lies on none that is shared. skip: where the search
   came from. */
static bool cross(const fs_surface *surface, fs_vec3 q, const place *at, int32_t skip, place *other) {
  const fs_patch *patch = &surface->patch[at->patch];
  for (int32_t side = 0; side < patch->n_sides; side++) {
    double t, u, v;
    bool is_on = patch->n_sides == 4
                     ? (side == 0 && at->v <= 0) || (side == 1 && at->u >= 1) || (side == 2 && at->v >= 1) ||
                           (side == 3 && at->u <= 0)
                     : (side == 0 && at->v <= 0) || (side == 1 && at->u + at->v >= 1) || (side == 2 && at->u <= 0);
    int32_t neighbour = patch->neighbour[side];
    if (!is_on || neighbour == FS_NONE || neighbour == skip) continue;
    if (patch->n_sides == 4)
      t = side == 0 ? at->u : side == 1 ? at->v : side == 2 ? 1 - at->u : 1 - at->v;
    else
      t = side == 0 ? at->u : side == 1 ? at->v : 1 - at->v;
    fs_side_parameters(surface->patch[neighbour].n_sides, patch->neighbour_side[side], 1 - t, &u, &v);
    set_place(surface, q, neighbour, u, v, other);
    minimise(surface, q, other);
    if (other->f < at->f * (1 - 1e-14)) return true;
  }
  return false;
}

void fs_nearest_find(const fs_nearest *nearest, fs_vec3 p, fs_near *near) {
  double weight[3], u = 0, v = 0;
  fs_vec3 position;
  const fs_piece *piece = fs_tree_find(nearest->tree, p, &position, weight);
  place at, next;
  int32_t before = FS_NONE;
  if (nearest->surface == NULL) {
    *near = (fs_near){.position = position, .distance = fs_vec3_distance(position, p), .patch = piece->patch};
    return;
  }
  for (int k = 0; k < 3; k++) u += weight[k] * piece->uv[k][0], v += weight[k] * piece->uv[k][1];
  clamp(nearest->surface->patch[piece->patch].n_sides, &u, &v);
  set_place(nearest->surface, p, piece->patch, u, v, &at);
  minimise(nearest->surface, p, &at);
  for (int k = 0; k < MAX_PATCHES && cross(nearest->surface, p, &at, before, &next); k++) {
    before = at.patch;
    at = next;
  }
  *near = (fs_near){at.x[FS_D], sqrt(2 * at.f), at.patch, at.u, at.v};
}

double fs_nearest_distance(const void *self, fs_vec3 p, fs_vec3 *position) {
  fs_near near;
  fs_nearest_find(self, p, &near);
  *position = near.position;
  return near.distance;
}
