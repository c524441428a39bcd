/* SPDX-License-Identifier: MIT */
/* Single role: from claimed faces to a space: rules build elements, then the elements learn their neighbours. */
#include "space/space.h"

#include <math.h>
#include <string.h>

enum { DEFAULT_FULL_VALENCE = 8 };

struct fs_space_builder {
  fs_context *ctx;
  const fs_mesh *mesh;
  fs_space *space;
  fs_space_options options;
  int32_t *note_of; /* [n_vertices] 1 + number of the cap among those that are kept; NULL: none are */
  int64_t dof_capacity;
  int32_t extraction_capacity, cap_capacity;
};

/* ---- the builder ------------------------------------------------------------------------------------------------- */

static fs_status copy_doubles(fs_context *ctx, double **out, const double *in, size_t n) {
  fs_status status = FS_OK;
  FS_ALLOC(ctx, *out, n);
  memcpy(*out, in, n * sizeof **out);
done:
  return status;
}

fs_status fs_builder_add_extraction(fs_space_builder *b, const fs_extraction *extraction, int32_t *index) {
  fs_status status = FS_OK;
  fs_space *space = b->space;
  fs_extraction *grown = NULL, *added;
  if (space->n_extractions == b->extraction_capacity) {
    FS_ALLOC(b->ctx, grown, 2 * b->extraction_capacity + 4);
    if (space->n_extractions > 0) memcpy(grown, space->extraction, (size_t)space->n_extractions * sizeof *grown);
    fs_release(b->ctx, space->extraction);
    space->extraction = grown;
    b->extraction_capacity = 2 * b->extraction_capacity + 4;
  }
  added = &space->extraction[space->n_extractions];
  *added = *extraction;
  *index = space->n_extractions++;
  if (!extraction->is_borrowed) {
    size_t n = (size_t)(extraction->degree_u + 1) * (size_t)(extraction->degree_v + 1);
    added->E = added->chart = added->segment = NULL;
    FS_TRY(copy_doubles(b->ctx, &added->E, extraction->E, n * (size_t)extraction->n_dofs));
    if (extraction->chart != NULL) FS_TRY(copy_doubles(b->ctx, &added->chart, extraction->chart, 2 * n));
    if (extraction->segment != NULL) FS_TRY(copy_doubles(b->ctx, &added->segment, extraction->segment, 16));
  }
done:
  return status;
}

fs_status fs_builder_add_element(fs_space_builder *b, int32_t halfedge, int32_t extraction, const int32_t *dofs) {
  fs_status status = FS_OK;
  fs_space *space = b->space;
  int32_t n = space->extraction[extraction].n_dofs, *grown = NULL;
  if (space->n_element_dofs + n > INT32_MAX)
    return fs_fail(b->ctx, FS_ERR_UNSUPPORTED, "the mesh of %d faces is too large for one space", b->mesh->n_faces);
  if (space->n_element_dofs + n > b->dof_capacity) {
    int64_t capacity = 2 * b->dof_capacity + 16 * (int64_t)b->mesh->n_faces / 4 + n;
    FS_ALLOC(b->ctx, grown, capacity);
    if (space->n_element_dofs > 0) memcpy(grown, space->dof, (size_t)space->n_element_dofs * sizeof *grown);
    fs_release(b->ctx, space->dof);
    space->dof = grown;
    b->dof_capacity = capacity;
  }
  space->element[space->n_elements++] = (fs_element){.face = b->mesh->face[halfedge],
                                                     .halfedge = halfedge,
                                                     .extraction = extraction,
                                                     .dof_start = (int32_t)space->n_element_dofs};
  memcpy(space->dof + space->n_element_dofs, dofs, (size_t)n * sizeof *dofs);
  space->n_element_dofs += n;
done:
  return status;
}

fs_status fs_builder_add_cap(fs_space_builder *b, int32_t spoke, int32_t n_dofs, int32_t *first_dof) {
  fs_status status = FS_OK;
  fs_space *space = b->space;
  int32_t vertex = b->mesh->origin[spoke];
  fs_cap *grown = NULL;
  if (n_dofs > INT32_MAX - space->n_dofs)
    return fs_fail(b->ctx, FS_ERR_UNSUPPORTED, "the mesh has too many caps for one space of %d dofs", space->n_dofs);
  if (space->n_caps == b->cap_capacity) {
    FS_ALLOC(b->ctx, grown, 2 * (size_t)b->cap_capacity + 4);
    if (space->n_caps > 0) memcpy(grown, space->cap, (size_t)space->n_caps * sizeof *grown);
    fs_release(b->ctx, space->cap);
    space->cap = grown;
    b->cap_capacity = 2 * b->cap_capacity + 4;
  }
  *first_dof = space->n_dofs;
  space->cap[space->n_caps++] = (fs_cap){.vertex = vertex,
                                         .valence = fs_mesh_valence(b->mesh, vertex),
                                         .first_dof = space->n_dofs,
                                         .n_dofs = n_dofs,
                                         .halfedge = spoke};
  space->n_dofs += n_dofs;
done:
  return status;
}

const fs_space_options *fs_builder_options(const fs_space_builder *builder) { return &builder->options; }

const fs_cap_note *fs_builder_kept(const fs_space_builder *builder, int32_t vertex) {
  int32_t number = builder->note_of != NULL ? builder->note_of[vertex] : 0;
  return number > 0 ? &builder->options.kept->cap[number - 1] : NULL;
}

/* ---- neighbours -------------------------------------------------------------------------------------------------- */

/* The half-edge along side s of an element on a quadrilateral. */
static int32_t side_halfedge(const fs_mesh *mesh, const fs_element *e, int side) {
  int32_t start = mesh->face_start[e->face];
  return start + (e->halfedge - start + side) % 4;
}

static fs_status connect(fs_context *ctx, const fs_mesh *mesh, fs_space *space) {
  fs_status status = FS_OK;
  int32_t *element_of = NULL; /* [n_faces] */
  FS_ALLOC(ctx, element_of, mesh->n_faces);
  for (int32_t f = 0; f < mesh->n_faces; f++) element_of[f] = FS_NONE;
  for (int32_t i = 0; i < space->n_elements; i++) element_of[space->element[i].face] = i;
  for (int32_t i = 0; i < space->n_elements; i++)
    for (int side = 0; side < 4; side++) {
      fs_element *e = &space->element[i];
      int32_t twin = mesh->twin[side_halfedge(mesh, e, side)];
      int32_t other = twin == FS_NONE ? FS_NONE : element_of[mesh->face[twin]];
      e->neighbour[side] = other;
      if (other != FS_NONE) {
        int32_t start = mesh->face_start[space->element[other].face];
        e->neighbour_side[side] = (uint8_t)((twin - start + 4 - (space->element[other].halfedge - start)) % 4);
      }
    }
done:
  fs_release(ctx, element_of);
  return status;
}

/* ---- the space --------------------------------------------------------------------------------------------------- */

static fs_status check_owners(fs_context *ctx, const fs_mesh *mesh, const int32_t *owner) {
  for (int32_t f = 0; f < mesh->n_faces; f++)
    if (owner[f] == FS_NONE)
      return fs_fail(
          ctx, FS_ERR_UNSUPPORTED,
          "no patch fits face %d: it is no quadrilateral, lies next to one that is not, or its special vertex is "
          "too close to another one or to the boundary",
          f);
  return FS_OK;
}

fs_status fs_space_create(fs_context *ctx, const fs_mesh *mesh, fs_space **result) {
  return fs_space_create_with(ctx, mesh, NULL, result);
}

static fs_status set_options(fs_context *ctx, const fs_space_options *given, fs_space_options *options) {
  if (given != NULL) *options = *given;
  if (options->caps != FS_CAPS_LINEAR && options->caps != FS_CAPS_SMOOTH && options->caps != FS_CAPS_FULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "there is no kind of caps with the number %d", (int)options->caps);
  if (options->max_full_valence < 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "full caps up to valence %d: it must not be negative",
                   options->max_full_valence);
  if (options->max_full_valence == 0) options->max_full_valence = DEFAULT_FULL_VALENCE;
  return FS_OK;
}

fs_status fs_space_create_with(fs_context *ctx, const fs_mesh *mesh, const fs_space_options *options,
                               fs_space **result) {
  fs_status status = FS_OK;
  fs_space *space = NULL;
  int32_t *owner = NULL, n_covered = 0;
  fs_space_builder builder = {.ctx = ctx, .mesh = mesh};
  FS_TRY(set_options(ctx, options, &builder.options));
  if (builder.options.kept != NULL) FS_TRY(fs_space_find_caps(ctx, mesh, builder.options.kept, &builder.note_of));
  FS_ALLOC(ctx, space, 1);
  builder.space = space;
  FS_ALLOC(ctx, owner, mesh->n_faces);
  FS_TRY(fs_claim_faces(ctx, mesh, owner));
  FS_TRY(check_owners(ctx, mesh, owner));
  space->n_vertices = space->n_dofs = mesh->n_vertices;
  space->continuity = 2;
  for (int32_t f = 0; f < mesh->n_faces; f++) n_covered += fs_patch_rules[owner[f]] != &fs_rule_trim;
  if (n_covered == 0) {
    status = fs_fail(ctx, FS_ERR_UNSUPPORTED,
                     "no face has a full net: each of the %d faces has a vertex on the boundary", mesh->n_faces);
    goto done;
  }
  FS_ALLOC(ctx, space->element, n_covered);
  for (int32_t rule = 0; fs_patch_rules[rule] != NULL; rule++)
    FS_TRY(fs_patch_rules[rule]->build(ctx, mesh, rule, owner, &builder));
  FS_TRY(connect(ctx, mesh, space));
  FS_ALLOC(ctx, space->start, space->n_dofs);
  memcpy(space->start, mesh->position, (size_t)mesh->n_vertices * sizeof *space->start);
  fs_builder_take_caps(&builder, space, space->start);
  *result = space;
  space = NULL;
done:
  fs_release(ctx, owner);
  fs_release(ctx, builder.note_of);
  fs_space_free(ctx, space);
  return status;
}

void fs_space_free(fs_context *ctx, fs_space *space) {
  if (space == NULL) return;
  for (int32_t i = 0; i < space->n_extractions; i++)
    if (!space->extraction[i].is_borrowed) {
      fs_release(ctx, space->extraction[i].E);
      fs_release(ctx, space->extraction[i].chart);
      fs_release(ctx, space->extraction[i].segment);
    }
  fs_release(ctx, space->extraction);
  fs_release(ctx, space->element);
  fs_release(ctx, space->cap);
  fs_release(ctx, space->dof);
  fs_release(ctx, space->start);
  fs_release(ctx, space);
}

static fs_status validate_extraction(fs_context *ctx, const fs_extraction *x, int32_t index) {
  int32_t n_points = (x->degree_u + 1) * (x->degree_v + 1);
  for (int32_t r = 0; r < n_points; r++) {
    double sum = 0;
    for (int32_t i = 0; i < x->n_dofs - x->n_offsets; i++) sum += x->E[(size_t)r * x->n_dofs + i];
    if (!(fabs(sum - 1) <= 1e-11))
      return fs_fail(ctx, FS_ERR_NUMERIC, "row %d of extraction %d sums to %.17g instead of 1", r, index, sum);
  }
  return FS_OK;
}

fs_status fs_space_validate(fs_context *ctx, const fs_space *space) {
  fs_status status = FS_OK;
  for (int32_t i = 0; i < space->n_extractions; i++) FS_TRY(validate_extraction(ctx, &space->extraction[i], i));
  for (int32_t i = 0; i < space->n_elements; i++) {
    const fs_element *e = &space->element[i];
    const fs_extraction *x = &space->extraction[e->extraction];
    for (int32_t d = 0; d < x->n_dofs; d++) {
      int32_t dof = space->dof[e->dof_start + d];
      bool is_offset = d >= x->n_dofs - x->n_offsets;
      if (dof < (is_offset ? space->n_vertices : 0) || dof >= (is_offset ? space->n_dofs : space->n_vertices))
        return fs_fail(ctx, FS_ERR_ARGUMENT, "element %d uses dof %d of %d as %s", i, dof, space->n_dofs,
                       is_offset ? "an offset" : "a vertex");
    }
    for (int side = 0; side < 4; side++) {
      int32_t other = e->neighbour[side];
      if (other == FS_NONE) continue;
      const fs_element *o = &space->element[other];
      if (o->neighbour[e->neighbour_side[side]] != i || o->neighbour_side[e->neighbour_side[side]] != side)
        return fs_fail(ctx, FS_ERR_TOPOLOGY, "side %d of element %d meets element %d, but not the other way", side, i,
                       other);
    }
  }
done:
  return status;
}
