/* SPDX-License-Identifier: MIT */
/* Where the camera of a POV-Ray scene stands: the box of the surface, and the distance from which all of it is seen,
   of a turning one through the whole turn.

   A point at (x, y, z) from the middle of the box, x to the right, y up, z towards the camera, is inside a view of
   tangent t seen from distance d where max(|x|, |y|) <= t (d - z). Both forms of the object share the camera, because
   it follows from the same points of the surface. */
#include "povray.h"
#include "base/base.h"
#include "math/vec3.h"

enum { N = 8 };

/* Calls visit for (N + 1)^2 points of each patch. */
static fs_status visit_points(fs_context *ctx, fs_povray_model *model, void (*visit)(fs_povray_model *, fs_vec3)) {
  const fs_surface *surface = model->model->surface;
  fs_vec3 x[FS_JET_SIZE];
  for (int32_t p = 0; p < surface->n_patches; p++)
    for (int j = 0; j <= N; j++)
      for (int i = 0; i <= N; i++) {
        if (surface->patch[p].n_sides == 3 && i + j > N) break;
        fs_surface_evaluate(surface, p, (double)i / N, (double)j / N, x);
        if (!fs_vec3_is_finite(x[FS_D]))
          return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite", (int)p);
        visit(model, x[FS_D]);
      }
  return FS_OK;
}

static void extend_box(fs_povray_model *model, fs_vec3 point) {
  model->min = fs_vec3_min(model->min, point);
  model->max = fs_vec3_max(model->max, point);
}

static fs_vec3 unit(fs_vec3 a) { return fs_vec3_scale(a, 1 / fs_vec3_length(a)); }

/* About z. */
static fs_vec3 turn(fs_vec3 p, double angle) {
  double c = cos(angle), s = sin(angle);
  return (fs_vec3){c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

static void extend_distance(fs_povray_model *model, fs_vec3 point) {
  enum { N_TURNS = 72 };
  const fs_vec3 back = unit(FS_POVRAY_DIRECTION), right = unit(fs_vec3_cross((fs_vec3){0, 0, 1}, back));
  const fs_vec3 up = fs_vec3_cross(back, right);
  fs_vec3 from_middle = fs_vec3_sub(point, fs_vec3_scale(fs_vec3_add(model->min, model->max), 0.5));
  for (int k = 0; k < (model->is_turning ? N_TURNS : 1); k++) {
    fs_vec3 turned = turn(from_middle, k * (2 * 3.14159265358979323846 / N_TURNS));
    double aside = fmax(fabs(fs_vec3_dot(turned, right)), fabs(fs_vec3_dot(turned, up)));
    model->distance = fmax(model->distance, fs_vec3_dot(turned, back) + aside / FS_POVRAY_TANGENT);
  }
}

fs_status fs_povray_find_view(fs_context *ctx, fs_povray_model *model) {
  const double margin = 1.08;
  fs_status status = FS_OK;
  model->min = (fs_vec3){INFINITY, INFINITY, INFINITY};
  model->max = (fs_vec3){-INFINITY, -INFINITY, -INFINITY};
  model->distance = 0;
  FS_TRY(visit_points(ctx, model, extend_box));
  FS_TRY(visit_points(ctx, model, extend_distance));
  model->distance *= margin;
  if (!(model->distance > 0 && isfinite(model->distance)))
    return fs_fail(ctx, FS_ERR_NUMERIC, "the surface is a single point, or too large for a picture");
done:
  return status;
}
