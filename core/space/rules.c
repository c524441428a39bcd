/* SPDX-License-Identifier: MIT */
/* Single role: the table of rules in the order in which they claim faces, and the conditions they share. */
#include "space/space.h"

const fs_patch_rule *const fs_patch_rules[] = {&fs_rule_trim, &fs_rule_bspline, &fs_rule_g2cap, NULL};

bool fs_face_touches_boundary(const fs_mesh *mesh, int32_t face) {
  for (int32_t h = mesh->face_start[face]; h < mesh->face_start[face + 1]; h++)
    if (fs_mesh_is_boundary(mesh, mesh->origin[h])) return true;
  return false;
}

bool fs_face_is_among_quads(const fs_mesh *mesh, int32_t face) {
  for (int32_t h = mesh->face_start[face]; h < mesh->face_start[face + 1]; h++) {
    int32_t g = h;
    do {
      if (fs_mesh_face_size(mesh, mesh->face[g]) != 4) return false;
      g = fs_mesh_rotate(mesh, g);
    } while (g != h);
  }
  return true;
}

bool fs_vertex_takes_cap(const fs_mesh *mesh, int32_t vertex) {
  int32_t first = mesh->outgoing[vertex], h = first, valence = fs_mesh_valence(mesh, vertex);
  if (!fs_is_special(mesh, vertex) || valence < 3 || valence > FS_MAX_CAP_VALENCE) return false;
  do {
    int32_t face = mesh->face[h];
    if (fs_mesh_face_size(mesh, face) != 4 || fs_face_touches_boundary(mesh, face)) return false;
    for (int32_t g = fs_mesh_next(mesh, h); g != h; g = fs_mesh_next(mesh, g))
      if (fs_is_special(mesh, mesh->origin[g])) return false;
    if (!fs_face_is_among_quads(mesh, face)) return false;
    h = fs_mesh_rotate(mesh, h);
  } while (h != first);
  return true;
}

fs_status fs_claim_faces(fs_context *ctx, const fs_mesh *mesh, int32_t *owner) {
  fs_status status = FS_OK;
  for (int32_t f = 0; f < mesh->n_faces; f++) owner[f] = FS_NONE;
  for (int32_t rule = 0; fs_patch_rules[rule] != NULL; rule++)
    FS_TRY(fs_patch_rules[rule]->claim(ctx, mesh, rule, owner));
done:
  return status;
}

/* The first rule: faces with a boundary vertex have no complete net of 4x4 vertices and carry nothing. */
static fs_status claim_trim(fs_context *ctx, const fs_mesh *mesh, int32_t rule, int32_t *owner) {
  (void)ctx;
  for (int32_t f = 0; f < mesh->n_faces; f++)
    if (owner[f] == FS_NONE && fs_face_touches_boundary(mesh, f)) owner[f] = rule;
  return FS_OK;
}

static fs_status build_nothing(fs_context *ctx, const fs_mesh *mesh, int32_t rule, const int32_t *owner,
                               fs_space_builder *builder) {
  (void)ctx, (void)mesh, (void)rule, (void)owner, (void)builder;
  return FS_OK;
}

const fs_patch_rule fs_rule_trim = {"trim", "faces with a boundary vertex carry no element", 2, claim_trim,
                                    build_nothing};
