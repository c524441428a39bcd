/* SPDX-License-Identifier: MIT */
/* Single role: makes a cap step by step, and owns its arrays. [Kiciak 2013; docs/g2caps.md] */
#include "space/g2cap_parts.h"

#include <math.h>
#include <string.h>

fs_status fs_g2cap_check_valence(fs_context *ctx, int32_t valence) {
  if (valence >= FS_G2CAP_MIN_VALENCE && valence <= FS_G2CAP_MAX_VALENCE && valence != 4) return FS_OK;
  return fs_fail(ctx, FS_ERR_ARGUMENT, "a cap has valence 3 or 5 to %d, not %d", FS_G2CAP_MAX_VALENCE, valence);
}

static fs_status allocate_cap(fs_context *ctx, int32_t valence, fs_g2cap **out) {
  fs_status status = FS_OK;
  fs_g2cap *cap = NULL;
  FS_ALLOC(ctx, cap, 1);
  cap->valence = valence;
  cap->n_vertices = 6 * valence + 1;
  FS_ALLOC(ctx, cap->matrix, FS_G2CAP_POINTS * cap->n_vertices);
  FS_ALLOC(ctx, cap->chart, FS_G2CAP_POINTS * 2);
  FS_ALLOC(ctx, cap->net, 2 * cap->n_vertices);
  *out = cap;
  cap = NULL;
done:
  fs_g2cap_free(ctx, cap);
  return status;
}

fs_status fs_g2cap_sector(fs_context *ctx, int32_t valence, double *net, double *local, double *chart) {
  fs_status status = FS_OK;
  fs_g2cap_domain domain;
  fs_g2cap_junction junction;
  double eigenvalue;
  fs_g2cap_domain_net(valence, &eigenvalue, net);
  fs_g2cap_domain_set(valence, eigenvalue, net, &domain);
  FS_TRY(fs_g2cap_junction_solve(ctx, &domain, &junction));
  FS_TRY(fs_g2cap_local_patches(ctx, &domain, &junction, local, chart));
done:
  return status;
}

fs_status fs_g2cap_scale_chart(fs_context *ctx, double *chart) {
  double area;
  fs_status status = fs_g2cap_area(ctx, chart, &area);
  if (status != FS_OK) return status;
  for (int32_t i = 0; i < 2 * FS_G2CAP_POINTS; i++) chart[i] /= sqrt(area);
  return FS_OK;
}

fs_status fs_g2cap_create(fs_context *ctx, int32_t valence, const fs_g2cap_options *options, fs_g2cap **out) {
  static const fs_g2cap_options defaults = {0};
  fs_status status = FS_OK;
  fs_g2cap *cap = NULL;
  fs_g2cap_ritz *ritz = NULL;
  double *local = NULL;
  FS_TRY(fs_g2cap_check_valence(ctx, valence));
  FS_TRY(allocate_cap(ctx, valence, &cap));
  FS_ALLOC(ctx, local, FS_G2CAP_POINTS * FS_G2CAP_OUTER);
  FS_TRY(fs_g2cap_sector(ctx, valence, cap->net, local, cap->chart));
  FS_TRY(fs_g2cap_ritz_create(ctx, valence, options != NULL ? options : &defaults, local, cap->chart, &ritz));
  fs_g2cap_matrix(ritz, cap->matrix);
  for (int32_t i = 0; i < cap->n_vertices; i++) cap->trace_energy += ritz->energy[i * (cap->n_vertices + 1)];
  FS_TRY(fs_g2cap_scale_chart(ctx, cap->chart));
  *out = cap;
  cap = NULL;
done:
  fs_g2cap_free(ctx, cap);
  fs_g2cap_ritz_free(ctx, ritz);
  fs_release(ctx, local);
  return status;
}

void fs_g2cap_free(fs_context *ctx, fs_g2cap *cap) {
  if (cap == NULL) return;
  fs_release(ctx, cap->matrix);
  fs_release(ctx, cap->chart);
  fs_release(ctx, cap->net);
  fs_release(ctx, cap);
}
