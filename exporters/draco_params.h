/* SPDX-License-Identifier: MIT */
/* Parameters that all exporters with Draco compression have. */
#ifndef FS_EXPORTERS_DRACO_PARAMS_H
#define FS_EXPORTERS_DRACO_PARAMS_H

#include <fairsurf/base.h>

#define FS_PARAM_POSITION_BITS                                                                                  \
  {                                                                                                             \
    .name = "position-bits", .summary = "bits per coordinate of triangles; 0: single precision", .initial = 14, \
    .min = 0, .max = 30                                                                                         \
  }
/* 8 bits, usual elsewhere, are off by 0.9 degrees: stripes on a smooth surface are torn. 12 bits: 0.06 degrees. */
#define FS_PARAM_NORMAL_BITS \
  { .name = "normal-bits", .summary = "bits per coordinate of normals", .initial = 12, .min = 2, .max = 30 }
#define FS_PARAM_MEASURE_BITS \
  { .name = "measure-bits", .summary = "bits of a measure; 0: single precision", .initial = 12, .min = 0, .max = 30 }

#endif
