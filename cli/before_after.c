/* SPDX-License-Identifier: MIT */
/* Single role: two surfaces beside each other in one scene of POV-Ray: DIR/before_after.pov, the pictures of a turn by
   DIR/before_after.ini. */
#include "cli.h"

#include <string.h>

/* The two files declare an object of the same name. */
static const char objects[] =
    "// before fairing on the left, after it on the right: povray before_after.pov +W960 +H400 +A0.1\n"
    "#version 3.7;\n"
    "global_settings { assumed_gamma 1.0 }\n"
    "#include \"%s.inc\"\n"
    "#declare Before = object { %s }\n"
    "#declare Middle = (%s_Min + %s_Max) / 2;\n"
    "#declare Radius = vlength(%s_Max - %s_Min) / 2;\n"
    "#undef %s_Included\n"
    "#include \"%s.inc\"\n"
    "#declare After = object { %s }\n";

static const char scene[] =
    "#declare View = vnormalize(<2.3, -2.9, 2.3>);\n"
    "#declare Aside = vnormalize(vcross(z, View)) * 1.1 * Radius;\n"
    "// parallel rays: both are seen from the same direction\n"
    "#declare Ratio = image_width / image_height;\n"
    "#declare Height = max(2.2, 4.4 / Ratio) * Radius;\n"
    "camera { orthographic location Middle + View * 6 * Radius sky z right -x * Ratio * Height up z * Height look_at "
    "Middle }\n"
    "background { rgb <0.62, 0.68, 0.75> }\n"
    "// stripes that only the mirrors see\n"
    "sphere { 0, 1 hollow no_image no_shadow\n"
    "  pigment { gradient x triangle_wave frequency 5\n"
    "    color_map { [0 rgb 0.98] [0.485 rgb 0.98] [0.515 rgb 0.02] [1 rgb 0.02] } }\n"
    "  finish { ambient 0 emission 1 diffuse 0 } scale 50 * Radius translate Middle }\n"
    "#declare Mirror = texture { pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 1 } }\n"
    "// one turn while clock goes from 0 to 1\n"
    "#declare Turn = transform { translate -Middle rotate 360 * clock * z translate Middle }\n"
    "object { Before texture { Mirror } no_reflection transform { Turn } translate -Aside }\n"
    "object { After texture { Mirror } no_reflection transform { Turn } translate Aside }\n";

static const char turn[] = "; one turn in 36 pictures: povray before_after.ini +W960 +H400 +A0.1\n"
                           "Input_File_Name=before_after.pov\nInitial_Frame=1\nFinal_Frame=36\nCyclic_Animation=on\n";

fs_status write_pair(fs_context *ctx, const char *folder, const char *object, const char *before, const char *after) {
  char text[sizeof objects + sizeof scene + 1000];
  fs_status status;
  int used =
      snprintf(text, sizeof text, objects, before, object, object, object, object, object, object, after, object);
  snprintf(text + used, sizeof text - (size_t)used, "%s", scene);
  status = write_text(ctx, folder, "before_after.pov", text);
  return status == FS_OK ? write_text(ctx, folder, "before_after.ini", turn) : status;
}

fs_status write_before_after(fs_context *ctx, const arguments *a, const fs_surface *before, const fs_surface *after) {
  const fs_surface *surface[2] = {before, after};
  static const char *const file[2] = {"before.pov", "after.pov"};
  fs_status status = make_folder(ctx, a->before_after);
  for (int k = 0; k < 2 && status == FS_OK; k++) {
    fs_model model = {
        .name = "surface", .surface = surface[k], .made_with = k == 0 ? "before fairing" : "after fairing"};
    status = export_into(ctx, &model, a->film_param, a->before_after, file[k]);
  }
  return status == FS_OK ? write_pair(ctx, a->before_after, "surface", "before", "after") : status;
}
