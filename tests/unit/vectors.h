/* SPDX-License-Identifier: MIT */
/* Numbers of other programs in files of FAIRSURF_SHARED, compared by name. */
#ifndef FS_TEST_VECTORS_H
#define FS_TEST_VECTORS_H

#include <fairsurf/surface.h>
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <cmocka.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>

/* NULL, with a message, where the file is absent. */
static inline cJSON *vectors_open(const char *relative) {
  const char *path = test_shared(relative);
  size_t size;
  char *text;
  cJSON *vectors;
  if (path == NULL) return NULL;
  text = test_file(path, &size);
  vectors = cJSON_Parse(text);
  free(text);
  return vectors;
}

static inline const cJSON *vectors_item(const cJSON *object, const char *name) {
  const cJSON *found = cJSON_GetObjectItemCaseSensitive(object, name);
  if (found == NULL) fail_msg("the file has no \"%s\"", name);
  return found;
}

/* Flattens nested arrays of numbers into out; returns how many there are. */
static inline int vectors_flatten(const cJSON *array, double *out) {
  int n = 0;
  if (cJSON_IsNumber(array)) {
    *out = array->valuedouble;
    return 1;
  }
  for (const cJSON *child = array->child; child != NULL; child = child->next) n += vectors_flatten(child, out + n);
  return n;
}

static inline double vectors_number(const cJSON *object, const char *name) {
  return vectors_item(object, name)->valuedouble;
}

/* n numbers or points of an array of that size. */
static inline void vectors_numbers(const cJSON *object, const char *name, int n, double *out) {
  assert_int_equal(vectors_flatten(vectors_item(object, name), out), n);
}

static inline void vectors_points(const cJSON *object, const char *name, int n, fs_vec3 *out) {
  vectors_numbers(object, name, 3 * n, &out->x);
}

/* The difference of n numbers is at most tolerance times the largest of them, or times 1. */
static inline void vectors_agree(const char *name, int n, const double *ours, const double *theirs, double tolerance) {
  double largest = 1;
  for (int i = 0; i < n; i++) largest = fmax(largest, fabs(theirs[i]));
  for (int i = 0; i < n; i++)
    if (!(fabs(ours[i] - theirs[i]) <= tolerance * largest))
      fail_msg("%s[%d]: %.17g is not %.17g (difference %.3g)", name, i, ours[i], theirs[i], ours[i] - theirs[i]);
}

static inline void vectors_compare(const cJSON *object, const char *name, int n, const double *ours, double tolerance) {
  double *theirs = calloc((size_t)n + 1, sizeof *theirs);
  vectors_numbers(object, name, n, theirs);
  vectors_agree(name, n, ours, theirs, tolerance);
  free(theirs);
}

/* Position and derivatives up to order 2 named "00", "10", "01", "20", "11", "02". */
static inline void vectors_compare_jet(const cJSON *jet, const fs_vec3 *x) {
  static const char *const name[] = {"00", "10", "01", "20", "11", "02"};
  for (int k = 0; k < 6; k++) vectors_compare(jet, name[k], 3, &x[k].x, k < 3 ? 1e-12 : 1e-10);
}

#endif
