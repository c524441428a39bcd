/* SPDX-License-Identifier: MIT */
/* Single role: uniform bicubic B-spline squares on faces whose four vertices are interior with valence 4.

     p(u, v) = sum over x, y of c_xy N_x(u) N_y(v),  x, y = 0 .. 3; the face lies between c_11 and c_22.
   Bezier points b_pq = sum S_px S_qy c_xy with the uniform cubic segment in Bernstein form [Farin, ch. 8]:
     S = 1/6 (1 4 1 0 | 0 4 2 0 | 0 2 4 0 | 0 1 4 1). */
#include "space/space.h"

enum { N_DOFS = 16 };

bool fs_face_is_regular(const fs_mesh *mesh, int32_t face) {
  if (fs_mesh_face_size(mesh, face) != 4) return false;
  for (int32_t h = mesh->face_start[face]; h < mesh->face_start[face + 1]; h++) {
    int32_t vertex = mesh->origin[h];
    if (fs_mesh_is_boundary(mesh, vertex) || fs_is_special(mesh, vertex)) return false;
  }
  return fs_face_is_among_quads(mesh, face);
}

static fs_status claim(fs_context *ctx, const fs_mesh *mesh, int32_t rule, int32_t *owner) {
  (void)ctx;
  for (int32_t f = 0; f < mesh->n_faces; f++)
    if (owner[f] == FS_NONE && fs_face_is_regular(mesh, f)) owner[f] = rule;
  return FS_OK;
}

/* Walks over the 3x3 faces around that of h, row by row from the lower left. */
void fs_collect_net(const fs_mesh *mesh, int32_t h, int32_t *net) {
  int32_t row = fs_walk_down(mesh, fs_walk_left(mesh, h));
  for (int y = 0; y < 3; y++) {
    int32_t g = row;
    for (int x = 0; x < 3; x++) {
      int32_t right = fs_mesh_next(mesh, g);
      net[x + 4 * y] = mesh->origin[g];
      net[x + 1 + 4 * y] = mesh->origin[right];
      net[x + 1 + 4 * (y + 1)] = fs_mesh_target(mesh, right);
      net[x + 4 * (y + 1)] = mesh->origin[fs_mesh_previous(mesh, g)];
      if (x < 2) g = fs_walk_right(mesh, g);
    }
    if (y < 2) row = fs_walk_up(mesh, row);
  }
}

static fs_status build(fs_context *ctx, const fs_mesh *mesh, int32_t rule, const int32_t *owner,
                       fs_space_builder *builder) {
  static const double sixfold[16] = {1, 4, 1, 0, 0, 4, 2, 0, 0, 2, 4, 0, 0, 1, 4, 1};
  fs_status status = FS_OK;
  double S[16];
  double E[N_DOFS * N_DOFS];
  int32_t index = FS_NONE;
  (void)ctx;
  for (int i = 0; i < 16; i++) S[i] = sixfold[i] / 6.0;
  for (int p = 0; p < 4; p++)
    for (int q = 0; q < 4; q++)
      for (int x = 0; x < 4; x++)
        for (int y = 0; y < 4; y++) E[(p + 4 * q) * N_DOFS + x + 4 * y] = S[4 * p + x] * S[4 * q + y];
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    int32_t net[N_DOFS];
    if (owner[f] != rule) continue;
    if (index == FS_NONE)
      FS_TRY(fs_builder_add_extraction(
          builder, &(fs_extraction){.degree_u = 3, .degree_v = 3, .n_dofs = N_DOFS, .E = E, .segment = S, .valence = 4},
          &index));
    fs_collect_net(mesh, mesh->face_start[f], net);
    FS_TRY(fs_builder_add_element(builder, mesh->face_start[f], index, net));
  }
done:
  return status;
}

const fs_patch_rule fs_rule_bspline = {"bspline", "bicubic B-spline squares on faces whose vertices all have valence 4",
                                       2, claim, build};
