/* SPDX-License-Identifier: MIT */
/* What the files of the POV-Ray exporter share. */
#ifndef FS_EXPORTERS_POVRAY_H
#define FS_EXPORTERS_POVRAY_H

#include <fairsurf/export.h>
#include "writer.h"

/* Names: at most 31 letters, so that NAME_Included stays within the 40 that old versions of the program tell apart. */
enum { FS_POVRAY_NAME = 32 };
void fs_povray_name(const char *stem, char name[FS_POVRAY_NAME]);
bool fs_povray_is_reserved(const char *word);

/* Numbers rounded to some digits, with a point whatever the locale says. */
void fs_povray_number(fs_writer *writer, double value, int digits);
void fs_povray_vector(fs_writer *writer, fs_vec3 value, int digits); /* <x,y,z> */
/* stem and extension in quotes, as the language writes names of files. */
void fs_povray_file(fs_writer *writer, const char *stem, const char *extension);

/* A surface as bicubic Bezier patches. Patches of degree 3 and less stay one piece; others become 2^m x 2^m.
   Along a side that two patches share the points of both are the same doubles; where a whole patch meets a divided one
   the points of the latter are those of the halved curve. */
typedef struct fs_povray_pieces {
  int32_t n_patches, n_whole, n_divided, m;
  bool is_tensor; /* all divided ones are tensor Bezier patches: caps */
  size_t n_pieces;
  size_t *first;    /* [n_patches + 1] first piece of each patch; piece (a, b) of a divided one is number a + 2^m b */
  fs_vec3 *point;   /* [16 n_pieces] u fastest */
  double deviation; /* largest distance of points at equal parameters from the divided patches, 8x8 points per piece */
  double angle;     /* largest angle between normals across a side of a divided patch, radians */
} fs_povray_pieces;
fs_status fs_povray_pieces_create(fs_context *ctx, const fs_surface *surface, double tolerance, int32_t max_m,
                                  fs_povray_pieces **pieces);
void fs_povray_pieces_free(fs_context *ctx, fs_povray_pieces *pieces); /* NULL is allowed */

bool fs_povray_is_whole(const fs_patch *patch);

typedef enum fs_povray_scene {
  FS_POVRAY_SHADED,
  FS_POVRAY_ZEBRA,
  FS_POVRAY_ISOPHOTE,
  FS_POVRAY_CURVATURE,
  FS_POVRAY_TURNTABLE,
} fs_povray_scene;

extern const fs_exporter fs_exporter_povray;

/* What both files say. */
typedef struct fs_povray_model {
  const fs_model *model;
  char name[FS_POVRAY_NAME];
  fs_vec3 min, max; /* of points of the surface, 8x8 steps per patch */
  bool is_turning;  /* about the vertical line through the middle of the box: the camera sees it from all sides */
  double distance;  /* of the camera from the middle of that box */
  int32_t steps;    /* each patch shows as 2^steps x 2^steps quadrilaterals */
  double tolerance; /* length */
} fs_povray_model;

fs_status fs_povray_write_bicubic(fs_context *ctx, const fs_povray_model *model, const fs_povray_pieces *pieces,
                                  const fs_output *output);

/* colour, a line of fs_measures or a measure of the caller's, becomes the first coordinate of uv_vectors; or NULL. */
fs_status fs_povray_write_mesh(fs_context *ctx, const fs_povray_model *model, const fs_measure *colour,
                               const fs_output *output);
fs_status fs_povray_write_scene(fs_context *ctx, const fs_povray_model *model, fs_povray_scene scene,
                                const fs_output *output);
/* NAME.curves.inc: the curves of the model. */
fs_status fs_povray_write_curves(fs_context *ctx, const fs_povray_model *model, const fs_output *output);
/* NAME.ini, with which the renderer makes n_frames pictures of one turn. */
fs_status fs_povray_write_turn(fs_context *ctx, const fs_povray_model *model, int32_t n_frames,
                               const fs_output *output);

/* The direction from the middle of the box to the camera, and the tangent of half the angle that the points fill. */
#define FS_POVRAY_DIRECTION ((fs_vec3){2.3, -2.9, 2.3})
#define FS_POVRAY_TANGENT 0.25
fs_status fs_povray_find_view(fs_context *ctx, fs_povray_model *model); /* sets min, max, distance */

/* The lines before the object, common to both forms: what it is, how it was made, guard, box. */
void fs_povray_write_head(fs_writer *writer, const fs_povray_model *model);

#endif
