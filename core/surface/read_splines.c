/* SPDX-License-Identifier: MIT */
/* Single role: the text format of B-splines (docs/formats/splines.md).

     fairsurf-splines 1
     patch NAME | curve NAME | function NAME
     degree P [Q]
     knots U…          once for each parameter; without: one Bezier piece on [0, 1]
     points            or values: as many as degrees and knots ask for, u fastest, line breaks anywhere            */
#include "surface/spline.h"
#include "mesh/read.h"

#include <stdio.h>
#include <string.h>

enum { MAX_SPLINES = 4096 };

typedef struct parser {
  fs_context *ctx;
  fs_text text;
  fs_splines *splines;
  int32_t room;
} parser;

static fs_status take_name(parser *p, const char *keyword, char name[FS_SPLINE_NAME]) {
  char quote[FS_QUOTE_SIZE];
  fs_word word;
  if (!fs_text_word(&p->text, &word)) return fs_text_fail(&p->text, "a name must follow '%s'", keyword);
  if (word.size >= FS_SPLINE_NAME)
    return fs_text_fail(&p->text, "the name %s has more than %d characters", fs_word_quote(word, quote),
                        FS_SPLINE_NAME - 1);
  memcpy(name, word.at, word.size);
  name[word.size] = '\0';
  if (strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.") != word.size)
    return fs_text_fail(&p->text, "the name %s has characters other than letters, digits, '_', '-' and '.'",
                        fs_word_quote(word, quote));
  if (fs_splines_find(p->splines, name) != NULL)
    return fs_text_fail(&p->text, "a second '%s'; names must differ", name);
  return FS_OK;
}

static fs_status refuse_rest(parser *p, const char *behind) {
  char quote[FS_QUOTE_SIZE];
  fs_word word;
  if (!fs_text_word(&p->text, &word)) return FS_OK;
  return fs_text_fail(&p->text, "%s stands behind %s", fs_word_quote(word, quote), behind);
}

/* "degree 3 3" */
static fs_status take_degree(parser *p, fs_spline *s) {
  fs_word word;
  if (!fs_text_any_word(&p->text, &word) || !fs_word_is(word, "degree"))
    return fs_text_fail(&p->text, "'%s' lacks its line 'degree'", s->name);
  for (int d = 0; d < s->n_parameters; d++) {
    fs_status status;
    if (!fs_text_word(&p->text, &word))
      return fs_text_fail(&p->text, "'%s' needs %d degrees", s->name, (int)s->n_parameters);
    status = fs_text_integer(&p->text, word, &s->degree[d]);
    if (status != FS_OK) return status;
    if (s->degree[d] < 0 || s->degree[d] > FS_MAX_SPLINE_DEGREE)
      return fs_text_fail(&p->text, "'%s' has degree %d, which is not between 0 and %d", s->name, (int)s->degree[d],
                          FS_MAX_SPLINE_DEGREE);
  }
  return refuse_rest(p, "the degrees");
}

/* The numbers of the rest of a line; knots of direction d. */
static fs_status take_knots(parser *p, fs_spline *s, int d) {
  fs_context *ctx = p->ctx;
  fs_status status = FS_OK;
  fs_text counting = p->text;
  fs_word word;
  int64_t n = 0;
  while (fs_text_word(&counting, &word)) n++;
  if (n < 2 * ((int64_t)s->degree[d] + 1) || n > INT32_MAX)
    return fs_text_fail(&p->text, "'%s' has %lld knots here: degree %d needs %d or more", s->name, (long long)n,
                        (int)s->degree[d], 2 * ((int)s->degree[d] + 1));
  FS_ALLOC(ctx, s->knot[d], n);
  for (int64_t i = 0; i < n; i++) {
    fs_text_word(&p->text, &word);
    FS_TRY(fs_text_real(&p->text, word, &s->knot[d][i]));
    if (i > 0 && s->knot[d][i] < s->knot[d][i - 1]) {
      status = fs_text_fail(&p->text, "the knots of '%s' decrease: knot %lld is %g after %g", s->name, (long long)i,
                            s->knot[d][i], s->knot[d][i - 1]);
      goto done;
    }
  }
  s->n[d] = (int32_t)n - s->degree[d] - 1;
done:
  return status;
}

static fs_status set_bezier_knots(parser *p, fs_spline *s, int d) {
  fs_context *ctx = p->ctx;
  fs_status status = FS_OK;
  s->n[d] = s->degree[d] + 1;
  FS_ALLOC(ctx, s->knot[d], 2 * s->n[d]);
  for (int32_t i = 0; i < s->n[d]; i++) s->knot[d][s->n[d] + i] = 1;
done:
  return status;
}

/* "knots …" for each parameter or for none, up to the word that starts the coefficients. */
static fs_status take_all_knots(parser *p, fs_spline *s) {
  const char *start = s->width == 3 ? "points" : "values";
  fs_status status = FS_OK;
  fs_word word;
  int d = 0;
  for (;;) {
    if (!fs_text_any_word(&p->text, &word)) return fs_text_fail(&p->text, "'%s' lacks its '%s'", s->name, start);
    if (fs_word_is(word, start)) break;
    if (!fs_word_is(word, "knots") || d == s->n_parameters) {
      char quote[FS_QUOTE_SIZE];
      return fs_text_fail(&p->text, "%s stands where '%s' of '%s' is needed", fs_word_quote(word, quote),
                          d == s->n_parameters ? start : "knots' or 'points", s->name);
    }
    FS_TRY(take_knots(p, s, d++));
  }
  if (d != 0 && d != s->n_parameters) return fs_text_fail(&p->text, "'%s' has knots for u but not for v", s->name);
  for (int e = 0; e < s->n_parameters && d == 0; e++) FS_TRY(set_bezier_knots(p, s, e));
done:
  return status;
}

static fs_status take_coefficients(parser *p, fs_spline *s) {
  fs_context *ctx = p->ctx;
  fs_status status = FS_OK;
  int64_t n = (int64_t)s->n[0] * s->n[1] * s->width;
  fs_word word;
  if (2 * n > (int64_t)fs_text_rest(&p->text) + 1) /* a number and a space take 2 bytes */
    return fs_text_fail(&p->text, "'%s' needs %lld numbers, more than the %zu bytes that follow hold", s->name,
                        (long long)n, fs_text_rest(&p->text));
  FS_ALLOC(ctx, s->c, n);
  for (int64_t i = 0; i < n; i++) {
    if (!fs_text_any_word(&p->text, &word)) {
      status = fs_text_fail(&p->text, "the file ends within point %lld of '%s'", (long long)(i / s->width), s->name);
      goto done;
    }
    FS_TRY(fs_text_real(&p->text, word, &s->c[i]));
  }
done:
  return status;
}

static void release(fs_context *ctx, fs_spline *s) {
  fs_release(ctx, s->knot[0]);
  fs_release(ctx, s->knot[1]);
  fs_release(ctx, s->c);
}

/* One more spline at the end of the list: a checked copy. */
static fs_status append(parser *p, const fs_spline *s, int64_t line) {
  fs_context *ctx = p->ctx;
  fs_status status = FS_OK;
  fs_spline *larger = NULL;
  if (p->splines->n == p->room) {
    if (p->room >= MAX_SPLINES) return fs_text_fail(&p->text, "the file has more than %d splines", MAX_SPLINES);
    FS_ALLOC(ctx, larger, 2 * p->room + 4);
    if (p->splines->n > 0) memcpy(larger, p->splines->spline, (size_t)p->splines->n * sizeof *larger);
    fs_release(ctx, p->splines->spline);
    p->splines->spline = larger;
    p->room = 2 * p->room + 4;
  }
  status = fs_spline_copy(ctx, s, &p->splines->spline[p->splines->n]);
  if (status == FS_ERR_ARGUMENT) { /* the sentence names the spline; say where it starts */
    char sentence[sizeof ctx->message];
    memcpy(sentence, ctx->message, sizeof sentence);
    return fs_fail(ctx, FS_ERR_FORMAT, "line %lld: %.200s", (long long)line, sentence);
  }
  p->splines->n += status == FS_OK;
done:
  return status;
}

static fs_status take_spline(parser *p, fs_word kind) {
  fs_status status = FS_OK;
  fs_spline s = {.n_parameters = 1, .width = 3, .n = {0, 1}};
  char quote[FS_QUOTE_SIZE];
  int64_t line = p->text.line;
  if (fs_word_is(kind, "patch"))
    s.n_parameters = 2;
  else if (fs_word_is(kind, "function"))
    s.width = 1;
  else if (!fs_word_is(kind, "curve"))
    return fs_text_fail(&p->text, "%s stands where 'patch', 'curve' or 'function' is needed",
                        fs_word_quote(kind, quote));
  FS_TRY(take_name(p, s.n_parameters == 2 ? "patch" : s.width == 1 ? "function" : "curve", s.name));
  FS_TRY(refuse_rest(p, "the name"));
  FS_TRY(take_degree(p, &s));
  FS_TRY(take_all_knots(p, &s));
  FS_TRY(take_coefficients(p, &s));
  FS_TRY(append(p, &s, line));
done:
  release(p->ctx, &s);
  return status;
}

fs_status fs_splines_parse(fs_context *ctx, const char *bytes, size_t size, fs_splines **splines) {
  fs_status status = FS_OK;
  parser p = {.ctx = ctx};
  fs_word word;
  int32_t version = 0;
  FS_TRY(fs_text_open(ctx, bytes, size, &p.text));
  p.text.comment = '#';
  FS_ALLOC(ctx, p.splines, 1);
  if (!fs_text_any_word(&p.text, &word) || !fs_word_is(word, "fairsurf-splines") || !fs_text_word(&p.text, &word)) {
    status = fs_text_fail(&p.text, "the file does not start with 'fairsurf-splines 1'");
    goto done;
  }
  FS_TRY(fs_text_integer(&p.text, word, &version));
  if (version != 1) {
    status = fs_text_fail(&p.text, "version %d of the format is not known; this reads version 1", (int)version);
    goto done;
  }
  while (fs_text_any_word(&p.text, &word)) FS_TRY(take_spline(&p, word));
  if (p.splines->n == 0) {
    status = fs_text_fail(&p.text, "the file has no splines");
    goto done;
  }
  *splines = p.splines;
  p.splines = NULL;
done:
  fs_text_close(&p.text);
  fs_splines_free(ctx, p.splines);
  return status;
}

static fs_status parse(fs_context *ctx, const char *bytes, size_t size, fs_surface **surface) {
  fs_status status = FS_OK;
  fs_splines *splines = NULL;
  const fs_spline **patch = NULL;
  int32_t n = 0;
  FS_TRY(fs_splines_parse(ctx, bytes, size, &splines));
  FS_ALLOC(ctx, patch, splines->n);
  for (int32_t i = 0; i < splines->n; i++)
    if (splines->spline[i].n_parameters == 2) patch[n++] = &splines->spline[i];
  if (n == 0) {
    status = fs_fail(ctx, FS_ERR_FORMAT, "the file has curves or functions but no patch");
    goto done;
  }
  FS_TRY(fs_splines_surface(ctx, n, patch, surface));
done:
  fs_release(ctx, patch);
  fs_splines_free(ctx, splines);
  return status;
}

const fs_surface_reader fs_surface_reader_spl = {"spl", "spl", "B-spline patches, text (docs/formats/splines.md)",
                                                 parse};
