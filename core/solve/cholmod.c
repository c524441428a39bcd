/* SPDX-License-Identifier: MIT */
/* Single role: the solver on CHOLMOD's supernodal factorisation [Chen Davis Hager Rajamanickam 2008].
   The order is found on the graph of blocks, a ninth of the entries, and the matrix is handed over in it: CHOLMOD would permute its
   values anew for every factorisation. The order is a postorder of the elimination tree of blocks; then that of the rows is one
   too, since the three rows of a block follow each other in the tree. */
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
  int32_t *number;    /* [n_blocks] of a block in the order of elimination */
  int32_t *place;     /* of each block of the pattern among those of its column there */
  int32_t *col_start; /* [n_blocks + 1] there */
  int *start, *row;   /* the rows; each column has its diagonal block first */
  double *value;
  double *right; /* [3 n_blocks] */
  const fs_sparse *pattern;
  fs_solver_costs costs;
};

static fs_status failed(fs_context *ctx, const fs_solver *s, const char *what) {
  if (s->common.status == CHOLMOD_OUT_OF_MEMORY || s->common.status == CHOLMOD_TOO_LARGE)
    return fs_fail(ctx, FS_ERR_MEMORY, "out of memory in the %s of %d unknown points", what, s->pattern->n_blocks);
  return fs_fail(ctx, FS_ERR_NUMERIC, "CHOLMOD status %d in the %s of %d unknown points", s->common.status, what,
                 s->pattern->n_blocks);
}

/* s->number from the order of the graph of blocks. */
static fs_status order_blocks(fs_context *ctx, fs_solver *s) {
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
  for (int32_t i = 0; i < s->pattern->n_blocks; i++) s->number[((const int *)graph->Perm)[i]] = i;
done:
  cholmod_free_factor(&graph, &s->common);
  return status;
}

/* Column of block (i, j) in the order of elimination, below the diagonal: the lower number. */
static int32_t column_of(const fs_solver *s, int32_t i, int32_t j) {
  return s->number[i] < s->number[j] ? s->number[i] : s->number[j];
}

/* col_start and place; a diagonal block is the first of its column. */
static fs_status place_blocks(fs_context *ctx, fs_solver *s) {
  fs_status status = FS_OK;
  const fs_sparse *a = s->pattern;
  int32_t *used = NULL;
  FS_ALLOC(ctx, used, a->n_blocks);
  for (int32_t j = 0; j < a->n_blocks; j++)
    for (int32_t k = a->col_start[j]; k < a->col_start[j + 1]; k++) s->col_start[column_of(s, a->row[k], j) + 1]++;
  for (int32_t j = 0; j < a->n_blocks; j++) s->col_start[j + 1] += s->col_start[j];
  for (int32_t j = 0; j < a->n_blocks; j++)
    for (int32_t k = a->col_start[j]; k < a->col_start[j + 1]; k++)
      s->place[k] = a->row[k] == j ? 0 : 1 + used[column_of(s, a->row[k], j)]++;
done:
  fs_release(ctx, used);
  return status;
}

static void spread_pattern(fs_solver *s) {
  const fs_sparse *a = s->pattern;
  for (int32_t j = 0; j < a->n_blocks; j++)
    for (int c = 0; c < 3; c++) {
      int32_t n = s->col_start[j + 1] - s->col_start[j];
      s->start[3 * j + c] = 9 * s->col_start[j] + 3 * n * c;
    }
  s->start[3 * a->n_blocks] = 9 * s->col_start[a->n_blocks];
  for (int32_t j = 0; j < a->n_blocks; j++)
    for (int32_t k = a->col_start[j]; k < a->col_start[j + 1]; k++) {
      int32_t column = column_of(s, a->row[k], j), row = s->number[a->row[k]] + s->number[j] - column;
      for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++) s->row[s->start[3 * column + c] + 3 * s->place[k] + r] = 3 * row + r;
    }
}

/* s->value = factor times the values of a, or added; their blocks are transposed where the order turns them. */
static void spread_values(fs_solver *s, double factor, const fs_sparse *a, bool is_added) {
  for (int32_t j = 0; j < a->n_blocks; j++) {
    int32_t n = a->col_start[j + 1] - a->col_start[j];
    for (int32_t b = 0; b < n; b++) {
      int32_t k = a->col_start[j] + b, i = a->row[k], column = column_of(s, i, j);
      size_t stride = 3 * (size_t)(s->col_start[column + 1] - s->col_start[column]);
      const double *from = a->value + 9 * (size_t)a->col_start[j] + 3 * (size_t)b;
      double *to = s->value + 9 * (size_t)s->col_start[column] + 3 * (size_t)s->place[k];
      bool is_turned = s->number[i] < s->number[j];
      for (int c = 0; c < 3; c++)
        for (int r = 0; r < 3; r++) {
          double value = factor * (is_turned ? from[3 * n * r + c] : from[3 * n * c + r]);
          to[stride * (size_t)c + r] = is_added ? to[stride * (size_t)c + r] + value : value;
        }
    }
  }
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
  if (bytes <= limit) return FS_OK;
  return fs_fail(ctx, FS_ERR_MEMORY,
                 "factorising the Hessian of %d unknown points would take %.3g GB of memory, and %.3g GB are %s",
                 s->pattern->n_blocks, 1e-9 * bytes, 1e-9 * limit, ctx->max_bytes > 0 ? "allowed" : "available");
}

fs_status fs_solver_create(fs_context *ctx, const fs_sparse *pattern, fs_solver **solver) {
  fs_status status = FS_OK;
  fs_solver *s = NULL;
  size_t n = 3 * (size_t)pattern->n_blocks, n_entries = 9 * (size_t)pattern->col_start[pattern->n_blocks];
  double begin = fs_clock_processor_seconds();
  FS_ALLOC(ctx, s, 1);
  s->pattern = pattern;
  cholmod_start(&s->common);
  s->common.print = 0;
  s->common.quick_return_if_not_posdef = 1;
  FS_ALLOC(ctx, s->number, pattern->n_blocks);
  FS_ALLOC(ctx, s->col_start, (size_t)pattern->n_blocks + 1);
  FS_ALLOC(ctx, s->place, pattern->col_start[pattern->n_blocks]);
  FS_ALLOC(ctx, s->right, n);
  FS_ALLOC(ctx, s->start, n + 1);
  FS_ALLOC(ctx, s->row, n_entries);
  FS_ALLOC(ctx, s->value, n_entries);
  FS_TRY(order_blocks(ctx, s));
  FS_TRY(place_blocks(ctx, s));
  spread_pattern(s);
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
                               .packed = 1};
  s->common.nmethods = 1;
  s->common.method[0].ordering = CHOLMOD_NATURAL;
  s->common.postorder = 0;
  s->common.supernodal = CHOLMOD_SUPERNODAL;
  s->factor = cholmod_analyze(&s->matrix, &s->common);
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
  fs_release(ctx, s->number);
  fs_release(ctx, s->col_start);
  fs_release(ctx, s->place);
  fs_release(ctx, s->right);
  fs_release(ctx, s->start);
  fs_release(ctx, s->row);
  fs_release(ctx, s->value);
  fs_release(ctx, s);
}

fs_status fs_solver_factor(fs_context *ctx, fs_solver *s, const fs_sparse *a, const double *shift, bool *is_definite) {
  return fs_solver_factor_sum(ctx, s, a, 0, NULL, shift, is_definite);
}

fs_status fs_solver_factor_sum(fs_context *ctx, fs_solver *s, const fs_sparse *a, double nu, const fs_sparse *b,
                               const double *shift, bool *is_definite) {
  double begin = fs_clock_processor_seconds();
  spread_values(s, 1, a, false);
  if (b != NULL && nu != 0) spread_values(s, nu, b, true);
  for (int32_t j = 0; j < a->n_blocks; j++)
    for (int c = 0; c < 3; c++) s->value[s->start[3 * s->number[j] + c] + c] += shift[j];
  if (!cholmod_factorize(&s->matrix, s->factor, &s->common)) return failed(ctx, s, "factorisation");
  if (s->common.status < CHOLMOD_OK) return failed(ctx, s, "factorisation");
  s->costs.n_factorisations++;
  s->costs.factorisations += fs_clock_processor_seconds() - begin;
  *is_definite = s->common.status != CHOLMOD_NOT_POSDEF && s->factor->minor == s->factor->n;
  return FS_OK;
}

fs_status fs_solver_solve(fs_context *ctx, fs_solver *s, const double *b, double *x) {
  size_t n = 3 * (size_t)s->pattern->n_blocks;
  cholmod_dense right = {
      .nrow = n, .ncol = 1, .nzmax = n, .d = n, .x = s->right, .xtype = CHOLMOD_REAL, .dtype = CHOLMOD_DOUBLE};
  for (int32_t i = 0; i < s->pattern->n_blocks; i++)
    memcpy(s->right + 3 * (size_t)s->number[i], b + 3 * (size_t)i, 3 * sizeof *b);
  if (!cholmod_solve2(CHOLMOD_A, s->factor, &right, NULL, &s->solution, NULL, &s->work_y, &s->work_e, &s->common))
    return failed(ctx, s, "solution");
  const double *solution = s->solution->x;
  for (int32_t i = 0; i < s->pattern->n_blocks; i++)
    memcpy(x + 3 * (size_t)i, solution + 3 * (size_t)s->number[i], 3 * sizeof *x);
  return FS_OK;
}
