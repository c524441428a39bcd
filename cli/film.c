/* SPDX-License-Identifier: MIT */
/* Single role: the film of a fairing: DIR/iter0000.pov, … a scene per iterate; film.pov and film.ini, all of them seen by one
   camera; before_after.pov, the first and the last beside each other. */
#include "cli.h"

#include <string.h>

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

static const char pair_scene[] =
    "// before fairing on the left, after it on the right: povray before_after.pov +W960 +H400 +A0.1\n"
    "#version 3.7;\n"
    "global_settings { assumed_gamma 1.0 }\n"
    "#include \"iter0000.inc\"\n"
    "#declare Before = object { film }\n"
    "#declare Middle = (film_Min + film_Max) / 2;\n"
    "#declare Radius = vlength(film_Max - film_Min) / 2;\n"
    "#undef film_Included\n"
    "#include \"iter%04d.inc\"\n"
    "#declare View = vnormalize(<2.3, -2.9, 2.3>);\n"
    "#declare Aside = vnormalize(vcross(z, View)) * 1.1 * Radius;\n"
    "camera { location Middle + View * 6 * Radius sky z right -x * image_width / image_height up z\n"
    "  angle 2 * degrees(atan2(max(0.36, 0.17 * image_width / image_height), 1)) look_at Middle }\n"
    "background { rgb <0.62, 0.68, 0.75> }\n"
    "// stripes that only the mirrors see\n"
    "sphere { 0, 1 hollow no_image no_shadow\n"
    "  pigment { gradient x triangle_wave frequency 5\n"
    "    color_map { [0 rgb 0.98] [0.485 rgb 0.98] [0.515 rgb 0.02] [1 rgb 0.02] } }\n"
    "  finish { ambient 0 emission 1 diffuse 0 } scale 50 * Radius translate Middle }\n"
    "#declare Mirror = texture { pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 1 } }\n"
    "object { Before texture { Mirror } no_reflection translate -Aside }\n"
    "object { film texture { Mirror } no_reflection translate Aside }\n";

enum { MAX_PATH = 4096 };

static fs_status path_of(fs_context *ctx, const iterates *it, const char *name, char path[MAX_PATH]) {
  if (snprintf(path, MAX_PATH, "%s/%s", it->film, name) < MAX_PATH) return FS_OK;
  snprintf(ctx->message, sizeof ctx->message, "the path of %.200s is too long", it->film);
  return FS_ERR_IO;
}

fs_status write_frame(fs_context *ctx, iterates *it, const fs_vec3 *c) {
  fs_surface *surface = NULL;
  char path[MAX_PATH], name[32];
  fs_status status;
  snprintf(name, sizeof name, "iter%04d.pov", it->n_frames);
  status = path_of(ctx, it, name, path);
  if (status == FS_OK) status = fs_surface_create(ctx, it->space, c, &surface);
  if (status == FS_OK)
    status =
        fs_export_file(ctx, &(fs_model){.name = "film", .surface = surface, .made_with = "an iterate of a fairing"},
                       it->film_param, path);
  fs_surface_free(ctx, surface);
  if (status == FS_OK) it->n_frames++;
  return status;
}

static fs_status write_text(fs_context *ctx, const iterates *it, const char *name, const char *text) {
  char path[MAX_PATH];
  fs_status status = path_of(ctx, it, name, path);
  fs_files *files = NULL;
  fs_output output;
  fs_sink sink;
  if (status == FS_OK) status = fs_files_create(ctx, path, &files, &output);
  if (status != FS_OK) return status;
  status = output.open(output.user, strrchr(name, '.') + 1, &sink);
  if (status == FS_OK) status = sink.write(sink.user, text, strlen(text));
  if (status == FS_OK) return fs_files_commit(ctx, files);
  fs_files_discard(ctx, files);
  return status;
}

fs_status end_film(fs_context *ctx, iterates *it) {
  char text[sizeof pair_scene + 16];
  fs_status status;
  if (it->n_frames == 0) return FS_OK;
  status = write_text(ctx, it, "film.pov", film_scene);
  snprintf(text, sizeof text, "Input_File_Name=film.pov\nInitial_Frame=0\nFinal_Frame=%d\n", it->n_frames - 1);
  if (status == FS_OK) status = write_text(ctx, it, "film.ini", text);
  snprintf(text, sizeof text, pair_scene, it->n_frames - 1);
  if (status == FS_OK) status = write_text(ctx, it, "before_after.pov", text);
  return status;
}
