/* SPDX-License-Identifier: MIT */
/* Single role: every file of a folder of seeds through the reader of its extension, and through the others.
   Seeds named good_… must be read, all others refused. Usage: replay FOLDER */
#include "read_one.h"
#include "seeds.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void replay(void *user, const char *name, const char *extension, const char *bytes, size_t size) {
  bool is_good = strncmp(name, "good_", 5) == 0;
  int32_t *n_wrong = user;
  if (strcmp(extension, CAPS_FILE) == 0 && (read_one(CAPS_FILE, bytes, size) == FS_OK) != is_good) {
    fprintf(stderr, "%s is not as expected\n", name);
    (*n_wrong)++;
  }
  for (const fs_reader *const *reader = fs_readers; *reader != NULL; reader++) {
    fs_status status = read_one((*reader)->extension, bytes, size);
    if (strcmp((*reader)->extension, extension) != 0 || (status == FS_OK) == is_good) continue;
    fprintf(stderr, "%s: %s\n", name, fs_status_text(status));
    (*n_wrong)++;
  }
}

int main(int argc, char **argv) {
  int32_t n_wrong = 0, n = argc == 2 ? for_each_seed(argv[1], &n_wrong, replay) : 0;
  printf("%d seeds, %d not as expected\n", n, n_wrong);
  return n > 0 && n_wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
