/* SPDX-License-Identifier: MIT */
/* The command check: how smoothly the patches of a surface meet, and what its shape is. */
#include "cli.h"
#include "check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TRY(call)                         \
  do {                                    \
    fs_status status_ = (call);           \
    if (status_ != FS_OK) return status_; \
  } while (0)

enum { N_CROSSINGS = 10 };

/* Takes the shape of the surface, then what is measured by it: jumps by its curvature and diameter. */
static fs_status measure(fs_context *ctx, const arguments *a, check_result *r) {
  fs_continuity_options options = {.n_worst = a->worst};
  TRY(a->is_constructed ? construct_surface(ctx, a, &r->surface) : load_surface(ctx, a, a->mesh, &r->surface));
  TRY(fs_edges_create(ctx, r->surface, 0, &r->edges));
  TRY(fs_shape_measure(ctx, r->surface, 0, &r->shape));
  options.curvature_scale = r->shape.curvature;
  options.diameter = r->shape.diameter;
  TRY(fs_continuity_measure(ctx, r->surface, r->edges, &options, &r->continuity));
  TRY(fs_crossings_find(ctx, r->surface, r->edges, 0, N_CROSSINGS, &r->crossings));
  r->passes = fs_continuity_passes(r->continuity, r->order, r->tolerance);
  for (r->smoothness = -1; r->smoothness < 3; r->smoothness++)
    if (!fs_continuity_passes(r->continuity, r->smoothness + 1, r->tolerance)) break;
  return FS_OK;
}

/* The start, for comparison, and the distance of the surface from it where their patches correspond. */
static fs_status compare(fs_context *ctx, const arguments *a, check_result *r) {
  enum { N = 4 };
  r->distance = NAN;
  if (a->compare == NULL) return FS_OK;
  TRY(load_surface(ctx, a, a->compare, &r->start));
  TRY(fs_shape_measure(ctx, r->start, 0, &r->start_shape));
  r->has_start = true;
  if (r->start->n_patches != r->surface->n_patches) return FS_OK;
  r->distance = 0;
  for (int32_t p = 0; p < r->surface->n_patches; p++)
    for (int k = 0; k <= N * (N + 2); k++) {
      fs_vec3 x[FS_JET_SIZE], y[FS_JET_SIZE];
      double u = (double)(k % (N + 1)) / N, v = (double)(k / (N + 1)) / N;
      if (r->start->patch[p].n_sides != r->surface->patch[p].n_sides) {
        r->distance = NAN;
        return FS_OK;
      }
      if (!fs_domain_holds(r->surface->patch[p].n_sides, u, v)) continue;
      fs_surface_evaluate(r->surface, p, u, v, x);
      fs_surface_evaluate(r->start, p, u, v, y);
      r->distance =
          fmax(r->distance, hypot(hypot(x[FS_D].x - y[FS_D].x, x[FS_D].y - y[FS_D].y), x[FS_D].z - y[FS_D].z));
    }
  return FS_OK;
}

static fs_status write_outputs(fs_context *ctx, const arguments *a, const check_result *r) {
  /* the jump of the required order: positions for G0, and so on */
  fs_jump_colours *colours = NULL;
  fs_status status = fs_jump_colours_create(ctx, r->surface, r->edges, r->continuity, (fs_jump)r->order, &colours);
  for (int32_t i = 0; i < a->n_outputs && status == FS_OK; i++) {
    const output_request *o = &a->output[i];
    fs_model model = {.name = a->name,
                      .surface = r->surface,
                      .colour = o->colour != NULL ? o->colour : &colours->measure,
                      .made_with = "fairsurf check"};
    if (o->exporter->what == FS_EXPORT_NET) {
      snprintf(ctx->message, sizeof ctx->message, "%.100s: check writes surfaces, and a .%s file holds a control net",
               o->path, o->exporter->extension);
      status = FS_ERR_UNSUPPORTED;
    } else {
      status = fs_export_file(ctx, &model, o->param, o->path);
    }
  }
  fs_jump_colours_free(ctx, colours);
  return status;
}

fs_status run_check(fs_context *ctx, const arguments *a, bool *passes) {
  check_result r = {.order = a->require >= 0 ? a->require : 2, .tolerance = a->tolerance};
  fs_status status = measure(ctx, a, &r);
  if (status == FS_OK) status = compare(ctx, a, &r);
  if (status == FS_OK && a->n_outputs > 0) status = write_outputs(ctx, a, &r);
  if (status == FS_OK) {
    if (a->json)
      print_check_json(stdout, a, &r);
    else if (!a->quiet)
      print_check(stdout, a, &r);
    *passes = a->require < 0 || r.passes;
  }
  fs_crossings_free(ctx, r.crossings);
  fs_continuity_free(ctx, r.continuity);
  fs_edges_free(ctx, r.edges);
  fs_surface_free(ctx, r.surface);
  fs_surface_free(ctx, r.start);
  return status;
}
