/* SPDX-License-Identifier: MIT */
/* Single role: files of points that are held, and of equations between vertices [docs/constraints.md]. # starts a comment.

     X Y Z [normal [NX NY NZ]]                      the nearest point of the start comes to (X, Y, Z)
     stay X Y Z [normal [NX NY NZ]]                 the nearest point of the start stays where it is
     near X Y Z normal [NX NY NZ]                   the tangent plane there, the point moves in any way
     face F U V [at X Y Z] [normal [NX NY NZ]]      the point at (U, V) of face F: it comes to (X, Y, Z), or has the tangent
                                                    plane, or both; or stays where it is
   normal alone: that of the start.

     [x: | y: | z: | A,B,C:] TERM [+ TERM | - TERM] ... = VALUE [VALUE VALUE]       TERM: [WEIGHT *] VERTEX          */
#include "constraints.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_SIZE = 64 };

/* A file that is read line by line. */
typedef struct lines {
  fs_context *ctx;
  const char *path;
  char *bytes, *next;
  int32_t number, n_lines;
} lines;

static fs_status complain(const lines *l, const char *what) {
  snprintf(l->ctx->message, sizeof l->ctx->message, "%s, line %d: %s", l->path, l->number, what);
  return FS_ERR_FORMAT;
}

static fs_status lines_open(fs_context *ctx, const char *path, lines *l) {
  size_t size = 0;
  fs_status status;
  *l = (lines){.ctx = ctx, .path = path};
  status = fs_file_read(ctx, path, &l->bytes, &size);
  if (status != FS_OK) return status;
  l->next = l->bytes;
  for (size_t i = 0; i <= size; i++) l->n_lines += l->bytes[i] == '\n' || i == size;
  return FS_OK;
}

/* The next line that says something, without its comment; NULL: none. */
static char *lines_next(lines *l) {
  while (l->next != NULL) {
    char *text = l->next, *newline = strchr(text, '\n'), *hash;
    l->next = newline != NULL ? newline + 1 : NULL;
    l->number++;
    if (newline != NULL) *newline = '\0';
    hash = strchr(text, '#');
    if (hash != NULL) *hash = '\0';
    text += strspn(text, " \t\r");
    if (*text != '\0') return text;
  }
  return NULL;
}

static char *set_name(const lines *l, constraint_set *set, int32_t index) {
  char *name = set->names + (size_t)NAME_SIZE * (size_t)index;
  const char *file = strrchr(l->path, '/');
  snprintf(name, NAME_SIZE, "%.40s, line %d", file != NULL ? file + 1 : l->path, l->number);
  return name;
}

/* Names for n more holds or equations; those that are there move. */
static fs_status grow_names(fs_context *ctx, constraint_set *set, int32_t n) {
  int32_t n_old = set->constraints.n_holds + set->constraints.n_equations;
  char *names = calloc((size_t)n_old + (size_t)n, NAME_SIZE);
  if (names == NULL) {
    snprintf(ctx->message, sizeof ctx->message, "out of memory for %d constraints", n);
    return FS_ERR_MEMORY;
  }
  if (n_old > 0) memcpy(names, set->names, (size_t)n_old * NAME_SIZE);
  free(set->names);
  set->names = names;
  for (int32_t i = 0; i < set->constraints.n_holds; i++) set->hold[i].name = names + (size_t)NAME_SIZE * (size_t)i;
  return FS_OK;
}

/* ---- points ------------------------------------------------------------------------------------------------------ */

static bool take_word(char **text, const char *word) {
  size_t n = strlen(word);
  if (strncmp(*text, word, n) != 0 || ((*text)[n] != '\0' && strchr(" \t\r", (*text)[n]) == NULL)) return false;
  *text += n;
  *text += strspn(*text, " \t\r");
  return true;
}

static bool take_number(char **text, double *number) {
  char *end;
  *number = strtod(*text, &end);
  if (end == *text || !isfinite(*number) || (*end != '\0' && strchr(" \t\r", *end) == NULL)) return false;
  *text = end + strspn(end, " \t\r");
  return true;
}

static bool take_point(char **text, fs_vec3 *p) {
  return take_number(text, &p->x) && take_number(text, &p->y) && take_number(text, &p->z);
}

static fs_status take_normal(const lines *l, char **text, const constraint_set *set, fs_hold *h) {
  fs_vec3 x[FS_JET_SIZE];
  if (!take_word(text, "normal")) return FS_OK;
  h->has_normal = true;
  if (**text != '\0')
    return take_point(text, &h->normal) ? FS_OK : complain(l, "three numbers are needed after normal");
  fs_surface_evaluate(set->start, h->element, h->u, h->v, x);
  h->normal =
      (fs_vec3){x[FS_DU].y * x[FS_DV].z - x[FS_DU].z * x[FS_DV].y, x[FS_DU].z * x[FS_DV].x - x[FS_DU].x * x[FS_DV].z,
                x[FS_DU].x * x[FS_DV].y - x[FS_DU].y * x[FS_DV].x};
  return FS_OK;
}

static fs_status read_face(const lines *l, char **text, const fs_space *space, bool is_refined,
                           const constraint_set *set, fs_hold *h) {
  double face;
  fs_vec3 x[FS_JET_SIZE];
  if (is_refined)
    return complain(l, "the mesh is refined first, so that its faces have other numbers: use fairsurf refine");
  if (!take_number(text, &face) || !take_number(text, &h->u) || !take_number(text, &h->v))
    return complain(l, "a face and two parameters are needed after face");
  h->element = -1;
  for (int32_t e = 0; e < space->n_elements; e++)
    if (space->element[e].face == face) h->element = e;
  if (h->element < 0) return complain(l, "this face carries no patch");
  if (!(h->u >= 0 && h->u <= 1 && h->v >= 0 && h->v <= 1)) return complain(l, "parameters are between 0 and 1");
  h->has_position = take_word(text, "at");
  if (h->has_position && !take_point(text, &h->position)) return complain(l, "three numbers are needed after at");
  if (h->has_position || strncmp(*text, "normal", 6) == 0) return FS_OK;
  fs_surface_evaluate(set->start, h->element, h->u, h->v, x);
  h->has_position = true;
  h->position = x[FS_D];
  return FS_OK;
}

/* Sides and corners are meant where a parameter comes so near to them: there the neighbours see the same. */
static double snap(double t) { return t < 1e-6 ? 0 : t > 1 - 1e-6 ? 1 : t; }

static fs_status read_hold(const lines *l, char *text, const fs_space *space, bool is_refined,
                           const constraint_set *set, fs_hold *h) {
  fs_status status;
  if (take_word(&text, "face")) {
    status = read_face(l, &text, space, is_refined, set, h);
    if (status != FS_OK) return status;
  } else {
    bool stays = take_word(&text, "stay"), is_free = !stays && take_word(&text, "near");
    fs_vec3 p;
    fs_near near;
    if (!take_point(&text, &p)) return complain(l, "three coordinates, or one of stay, near, face are needed");
    fs_nearest_find(set->nearest, p, &near);
    h->element = near.patch, h->u = snap(near.u), h->v = snap(near.v);
    h->has_position = !is_free;
    h->position = p;
    if (stays) {
      fs_vec3 x[FS_JET_SIZE];
      fs_surface_evaluate(set->start, h->element, h->u, h->v, x);
      h->position = x[FS_D];
    }
    if (is_free && strncmp(text, "normal", 6) != 0) return complain(l, "near is for tangent planes: normal is needed");
  }
  status = take_normal(l, &text, set, h);
  if (status == FS_OK && *text != '\0') return complain(l, "there is something more than a point and a normal");
  return status;
}

fs_status read_points(fs_context *ctx, const char *path, const fs_space *space, bool is_refined, constraint_set *set) {
  lines l;
  char *text;
  fs_status status = lines_open(ctx, path, &l);
  if (status != FS_OK) return status;
  set->hold = calloc((size_t)l.n_lines, sizeof *set->hold);
  status = grow_names(ctx, set, l.n_lines);
  if (set->hold == NULL) status = FS_ERR_MEMORY;
  while (status == FS_OK && (text = lines_next(&l)) != NULL) {
    fs_hold *h = &set->hold[set->constraints.n_holds];
    h->name = set_name(&l, set, set->constraints.n_holds);
    status = read_hold(&l, text, space, is_refined, set, h);
    if (status == FS_OK) set->constraints.n_holds++;
  }
  set->constraints.hold = set->hold;
  fs_file_free(ctx, l.bytes);
  return status;
}

/* ---- equations --------------------------------------------------------------------------------------------------- */

static void skip(char **text) { *text += strspn(*text, " \t\r"); }

static fs_status read_direction(const lines *l, char **text, fs_equation *q) {
  static const char axes[] = "xyz";
  char *colon = strchr(*text, ':');
  double number[3] = {0, 0, 0};
  if (colon == NULL) return FS_OK;
  *colon = '\0';
  if (strlen(*text) == 1 && strchr(axes, (*text)[0]) != NULL)
    number[strchr(axes, (*text)[0]) - axes] = 1;
  else if (!read_numbers(*text, 3, number) || (number[0] == 0 && number[1] == 0 && number[2] == 0))
    return complain(l, "x, y, z or three numbers A,B,C are needed before the colon");
  q->direction = (fs_vec3){number[0], number[1], number[2]};
  *text = colon + 1;
  return FS_OK;
}

/* One term: [WEIGHT *] VERTEX, after its sign. */
static fs_status read_term(const lines *l, char **text, const fs_space *space, int32_t *dof, double *weight) {
  char *end;
  double number = strtod(*text, &end), vertex;
  if (end == *text) return complain(l, "a vertex, or a weight, * and a vertex are needed");
  *text = end;
  skip(text);
  vertex = number;
  if (**text == '*') {
    ++*text;
    *weight *= number;
    vertex = strtod(*text, &end);
    if (end == *text) return complain(l, "a vertex is needed after *");
    *text = end;
    skip(text);
  }
  if (!(vertex >= 0 && vertex < space->n_vertices) || vertex != floor(vertex)) {
    char what[100];
    snprintf(what, sizeof what, "vertex %g, but the net has the vertices 0 to %d", vertex, space->n_vertices - 1);
    return complain(l, what);
  }
  *dof = (int32_t)vertex;
  return FS_OK;
}

static fs_status read_equation(const lines *l, char *text, const fs_space *space, int32_t *dof, double *weight,
                               fs_equation *q) {
  fs_status status = read_direction(l, &text, q);
  bool is_along = q->direction.x != 0 || q->direction.y != 0 || q->direction.z != 0;
  for (bool is_first = true; status == FS_OK; is_first = false) {
    skip(&text);
    if (*text == '=' && !is_first) break;
    weight[q->n_terms] = *text == '-' ? -1 : 1;
    if (*text == '+' || *text == '-')
      text++;
    else if (!is_first)
      return complain(l, "+, - or = is needed between terms");
    status = read_term(l, &text, space, &dof[q->n_terms], &weight[q->n_terms]);
    q->n_terms++;
  }
  if (status != FS_OK) return status;
  text++;
  skip(&text);
  if (!(is_along ? take_number(&text, &q->value.x) : take_point(&text, &q->value)) || *text != '\0')
    return complain(l, is_along ? "one number is needed after =" : "three numbers are needed after =");
  q->dof = dof;
  q->weight = weight;
  return FS_OK;
}

fs_status read_equations(fs_context *ctx, const char *path, const fs_space *space, bool is_refined,
                         constraint_set *set) {
  lines l;
  char *text;
  size_t n_terms = 0, used = 0;
  fs_status status = lines_open(ctx, path, &l);
  if (status != FS_OK) return status;
  for (const char *p = l.bytes; *p != '\0'; p++) n_terms += *p == '+' || *p == '-' || *p == '\n';
  n_terms += 2;
  set->equation = calloc((size_t)l.n_lines, sizeof *set->equation);
  set->dof = calloc(n_terms, sizeof *set->dof);
  set->weight = calloc(n_terms, sizeof *set->weight);
  status = grow_names(ctx, set, l.n_lines);
  if (set->equation == NULL || set->dof == NULL || set->weight == NULL) status = FS_ERR_MEMORY;
  while (status == FS_OK && (text = lines_next(&l)) != NULL) {
    fs_equation *q = &set->equation[set->constraints.n_equations];
    if (is_refined) {
      status = complain(&l, "the mesh is refined first, so that its vertices have other numbers: use fairsurf refine");
      break;
    }
    q->name = set_name(&l, set, set->constraints.n_holds + set->constraints.n_equations);
    status = read_equation(&l, text, space, set->dof + used, set->weight + used, q);
    used += (size_t)q->n_terms;
    if (status == FS_OK) set->constraints.n_equations++;
  }
  set->constraints.equation = set->equation;
  fs_file_free(ctx, l.bytes);
  return status;
}
