/* SPDX-License-Identifier: MIT */
/* What the tests of Coons patches share. */
#ifndef FS_TEST_COONS_CHECKS_H
#define FS_TEST_COONS_CHECKS_H

#include "coons_samples.h"
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const sample_square unit_square = {sample_F, 0, 0, 1, {{0, 0, 0}}, {0, 0, 0}};

static inline void near_points(fs_vec3 a, fs_vec3 b, double tolerance) {
  if (!(fs_vec3_distance(a, b) <= tolerance))
    fail_msg("(%.12g %.12g %.12g) is not (%.12g %.12g %.12g)", a.x, a.y, a.z, b.x, b.y, b.z);
}

static inline fs_coons prepare(const fs_coons_data *data) {
  fs_context ctx = test_context();
  fs_coons coons;
  if (fs_coons_prepare(&ctx, data, 1e-9, &coons) != FS_OK) fail_msg("%s", ctx.message);
  return coons;
}

#endif
