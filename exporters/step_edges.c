/* SPDX-License-Identifier: MIT */
/* Single role: the edges between the faces of a layout. Each is used by two faces in opposite directions, or by one at the
   border of the surface. */
#include "step.h"
#include "base/base.h"
#include "surface/surface.h"

/* The side of the face on which a side of a patch lies. */
static int32_t face_side(const fs_step_layout *layout, int32_t side) {
  return (side % 4 + 4 - layout->turn[side / 4]) % 4;
}

/* Whether the side goes on with the edge of the side before it in their face: across both lies the border, or the same
   side of one face. They follow each other there too, since the border of a face passes no corner twice. */
static bool continues(const fs_surface *surface, const fs_step_layout *layout, int32_t before, int32_t side) {
  int32_t a = fs_side_across(surface, before / 4, before % 4), b = fs_side_across(surface, side / 4, side % 4);
  if (a == FS_NONE || b == FS_NONE) return a == b;
  return layout->face_of[a / 4] == layout->face_of[b / 4] && face_side(layout, a) == face_side(layout, b);
}

/* The sides of one face that have no edge yet get one. */
static void walk(const fs_surface *surface, const fs_step_layout *layout, int32_t f, fs_step_edges *edges) {
  const fs_step_face *face = &layout->face[f];
  int32_t cell = face->cell;
  for (int32_t s = 0; s < 4; s++) {
    int32_t before = FS_NONE; /* the side before this one where that began or continued an edge */
    for (int32_t k = 0, n = s % 2 == 0 ? face->n : face->m; k < n; k++) {
      int32_t side = fs_step_side(cell, s), across = fs_side_across(surface, side / 4, side % 4);
      bool is_new = edges->edge_of[side] == FS_NONE;
      if (is_new && (before == FS_NONE || !continues(surface, layout, before, side)))
        edges->edge[edges->n_edges++] = (fs_step_edge){.first = side, .start = layout->corner[side]};
      if (is_new) {
        fs_step_edge *edge = &edges->edge[edges->n_edges - 1];
        edge->n_sides++;
        edge->end = layout->corner[side - side % 4 + (side + 1) % 4];
        edges->edge_of[side] = 2 * (edges->n_edges - 1);
        if (across != FS_NONE) edges->edge_of[across] = 2 * (edges->n_edges - 1) + 1;
      }
      before = is_new ? side : FS_NONE;
      if (k + 1 < n) cell = fs_step_cross(surface, cell, (s + 1) % 4);
    }
  }
}

fs_status fs_step_edges_create(fs_context *ctx, const fs_surface *surface, const fs_step_layout *layout,
                               fs_step_edges **edges) {
  fs_status status = FS_OK;
  fs_step_edges *made = NULL;
  size_t n_sides = 4 * (size_t)surface->n_patches, n_edges = 0;
  for (int32_t f = 0; f < layout->n_faces; f++) n_edges += 2 * ((size_t)layout->face[f].n + (size_t)layout->face[f].m);
  FS_ALLOC(ctx, made, 1);
  FS_ALLOC(ctx, made->edge_of, n_sides);
  FS_ALLOC(ctx, made->edge, n_edges);
  for (size_t side = 0; side < n_sides; side++) made->edge_of[side] = FS_NONE;
  for (int32_t f = 0; f < layout->n_faces; f++) walk(surface, layout, f, made);
  *edges = made;
  made = NULL;
done:
  fs_step_edges_free(ctx, made);
  return status;
}

void fs_step_edges_free(fs_context *ctx, fs_step_edges *edges) {
  if (edges == NULL) return;
  fs_release(ctx, edges->edge);
  fs_release(ctx, edges->edge_of);
  fs_release(ctx, edges);
}
