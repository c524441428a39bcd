/* SPDX-License-Identifier: MIT */
/* Constraints of the command fair: their options, and what is made of them for the mesh. */
#ifndef FS_CLI_CONSTRAINTS_H
#define FS_CLI_CONSTRAINTS_H

#include <fairsurf/fairsurf.h>

enum { MAX_REGIONS = 64 };

/* Vertices in a box or on a plane. */
typedef struct region {
  bool is_box;
  double number[6]; /* x0 y0 z0 x1 y1 z1; or a b c d of a x + b y + c z = d */
} region;

typedef struct constraint_arguments {
  int32_t n_regions;
  region region[MAX_REGIONS];
  const char *points, *equations, *stay_near; /* files, or NULL */
  bool is_symmetric, is_plane_given;
  double plane[4];
  double stay_within; /* 0: any distance */
  fs_keep keep;
} constraint_arguments;

struct argp;
extern const struct argp constraint_argp; /* a child; its input is a constraint_arguments */

/* Reads COUNT numbers with commas between them and nothing else. */
bool read_numbers(const char *text, int count, double *number);

/* Constraints and what they point to. */
typedef struct constraint_set {
  fs_constraints constraints;
  fs_symmetry *symmetry;
  fs_surface *start;
  fs_nearest *nearest, *near_mesh; /* on the start; on the mesh of --stay-near */
  fs_target target;
  fs_hold *hold;
  fs_equation *equation;
  int32_t *dof; /* of all equations, one after the other */
  double *weight;
  char *names; /* of holds and equations */
} constraint_set;

/* fixed[n_dofs] receives the vertices in regions; the rest goes to the set, which borrows nothing but the arguments. is_refined:
   the mesh is not the one that was read, so that numbers of its vertices and faces mean something else. c[n_dofs]: the start. */
fs_status make_constraints(fs_context *ctx, const constraint_arguments *arguments, const fs_mesh *mesh,
                           const fs_space *space, const fs_vec3 *c, bool is_refined, bool *fixed, constraint_set *set);
void free_constraints(fs_context *ctx, constraint_set *set);

/* The parts of a set that stand in files. */
fs_status read_points(fs_context *ctx, const char *path, const fs_space *space, bool is_refined, constraint_set *set);
fs_status read_equations(fs_context *ctx, const char *path, const fs_space *space, bool is_refined,
                         constraint_set *set);

#endif
