/* SPDX-License-Identifier: MIT */
/* Single role: filling a gap as a line of the table of constructions. */
#include "construct/construct.h"
#include "base/base.h"

#include <fairsurf/construct_gap.h>

enum { ORDER, WAY, SCALAR_DEGREE, ANGLE, PARTS, FACTOR_FIRST, FACTOR_SECOND, WRITE };

static const char *const orders[] = {"tangent", "curvature", NULL}, *const ways[] = {"cubic", "exact", NULL};
static const char *const wholes[] = {"all", "filling", NULL};

/* The patches "q" and "r", or the first two of the list. */
static fs_status find_patches(fs_context *ctx, const fs_splines *splines, const fs_spline *pair[2]) {
  static const char *const name[2] = {"q", "r"};
  int32_t next = 0;
  for (int k = 0; k < 2; k++) {
    pair[k] = fs_splines_find(splines, name[k]);
    while (pair[k] == NULL && next < splines->n) {
      const fs_spline *s = &splines->spline[next++];
      if (s->n_parameters == 2 && (k == 0 || s != pair[0])) pair[k] = s;
    }
    if (pair[k] == NULL) return fs_fail(ctx, FS_ERR_ARGUMENT, "filling a gap needs two patches, q and r");
  }
  return FS_OK;
}

static fs_status build(fs_context *ctx, const fs_construction_input *input, const double *param, fs_surface **surface) {
  const fs_gap_options options = {.order = (int32_t)param[ORDER] + 1,
                                  .is_exact = param[WAY] != 0,
                                  .scalar_degree = (int32_t)param[SCALAR_DEGREE],
                                  .angle = param[ANGLE],
                                  .n_parts = (int32_t)param[PARTS],
                                  .factor = {param[FACTOR_FIRST], param[FACTOR_SECOND]}};
  fs_status status = FS_OK;
  const fs_spline *pair[2];
  fs_spline *filling = NULL;
  fs_gap_report report;
  FS_TRY(find_patches(ctx, input->splines, pair));
  FS_TRY(fs_gap_fill(ctx, pair[0], pair[1], &options, &filling, &report));
  fs_note(
      ctx,
      "the gap takes %d spans of degree (%d, %d); at its seams normals differ by %.2g rad, curvature tensors by %.2g, "
      "lengths of derivatives by %.2g of them",
      (int)report.n_spans, (int)filling->degree[0], (int)filling->degree[1], report.angle, report.curvature,
      report.length);
  if (param[WRITE] == 0) {
    FS_TRY(fs_gap_surface(ctx, pair[0], filling, pair[1], surface));
  } else {
    const fs_spline *const alone[1] = {filling};
    FS_TRY(fs_splines_surface(ctx, 1, alone, surface));
  }
done:
  fs_spline_free(ctx, filling);
  return status;
}

const fs_construction fs_construction_gap = {
    .name = "gap",
    .summary = "fills the gap between two B-spline patches, from a file of splines",
    .takes = FS_TAKES_SPLINES,
    .params =
        (const fs_param[]){
            {"joint", "what agrees at the seams", 0, 0, 1, orders},
            {"way", "cubic within an angle, or exact and of higher degree", 0, 0, 1, ways},
            {"scalar-degree", "exact: degree of the scalars that scale derivatives", 3, 2, 3, NULL},
            {"angle", "cubic: largest angle between normals at the seams, radians", 1e-4, 1e-12, 1, NULL},
            {"parts", "parts that each span is cut into; 0: as the angle asks", 0, 0, 4096, NULL},
            {"factor-q", "length of derivatives at the first patch, beside 1", 1, 1e-3, 1e3, NULL},
            {"factor-r", "length of derivatives at the second patch, beside 1", 1, 1e-3, 1e3, NULL},
            {"write", "the whole with both patches, or the filling alone", 0, 0, 1, wholes},
            {.name = NULL}},
    .build = build,
};
