/* SPDX-License-Identifier: MIT */
/* Counts cracks. Usage: crack PICTURE FINE BACKGROUND [OUT.png]      BACKGROUND: RRGGBB
   Both pictures are renders of one surface by one camera, without antialiasing, the surface in one colour from outside and
   in the colour of the background from inside; FINE from a mesh with shared vertices, which has no cracks. A pixel is a
   crack when it shows background in PICTURE while it and its 8 neighbours are surface in FINE.
   Exit 0: none; 1: some; 2: usage, files, or pictures that show nothing. OUT.png is PICTURE with the cracks in red. */
#include "picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool read_colour(const char *text, uint8_t colour[3]) {
  char *end;
  if (strlen(text) != 6) return false;
  unsigned long value = strtoul(text, &end, 16);
  if (*end != '\0') return false;
  for (int k = 0; k < 3; k++) colour[k] = (uint8_t)(value >> (16 - 8 * k));
  return true;
}

static bool is_background(const picture *p, int32_t x, int32_t y, const uint8_t *background) {
  return picture_distance(picture_at(p, x, y), background) <= 2;
}

/* Pixels at the border of the picture have no 8 neighbours and are no cracks. */
static bool is_inside(const picture *fine, int32_t x, int32_t y, const uint8_t *background) {
  if (x == 0 || y == 0 || x == fine->width - 1 || y == fine->height - 1) return false;
  for (int32_t j = y - 1; j <= y + 1; j++)
    for (int32_t i = x - 1; i <= x + 1; i++)
      if (is_background(fine, i, j, background)) return false;
  return true;
}

int main(int argc, char **argv) {
  picture p = {0}, fine = {0};
  uint8_t background[3];
  int64_t n_inside = 0, n_cracks = 0;
  int result = 2;
  if (argc < 4 || argc > 5 || !read_colour(argv[3], background)) {
    fprintf(stderr, "usage: %s PICTURE FINE RRGGBB [OUT.png]\n", argv[0]);
    return 2;
  }
  if (!picture_read(argv[1], &p) || !picture_read(argv[2], &fine)) goto done;
  if (p.width != fine.width || p.height != fine.height) {
    fprintf(stderr, "the pictures have different sizes\n");
    goto done;
  }
  for (int32_t y = 0; y < p.height; y++) {
    for (int32_t x = 0; x < p.width; x++) {
      if (!is_inside(&fine, x, y, background)) continue;
      n_inside++;
      if (!is_background(&p, x, y, background)) continue;
      if (n_cracks++ < 10) printf("crack at pixel (%d, %d)\n", x, y);
      memcpy(picture_at(&p, x, y), (uint8_t[3]){255, 0, 0}, 3);
    }
  }
  printf("%lld cracks among %lld pixels inside the surface\n", (long long)n_cracks, (long long)n_inside);
  if (argc == 5 && !picture_write(argv[4], &p)) goto done;
  if (n_inside == 0)
    fprintf(stderr, "the fine picture shows no surface\n");
  else
    result = n_cracks > 0;
done:
  free(fine.rgb);
  free(p.rgb);
  return result;
}
