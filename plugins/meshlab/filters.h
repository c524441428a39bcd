/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of filters. Menus, dialogs, scripts of meshlabserver and the manual page are all made from it. */
#ifndef FS_MESHLAB_FILTERS_H
#define FS_MESHLAB_FILTERS_H

#include "layer.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum filter_param_kind {
  PARAM_INTEGER, /* a text field without limits in MeshLab: what is outside the range is refused */
  PARAM_NUMBER,
  PARAM_SLIDER,
  PARAM_SWITCH, /* 0 or 1 */
  PARAM_CHOICE  /* a number into choices */
} filter_param_kind;

/* A parameter of a filter; lists of them end with a NULL name. */
typedef struct filter_param {
  const char *name; /* in scripts */
  filter_param_kind kind;
  double initial, min, max;
  const char *label, *help;
  const char *(*choice)(int32_t number); /* of choices: NULL past the last one */
  const char *const *choices;            /* or, instead of choice: their names, ended by NULL */
} filter_param;

/* The name of a choice, or NULL past the last one. */
const char *param_choice(const filter_param *p, int32_t number);
/* Whether the values lie in their ranges: FS_ERR_ARGUMENT names one that does not. */
fs_status params_check(fs_context *ctx, const filter_param *params, const double *value);

typedef enum filter_menu { MENU_REFINE, MENU_FAIR, MENU_CURVATURE } filter_menu;

enum { MAX_FILTER_PARAMS = 16 };
typedef struct filter {
  const char *name;        /* in menus and scripts */
  const char *python_name; /* unique, in PyMeshLab */
  const char *help;        /* HTML as MeshLab shows it */
  filter_menu menu;
  bool only_colours; /* quality and colours change and nothing else: MeshLab then offers a preview */
  const filter_param *params;
  /* param: values in the order of params. On failure the message of the context says why. */
  fs_status (*run)(fs_context *ctx, const layer *l, const double *param, outcome *o);
} filter;
extern const filter *const filters[]; /* ends with NULL */
extern const filter filter_refine, filter_fair, filter_patches, filter_curvature, filter_fill_hole;

/* Checks the values against their ranges and runs the filter; o stays as it is unless that succeeds. */
fs_status filter_run(fs_context *ctx, const filter *f, const layer *l, const double *param, outcome *o);

/* The same parameter in several filters. */
#define PARAM_NEW_LAYER                                                                                           \
  {                                                                                                               \
    "new_layer", PARAM_SWITCH, 1, 0, 1, "Put the result into a new layer",                                        \
        "MeshLab has no undo: in a new layer the mesh stays as it was. Otherwise the current layer is replaced.", \
        NULL, NULL                                                                                                \
  }
#define PARAM_COLOUR                                                                                               \
  {                                                                                                                \
    "colour", PARAM_CHOICE, 0, 0, 0, "Colour", "A measure of the surface as quality and colours of its vertices.", \
        colour_choice, NULL                                                                                        \
  }
#define PARAM_DENSITY                                                                                                  \
  {                                                                                                                    \
    "tolerance", PARAM_SLIDER, 0.05, 0.001, 2, "Tolerance of the resulting mesh (% of the diagonal)",                  \
        "The surface becomes a mesh of quadrilaterals, so fine that it deviates by at most this part of the diagonal " \
        "of its box.",                                                                                                 \
        NULL, NULL                                                                                                     \
  }
const char *colour_choice(int32_t number); /* none, then the measures of the library */

#ifdef __cplusplus
}
#endif
#endif
