/* SPDX-License-Identifier: MIT */
/* Single role: the size of a surface of which nothing is fixed, its area or its volume: measured, kept, given back. */
#include "fair/setup.h"
#include "math/vec3.h"

#include <string.h>

enum { NODES_SQUARE = 20, NODES_CAP = 28 };

fs_status fs_setup_keep_volume(fs_setup *s) {
  fs_status status = FS_OK;
  double volume, integral[FS_MAX_TERMS + 2];
  fs_problem *p = s->problem;
  if (!s->functional->is_scale_free)
    return fs_fail(p->ctx, FS_ERR_UNSUPPORTED, "the volume is kept by functionals that are free of scale, not by %s",
                   s->functional->name);
  FS_TRY(fs_volume_create(p, &s->volume));
  FS_TRY(fs_volume_evaluate(s->volume, FS_VALUE, 0, &volume, NULL, NULL));
  FS_TRY(fs_problem_evaluate(p, FS_VALUE, integral, NULL, NULL, NULL));
  s->volume_sign = volume < 0 ? -1 : 1;
  if (!(fabs(volume) > 1e-9 * pow(integral[s->term_A], 1.5))) {
    status = fs_fail(p->ctx, FS_ERR_ARGUMENT, "the surface encloses the volume %g, which cannot be kept", volume);
    goto done;
  }
  s->volume_factor = integral[s->term_A] / cbrt(volume * volume);
done:
  return status;
}

/* The area with more nodes than the functional has. */
static fs_status fine_area(const fs_problem *p, double *area) {
  static const fs_density *const term[1] = {&fs_density_area};
  fs_status status = FS_OK;
  fs_problem *fine = NULL;
  bool *fixed = NULL;
  FS_ALLOC(p->ctx, fixed, p->space->n_dofs);
  memset(fixed, true, (size_t)p->space->n_dofs * sizeof *fixed);
  FS_TRY(fs_problem_create(p->ctx, p->space, 1, term, fixed, NODES_SQUARE, NODES_CAP, p->c, &fine));
  FS_TRY(fs_problem_evaluate(fine, FS_VALUE, area, NULL, NULL, NULL));
done:
  fs_problem_free(p->ctx, fine);
  fs_release(p->ctx, fixed);
  return status;
}

fs_status fs_setup_size(fs_setup *s, double *size) {
  if (s->volume != NULL) return fs_volume_evaluate(s->volume, FS_VALUE, 0, size, NULL, NULL);
  return fine_area(s->problem, size);
}

fs_status fs_setup_restore_size(fs_setup *s, double size) {
  fs_status status = FS_OK;
  fs_problem *p = s->problem;
  const fs_space *space = p->space;
  double now, factor;
  fs_vec3 centre = {0, 0, 0};
  FS_TRY(fs_setup_size(s, &now));
  factor = s->volume != NULL ? cbrt(size / now) : sqrt(size / now);
  for (int32_t v = 0; v < space->n_vertices; v++) centre = fs_vec3_add_scaled(centre, p->c[v], 1.0 / space->n_vertices);
  for (int32_t d = 0; d < space->n_dofs; d++) { /* dofs beyond the vertices are offsets */
    fs_vec3 origin = d < space->n_vertices ? centre : (fs_vec3){0, 0, 0};
    p->c[d] = fs_vec3_add_scaled(origin, fs_vec3_sub(p->c[d], origin), factor);
  }
done:
  return status;
}
