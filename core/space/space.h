/* SPDX-License-Identifier: MIT */
/* What the files of this room share: walking over quadrilaterals, the builder that rules fill, cap conditions. */
#ifndef FS_SPACE_SPACE_H
#define FS_SPACE_SPACE_H

#include <fairsurf/space.h>
#include "base/base.h"

/* Half-edge h runs along side v = 0 of its quadrilateral. The corresponding half-edges of the neighbours (all involved faces
   must be quadrilaterals with twins where they are crossed): */
static inline int32_t fs_walk_right(const fs_mesh *m, int32_t h) { /* u + 1 */
  return fs_mesh_next(m, m->twin[fs_mesh_next(m, h)]);
}
static inline int32_t fs_walk_up(const fs_mesh *m, int32_t h) { /* v + 1 */
  return m->twin[fs_mesh_next(m, fs_mesh_next(m, h))];
}
static inline int32_t fs_walk_left(const fs_mesh *m, int32_t h) { /* u - 1 */
  return fs_mesh_previous(m, m->twin[fs_mesh_previous(m, h)]);
}
static inline int32_t fs_walk_down(const fs_mesh *m, int32_t h) { /* v - 1 */
  return fs_mesh_next(m, fs_mesh_next(m, m->twin[h]));
}

/* An interior vertex where a regular net is not possible. */
static inline bool fs_is_special(const fs_mesh *mesh, int32_t vertex) {
  return !fs_mesh_is_boundary(mesh, vertex) && fs_mesh_valence(mesh, vertex) != 4;
}

bool fs_face_touches_boundary(const fs_mesh *mesh, int32_t face);

/* All faces that share a vertex with the face are quadrilaterals (the face itself too); its vertices must be interior. */
bool fs_face_is_among_quads(const fs_mesh *mesh, int32_t face);

/* A quadrilateral among quadrilaterals whose vertices are interior with valence 4: it carries a bicubic B-spline. */
bool fs_face_is_regular(const fs_mesh *mesh, int32_t face);

/* net[x + 4 y] = the dofs of a regular face, which lies between dofs (1, 1) and (2, 2), from there along its half-edge h. */
void fs_collect_net(const fs_mesh *mesh, int32_t h, int32_t *net);

/* A cap can be put around this special vertex: valence 3, 5 .. 24, and all faces around it are among quadrilaterals with
   no other special vertex and none of the boundary. */
bool fs_vertex_takes_cap(const fs_mesh *mesh, int32_t vertex);
enum { FS_MAX_CAP_VALENCE = 24 };

/* owner[n_faces] = the index in fs_patch_rules of the rule that takes the face, or FS_NONE. */
fs_status fs_claim_faces(fs_context *ctx, const fs_mesh *mesh, int32_t *owner);

/* Adds an extraction; its arrays are copied unless it says is_borrowed. */
fs_status fs_builder_add_extraction(fs_space_builder *builder, const fs_extraction *extraction, int32_t *index);

/* Adds an element on the face of halfedge, its side 0 along that; dofs[extraction.n_dofs] are copied. */
fs_status fs_builder_add_element(fs_space_builder *builder, int32_t halfedge, int32_t extraction, const int32_t *dofs);

/* One more special vertex carries a cap, with sector 0 at the half-edge spoke and n_dofs dofs of its own, whose first is
   *first_dof. */
fs_status fs_builder_add_cap(fs_space_builder *builder, int32_t spoke, int32_t n_dofs, int32_t *first_dof);

/* Never NULL; max_full_valence is set. */
const fs_space_options *fs_builder_options(const fs_space_builder *builder);

/* The coefficients that are kept for the cap at a vertex; NULL: none. */
const fs_cap_note *fs_builder_kept(const fs_space_builder *builder, int32_t vertex);

/* Half-edge from one vertex to another, or FS_NONE: no edge joins them. */
int32_t fs_find_halfedge(const fs_mesh *mesh, int32_t from, int32_t to);

/* fs_space_check_caps, and note_of[n_vertices]: 1 + the number of its cap in the notes; 0: none. The caller frees. */
fs_status fs_space_find_caps(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes, int32_t **note_of);

/* start[n_dofs]: copies what is kept to the dofs of the caps. */
void fs_builder_take_caps(const fs_space_builder *builder, const fs_space *space, fs_vec3 *start);

extern const fs_patch_rule fs_rule_trim, fs_rule_bspline, fs_rule_g2cap;

#endif
