/* SPDX-License-Identifier: MIT */
/* The STEP exporter, AP214: every patch exactly as a B-spline surface, runs of bicubic patches as one, faces that share
   vertices and edges; a solid for each closed component, an open shell for each other one. */
#include "step.h"
#include "base/base.h"
#include "math/vec3.h"
#include "surface/surface.h"

enum { MERGE, UNIT, N_PARAMS };

static const fs_param params[] = {
    [MERGE] = {"step-merge", "whether bicubic patches that join smoothly become larger faces", 1, 0, 1,
               (const char *const[]){"no", "yes", NULL}},
    [UNIT] = {"unit", "of the coordinates", FS_STEP_MM, FS_STEP_MM, FS_STEP_IN,
              (const char *const[]){"mm", "cm", "m", "in", NULL}},
    [N_PARAMS] = {0},
};

/* Points closer than this part of the largest coordinate are rounding errors of one. */
#define ROUNDING 1e-12

typedef struct survey {
  double largest;   /* coordinate, its absolute value */
  fs_vec3 min, max; /* of the control points */
} survey;

static fs_status check(fs_context *ctx, const fs_surface *surface, survey *found) {
  if (surface == NULL || surface->n_patches == 0)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "STEP files need a surface with at least one patch");
  if (surface->n_patches > INT32_MAX / 16)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "%d patches are more than the STEP exporter can number",
                   (int)surface->n_patches);
  found->min = (fs_vec3){INFINITY, INFINITY, INFINITY};
  found->max = (fs_vec3){-INFINITY, -INFINITY, -INFINITY};
  for (int32_t p = 0; p < surface->n_patches; p++) {
    const fs_patch *patch = &surface->patch[p];
    const double *b = surface->data + patch->data_start;
    if (!fs_patch_is_tensor_bezier(patch) || patch->degree_u < 1 || patch->degree_v < 1 ||
        patch->degree_u > FS_MAX_DEGREE || patch->degree_v > FS_MAX_DEGREE)
      return fs_fail(ctx, FS_ERR_UNSUPPORTED, "patch %d is no Bezier patch of degree 1 to %d", (int)p, FS_MAX_DEGREE);
    for (int32_t k = 0; k < (patch->degree_u + 1) * (patch->degree_v + 1); k++) {
      fs_vec3 point = {b[3 * k], b[3 * k + 1], b[3 * k + 2]};
      if (!fs_vec3_is_finite(point))
        return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)p);
      found->min = fs_vec3_min(found->min, point);
      found->max = fs_vec3_max(found->max, point);
    }
  }
  fs_vec3 far = fs_vec3_max(found->max, fs_vec3_scale(found->min, -1));
  found->largest = fmax(far.x, fmax(far.y, far.z));
  return FS_OK;
}

/* A power of ten, 1e-6 where the model is about 1 or larger. */
static double accuracy_of(const survey *found) {
  double size = fs_vec3_distance(found->min, found->max);
  return size >= 1 || !(size > 0) ? 1e-6 : pow(10, floor(log10(size)) - 6);
}

/* Writes the shells of one kind, and the items made of them; returns how many there are. */
static int64_t write_shells(fs_step_file *step, const fs_step_shells *shells, bool is_open, const int64_t *face_entity,
                            int64_t *scratch, int64_t *item) {
  int64_t n_items = 0;
  for (int32_t c = 0; c < shells->n_shells; c++) {
    int32_t first = shells->start[c], n = shells->start[c + 1] - first;
    if (shells->is_open[c] != is_open) continue;
    for (int32_t k = 0; k < n; k++) scratch[k] = face_entity[shells->face[first + k]];
    int64_t shell = fs_step_begin(step, is_open ? "OPEN_SHELL(''," : "CLOSED_SHELL('',");
    fs_step_list(step, n, scratch);
    fs_step_end(step);
    item[n_items++] =
        fs_step_entity(step, is_open ? "SHELL_BASED_SURFACE_MODEL('',(%))" : "MANIFOLD_SOLID_BREP('',%)", &shell);
  }
  return n_items;
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_status status = FS_OK;
  const fs_surface *surface = model->surface;
  fs_step_layout *layout = NULL;
  fs_step_shells *shells = NULL;
  int64_t *face_entity = NULL, *item = NULL, *scratch = NULL;
  survey found = {0};
  fs_step_file step = {0};
  fs_step_frame frame;
  FS_TRY(check(ctx, surface, &found));
  double tolerance = ROUNDING * found.largest;
  FS_TRY(fs_step_layout_create(ctx, surface, param[MERGE] != 0, tolerance, &layout));
  FS_TRY(fs_step_shells_create(ctx, surface, layout, &shells));
  FS_ALLOC(ctx, face_entity, layout->n_faces);
  FS_ALLOC(ctx, scratch, layout->n_faces);
  FS_ALLOC(ctx, item, shells->n_shells);
  fs_writer_start(&step.writer, ctx, output, "step");
  frame = fs_step_write_head(&step, model, (fs_step_unit)param[UNIT], accuracy_of(&found));
  FS_TRY(fs_step_write_faces(ctx, &step, surface, layout, tolerance, face_entity));
  int64_t n_solids = write_shells(&step, shells, false, face_entity, scratch, item);
  int64_t n_open = write_shells(&step, shells, true, face_entity, scratch, item + n_solids);
  fs_step_write_foot(&step, &frame, n_solids, item, n_open, item + n_solids);
  status = fs_writer_finish(&step.writer);
done:
  fs_release(ctx, face_entity);
  fs_release(ctx, scratch);
  fs_release(ctx, item);
  fs_step_shells_free(ctx, shells);
  fs_step_layout_free(ctx, layout);
  return status;
}

const fs_exporter fs_exporter_step = {
    "step", "step", "STEP AP214: exact B-spline faces, a solid where closed", params, FS_EXPORT_SURFACE, write,
};
