/* SPDX-License-Identifier: MIT */
/* Single role: the JSON of a GLB file [glTF 2.0; KHR_draco_mesh_compression]. The format has y up: a node turns the z of
   the surface there. */
#include "glb.h"
#include "writer.h"

#define COMPRESSION "KHR_draco_mesh_compression"
#define UNLIT "KHR_materials_unlit"

enum { FLOAT32 = 5126, UINT32 = 5125, VERTICES = 34962, INDICES = 34963 };

/* Corners and attributes of a part, which have an accessor each, number (count of them) p + k; the corners come first. */
enum { CORNERS, FIRST_ATTRIBUTE };

static const struct attribute {
  const char *name, *type;
  int32_t n_components;
} attributes[FS_GLB_ATTRIBUTES] = {
    {"POSITION", "VEC3", 3}, {"NORMAL", "VEC3", 3}, {"TEXCOORD_0", "VEC2", 2}, {"_CURVATURE", "SCALAR", 1}};

static int32_t count_attributes(const fs_glb_scene *s) {
  return s->mesh->measure != NULL ? FS_GLB_ATTRIBUTES : FS_GLB_TEXTURE;
}

/* Bytes that belong to the character that begins here, 0: it is none of UTF-8. */
static size_t measure_character(const unsigned char *c) {
  static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  size_t n = *c < 0x80 ? 1 : *c >= 0xC2 && *c < 0xE0 ? 2 : (*c & 0xF0) == 0xE0 ? 3 : *c >= 0xF0 && *c < 0xF5 ? 4 : 0;
  uint32_t code = n > 1 ? *c & (0x7Fu >> n) : *c;
  for (size_t i = 1; i < n; i++) {
    if ((c[i] & 0xC0) != 0x80) return 0;
    code = code << 6 | (c[i] & 0x3Fu);
  }
  if (n > 1 && (code < least[n] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000))) return 0;
  return n;
}

/* Text in quotes; what JSON forbids becomes a space or a question mark. */
static void write_string(fs_writer *w, const char *text) {
  const unsigned char *c = (const unsigned char *)text;
  fs_writer_text(w, "\"");
  while (*c != '\0') {
    size_t n = measure_character(c);
    if (*c == '"' || *c == '\\') fs_writer_text(w, "\\");
    if (n == 0 || *c < 32)
      fs_writer_text(w, n == 0 ? "?" : " ");
    else
      fs_writer_bytes(w, c, n);
    c += n == 0 ? 1 : n;
  }
  fs_writer_text(w, "\"");
}

static void write_size(fs_writer *w, const char *key, size_t size) { fs_writer_printf(w, "\"%s\":%zu", key, size); }

static void write_named(fs_writer *w, const fs_glb_scene *s, int32_t p) {
  fs_writer_text(w, "\"name\":");
  if (s->mesh->n_parts == 1) {
    write_string(w, s->model->name);
    return;
  }
  fs_writer_printf(w, "\"part %d\"", p + 1);
}

/* ---- scene, nodes, meshes, materials ---- */

static void write_nodes(fs_writer *w, const fs_glb_scene *s) {
  fs_writer_text(w, "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":");
  write_string(w, s->model->name);
  fs_writer_text(w, ",\"rotation\":[-0.7071067811865475,0,0,0.7071067811865476]");
  if (s->mesh->n_parts == 1) {
    fs_writer_text(w, s->lines.n_lines > 0 ? ",\"mesh\":0,\"children\":[1]},{\"name\":\"curves\",\"mesh\":1}]"
                                           : ",\"mesh\":0}]");
    return;
  }
  fs_writer_text(w, ",\"children\":[");
  for (int32_t p = 0; p < s->mesh->n_parts; p++) fs_writer_printf(w, p > 0 ? ",%d" : "%d", p + 1);
  if (s->lines.n_lines > 0) fs_writer_printf(w, ",%d", s->mesh->n_parts + 1);
  fs_writer_text(w, "]}");
  for (int32_t p = 0; p < s->mesh->n_parts; p++) {
    fs_writer_text(w, ",{");
    write_named(w, s, p);
    fs_writer_printf(w, ",\"mesh\":%d}", p);
  }
  if (s->lines.n_lines > 0) fs_writer_printf(w, ",{\"name\":\"curves\",\"mesh\":%d}", s->mesh->n_parts);
  fs_writer_text(w, "]");
}

static void write_mesh(fs_writer *w, const fs_glb_scene *s, int32_t p) {
  int32_t n = count_attributes(s), first = (n + FIRST_ATTRIBUTE) * p;
  fs_writer_text(w, p > 0 ? ",{" : "{");
  write_named(w, s, p);
  fs_writer_printf(w, ",\"primitives\":[{\"mode\":4,\"material\":0,\"indices\":%d,\"attributes\":{", first + CORNERS);
  for (int32_t a = 0; a < n; a++)
    fs_writer_printf(w, "%s\"%s\":%d", a > 0 ? "," : "", attributes[a].name, first + FIRST_ATTRIBUTE + a);
  fs_writer_text(w, "}");
  if (s->is_compressed) {
    fs_writer_printf(w, ",\"extensions\":{\"" COMPRESSION "\":{\"bufferView\":%d,\"attributes\":{", p);
    for (int32_t a = 0; a < n; a++)
      fs_writer_printf(w, "%s\"%s\":%d", a > 0 ? "," : "", attributes[a].name, s->stored[p].id[a]);
    fs_writer_text(w, "}}}");
  }
  fs_writer_text(w, "}]");
  if (s->mesh->measure != NULL) {
    fs_writer_text(w, ",\"extras\":{\"measure\":");
    write_string(w, s->model->colour->name);
    fs_writer_text(w, ",\"low\":");
    fs_writer_number(w, s->mesh->low);
    fs_writer_text(w, ",\"high\":");
    fs_writer_number(w, s->mesh->high);
    fs_writer_text(w, "}");
  }
  fs_writer_text(w, "}");
}

/* view: of the picture. */
static void write_materials(fs_writer *w, const fs_glb_scene *s, int32_t view) {
  fs_writer_printf(w, ",\"materials\":[{\"name\":\"surface\",\"doubleSided\":%s,\"pbrMetallicRoughness\":{",
                   s->mesh->is_closed ? "false" : "true");
  fs_writer_text(w, s->mesh->measure != NULL ? "\"baseColorTexture\":{\"index\":0}"
                                             : "\"baseColorFactor\":[0.3,0.45,0.62,1]");
  fs_writer_text(w, ",\"metallicFactor\":0,\"roughnessFactor\":0.35}}");
  if (s->lines.n_lines > 0)
    fs_writer_text(w, ",{\"name\":\"curves\",\"extensions\":{\"" UNLIT "\":{}},\"pbrMetallicRoughness\":"
                      "{\"metallicFactor\":0,\"roughnessFactor\":1}}");
  fs_writer_text(w, "]");
  if (s->mesh->measure == NULL) return;
  fs_writer_text(w, ",\"textures\":[{\"source\":0,\"sampler\":0}],\"samplers\":[{\"magFilter\":9729,\"minFilter\":9729,"
                    "\"wrapS\":33071,\"wrapT\":33071}],\"images\":[{\"name\":\"ramp\",\"mimeType\":\"image/png\",");
  fs_writer_printf(w, "\"bufferView\":%d}]", view);
}

/* ---- where the numbers lie ---- */

static void write_view(fs_writer *w, size_t start, size_t size, int32_t target) {
  fs_writer_text(w, "{\"buffer\":0,");
  write_size(w, "byteOffset", start);
  fs_writer_text(w, ",");
  write_size(w, "byteLength", size);
  if (target != 0) fs_writer_printf(w, ",\"target\":%d", target);
  fs_writer_text(w, "}");
}

/* A view per part where it is compressed, else one per accessor; the picture comes last. Returns its number. */
static int32_t write_views(fs_writer *w, const fs_glb_scene *s) {
  int32_t n = count_attributes(s), number = 0;
  fs_writer_text(w, ",\"bufferViews\":[");
  for (int32_t p = 0; p < s->mesh->n_parts; p++) {
    const fs_glb_stored *stored = &s->stored[p];
    size_t at = stored->start, size = 3 * sizeof(uint32_t) * (size_t)stored->n_triangles;
    if (s->is_compressed) {
      fs_writer_text(w, number++ > 0 ? "," : "");
      write_view(w, at, stored->size, 0);
      continue;
    }
    fs_writer_text(w, number > 0 ? "," : "");
    write_view(w, at, size, INDICES);
    at += size;
    for (int32_t a = 0; a < n; a++, at += size) {
      size = (size_t)attributes[a].n_components * sizeof(float) * (size_t)stored->n_vertices;
      fs_writer_text(w, ",");
      write_view(w, at, size, VERTICES);
    }
    number += n + FIRST_ATTRIBUTE;
  }
  if (s->lines.n_lines > 0) {
    fs_glb_write_lines_views(w, &s->lines);
    number += 3;
  }
  if (s->mesh->measure != NULL) {
    fs_writer_text(w, ",");
    write_view(w, s->ramp_start, s->ramp_size, 0);
  }
  fs_writer_text(w, "]");
  return number;
}

static void write_corner_of_box(fs_writer *w, const char *key, const float x[3]) {
  fs_writer_printf(w, ",\"%s\":[", key);
  fs_writer_vec3(w, (fs_vec3){x[0], x[1], x[2]}, ",");
  fs_writer_text(w, "]");
}

static void write_accessor(fs_writer *w, const fs_glb_scene *s, int32_t view, int32_t component, int32_t count,
                           const char *type) {
  fs_writer_text(w, "{");
  if (!s->is_compressed) fs_writer_printf(w, "\"bufferView\":%d,", view);
  fs_writer_printf(w, "\"componentType\":%d,\"count\":%d,\"type\":\"%s\"", component, count, type);
}

static void write_accessors(fs_writer *w, const fs_glb_scene *s) {
  int32_t n = count_attributes(s), view = 0;
  fs_writer_text(w, ",\"accessors\":[");
  for (int32_t p = 0; p < s->mesh->n_parts; p++) {
    const fs_glb_stored *stored = &s->stored[p];
    fs_writer_text(w, p > 0 ? "," : "");
    write_accessor(w, s, view++, UINT32, 3 * stored->n_triangles, "SCALAR");
    fs_writer_text(w, "}");
    for (int32_t a = 0; a < n; a++) {
      fs_writer_text(w, ",");
      write_accessor(w, s, view++, FLOAT32, stored->n_vertices, attributes[a].type);
      if (a == FS_GLB_POSITION) {
        write_corner_of_box(w, "min", stored->min);
        write_corner_of_box(w, "max", stored->max);
      }
      fs_writer_text(w, "}");
    }
  }
  if (s->lines.n_lines > 0) fs_glb_write_lines_accessors(w, &s->lines, s->is_compressed ? s->mesh->n_parts : view);
  fs_writer_text(w, "]");
}

fs_status fs_glb_append_scene(const fs_glb_scene *s, fs_blob *json) {
  fs_output output = fs_blob_output(json);
  int32_t picture;
  fs_writer w;
  fs_writer_start(&w, json->ctx, &output, "json");
  fs_writer_text(&w, "{\"asset\":{\"version\":\"2.0\",\"generator\":");
  write_string(&w, s->model->made_with != NULL ? s->model->made_with : "fairsurf");
  fs_writer_text(&w, "},");
  if (s->is_compressed && s->lines.n_lines > 0)
    fs_writer_text(&w, "\"extensionsUsed\":[\"" COMPRESSION "\",\"" UNLIT "\"],");
  else if (s->is_compressed || s->lines.n_lines > 0)
    fs_writer_printf(&w, "\"extensionsUsed\":[\"%s\"],", s->is_compressed ? COMPRESSION : UNLIT);
  if (s->is_compressed) fs_writer_text(&w, "\"extensionsRequired\":[\"" COMPRESSION "\"],");
  write_nodes(&w, s);
  fs_writer_text(&w, ",\"meshes\":[");
  for (int32_t p = 0; p < s->mesh->n_parts; p++) write_mesh(&w, s, p);
  if (s->lines.n_lines > 0) fs_glb_write_lines_mesh(&w, (count_attributes(s) + FIRST_ATTRIBUTE) * s->mesh->n_parts);
  fs_writer_text(&w, "]");
  picture = write_views(&w, s);
  write_materials(&w, s, picture);
  write_accessors(&w, s);
  fs_writer_text(&w, ",\"buffers\":[{");
  write_size(&w, "byteLength", s->chunk_size);
  fs_writer_text(&w, "}]}");
  return fs_writer_finish(&w);
}
