/* SPDX-License-Identifier: MIT */
/* An output that keeps the files of one export in memory. */
#ifndef FS_TEST_MEMORY_OUTPUT_H
#define FS_TEST_MEMORY_OUTPUT_H

#include <fairsurf/export.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Zero at the beginning. Several files follow each other in bytes; a zero byte ends them. */
typedef struct memory_output {
  char *bytes, extension[16];
  size_t size;
  int32_t n_opened;
} memory_output;

static inline fs_status memory_output_write(void *user, const void *bytes, size_t size) {
  memory_output *file = user;
  file->bytes = realloc(file->bytes, file->size + size + 1);
  memcpy(file->bytes + file->size, bytes, size);
  file->size += size;
  file->bytes[file->size] = '\0';
  return FS_OK;
}

static inline fs_status memory_output_open(void *user, const char *extension, fs_sink *sink) {
  memory_output *file = user;
  file->n_opened++;
  snprintf(file->extension, sizeof file->extension, "%s", extension);
  *sink = (fs_sink){memory_output_write, file};
  return FS_OK;
}

static inline fs_output memory_output_of(memory_output *file) { return (fs_output){memory_output_open, file}; }

/* value of the parameter of that name, among those of an exporter */
static inline void memory_output_set(const fs_exporter *exporter, double *param, const char *name, double value) {
  for (int k = 0; exporter->params[k].name != NULL; k++)
    if (strcmp(exporter->params[k].name, name) == 0) param[k] = value;
}

/* The numbers behind the first occurrence of `behind`: whatever stands between them is skipped. */
static inline const char *memory_output_numbers(const char *text, const char *behind, size_t n, double *number) {
  const char *at = strstr(text, behind);
  if (at == NULL) return NULL;
  at += strlen(behind);
  for (size_t k = 0; k < n; k++) {
    char *end;
    at += strcspn(at, "-0123456789");
    number[k] = strtod(at, &end);
    if (end == at) return NULL;
    at = end;
  }
  return at;
}

#endif
