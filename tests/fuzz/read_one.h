/* SPDX-License-Identifier: MIT */
/* What the fuzzer, the replay of its seeds and the mutations share. */
#ifndef FS_TEST_READ_ONE_H
#define FS_TEST_READ_ONE_H

#include "support.h"

/* Extension of files of inner coefficients, which no reader of meshes takes. */
#define CAPS_FILE "json"

/* Parses and ends the program with abort() where the reader breaks a promise: a mesh that does not validate, a failure
   without a sentence, an output touched on failure, a leak, memory beyond a small multiple of the size. */
fs_status read_one(const char *extension, const char *bytes, size_t size);

#endif
