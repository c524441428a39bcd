/* SPDX-License-Identifier: MIT */
/* fairsurf: from a polygon control mesh to a fair, curvature continuous surface and its files.
   The headers below follow the path of the data. */
#ifndef FAIRSURF_FAIRSURF_H
#define FAIRSURF_FAIRSURF_H

#include <fairsurf/base.h>
#include <fairsurf/mesh.h>
#include <fairsurf/refine.h>
#include <fairsurf/space.h>
#include <fairsurf/fair.h>
#include <fairsurf/surface.h>
#include <fairsurf/surface_splines.h>
#include <fairsurf/construct.h>
#include <fairsurf/construct_stacho.h>
#include <fairsurf/construct_junction.h>
#include <fairsurf/construct_gap.h>
#include <fairsurf/analyse.h>
#include <fairsurf/analyse_curves.h>
#include <fairsurf/export.h>
#include <fairsurf/file.h>

#endif
