/* SPDX-License-Identifier: MIT */
/* Compares two pictures by their pixels, whatever else the files hold.
   Usage: compare A B [--tolerance T] [--pixels N] [--difference OUT.png]
   A pixel differs when one of its channels does by more than T of 255 (default 2). Exit 0: at most N pixels differ (default
   0); 1: more, or the sizes differ; 2: usage or files. The difference picture shows A in pale grey, and what differs in
   red, the darker the less. */
#include "picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct options {
  const char *a, *b, *difference;
  int32_t tolerance, pixels;
} options;

static bool read_number(const char *text, int32_t *number) {
  char *end;
  long value = strtol(text, &end, 10);
  if (end == text || *end != '\0' || value < 0 || value > INT32_MAX) return false;
  *number = (int32_t)value;
  return true;
}

static bool read_options(int argc, char **argv, options *o) {
  *o = (options){.tolerance = 2};
  for (int i = 1; i < argc; i++) {
    bool is_last = i + 1 == argc;
    if (strcmp(argv[i], "--tolerance") == 0 && !is_last) {
      if (!read_number(argv[++i], &o->tolerance)) return false;
    } else if (strcmp(argv[i], "--pixels") == 0 && !is_last) {
      if (!read_number(argv[++i], &o->pixels)) return false;
    } else if (strcmp(argv[i], "--difference") == 0 && !is_last) {
      o->difference = argv[++i];
    } else if (argv[i][0] == '-' || o->b != NULL) {
      return false;
    } else if (o->a == NULL) {
      o->a = argv[i];
    } else {
      o->b = argv[i];
    }
  }
  return o->b != NULL;
}

/* Number of pixels that differ; the difference picture replaces shown. */
static int64_t compare(const picture *a, const picture *b, int32_t tolerance, picture *shown, int32_t *largest) {
  int64_t count = 0;
  *largest = 0;
  for (int32_t y = 0; y < a->height; y++) {
    for (int32_t x = 0; x < a->width; x++) {
      const uint8_t *p = picture_at(a, x, y);
      uint8_t *s = picture_at(shown, x, y);
      int32_t distance = picture_distance(p, picture_at(b, x, y));
      uint8_t grey = (uint8_t)(191 + (p[0] + p[1] + p[2]) / 12);
      memset(s, grey, 3);
      if (distance > *largest) *largest = distance;
      if (distance <= tolerance) continue;
      count++;
      s[0] = (uint8_t)(128 + distance / 2);
      s[1] = s[2] = 0;
    }
  }
  return count;
}

int main(int argc, char **argv) {
  options o;
  picture a = {0}, b = {0}, shown = {0};
  int32_t largest;
  int result = 2;
  if (!read_options(argc, argv, &o)) {
    fprintf(stderr, "usage: %s A B [--tolerance T] [--pixels N] [--difference OUT.png]\n", argv[0]);
    return 2;
  }
  if (!picture_read(o.a, &a) || !picture_read(o.b, &b)) goto done;
  if (a.width != b.width || a.height != b.height) {
    printf("sizes differ: %d x %d and %d x %d\n", a.width, a.height, b.width, b.height);
    result = 1;
    goto done;
  }
  shown = (picture){a.width, a.height, malloc(3 * (size_t)a.width * (size_t)a.height)};
  if (shown.rgb == NULL) {
    fprintf(stderr, "out of memory\n");
    goto done;
  }
  int64_t count = compare(&a, &b, o.tolerance, &shown, &largest);
  printf("%lld pixels differ by more than %d (%d are allowed), largest difference %d\n", (long long)count, o.tolerance,
         o.pixels, largest);
  if (o.difference != NULL && !picture_write(o.difference, &shown)) goto done;
  result = count > o.pixels;
done:
  free(shown.rgb);
  free(b.rgb);
  free(a.rgb);
  return result;
}
