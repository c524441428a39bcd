/* SPDX-License-Identifier: MIT */
/* The lines of the table of constructions. */
#ifndef FS_CONSTRUCT_CONSTRUCT_H
#define FS_CONSTRUCT_CONSTRUCT_H

#include <fairsurf/construct.h>

extern const fs_construction fs_construction_coons;
extern const fs_construction fs_construction_gregory, fs_construction_stacho, fs_construction_stacho_graph,
    fs_construction_junction, fs_construction_gap;

#endif
