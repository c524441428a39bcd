/* SPDX-License-Identifier: MIT */
/* What the programs that measure fairing share: a wavy sheet of quads, its n x n free vertices moved at random by a twentieth of
   an edge, and three rows of vertices around them that are fixed. */
#ifndef FS_BENCH_FAIR_RUN_H
#define FS_BENCH_FAIR_RUN_H

#include <fairsurf/fairsurf.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { BENCH_RIM = 3 }; /* rows of fixed vertices */

/* n + 2 BENCH_RIM vertices in each direction, x fastest; exits with a message on failure. */
fs_mesh *bench_make_sheet(fs_context *ctx, int n);

/* Fairs a sheet with n x n free vertices by the functional "penalised", C = 0.01; exits with a message on failure. */
fs_fair_report bench_fair_sheet(int n, int n_threads, fs_fair_options options);

#ifdef __cplusplus
}
#endif

#endif
