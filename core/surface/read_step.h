/* SPDX-License-Identifier: MIT */
/* What the files that read STEP share: the entities of an exchange structure, and a cursor in their parameters. */
#ifndef FS_SURFACE_READ_STEP_H
#define FS_SURFACE_READ_STEP_H

#include "mesh/read.h"
#include "surface/spline.h"

/* "#id=NAME(parameters);", or for an entity of several types "#id=(NAME1(…)NAME2(…));". */
typedef struct fs_step_record {
  int64_t id;
  const char *at, *end; /* of what stands behind the =, up to the ; */
} fs_step_record;

typedef struct fs_step_model {
  fs_context *ctx;
  const char *bytes;
  int32_t n;
  fs_step_record *entity; /* [n] ascending ids */
  locale_t c_locale;      /* numbers have a decimal point whatever the locale of the program */
} fs_step_model;

fs_status fs_step_model_create(fs_context *ctx, const char *bytes, size_t size, fs_step_model *model);
void fs_step_model_clear(fs_step_model *model); /* all zero is allowed */

/* FS_ERR_FORMAT, or another status, with the line of a place in the bytes, "line 12: ". */
fs_status fs_step_fail(const fs_step_model *model, const char *at, fs_status status, const char *format, ...)
    FS_PRINTF(4, 5);

const fs_step_record *fs_step_find(const fs_step_model *model, int64_t id); /* NULL: there is none */

/* Whether an entity has that type, alone or among several. at: where its parameters start, behind the parenthesis. */
bool fs_step_has_type(const fs_step_model *model, const fs_step_record *entity, const char *type, const char **at);
/* The type of an entity, or the first of several, for messages: type[40]. */
void fs_step_name_type(const fs_step_record *entity, char type[40]);

/* A place among the parameters of an entity. Each function moves it behind what it takes and the comma that follows. */
typedef struct fs_step_cursor {
  const fs_step_model *model;
  const fs_step_record *entity;
  const char *at;
} fs_step_cursor;
fs_status fs_step_open(const fs_step_model *model, const fs_step_record *entity, const char *type,
                       fs_step_cursor *cursor); /* FS_ERR_FORMAT: it has another type */
fs_status fs_step_skip(fs_step_cursor *cursor); /* one parameter of any kind */
fs_status fs_step_take_reference(fs_step_cursor *cursor, const fs_step_record **entity);
fs_status fs_step_take_integer(fs_step_cursor *cursor, int32_t *i);
fs_status fs_step_take_real(fs_step_cursor *cursor, double *x);
fs_status fs_step_take_logical(fs_step_cursor *cursor, bool *is_true); /* .T., or .F. and .U. */
fs_status fs_step_enter(fs_step_cursor *cursor);                       /* a list: behind its parenthesis */
bool fs_step_leave(fs_step_cursor *cursor); /* true: the list ends here, and the cursor is behind it */

/* (x, y, z) of a CARTESIAN_POINT. */
fs_status fs_step_read_point(const fs_step_model *model, const fs_step_record *entity, fs_vec3 *point);

/* A B-spline surface or curve; FS_ERR_UNSUPPORTED for other types, and for weights that differ. */
fs_status fs_step_read_surface(const fs_step_model *model, const fs_step_record *entity, fs_spline **spline);
fs_status fs_step_read_curve(const fs_step_model *model, const fs_step_record *entity, fs_spline **spline);
bool fs_step_is_curve(const fs_step_model *model, const fs_step_record *entity); /* a B-spline curve */

/* FS_ERR_UNSUPPORTED where the border of a face is not the border of its surface. bound: the bounds of an ADVANCED_FACE. */
fs_status fs_step_check_border(const fs_step_model *model, const fs_step_record *face, const fs_spline *surface);

#endif
