/* SPDX-License-Identifier: MIT */
/* Walking on a surface of four-sided patches along principal directions. */
#ifndef FS_ANALYSE_WALK_H
#define FS_ANALYSE_WALK_H

#include "analyse/curves.h"

/* A walker: where it stands, and the unit tangent along which it goes. */
typedef struct fs_walker {
  const fs_surface *surface;
  int32_t family;   /* 0: the larger principal curvature, 1: the smaller */
  double tolerance; /* error of a step */
  fs_place place;
  fs_vec3 position, normal, direction;
} fs_walker;

typedef enum fs_walk_end { FS_WALK_GOES_ON, FS_WALK_BORDER, FS_WALK_UMBILIC } fs_walk_end;

/* Stands at a place; false at an umbilic and where there is no normal. The direction is that of the family, with the sign
   that goes along `along` where that is not zero. */
bool fs_walker_start(fs_walker *walker, fs_place place, fs_vec3 along);

/* One step of at most *length, which becomes the length for the next one; done gets what was walked. It ends on a side of
   the patch at the latest; the walker then stands on the patch beyond. */
fs_walk_end fs_walker_step(fs_walker *walker, double *length, double *done);

#endif
