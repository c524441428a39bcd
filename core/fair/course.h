/* SPDX-License-Identifier: MIT */
/* The course of a fairing: what its stages share. */
#ifndef FS_FAIR_COURSE_H
#define FS_FAIR_COURSE_H

#include "fair/constrain.h"
#include "fair/stages.h"

/* The whole fairing. */
typedef struct fs_course {
  fs_context *ctx;
  const fs_fair_options *options;
  fs_fair_report *report;
  fs_setup setup;
  bool *fixed;      /* along normals: with the inner coefficients */
  fs_base base;     /* with linear constraints: the dofs by fewer numbers */
  int32_t n_coarse; /* depths that there are */
  fs_reduction *coarse[FS_MAX_COARSE];
  int32_t depth; /* of the solver and the unknowns */
  fs_solver *solver;
  fs_damping damping;
  double *x, *y, *g, gradient_start; /* x: the unknowns of depth 0; y: those of others, while they are */
  double *begin, excess;     /* with a wall: the last x that kept the tolerance; how far samples are beyond it */
  double wall_tolerance;     /* predicted decrease at which a stage ends */
  int32_t n_rounds;          /* so many times the last stage was begun with the same wall */
  double start;              /* seconds */
  int32_t n_earlier_steps;   /* of the stages before */
  int32_t n_stages;          /* before */
  double last_damping;       /* in the last factorisation */
  double first_damping;      /* of the first step over these unknowns, which the next begin with; of the coarsest: 0 */
  double value, begin_value; /* at x, and at the start of the last minimisation */
  bool is_out_of_time;
} fs_course;

/* Minimises from x on as the stage says. *is_over: cancelled, out of time or out of steps. */
fs_status fs_course_run_stage(fs_course *course, const fs_stage *stage, bool *is_over);

/* Back to depth 0, without a solver. */
void fs_course_leave_depth(fs_course *course);

/* ---- with a tolerance -------------------------------------------------------------------------------------------- */

/* The wall at the constraints' tolerance, with x within it. */
fs_status fs_course_begin_near(fs_course *course);

/* A stiffness of the wall at which going as far again beyond it everywhere would cost many times the functional. */
fs_status fs_course_stiffen_wall(fs_course *course, const fs_objective *objective);

/* Repeats the last stage until the forces hold the surface at the wall; what then still is beyond the tolerance goes back
   towards the start. */
fs_status fs_course_press_to_wall(fs_course *course, const fs_stage *last, bool is_over);

#endif
