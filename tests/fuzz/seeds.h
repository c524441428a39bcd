/* SPDX-License-Identifier: MIT */
/* The files of a folder of seeds. */
#ifndef FS_TEST_SEEDS_H
#define FS_TEST_SEEDS_H

#include "support.h"

/* Calls visit for every file whose extension has a reader, in the order of their names; returns their number. */
int32_t for_each_seed(const char *folder, void *user,
                      void (*visit)(void *user, const char *name, const char *extension, const char *bytes,
                                    size_t size));

#endif
