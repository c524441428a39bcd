/* SPDX-License-Identifier: MIT */
/* Single role: the largest distance of a surface from a target: on a grid of twice as many steps as the wall sees, then
   followed from the farthest point of every element that comes near to the largest, by ever smaller steps along u and v. */
#include "fair/wall.h"
#include "fair/constrain.h"
#include "math/bernstein.h"
#include "math/vec3.h"

enum { MAX_POINTS = 32, MAX_BEZIER = 32 * 32, N_STEPS = 60 };

typedef struct farthest {
  double distance, u, v;
} farthest;

typedef struct search {
  const fs_wall *wall;
  farthest *point;  /* [n_elements] */
  double follow_at; /* distance from which on a point is followed; infinite while grids are searched */
} search;

/* An element as a Bezier patch. */
typedef struct patch {
  const fs_target *target;
  const fs_extraction *extraction;
  fs_vec3 point[MAX_BEZIER];
} patch;

static double distance_at(const patch *s, double u, double v) {
  double by_u[MAX_POINTS], by_v[MAX_POINTS];
  fs_vec3 p = {0, 0, 0}, nearest;
  int32_t n = s->extraction->degree_u, m = s->extraction->degree_v;
  fs_bernstein_basis(n, u, 0, by_u);
  fs_bernstein_basis(m, v, 0, by_v);
  for (int32_t j = 0; j <= m; j++)
    for (int32_t i = 0; i <= n; i++) p = fs_vec3_add_scaled(p, s->point[i + (n + 1) * j], by_u[i] * by_v[j]);
  return s->target->distance(s->target->self, p, &nearest);
}

static void set_patch(const fs_problem *p, const fs_element *e, patch *s) {
  const fs_extraction *x = s->extraction;
  for (int32_t row = 0; row < (x->degree_u + 1) * (x->degree_v + 1); row++) {
    s->point[row] = (fs_vec3){0, 0, 0};
    for (int32_t d = 0; d < x->n_dofs; d++)
      s->point[row] = fs_vec3_add_scaled(s->point[row], p->c[p->space->dof[e->dof_start + d]],
                                         x->E[(size_t)row * (size_t)x->n_dofs + (size_t)d]);
  }
}

static double clamp(double t) { return t < 0 ? 0 : t > 1 ? 1 : t; }

static farthest search_grid(const patch *s, int32_t n) {
  farthest best = {-1, 0, 0};
  for (int32_t j = 0; j <= n; j++)
    for (int32_t i = 0; i <= n; i++) {
      double u = (double)i / n, v = (double)j / n, distance = distance_at(s, u, v);
      if (!(distance <= best.distance)) best = (farthest){distance, u, v};
    }
  return best;
}

static farthest follow(const patch *s, farthest best, double step) {
  static const int way[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
  for (int k = 0; k < N_STEPS && step > 1e-5; k++) {
    bool is_better = false;
    for (int w = 0; w < 8; w++) {
      double u = clamp(best.u + step * way[w][0]), v = clamp(best.v + step * way[w][1]);
      double distance = distance_at(s, u, v);
      if (distance > best.distance) best = (farthest){distance, u, v}, is_better = true;
    }
    if (!is_better) step *= 0.5;
  }
  return best;
}

static fs_status run(void *user, int32_t begin, int32_t end, int32_t worker) {
  const search *s = user;
  const fs_problem *p = s->wall->problem;
  patch at;
  (void)worker;
  for (int32_t i = begin; i < end; i++) {
    const fs_element *e = &p->space->element[i];
    at.target = s->wall->target;
    at.extraction = &p->space->extraction[e->extraction];
    int32_t n = 2 * (s->wall->table[e->extraction].n - 1);
    if (s->point[i].distance < s->follow_at && isfinite(s->follow_at)) continue;
    set_patch(p, e, &at);
    s->point[i] = isfinite(s->follow_at) ? follow(&at, s->point[i], 0.5 / n) : search_grid(&at, n);
  }
  return FS_OK;
}

fs_status fs_wall_measure(fs_wall *b, double *distance, int32_t *face) {
  fs_status status = FS_OK;
  const fs_problem *p = b->problem;
  search s = {.wall = b};
  FS_ALLOC(p->ctx, s.point, p->space->n_elements);
  s.follow_at = INFINITY;
  for (int pass = 0; pass < 2; pass++) {
    FS_TRY(fs_parallel_for(p->ctx, p->space->n_elements, run, &s));
    *distance = -1;
    for (int32_t i = 0; i < p->space->n_elements; i++)
      if (!(s.point[i].distance <= *distance)) *distance = s.point[i].distance, *face = p->space->element[i].face;
    s.follow_at = 0.95 * *distance;
  }
done:
  fs_release(p->ctx, s.point);
  return status;
}
