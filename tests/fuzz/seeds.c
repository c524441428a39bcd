/* SPDX-License-Identifier: MIT */
/* Single role: the files of a folder of seeds, one after the other. */
#include "seeds.h"
#include "read_one.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool has_reader(const char *extension) {
  for (const fs_reader *const *reader = fs_readers; *reader != NULL; reader++)
    if (strcmp((*reader)->extension, extension) == 0) return true;
  return strcmp(extension, CAPS_FILE) == 0;
}

int32_t for_each_seed(const char *folder, void *user,
                      void (*visit)(void *user, const char *name, const char *extension, const char *bytes,
                                    size_t size)) {
  struct dirent **entry = NULL;
  int n = scandir(folder, &entry, NULL, alphasort);
  int32_t n_seeds = 0;
  for (int i = 0; i < n; i++) {
    const char *dot = strrchr(entry[i]->d_name, '.');
    if (dot != NULL && has_reader(dot + 1)) {
      char path[4096], *bytes;
      size_t size;
      snprintf(path, sizeof path, "%s/%s", folder, entry[i]->d_name);
      bytes = test_file(path, &size);
      visit(user, entry[i]->d_name, dot + 1, bytes, size);
      free(bytes);
      n_seeds++;
    }
    free(entry[i]);
  }
  free(entry);
  return n_seeds;
}
