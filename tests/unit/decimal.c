/* SPDX-License-Identifier: MIT */
/* Single role: tests of numbers as text: against printf and strtod on millions of doubles, and the powers of ten against
   long multiplication. */
#include "decimal.h"
#include "../support/support.h"

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- doubles of many sorts ---- */

static double from_bits(uint64_t bits) {
  double number;
  memcpy(&number, &bits, sizeof number);
  return number;
}

static double any_bits(uint64_t *state) {
  double number;
  do number = from_bits(test_random(state));
  while (!isfinite(number));
  return number;
}

static double coordinate(uint64_t *state) { return test_random_real(state, -100, 100); }

static double dyadic(uint64_t *state) { /* few bits: often half-way between two decimals */
  return ldexp((double)test_random_integer(state, -100000, 100000), -test_random_integer(state, 0, 40));
}

static double decimal_fraction(uint64_t *state) {
  return test_random_integer(state, -1000000, 1000000) / pow(10, test_random_integer(state, 0, 9));
}

static double near_power(uint64_t *state) {
  double power = test_random(state) % 2 ? ldexp(1, test_random_integer(state, -1074, 1023))
                                        : pow(10, test_random_integer(state, -307, 308));
  uint64_t bits;
  memcpy(&bits, &power, sizeof bits);
  bits += (uint64_t)(int64_t)test_random_integer(state, -2, 2);
  return isfinite(from_bits(bits)) ? from_bits(bits) : 1;
}

static double whole(uint64_t *state) {
  return (double)(int64_t)(test_random(state) >> test_random_integer(state, 1, 63));
}

static double subnormal(uint64_t *state) { return from_bits(test_random(state) >> test_random_integer(state, 12, 63)); }

static double (*const sorts[])(uint64_t *) = {any_bits,   coordinate, dyadic,   decimal_fraction,
                                              near_power, whole,      subnormal};
enum { N_SORTS = sizeof sorts / sizeof *sorts };

static const double corners[] = {0.0,
                                 -0.0,
                                 1,
                                 -1,
                                 10,
                                 0.1,
                                 0.3,
                                 1e15,
                                 1e16,
                                 1e17,
                                 1e22,
                                 1e23,
                                 5e-324,
                                 DBL_MIN,
                                 DBL_MAX,
                                 1e-4,
                                 1e-5,
                                 123456,
                                 9.5,
                                 0.5,
                                 99999.5,
                                 999.995,
                                 2.5,
                                 0.000125,
                                 1e300,
                                 1e-300,
                                 9007199254740992.0,
                                 9007199254740993.0,
                                 4.35,
                                 0x1p-1022,
                                 0x1.fffffffffffffp-1023,
                                 0x1p1023,
                                 123456789012345678.0};
enum { N_CORNERS = sizeof corners / sizeof *corners };

/* ---- what must hold ---- */

static int32_t significant_digits(const char *text) {
  int32_t n = 0, zeros = 0;
  for (; *text != '\0' && *text != 'e'; text++) {
    if (*text < '0' || *text > '9' || (n == 0 && *text == '0')) continue;
    n++;
    zeros = *text == '0' ? zeros + 1 : 0;
  }
  return n - zeros;
}

static void check_shortest(double number) {
  char text[FS_DECIMAL_SIZE + 1], other[64];
  double back;
  size_t size = fs_decimal_shortest(text, number);
  int32_t n;
  assert_true(size < sizeof text);
  text[size] = '\0';
  back = strtod(text, NULL);
  if (memcmp(&back, &number, sizeof back) != 0) fail_msg("%a gives %s, which reads back as %a", number, text, back);
  if (number == 0) return;
  n = significant_digits(text);
  /* No other text of as many digits is nearer. */
  snprintf(other, sizeof other, "%.*g", n, number);
  if (strtod(other, NULL) == number && strtod(other, NULL) == back && strcmp(other, text) != 0) {
    /* with an exponent "%g" depends on n: only the digits and the value are compared */
    snprintf(other, sizeof other, "%.*e", n - 1, number);
    char ours[64];
    snprintf(ours, sizeof ours, "%.*e", n - 1, strtod(text, NULL));
    if (strcmp(other, ours) != 0) fail_msg("%a gives %s, %s is nearer", number, text, other);
  }
  /* None of fewer digits reads back. Where the mantissa is a power of two the nearest text need not be the one. */
  if (n == 1) return;
  snprintf(other, sizeof other, "%.*e", n - 2, number);
  if (strtod(other, NULL) == number) fail_msg("%a gives %s, %s is shorter", number, text, other);
}

static void check_rounded(double number, int32_t digits) {
  char text[FS_DECIMAL_SIZE + 1], expected[64];
  size_t size = fs_decimal_rounded(text, number, digits);
  assert_true(size < sizeof text);
  text[size] = '\0';
  snprintf(expected, sizeof expected, "%.*g", (int)digits, number);
  if (strcmp(text, expected) != 0) fail_msg("%a to %d digits gives %s, not %s", number, digits, text, expected);
}

static int32_t multiplier(void) {
  const char *text = getenv("FAIRSURF_TEST_MULTIPLIER");
  return text != NULL && atoi(text) > 0 ? atoi(text) : 1;
}

static void test_shortest_reads_back(void **state) {
  uint64_t random = 5;
  (void)state;
  for (int32_t i = 0; i < N_CORNERS; i++) check_shortest(corners[i]), check_shortest(-corners[i]);
  for (int32_t e = 1; e < 2047; e++) /* the irregular intervals, and their neighbours, of every exponent */
    for (int64_t i = -1; i <= 1; i++) check_shortest(from_bits(((uint64_t)e << 52) + (uint64_t)i));
  for (int32_t i = 0; i < 1000000 * multiplier(); i++) check_shortest(sorts[i % N_SORTS](&random));
}

static void test_rounded_as_printf(void **state) {
  uint64_t random = 7;
  (void)state;
  for (int32_t digits = 1; digits <= 17; digits++)
    for (int32_t i = 0; i < N_CORNERS; i++) check_rounded(corners[i], digits), check_rounded(-corners[i], digits);
  for (int32_t i = 0; i < 2000000 * multiplier(); i++)
    check_rounded(sorts[i % N_SORTS](&random), test_random_integer(&random, 1, 17));
}

static void test_integers(void **state) {
  uint64_t random = 9;
  (void)state;
  for (int32_t i = 0; i < 1000000; i++) {
    int64_t number = i < 2000 ? i - 1000 : (int64_t)test_random(&random) >> test_random_integer(&random, 0, 63);
    char text[FS_DECIMAL_SIZE + 1], expected[64];
    if (i == 2000) number = INT64_MIN;
    text[fs_decimal_integer(text, number)] = '\0';
    snprintf(expected, sizeof expected, "%lld", (long long)number);
    assert_string_equal(text, expected);
  }
}

/* A comma as decimal point changes nothing. Uses what locale there is with one; passes where there is none. */
static void test_locale_is_ignored(void **state) {
  static const char *const names[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "pl_PL.UTF-8"};
  char text[FS_DECIMAL_SIZE + 1];
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof *names; i++)
    if (setlocale(LC_NUMERIC, names[i]) != NULL) break;
  text[fs_decimal_shortest(text, 1234.5)] = '\0';
  assert_string_equal(text, "1234.5");
  text[fs_decimal_rounded(text, 0x1.8p-1074, 5)] = '\0'; /* subnormal: by printf */
  assert_string_equal(text, "9.8813e-324");
  setlocale(LC_NUMERIC, "C");
}

/* ---- powers of ten ---- */

enum { N_WORDS = 48 };
typedef struct natural {
  uint32_t word[N_WORDS]; /* least first */
} natural;

static natural from_power(fs_power p) {
  return (natural){{(uint32_t)p.low, (uint32_t)(p.low >> 32), (uint32_t)p.high, (uint32_t)(p.high >> 32)}};
}

static void times_ten(natural *a) {
  uint64_t carry = 0;
  for (int32_t i = 0; i < N_WORDS; i++) {
    carry += 10 * (uint64_t)a->word[i];
    a->word[i] = (uint32_t)carry;
    carry >>= 32;
  }
  assert_true(carry == 0);
}

static int32_t n_bits(const natural *a) {
  for (int32_t i = 32 * N_WORDS - 1; i >= 0; i--)
    if (a->word[i / 32] >> (i % 32) & 1) return i + 1;
  return 0;
}

/* ceil(a 2^(128 - n_bits)) */
static fs_power leading(const natural *a) {
  fs_power p = {0, 0};
  int32_t n = n_bits(a);
  bool is_inexact = false;
  for (int32_t i = n - 1, k = 127; i >= 0; i--, k--) {
    uint64_t bit = a->word[i / 32] >> (i % 32) & 1;
    if (k >= 64)
      p.high |= bit << (k - 64);
    else if (k >= 0)
      p.low |= bit << k;
    else
      is_inexact = is_inexact || bit != 0;
  }
  p.low += is_inexact;
  p.high += is_inexact && p.low == 0;
  return p;
}

static void test_powers_of_ten(void **state) {
  natural ten = {{1}};
  (void)state;
  for (int32_t k = 0; k <= FS_POWER_LAST; k++, times_ten(&ten)) {
    fs_power expected = leading(&ten), found = fs_powers_of_ten[k - FS_POWER_FIRST];
    assert_true(expected.high == found.high && expected.low == found.low);
  }
  /* g = ceil(2^s 10^k) for k < 0: g 10^-k >= 2^s > (g - 1) 10^-k, so the products differ in length. */
  for (int32_t k = FS_POWER_FIRST; k < 0; k++) {
    fs_power g = fs_powers_of_ten[k - FS_POWER_FIRST], less = {g.high - (g.low == 0), g.low - 1};
    natural upper = from_power(g), lower = from_power(less);
    assert_true(g.high >> 63 == 1);
    for (int32_t i = 0; i < -k; i++) times_ten(&upper), times_ten(&lower);
    assert_int_equal(n_bits(&upper), n_bits(&lower) + 1);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_powers_of_ten),     cmocka_unit_test(test_shortest_reads_back),
      cmocka_unit_test(test_rounded_as_printf), cmocka_unit_test(test_integers),
      cmocka_unit_test(test_locale_is_ignored),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
