/* SPDX-License-Identifier: MIT */
/* A binary PLY file in memory, for the tests of the readers. */
#ifndef FS_TEST_BINARY_PLY_H
#define FS_TEST_BINARY_PLY_H

#include <stdint.h>
#include <string.h>

/* Bytes put one after the other, little-endian whatever the machine. */
struct bytes {
  char at[2048];
  size_t size;
};

static inline void put(struct bytes *b, uint64_t value, int size) {
  for (int i = 0; i < size; i++) b->at[b->size++] = (char)(value >> 8 * i);
}

static inline void put_text(struct bytes *b, const char *text) {
  memcpy(b->at + b->size, text, strlen(text));
  b->size += strlen(text);
}

static inline void put_float(struct bytes *b, float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  put(b, bits, 4);
}

static inline void put_double(struct bytes *b, double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  put(b, bits, 8);
}

/* A triangle and a quad, among properties of all types; its last 20 bytes are the second face. */
static inline struct bytes binary_ply(void) {
  struct bytes b = {.size = 0};
  put_text(&b, "ply\nformat binary_little_endian 1.0\nelement vertex 5\nproperty uchar a\nproperty float x\n"
               "property short y\nproperty double z\nproperty list char ushort l\nelement edge 2\nproperty int16 e\n"
               "element face 2\nproperty list ushort int vertex_indices\nproperty uint f\nend_header\n");
  for (int v = 0; v < 5; v++) {
    put(&b, 0xff, 1);
    put_float(&b, (float)(0.1 * v));
    put(&b, (uint64_t)(-300 * v), 2);
    put_double(&b, v / 7.0);
    put(&b, (uint64_t)v, 1);
    for (int i = 0; i < v; i++) put(&b, 0x0a0d, 2);
  }
  put(&b, 0x0a0a0a0a, 4);
  put(&b, 3, 2), put(&b, 0, 4), put(&b, 1, 4), put(&b, 2, 4), put(&b, 0, 4);
  put(&b, 4, 2), put(&b, 2, 4), put(&b, 1, 4), put(&b, 3, 4), put(&b, 4, 4), put(&b, 0, 4);
  return b;
}

#endif
