/* SPDX-License-Identifier: MIT */
/* Single role: inner coefficients between the dofs of a space and what is kept of them with a mesh. They belong to the
   vertex of the cap and to the edge from which its sectors are counted [docs/g2caps.md, section 10]. */
#include "space/space.h"
#include "space/g2cap_parts.h"

#include <math.h>
#include <string.h>

int32_t fs_find_halfedge(const fs_mesh *mesh, int32_t from, int32_t to) {
  int32_t first = mesh->outgoing[from], h = first;
  do {
    if (fs_mesh_target(mesh, h) == to) return h;
    h = fs_mesh_rotate(mesh, h);
  } while (h != first && h != FS_NONE);
  return FS_NONE;
}

/* ---- what fits a mesh ---- */

static bool is_zero(const fs_vec3 *c, int32_t n) {
  for (int32_t i = 0; i < n; i++)
    if (c[i].x != 0 || c[i].y != 0 || c[i].z != 0) return false;
  return true;
}

static fs_status check_coefficients(fs_context *ctx, const fs_cap_notes *notes, const fs_cap_note *cap) {
  if (cap->n < 0 || cap->first < 0 || cap->first > notes->n_coefficients - cap->n)
    return fs_fail(ctx, FS_ERR_FORMAT, "the inner coefficients of the cap at vertex %d are not among the %d there are",
                   cap->vertex, notes->n_coefficients);
  for (int32_t i = 0; i < cap->n; i++) {
    fs_vec3 c = notes->coefficient[cap->first + i];
    if (!isfinite(c.x) || !isfinite(c.y) || !isfinite(c.z))
      return fs_fail(ctx, FS_ERR_FORMAT, "inner coefficient %d of the cap at vertex %d is not finite", i, cap->vertex);
  }
  return FS_OK;
}

static fs_status check_cap(fs_context *ctx, const fs_mesh *mesh, const fs_cap_note *cap) {
  int32_t v = cap->vertex, valence, n_smooth;
  if (v < 0 || v >= mesh->n_vertices)
    return fs_fail(ctx, FS_ERR_FORMAT,
                   "there are inner coefficients for vertex %d, but the mesh has the vertices 0 to %d", v,
                   mesh->n_vertices - 1);
  if (!fs_is_special(mesh, v) || !fs_vertex_takes_cap(mesh, v))
    return fs_fail(ctx, FS_ERR_FORMAT, "there are inner coefficients for vertex %d, which carries no cap", v);
  valence = fs_mesh_valence(mesh, v);
  if (cap->valence != valence)
    return fs_fail(ctx, FS_ERR_FORMAT,
                   "the inner coefficients of the cap at vertex %d are for valence %d, but it has %d", v, cap->valence,
                   valence);
  if (cap->spoke < 0 || cap->spoke >= mesh->n_vertices || fs_find_halfedge(mesh, v, cap->spoke) == FS_NONE)
    return fs_fail(ctx, FS_ERR_FORMAT, "the sectors of the cap at vertex %d begin at vertex %d, to which no edge leads",
                   v, cap->spoke);
  n_smooth = fs_g2cap_n_functions(valence);
  if (cap->n != n_smooth && cap->n != n_smooth + FS_G2CAP_LOCAL * valence)
    return fs_fail(ctx, FS_ERR_FORMAT, "the cap at vertex %d has %d inner coefficients, but valence %d needs %d or %d",
                   v, cap->n, valence, n_smooth, n_smooth + FS_G2CAP_LOCAL * valence);
  return FS_OK;
}

/* note_of[n_vertices]: 1 + the number of the cap in the notes; 0: none. */
static fs_status check_and_find(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes, int32_t *note_of) {
  fs_status status = FS_OK;
  if (notes->basis != FS_CAP_BASIS)
    return fs_fail(ctx, FS_ERR_FORMAT,
                   "the inner coefficients belong to version %d of the functions, but only version %d is known",
                   notes->basis, FS_CAP_BASIS);
  for (int32_t i = 0; i < notes->n_caps; i++) {
    const fs_cap_note *cap = &notes->cap[i];
    FS_TRY(check_cap(ctx, mesh, cap));
    FS_TRY(check_coefficients(ctx, notes, cap));
    if (note_of[cap->vertex] != 0)
      return fs_fail(ctx, FS_ERR_FORMAT, "the inner coefficients of the cap at vertex %d are there twice", cap->vertex);
    note_of[cap->vertex] = i + 1;
  }
done:
  return status;
}

fs_status fs_space_find_caps(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes, int32_t **note_of) {
  fs_status status = FS_OK;
  int32_t *found = NULL;
  FS_ALLOC(ctx, found, mesh->n_vertices);
  FS_TRY(check_and_find(ctx, mesh, notes, found));
  *note_of = found;
  found = NULL;
done:
  fs_release(ctx, found);
  return status;
}

fs_status fs_space_check_caps(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes) {
  int32_t *note_of = NULL;
  fs_status status = fs_space_find_caps(ctx, mesh, notes, &note_of);
  if (status == FS_OK) fs_release(ctx, note_of);
  return status;
}

/* ---- to dofs and back ---- */

void fs_builder_take_caps(const fs_space_builder *builder, const fs_space *space, fs_vec3 *start) {
  const fs_cap_notes *notes = fs_builder_options(builder)->kept;
  for (int32_t i = 0; i < space->n_caps; i++) {
    const fs_cap *cap = &space->cap[i];
    const fs_cap_note *kept = fs_builder_kept(builder, cap->vertex);
    int32_t n = kept == NULL ? 0 : kept->n < cap->n_dofs ? kept->n : cap->n_dofs;
    if (n > 0) memcpy(start + cap->first_dof, notes->coefficient + kept->first, (size_t)n * sizeof *start);
  }
}

/* Coefficients of a cap that have to be kept: none, those of the whole cap, or all. */
static int32_t n_kept(const fs_cap *cap, const fs_vec3 *c) {
  int32_t n_smooth = fs_g2cap_n_functions(cap->valence), n = cap->n_dofs;
  if (is_zero(c + cap->first_dof, n)) return 0;
  return n > n_smooth && is_zero(c + cap->first_dof + n_smooth, n - n_smooth) ? n_smooth : n;
}

fs_status fs_space_keep_caps(fs_context *ctx, const fs_mesh *mesh, const fs_space *space, const fs_vec3 *c,
                             fs_cap_notes **result) {
  fs_status status = FS_OK;
  fs_cap_notes *notes = NULL;
  int32_t n_caps = 0, n = 0;
  for (int32_t i = 0; i < space->n_caps; i++) {
    int32_t here = n_kept(&space->cap[i], c);
    n_caps += here > 0;
    n += here;
  }
  if (n_caps > 0) FS_TRY(fs_cap_notes_create(ctx, n_caps, n, &notes));
  n_caps = n = 0;
  for (int32_t i = 0; i < space->n_caps; i++) {
    const fs_cap *cap = &space->cap[i];
    int32_t here = n_kept(cap, c);
    if (here == 0) continue;
    notes->cap[n_caps++] = (fs_cap_note){.vertex = cap->vertex,
                                         .spoke = fs_mesh_target(mesh, cap->halfedge),
                                         .valence = cap->valence,
                                         .first = n,
                                         .n = here};
    memcpy(notes->coefficient + n, c + cap->first_dof, (size_t)here * sizeof *c);
    n += here;
  }
  *result = notes;
done:
  return status;
}
