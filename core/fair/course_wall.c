/* SPDX-License-Identifier: MIT */
/* Single role: the course of a fairing under a tolerance: how stiff the wall is, and how its forces are learnt. */
#include "fair/course.h"
#include "fair/stay_near.h"

#include <math.h>
#include <string.h>

enum { MAX_ROUNDS = 24, WALL_SHARE = 100 };
static const double WALL_EXCESS = 0.004; /* relative to the tolerance */
static const double WALL_TOLERANCE = 1e-4,
                    WALL_LAST_TOLERANCE = 1e-7; /* decreases while the forces are learnt, and at the end */

fs_status fs_course_stiffen_wall(fs_course *c, const fs_objective *objective) {
  fs_status status = FS_OK;
  fs_wall *wall = c->setup.wall;
  double f;
  c->setup.wall = NULL;
  status = objective->gradient(objective->self, c->x, &f, c->g);
  c->setup.wall = wall;
  if (status == FS_ERR_CANCELLED) return FS_OK; /* the minimisation will hear of it too */
  if (status != FS_OK) return status;
  wall->stiffness =
      WALL_SHARE * fabs(f) / ((double)wall->start[wall->problem->space->n_elements] * pow(wall->limit, 2));
  return FS_OK;
}

fs_status fs_course_begin_near(fs_course *c) {
  fs_status status = FS_OK;
  size_t n = 3 * (size_t)fs_setup_n(&c->setup);
  if (c->options->start_triharmonic)
    return fs_fail(c->ctx, FS_ERR_UNSUPPORTED, "a tolerance needs the start as it is, not the triharmonic surface");
  FS_ALLOC(c->ctx, c->begin, n);
  memcpy(c->begin, c->x, n * sizeof *c->begin);
  c->wall_tolerance = WALL_TOLERANCE;
  FS_TRY(fs_stay_near_begin(&c->setup, c->options->constraints, c->x));
done:
  return status;
}

fs_status fs_course_press_to_wall(fs_course *c, const fs_stage *last, bool is_over) {
  fs_status status = FS_OK;
  fs_wall *wall = c->setup.wall;
  double tolerance = c->options->constraints->tolerance, limit = (1 - 1e-12) * tolerance, distance, before;
  int32_t face;
  for (c->n_rounds = 1; c->n_rounds <= MAX_ROUNDS && !is_over; c->n_rounds++) {
    if (c->excess <= WALL_EXCESS * tolerance) {
      FS_TRY(fs_wall_measure(wall, &distance, &face));
      if (distance <= limit) { /* the next round is more precise; whatever comes, there is a way back to here */
        memcpy(c->begin, c->x, 3 * (size_t)fs_setup_n(&c->setup) * sizeof *c->x);
        if (c->wall_tolerance <= WALL_LAST_TOLERANCE) break;
        c->wall_tolerance *= 0.1;
      } else {
        wall->limit -= 1.1 * (distance - tolerance); /* there is more between the samples */
      }
    }
    before = c->excess;
    FS_TRY(fs_course_run_stage(c, last, &is_over));
    if (c->excess > 0.25 * before) wall->stiffness *= 4;
  }
  FS_TRY(fs_stay_near_retract(&c->setup, limit, c->begin, c->x, &c->report->distance));
done:
  return status;
}
