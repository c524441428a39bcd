/* SPDX-License-Identifier: MIT */
/* Single role: B-spline surfaces and curves of STEP files [ISO 10303-42]. Knots are given with multiplicities, or follow from
   the type: uniform ones are not clamped and refused like all others that are not, quasi-uniform ones are clamped and simple
   inside, those of Bezier type have the multiplicity of the degree. Weights that are all equal do not matter. */
#include "surface/read_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* What is being put together: points[n_points] row by row, rows along v. */
typedef struct parts {
  int32_t degree[2], n_rows, n_columns; /* n_rows along u */
  size_t n, room;
  fs_vec3 *point;
  double *knot[2];
} parts;

fs_status fs_step_read_point(const fs_step_model *model, const fs_step_record *entity, fs_vec3 *point) {
  fs_step_cursor c;
  fs_vec3 p;
  fs_status status = FS_OK;
  FS_TRY(fs_step_open(model, entity, "CARTESIAN_POINT", &c));
  FS_TRY(fs_step_skip(&c));
  FS_TRY(fs_step_enter(&c));
  FS_TRY(fs_step_take_real(&c, &p.x));
  FS_TRY(fs_step_take_real(&c, &p.y));
  FS_TRY(fs_step_take_real(&c, &p.z));
  *point = p;
done:
  return status;
}

static fs_status add_point(const fs_step_model *model, parts *p, fs_vec3 point) {
  fs_context *ctx = model->ctx;
  fs_vec3 *more = NULL;
  fs_status status = FS_OK;
  if (p->n == p->room) {
    FS_ALLOC(ctx, more, 2 * p->room + 64);
    for (size_t i = 0; i < p->n; i++) more[i] = p->point[i];
    fs_release(ctx, p->point);
    p->point = more;
    p->room = 2 * p->room + 64;
  }
  p->point[p->n++] = point;
done:
  return status;
}

/* A list of references to points, after those that are there; n: how many. */
static fs_status take_row(const fs_step_model *model, fs_step_cursor *c, parts *p, int32_t *n) {
  fs_status status = FS_OK;
  *n = 0;
  FS_TRY(fs_step_enter(c));
  while (!fs_step_leave(c)) {
    const fs_step_record *entity;
    fs_vec3 point;
    FS_TRY(fs_step_take_reference(c, &entity));
    FS_TRY(fs_step_read_point(model, entity, &point));
    FS_TRY(add_point(model, p, point));
    if (++*n == INT32_MAX / 64) return fs_step_fail(model, c->at, FS_ERR_FORMAT, "a list of points has no end");
  }
done:
  return status;
}

static fs_status take_rows(const fs_step_model *model, fs_step_cursor *c, parts *p) {
  fs_status status = FS_OK;
  FS_TRY(fs_step_enter(c));
  while (!fs_step_leave(c)) {
    int32_t n;
    FS_TRY(take_row(model, c, p, &n));
    if (p->n_rows++ == 0) p->n_columns = n;
    if (n != p->n_columns)
      return fs_step_fail(model, c->at, FS_ERR_FORMAT, "#%lld has rows of %d and of %d points",
                          (long long)c->entity->id, (int)p->n_columns, (int)n);
    if (p->n_rows == INT32_MAX / 64) return fs_step_fail(model, c->at, FS_ERR_FORMAT, "a list of rows has no end");
  }
done:
  return status;
}

/* ---- knots ---- */

/* The knots of multiplicities and values at two cursors, which must be n in all. */
static fs_status take_knots(const fs_step_model *model, fs_step_cursor *multiplicities, fs_step_cursor *values,
                            int32_t n, double **knots) {
  fs_context *ctx = model->ctx;
  double *knot = NULL;
  int32_t filled = 0;
  fs_status status = FS_OK;
  FS_ALLOC(ctx, knot, n);
  FS_TRY(fs_step_enter(multiplicities));
  FS_TRY(fs_step_enter(values));
  while (!fs_step_leave(multiplicities)) {
    int32_t m;
    double value;
    FS_TRY(fs_step_take_integer(multiplicities, &m));
    FS_TRY(fs_step_take_real(values, &value));
    if (m < 0 || m > n - filled) filled = n + 1;
    if (filled > n) break;
    while (m-- > 0) knot[filled++] = value;
  }
  if (filled != n || !fs_step_leave(values)) {
    status = fs_step_fail(model, values->at, FS_ERR_FORMAT, "the knots of #%lld do not belong to its points and degree",
                          (long long)values->entity->id);
    goto done;
  }
  *knots = knot;
  knot = NULL;
done:
  fs_release(ctx, knot);
  return status;
}

/* Clamped on 0 .. number of spans, inner knots as often as said. */
static fs_status make_knots(const fs_step_model *model, const fs_step_record *entity, int32_t degree, int32_t n,
                            int32_t multiplicity, double **knots) {
  fs_context *ctx = model->ctx;
  double *knot = NULL;
  fs_status status = FS_OK;
  if (multiplicity < 1 || n <= degree || (n - degree - 1) % multiplicity != 0)
    return fs_step_fail(model, entity->at, FS_ERR_FORMAT, "#%lld has %d points, which its degree %d does not allow",
                        (long long)entity->id, (int)n, (int)degree);
  FS_ALLOC(ctx, knot, (size_t)n + (size_t)degree + 1);
  for (int32_t i = 0; i < n + degree + 1; i++)
    knot[i] = i <= degree ? 0 : i >= n ? (n - degree - 1) / multiplicity + 1 : (i - degree - 1) / multiplicity + 1;
  *knots = knot;
done:
  return status;
}

/* ---- entities ---- */

/* Where the numbers of a spline start: behind the name in an entity of one type. */
static fs_status open_any(const fs_step_model *model, const fs_step_record *entity, const char *const *type,
                          fs_step_cursor *c, const char **found) {
  char name[40];
  for (; *type != NULL; type++)
    if (fs_step_has_type(model, entity, *type, &c->at)) {
      *c = (fs_step_cursor){model, entity, c->at};
      *found = *type;
      /* a type among several has only its own parameters: the name is that of REPRESENTATION_ITEM */
      return *entity->at == '(' ? FS_OK : fs_step_skip(c);
    }
  fs_step_name_type(entity, name);
  return fs_step_fail(model, entity->at, FS_ERR_UNSUPPORTED, "#%lld is a %s; only B-spline surfaces are read",
                      (long long)entity->id, name);
}

static fs_status check_weights(const fs_step_model *model, const fs_step_record *entity, const char *type) {
  fs_step_cursor c = {.model = model, .entity = entity};
  double first = NAN;
  if (!fs_step_has_type(model, entity, type, &c.at)) return FS_OK;
  for (const char *at = c.at; at < entity->end;) { /* rows or not: numbers in parentheses */
    double weight;
    c.at = at;
    if (*at == '(' || *at == ')' || *at == ',') {
      at++;
      continue;
    }
    if (*at == '_' || (*at >= 'A' && *at <= 'Z')) break; /* the next type */
    if (fs_step_take_real(&c, &weight) != FS_OK) {
      at++;
      continue;
    }
    if (isnan(first)) first = weight;
    if (weight != first)
      return fs_step_fail(model, entity->at, FS_ERR_UNSUPPORTED,
                          "#%lld is rational, with weights %g and %g: only polynomial B-splines are read",
                          (long long)entity->id, first, weight);
    at = c.at;
  }
  return FS_OK;
}

static int32_t inner_multiplicity(const char *type, int32_t degree) {
  return strncmp(type, "BEZIER", 6) == 0 ? degree : strncmp(type, "QUASI", 5) == 0 ? 1 : 0;
}

static fs_status finish(const fs_step_model *model, const fs_step_record *entity, int32_t n_parameters, parts *p,
                        fs_spline **spline) {
  fs_context *ctx = model->ctx;
  static double of_curve[2] = {0, 1};
  fs_spline like = {.n_parameters = n_parameters, .width = 3, .degree = {p->degree[0], p->degree[1]}};
  double *c = NULL;
  fs_status status = FS_OK;
  char sentence[sizeof ctx->message];
  like.n[0] = n_parameters == 2 ? p->n_rows : (int32_t)p->n;
  like.n[1] = n_parameters == 2 ? p->n_columns : 1;
  like.knot[0] = p->knot[0];
  like.knot[1] = n_parameters == 2 ? p->knot[1] : of_curve;
  FS_ALLOC(ctx, c, 3 * p->n);
  for (int32_t i = 0; i < like.n[0]; i++)
    for (int32_t j = 0; j < like.n[1]; j++) {
      fs_vec3 point = p->point[(size_t)i * (size_t)like.n[1] + (size_t)j];
      double *to = c + 3 * ((size_t)i + (size_t)like.n[0] * (size_t)j);
      to[0] = point.x, to[1] = point.y, to[2] = point.z;
    }
  like.c = c;
  snprintf(like.name, sizeof like.name, "%lld", (long long)entity->id);
  status = fs_spline_create(ctx, &like, spline);
  if (status == FS_ERR_ARGUMENT) {
    memcpy(sentence, ctx->message, sizeof sentence);
    status = fs_step_fail(model, entity->at, FS_ERR_UNSUPPORTED, "%s", sentence);
  }
done:
  fs_release(ctx, c);
  return status;
}

static void clear(const fs_step_model *model, parts *p) {
  fs_release(model->ctx, p->point);
  fs_release(model->ctx, p->knot[0]);
  fs_release(model->ctx, p->knot[1]);
}

static fs_status check_degree(const fs_step_model *model, const fs_step_record *entity, int32_t degree) {
  if (degree >= 1 && degree <= FS_MAX_SPLINE_DEGREE) return FS_OK;
  return fs_step_fail(model, entity->at, FS_ERR_UNSUPPORTED, "#%lld has degree %d, which is not between 1 and %d",
                      (long long)entity->id, (int)degree, FS_MAX_SPLINE_DEGREE);
}

fs_status fs_step_read_surface(const fs_step_model *model, const fs_step_record *entity, fs_spline **spline) {
  static const char *const types[] = {"B_SPLINE_SURFACE", "B_SPLINE_SURFACE_WITH_KNOTS", "QUASI_UNIFORM_SURFACE",
                                      "BEZIER_SURFACE", NULL};
  fs_step_cursor c, values;
  const char *type = NULL, *at;
  parts p = {0};
  fs_status status = FS_OK;
  FS_TRY(check_weights(model, entity, "RATIONAL_B_SPLINE_SURFACE"));
  FS_TRY(open_any(model, entity, types, &c, &type));
  for (int k = 0; k < 2; k++) {
    FS_TRY(fs_step_take_integer(&c, &p.degree[k]));
    FS_TRY(check_degree(model, entity, p.degree[k]));
  }
  FS_TRY(take_rows(model, &c, &p));
  for (int k = 0; k < 4; k++) FS_TRY(fs_step_skip(&c)); /* form, closed in u and in v, self-intersecting */
  for (int k = 1; k < 4 && type == types[0]; k++)       /* one of several types: the knots stand in another */
    if (fs_step_has_type(model, entity, types[k], &at)) type = types[k], c.at = at;
  const int32_t n[2] = {p.n_rows, p.n_columns};
  if (type == types[1]) {
    values = c;
    for (int k = 0; k < 2; k++) FS_TRY(fs_step_skip(&values));
    for (int k = 0; k < 2; k++) FS_TRY(take_knots(model, &c, &values, n[k] + p.degree[k] + 1, &p.knot[k]));
  } else {
    for (int k = 0; k < 2; k++)
      FS_TRY(make_knots(model, entity, p.degree[k], n[k], inner_multiplicity(type, p.degree[k]), &p.knot[k]));
  }
  FS_TRY(finish(model, entity, 2, &p, spline));
done:
  clear(model, &p);
  return status;
}

static const char *const curve_types[] = {"B_SPLINE_CURVE", "B_SPLINE_CURVE_WITH_KNOTS", NULL};

bool fs_step_is_curve(const fs_step_model *model, const fs_step_record *entity) {
  const char *at;
  return fs_step_has_type(model, entity, curve_types[1], &at);
}

fs_status fs_step_read_curve(const fs_step_model *model, const fs_step_record *entity, fs_spline **spline) {
  fs_step_cursor c, values;
  const char *type = NULL;
  parts p = {.degree = {0, 0}};
  int32_t n;
  fs_status status = FS_OK;
  FS_TRY(check_weights(model, entity, "RATIONAL_B_SPLINE_CURVE"));
  FS_TRY(open_any(model, entity, curve_types, &c, &type));
  FS_TRY(fs_step_take_integer(&c, &p.degree[0]));
  FS_TRY(check_degree(model, entity, p.degree[0]));
  FS_TRY(take_row(model, &c, &p, &n));
  for (int k = 0; k < 3; k++) FS_TRY(fs_step_skip(&c)); /* form, closed, self-intersecting */
  if (type == curve_types[0]) FS_TRY(fs_step_open(model, entity, curve_types[1], &c));
  values = c;
  FS_TRY(fs_step_skip(&values));
  FS_TRY(take_knots(model, &c, &values, n + p.degree[0] + 1, &p.knot[0]));
  FS_TRY(finish(model, entity, 1, &p, spline));
done:
  clear(model, &p);
  return status;
}
