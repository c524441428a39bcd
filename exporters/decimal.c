/* SPDX-License-Identifier: MIT */
/* Single role: doubles and integers as decimal text, faster than printf and independent of the locale.

   A double is c 2^q. Shortest text [Giulietti 2020, "The Schubfach way to render doubles"]: with 10^k <= 2^q (the width of
   the interval that rounds to the double) < 10^(k+1), at least one and at most two multiples of 10^k lie in the interval,
   and at most one of 10^(k+1). The middle and both ends times 10^-k are needed to two bits behind the point only; these are
   products with a 128-bit power of ten, of which all lower bits are kept as one ("round to odd").

   Rounded text: the integer part and the fraction of c 2^q 10^t, t such that the integer has as many digits as are wanted.
   The product is too large by less than two units of its 128th bit; where half a unit lies within that, printf decides. */
#include "decimal.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

typedef struct decimal {
  uint64_t digits; /* the number is digits 10^exponent */
  int32_t exponent;
} decimal;

typedef struct binary {
  uint64_t c; /* the number is c 2^q */
  int32_t q;
  bool is_negative, is_power; /* is_power: the next smaller double is half as far away as the next larger one */
} binary;

static binary take_apart(double number) {
  uint64_t bits, fraction;
  int32_t exponent;
  binary b;
  memcpy(&bits, &number, sizeof bits);
  fraction = bits & (UINT64_MAX >> 12);
  exponent = (int32_t)(bits >> 52 & 0x7ff);
  b.is_negative = bits >> 63 != 0;
  b.is_power = fraction == 0 && exponent > 1;
  b.c = exponent == 0 ? fraction : fraction | UINT64_C(1) << 52;
  b.q = exponent == 0 ? -1074 : exponent - 1075;
  return b;
}

/* Quotient rounded down, for negative numbers too. */
static int32_t shift_down(int32_t number, int32_t bits) { return number >= 0 ? number >> bits : ~(~number >> bits); }

static int32_t floor_log10_of_power2(int32_t e) { return shift_down(e * 1262611, 22); }
static int32_t floor_log10_of_3_4_power2(int32_t e) { return shift_down(e * 1262611 - 524031, 22); }
static int32_t floor_log2_of_power10(int32_t e) { return shift_down(e * 1741647, 19); }

typedef struct product {
  uint64_t high, low;
} product;

static product multiply(uint64_t a, uint64_t b) {
#ifdef __SIZEOF_INT128__
  __extension__ typedef unsigned __int128 wide;
  wide p = (wide)a * b;
  return (product){(uint64_t)(p >> 64), (uint64_t)p};
#else
  uint64_t a0 = a & UINT32_MAX, a1 = a >> 32, b0 = b & UINT32_MAX, b1 = b >> 32;
  uint64_t low = a0 * b0, middle = a1 * b0 + (low >> 32), cross = a0 * b1 + (middle & UINT32_MAX);
  return (product){a1 * b1 + (middle >> 32) + (cross >> 32), cross << 32 | (low & UINT32_MAX)};
#endif
}

/* Bits 64 .. 191 of a times the power. */
static product multiply_power(uint64_t a, const fs_power *power) {
  product high = multiply(a, power->high), low = multiply(a, power->low);
  high.low += low.high;
  high.high += high.low < low.high;
  return high;
}

/* Bits 128 .. 191, with the last one set where anything below remains: 1 may be the error of the power. */
static uint64_t multiply_to_odd(uint64_t a, const fs_power *power) {
  product p = multiply_power(a, power);
  return p.high | (p.low > 1);
}

static decimal find_shortest(const binary *b) {
  int32_t k = b->is_power ? floor_log10_of_3_4_power2(b->q) : floor_log10_of_power2(b->q);
  int32_t h = b->q + floor_log2_of_power10(-k) + 1; /* 1 .. 4 */
  const fs_power *power = &fs_powers_of_ten[-k - FS_POWER_FIRST];
  uint64_t is_odd = b->c & 1; /* the ends of the interval of an odd c read back as its neighbours */
  uint64_t low = multiply_to_odd((4 * b->c - 2 + b->is_power) << h, power) + is_odd;
  uint64_t middle = multiply_to_odd(4 * b->c << h, power);
  uint64_t high = multiply_to_odd((4 * b->c + 2) << h, power) - is_odd;
  uint64_t s = middle / 4;
  if (s >= 10) {
    uint64_t t = s / 10;
    bool is_lower_inside = low <= 40 * t, is_upper_inside = 40 * t + 40 <= high;
    if (is_lower_inside != is_upper_inside) return (decimal){t + is_upper_inside, k + 1};
  }
  bool is_lower_inside = low <= 4 * s, is_upper_inside = 4 * s + 4 <= high;
  if (is_lower_inside != is_upper_inside) return (decimal){s + is_upper_inside, k};
  return (decimal){s + (middle > 4 * s + 2 || (middle == 4 * s + 2 && (s & 1) != 0)), k};
}

/* ---- layout ---- */

static const char pairs[] =
    "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243444546474849"
    "5051525354555657585960616263646566676869707172737475767778798081828384858687888990919293949596979899";

static int32_t count_digits(uint64_t number) {
  int32_t n = 1;
  for (; number >= 10000; number /= 10000) n += 4;
  return n + (number >= 10) + (number >= 100) + (number >= 1000);
}

/* Exactly n digits, with zeros in front. */
static void put_digits(char *text, uint64_t number, int32_t n) {
  for (; n >= 2; n -= 2, number /= 100) memcpy(text + n - 2, pairs + 2 * (number % 100), 2);
  if (n == 1) *text = (char)('0' + number % 10);
}

/* As "%g" lays numbers out: with an exponent where it is below -4, or not below limit. */
static size_t put_decimal(char *text, bool is_negative, decimal d, int32_t limit) {
  char *at = text;
  int32_t n = count_digits(d.digits), e;
  e = d.exponent + n - 1;
  for (; d.digits % 100 == 0; d.digits /= 100) n -= 2;
  if (d.digits % 10 == 0) d.digits /= 10, n--;
  if (is_negative) *at++ = '-';
  if (e < -4 || e >= limit) {
    uint32_t size = (uint32_t)(e < 0 ? -e : e);
    put_digits(at + 1, d.digits, n);
    at[0] = at[1];
    at[1] = '.';
    at += n > 1 ? n + 1 : 1;
    *at++ = 'e';
    *at++ = e < 0 ? '-' : '+';
    if (size >= 100) *at++ = (char)('0' + size / 100);
    put_digits(at, size % 100, 2);
    at += 2;
  } else if (e < 0) {
    memcpy(at, "0.000000", 8);
    put_digits(at + 1 - e, d.digits, n);
    at += 1 - e + n;
  } else if (e >= n - 1) {
    put_digits(at, d.digits, n);
    memset(at + n, '0', (size_t)(e + 1 - n));
    at += e + 1;
  } else {
    put_digits(at + 1, d.digits, n);
    memmove(at, at + 1, (size_t)e + 1);
    at[e + 1] = '.';
    at += n + 1;
  }
  return (size_t)(at - text);
}

static size_t put_zero(char *text, bool is_negative) {
  memcpy(text, is_negative ? "-0" : "0", 2);
  return is_negative ? 2 : 1;
}

size_t fs_decimal_shortest(char *text, double number) {
  binary b = take_apart(number);
  if (b.c == 0) return put_zero(text, b.is_negative);
  /* Whole numbers below 2^53 need no search. */
  if (b.q <= 0 && b.q > -53 && (b.c & ((UINT64_C(1) << -b.q) - 1)) == 0)
    return put_decimal(text, b.is_negative, (decimal){b.c >> -b.q, 0}, 17);
  return put_decimal(text, b.is_negative, find_shortest(&b), 17);
}

/* ---- rounded ---- */

static const uint64_t small_powers[] = {1,
                                        10,
                                        100,
                                        1000,
                                        10000,
                                        100000,
                                        1000000,
                                        10000000,
                                        100000000,
                                        1000000000,
                                        10000000000,
                                        100000000000,
                                        1000000000000,
                                        10000000000000,
                                        100000000000000,
                                        1000000000000000,
                                        10000000000000000,
                                        100000000000000000};

/* False where 128 bits do not decide. c is not zero, and normal: its bit 52 is set. */
static bool find_rounded(const binary *b, int32_t n_digits, decimal *d) {
  int32_t e = floor_log10_of_power2(b->q + 52); /* of the number, or one less */
  for (int32_t attempt = 0; attempt < 2; attempt++, e++) {
    int32_t t = n_digits - 1 - e, shift;
    const fs_power *power;
    product p;
    uint64_t integer, fraction, half;
    if (t < FS_POWER_FIRST || t > FS_POWER_LAST) return false;
    power = &fs_powers_of_ten[t - FS_POWER_FIRST];
    p = multiply_power(b->c << 11, power);
    shift = 11 - b->q + 127 - floor_log2_of_power10(t) - 128; /* of p.high; 1 .. 63 since 1 <= integer < 10^18 */
    integer = p.high >> shift;
    if (integer >= small_powers[n_digits]) continue;
    half = UINT64_C(1) << (shift - 1);
    fraction = p.high & (2 * half - 1);
    if (t >= 0 && t <= 27) { /* 5^27 < 2^64: the product is exact */
      bool is_tie = fraction == half && p.low == 0;
      integer += is_tie ? integer & 1 : fraction >= half;
    } else {
      if ((fraction == half && p.low <= 2) || (fraction == half - 1 && p.low >= UINT64_MAX - 2)) return false;
      integer += fraction >= half;
    }
    *d = (decimal){integer, -t};
    return true;
  }
  return false;
}

/* Whatever stands between the digits of the locale's number is its decimal point. */
static size_t print_rounded(char *text, double number, int32_t digits) {
  char local[64];
  size_t n = 0;
  bool is_point = false;
  snprintf(local, sizeof local, "%.*g", (int)digits, number);
  for (const char *c = local; *c != '\0' && n < FS_DECIMAL_SIZE; c++) {
    bool is_plain = strchr("0123456789+-e", *c) != NULL;
    if (is_plain || !is_point) text[n++] = is_plain ? *c : '.';
    is_point = !is_plain;
  }
  return n;
}

size_t fs_decimal_rounded(char *text, double number, int32_t digits) {
  binary b = take_apart(number);
  decimal d;
  if (b.c == 0) return put_zero(text, b.is_negative);
  if (b.c >> 52 == 0 || !find_rounded(&b, digits, &d)) return print_rounded(text, number, digits);
  return put_decimal(text, b.is_negative, d, digits);
}

size_t fs_decimal_integer(char *text, int64_t number) {
  uint64_t size = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;
  int32_t n = count_digits(size), sign = number < 0;
  *text = '-';
  put_digits(text + sign, size, n);
  return (size_t)(sign + n);
}
