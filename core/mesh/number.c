/* SPDX-License-Identifier: MIT */
/* Single role: numbers of a text, exact to the last bit. A decimal m 10^e with integers m <= 2^53 and |e| <= 22 is one
   multiplication or division of exact doubles, so it is rounded once [Clinger 1990]; strtod does the others. */
#include "mesh/read.h"

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_digit(char c) { return c >= '0' && c <= '9'; }

/* Parts of [+-] digits [. digits] [e [+-] digits]. */
typedef struct decimal {
  bool is_negative;
  uint64_t mantissa; /* above 2^53 where it lacks digits */
  int64_t exponent;  /* value = mantissa 10^exponent */
} decimal;

static void add_digit(decimal *d, char c, bool is_fraction) {
  if (d->mantissa > (UINT64_MAX - 9) / 10) return;
  d->mantissa = 10 * d->mantissa + (uint64_t)(c - '0');
  d->exponent -= is_fraction;
}

/* Reads the digits after e; false where they are missing. */
static bool scan_exponent(const char *p, const char *end, decimal *d) {
  bool is_negative = p < end && *p == '-';
  int64_t exponent = 0;
  if (p < end && (*p == '-' || *p == '+')) p++;
  if (p == end) return false;
  for (; p < end; p++) {
    if (!is_digit(*p)) return false;
    if (exponent < INT32_MAX) exponent = 10 * exponent + (*p - '0'); /* larger ones are for strtod */
  }
  d->exponent += is_negative ? -exponent : exponent;
  return true;
}

static bool scan_decimal(fs_word word, decimal *d) {
  const char *p = word.at, *end = word.at + word.size;
  bool is_fraction = false;
  int64_t n_digits = 0;
  *d = (decimal){0};
  if (p < end && (*p == '-' || *p == '+')) d->is_negative = *p++ == '-';
  for (; p < end && (is_digit(*p) || (*p == '.' && !is_fraction)); p++) {
    if (*p == '.') {
      is_fraction = true;
    } else {
      add_digit(d, *p, is_fraction);
      n_digits++;
    }
  }
  if (n_digits == 0) return false;
  if (p == end) return true;
  return (*p == 'e' || *p == 'E') && scan_exponent(p + 1, end, d);
}

static bool is_fast(const decimal *d) {
  return FLT_EVAL_METHOD == 0 && d->mantissa <= UINT64_C(1) << 53 && d->exponent >= -22 && d->exponent <= 22;
}

static double fast_value(const decimal *d) {
  static const double power[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  double x = (double)d->mantissa;
  x = d->exponent < 0 ? x / power[-d->exponent] : x * power[d->exponent];
  return d->is_negative ? -x : x;
}

/* Words like nan, -inf and infinity, to say more than "not a number". */
static bool names_no_finite(fs_word word) {
  char c;
  if (word.size > 1 && (*word.at == '-' || *word.at == '+')) word = (fs_word){word.at + 1, word.size - 1};
  c = word.size >= 3 ? (char)(*word.at | 0x20) : ' ';
  return (c == 'n' && (word.at[1] | 0x20) == 'a') || (c == 'i' && (word.at[1] | 0x20) == 'n');
}

fs_status fs_text_real(fs_text *text, fs_word word, double *x) {
  enum { MOST = 1000 };
  char copy[MOST + 1], quote[FS_QUOTE_SIZE];
  decimal d;
  double value;
  if (!scan_decimal(word, &d))
    return fs_text_fail(text, "%s is not a %snumber", fs_word_quote(word, quote),
                        names_no_finite(word) ? "finite " : "");
  if (is_fast(&d)) {
    *x = fast_value(&d);
    return FS_OK;
  }
  if (word.size > MOST) return fs_text_fail(text, "a number has more than %d characters", MOST);
  memcpy(copy, word.at, word.size);
  copy[word.size] = '\0';
  value = strtod_l(copy, NULL, text->c_locale);
  if (!isfinite(value)) return fs_text_fail(text, "%s is too large for a number", fs_word_quote(word, quote));
  *x = value;
  return FS_OK;
}

fs_status fs_text_integer(fs_text *text, fs_word word, int32_t *i) {
  char quote[FS_QUOTE_SIZE];
  const char *p = word.at, *end = word.at + word.size;
  int64_t value = 0;
  if (p < end && (*p == '-' || *p == '+')) p++;
  if (p == end) return fs_text_fail(text, "%s is not an integer", fs_word_quote(word, quote));
  for (; p < end; p++) {
    if (!is_digit(*p)) return fs_text_fail(text, "%s is not an integer", fs_word_quote(word, quote));
    if (value <= INT32_MAX) value = 10 * value + (*p - '0');
  }
  if (value > INT32_MAX)
    return fs_text_fail(text, "the integer %s needs more than 32 bits", fs_word_quote(word, quote));
  *i = (int32_t)(*word.at == '-' ? -value : value);
  return FS_OK;
}
