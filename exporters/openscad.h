/* SPDX-License-Identifier: MIT */
/* What the files of the OpenSCAD exporter share. */
#ifndef FS_EXPORTERS_OPENSCAD_H
#define FS_EXPORTERS_OPENSCAD_H

#include <fairsurf/export.h>
#include "solid.h"
#include "writer.h"

enum { FS_OPENSCAD_NAME = 64 };
/* A legal identifier that is no word of the language: "3-way pipe" gives "_3_way_pipe", "cube" gives "cube_surface". */
void fs_openscad_name(const char *stem, char name[FS_OPENSCAD_NAME]);

enum { FS_INWARDS, FS_OUTWARDS };

/* What there is to know of a surface before it is cut into triangles, from 9 x 9 points per patch. */
typedef struct fs_survey {
  fs_vec3 min, max;
  double bend; /* largest |h11| + 2 |h12| + |h22| of a patch (n.p_uu, n.p_uv, n.p_vv), each the largest of its points */
  double radius[2]; /* smallest radius of curvature on each side; INFINITY: flat or bent the other way everywhere */
  fs_vec3 place[2]; /* where that is, and on which patch */
  int32_t patch[2];
} fs_survey;
fs_status fs_survey_surface(fs_context *ctx, const fs_surface *surface, fs_survey *survey);

/* About how far the surface is from n x n cells of triangles per patch: a function on a triangle with legs 1/n stays within
   (max |f_uu| + 2 max |f_uv| + max |f_vv|) / (8 n^2) of its linear interpolant [Filip Magedson Markot 1986], here applied to
   the direction of the normal. */
double fs_survey_deviation(const fs_survey *survey, int32_t n_steps);

typedef struct fs_openscad_file {
  const fs_model *model;
  char name[FS_OPENSCAD_NAME];
  const fs_survey *survey;
  const fs_triangles *triangles;
  const fs_rim *rim; /* no loops: the surface is closed */
  int32_t n_steps;
  bool is_reversed;  /* the triangles are inside out */
  double wall, side; /* of open surfaces: thickness, and -1, 0, 1: inwards, both, outwards */
} fs_openscad_file;
fs_status fs_openscad_write(fs_context *ctx, const fs_openscad_file *file, const fs_output *output);

extern const fs_exporter fs_exporter_openscad;

#endif
