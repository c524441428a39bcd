/* SPDX-License-Identifier: MIT */
/* Counts cracks. Usage: crack PICTURE FINE [OUT.png]
   Both pictures are renders of one surface by one camera, without antialiasing: blue (0, 0, 255) where there is nothing,
   green (0, 255, 0) where the surface is seen from inside, red by distance where it is seen from outside. FINE comes from a
   mesh with shared vertices, which has no cracks. A pixel is a crack when

     - it is blue in PICTURE while it and its 8 neighbours are red in FINE, or
     - it is green in PICTURE, the same holds in FINE, and those 9 are about equally far away. Through a crack in the front
       of a surface its far wall shows from inside. Where the surface turns away from the camera in front of another part
       of itself, the distances differ, and normals of the two renders may differ in what is inside.

   Exit 0: none; 1: some; 2: usage, files, or a FINE without surface. OUT.png is PICTURE with the cracks in white. */
#include "picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FOLD = 16 }; /* of 255 levels of red that span the whole object */

typedef enum kind { OUTSIDE, INSIDE, NOTHING } kind;

static kind kind_of(const uint8_t *pixel) {
  const uint8_t blue[3] = {0, 0, 255}, green[3] = {0, 255, 0};
  if (picture_distance(pixel, blue) <= 2) return NOTHING;
  return picture_distance(pixel, green) <= 2 ? INSIDE : OUTSIDE;
}

/* Whether (x, y) and its 8 neighbours, all in the picture, are surface seen from outside; range: of their red. */
static bool is_amid_surface(const picture *fine, int32_t x, int32_t y, int32_t *range) {
  int32_t min = 255, max = 0;
  if (x == 0 || y == 0 || x == fine->width - 1 || y == fine->height - 1) return false;
  for (int32_t j = y - 1; j <= y + 1; j++)
    for (int32_t i = x - 1; i <= x + 1; i++) {
      const uint8_t *pixel = picture_at(fine, i, j);
      if (kind_of(pixel) != OUTSIDE) return false;
      if (pixel[0] < min) min = pixel[0];
      if (pixel[0] > max) max = pixel[0];
    }
  *range = max - min;
  return true;
}

int main(int argc, char **argv) {
  picture p = {0}, fine = {0};
  int64_t n_inner = 0, n_cracks = 0;
  int result = 2;
  if (argc < 3 || argc > 4) {
    fprintf(stderr, "usage: %s PICTURE FINE [OUT.png]\n", argv[0]);
    return 2;
  }
  if (!picture_read(argv[1], &p) || !picture_read(argv[2], &fine)) goto done;
  if (p.width != fine.width || p.height != fine.height) {
    fprintf(stderr, "the pictures have different sizes\n");
    goto done;
  }
  for (int32_t y = 0; y < p.height; y++) {
    for (int32_t x = 0; x < p.width; x++) {
      int32_t range;
      if (!is_amid_surface(&fine, x, y, &range)) continue;
      n_inner++;
      kind seen = kind_of(picture_at(&p, x, y));
      if (seen == OUTSIDE || (seen == INSIDE && range > FOLD)) continue;
      if (n_cracks++ < 10) printf("crack at pixel (%d, %d)\n", x, y);
      memset(picture_at(&p, x, y), 255, 3);
    }
  }
  printf("%lld cracks among %lld pixels amid the surface\n", (long long)n_cracks, (long long)n_inner);
  if (argc == 4 && !picture_write(argv[3], &p)) goto done;
  if (n_inner == 0)
    fprintf(stderr, "the fine picture shows no surface\n");
  else
    result = n_cracks > 0;
done:
  free(fine.rgb);
  free(p.rgb);
  return result;
}
