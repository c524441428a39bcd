/* SPDX-License-Identifier: MIT */
/* The table of constructions. */
#include "construct/construct.h"
#include "base/base.h"

#include <string.h>

const fs_construction *const fs_constructions[] = {&fs_construction_gregory,
                                                   &fs_construction_coons,
                                                   &fs_construction_stacho,
                                                   &fs_construction_stacho_graph,
                                                   &fs_construction_junction,
                                                   &fs_construction_gap,
                                                   NULL};

const fs_construction *fs_construction_find(const char *name) {
  for (const fs_construction *const *c = fs_constructions; *c != NULL; c++)
    if (strcmp((*c)->name, name) == 0) return *c;
  return NULL;
}

fs_status fs_construct(fs_context *ctx, const fs_construction *construction, const fs_construction_input *input,
                       const double *param, fs_surface **surface) {
  fs_status status = FS_OK;
  double *initial = NULL;
  size_t n = 0;
  if (construction->takes == FS_TAKES_MESH && input->mesh == NULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the construction %s needs a mesh", construction->name);
  if (construction->takes == FS_TAKES_SPLINES && input->splines == NULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "the construction %s needs splines", construction->name);
  if (param != NULL || construction->params == NULL) return construction->build(ctx, input, param, surface);
  while (construction->params[n].name != NULL) n++;
  FS_ALLOC(ctx, initial, n);
  for (size_t k = 0; k < n; k++) initial[k] = construction->params[k].initial;
  FS_TRY(construction->build(ctx, input, initial, surface));
done:
  fs_release(ctx, initial);
  return status;
}
