/* SPDX-License-Identifier: MIT */
/* The POV-Ray exporter: counts, shared points, names, texts, failures. Pictures are compared elsewhere. */
#include "povray.h"
#include "math/vec3.h"
#include "surface_samples.h"
#include "../support/support.h"
#include <locale.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

/* An output into memory, which can fail after some bytes. */
struct file {
  char extension[8];
  char *text;
  size_t size, capacity;
};
struct memory_output {
  struct file file[4];
  int n_files;
  size_t fail_after; /* bytes in all; 0: never */
  size_t n_bytes;
};

static fs_status write_memory(void *user, const void *bytes, size_t size) {
  struct memory_output *output = user;
  struct file *file = &output->file[output->n_files - 1];
  output->n_bytes += size;
  if (output->fail_after > 0 && output->n_bytes > output->fail_after) return FS_ERR_IO;
  if (file->size + size + 1 > file->capacity) {
    file->capacity = 2 * (file->size + size + 1);
    file->text = realloc(file->text, file->capacity);
  }
  memcpy(file->text + file->size, bytes, size);
  file->size += size;
  file->text[file->size] = '\0';
  return FS_OK;
}

static fs_status open_memory(void *user, const char *extension, fs_sink *sink) {
  struct memory_output *output = user;
  struct file *file = &output->file[output->n_files++];
  snprintf(file->extension, sizeof file->extension, "%s", extension);
  *sink = (fs_sink){write_memory, output};
  return FS_OK;
}

static void clear(struct memory_output *output) {
  for (int k = 0; k < output->n_files; k++) free(output->file[k].text);
  *output = (struct memory_output){0};
}

static fs_status export(fs_context *ctx, const fs_surface *surface, const char *name, double scene, double form,
                        double steps, double tolerance, struct memory_output *memory) {
  const fs_output output = {open_memory, memory};
  const fs_model model = {.name = name, .surface = surface, .made_with = "two\nlines"};
  const double param[] = {scene, form, steps, tolerance, 12};
  return fs_exporter_povray.write(ctx, &model, param, &output);
}

static int count(const char *text, const char *word) {
  int n = 0;
  for (; (text = strstr(text, word)) != NULL; text += strlen(word)) n++;
  return n;
}

static int some(int i, int j) { return i >= 2 && i < 5 && j < 3; }

static void test_counts(void **state) {
  fs_surface *s = sample_torus(8, 6, some, 0.05);
  fs_context ctx = test_context();
  struct memory_output memory = {0};
  (void)state;
  const struct {
    double steps, tolerance;
    int m;
  } cases[] = {{3, 1e-9, 2}, {2, 1e-9, 1}, {1, 1e-9, 0}, {4, 1, 0}, {0, 1e-9, 3}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    char less[64];
    assert_int_equal(export(&ctx, s, "bumpy", 0, 0, cases[k].steps, cases[k].tolerance, &memory), FS_OK);
    assert_int_equal(memory.n_files, 2);
    assert_string_equal(memory.file[0].extension, "inc");
    assert_string_equal(memory.file[1].extension, "pov");
    const char *inc = memory.file[0].text, *pov = memory.file[1].text;
    assert_int_equal(count(inc, "bicubic_patch {"), 39 + (9 << (2 * cases[k].m)));
    assert_int_equal(count(inc, "u_steps bumpy_Less v_steps bumpy_Less"), 9 << (2 * cases[k].m));
    assert_int_equal(count(inc, "flatness 0 "), 39 + (9 << (2 * cases[k].m)));
    snprintf(less, sizeof less, "#declare bumpy_Less = bumpy_Steps - %d;", cases[k].m);
    assert_int_equal(count(inc, less), 1);
    snprintf(less, sizeof less, "#if (bumpy_Steps < %d) #error", cases[k].m + 1);
    assert_int_equal(count(inc, less), 1);
    assert_int_equal(count(inc, "// two lines\n"), 1);
    assert_int_equal(count(inc, "pigment") + count(inc, "texture {") + count(inc, "camera"), 1); /* in a comment */
    assert_int_equal(count(pov, "#include "), 1);
    assert_int_equal(count(pov, "#include \"bumpy.inc\"\n"), 1);
    assert_int_equal(count(pov, "#version 3.7;"), 1);
    for (const char *c = inc; *c != '\0'; c++) assert_true(*c != '{' || c[1] == ' ' || c[1] == '\n');
    assert_int_equal(count(inc, "{"), count(inc, "}"));
    assert_int_equal(count(pov, "{"), count(pov, "}"));
    clear(&memory);
  }
  sample_free(s);
}

/* The parameters of the pieces, in the renderer's order of corners, fill the unit square of their patch. */
static void test_parameters(void **state) {
  fs_surface *s = sample_torus(8, 6, some, 0.05);
  fs_context ctx = test_context();
  struct memory_output memory = {0};
  int n = 0, n_parts = 0;
  double area = 0;
  (void)state;
  assert_int_equal(export(&ctx, s, "a", 0, 0, 3, 1e-9, &memory), FS_OK);
  for (const char *c = memory.file[0].text; (c = strstr(c, "uv_vectors ")) != NULL; c++, n++) {
    double u[4], v[4];
    assert_int_equal(sscanf(c, "uv_vectors <%lf,%lf>,<%lf,%lf>,<%lf,%lf>,<%lf,%lf>\n", &u[0], &v[0], &u[1], &v[1],
                            &u[2], &v[2], &u[3], &v[3]),
                     8);
    assert_true(u[0] == u[1] && u[2] == u[3] && v[0] == v[3] && v[1] == v[2]);
    assert_true(u[0] >= 0 && v[0] >= 0 && u[2] <= 1 && v[2] <= 1 && u[2] - u[0] == v[2] - v[0]);
    assert_true(u[2] - u[0] == 1 || u[2] - u[0] == 0.25);
    area += (u[2] - u[0]) * (v[2] - v[0]);
    n_parts += u[2] - u[0] == 0.25;
  }
  assert_int_equal(n, 39 + 9 * 16);
  assert_int_equal(n_parts, 9 * 16);
  assert_true(area == 48);
  clear(&memory);
  sample_free(s);
}

/* A scene that turns comes with the settings of a whole turn, and its camera stands back far enough for all of it. */
static void test_turn(void **state) {
  fs_surface *s = sample_torus(6, 5, NULL, 0);
  fs_context ctx = test_context();
  struct memory_output memory = {0}, still = {0};
  double distance, still_distance;
  (void)state;
  for (size_t k = 0; k < s->n_data; k += 3) s->data[k + 1] *= 4; /* long, so that turning it matters */
  assert_int_equal(export(&ctx, s, "a", FS_POVRAY_TURNTABLE, 0, 0, 1e-4, &memory), FS_OK);
  assert_int_equal(export(&ctx, s, "a", FS_POVRAY_SHADED, 0, 0, 1e-4, &still), FS_OK);
  assert_int_equal(memory.n_files, 3);
  assert_string_equal(memory.file[2].extension, "ini");
  assert_int_equal(count(memory.file[2].text, "Input_File_Name=\"a.pov\"\n"), 1);
  assert_int_equal(count(memory.file[2].text, "Final_Frame=12\n"), 1);
  assert_int_equal(count(memory.file[1].text, "rotate 360 * clock * z"), 1);
  assert_int_equal(count(still.file[1].text, "clock"), 0);
  assert_int_equal(sscanf(strstr(memory.file[1].text, "a_Distance = "), "a_Distance = %lf", &distance), 1);
  assert_int_equal(sscanf(strstr(still.file[1].text, "a_Distance = "), "a_Distance = %lf", &still_distance), 1);
  assert_true(distance > 1.05 * still_distance);
  clear(&memory);
  clear(&still);
  sample_free(s);
}

static void test_scenes(void **state) {
  static const char *const sign[] = {"interior_texture", "triangle_wave", "slope", "uv_mapping"};
  fs_surface *s = sample_torus(6, 5, NULL, 0);
  fs_context ctx = test_context();
  struct memory_output memory = {0};
  (void)state;
  for (int scene = 0; scene < 4; scene++) {
    assert_int_equal(export(&ctx, s, "a", scene, 0, 0, 1e-4, &memory), FS_OK);
    for (int k = 0; k < 4; k++) assert_int_equal(count(memory.file[1].text, sign[k]), k == scene);
    assert_int_equal(count(memory.file[0].text, "mesh2 {"), scene == 3);
    assert_int_equal(count(memory.file[0].text, "uv_vectors {"), scene == 3);
    assert_int_equal(memory.n_files, 2);
    assert_int_equal(count(memory.file[1].text, "#ifndef (a_Texture) #declare a_Texture = texture {\n"), 1);
    assert_true(count(memory.file[1].text, "texture { a_Texture }") == 1);
    assert_int_equal(count(memory.file[0].text, "bicubic_patch"), scene == 3 ? 0 : 30);
    clear(&memory);
  }
  sample_free(s);
}

/* The numbers behind a keyword, until the block ends. */
static int read_numbers(const char *text, const char *keyword, double *number, int capacity) {
  int n = 0;
  const char *c = strstr(text, keyword), *end;
  assert_non_null(c);
  c += strlen(keyword);
  end = strchr(c, '}');
  while (c < end) {
    char *after;
    double value = strtod(c, &after);
    if (after == c)
      c++;
    else {
      assert_true(n < capacity);
      number[n++] = value;
      c = after;
    }
  }
  return n;
}

static void test_mesh2(void **state) {
  static double vertex[5000], normal[5000], face[5000], uv[5000];
  fs_surface *s = sample_torus(6, 5, NULL, 0);
  fs_context ctx = test_context();
  struct memory_output memory = {0};
  (void)state;
  for (int scene = 0; scene < 4; scene += 3) {
    assert_int_equal(export(&ctx, s, "a", scene, 1, 2, 1e-4, &memory), FS_OK);
    const char *inc = memory.file[0].text;
    const int n = 30 * 16;
    assert_int_equal(read_numbers(inc, "vertex_vectors {", vertex, 5000), 1 + 3 * n);
    assert_int_equal(read_numbers(inc, "normal_vectors {", normal, 5000), 1 + 3 * n);
    assert_int_equal(read_numbers(inc, "face_indices {", face, 5000), 1 + 6 * n);
    assert_true(vertex[0] == n && normal[0] == n && face[0] == 2 * n);
    assert_int_equal(count(inc, "inside_vector <"), 1);
    /* clockwise from outside, so the volume of the corners in this order is negative; normals point out */
    double volume = 0;
    for (int k = 0; k < 2 * n; k++) {
      fs_vec3 p[3], q;
      for (int c = 0; c < 3; c++) {
        int i = (int)face[1 + 3 * k + c];
        assert_in_range(i, 0, n - 1);
        p[c] = (fs_vec3){vertex[1 + 3 * i], vertex[2 + 3 * i], vertex[3 + 3 * i]};
        q = (fs_vec3){normal[1 + 3 * i], normal[2 + 3 * i], normal[3 + 3 * i]};
      }
      volume += fs_vec3_dot(p[0], fs_vec3_cross(p[1], p[2])) / 6;
      assert_true(fs_vec3_dot(q, fs_vec3_cross(fs_vec3_sub(p[1], p[0]), fs_vec3_sub(p[2], p[0]))) < 0);
    }
    assert_true(volume < -1);
    if (scene == 3) {
      int at_ends = 0;
      assert_int_equal(read_numbers(inc, "uv_vectors {", uv, 5000), 1 + 2 * n);
      for (int k = 0; k < n; k++) {
        assert_true(uv[1 + 2 * k] > 0 && uv[1 + 2 * k] < 1);
        at_ends += uv[1 + 2 * k] == 0.001 || uv[1 + 2 * k] == 0.999;
      }
      assert_in_range(at_ends, 2, n / 10); /* 2 of 100 at each end, and their mirror images */
    }
    clear(&memory);
  }
  s->patch[0].neighbour[0] = FS_NONE;
  s->patch[24].neighbour[2] = FS_NONE;
  assert_int_equal(export(&ctx, s, "a", 0, 1, 1, 1e-4, &memory), FS_OK);
  assert_int_equal(count(memory.file[0].text, "inside_vector"), 0); /* no inside */
  clear(&memory);
  sample_free(s);
}

/* Point k of the 3 n + 1 points along side s of patch p. */
static fs_vec3 side_point(const fs_povray_pieces *pieces, int p, int s, int k) {
  int n = pieces->first[p + 1] - pieces->first[p] == 1 ? 1 : 1 << pieces->m;
  int e = k / 3 < n ? k / 3 : n - 1, l = k - 3 * e;
  const int a[] = {e, n - 1, n - 1 - e, 0}, b[] = {0, e, n - 1, n - 1 - e};
  const int i[] = {l, 3, 3 - l, 0}, j[] = {0, l, 3, 3 - l};
  return pieces->point[16 * (pieces->first[p] + (size_t)(a[s] + n * b[s])) + (size_t)(i[s] + 4 * j[s])];
}

/* Every side that patches of one kind share has the same doubles; a divided one has those of the halved cubic. */
static void test_shared_points(void **state) {
  fs_surface *s = sample_torus(8, 6, some, 0.05);
  fs_context ctx = test_context();
  fs_povray_pieces *pieces = NULL;
  int n_mixed = 0, n_divided = 0;
  (void)state;
  /* sides and corners of neighbours differ by rounding errors, as they do when they come from other dofs */
  for (size_t k = 0; k < s->n_data; k++) s->data[k] *= 1 + (double)(k % 7) * 1e-13;
  assert_int_equal(fs_povray_pieces_create(&ctx, s, 1e-9, 2, &pieces), FS_OK);
  assert_int_equal(pieces->m, 2);
  assert_int_equal(pieces->n_whole, 39);
  assert_int_equal(pieces->n_divided, 9);
  for (int p = 0; p < s->n_patches; p++)
    for (int side = 0; side < 4; side++) {
      int q = s->patch[p].neighbour[side], r = s->patch[p].neighbour_side[side];
      int is_divided = s->patch[p].degree_u == 9, is_other = s->patch[q].degree_u == 9;
      if (is_divided == is_other) {
        int n = 3 * (is_divided ? 4 : 1);
        n_divided += is_divided;
        for (int k = 0; k <= n; k++) {
          fs_vec3 a = side_point(pieces, p, side, k), b = side_point(pieces, q, r, n - k);
          assert_true(a.x == b.x && a.y == b.y && a.z == b.z);
        }
      } else if (!is_divided) {
        n_mixed++;
        for (int k = 0; k <= 4; k++) { /* ends of the parts lie on the cubic, at its de Casteljau points */
          fs_vec3 c[4];
          for (int l = 0; l < 4; l++) c[l] = side_point(pieces, p, side, l);
          for (int l = 3; l > 0; l--)
            for (int i = 0; i < l; i++) c[i] = fs_vec3_add_scaled(fs_vec3_scale(c[i], 1 - k / 4.), c[i + 1], k / 4.);
          assert_true(fs_vec3_distance(c[0], side_point(pieces, q, r, 12 - 3 * k)) < (k % 4 == 0 ? 1e-300 : 1e-15));
        }
      }
    }
  assert_int_equal(n_mixed, 12);
  assert_int_equal(n_divided, 24);
  /* the error is measured on what is written, so no point of a piece may be farther off than it says */
  assert_true(pieces->deviation > 0 && pieces->deviation < 0.01);
  assert_true(pieces->angle < 0.05);
  fs_povray_pieces_free(&ctx, pieces);
  /* without bumps the raised patches are bicubics, and the pieces exact */
  fs_surface *flat = sample_torus(8, 6, some, 0);
  assert_int_equal(fs_povray_pieces_create(&ctx, flat, 1e-9, 2, &pieces), FS_OK);
  assert_int_equal(pieces->m, 0);
  assert_true(pieces->deviation < 1e-14 && pieces->angle < 1e-12);
  fs_povray_pieces_free(&ctx, pieces);
  sample_free(s);
  sample_free(flat);
}

/* Neighbours print their shared points at the same place but for the overlap, a millionth of a patch: far fewer distinct
   points than points. */
static void test_printed_corners(void **state) {
  fs_surface *s = sample_torus(6, 5, some, 0.05);
  fs_context ctx = test_context();
  struct memory_output memory = {0};
  (void)state;
  /* spread neighbours by rounding errors, which must not show */
  for (size_t k = 0; k < s->n_data; k++) s->data[k] *= 1 + (k % 7) * 1e-12;
  assert_int_equal(export(&ctx, s, "a", 0, 0, 1, 1, &memory), FS_OK);
  enum { N = 30 * 16 };
  static fs_vec3 point[N];
  int n = 0, n_distinct = 0;
  for (char *c = strstr(memory.file[0].text, "bicubic_patch"); (c = strchr(c, '<')) != NULL && n < N; c++)
    n += sscanf(c, "<%lf,%lf,%lf>", &point[n].x, &point[n].y, &point[n].z) == 3; /* the others are parameters */
  assert_int_equal(n, N);
  for (int k = 0; k < N; k++) {
    int l = 0;
    while (l < k && fs_vec3_distance(point[k], point[l]) > 1e-4) l++;
    n_distinct += l == k;
    if (l < k) assert_true(fs_vec3_distance(point[k], point[l]) < 4e-5);
  }
  assert_int_equal(n_distinct, 30 * 9); /* per patch: 1 corner, 2 sides of 2 points, 4 inside */
  clear(&memory);
  sample_free(s);
}

static void test_names(void **state) {
  static const char *const cases[][2] = {{"pipe", "pipe"},
                                         {"torus", "Torus"},
                                         {"t", "T"},
                                         {"3-way pipe", "_3_way_pipe"},
                                         {"Torus", "Torus"},
                                         {"", "Surface"},
                                         {"na\xc3\xafve", "na__ve"},
                                         {"mesh2", "Mesh2"},
                                         {"image_width", "Image_width"},
                                         {"abcdefghijklmnopqrstuvwxyz0123456789", "abcdefghijklmnopqrstuvwxyz01234"}};
  static const char *const reserved[] = {"torus", "sphere", "mesh",   "box", "union",   "blob", "x",     "z",
                                         "u",     "pi",     "camera", "if",  "declare", "yes",  "clock", "aa_level"};
  char name[FS_POVRAY_NAME];
  (void)state;
  for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
    fs_povray_name(cases[k][0], name);
    assert_string_equal(name, cases[k][1]);
  }
  fs_povray_name(NULL, name);
  assert_string_equal(name, "Surface");
  for (size_t k = 0; k < sizeof reserved / sizeof *reserved; k++) assert_true(fs_povray_is_reserved(reserved[k]));
  assert_false(fs_povray_is_reserved("Torus"));
  assert_false(fs_povray_is_reserved("pipe"));
  assert_false(fs_povray_is_reserved("union blob"));
  assert_false(fs_povray_is_reserved(""));
}

/* Numbers carry a point in every locale of the machine that has a comma. */
static void test_locale(void **state) {
  static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "pl_PL.UTF-8", "ps_AF.UTF-8"};
  fs_surface *s = sample_torus(4, 4, NULL, 0);
  fs_context ctx = test_context();
  struct memory_output plain = {0}, other = {0};
  (void)state;
  assert_int_equal(export(&ctx, s, "a", 0, 0, 0, 1e-4, &plain), FS_OK);
  for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
    if (setlocale(LC_ALL, names[k]) == NULL) continue;
    assert_int_equal(export(&ctx, s, "a", 0, 0, 0, 1e-4, &other), FS_OK);
    assert_string_equal(plain.file[0].text, other.file[0].text);
    assert_string_equal(plain.file[1].text, other.file[1].text);
    clear(&other);
  }
  setlocale(LC_ALL, "C");
  clear(&plain);
  sample_free(s);
}

static void test_refusals(void **state) {
  fs_surface *s = sample_torus(4, 4, some, 0.01), none = {0};
  fs_context ctx = test_context();
  struct memory_output memory = {0};
  (void)state;
  assert_int_equal(export(&ctx, NULL, "a", 0, 0, 0, 1e-4, &memory), FS_ERR_ARGUMENT);
  assert_int_equal(export(&ctx, &none, "a", 0, 0, 0, 1e-4, &memory), FS_ERR_ARGUMENT);
  assert_int_equal(export(&ctx, s, "a", 5, 0, 0, 1e-4, &memory), FS_ERR_ARGUMENT);
  assert_int_equal(export(&ctx, s, "a", 0, 0, 9, 1e-4, &memory), FS_ERR_ARGUMENT);
  assert_int_equal(export(&ctx, s, "a", 0, 0, 0, NAN, &memory), FS_ERR_ARGUMENT);
  assert_int_equal(export(&ctx, s, "a\nb", 0, 0, 0, 1e-4, &memory), FS_ERR_ARGUMENT);
  assert_int_equal(memory.n_files, 0);
  for (size_t after = 1; after < 20000; after += 4000) {
    memory.fail_after = after;
    assert_int_equal(export(&ctx, s, "a", 0, 0, 0, 1e-4, &memory), FS_ERR_IO);
    clear(&memory);
    memory.fail_after = after;
    assert_int_equal(export(&ctx, s, "a", 3, 1, 0, 1e-4, &memory), FS_ERR_IO);
    clear(&memory);
  }
  s->data[40] = INFINITY;
  assert_int_equal(export(&ctx, s, "a", 0, 0, 0, 1e-4, &memory), FS_ERR_NUMERIC);
  assert_non_null(strstr(ctx.message, "patch 0"));
  clear(&memory);
  for (size_t k = 0; k < s->n_data; k++) s->data[k] = 1;
  assert_int_equal(export(&ctx, s, "a", 0, 0, 0, 1e-4, &memory), FS_ERR_NUMERIC);
  clear(&memory);
  sample_free(s);
}

static void test_memory(void **state) {
  fs_surface *s = sample_torus(4, 4, some, 0.05);
  (void)state;
  for (int scene = 0; scene < 4; scene += 3)
    for (int64_t n = 1;; n++) {
      struct test_memory counter = {.fail_at = n};
      fs_context ctx = test_memory_context(&counter);
      struct memory_output memory = {0};
      fs_status status = export(&ctx, s, "a", scene, 0, 2, 1e-9, &memory);
      clear(&memory);
      assert_int_equal(counter.n_live, 0);
      if (status == FS_OK) {
        assert_true(n > 6);
        break;
      }
      assert_int_equal(status, FS_ERR_MEMORY);
    }
  /* a tolerance that the steps cannot reach is said */
  struct test_memory counter = {0};
  fs_context ctx = test_memory_context(&counter);
  struct memory_output memory = {0};
  assert_int_equal(export(&ctx, s, "a", 0, 0, 1, 1e-9, &memory), FS_OK);
  assert_int_equal(counter.n_notes, 1);
  assert_non_null(strstr(counter.note, "tolerance"));
  clear(&memory);
  sample_free(s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_counts),
      cmocka_unit_test(test_scenes),
      cmocka_unit_test(test_mesh2),
      cmocka_unit_test(test_shared_points),
      cmocka_unit_test(test_printed_corners),
      cmocka_unit_test(test_names),
      cmocka_unit_test(test_locale),
      cmocka_unit_test(test_refusals),
      cmocka_unit_test(test_memory),
      cmocka_unit_test(test_parameters),
      cmocka_unit_test(test_turn),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
