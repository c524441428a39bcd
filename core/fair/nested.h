/* SPDX-License-Identifier: MIT */
/* Coarse surfaces first, where a mesh is a refinement. */
#ifndef FS_FAIR_NESTED_H
#define FS_FAIR_NESTED_H

#include "fair/course.h"

/* Fairs the surfaces of the meshes of which the course's is a refinement, the coarsest first, and adds their displacements to
   the unknowns c->x. Fixed dofs do not move. Leaves c->x alone where there is no coarse mesh with enough free vertices that
   has a surface; report->n_coarse counts those that were faired. *is_over: cancelled, out of time or out of steps. */
fs_status fs_nested_start(fs_course *course, bool *is_over);

#endif
