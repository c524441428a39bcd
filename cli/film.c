/* SPDX-License-Identifier: MIT */
/* Single role: the film of a fairing: DIR/iter0000.pov, … a scene per iterate; film.pov and film.ini, all of them seen by one
   camera; before_after.pov, the first and the last beside each other. */
#include "cli.h"

/* The object of every iterate is called film, so that one scene shows any of them. */
static const char film_scene[] =
    "// every iterate of a fairing, by the camera that fits the first: povray film.ini +W480 +H360 +A0.1\n"
    "#version 3.7;\n"
    "#include \"iter0000.inc\"\n"
    "#declare film_Middle = (film_Min + film_Max) / 2;\n"
    "#declare film_Radius = vlength(film_Max - film_Min) / 2;\n"
    "#declare film_Distance = 3.6 * film_Radius;\n"
    "#undef film_Included\n"
    "#include concat(\"iter\", str(frame_number, -4, 0), \".pov\")\n";

fs_status write_frame(fs_context *ctx, iterates *it, const fs_vec3 *c) {
  fs_surface *surface = NULL;
  char name[32];
  fs_status status = fs_surface_create(ctx, it->space, c, &surface);
  snprintf(name, sizeof name, "iter%04d.pov", it->n_frames);
  if (status == FS_OK) {
    fs_model model = {.name = "film", .surface = surface, .made_with = "an iterate of a fairing"};
    status = export_into(ctx, &model, it->film_param, it->film, name);
  }
  fs_surface_free(ctx, surface);
  if (status == FS_OK) it->n_frames++;
  return status;
}

fs_status end_film(fs_context *ctx, iterates *it) {
  char text[100], last[32];
  fs_status status;
  if (it->n_frames == 0) return FS_OK;
  status = write_text(ctx, it->film, "film.pov", film_scene);
  snprintf(text, sizeof text, "Input_File_Name=film.pov\nInitial_Frame=0\nFinal_Frame=%d\n", it->n_frames - 1);
  if (status == FS_OK) status = write_text(ctx, it->film, "film.ini", text);
  snprintf(last, sizeof last, "iter%04d", it->n_frames - 1);
  if (status == FS_OK) status = write_pair(ctx, it->film, "film", "iter0000", last);
  return status;
}
