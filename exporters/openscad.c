/* SPDX-License-Identifier: MIT */
/* Single role: the OpenSCAD exporter: chooses triangles and wall, warns of walls that fold, and hands over to the writer. */
#include "openscad.h"
#include "base/base.h"
#include "math/vec3.h"

enum { WALL, SIDE, STEPS, TOLERANCE, TRIANGLES, N_PARAMS };

/* Booleans take 3 s for 10 000 triangles, 13 s for 50 000; points nearer than 2^-20 are joined. */
enum { MANY_TRIANGLES = 50000 };
#define JOINED_DISTANCE 0x1p-20

static const fs_param params[] = {
    [WALL] = {"wall", "thickness given to open surfaces; 0: chosen from size and curvature", 0, 0, 1e9, NULL},
    [SIDE] = {"side", "where the wall grows from the surface", 0, 0, 2,
              (const char *const[]){"inwards", "both", "outwards", NULL}},
    [STEPS] = {"steps", "quadrilaterals along a patch side; 0: as the tolerance asks", 0, 0, 1024, NULL},
    [TOLERANCE] = {"tolerance", "largest distance of the triangles from the surface, as part of the box diagonal", 1e-3,
                   1e-9, 1, NULL},
    [TRIANGLES] = {"triangles", "most triangles of the surface where steps is 0", 10000, 2, 1e7, NULL},
    [N_PARAMS] = {0},
};

static fs_status choose_steps(fs_context *ctx, const fs_surface *surface, const fs_survey *survey, const double *param,
                              int32_t *n_steps) {
  double tolerance = param[TOLERANCE] * fs_vec3_distance(survey->min, survey->max), n_wanted, n_most;
  if (param[STEPS] >= 1) {
    *n_steps = (int32_t)param[STEPS];
    return FS_OK;
  }
  n_wanted = tolerance > 0 ? ceil(sqrt(survey->bend / (8 * tolerance))) : 1;
  n_most = fmax(1, floor(sqrt(param[TRIANGLES] / (2.0 * surface->n_patches))));
  *n_steps = (int32_t)fmin(fmax(n_wanted, 1), fmin(n_most, 1024));
  if (2.0 * surface->n_patches > param[TRIANGLES])
    fs_note(ctx, "the surface has %d patches of at least two triangles each, more than the %.0f triangles wanted",
            (int)surface->n_patches, param[TRIANGLES]);
  else if (*n_steps < n_wanted)
    fs_note(ctx, "%d triangles stay within about %.2g of the surface, not within %.2g: raise triangles for more",
            (int)(2 * surface->n_patches * *n_steps * *n_steps), fs_survey_deviation(survey, *n_steps), tolerance);
  return FS_OK;
}

/* Largest of 1, 2, 5 times a power of ten that is not above length. */
static double round_length(double length) {
  double power = pow(10, floor(log10(length)));
  double factor = length / power;
  return power * (factor >= 5 ? 5 : factor >= 2 ? 2 : 1);
}

/* How far a wall reaches to each side. */
static double reach(double wall, double side, int32_t direction) {
  return direction == FS_INWARDS ? (1 - side) / 2 * wall : (1 + side) / 2 * wall;
}

/* A fiftieth of the box, and at most half of the radius of curvature. */
static double choose_wall(const fs_survey *survey, double side) {
  double wall = fs_vec3_distance(survey->min, survey->max) / 50;
  for (int32_t i = 0; i < 2; i++)
    if (reach(1, side, i) > 0) wall = fmin(wall, survey->radius[i] / 2 / reach(1, side, i));
  return round_length(wall);
}

static void warn_of_folds(fs_context *ctx, const fs_openscad_file *file) {
  const fs_survey *s = file->survey;
  for (int32_t i = 0; i < 2; i++) {
    double length = reach(file->wall, file->side, i);
    if (length < s->radius[i]) continue;
    fs_note(ctx,
            "a wall that grows %.3g %s folds: the radius of curvature is %.3g at (%.6g, %.6g, %.6g), patch %d, face %d",
            length, i == FS_INWARDS ? "inwards" : "outwards", s->radius[i], s->place[i].x, s->place[i].y, s->place[i].z,
            (int)s->patch[i], (int)file->model->surface->patch[s->patch[i]].face);
  }
}

static fs_status check_triangles(fs_context *ctx, fs_openscad_file *file) {
  const fs_triangles *t = file->triangles;
  double shortest;
  int32_t flat = fs_triangles_flat(t, &shortest);
  if (flat != FS_NONE)
    return fs_fail(ctx, FS_ERR_NUMERIC, "a triangle of patch %d has no area, which OpenSCAD does not take",
                   (int)t->patch[flat]);
  if (shortest < 2 * JOINED_DISTANCE)
    fs_note(ctx,
            "OpenSCAD joins points closer than 1e-6, and sides of triangles are as short as %.2g: enlarge the mesh",
            shortest);
  if (t->n_triangles > MANY_TRIANGLES)
    fs_note(ctx, "%d triangles are slow in OpenSCAD: booleans take a minute for 100 000", (int)t->n_triangles);
  file->is_reversed = file->rim->n_loops == 0 && fs_triangles_volume(t) < 0;
  if (file->is_reversed) fs_note(ctx, "the closed surface is inside out; its triangles are turned round");
  return FS_OK;
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_status status = FS_OK;
  fs_survey survey;
  fs_triangles *triangles = NULL;
  fs_rim *rim = NULL;
  fs_openscad_file file = {.model = model, .survey = &survey, .side = param[SIDE] - 1};
  if (model->surface->n_patches == 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "OpenSCAD files need a surface with at least one patch");
  FS_TRY(fs_survey_surface(ctx, model->surface, &survey));
  FS_TRY(choose_steps(ctx, model->surface, &survey, param, &file.n_steps));
  FS_TRY(fs_tessellate(ctx, model->surface, file.n_steps, &triangles));
  FS_TRY(fs_rim_create(ctx, triangles, &rim));
  file.triangles = triangles;
  file.rim = rim;
  FS_TRY(check_triangles(ctx, &file));
  fs_openscad_name(model->name, file.name);
  file.wall = param[WALL] > 0 ? param[WALL] : choose_wall(&survey, file.side);
  if (rim->n_loops > 0) warn_of_folds(ctx, &file);
  FS_TRY(fs_openscad_write(ctx, &file, output));
done:
  fs_rim_free(ctx, rim);
  fs_triangles_free(ctx, triangles);
  return status;
}

const fs_exporter fs_exporter_openscad = {
    .name = "openscad",
    .extension = "scad",
    .summary = "OpenSCAD library: the surface as a solid module, open ones with a wall",
    .params = params,
    .what = FS_EXPORT_SURFACE,
    .write = write,
};
