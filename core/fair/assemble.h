/* SPDX-License-Identifier: MIT */
/* The working memory of one thread in assemble.c. */
#ifndef FS_FAIR_ASSEMBLE_H
#define FS_FAIR_ASSEMBLE_H

#include <stddef.h>

size_t fs_assemble_scratch_size(void);

#endif
