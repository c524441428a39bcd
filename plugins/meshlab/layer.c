/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: memory and messages of layers and outcomes. */
#include "layer.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void polygons_clear(polygon_list *p) {
  free(p->position);
  free(p->face_start);
  free(p->corner);
  *p = (polygon_list){0};
}

void layer_clear(layer *l) {
  polygons_clear(&l->polygons);
  free(l->selected);
  *l = (layer){0};
}

void outcome_clear(outcome *o) {
  polygons_clear(&o->polygons);
  free(o->normal);
  free(o->quality);
  *o = (outcome){0};
}

void outcome_add(outcome *o, const char *name, double value) {
  if (o->n_values < MAX_VALUES) o->value[o->n_values++] = (named_value){name, value};
}

void outcome_say(outcome *o, const char *format, ...) {
  size_t used = strlen(o->log);
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(o->log + used, sizeof o->log - used, format, arguments);
  va_end(arguments);
}

fs_status refuse(fs_context *ctx, fs_status status, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(ctx->message, sizeof ctx->message, format, arguments);
  va_end(arguments);
  return status;
}

void *take(fs_context *ctx, size_t n, size_t size) {
  void *block = calloc(n > 0 ? n : 1, size);
  if (block == NULL) refuse(ctx, FS_ERR_MEMORY, "out of memory");
  return block;
}

fs_status outcome_take_mesh(fs_context *ctx, const fs_mesh *mesh, outcome *o) {
  fs_status status = FS_OK;
  polygon_list p = {.n_vertices = mesh->n_vertices, .n_faces = mesh->n_faces};
  TAKE(ctx, p.position, p.n_vertices);
  TAKE(ctx, p.face_start, p.n_faces + 1);
  TAKE(ctx, p.corner, mesh->n_halfedges);
  memcpy(p.position, mesh->position, (size_t)p.n_vertices * sizeof *p.position);
  memcpy(p.face_start, mesh->face_start, ((size_t)p.n_faces + 1) * sizeof *p.face_start);
  memcpy(p.corner, mesh->origin, (size_t)mesh->n_halfedges * sizeof *p.corner);
  o->polygons = p;
  p = (polygon_list){0};
done:
  polygons_clear(&p);
  return status;
}
