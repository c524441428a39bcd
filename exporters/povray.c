/* SPDX-License-Identifier: MIT */
/* The POV-Ray exporter: NAME.inc, the object alone, NAME.pov, a scene that shows it, and NAME.ini where it turns. */
#include "povray.h"
#include "base/base.h"
#include "math/vec3.h"

static const char *const scene_names[] = {"shaded", "zebra", "isophote", "curvature", "turntable", NULL};
static const char *const form_names[] = {"bicubic", "mesh2", NULL};

enum { SCENE, FORM, STEPS, TOLERANCE, FRAMES, N_PARAMS };
enum { FORM_BICUBIC, FORM_MESH2 };

static const fs_param params[] = {
    [SCENE] = {"scene", "how the scene shows the surface; curvature implies mesh2", 0, 0, 4, scene_names},
    [FORM] = {"pov", "what the object consists of", FORM_BICUBIC, 0, 1, form_names},
    [STEPS] = {"pov-steps",
               "each patch is drawn as 2^N x 2^N cells; 0: 4 up to 1500 patches, then fewer, more for caps", 0, 0, 8,
               NULL},
    [TOLERANCE] = {"tolerance", "largest distance of bicubic pieces from other patches, as part of the box diagonal",
                   1e-4, 1e-9, 1, NULL},
    [FRAMES] = {"frames", "pictures of a whole turn that NAME.ini of the turntable makes", 36, 2, 10000, NULL},
    [N_PARAMS] = {0},
};

/* Steps when they are automatic: a patch takes 30 kB at 3, 8.7 kB at 2 in the renderer. */
static int32_t automatic_steps(size_t n_pieces) {
  return n_pieces <= 1500 ? 4 : n_pieces <= 5000 ? 3 : n_pieces <= 50000 ? 2 : 1;
}

/* Patches may be divided while one step at least is left for the pieces. */
static int32_t most_divisions(int32_t steps, int32_t n_patches) {
  if (steps > 0) return steps - 1 < 5 ? steps - 1 : 5;
  return n_patches <= 24 ? 5 : n_patches <= 2000 ? 3 : 2;
}

static fs_status check(fs_context *ctx, const fs_model *model, const double *param) {
  if (model->surface == NULL || model->surface->n_patches == 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "POV-Ray files need a surface with at least one patch");
  if (model->surface->n_patches > INT32_MAX / 4)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "%d patches are more than a POV-Ray file can hold",
                   (int)model->surface->n_patches);
  for (int k = 0; k < N_PARAMS; k++)
    if (!(param[k] >= params[k].min && param[k] <= params[k].max))
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%s is outside its range", params[k].name);
  for (const char *c = model->name; c != NULL && *c != '\0'; c++)
    if ((unsigned char)*c < 32)
      return fs_fail(ctx, FS_ERR_ARGUMENT, "a POV-Ray file cannot include a file whose name has control characters");
  return FS_OK;
}

static fs_status write_mesh(fs_context *ctx, fs_povray_model *model, const fs_measure *colour,
                            const fs_output *output) {
  if (model->steps == 0) model->steps = automatic_steps((size_t)model->model->surface->n_patches);
  return fs_povray_write_mesh(ctx, model, colour, output);
}

static fs_status write_bicubic(fs_context *ctx, fs_povray_model *model, const fs_output *output) {
  fs_status status = FS_OK;
  fs_povray_pieces *pieces = NULL;
  fs_surface *surface = NULL;
  const fs_model *given = model->model;
  fs_model quads = *model->model;
  FS_TRY(fs_surface_to_quads(ctx, quads.surface, &surface));
  quads.surface = surface;
  model->model = &quads;
  FS_TRY(fs_povray_pieces_create(ctx, surface, model->tolerance, most_divisions(model->steps, surface->n_patches),
                                 &pieces));
  if (model->steps == 0) model->steps = automatic_steps(pieces->n_pieces);
  if (model->steps <= pieces->m && pieces->n_divided > 0) model->steps = pieces->m + 1;
  if (pieces->deviation > model->tolerance)
    fs_note(ctx, "the POV-Ray pieces deviate by %.2g, more than the tolerance %.2g: raise pov-steps", pieces->deviation,
            model->tolerance);
  FS_TRY(fs_povray_write_bicubic(ctx, model, pieces, output));
done:
  model->model = given;
  fs_surface_free(ctx, surface);
  fs_povray_pieces_free(ctx, pieces);
  return status;
}

static fs_status write(fs_context *ctx, const fs_model *given, const double *param, const fs_output *output) {
  fs_status status = FS_OK;
  fs_model model = *given;
  fs_povray_model written = {.model = &model};
  FS_TRY(check(ctx, given, param));
  fs_povray_scene scene = (fs_povray_scene)param[SCENE];
  if (model.colour == NULL) model.colour = fs_measures[0];
  fs_povray_name(model.name, written.name);
  written.steps = (int32_t)param[STEPS];
  written.is_turning = scene == FS_POVRAY_TURNTABLE;
  FS_TRY(fs_povray_find_view(ctx, &written));
  written.tolerance = param[TOLERANCE] * fs_vec3_distance(written.min, written.max);
  if (scene == FS_POVRAY_CURVATURE)
    FS_TRY(write_mesh(ctx, &written, model.colour, output));
  else if ((int)param[FORM] == FORM_MESH2)
    FS_TRY(write_mesh(ctx, &written, NULL, output));
  else
    FS_TRY(write_bicubic(ctx, &written, output));
  if (model.curves != NULL) FS_TRY(fs_povray_write_curves(ctx, &written, output));
  FS_TRY(fs_povray_write_scene(ctx, &written, scene, output));
  if (scene == FS_POVRAY_TURNTABLE) FS_TRY(fs_povray_write_turn(ctx, &written, (int32_t)param[FRAMES], output));
done:
  return status;
}

const fs_exporter fs_exporter_povray = {
    .name = "povray",
    .extension = "pov",
    .summary = "POV-Ray 3.7 scene and object, native bicubic patches",
    .params = params,
    .what = FS_EXPORT_SURFACE,
    .write = write,
    .has_curves = true,
};
