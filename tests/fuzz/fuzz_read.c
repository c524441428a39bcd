/* SPDX-License-Identifier: MIT */
/* Single role: the readers as a target of libFuzzer. It is built
   from this file, read_one.c, tests/support, core/base and core/mesh with clang -fsanitize=fuzzer,address,undefined, and
   run with tests/fuzz/seeds as the corpus. */
#include "read_one.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
  for (const fs_reader *const *reader = fs_readers; *reader != NULL; reader++)
    read_one((*reader)->extension, (const char *)bytes, size);
  return 0;
}
