/* SPDX-License-Identifier: MIT */
/* Single role: the surface of a STEP file: all faces that are whole polynomial B-spline surfaces, or where a file has no
   faces, all such surfaces, cut into Bezier patches. Coordinates stay in the unit of the file. A face that looks the other way
   than its surface has u and v exchanged. Files with other faces, and assemblies, are refused. */
#include "surface/read_step.h"

#include <string.h>

typedef struct reading {
  fs_step_model model;
  int32_t n;
  fs_spline **spline; /* [model.n] room; n are there */
} reading;

static fs_status transpose(fs_context *ctx, fs_spline **spline) {
  const fs_spline *s = *spline;
  fs_spline like = {.n_parameters = 2,
                    .width = 3,
                    .degree = {s->degree[1], s->degree[0]},
                    .n = {s->n[1], s->n[0]},
                    .knot = {s->knot[1], s->knot[0]}},
            *made = NULL;
  fs_status status = FS_OK;
  memcpy(like.name, s->name, sizeof like.name);
  FS_ALLOC(ctx, like.c, 3 * (size_t)s->n[0] * (size_t)s->n[1]);
  for (int32_t j = 0; j < s->n[1]; j++)
    for (int32_t i = 0; i < s->n[0]; i++)
      memcpy(like.c + 3 * ((size_t)j + (size_t)s->n[1] * (size_t)i),
             s->c + 3 * ((size_t)i + (size_t)s->n[0] * (size_t)j), 3 * sizeof *like.c);
  FS_TRY(fs_spline_create(ctx, &like, &made));
  fs_spline_free(ctx, *spline);
  *spline = made;
done:
  fs_release(ctx, like.c);
  return status;
}

static fs_status read_face(reading *r, const fs_step_record *face, const char *type) {
  fs_step_cursor c;
  const fs_step_record *surface;
  bool is_same;
  fs_status status = FS_OK;
  FS_TRY(fs_step_open(&r->model, face, type, &c));
  FS_TRY(fs_step_skip(&c));
  FS_TRY(fs_step_skip(&c));
  FS_TRY(fs_step_take_reference(&c, &surface));
  FS_TRY(fs_step_take_logical(&c, &is_same));
  FS_TRY(fs_step_read_surface(&r->model, surface, &r->spline[r->n]));
  r->n++;
  FS_TRY(fs_step_check_border(&r->model, face, r->spline[r->n - 1]));
  if (!is_same) FS_TRY(transpose(r->model.ctx, &r->spline[r->n - 1]));
done:
  return status;
}

static fs_status read_faces(reading *r) {
  static const char *const faces[] = {"ADVANCED_FACE", "FACE_SURFACE"};
  fs_status status = FS_OK;
  const char *at;
  for (int32_t i = 0; i < r->model.n; i++) {
    const fs_step_record *e = &r->model.entity[i];
    for (int k = 0; k < 2; k++)
      if (fs_step_has_type(&r->model, e, faces[k], &at)) FS_TRY(read_face(r, e, faces[k]));
    if (i % 4096 == 0) FS_TRY(fs_progress(r->model.ctx, "read", (double)i / r->model.n));
  }
done:
  return status;
}

static fs_status read_surfaces(reading *r) {
  static const char *const surfaces[] = {"B_SPLINE_SURFACE_WITH_KNOTS", "QUASI_UNIFORM_SURFACE", "BEZIER_SURFACE"};
  fs_status status = FS_OK;
  const char *at;
  for (int32_t i = 0; i < r->model.n; i++)
    for (int k = 0; k < 3; k++)
      if (fs_step_has_type(&r->model, &r->model.entity[i], surfaces[k], &at)) {
        FS_TRY(fs_step_read_surface(&r->model, &r->model.entity[i], &r->spline[r->n]));
        r->n++;
        break;
      }
done:
  return status;
}

/* Parts of assemblies have coordinates of their own. */
static fs_status refuse_assemblies(const fs_step_model *model) {
  static const char *const types[] = {"MAPPED_ITEM", "ITEM_DEFINED_TRANSFORMATION"};
  const char *at;
  for (int32_t i = 0; i < model->n; i++)
    for (int k = 0; k < 2; k++)
      if (fs_step_has_type(model, &model->entity[i], types[k], &at))
        return fs_step_fail(model, model->entity[i].at, FS_ERR_UNSUPPORTED,
                            "#%lld is a %s: assemblies are not read, but their parts from files of their own",
                            (long long)model->entity[i].id, types[k]);
  return FS_OK;
}

static fs_status parse(fs_context *ctx, const char *bytes, size_t size, fs_surface **surface) {
  reading r = {0};
  fs_status status = FS_OK;
  FS_TRY(fs_step_model_create(ctx, bytes, size, &r.model));
  FS_TRY(refuse_assemblies(&r.model));
  FS_ALLOC(ctx, r.spline, r.model.n);
  FS_TRY(read_faces(&r));
  if (r.n == 0) FS_TRY(read_surfaces(&r));
  if (r.n == 0) {
    status = fs_fail(ctx, FS_ERR_UNSUPPORTED, "the file holds no B-spline surface");
    goto done;
  }
  FS_TRY(fs_splines_surface(ctx, r.n, (const fs_spline *const *)r.spline, surface));
done:
  for (int32_t i = 0; r.spline != NULL && i < r.model.n; i++) fs_spline_free(ctx, r.spline[i]);
  fs_release(ctx, r.spline);
  fs_step_model_clear(&r.model);
  return status;
}

const fs_surface_reader fs_surface_reader_step = {"step", "step",
                                                  "STEP: faces that are whole polynomial B-spline surfaces", parse};
const fs_surface_reader fs_surface_reader_stp = {"step", "stp", "STEP, by its other extension", parse};
