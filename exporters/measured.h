/* SPDX-License-Identifier: MIT */
/* Values of a measure at the vertices of triangles. */
#ifndef FS_EXPORTERS_MEASURED_H
#define FS_EXPORTERS_MEASURED_H

#include <fairsurf/analyse.h>

/* value[n_vertices] of the measure with the initial values of its parameters; NaN where it has none. */
fs_status fs_measure_vertices(fs_context *ctx, const fs_surface *surface, const fs_measure *measure,
                              const fs_triangles *t, double *value);

/* The values at the ends of a ramp of colours: the 2nd and the 98th of 100, since a few wild points must not take them
   all; low < high whatever the values are. */
fs_status fs_measure_range(fs_context *ctx, const double *value, size_t n, double *low, double *high);

#endif
