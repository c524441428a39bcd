/* SPDX-License-Identifier: MIT */
/* The construction coons: the curves v0, v1 (sides v = 0 and 1, along u) and u0, u1 (along v) of a file become a Coons patch.
   Opposite sides get one degree and one knot vector: a spline over more knots of a higher degree is found exactly by
   interpolating its own values at the Greville abscissae of those. */
#include "construct/construct.h"
#include "construct/coons.h"
#include "math/vec3.h"
#include "surface/spline.h"

#include <string.h>

enum { BLEND_LINEAR, BLEND_SMOOTH, BLEND_HERMITE };

/* A curve over [0, 1]. */
typedef struct side {
  fs_knots knots;
  double *knot;
  fs_vec3 *point;
} side;

static void side_clear(fs_context *ctx, side *s) {
  fs_release(ctx, s->knot);
  fs_release(ctx, s->point);
  *s = (side){{0, 0, NULL}, NULL, NULL};
}

static fs_status take_side(fs_context *ctx, const fs_splines *splines, const char *name, side *s) {
  fs_status status = FS_OK;
  const fs_spline *curve = fs_splines_find(splines, name);
  if (curve == NULL) return fs_fail(ctx, FS_ERR_ARGUMENT, "a Coons patch needs a curve '%s'; there is none", name);
  if (curve->n_parameters != 1 || curve->width != 3 || curve->degree[0] < 1)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "'%s' is no curve of degree 1 or more", name);
  int32_t n = curve->n[0], n_knots = n + curve->degree[0] + 1;
  double first = curve->knot[0][0], length = curve->knot[0][n_knots - 1] - first;
  FS_ALLOC(ctx, s->knot, n_knots);
  FS_ALLOC(ctx, s->point, n);
  for (int32_t i = 0; i < n_knots; i++) s->knot[i] = (curve->knot[0][i] - first) / length;
  memcpy(s->point, curve->c, (size_t)n * sizeof *s->point);
  s->knots = (fs_knots){curve->degree[0], n, s->knot};
done:
  return status;
}

/* ---- one degree and one knot vector ---- */

/* raised[(more + 1) * number of knots]: every knot more times; returns how many there are. */
static int32_t raise_knots(const fs_knots *knots, int32_t more, double *raised) {
  int32_t n = 0;
  for (int32_t i = 0; i < knots->n + knots->degree + 1; i++) {
    bool is_last = i == knots->n + knots->degree || knots->knot[i + 1] > knots->knot[i];
    for (int32_t k = 0; k < (is_last ? more + 1 : 1); k++) raised[n++] = knots->knot[i];
  }
  return n;
}

/* The side over other knots that can hold it. */
static fs_status move_side(fs_context *ctx, const fs_knots *to, side *s) {
  fs_status status = FS_OK;
  side made = {*to, NULL, NULL};
  FS_ALLOC(ctx, made.knot, to->n + to->degree + 1);
  FS_ALLOC(ctx, made.point, to->n);
  memcpy(made.knot, to->knot, (size_t)(to->n + to->degree + 1) * sizeof *made.knot);
  made.knots.knot = made.knot;
  for (int32_t i = 0; i < to->n; i++)
    fs_bspline_evaluate(&s->knots, 3, &s->point[0].x, fs_knots_greville(to, i), 0, &made.point[i].x);
  FS_TRY(fs_bspline_interpolate(ctx, to, 3, &made.point[0].x));
  side_clear(ctx, s);
  *s = made;
  made = (side){{0, 0, NULL}, NULL, NULL};
done:
  side_clear(ctx, &made);
  return status;
}

static bool is_same(const fs_knots *a, const fs_knots *b) {
  return a->degree == b->degree && a->n == b->n &&
         memcmp(a->knot, b->knot, (size_t)(a->n + a->degree + 1) * sizeof *a->knot) == 0;
}

/* Brings two opposite sides together. */
static fs_status unite(fs_context *ctx, side *a, side *b) {
  fs_status status = FS_OK;
  double *knot[2] = {NULL, NULL}, *joined = NULL;
  side *both[2] = {a, b};
  fs_knots raised[2], to;
  int32_t degree = a->knots.degree > b->knots.degree ? a->knots.degree : b->knots.degree;
  if (is_same(&a->knots, &b->knots)) return FS_OK;
  for (int k = 0; k < 2; k++) {
    const fs_knots *own = &both[k]->knots;
    int32_t more = degree - own->degree;
    FS_ALLOC(ctx, knot[k], (size_t)(more + 1) * (size_t)(own->n + own->degree + 1));
    raised[k] = (fs_knots){degree, raise_knots(own, more, knot[k]) - degree - 1, knot[k]};
  }
  FS_ALLOC(ctx, joined, raised[0].n + raised[1].n + 2 * degree + 2);
  to = (fs_knots){degree, fs_knots_unite(&raised[0], &raised[1], joined) - degree - 1, joined};
  for (int k = 0; k < 2; k++) FS_TRY(move_side(ctx, &to, both[k]));
done:
  fs_release(ctx, knot[0]);
  fs_release(ctx, knot[1]);
  fs_release(ctx, joined);
  return status;
}

/* ---- patches ---- */

#define TOLERANCE 1e-6

/* v: sides along u; u: sides along v. */
static fs_status make_bilinear(fs_context *ctx, const side v[2], const side u[2], fs_surface **surface) {
  fs_status status = FS_OK;
  const fs_vec3 *const at_v[2] = {v[0].point, v[1].point}, *const at_u[2] = {u[0].point, u[1].point};
  fs_spline patch = {.name = "coons",
                     .n_parameters = 2,
                     .width = 3,
                     .degree = {v[0].knots.degree, u[0].knots.degree},
                     .n = {v[0].knots.n, u[0].knots.n},
                     .knot = {v[0].knot, u[0].knot}};
  fs_vec3 *net = NULL;
  FS_ALLOC(ctx, net, (size_t)patch.n[0] * (size_t)patch.n[1]);
  FS_TRY(fs_coons_spline_net(ctx, patch.degree[0], patch.n[0], patch.knot[0], at_v, patch.degree[1], patch.n[1],
                             patch.knot[1], at_u, TOLERANCE, net));
  patch.c = &net[0].x;
  FS_TRY(fs_splines_surface(ctx, 1, (const fs_spline *const[]){&patch}, surface));
done:
  fs_release(ctx, net);
  return status;
}

static fs_status make_blended(fs_context *ctx, const side v[2], const side u[2], int blend, fs_surface **surface) {
  static const double smooth[2][4] = {{1, 1, 0, 0}, {0, 0, 1, 1}};
  fs_status status = FS_OK;
  fs_bezier_curve curve[8];
  fs_vec3 twist[2][2], across_u[2][4], across_v[2][4];
  fs_coons_data data = {.n_data = blend == BLEND_HERMITE ? 4 : 2};
  fs_coons coons;
  for (int k = 0; k < 2; k++) {
    if (v[k].knots.n > v[k].knots.degree + 1 || u[k].knots.n > u[k].knots.degree + 1)
      return fs_fail(ctx, FS_ERR_UNSUPPORTED, "this blend needs sides without inner knots; --blend linear takes any");
    curve[k] = (fs_bezier_curve){u[k].knots.degree, u[k].point};
    curve[2 + k] = (fs_bezier_curve){3, across_u[k]};
    curve[4 + k] = (fs_bezier_curve){v[k].knots.degree, v[k].point};
    curve[6 + k] = (fs_bezier_curve){3, across_v[k]};
  }
  for (int a = 0; a < data.n_data; a++) {
    data.at_u[a] = (fs_curve){fs_bezier_evaluate, &curve[a]};
    data.at_v[a] = (fs_curve){fs_bezier_evaluate, &curve[4 + a]};
  }
  if (blend == BLEND_HERMITE) {
    fs_adini_twists(data.at_u, data.at_v, twist);
    fs_coons_cross(data.at_u, data.at_v, (const fs_vec3(*)[2])twist, across_u, across_v);
  } else {
    data.blend_degree = 3, data.blend[0] = smooth[0], data.blend[1] = smooth[1];
  }
  FS_TRY(fs_coons_prepare(ctx, &data, TOLERANCE, &coons));
  FS_TRY(fs_coons_to_bezier(ctx, &coons, surface));
done:
  return status;
}

static fs_status build(fs_context *ctx, const fs_construction_input *input, const double *param, fs_surface **surface) {
  fs_status status = FS_OK;
  int blend = (int)param[0];
  side v[2] = {{{0, 0, NULL}, NULL, NULL}, {{0, 0, NULL}, NULL, NULL}};
  side u[2] = {{{0, 0, NULL}, NULL, NULL}, {{0, 0, NULL}, NULL, NULL}};
  FS_TRY(take_side(ctx, input->splines, "v0", &v[0]));
  FS_TRY(take_side(ctx, input->splines, "v1", &v[1]));
  FS_TRY(take_side(ctx, input->splines, "u0", &u[0]));
  FS_TRY(take_side(ctx, input->splines, "u1", &u[1]));
  FS_TRY(unite(ctx, &v[0], &v[1]));
  FS_TRY(unite(ctx, &u[0], &u[1]));
  if (blend == BLEND_LINEAR)
    FS_TRY(make_bilinear(ctx, v, u, surface));
  else
    FS_TRY(make_blended(ctx, v, u, blend, surface));
done:
  for (int k = 0; k < 2; k++) {
    side_clear(ctx, &v[k]);
    side_clear(ctx, &u[k]);
  }
  return status;
}

static const char *const blends[] = {"linear", "smooth", "hermite", NULL};
static const fs_param params[] = {
    {"blend", "how opposite sides are weighed: linear, smooth (flat at sides), hermite (with Adini's twists)",
     BLEND_LINEAR, 0, 2, blends},
    {0}};

const fs_construction fs_construction_coons = {
    "coons", "a patch over four curves v0, v1, u0, u1", FS_TAKES_SPLINES, params, build,
};
