/* SPDX-License-Identifier: MIT */
/* The STEP exporter, AP214: every Bezier patch exactly as a B-spline surface, others as bicubic pieces within a tolerance, runs of bicubic patches as one, faces that share
   vertices and edges; a solid for each closed component, an open shell for each other one. */
#include "step.h"
#include "base/base.h"
#include "math/vec3.h"
#include "surface/surface.h"

enum { MERGE, UNIT, TOLERANCE, N_PARAMS };

static const fs_param params[] = {
    [MERGE] = {"step-merge", "whether bicubic patches that join smoothly become larger faces", 1, 0, 1,
               (const char *const[]){"no", "yes", NULL}},
    [UNIT] = {"unit", "of the coordinates", FS_STEP_MM, FS_STEP_MM, FS_STEP_IN,
              (const char *const[]){"mm", "cm", "m", "in", NULL}},
    [TOLERANCE] = {"tolerance", "largest distance of bicubic pieces from other patches, as part of the box diagonal",
                   1e-4, 1e-9, 1, NULL},
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

/* ---- patches that are no Bezier patches ---- */

static bool is_exact(const fs_surface *surface) {
  for (int32_t p = 0; p < surface->n_patches; p++)
    if (!fs_patch_is_tensor_bezier(&surface->patch[p])) return false;
  return true;
}

/* The diagonal of the box of the corners of the patches. */
static double diagonal(const fs_surface *surface) {
  fs_vec3 min = {INFINITY, INFINITY, INFINITY}, max = {-INFINITY, -INFINITY, -INFINITY}, x[FS_JET_SIZE];
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int32_t s = 0; s < surface->patch[p].n_sides; s++) {
      double u, v;
      fs_side_parameters(surface->patch[p].n_sides, s, 0, &u, &v);
      fs_surface_evaluate(surface, p, u, v, x);
      min = fs_vec3_min(min, x[FS_D]);
      max = fs_vec3_max(max, x[FS_D]);
    }
  return fs_vec3_distance(min, max);
}

/* stand_in: bicubic patches in place of a surface that has others; NULL where it has none. */
static fs_status make_stand_in(fs_context *ctx, const fs_surface *surface, double tolerance, fs_surface **stand_in) {
  enum { MAX_M = 5 };
  double length, deviation = 0;
  fs_status status;
  if (surface == NULL || is_exact(surface)) return FS_OK;
  length = diagonal(surface);
  if (!(length > 0) || !isfinite(length)) return fs_fail(ctx, FS_ERR_NUMERIC, "the corners of the patches span no box");
  status = fs_surface_to_bicubics(ctx, surface, tolerance * length, MAX_M, stand_in, &deviation);
  if (status == FS_OK)
    fs_note(ctx, "the STEP file has bicubic patches within %.2g of the surface%s", deviation,
            deviation > tolerance * length ? ", more than the tolerance" : "");
  return status;
}

static fs_status write(fs_context *ctx, const fs_model *model, const double *param, const fs_output *output) {
  fs_status status = FS_OK;
  const fs_surface *surface = model->surface;
  fs_surface *stand_in = NULL;
  fs_step_layout *layout = NULL;
  fs_step_shells *shells = NULL;
  int64_t *face_entity = NULL, *item = NULL, *scratch = NULL;
  survey found = {0};
  fs_step_file step = {0};
  fs_step_frame frame;
  FS_TRY(make_stand_in(ctx, surface, param[TOLERANCE], &stand_in));
  if (stand_in != NULL) surface = stand_in;
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
  fs_surface_free(ctx, stand_in);
  return status;
}

const fs_exporter fs_exporter_step = {
    .name = "step",
    .extension = "step",
    .summary = "STEP AP214: exact B-spline faces, a solid where closed",
    .params = params,
    .what = FS_EXPORT_SURFACE,
    .write = write,
};
