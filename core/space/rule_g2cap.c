/* SPDX-License-Identifier: MIT */
/* Single role: G2 caps of degree (9, 9) on the k faces around an interior vertex of valence k = 3, 5 .. 24 [Kiciak 2013;
   docs/g2caps.md]. All sectors share one extraction: only the order of the dofs turns. */
#include "space/space.h"
#include "space/g2cap.h"

enum { MAX_NET = 6 * FS_MAX_CAP_VALENCE + 1 };

static fs_status claim(fs_context *ctx, const fs_mesh *mesh, int32_t rule, int32_t *owner) {
  (void)ctx;
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    int32_t first = mesh->outgoing[v], h = first;
    if (!fs_vertex_takes_cap(mesh, v)) continue;
    do {
      if (owner[mesh->face[h]] == FS_NONE) owner[mesh->face[h]] = rule;
      h = fs_mesh_rotate(mesh, h);
    } while (h != first);
  }
  return FS_OK;
}

/* The six net vertices of the sector of spoke h, from the four faces (0,0), (1,0), (0,1), (1,1) of the sector:
   V(1,0) V(2,0) V(1,1) V(2,1) V(1,2) V(2,2). */
static void collect_sector(const fs_mesh *mesh, int32_t h, int32_t *net) {
  int32_t right = fs_walk_right(mesh, h), up = fs_walk_up(mesh, h), both = fs_walk_right(mesh, up);
  net[0] = fs_mesh_target(mesh, h);
  net[1] = fs_mesh_target(mesh, right);
  net[2] = fs_mesh_target(mesh, fs_mesh_next(mesh, h));
  net[3] = fs_mesh_target(mesh, fs_mesh_next(mesh, right));
  net[4] = fs_mesh_target(mesh, fs_mesh_next(mesh, up));
  net[5] = fs_mesh_target(mesh, fs_mesh_next(mesh, both));
}

static fs_status build_cap(const fs_mesh *mesh, int32_t vertex, int32_t extraction, fs_space_builder *builder) {
  fs_status status = FS_OK;
  int32_t net[MAX_NET], dofs[MAX_NET], spoke[FS_MAX_CAP_VALENCE], k = 0, first = mesh->outgoing[vertex], h = first;
  do {
    spoke[k] = h;
    collect_sector(mesh, h, net + 6 * k);
    k++;
    h = fs_mesh_rotate(mesh, h);
  } while (h != first);
  for (int32_t s = 0; s < k; s++) {
    dofs[0] = vertex;
    for (int32_t i = 0; i < 6 * k; i++) dofs[1 + i] = net[(6 * s + i) % (6 * k)];
    FS_TRY(fs_builder_add_element(builder, spoke[s], extraction, dofs));
  }
  fs_builder_count_cap(builder);
done:
  return status;
}

static fs_status build(fs_context *ctx, const fs_mesh *mesh, int32_t rule, const int32_t *owner,
                       fs_space_builder *builder) {
  fs_status status = FS_OK;
  int32_t index[FS_MAX_CAP_VALENCE + 1];
  for (int32_t k = 0; k <= FS_MAX_CAP_VALENCE; k++) index[k] = FS_NONE;
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    int32_t k;
    if (!fs_is_special(mesh, v) || owner[mesh->face[mesh->outgoing[v]]] != rule) continue;
    k = fs_mesh_valence(mesh, v);
    if (index[k] == FS_NONE) {
      const fs_g2cap *cap = NULL;
      FS_TRY(fs_g2cap_get(ctx, k, &cap));
      fs_extraction extraction = {.degree_u = 9,
                                  .degree_v = 9,
                                  .n_dofs = cap->n_vertices,
                                  .E = cap->matrix,
                                  .chart = cap->chart,
                                  .valence = k,
                                  .is_borrowed = true};
      FS_TRY(fs_builder_add_extraction(builder, &extraction, &index[k]));
    }
    FS_TRY(build_cap(mesh, v, index[k], builder));
  }
done:
  return status;
}

const fs_patch_rule fs_rule_g2cap = {
    "g2cap", "G2 caps of degree (9, 9) around interior vertices of valence 3, 5 .. 24", 2, claim, build};
