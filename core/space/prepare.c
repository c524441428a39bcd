/* SPDX-License-Identifier: MIT */
/* Single role: what stands between a mesh and its space, and the refinements that remove it. */
#include "space/space.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_AUTOMATIC = 2, MAX_TRIANGLES = 5000 };

/* ---- obstacles --------------------------------------------------------------------------------------------------- */

static bool has_boundary_neighbour(const fs_mesh *mesh, int32_t vertex) {
  int32_t first = mesh->outgoing[vertex], h = first;
  do {
    if (fs_mesh_is_boundary(mesh, fs_mesh_target(mesh, h))) return true;
    h = fs_mesh_rotate(mesh, h);
  } while (h != first);
  return false;
}

static void examine_vertex(const fs_mesh *mesh, const int32_t *owner, int32_t vertex, fs_space_obstacles *o) {
  int32_t first = mesh->outgoing[vertex], h = first, valence = fs_mesh_valence(mesh, vertex);
  bool is_uncovered = false, is_close = false, is_at_rim = false;
  if (!fs_is_special(mesh, vertex)) return;
  if ((valence < 3 || valence > FS_MAX_CAP_VALENCE) && o->bad_vertex == FS_NONE) o->bad_vertex = vertex;
  if (has_boundary_neighbour(mesh, vertex)) o->special_near_boundary = true;
  do {
    int32_t face = mesh->face[h];
    is_uncovered |= owner[face] == FS_NONE;
    is_at_rim |= fs_face_touches_boundary(mesh, face);
    for (int32_t g = mesh->face_start[face]; g < mesh->face_start[face + 1]; g++)
      is_close |= mesh->origin[g] != vertex && fs_is_special(mesh, mesh->origin[g]);
    h = fs_mesh_rotate(mesh, h);
  } while (h != first);
  if (is_uncovered && is_close) o->n_close_specials++;
  if (is_uncovered && is_at_rim) o->n_rim_specials++;
}

static bool touches_uncovered(const fs_mesh *mesh, const int32_t *owner, int32_t face) {
  for (int32_t h = mesh->face_start[face]; h < mesh->face_start[face + 1]; h++) {
    int32_t first = mesh->outgoing[mesh->origin[h]], g = first;
    do {
      if (owner[mesh->face[g]] == FS_NONE) return true;
      g = fs_mesh_rotate(mesh, g);
    } while (g != first && g != FS_NONE);
  }
  return false;
}

fs_status fs_space_examine(fs_context *ctx, const fs_mesh *mesh, fs_space_obstacles *obstacles) {
  fs_status status = FS_OK;
  fs_space_obstacles o = {.first_face = FS_NONE, .bad_vertex = FS_NONE};
  int32_t *owner = NULL;
  FS_ALLOC(ctx, owner, mesh->n_faces);
  FS_TRY(fs_claim_faces(ctx, mesh, owner));
  for (int32_t f = 0; f < mesh->n_faces; f++) {
    if (owner[f] == FS_NONE) {
      o.n_uncovered_faces++;
      if (o.first_face == FS_NONE) o.first_face = f;
    } else if (fs_patch_rules[owner[f]] != &fs_rule_trim) {
      o.n_elements++;
      o.n_cap_elements += fs_patch_rules[owner[f]] == &fs_rule_g2cap;
    }
    if (fs_mesh_face_size(mesh, f) != 4) {
      if (touches_uncovered(mesh, owner, f)) o.n_non_quads++;
      if (fs_face_touches_boundary(mesh, f)) o.special_near_boundary = true;
    }
  }
  for (int32_t v = 0; v < mesh->n_vertices; v++) {
    examine_vertex(mesh, owner, v, &o);
    o.n_caps += fs_vertex_takes_cap(mesh, v);
  }
  *obstacles = o;
done:
  fs_release(ctx, owner);
  return status;
}

/* ---- refinements ------------------------------------------------------------------------------------------------- */

/* "12 faces that are no quadrilaterals, 4 special vertices that share faces" */
static void describe(const fs_space_obstacles *o, char *text, size_t size) {
  const struct {
    int32_t n;
    const char *what;
  } part[] = {{o->n_non_quads, "faces that are no quadrilaterals"},
              {o->n_close_specials, "special vertices that share a face with another one"},
              {o->n_rim_specials, "special vertices too close to the boundary"}};
  size_t used = 0;
  text[0] = '\0';
  for (size_t i = 0; i < sizeof part / sizeof part[0]; i++)
    if (part[i].n > 0 && used < size)
      used += (size_t)snprintf(text + used, size - used, "%s%d %s", used > 0 ? ", " : "", part[i].n, part[i].what);
  if (text[0] == '\0') snprintf(text, size, "%d faces without a full net", o->n_uncovered_faces);
}

static fs_status check_bounds(fs_context *ctx, const fs_mesh *mesh, const fs_space_obstacles *o) {
  if (o->bad_vertex != FS_NONE)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "interior vertex %d has valence %d: 3 to %d are possible", o->bad_vertex,
                   fs_mesh_valence(mesh, o->bad_vertex), FS_MAX_CAP_VALENCE);
  for (int32_t f = 0; f < mesh->n_faces; f++)
    if (fs_mesh_face_size(mesh, f) > FS_MAX_CAP_VALENCE)
      return fs_fail(ctx, FS_ERR_UNSUPPORTED, "face %d has %d sides: up to %d are possible", f,
                     fs_mesh_face_size(mesh, f), FS_MAX_CAP_VALENCE);
  return FS_OK;
}

/* The densities hold powers of length up to 22, so that sizes far from 1 leave the range of double. */
static fs_status check_size(fs_context *ctx, const fs_mesh *mesh) {
  fs_vec3 min = mesh->position[0], max = min;
  for (int32_t v = 1; v < mesh->n_vertices; v++) {
    fs_vec3 p = mesh->position[v];
    min = (fs_vec3){fmin(min.x, p.x), fmin(min.y, p.y), fmin(min.z, p.z)};
    max = (fs_vec3){fmax(max.x, p.x), fmax(max.y, p.y), fmax(max.z, p.z)};
  }
  double size = hypot(hypot(max.x - min.x, max.y - min.y), max.z - min.z);
  double distance =
      fmax(fmax(fabs(min.x), fabs(max.x)), fmax(fmax(fabs(min.y), fabs(max.y)), fmax(fabs(min.z), fabs(max.z))));
  if (size >= 1e-10 && size <= 1e12 && distance <= 1e12) return FS_OK;
  return fs_fail(ctx, FS_ERR_UNSUPPORTED,
                 "the mesh measures %g across, %g from the origin: scale it to between 1e-10 and 1e12", size, distance);
}

static fs_status check_triangles(fs_context *ctx, const fs_mesh *mesh) {
  int32_t n_triangles = 0;
  for (int32_t f = 0; f < mesh->n_faces; f++) n_triangles += fs_mesh_face_size(mesh, f) == 3;
  if (mesh->n_faces <= MAX_TRIANGLES || n_triangles <= mesh->n_faces / 2) return FS_OK;
  return fs_fail(
      ctx, FS_ERR_UNSUPPORTED,
      "%d of %d faces are triangles, and each would become three patches: make quadrilaterals first (MeshLab: "
      "Tri to Quad by smart triangle pairing), or ask for the refinement explicitly",
      n_triangles, mesh->n_faces);
}

/* Whether another refinement is wanted; with_averaging: which. */
static fs_status next_step(fs_context *ctx, const fs_mesh *mesh, int32_t n_done, int32_t at_least, bool *is_wanted,
                           bool *with_averaging) {
  fs_status status = FS_OK;
  fs_space_obstacles o;
  char reason[200];
  FS_TRY(check_size(ctx, mesh));
  FS_TRY(fs_space_examine(ctx, mesh, &o));
  FS_TRY(check_bounds(ctx, mesh, &o));
  *with_averaging = !o.special_near_boundary;
  *is_wanted = n_done < at_least || o.n_uncovered_faces > 0;
  if (n_done < at_least) goto done;
  if (o.n_uncovered_faces == 0) {
    if (o.n_elements == 0)
      status = fs_fail(ctx, FS_ERR_UNSUPPORTED,
                       "no face has a full net: each of the %d faces has a vertex on the boundary", mesh->n_faces);
    goto done;
  }
  if (at_least == 0 && n_done == 0) FS_TRY(check_triangles(ctx, mesh));
  describe(&o, reason, sizeof reason);
  if (n_done >= at_least + MAX_AUTOMATIC) {
    status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "after %d refinements no patch fits face %d: %s", n_done, o.first_face,
                     reason);
    goto done;
  }
  fs_note(ctx, "refined by %s, because of %s",
          *with_averaging ? "averagings" : "Catmull-Clark (averagings would leave special vertices at the boundary)",
          reason);
done:
  return status;
}

fs_status fs_space_prepare(fs_context *ctx, const fs_mesh *mesh, int32_t at_least,
                           fs_refinement *steps[FS_MAX_REFINEMENTS], int32_t *n_steps) {
  fs_status status = FS_OK;
  int32_t n = 0;
  bool is_wanted = false, with_averaging = true;
  if (at_least < 0 || at_least > FS_MAX_REFINEMENTS - MAX_AUTOMATIC)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%d refinements: 0 to %d are possible", at_least,
                   FS_MAX_REFINEMENTS - MAX_AUTOMATIC);
  FS_TRY(next_step(ctx, mesh, n, at_least, &is_wanted, &with_averaging));
  while (is_wanted) {
    const fs_mesh *current = n > 0 ? steps[n - 1]->mesh : mesh;
    FS_TRY(fs_mesh_refine(ctx, current, with_averaging ? "averaging" : "catmull-clark", NULL, &steps[n]));
    n++;
    FS_TRY(next_step(ctx, steps[n - 1]->mesh, n, at_least, &is_wanted, &with_averaging));
  }
  *n_steps = n;
  n = 0;
done:
  while (n > 0) fs_refinement_free(ctx, steps[--n]);
  return status;
}

/* ---- the rim ----------------------------------------------------------------------------------------------------- */

/* All sectors of a cap see the same vertices. */
void fs_space_fix_caps(const fs_space *space, bool *fixed) {
  for (int32_t e = 0; e < space->n_elements; e++) {
    const fs_extraction *x = &space->extraction[space->element[e].extraction];
    const int32_t *dof = space->dof + space->element[e].dof_start;
    int32_t n_vertices = x->n_dofs - x->n_offsets;
    bool all = true;
    for (int32_t i = 0; i < n_vertices && all && x->n_offsets > 0; i++) all = fixed[dof[i]];
    for (int32_t i = n_vertices; i < x->n_dofs && all; i++) fixed[dof[i]] = true;
  }
}

fs_status fs_space_rim(fs_context *ctx, const fs_mesh *mesh, const fs_space *space, bool *fixed) {
  fs_status status = FS_OK;
  bool *near_boundary = NULL;
  FS_ALLOC(ctx, near_boundary, mesh->n_vertices);
  memset(fixed, 0, (size_t)space->n_dofs * sizeof *fixed);
  for (int32_t v = 0; v < mesh->n_vertices; v++) fixed[v] = fs_mesh_is_boundary(mesh, v);
  for (int step = 0; step < 2; step++) { /* over all faces at a vertex marked before the step */
    memcpy(near_boundary, fixed, (size_t)mesh->n_vertices * sizeof *fixed);
    for (int32_t f = 0; f < mesh->n_faces; f++) {
      bool is_near = false;
      for (int32_t h = mesh->face_start[f]; h < mesh->face_start[f + 1]; h++) is_near |= near_boundary[mesh->origin[h]];
      for (int32_t h = mesh->face_start[f]; is_near && h < mesh->face_start[f + 1]; h++) fixed[mesh->origin[h]] = true;
    }
  }
  fs_space_fix_caps(space, fixed);
done:
  fs_release(ctx, near_boundary);
  return status;
}
