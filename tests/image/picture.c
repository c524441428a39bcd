/* SPDX-License-Identifier: MIT */
/* PNG files to RGB bytes and back, by libpng's simplified interface. */
#include "picture.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>

bool picture_read(const char *path, picture *out) {
  png_image image = {.version = PNG_IMAGE_VERSION};
  uint8_t *rgb = NULL;
  if (!png_image_begin_read_from_file(&image, path)) goto failed;
  if (image.width > 16384 || image.height > 16384) {
    fprintf(stderr, "%s: larger than 16384 pixels\n", path);
    goto done;
  }
  image.format = PNG_FORMAT_RGB;
  rgb = malloc(PNG_IMAGE_SIZE(image));
  if (rgb == NULL) {
    fprintf(stderr, "%s: out of memory\n", path);
    goto done;
  }
  if (!png_image_finish_read(&image, &(png_color){0, 0, 0}, rgb, 0, NULL)) goto failed;
  *out = (picture){(int32_t)image.width, (int32_t)image.height, rgb};
  return true;
failed:
  fprintf(stderr, "%s: %s\n", path, image.message);
done:
  png_image_free(&image);
  free(rgb);
  return false;
}

bool picture_write(const char *path, const picture *in) {
  png_image image = {.version = PNG_IMAGE_VERSION, .format = PNG_FORMAT_RGB};
  image.width = (png_uint_32)in->width;
  image.height = (png_uint_32)in->height;
  if (png_image_write_to_file(&image, path, 0, in->rgb, 0, NULL)) return true;
  fprintf(stderr, "%s: %s\n", path, image.message);
  return false;
}

uint8_t *picture_at(const picture *p, int32_t x, int32_t y) {
  return p->rgb + 3 * ((size_t)y * (size_t)p->width + (size_t)x);
}

int32_t picture_distance(const uint8_t *a, const uint8_t *b) {
  int32_t largest = 0;
  for (int k = 0; k < 3; k++)
    if (abs(a[k] - b[k]) > largest) largest = abs(a[k] - b[k]);
  return largest;
}
