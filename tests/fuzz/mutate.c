/* SPDX-License-Identifier: MIT */
/* Single role: random changes of the seeds through the readers, the same ones on every run with the same numbers.
   Usage: mutate FOLDER CHANGES_PER_SEED [FIRST_NUMBER] */
#include "read_one.h"
#include "seeds.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct run {
  int32_t n_changes;
  uint64_t first;
  int64_t n_read, n_good;
};

static const char *const pieces[] = {
    "0",    "-1", "3",  "1e308", "1e-320", "nan",        "2147483647", "4294967296",
    "-0.0", "\n", "\r", "\\\n",  " ",      "4000000000", "\xff\xff",   "element face 9\n",
    "list", "#",  "/",  "f ",    "v ",     "t crease ",  "9999999999", "property char x\n"};

/* Puts piece in place of n bytes at position at; bytes has room. */
static size_t replace(char *bytes, size_t size, size_t at, size_t n, const char *piece, size_t length) {
  memmove(bytes + at + length, bytes + at + n, size - at - n);
  memcpy(bytes + at, piece, length);
  return size - n + length;
}

static size_t change(char *bytes, size_t size, uint64_t *random) {
  size_t at = test_random(random) % (size + 1), left = size - at;
  const char *piece = pieces[test_random(random) % (sizeof pieces / sizeof *pieces)];
  switch (test_random(random) % 6) {
  case 0: /* flip a bit */
    if (left > 0) bytes[at] = (char)(bytes[at] ^ (1 << test_random(random) % 8));
    return size;
  case 1: /* any byte */
    if (left > 0) bytes[at] = (char)test_random(random);
    return size;
  case 2:
    return at; /* cut off */
  case 3:
    return replace(bytes, size, at, 0, piece, strlen(piece));
  case 4:
    return replace(bytes, size, at, left > 4 ? test_random(random) % 5 : 0, piece, strlen(piece));
  default: /* drop some */
    return replace(bytes, size, at, left > 0 ? test_random(random) % left % 16 : 0, "", 0);
  }
}

static void mutate(void *user, const char *name, const char *extension, const char *bytes, size_t size) {
  enum { MOST_CHANGES = 4, LONGEST_PIECE = 20 };
  struct run *run = user;
  char *copy = malloc(size + MOST_CHANGES * LONGEST_PIECE);
  (void)name;
  if (copy == NULL) abort();
  for (int32_t i = 0; i < run->n_changes; i++) {
    uint64_t random = run->first + (uint64_t)i * 1000003u + size;
    size_t n = size;
    int32_t n_steps = test_random_integer(&random, 1, MOST_CHANGES);
    memcpy(copy, bytes, size);
    for (int32_t step = 0; step < n_steps; step++) n = change(copy, n, &random);
    run->n_good += read_one(extension, copy, n) == FS_OK;
    run->n_read++;
  }
  free(copy);
}

int main(int argc, char **argv) {
  struct run run = {.n_changes = argc > 2 ? atoi(argv[2]) : 0, .first = argc > 3 ? strtoull(argv[3], NULL, 10) : 0};
  int32_t n = argc > 2 ? for_each_seed(argv[1], &run, mutate) : 0;
  printf("%d seeds, %lld changed files, %lld of them still meshes\n", n, (long long)run.n_read, (long long)run.n_good);
  return n > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
