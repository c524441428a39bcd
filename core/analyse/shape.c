/* SPDX-License-Identifier: MIT */
/* Single role: the numbers of a surface as a whole, from those of its patches. Extreme values are followed from the nodes of
   those patches whose nodes have the best ones. */
#include "analyse/analyse.h"
#include "math/vec3.h"

#include <stdlib.h>

enum { MAX_SAMPLES = 1 << 18, N_FOLLOWED = 48, PART = 8192 };
static const double area_tolerance = 1e-10, willmore_factor = 1e3, S_factor = 1e5;
static const double suspicious = 0.02, singular = 1e-6; /* |p_u x p_v| in relation to its average */
static const double followed_range = 0.3, regular = 1e-4;

typedef struct job {
  const fs_surface *surface;
  const fs_rules *rules;
  double tolerance[FS_N_INTEGRALS];
  int32_t stride;
  int32_t from;          /* first patch of this part */
  fs_patch_shape *patch; /* [n_patches] */
  fs_sample *sample;
  size_t *sample_start;  /* [n_patches] */
  int32_t *sample_first; /* [n_patches]: node of the patch */
  int32_t *sample_count; /* [n_patches] */
} job;

static fs_status measure_patches(void *user, int32_t begin, int32_t end, int32_t worker) {
  job *j = user;
  (void)worker;
  for (int32_t i = j->from + begin; i < j->from + end; i++)
    fs_patch_measure(j->surface, i, j->rules, j->tolerance, j->sample_first[i], j->stride, &j->patch[i],
                     j->sample + j->sample_start[i], &j->sample_count[i]);
  return FS_OK;
}

/* Every stride-th node, counted on from patch to patch: each node of a patch as often as any other, and all together no more
   than MAX_SAMPLES, or about one of each patch. */
static fs_status plan_samples(fs_context *ctx, job *j, size_t *n_samples) {
  const fs_surface *s = j->surface;
  int64_t n_nodes = 0, next = 0; /* the next sample, counted from the first node of the patch */
  size_t n = 0;
  fs_status status = FS_OK;
  for (int32_t p = 0; p < s->n_patches; p++)
    n_nodes += (int64_t)fs_patch_nodes(&s->patch[p]) * fs_patch_nodes(&s->patch[p]);
  j->stride = (int32_t)(n_nodes / MAX_SAMPLES) + 1;
  if (j->stride > 1) j->stride |= 1; /* odd, so that it has no part in common with the number of nodes of a patch */
  FS_ALLOC(ctx, j->sample_start, s->n_patches);
  FS_ALLOC(ctx, j->sample_first, s->n_patches);
  FS_ALLOC(ctx, j->sample_count, s->n_patches);
  for (int32_t p = 0; p < s->n_patches; p++) {
    int32_t m = fs_patch_nodes(&s->patch[p]);
    j->sample_start[p] = n;
    j->sample_first[p] = (int32_t)next;
    for (; next < m * m; next += j->stride) n++;
    next -= m * m;
  }
  FS_ALLOC(ctx, j->sample, n);
  *n_samples = n;
done:
  return status;
}

/* ---- extremes ---- */

typedef struct ranked {
  double value;
  int32_t patch;
} ranked;

/* The patches whose nodes have the best values, at most N_FOLLOWED, best first. */
static int32_t choose(const job *j, fs_extreme e, ranked *list) {
  int32_t n = 0;
  for (int32_t p = 0; p < j->surface->n_patches; p++) {
    double value = j->patch[p].found[e].value;
    int32_t at;
    if (isnan(value)) continue;
    if (n == N_FOLLOWED && !fs_extreme_is_better(e, value, list[n - 1].value)) continue;
    at = n < N_FOLLOWED ? n++ : n - 1;
    for (; at > 0 && fs_extreme_is_better(e, value, list[at - 1].value); at--) list[at] = list[at - 1];
    list[at] = (ranked){value, p};
  }
  return n;
}

/* Average of |p_u x p_v| over a patch: domains have area 1, or 1/2 with three sides. */
static double average_area(const job *j, int32_t p) {
  return j->patch[p].integral[FS_AREA] * (j->surface->patch[p].n_sides == 3 ? 2 : 1);
}

static double first_step(const job *j, int32_t p) { return 0.25 / fs_patch_nodes(&j->surface->patch[p]); }

/* Patches whose nodes are far from the best, by the range of the chosen ones' and all others' values, are not followed. */
static double find_extreme(const job *j, fs_extreme e, fs_place *place) {
  ranked list[N_FOLLOWED];
  int32_t n = choose(j, e, list);
  double best = NAN, worst = NAN;
  *place = (fs_place){FS_NONE, 0, 0};
  for (int32_t p = 0; p < j->surface->n_patches; p++)
    if (isnan(worst) || fs_extreme_is_better(e, worst, j->patch[p].found[e].value)) worst = j->patch[p].found[e].value;
  for (int32_t i = 0; i < n && fabs(list[i].value - list[0].value) <= followed_range * fabs(worst - list[0].value);
       i++) {
    int32_t p = list[i].patch;
    fs_found found = j->patch[p].found[e];
    fs_extreme_follow(j->surface, p, e, first_step(j, p), regular * average_area(j, p), &found);
    if (!fs_extreme_is_better(e, found.value, best)) continue;
    best = found.value;
    *place = (fs_place){p, found.u, found.v};
  }
  return best;
}

static void find_regularity(const job *j, fs_shape *shape) {
  shape->regularity = INFINITY;
  for (int32_t p = 0; p < j->surface->n_patches; p++) {
    fs_found found = j->patch[p].found[FS_LEAST_AREA];
    double average = average_area(j, p), least = average > 0 ? found.value / average : 0;
    if (least < suspicious || least < shape->regularity) {
      fs_extreme_follow(j->surface, p, FS_LEAST_AREA, first_step(j, p), 0, &found);
      least = average > 0 ? found.value / average : 0;
    }
    shape->n_singular += !(least >= singular);
    if (least >= shape->regularity) continue;
    shape->regularity = least;
    shape->at_regularity = (fs_place){p, found.u, found.v};
  }
}

static void find_extremes(const job *j, fs_shape *shape) {
  shape->H.max = find_extreme(j, FS_MOST_H, &shape->H.at_max);
  shape->H.min = find_extreme(j, FS_LEAST_H, &shape->H.at_min);
  shape->K.max = find_extreme(j, FS_MOST_K, &shape->K.at_max);
  shape->K.min = find_extreme(j, FS_LEAST_K, &shape->K.at_min);
  shape->gradient.max = find_extreme(j, FS_MOST_GRADIENT, &shape->gradient.at_max);
  shape->gradient.min = find_extreme(j, FS_LEAST_GRADIENT, &shape->gradient.at_min);
  shape->hollow = find_extreme(j, FS_MOST_PRINCIPAL, &shape->at_hollow);
  shape->ridge = find_extreme(j, FS_LEAST_PRINCIPAL, &shape->at_ridge);
  bool is_hollow = fabs(shape->hollow) >= fabs(shape->ridge);
  shape->curvature = is_hollow ? fabs(shape->hollow) : fabs(shape->ridge);
  shape->at_curvature = is_hollow ? shape->at_hollow : shape->at_ridge;
}

/* ---- all of it ---- */

static fs_status sum_up(fs_context *ctx, const job *j, fs_shape *shape) {
  double integral[FS_N_INTEGRALS] = {0}, error[FS_N_INTEGRALS] = {0};
  for (int32_t p = 0; p < j->surface->n_patches; p++)
    for (int k = 0; k < FS_N_INTEGRALS; k++) {
      integral[k] += j->patch[p].integral[k];
      error[k] += j->patch[p].error[k];
      if (!isfinite(integral[k]))
        return fs_fail(ctx, FS_ERR_NUMERIC, "patch %d has points that are not finite, or too large", (int)p);
    }
  shape->area = integral[FS_AREA], shape->area_error = error[FS_AREA];
  shape->volume = integral[FS_VOLUME], shape->volume_error = error[FS_VOLUME];
  shape->willmore = integral[FS_WILLMORE], shape->willmore_error = error[FS_WILLMORE];
  shape->S = integral[FS_S], shape->S_error = error[FS_S];
  return FS_OK;
}

/* Closes the gaps that points without a normal have left among the samples. */
static size_t pack_samples(const job *j) {
  size_t n = 0;
  for (int32_t p = 0; p < j->surface->n_patches; p++)
    for (int32_t i = 0; i < j->sample_count[p]; i++) j->sample[n++] = j->sample[j->sample_start[p] + (size_t)i];
  return n;
}

fs_status fs_shape_measure(fs_context *ctx, const fs_surface *surface, double tolerance, fs_shape *shape) {
  const double t = tolerance > 0 ? tolerance : area_tolerance;
  job j = {.surface = surface,
           .tolerance = {[FS_AREA] = t, [FS_VOLUME] = t, [FS_WILLMORE] = willmore_factor * t, [FS_S] = S_factor * t}};
  fs_shape result = {0};
  fs_rules *rules = NULL;
  size_t n_samples = 0;
  fs_status status = FS_OK;
  if (surface->n_patches < 1) return fs_fail(ctx, FS_ERR_ARGUMENT, "a surface without patches has no shape");
  if (surface->n_patches > INT32_MAX / 128)
    return fs_fail(ctx, FS_ERR_UNSUPPORTED, "%d patches are too many to measure", (int)surface->n_patches);
  FS_TRY(fs_rules_create(ctx, &rules));
  j.rules = rules;
  FS_ALLOC(ctx, j.patch, surface->n_patches);
  FS_TRY(plan_samples(ctx, &j, &n_samples));
  for (j.from = 0; j.from < surface->n_patches; j.from += PART) {
    int32_t n = surface->n_patches - j.from;
    FS_TRY(fs_progress(ctx, "shape", (double)j.from / surface->n_patches));
    FS_TRY(fs_parallel_for(ctx, n < PART ? n : PART, measure_patches, &j));
  }
  FS_TRY(sum_up(ctx, &j, &result));
  find_extremes(&j, &result);
  find_regularity(&j, &result);
  fs_distribution_percentiles(pack_samples(&j), j.sample, &result.H, &result.K, &result.gradient);
  FS_TRY(fs_surface_diameter(ctx, surface, &result.diameter, result.diameter_end));
  *shape = result;
done:
  fs_release(ctx, rules);
  fs_release(ctx, j.patch);
  fs_release(ctx, j.sample);
  fs_release(ctx, j.sample_start);
  fs_release(ctx, j.sample_first);
  fs_release(ctx, j.sample_count);
  return status;
}
