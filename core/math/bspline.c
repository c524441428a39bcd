/* SPDX-License-Identifier: MIT */
/* Single role: knots and the values of B-splines.

     N_i^0 = 1 on [U_i, U_(i+1)),  N_i^p = (t - U_i) / (U_(i+p) - U_i) N_i^(p-1) + (U_(i+p+1) - t) / (…) N_(i+1)^(p-1)
     (N_i^p)' = p (N_i^(p-1) / (U_(i+p) - U_i) - N_(i+1)^(p-1) / (U_(i+p+1) - U_(i+1)))      [Piegl Tiller 1997, ch. 2]

   On the span U_s <= t < U_(s+1) the functions s - p .. s live, and none of their denominators vanishes. */
#include "math/bspline.h"

#include <math.h>
#include <string.h>

static bool is_clamped(const fs_knots *k) {
  for (int32_t i = 1; i <= k->degree; i++)
    if (k->knot[i] != k->knot[0] || k->knot[k->n + i] != k->knot[k->n]) return false;
  return true;
}

fs_status fs_knots_check(fs_context *ctx, const char *what, const fs_knots *k) {
  const double *U = k->knot;
  if (k->degree < 0 || k->degree > FS_KNOTS_MAX_DEGREE)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%s have degree %d, which is not between 0 and %d", what, (int)k->degree,
                   FS_KNOTS_MAX_DEGREE);
  if (k->n <= k->degree)
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%s: degree %d needs %d control points or more, not %d", what, (int)k->degree,
                   (int)k->degree + 1, (int)k->n);
  for (int32_t i = 0; i < k->n + k->degree + 1; i++) {
    if (!isfinite(U[i])) return fs_fail(ctx, FS_ERR_ARGUMENT, "%s: knot %d is not finite", what, (int)i);
    if (i > 0 && U[i] < U[i - 1])
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%s decrease: knot %d is %g after %g", what, (int)i, U[i], U[i - 1]);
  }
  if (!is_clamped(k))
    return fs_fail(ctx, FS_ERR_ARGUMENT, "%s are not clamped: the first and the last %d must be equal", what,
                   (int)k->degree + 1);
  if (!(U[k->n] > U[k->degree])) return fs_fail(ctx, FS_ERR_ARGUMENT, "%s span no interval: all are %g", what, U[0]);
  for (int32_t i = k->degree + 1; i < k->n; i++)
    if ((k->degree > 0 && U[i] == U[i - k->degree]) || U[i] == U[k->n])
      return fs_fail(ctx, FS_ERR_ARGUMENT, "%s: knot %d, %g, occurs too often for a continuous spline of degree %d",
                     what, (int)i, U[i], (int)k->degree);
  return FS_OK;
}

int32_t fs_knots_span(const fs_knots *k, double t) {
  int32_t low = k->degree, high = k->n; /* U_low <= t < U_high, where t lies inside */
  if (!(t < k->knot[high])) {
    for (low = high - 1; low > k->degree && k->knot[low] == k->knot[high];) low--;
    return low;
  }
  while (high - low > 1) {
    int32_t middle = (low + high) / 2;
    if (t < k->knot[middle])
      high = middle;
    else
      low = middle;
  }
  return low;
}

void fs_knots_basis(const fs_knots *k, int32_t s, double t, int32_t order, double *value) {
  const double *U = k->knot;
  int32_t p = k->degree;
  memset(value, 0, (size_t)(p + 1) * sizeof *value);
  if (order > p) return;
  value[0] = 1;
  for (int32_t m = 1; m <= p; m++) { /* from degree m - 1 to m; function i of degree m is N_(s-m+i) */
    bool is_derivative = m > p - order;
    double carry = 0;
    for (int32_t i = 0; i < m; i++) { /* N_(s-m+1+i)^(m-1) feeds functions i and i + 1 */
      double left = U[s - m + 1 + i], right = U[s + 1 + i], b = value[i] / (right - left);
      value[i] = carry + (is_derivative ? -m * b : (right - t) * b);
      carry = is_derivative ? m * b : (t - left) * b;
    }
    value[m] = carry;
  }
}

void fs_bspline_evaluate(const fs_knots *k, int32_t width, const double *c, double t, int32_t order, double *value) {
  double basis[FS_KNOTS_MAX_DEGREE + 1];
  int32_t s = fs_knots_span(k, t), first = s - k->degree;
  fs_knots_basis(k, s, t, order, basis);
  memset(value, 0, (size_t)width * sizeof *value);
  for (int32_t i = 0; i <= k->degree; i++) {
    const double *point = c + (size_t)(first + i) * (size_t)width;
    for (int32_t w = 0; w < width; w++) value[w] += basis[i] * point[w];
  }
}

double fs_knots_greville(const fs_knots *k, int32_t i) {
  double sum = 0;
  for (int32_t j = 1; j <= k->degree; j++) sum += k->knot[i + j];
  return sum / k->degree;
}

static double tolerance(const fs_knots *k) { return FS_KNOT_TOLERANCE * (k->knot[k->n] - k->knot[0]); }

int32_t fs_knots_multiplicity(const fs_knots *k, double t) {
  int32_t n = 0;
  for (int32_t i = 0; i < k->n + k->degree + 1; i++) n += fabs(k->knot[i] - t) <= tolerance(k);
  return n;
}

int32_t fs_knots_unite(const fs_knots *a, const fs_knots *b, double *joined) {
  int32_t n_a = a->n + a->degree + 1, n_b = b->n + b->degree + 1, i = 0, j = 0, n = 0;
  double near = tolerance(a);
  while (i < n_a || j < n_b) {
    double value;
    if (i < n_a && j < n_b && fabs(a->knot[i] - b->knot[j]) <= near)
      value = a->knot[i++], j++;
    else if (j == n_b || (i < n_a && a->knot[i] < b->knot[j]))
      value = a->knot[i++];
    else
      value = b->knot[j++];
    joined[n] = n > 0 && value - joined[n - 1] <= near ? joined[n - 1] : value;
    n++;
  }
  return n;
}

int32_t fs_knots_n_spans(const fs_knots *k) {
  int32_t n = 0;
  for (int32_t i = k->degree; i < k->n; i++) n += k->knot[i] < k->knot[i + 1];
  return n;
}
