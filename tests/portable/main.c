/* SPDX-License-Identifier: MIT */
/* The rooms that also run in a browser, linked alone: a surface is made from a mesh in memory and evaluated. That this links
   without CHOLMOD, BLAS, threads and files is half of the test; tests/portable/check_symbols.py is the other half. */
#include <fairsurf/mesh.h>
#include <fairsurf/refine.h>
#include <fairsurf/space.h>
#include <fairsurf/surface.h>
#include <stddef.h>

int main(void) {
  static const char cube[] = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                             "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  fs_context ctx = {0};
  fs_mesh *mesh = NULL;
  fs_refinement *step[FS_MAX_REFINEMENTS];
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  fs_triangles *triangles = NULL;
  int32_t n_steps = 0;
  int result = 1;
  if (fs_mesh_parse(&ctx, "obj", cube, sizeof cube - 1, &mesh) == FS_OK &&
      fs_space_prepare(&ctx, mesh, 0, step, &n_steps) == FS_OK && n_steps == 1 &&
      fs_space_create(&ctx, step[0]->mesh, &space) == FS_OK &&
      fs_surface_create(&ctx, space, space->start, &surface) == FS_OK &&
      fs_tessellate(&ctx, surface, 4, &triangles) == FS_OK)
    result = triangles->n_triangles == 24 * 4 * 4 * 2 ? 0 : 1;
  fs_triangles_free(&ctx, triangles);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  for (int32_t i = 0; i < n_steps; i++) fs_refinement_free(&ctx, step[i]);
  fs_mesh_free(&ctx, mesh);
  fs_context_clear(&ctx);
  return result;
}
