/* SPDX-License-Identifier: MIT */
/* Single role: the options of constraints. */
#include "constraints.h"

#include <argp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_FIX_BOX = 3000, KEY_FIX_PLANE, KEY_POINTS, KEY_EQUATIONS, KEY_SYMMETRY, KEY_WITHIN, KEY_NEAR, KEY_KEEP };

bool read_numbers(const char *text, int count, double *number) {
  char *end;
  for (int i = 0; i < count; i++) {
    number[i] = strtod(text, &end);
    if (end == text || !isfinite(number[i]) || *end != (i + 1 < count ? ',' : '\0')) return false;
    text = end + 1;
  }
  return true;
}

static void add_region(struct argp_state *state, constraint_arguments *a, const char *option, const char *text,
                       bool is_box) {
  region r = {.is_box = is_box};
  if (a->n_regions == MAX_REGIONS) argp_error(state, "more than %d boxes and planes", MAX_REGIONS);
  if (!read_numbers(text, is_box ? 6 : 4, r.number))
    argp_error(state, "--%s %s: %s are needed, with commas between them", option, text,
               is_box ? "six numbers x0,y0,z0,x1,y1,z1" : "four numbers a,b,c,d of the plane a x + b y + c z = d");
  if (!is_box && r.number[0] == 0 && r.number[1] == 0 && r.number[2] == 0)
    argp_error(state, "--%s %s: a, b and c must not all be 0", option, text);
  a->region[a->n_regions++] = r;
}

static void set_symmetry(struct argp_state *state, constraint_arguments *a, const char *text) {
  static const char axes[] = "xyz";
  a->is_symmetric = true;
  a->is_plane_given = true;
  memset(a->plane, 0, sizeof a->plane);
  if (strcmp(text, "find") == 0)
    a->is_plane_given = false;
  else if (strlen(text) == 1 && strchr(axes, text[0]) != NULL)
    a->plane[strchr(axes, text[0]) - axes] = 1;
  else if (!read_numbers(text, 4, a->plane) || (a->plane[0] == 0 && a->plane[1] == 0 && a->plane[2] == 0))
    argp_error(state, "--symmetry %s: x, y, z, find or the numbers a,b,c,d of the plane a x + b y + c z = d are needed",
               text);
}

static error_t parse(int key, char *text, struct argp_state *state) {
  constraint_arguments *a = state->input;
  switch (key) {
  case KEY_FIX_BOX:
    add_region(state, a, "fix-box", text, true);
    break;
  case KEY_FIX_PLANE:
    add_region(state, a, "fix-plane", text, false);
    break;
  case KEY_POINTS:
    a->points = text;
    break;
  case KEY_EQUATIONS:
    a->equations = text;
    break;
  case KEY_SYMMETRY:
    set_symmetry(state, a, text);
    break;
  case KEY_WITHIN:
    if (!read_numbers(text, 1, &a->stay_within) || !(a->stay_within > 0))
      argp_error(state, "--stay-within %s: a distance above 0 is needed", text);
    break;
  case KEY_NEAR:
    a->stay_near = text;
    break;
  case KEY_KEEP:
    if (text == NULL || (strcmp(text, "area") != 0 && strcmp(text, "volume") != 0)) {
      argp_error(state, "--keep %s: choose one of area, volume", text != NULL ? text : "");
      break;
    }
    a->keep = strcmp(text, "area") == 0 ? FS_KEEP_AREA : FS_KEEP_VOLUME;
    break;
  case ARGP_KEY_END:
    if (a->stay_near != NULL && a->stay_within == 0)
      argp_error(state, "--stay-near %s: how near is said by --stay-within", a->stay_near);
    break;
  default:
    return ARGP_ERR_UNKNOWN;
  }
  return 0;
}

static const struct argp_option options[] = {
    {"fix-box", KEY_FIX_BOX, "X0,Y0,Z0,X1,Y1,Z1", 0, "vertices of the net in this box stay; may be given often", 0},
    {"fix-plane", KEY_FIX_PLANE, "A,B,C,D", 0, "vertices on the plane A x + B y + C z = D stay; may be given often", 0},
    {"points", KEY_POINTS, "FILE", 0, "points of the surface that are held, and tangent planes; docs/constraints.md",
     0},
    {"equations", KEY_EQUATIONS, "FILE", 0, "linear equations between vertices; docs/constraints.md", 0},
    {"symmetry", KEY_SYMMETRY, "PLANE", 0, "mirror symmetry that stays exact: x, y, z (= 0), A,B,C,D, or find", 0},
    {"stay-within", KEY_WITHIN, "DISTANCE", 0, "no point of the surface is farther than this from the start", 0},
    {"stay-near", KEY_NEAR, "MESH", 0, "not from the start, but from the polygons of MESH", 0},
    {"keep", KEY_KEEP, "WHAT", 0, "of closed surfaces: area (the default) or volume", 0},
    {0}};

const struct argp constraint_argp = {.options = options, .parser = parse};
