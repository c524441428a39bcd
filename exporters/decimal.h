/* SPDX-License-Identifier: MIT */
/* Numbers as decimal text, whatever the locale: the one way in which all exporters write them. */
#ifndef FS_EXPORTERS_DECIMAL_H
#define FS_EXPORTERS_DECIMAL_H

#include <stddef.h>
#include <stdint.h>

enum { FS_DECIMAL_SIZE = 32 }; /* room that every text below fits in; none ends with a zero byte */

/* The shortest text that reads back as the same double, and the nearest to it of that length. number is finite. */
size_t fs_decimal_shortest(char *text, double number);

/* What printf makes of "%.{digits}g" in the C locale: 1 to 17 digits, correctly rounded. number is finite. */
size_t fs_decimal_rounded(char *text, double number, int32_t digits);

size_t fs_decimal_integer(char *text, int64_t number);

/* 10^k as high 2^64 + low, scaled by a power of two so that the top bit of high is set, and rounded up. */
enum { FS_POWER_FIRST = -292, FS_POWER_LAST = 324 };
typedef struct fs_power {
  uint64_t high, low;
} fs_power;
extern const fs_power fs_powers_of_ten[FS_POWER_LAST - FS_POWER_FIRST + 1]; /* entry k - FS_POWER_FIRST */

#endif
