/* SPDX-License-Identifier: MIT */
/* What the programs that measure fairing share: a wavy sheet of quads, its n x n free vertices moved at random by a twentieth of
   an edge, and three rows of vertices around them that are fixed. */
#ifndef FS_BENCH_FAIR_RUN_H
#define FS_BENCH_FAIR_RUN_H

#include <fairsurf/fairsurf.h>

/* Fairs a sheet with n x n free vertices by the functional "penalised", C = 0.01; exits with a message on failure. */
fs_fair_report bench_fair_sheet(int n, int n_threads, fs_fair_options options);

#endif
