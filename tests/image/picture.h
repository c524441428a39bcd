/* SPDX-License-Identifier: MIT */
/* Pictures as plain arrays of RGB bytes, read from and written to PNG files. */
#ifndef FS_TEST_PICTURE_H
#define FS_TEST_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct picture {
  int32_t width, height;
  uint8_t *rgb; /* [height][width][3] */
} picture;

/* False, and a sentence on stderr, where the file is no picture; free rgb with free. Transparency is laid on black. */
bool picture_read(const char *path, picture *out);
bool picture_write(const char *path, const picture *in);

/* The three bytes of pixel (x, y). */
uint8_t *picture_at(const picture *p, int32_t x, int32_t y);

/* Largest difference of the three channels of two pixels. */
int32_t picture_distance(const uint8_t *a, const uint8_t *b);

#endif
