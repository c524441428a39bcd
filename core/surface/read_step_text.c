/* SPDX-License-Identifier: MIT */
/* Single role: the exchange structure of STEP files [ISO 10303-21:2002]: entities by their numbers, and their parameters.
   Strings and comments are stepped over; only what is asked for is read. */
#include "surface/read_step.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

fs_status fs_step_fail(const fs_step_model *model, const char *at, fs_status status, const char *format, ...) {
  char sentence[224];
  int64_t line = 1;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(sentence, sizeof sentence, format, arguments);
  va_end(arguments);
  for (const char *p = model->bytes; p < at; p++) line += *p == '\n';
  return fs_fail(model->ctx, status, "line %lld: %s", (long long)line, sentence);
}

static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }
static bool is_digit(char c) { return c >= '0' && c <= '9'; }
static bool is_word(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || is_digit(c) || c == '_'; }

/* Past spaces and comments. */
static const char *skip_space(const char *at, const char *end) {
  while (at < end) {
    if (is_space(*at)) {
      at++;
    } else if (end - at >= 2 && at[0] == '/' && at[1] == '*') {
      at += 2;
      while (end - at >= 2 && !(at[0] == '*' && at[1] == '/')) at++;
      at = end - at >= 2 ? at + 2 : end;
    } else {
      break;
    }
  }
  return at;
}

/* Past one token: a string, a comment, or a character. */
static const char *skip_token(const char *at, const char *end) {
  const char *behind = skip_space(at, end);
  if (behind > at) return behind;
  if (*at != '\'') return at + 1;
  for (at++; at < end; at++) /* two apostrophes stand for one, and look like two strings */
    if (*at == '\'') return at + 1;
  return end;
}

static int compare_entities(const void *a, const void *b) {
  const fs_step_record *p = a, *q = b;
  return p->id < q->id ? -1 : p->id > q->id;
}

/* "#id =" at a place: the number, and what is behind the sign. */
static bool take_head(const char **at, const char *end, int64_t *id) {
  const char *p = *at + 1;
  *id = 0;
  if (p == end || !is_digit(*p)) return false;
  for (; p < end && is_digit(*p); p++) {
    if (*id > INT64_MAX / 10 - 1) return false;
    *id = 10 * *id + (*p - '0');
  }
  p = skip_space(p, end);
  if (p == end || *p != '=') return false;
  *at = skip_space(p + 1, end);
  return true;
}

/* The entities of all data sections, in the order of the file; list NULL: only their number. */
static int64_t list_entities(const char *bytes, const char *end, fs_step_record *list) {
  int64_t n = 0;
  bool is_start = true; /* of a statement */
  for (const char *at = bytes; at < end;) {
    const char *next = skip_space(at, end);
    fs_step_record e;
    if (next > at) {
      at = next;
      continue;
    }
    if (is_start && *at == '#' && take_head(&at, end, &e.id)) {
      e.at = at;
      while (at < end && *at != ';') at = skip_token(at, end);
      e.end = at;
      if (list != NULL) list[n] = e;
      n++;
    }
    if (at >= end) break;
    is_start = *at == ';';
    at = skip_token(at, end);
  }
  return n;
}

fs_status fs_step_model_create(fs_context *ctx, const char *bytes, size_t size, fs_step_model *model) {
  static const char keyword[] = "ISO-10303-21;";
  fs_step_model m = {.ctx = ctx, .bytes = bytes};
  const char *end = bytes + size, *start = skip_space(bytes, end);
  int64_t n;
  fs_status status = FS_OK;
  if ((size_t)(end - start) < sizeof keyword || memcmp(start, keyword, sizeof keyword - 1) != 0)
    return fs_fail(ctx, FS_ERR_FORMAT, "line 1: the file does not begin with %s", keyword);
  n = list_entities(bytes, end, NULL);
  if (n > INT32_MAX) return fs_fail(ctx, FS_ERR_FORMAT, "%lld entities are too many to number", (long long)n);
  m.c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (m.c_locale == (locale_t)0) return fs_fail(ctx, FS_ERR_MEMORY, "out of memory: no room for a locale");
  FS_ALLOC(ctx, m.entity, n);
  m.n = (int32_t)n;
  list_entities(bytes, end, m.entity);
  if (n > 1) qsort(m.entity, (size_t)n, sizeof *m.entity, compare_entities);
  for (int32_t i = 1; i < m.n; i++)
    if (m.entity[i].id == m.entity[i - 1].id) {
      status = fs_step_fail(&m, m.entity[i].at, FS_ERR_FORMAT, "a second entity #%lld", (long long)m.entity[i].id);
      goto done;
    }
  *model = m;
  return FS_OK;
done:
  fs_step_model_clear(&m);
  return status;
}

void fs_step_model_clear(fs_step_model *model) {
  if (model->ctx == NULL) return;
  if (model->c_locale != (locale_t)0) freelocale(model->c_locale);
  fs_release(model->ctx, model->entity);
  *model = (fs_step_model){0};
}

const fs_step_record *fs_step_find(const fs_step_model *model, int64_t id) {
  fs_step_record key = {id, NULL, NULL};
  return bsearch(&key, model->entity, (size_t)model->n, sizeof key, compare_entities);
}

/* ---- types ---- */

/* The word at a place followed by a parenthesis, behind which at is moved. */
static size_t take_type(const char **at, const char *end, const char **word) {
  const char *p = *at, *behind;
  size_t size;
  while (p < end && is_word(*p)) p++;
  size = (size_t)(p - *at);
  behind = skip_space(p, end);
  if (size == 0 || behind == end || *behind != '(') return 0;
  *word = *at;
  *at = behind + 1;
  return size;
}

/* Past the parameters and their closing parenthesis. */
static const char *skip_parameters(const char *at, const char *end) {
  for (int64_t depth = 1; at < end && depth > 0; at = skip_token(at, end)) depth += (*at == '(') - (*at == ')');
  return at;
}

bool fs_step_has_type(const fs_step_model *model, const fs_step_record *entity, const char *type, const char **at) {
  const char *p = entity->at, *end = entity->end, *word;
  size_t size;
  bool is_several = p < end && *p == '(';
  (void)model;
  if (is_several) p = skip_space(p + 1, end);
  while ((size = take_type(&p, end, &word)) > 0) {
    if (size == strlen(type) && memcmp(word, type, size) == 0) {
      *at = skip_space(p, end);
      return true;
    }
    if (!is_several) return false;
    p = skip_space(skip_parameters(p, end), end);
  }
  return false;
}

void fs_step_name_type(const fs_step_record *entity, char type[40]) {
  const char *p = entity->at, *end = entity->end, *word;
  size_t size;
  if (p < end && *p == '(') p = skip_space(p + 1, end);
  size = take_type(&p, end, &word);
  if (size == 0)
    snprintf(type, 40, "nothing known");
  else
    snprintf(type, 40, "%.*s", (int)(size < 39 ? size : 39), word);
}

fs_status fs_step_open(const fs_step_model *model, const fs_step_record *entity, const char *type,
                       fs_step_cursor *cursor) {
  char found[40];
  const char *at;
  if (fs_step_has_type(model, entity, type, &at)) {
    *cursor = (fs_step_cursor){model, entity, at};
    return FS_OK;
  }
  fs_step_name_type(entity, found);
  return fs_step_fail(model, entity->at, FS_ERR_FORMAT, "#%lld is %s where %s is needed", (long long)entity->id, found,
                      type);
}

/* ---- parameters ---- */

static fs_status fail(const fs_step_cursor *c, const char *what) {
  return fs_step_fail(c->model, c->at, FS_ERR_FORMAT, "#%lld has no %s where one is needed", (long long)c->entity->id,
                      what);
}

/* Past the comma, if there is one. */
static void step_on(fs_step_cursor *c, const char *at) {
  at = skip_space(at, c->entity->end);
  if (at < c->entity->end && *at == ',') at = skip_space(at + 1, c->entity->end);
  c->at = at;
}

fs_status fs_step_skip(fs_step_cursor *c) {
  const char *end = c->entity->end, *at = c->at;
  if (at >= end || *at == ')' || *at == ',') return fail(c, "parameter");
  while (at < end && *at != ',' && *at != ')') at = *at == '(' ? skip_parameters(at + 1, end) : skip_token(at, end);
  step_on(c, at);
  return FS_OK;
}

fs_status fs_step_take_reference(fs_step_cursor *c, const fs_step_record **entity) {
  const char *at = c->at, *end = c->entity->end;
  int64_t id = 0;
  if (at >= end || *at != '#') return fail(c, "reference");
  for (at++; at < end && is_digit(*at) && id < INT64_MAX / 10 - 1; at++) id = 10 * id + (*at - '0');
  *entity = fs_step_find(c->model, id);
  if (*entity == NULL)
    return fs_step_fail(c->model, c->at, FS_ERR_FORMAT, "#%lld refers to #%lld, which is not there",
                        (long long)c->entity->id, (long long)id);
  step_on(c, at);
  return FS_OK;
}

/* The characters of a number. */
static size_t number_size(const fs_step_cursor *c) {
  size_t n = 0, room = (size_t)(c->entity->end - c->at);
  while (n < room && (is_digit(c->at[n]) || strchr("+-.eE", c->at[n]) != NULL) && c->at[n] != '\0') n++;
  return n;
}

fs_status fs_step_take_real(fs_step_cursor *c, double *x) {
  fs_text text = {.ctx = c->model->ctx, .at = c->at, .end = c->entity->end, .c_locale = c->model->c_locale};
  fs_word word = {c->at, number_size(c)};
  double value;
  if (word.size == 0 || fs_text_real(&text, word, &value) != FS_OK) return fail(c, "finite number");
  *x = value;
  step_on(c, c->at + word.size);
  return FS_OK;
}

fs_status fs_step_take_integer(fs_step_cursor *c, int32_t *i) {
  fs_text text = {.ctx = c->model->ctx, .at = c->at, .end = c->entity->end, .c_locale = c->model->c_locale};
  fs_word word = {c->at, number_size(c)};
  int32_t value;
  if (word.size == 0 || fs_text_integer(&text, word, &value) != FS_OK) return fail(c, "integer");
  *i = value;
  step_on(c, c->at + word.size);
  return FS_OK;
}

fs_status fs_step_take_logical(fs_step_cursor *c, bool *is_true) {
  if (c->entity->end - c->at < 3 || c->at[0] != '.' || c->at[2] != '.' || strchr("TFU", c->at[1]) == NULL)
    return fail(c, "logical value");
  *is_true = c->at[1] == 'T';
  step_on(c, c->at + 3);
  return FS_OK;
}

fs_status fs_step_enter(fs_step_cursor *c) {
  if (c->at >= c->entity->end || *c->at != '(') return fail(c, "list");
  c->at = skip_space(c->at + 1, c->entity->end);
  return FS_OK;
}

bool fs_step_leave(fs_step_cursor *c) {
  if (c->at < c->entity->end && *c->at != ')') return false;
  step_on(c, c->at < c->entity->end ? c->at + 1 : c->at);
  return true;
}
