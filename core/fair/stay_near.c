/* SPDX-License-Identifier: MIT */
/* Single role: a start that is near enough, and a result that is proved to be: the distance is measured, and where it is too
   large the unknowns go back on the straight way to the start, on which the start itself is near enough. */
#include "fair/stay_near.h"

#include <math.h>

enum { MAX_HALVINGS = 12 };

fs_status fs_stay_near_begin(fs_setup *s, const fs_constraints *k, const double *y) {
  fs_status status = FS_OK;
  fs_context *ctx = s->problem->ctx;
  double distance = 0;
  int32_t face = FS_NONE;
  if (!(k->tolerance > 0) || !isfinite(k->tolerance) || k->target == NULL || k->target->distance == NULL)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "a tolerance of %g needs to be above 0 and to have a target", k->tolerance);
  FS_TRY(fs_wall_create(s->problem, k->target, k->tolerance, &s->wall));
  fs_setup_place(s, y);
  FS_TRY(fs_wall_measure(s->wall, &distance, &face));
  if (!(distance < 0.999 * k->tolerance)) {
    status =
        fs_fail(ctx, FS_ERR_UNSUPPORTED,
                "the tolerance %g cannot be met: the start, moved to meet the other constraints, is at the distance %g "
                "from the target on face %d",
                k->tolerance, distance, face);
    goto done;
  }
  s->wall->limit = fmax(0.98 * k->tolerance, 0.5 * (distance + k->tolerance));
done:
  return status;
}

fs_status fs_stay_near_retract(fs_setup *s, double limit, const double *start, double *y, double *distance) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)fs_setup_n(s);
  double low = 0, high = 1, measured, *far = NULL;
  int32_t face;
  fs_setup_place(s, y);
  FS_TRY(fs_wall_measure(s->wall, distance, &face));
  if (*distance <= limit) return FS_OK;
  FS_ALLOC(s->problem->ctx, far, n);
  for (size_t i = 0; i < n; i++) far[i] = y[i];
  for (int k = 0; k < MAX_HALVINGS; k++) {
    double t = 0.5 * (low + high);
    for (size_t i = 0; i < n; i++) y[i] = start[i] + t * (far[i] - start[i]);
    fs_setup_place(s, y);
    FS_TRY(fs_wall_measure(s->wall, &measured, &face));
    if (measured <= limit)
      low = t;
    else
      high = t;
  }
  for (size_t i = 0; i < n; i++) y[i] = start[i] + low * (far[i] - start[i]);
  fs_setup_place(s, y);
  FS_TRY(fs_wall_measure(s->wall, distance, &face));
done:
  fs_release(s->problem->ctx, far);
  return status;
}
