/* SPDX-License-Identifier: MIT */
/* Single role: the limited memory update of an inverse Hessian [Nocedal 1980], two loops over pairs s, y:

     B+ = (I - s y^T / s.y) B (I - y s^T / s.y) + s s^T / s.y,   B0 = K^-1 */
#include "optimise/memory.h"

#include <math.h>

static double dot(const double *a, const double *b, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
  return sum;
}

void fs_memory_release(fs_context *ctx, fs_memory *m) {
  for (int32_t k = 0; k < FS_MEMORY_PAIRS; k++) {
    fs_release(ctx, m->step[k]);
    fs_release(ctx, m->change[k]);
    m->step[k] = m->change[k] = NULL;
  }
  m->n_pairs = 0;
}

void fs_memory_clear(fs_memory *m) { m->n_pairs = 0; }

fs_status fs_memory_add(fs_context *ctx, fs_memory *m, const double *step, const double *g_old, const double *g_new) {
  fs_status status = FS_OK;
  int32_t k = m->n_pairs == 0 ? 0 : (m->newest + 1) % FS_MEMORY_PAIRS;
  double change_squared, step_squared;
  if (m->step[k] == NULL) FS_ALLOC(ctx, m->step[k], m->n);
  if (m->change[k] == NULL) FS_ALLOC(ctx, m->change[k], m->n);
  for (size_t i = 0; i < m->n; i++) {
    m->step[k][i] = step[i];
    m->change[k][i] = g_new[i] - g_old[i];
  }
  m->product[k] = dot(m->step[k], m->change[k], m->n);
  step_squared = dot(m->step[k], m->step[k], m->n);
  change_squared = dot(m->change[k], m->change[k], m->n);
  if (!(m->product[k] > 1e-10 * sqrt(step_squared * change_squared))) {
    if (m->n_pairs == FS_MEMORY_PAIRS) m->n_pairs--; /* the oldest pair was written over */
    return FS_OK;
  }
  m->newest = k;
  if (m->n_pairs < FS_MEMORY_PAIRS) m->n_pairs++;
done:
  return status;
}

static int32_t pair(const fs_memory *m, int32_t age) { /* age 0: the newest */
  return (m->newest - age + FS_MEMORY_PAIRS) % FS_MEMORY_PAIRS;
}

void fs_memory_before(const fs_memory *m, double *d, double *alpha) {
  for (int32_t age = 0; age < m->n_pairs; age++) {
    int32_t k = pair(m, age);
    alpha[k] = dot(m->step[k], d, m->n) / m->product[k];
    for (size_t i = 0; i < m->n; i++) d[i] -= alpha[k] * m->change[k][i];
  }
}

void fs_memory_after(const fs_memory *m, double *d, const double *alpha) {
  for (int32_t age = m->n_pairs - 1; age >= 0; age--) {
    int32_t k = pair(m, age);
    double beta = dot(m->change[k], d, m->n) / m->product[k];
    for (size_t i = 0; i < m->n; i++) d[i] += (alpha[k] - beta) * m->step[k][i];
  }
}
