/* SPDX-License-Identifier: MIT */
/* Single role: the table of refiners, and what all refinements have in common. */
#include "refine/refine.h"

#include <math.h>
#include <string.h>

const fs_refiner *const fs_refiners[] = {&fs_refiner_averaging, &fs_refiner_catmull_clark, NULL};

enum { MAX_PARAMS = 16 };

static const fs_refiner *find(const char *name) {
  for (int32_t i = 0; fs_refiners[i] != NULL; i++)
    if (strcmp(fs_refiners[i]->name, name) == 0) return fs_refiners[i];
  return NULL;
}

static fs_status fail_unknown(fs_context *ctx, const char *name) {
  char known[160] = "";
  for (int32_t i = 0; fs_refiners[i] != NULL; i++) {
    if (i > 0) strncat(known, ", ", sizeof known - strlen(known) - 1);
    strncat(known, fs_refiners[i]->name, sizeof known - strlen(known) - 1);
  }
  return fs_fail(ctx, FS_ERR_UNSUPPORTED, "no refinement is called \"%.40s\"; there are: %s", name, known);
}

/* The given numbers, or the initial ones, checked against their ranges. */
static fs_status take_params(fs_context *ctx, const fs_param *list, const double *given, double *param) {
  for (int32_t i = 0; i < MAX_PARAMS && list[i].name != NULL; i++) {
    param[i] = given != NULL ? given[i] : list[i].initial;
    if (!(param[i] >= list[i].min && param[i] <= list[i].max))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%s is %g, not between %g and %g", list[i].name, param[i], list[i].min,
                     list[i].max);
  }
  return FS_OK;
}

fs_status fs_mesh_refine(fs_context *ctx, const fs_mesh *mesh, const char *name, const double *param,
                         fs_refinement **refinement) {
  const fs_refiner *refiner = find(name);
  double checked[MAX_PARAMS] = {0};
  fs_status status = FS_OK;
  if (refiner == NULL) return fail_unknown(ctx, name);
  FS_TRY(take_params(ctx, refiner->params, param, checked));
  FS_TRY(refiner->refine(ctx, mesh, checked, refinement));
done:
  return status;
}

static fs_status check_positions(fs_context *ctx, const fs_mesh *mesh) {
  for (int32_t i = 0; i < mesh->n_vertices; i++) {
    fs_vec3 p = mesh->position[i];
    if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z))
      return fs_fail(ctx, FS_ERR_NUMERIC, "the position of refined vertex %d is not finite", i);
  }
  return FS_OK;
}

fs_status fs_refinement_assemble(fs_context *ctx, const fs_mesh *coarse, fs_mesh **fine, fs_stencils *stencils,
                                 fs_refinement **refinement) {
  fs_refinement *result = NULL;
  fs_status status = FS_OK;
  FS_TRY(fs_stencils_sort(ctx, stencils));
  FS_ALLOC(ctx, result, 1);
  result->mesh = *fine;
  result->n_coarse = coarse->n_vertices;
  result->row_start = stencils->start;
  result->column = stencils->column;
  result->weight = stencils->weight;
  fs_refinement_apply(result, coarse->position, (*fine)->position);
  FS_TRY(check_positions(ctx, *fine));
  *refinement = result;
  result = NULL;
  *fine = NULL;
  *stencils = (fs_stencils){0};
done:
  fs_release(ctx, result);
  return status;
}

void fs_refinement_free(fs_context *ctx, fs_refinement *refinement) {
  if (refinement == NULL) return;
  fs_mesh_free(ctx, refinement->mesh);
  fs_release(ctx, refinement->row_start);
  fs_release(ctx, refinement->column);
  fs_release(ctx, refinement->weight);
  fs_release(ctx, refinement);
}

void fs_refinement_marks(const fs_refinement *refinement, const bool *coarse, bool *fine) {
  for (int32_t i = 0; i < refinement->mesh->n_vertices; i++) {
    fine[i] = true;
    for (int32_t j = refinement->row_start[i]; j < refinement->row_start[i + 1]; j++)
      fine[i] = fine[i] && (refinement->weight[j] == 0 || coarse[refinement->column[j]]);
  }
}

void fs_refinement_apply(const fs_refinement *refinement, const fs_vec3 *coarse, fs_vec3 *fine) {
  for (int32_t i = 0; i < refinement->mesh->n_vertices; i++) {
    fs_vec3 sum = {0, 0, 0};
    for (int32_t j = refinement->row_start[i]; j < refinement->row_start[i + 1]; j++) {
      fs_vec3 p = coarse[refinement->column[j]];
      sum.x += refinement->weight[j] * p.x;
      sum.y += refinement->weight[j] * p.y;
      sum.z += refinement->weight[j] * p.z;
    }
    fine[i] = sum;
  }
}
