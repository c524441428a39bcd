/* SPDX-License-Identifier: MIT */
/* Single role: contexts, counting allocator, random numbers and shared files for tests. */
#include "support.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

fs_context test_context(void) { return (fs_context){0}; }

/* The size of a block stands before it, in a header that keeps the alignment of malloc. */
enum { HEADER = 16 };

static void *counted_allocate(void *user, size_t size) {
  struct test_memory *memory = user;
  char *raw;
  if (++memory->n_allocations == memory->fail_at) return NULL;
  raw = malloc(size + HEADER);
  if (raw == NULL) return NULL;
  memcpy(raw, &size, sizeof size);
  memory->n_live++;
  memory->live_bytes += size;
  if (memory->live_bytes > memory->peak_bytes) memory->peak_bytes = memory->live_bytes;
  return raw + HEADER;
}

static void counted_release(void *user, void *block) {
  struct test_memory *memory = user;
  char *raw = (char *)block - HEADER;
  size_t size;
  memcpy(&size, raw, sizeof size);
  memory->n_live--;
  memory->live_bytes -= size;
  free(raw);
}

static void keep_note(void *user, const char *text) {
  struct test_memory *memory = user;
  memory->n_notes++;
  snprintf(memory->note, sizeof memory->note, "%s", text);
}

fs_context test_memory_context(struct test_memory *memory) {
  return (fs_context){.allocate = counted_allocate, .release = counted_release, .note = keep_note, .user = memory};
}

uint64_t test_random(uint64_t *state) {
  uint64_t x = *state += UINT64_C(0x9e3779b97f4a7c15);
  x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
  x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
  return x ^ (x >> 31);
}

double test_random_real(uint64_t *state, double min, double max) {
  return min + (max - min) * ((double)(test_random(state) >> 11) * 0x1p-53);
}

int32_t test_random_integer(uint64_t *state, int32_t min, int32_t max) {
  return min + (int32_t)(test_random(state) % (uint64_t)((int64_t)max - min + 1));
}

const char *test_shared(const char *relative) {
  static char path[4096];
  const char *folder = getenv("FAIRSURF_SHARED");
  FILE *file;
  if (folder == NULL || folder[0] == '\0') {
    fprintf(stderr, "skipped: FAIRSURF_SHARED does not name the folder that holds %s\n", relative);
    return NULL;
  }
  snprintf(path, sizeof path, "%s/%s", folder, relative);
  file = fopen(path, "rb");
  if (file == NULL) {
    fprintf(stderr, "skipped: no file %s\n", path);
    return NULL;
  }
  fclose(file);
  return path;
}

char *test_file(const char *path, size_t *size) {
  FILE *file = fopen(path, "rb");
  char *bytes = NULL;
  size_t capacity = 0, n = 0, got;
  if (file == NULL) {
    fprintf(stderr, "cannot open %s\n", path);
    exit(EXIT_FAILURE);
  }
  do {
    if (capacity - n < 2) {
      char *more = realloc(bytes, capacity = 2 * capacity + 65536);
      if (more == NULL) abort();
      bytes = more;
    }
    got = fread(bytes + n, 1, capacity - n - 1, file);
    n += got;
  } while (got > 0);
  fclose(file);
  bytes[n] = '\0';
  *size = n;
  return bytes;
}

fs_status test_parse(fs_context *ctx, const char *extension, const char *bytes, size_t size, fs_mesh **mesh) {
  char *copy = malloc(size + (size == 0));
  fs_status status;
  if (copy == NULL) abort();
  memcpy(copy, bytes, size);
  status = fs_mesh_parse(ctx, extension, copy, size, mesh);
  free(copy);
  return status;
}

fs_mesh *test_shared_mesh(const char *name) {
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  char relative[256];
  const char *path;
  char *bytes;
  size_t size;
  snprintf(relative, sizeof relative, "meshes/%s.obj", name);
  path = test_shared(relative);
  if (path == NULL) return NULL;
  bytes = test_file(path, &size);
  if (fs_mesh_parse(&ctx, "obj", bytes, size, &mesh) != FS_OK) {
    fprintf(stderr, "%s: %s\n", path, ctx.message);
    exit(EXIT_FAILURE);
  }
  free(bytes);
  return mesh;
}
