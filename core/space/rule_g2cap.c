/* SPDX-License-Identifier: MIT */
/* Single role: G2 caps of degree (9, 9) on the k faces around an interior vertex of valence k = 3, 5 .. 24 [Kiciak 2013;
   docs/g2caps.md]. The sectors of a linear cap share one extraction: only the order of the vertices turns. With inner
   coefficients each sector has its own, E = [matrix of the cap | smooth | local], shared by all caps of that valence. */
#include "space/space.h"
#include "space/g2cap_parts.h"

enum {
  MAX_NET = 6 * FS_MAX_CAP_VALENCE + 1,
  MAX_SMOOTH = 3 * FS_MAX_CAP_VALENCE + 6,
  MAX_DOFS = MAX_NET + MAX_SMOOTH + FS_G2CAP_LOCAL,
  N_POINTS = 100
};

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

/* How caps of one valence are made. Linear caps have one extraction for all sectors; inner functions differ from sector
   to sector. */
typedef struct cap_kind {
  bool is_made;
  int32_t n_smooth, n_local; /* n_local: per sector */
  int32_t extraction[FS_MAX_CAP_VALENCE];
} cap_kind;

static fs_status make_linear(fs_context *ctx, int32_t k, fs_space_builder *builder, cap_kind *kind) {
  fs_status status = FS_OK;
  const fs_g2cap *cap = NULL;
  int32_t index;
  FS_TRY(fs_g2cap_get(ctx, k, &cap));
  fs_extraction extraction = {.degree_u = 9,
                              .degree_v = 9,
                              .n_dofs = cap->n_vertices,
                              .E = cap->matrix,
                              .chart = cap->chart,
                              .valence = k,
                              .is_borrowed = true};
  FS_TRY(fs_builder_add_extraction(builder, &extraction, &index));
  for (int32_t s = 0; s < k; s++) kind->extraction[s] = index;
done:
  return status;
}

/* E [100][6k+1 + n_smooth + n_local] of a sector: the matrix of the cap, then the inner functions. */
static void join_columns(const fs_g2cap *cap, const fs_g2cap_inner *inner, int32_t sector, int32_t n_local, double *E) {
  for (int32_t point = 0; point < N_POINTS; point++) {
    const double *matrix = cap->matrix + point * cap->n_vertices, *local = inner->local + point * FS_G2CAP_LOCAL;
    const double *smooth = inner->smooth + (sector * N_POINTS + point) * inner->n_smooth;
    for (int32_t i = 0; i < cap->n_vertices; i++) *E++ = matrix[i];
    for (int32_t i = 0; i < inner->n_smooth; i++) *E++ = smooth[i];
    for (int32_t i = 0; i < n_local; i++) *E++ = local[i];
  }
}

static fs_status make_free(fs_context *ctx, int32_t k, int32_t n_local, fs_space_builder *builder, cap_kind *kind) {
  fs_status status = FS_OK;
  const fs_g2cap *cap = NULL;
  const fs_g2cap_inner *inner = NULL;
  double *E = NULL;
  FS_TRY(fs_g2cap_get(ctx, k, &cap));
  FS_TRY(fs_g2cap_get_inner(ctx, k, &inner));
  kind->n_smooth = inner->n_smooth;
  kind->n_local = n_local;
  fs_extraction extraction = {.degree_u = 9,
                              .degree_v = 9,
                              .n_dofs = cap->n_vertices + inner->n_smooth + n_local,
                              .n_offsets = inner->n_smooth + n_local,
                              .chart = cap->chart,
                              .valence = k};
  FS_ALLOC(ctx, E, N_POINTS * extraction.n_dofs);
  extraction.E = E;
  for (int32_t s = 0; s < k; s++) {
    join_columns(cap, inner, s, n_local, E);
    FS_TRY(fs_builder_add_extraction(builder, &extraction, &kind->extraction[s]));
  }
done:
  fs_release(ctx, E);
  return status;
}

/* is_kept_full: one of them has coefficients in its sectors to start with. */
static fs_status make_kind(fs_context *ctx, int32_t k, bool is_kept_full, fs_space_builder *builder, cap_kind *kind) {
  fs_status status = FS_OK;
  const fs_space_options *options = fs_builder_options(builder);
  bool is_full = options->caps == FS_CAPS_FULL && (k <= options->max_full_valence || is_kept_full);
  if (options->caps == FS_CAPS_LINEAR)
    FS_TRY(make_linear(ctx, k, builder, kind));
  else
    FS_TRY(make_free(ctx, k, is_full ? FS_G2CAP_LOCAL : 0, builder, kind));
  kind->is_made = true;
done:
  return status;
}

static fs_status build_cap(const fs_mesh *mesh, int32_t vertex, const cap_kind *kind, fs_space_builder *builder) {
  fs_status status = FS_OK;
  int32_t net[MAX_NET], dofs[MAX_DOFS], spoke[FS_MAX_CAP_VALENCE], k = 0, first_dof;
  const fs_cap_note *kept = fs_builder_kept(builder, vertex);
  int32_t first = kept != NULL ? fs_find_halfedge(mesh, vertex, kept->spoke) : mesh->outgoing[vertex], h = first;
  do {
    spoke[k] = h;
    collect_sector(mesh, h, net + 6 * k);
    k++;
    h = fs_mesh_rotate(mesh, h);
  } while (h != first);
  FS_TRY(fs_builder_add_cap(builder, first, kind->n_smooth + k * kind->n_local, &first_dof));
  for (int32_t s = 0; s < k; s++) {
    int32_t *dof = dofs;
    *dof++ = vertex;
    for (int32_t i = 0; i < 6 * k; i++) *dof++ = net[(6 * s + i) % (6 * k)];
    for (int32_t i = 0; i < kind->n_smooth; i++) *dof++ = first_dof + i;
    for (int32_t i = 0; i < kind->n_local; i++) *dof++ = first_dof + kind->n_smooth + s * kind->n_local + i;
    FS_TRY(fs_builder_add_element(builder, spoke[s], kind->extraction[s], dofs));
  }
done:
  return status;
}

static bool is_owned(const fs_mesh *mesh, int32_t vertex, int32_t rule, const int32_t *owner) {
  return fs_is_special(mesh, vertex) && owner[mesh->face[mesh->outgoing[vertex]]] == rule;
}

/* is_full[k]: a cap of that valence has coefficients in its sectors to start with. */
static void find_kept_full(const fs_mesh *mesh, int32_t rule, const int32_t *owner, const fs_space_builder *builder,
                           bool *is_full) {
  if (fs_builder_options(builder)->kept == NULL) return;
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    const fs_cap_note *kept = fs_builder_kept(builder, v);
    if (kept == NULL || !is_owned(mesh, v, rule, owner)) continue;
    is_full[kept->valence] |= kept->n > fs_g2cap_n_functions(kept->valence);
  }
}

static fs_status build(fs_context *ctx, const fs_mesh *mesh, int32_t rule, const int32_t *owner,
                       fs_space_builder *builder) {
  fs_status status = FS_OK;
  cap_kind kind[FS_MAX_CAP_VALENCE + 1] = {0};
  bool is_kept_full[FS_MAX_CAP_VALENCE + 1] = {false};
  find_kept_full(mesh, rule, owner, builder, is_kept_full);
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    int32_t k;
    if (!is_owned(mesh, v, rule, owner)) continue;
    k = fs_mesh_valence(mesh, v);
    if (!kind[k].is_made) FS_TRY(make_kind(ctx, k, is_kept_full[k], builder, &kind[k]));
    FS_TRY(build_cap(mesh, v, &kind[k], builder));
  }
done:
  return status;
}

const fs_patch_rule fs_rule_g2cap = {"g2cap", "G2 caps of degree (9, 9) around interior vertices of valence 3, 5 .. 24",
                                     2, claim, build};
