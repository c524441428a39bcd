/* SPDX-License-Identifier: MIT */
/* Single role: the solver on CHOLMOD's supernodal factorisation [Chen Davis Hager Rajamanickam 2008].
   The order is found on the graph of blocks, a ninth of the entries, and spread to the rows of the blocks. */
#include "solve/solver.h"
#include "base/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <suitesparse/cholmod.h>

struct fs_solver {
  cholmod_common common;
  cholmod_sparse matrix; /* view of the arrays below */
  cholmod_factor *factor;
  cholmod_dense *solution, *work_y, *work_e;
  int *start, *row; /* scalar pattern; column j has its diagonal block first */
  double *value;
  const fs_sparse *pattern;
  fs_solver_costs costs;
};

static fs_status failed(fs_context *ctx, const fs_solver *s, const char *what) {
  if (s->common.status == CHOLMOD_OUT_OF_MEMORY || s->common.status == CHOLMOD_TOO_LARGE)
    return fs_fail(ctx, FS_ERR_MEMORY, "out of memory in the %s of %d unknown points", what, s->pattern->n_blocks);
  return fs_fail(ctx, FS_ERR_NUMERIC, "CHOLMOD status %d in the %s of %d unknown points", s->common.status, what,
                 s->pattern->n_blocks);
}

/* order[3 n]: the order of the graph of blocks, each block's rows in sequence. */
static fs_status order_blocks(fs_context *ctx, fs_solver *s, int *order) {
  fs_status status = FS_OK;
  cholmod_factor *graph = NULL;
  cholmod_sparse pattern = {
      .nrow = (size_t)s->pattern->n_blocks,
      .ncol = (size_t)s->pattern->n_blocks,
      .nzmax = (size_t)s->pattern->col_start[s->pattern->n_blocks],
      .p = s->pattern->col_start,
      .i = s->pattern->row,
      .stype = -1,
      .itype = CHOLMOD_INT,
      .xtype = CHOLMOD_PATTERN,
      .dtype = CHOLMOD_DOUBLE,
      .sorted = 1,
      .packed = 1,
  };
  s->common.nmethods = 2;
  s->common.method[0].ordering = CHOLMOD_AMD;
  s->common.method[1].ordering = CHOLMOD_METIS;
  s->common.supernodal = CHOLMOD_SIMPLICIAL;
  graph = cholmod_analyze(&pattern, &s->common);
  if (graph == NULL) {
    status = failed(ctx, s, "ordering");
    goto done;
  }
  for (int32_t i = 0; i < s->pattern->n_blocks; i++)
    for (int r = 0; r < 3; r++) order[3 * (size_t)i + r] = 3 * ((const int *)graph->Perm)[i] + r;
done:
  cholmod_free_factor(&graph, &s->common);
  return status;
}

static void spread_pattern(fs_solver *s) {
  const fs_sparse *a = s->pattern;
  for (int32_t j = 0; j < a->n_blocks; j++) {
    int32_t n = a->col_start[j + 1] - a->col_start[j];
    for (int c = 0; c < 3; c++) {
      int start = 9 * a->col_start[j] + 3 * n * c;
      s->start[3 * j + c] = start;
      for (int32_t b = 0; b < n; b++)
        for (int r = 0; r < 3; r++) s->row[start + 3 * b + r] = 3 * a->row[a->col_start[j] + b] + r;
    }
  }
  s->start[3 * a->n_blocks] = 9 * a->col_start[a->n_blocks];
}

/* Memory that the system has left, in bytes; infinite where it does not say. */
static double available_memory(void) {
  double kilobytes = INFINITY;
  char line[128];
  FILE *file = fopen("/proc/meminfo", "r");
  if (file == NULL) return kilobytes;
  while (fgets(line, sizeof line, file) != NULL)
    if (sscanf(line, "MemAvailable: %lf kB", &kilobytes) == 1) break;
  fclose(file);
  return 1024 * kilobytes;
}

/* The factor is by far the largest thing, and its size is known before it is made. */
static fs_status check_memory(fs_context *ctx, const fs_solver *s) {
  double bytes = 8.0 * (double)s->factor->xsize + 8.0 * (double)s->factor->maxcsize + 4.0 * (double)s->factor->ssize;
  double limit = ctx->max_bytes > 0 ? ctx->max_bytes : available_memory();
  bytes += 12.0 * (double)s->matrix.nzmax; /* the permuted copy of the matrix */
  if (bytes <= limit) return FS_OK;
  return fs_fail(ctx, FS_ERR_MEMORY,
                 "factorising the Hessian of %d unknown points would take %.3g GB of memory, and %.3g GB are %s",
                 s->pattern->n_blocks, 1e-9 * bytes, 1e-9 * limit, ctx->max_bytes > 0 ? "allowed" : "available");
}

fs_status fs_solver_create(fs_context *ctx, const fs_sparse *pattern, fs_solver **solver) {
  fs_status status = FS_OK;
  fs_solver *s = NULL;
  int *order = NULL;
  size_t n = 3 * (size_t)pattern->n_blocks, n_entries = 9 * (size_t)pattern->col_start[pattern->n_blocks];
  double begin = fs_clock_processor_seconds();
  FS_ALLOC(ctx, s, 1);
  s->pattern = pattern;
  cholmod_start(&s->common);
  s->common.print = 0;
  s->common.quick_return_if_not_posdef = 1;
  FS_ALLOC(ctx, s->start, n + 1);
  FS_ALLOC(ctx, s->row, n_entries);
  FS_ALLOC(ctx, s->value, n_entries);
  FS_ALLOC(ctx, order, n);
  spread_pattern(s);
  FS_TRY(order_blocks(ctx, s, order));
  s->matrix = (cholmod_sparse){.nrow = n,
                               .ncol = n,
                               .nzmax = n_entries,
                               .p = s->start,
                               .i = s->row,
                               .x = s->value,
                               .stype = -1, /* entries above the diagonal are passed over */
                               .itype = CHOLMOD_INT,
                               .xtype = CHOLMOD_REAL,
                               .dtype = CHOLMOD_DOUBLE,
                               .sorted = 1,
                               .packed = 1};
  s->common.nmethods = 1;
  s->common.method[0].ordering = CHOLMOD_GIVEN;
  s->common.supernodal = CHOLMOD_SUPERNODAL;
  s->factor = cholmod_analyze_p(&s->matrix, order, NULL, 0, &s->common);
  if (s->factor == NULL) {
    status = failed(ctx, s, "analysis");
    goto done;
  }
  s->costs.flops = s->common.fl;
  s->costs.bytes = 8.0 * (double)s->factor->xsize;
  FS_TRY(check_memory(ctx, s));
  /* made here, since the solution itself does not survive when it cannot allocate them */
  if (cholmod_ensure_dense(&s->solution, n, 1, n, CHOLMOD_REAL, &s->common) == NULL ||
      cholmod_ensure_dense(&s->work_y, n, 1, n, CHOLMOD_REAL, &s->common) == NULL ||
      cholmod_ensure_dense(&s->work_e, 1, s->factor->maxesize, 1, CHOLMOD_REAL, &s->common) == NULL) {
    status = failed(ctx, s, "analysis");
    goto done;
  }
  s->costs.analysis = fs_clock_processor_seconds() - begin;
  *solver = s;
  s = NULL;
done:
  fs_release(ctx, order);
  fs_solver_free(ctx, s);
  return status;
}

fs_solver_costs fs_solver_get_costs(const fs_solver *s) { return s->costs; }

void fs_solver_free(fs_context *ctx, fs_solver *s) {
  if (s == NULL) return;
  cholmod_free_factor(&s->factor, &s->common);
  cholmod_free_dense(&s->solution, &s->common);
  cholmod_free_dense(&s->work_y, &s->common);
  cholmod_free_dense(&s->work_e, &s->common);
  cholmod_finish(&s->common);
  fs_release(ctx, s->start);
  fs_release(ctx, s->row);
  fs_release(ctx, s->value);
  fs_release(ctx, s);
}

fs_status fs_solver_factor(fs_context *ctx, fs_solver *s, const fs_sparse *a, const double *shift, bool *is_definite) {
  double begin = fs_clock_processor_seconds();
  memcpy(s->value, a->value, 9 * (size_t)a->col_start[a->n_blocks] * sizeof *a->value);
  for (int32_t j = 0; j < a->n_blocks; j++)
    for (int c = 0; c < 3; c++) s->value[s->start[3 * j + c] + c] += shift[j];
  if (!cholmod_factorize(&s->matrix, s->factor, &s->common)) return failed(ctx, s, "factorisation");
  if (s->common.status < CHOLMOD_OK) return failed(ctx, s, "factorisation");
  s->costs.n_factorisations++;
  s->costs.factorisations += fs_clock_processor_seconds() - begin;
  *is_definite = s->common.status != CHOLMOD_NOT_POSDEF && s->factor->minor == s->factor->n;
  return FS_OK;
}

fs_status fs_solver_solve(fs_context *ctx, fs_solver *s, const double *b, double *x) {
  size_t n = 3 * (size_t)s->pattern->n_blocks;
  cholmod_dense right = {.nrow = n,
                         .ncol = 1,
                         .nzmax = n,
                         .d = n,
                         .x = (void *)(uintptr_t)b, /* CHOLMOD does not write to it */
                         .xtype = CHOLMOD_REAL,
                         .dtype = CHOLMOD_DOUBLE};
  if (!cholmod_solve2(CHOLMOD_A, s->factor, &right, NULL, &s->solution, NULL, &s->work_y, &s->work_e, &s->common))
    return failed(ctx, s, "solution");
  memcpy(x, s->solution->x, n * sizeof *x);
  return FS_OK;
}
