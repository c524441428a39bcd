/* SPDX-License-Identifier: MIT */
/* NAME.pov: a camera that sees the whole object, light, and a way to look at it; NAME.ini: the pictures of a turn.

   The renderer is left-handed; "sky z" with a negated "right" shows right-handed data with z up as they are, without
   negated coordinates, which would turn the surface inside out. */
#include "povray.h"

/* Texts in which $ stands for NAME. The helpers carry the name too, so that no name of an object can meet them. Who includes
   the scene may declare the camera's before: pictures of a film need the same for all. */
static const char camera[] = "#ifndef ($_Middle) #declare $_Middle = ($_Min + $_Max) / 2; #end\n"
                             "#ifndef ($_Radius) #declare $_Radius = vlength($_Max - $_Min) / 2; #end\n"
                             "// the object fits a cone of half angle atan(0.25) whatever the shape of the picture\n"
                             "camera {\n"
                             "  location $_Middle + vnormalize(<2.3, -2.9, 2.3>) * $_Distance\n"
                             "  sky z right -x * image_width / image_height up z\n"
                             "  angle 2 * degrees(atan2(0.25 * max(1, image_width / image_height), 1))\n"
                             "  look_at $_Middle\n"
                             "}\n"
                             "background { rgb <0.62, 0.68, 0.75> }\n";

static const char lights[] = "light_source { $_Middle + <3, -6, 8> * $_Radius rgb 1\n"
                             "  area_light x * $_Radius, y * $_Radius, 4, 4 adaptive 1 }\n"
                             "light_source { $_Middle + <-6, -2, 3> * $_Radius rgb 0.3 shadowless }\n"
                             "#declare $_Finish = finish { ambient 0.1 diffuse 0.7 specular 0.4 roughness 0.008 }\n";
static const char outside[] = "  pigment { rgb <0.30, 0.45, 0.62> } finish { $_Finish }\n";
static const char inside[] = "  pigment { rgb <0.66, 0.54, 0.36> } finish { $_Finish }\n";

#define TURN                                       \
  "\n  // one turn while clock goes from 0 to 1\n" \
  "  translate -$_Middle rotate 360 * clock * z translate $_Middle"

/* What stands around the object; the textures of its two sides, or one for both; what stands in its braces. */
static const struct {
  const char *around, *texture, *inside, *object;
} scenes[] = {
    [FS_POVRAY_SHADED] = {lights, outside, inside, "texture { $_Texture } interior_texture { $_Inside }"},
    [FS_POVRAY_ZEBRA] = {"// stripes on a sphere that only the mirror sees\n"
                         "sphere { 0, 1 hollow no_image no_shadow\n"
                         "  pigment { gradient x triangle_wave frequency 5\n"
                         "    color_map { [0 rgb 0.98] [0.485 rgb 0.98] [0.515 rgb 0.02] [1 rgb 0.02] } }\n"
                         "  finish { ambient 0 emission 1 diffuse 0 }\n"
                         "  scale 50 * $_Radius translate $_Middle\n"
                         "}\n",
                         "  pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 1 }\n", NULL,
                         "texture { $_Texture } no_reflection"},
    [FS_POVRAY_ISOPHOTE] = {"// stripes of equal angle to a direction\n",
                            "  pigment { slope { <0.4, -0.6, 0.7> } frequency 16\n"
                            "    color_map { [0 rgb 0.1] [0.49 rgb 0.1] [0.51 rgb 1] [1 rgb 1] } }\n"
                            "  finish { ambient 0 emission 0.95 diffuse 0 }\n",
                            NULL, "texture { $_Texture }"},
    [FS_POVRAY_CURVATURE] =
        {"light_source { $_Middle + <3, -6, 8> * $_Radius rgb 0.8 shadowless }\n"
         "// colours of the measure from $_Low at 0 to $_High at 1\n",
         "  uv_mapping\n"
         "  pigment { gradient x color_map { [0 rgb <0.1, 0.2, 0.75>] [0.25 rgb <0.25, 0.75, 0.85>]\n"
         "    [0.5 rgb <0.95, 0.95, 0.9>] [0.75 rgb <0.95, 0.75, 0.2>] [1 rgb <0.75, 0.1, 0.1>] } }\n"
         "  finish { ambient 0.35 diffuse 0.6 }\n",
         NULL, "texture { $_Texture }"},
    [FS_POVRAY_TURNTABLE] = {lights, outside, inside, "texture { $_Texture } interior_texture { $_Inside } " TURN},
};

static void write_text(fs_writer *w, const char *text, const char *name) {
  for (; *text != '\0'; text++) {
    if (*text == '$')
      fs_writer_text(w, name);
    else
      fs_writer_bytes(w, text, 1);
  }
}

/* The texture is the user's who declares it before including the file. */
static void write_texture(fs_writer *w, const char *what, const char *texture, const char *name) {
  if (texture == NULL) return;
  fs_writer_printf(w, "#ifndef (%s_%s) #declare %s_%s = texture {\n", name, what, name, what);
  write_text(w, texture, name);
  fs_writer_text(w, "} #end\n");
}

/* Of the names of the files. */
static const char *stem(const fs_povray_model *model) {
  const char *found = model->model->file != NULL ? model->model->file : model->model->name;
  return found != NULL && *found != '\0' ? found : model->name;
}

fs_status fs_povray_write_scene(fs_context *ctx, const fs_povray_model *model, fs_povray_scene scene,
                                const fs_output *output) {
  fs_writer writer;
  fs_writer_start(&writer, ctx, output, "pov");
  write_text(&writer, "// $: a smooth surface made by fairsurf; render with +W960 +H720 +A0.1\n", model->name);
  write_text(&writer, "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n", model->name);
  fs_writer_text(&writer, "#include ");
  fs_povray_file(&writer, stem(model), "inc");
  if (model->model->curves != NULL) {
    fs_writer_text(&writer, "\n#include ");
    fs_povray_file(&writer, stem(model), "curves.inc");
  }
  fs_writer_text(&writer, "\n");
  write_text(&writer, "#ifndef ($_Distance) #declare $_Distance = ", model->name);
  fs_povray_number(&writer, model->distance, 6);
  fs_writer_text(&writer, "; #end\n");
  write_text(&writer, camera, model->name);
  write_text(&writer, scenes[scene].around, model->name);
  write_texture(&writer, "Texture", scenes[scene].texture, model->name);
  write_texture(&writer, "Inside", scenes[scene].inside, model->name);
  write_text(&writer, "object { $ ", model->name);
  write_text(&writer, scenes[scene].object, model->name);
  fs_writer_text(&writer, " }\n");
  if (model->model->curves != NULL)
    write_text(&writer, scene == FS_POVRAY_TURNTABLE ? "object { $_Curves " TURN " }\n" : "object { $_Curves }\n",
               model->name);
  return fs_writer_finish(&writer);
}

fs_status fs_povray_write_turn(fs_context *ctx, const fs_povray_model *model, int32_t n_frames,
                               const fs_output *output) {
  fs_writer writer;
  fs_writer_start(&writer, ctx, output, "ini");
  fs_writer_printf(&writer, "; one turn in %d pictures: povray NAME.ini +W480 +H360 +A0.1\n", (int)n_frames);
  fs_writer_text(&writer, "Input_File_Name=");
  fs_povray_file(&writer, stem(model), "pov");
  fs_writer_printf(&writer, "\nInitial_Frame=1\nFinal_Frame=%d\nCyclic_Animation=on\n", (int)n_frames);
  return fs_writer_finish(&writer);
}
