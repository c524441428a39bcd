/* SPDX-License-Identifier: MIT */
/* Single role: fills a gap, with as many knots as it takes: starts from the knots of both patches and halves the spans
   where the filling is not good enough yet. */
#include "construct/gap.h"

#include <string.h>

/* Knots of degree 3 by v; room for FS_GAP_MAX_SPANS spans with their multiplicities. */
typedef struct knot_list {
  double *knot, *next;
  int32_t n; /* coefficients */
} knot_list;

static fs_knots as_knots(const knot_list *list) { return (fs_knots){3, list->n, list->knot}; }

static fs_status open_knots(fs_context *ctx, const fs_gap *gap, knot_list *list) {
  fs_status status = FS_OK;
  const fs_knots *q = &gap->seam[0].knots, *r = &gap->seam[1].knots;
  size_t room = (size_t)(q->n + r->n + 8) + FS_GAP_MAX_SPANS;
  FS_ALLOC(ctx, list->knot, room);
  FS_ALLOC(ctx, list->next, room);
  list->n = fs_knots_unite(q, r, list->knot) - 4;
done:
  return status;
}

/* Cuts span i, of those that are not empty, into parts[i] equal parts. */
static fs_status cut(fs_context *ctx, knot_list *list, const int32_t *parts) {
  int32_t n = 0, span = 0;
  int64_t n_spans = 0;
  fs_knots knots = as_knots(list);
  for (int32_t i = 0; i < fs_knots_n_spans(&knots); i++) n_spans += parts[i];
  if (n_spans > FS_GAP_MAX_SPANS)
    return fs_fail(ctx, FS_ERR_NUMERIC, "the filling needs more than %d spans along the gap", FS_GAP_MAX_SPANS);
  for (int32_t i = 0; i < list->n + 4; i++) {
    double a = list->knot[i], b = i + 1 < list->n + 4 ? list->knot[i + 1] : a;
    list->next[n++] = a;
    if (!(a < b)) continue;
    for (int32_t k = 1; k < parts[span]; k++) list->next[n++] = a + (b - a) * k / parts[span];
    span++;
  }
  double *kept = list->knot;
  list->knot = list->next;
  list->next = kept;
  list->n = n - 4;
  return FS_OK;
}

/* One filling over the knots. wanted[n_spans]: 2 where a span must be halved, else 1; the sum of what is asked for. */
static fs_status attempt(fs_context *ctx, const fs_gap *gap, const fs_knots *knots, int32_t *parts, double *angle,
                         int32_t *n_bad, fs_spline **filling, fs_gap_report *report) {
  fs_status status = FS_OK;
  int32_t n_spans = fs_knots_n_spans(knots);
  bool is_positive = true;
  *n_bad = 0;
  if (gap->options.is_exact)
    FS_TRY(fs_gap_multiply(ctx, gap, knots, &is_positive, filling));
  else
    FS_TRY(fs_gap_approximate(ctx, gap, knots, filling));
  if (is_positive) FS_TRY(fs_gap_measure(ctx, gap, *filling, angle, report));
  for (int32_t i = 0; i < n_spans; i++) {
    bool is_bad = !is_positive || (!gap->options.is_exact && angle[i] > gap->options.angle);
    parts[i] = is_bad ? 2 : 1;
    *n_bad += is_bad;
  }
done:
  return status;
}

static fs_status fill(fs_context *ctx, const fs_gap *gap, knot_list *list, fs_spline **filling, fs_gap_report *report) {
  fs_status status = FS_OK;
  int32_t *parts = NULL, n_bad = 0;
  double *angle = NULL;
  fs_spline *made = NULL;
  FS_ALLOC(ctx, parts, FS_GAP_MAX_SPANS);
  FS_ALLOC(ctx, angle, FS_GAP_MAX_SPANS);
  for (int32_t i = 0; i < FS_GAP_MAX_SPANS; i++) parts[i] = gap->options.n_parts > 0 ? gap->options.n_parts : 1;
  for (int round = 0;; round++) {
    fs_knots knots;
    FS_TRY(fs_progress(ctx, "fill the gap", 1 - 1.0 / (round + 1)));
    FS_TRY(cut(ctx, list, parts));
    knots = as_knots(list);
    FS_TRY(attempt(ctx, gap, &knots, parts, angle, &n_bad, &made, report));
    if (n_bad == 0 || (gap->options.n_parts > 0 && made != NULL)) break;
    if (gap->options.n_parts > 0) {
      status = fs_fail(ctx, FS_ERR_NUMERIC, "c1 or g1 is not positive as a spline of degree %d with %d parts per span",
                       (int)gap->options.scalar_degree, (int)gap->options.n_parts);
      goto done;
    }
    fs_spline_free(ctx, made);
    made = NULL;
  }
  *filling = made;
  made = NULL;
done:
  fs_spline_free(ctx, made);
  fs_release(ctx, parts);
  fs_release(ctx, angle);
  return status;
}

fs_status fs_gap_fill(fs_context *ctx, const fs_spline *q, const fs_spline *r, const fs_gap_options *options,
                      fs_spline **filling, fs_gap_report *report) {
  fs_status status = FS_OK;
  fs_gap gap = {.options = {0}};
  fs_gap_report measured = {0};
  knot_list list = {NULL, NULL, 0};
  FS_TRY(fs_gap_open(ctx, q, r, options, &gap));
  FS_TRY(open_knots(ctx, &gap, &list));
  FS_TRY(fill(ctx, &gap, &list, filling, &measured));
  if (report != NULL) *report = measured;
done:
  fs_gap_close(ctx, &gap);
  fs_release(ctx, list.knot);
  fs_release(ctx, list.next);
  return status;
}

/* The patch with the v knots of the filling added once where they are missing. */
static fs_status conform(fs_context *ctx, const fs_spline *patch, const fs_spline *filling, fs_spline **made) {
  fs_status status = FS_OK;
  fs_knots from = fs_spline_knots(patch, 1), wanted = fs_spline_knots(filling, 1), to = {from.degree, 0, NULL};
  double *simple = NULL, *joined = NULL, *c = NULL;
  int32_t n = 0;
  FS_ALLOC(ctx, simple, wanted.n + wanted.degree + 1);
  FS_ALLOC(ctx, joined, from.n + from.degree + 1 + wanted.n + wanted.degree + 1);
  for (int32_t i = 0; i < wanted.n + wanted.degree + 1; i++)
    if (i == 0 || wanted.knot[i] > wanted.knot[i - 1]) simple[n++] = wanted.knot[i];
  /* a list of degree 0, whose ends are those of the other but once */
  const fs_knots once = {0, n - 1, simple};
  to.n = fs_knots_unite(&from, &once, joined) - from.degree - 1;
  to.knot = joined;
  FS_ALLOC(ctx, c, 3 * (size_t)patch->n[0] * (size_t)to.n);
  FS_TRY(fs_bspline_refine(ctx, &from, 3 * patch->n[0], patch->c, &to, c)); /* a row of points is one coefficient */
  fs_spline like = *patch;
  like.n[1] = to.n;
  like.knot[1] = joined;
  like.c = c;
  FS_TRY(fs_spline_create(ctx, &like, made));
done:
  fs_release(ctx, simple);
  fs_release(ctx, joined);
  fs_release(ctx, c);
  return status;
}

fs_status fs_gap_surface(fs_context *ctx, const fs_spline *q, const fs_spline *filling, const fs_spline *r,
                         fs_surface **surface) {
  fs_status status = FS_OK;
  fs_spline *fine[2] = {NULL, NULL};
  FS_TRY(conform(ctx, q, filling, &fine[0]));
  FS_TRY(conform(ctx, r, filling, &fine[1]));
  const fs_spline *const all[3] = {fine[0], filling, fine[1]};
  FS_TRY(fs_splines_surface(ctx, 3, all, surface));
done:
  fs_spline_free(ctx, fine[0]);
  fs_spline_free(ctx, fine[1]);
  return status;
}
