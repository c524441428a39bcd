/* SPDX-License-Identifier: MIT */
/* Single role: tests of the HTML exporter without a browser: text and base64, the net in the page bit by bit, and what it
   refuses. tests/web/ looks at the page itself. */
#include "memory_output.h"
#include "../support/support.h"

#include "html.h"

#include <fairsurf/space.h>

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

static void write_text(const char *text, memory_output *file) {
  fs_context ctx = test_context();
  fs_output output = memory_output_of(file);
  fs_writer writer;
  fs_writer_start(&writer, &ctx, &output, "html");
  fs_html_write_text(&writer, text);
  assert_int_equal(fs_writer_finish(&writer), FS_OK);
}

static void test_text_is_escaped_and_valid_utf8(void **state) {
  static const char *const pairs[][2] = {
      {"plain 'text'", "plain 'text'"},
      {"<b>&\"</b>", "&lt;b&gt;&amp;&quot;&lt;/b&gt;"},
      {"a\tb\nc\x7F", "a b c "},
      {"\xC3\x9F \xE6\x9B\xB2 \xF0\x9F\x99\x82", "\xC3\x9F \xE6\x9B\xB2 \xF0\x9F\x99\x82"},
      {"\xC3", "\xEF\xBF\xBD"},                                                 /* cut */
      {"\xE6\x9B<", "\xEF\xBF\xBD\xEF\xBF\xBD&lt;"},                            /* cut before markup */
      {"\xC0\xBC", "\xEF\xBF\xBD\xEF\xBF\xBD"},                                 /* overlong < */
      {"\xE0\x80\xBC", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"},                 /* overlong < */
      {"\xED\xA0\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"},                 /* surrogate */
      {"\xF4\x90\x80\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"}, /* above U+10FFFF */
      {"\xFF", "\xEF\xBF\xBD"},
  };
  (void)state;
  for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
    memory_output file = {0};
    write_text(pairs[i][0], &file);
    assert_string_equal(file.bytes, pairs[i][1]);
    free(file.bytes);
  }
}

/* The vectors of RFC 4648, section 10. */
static void test_base64_has_the_values_of_its_standard(void **state) {
  static const char *const pairs[][2] = {{"f", "Zg=="},        {"fo", "Zm8="},        {"foo", "Zm9v"},
                                         {"foob", "Zm9vYg=="}, {"fooba", "Zm9vYmE="}, {"foobar", "Zm9vYmFy"}};
  (void)state;
  for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
    fs_context ctx = test_context();
    memory_output file = {0};
    fs_output output = memory_output_of(&file);
    fs_writer writer;
    fs_base64 base64 = {0};
    fs_writer_start(&writer, &ctx, &output, "html");
    for (const char *c = pairs[i][0]; *c != '\0'; c++) fs_base64_uint8(&base64, &writer, (uint8_t)*c);
    fs_base64_finish(&base64, &writer);
    assert_int_equal(fs_writer_finish(&writer), FS_OK);
    assert_string_equal(file.bytes, pairs[i][1]);
    free(file.bytes);
  }
}

/* Bytes of a base64 text up to '<'; the caller frees. */
static unsigned char *decode(const char *text, size_t *size) {
  size_t n = strcspn(text, "<");
  unsigned char *bytes = malloc(n + 1);
  uint32_t bits = 0;
  int n_bits = 0;
  *size = 0;
  for (size_t i = 0; i < n && text[i] != '='; i++) {
    char c = text[i];
    int digit = c >= 'a' ? c - 'a' + 26 : c >= 'A' ? c - 'A' : c >= '0' ? c - '0' + 52 : c == '+' ? 62 : 63;
    bits = bits << 6 | (uint32_t)digit;
    n_bits += 6;
    if (n_bits < 8) continue;
    n_bits -= 8;
    bytes[(*size)++] = (unsigned char)(bits >> n_bits);
  }
  return bytes;
}

static fs_mesh *make_net(void) { return test_torus(8, 7, 3, 1); }

static fs_status export_page(fs_context *ctx, const fs_model *model, memory_output *file) {
  fs_output output = memory_output_of(file);
  return fs_export(ctx, model, fs_exporter_find("html"), NULL, &output);
}

static void test_page_holds_the_net_bit_by_bit(void **state) {
  fs_context ctx = test_context();
  uint64_t random = 5;
  fs_mesh *net = make_net();
  memory_output file = {0};
  fs_model model = {.name = "<net>", .control = net, .made_with = "\"quoted\""};
  const char *start, *at;
  unsigned char *bytes;
  size_t size, n_position = (size_t)net->n_vertices * 24, n_starts = ((size_t)net->n_faces + 1) * 4;
  (void)state;
  test_mesh_disturb(net, 0.01, &random);
  assert_int_equal(export_page(&ctx, &model, &file), FS_OK);
  assert_int_equal(file.n_opened, 1);
  assert_string_equal(file.extension, "html");
  assert_non_null(strstr(file.bytes, "<title>&lt;net&gt;</title>"));
  start = strstr(
      file.bytes,
      "id=\"net\" data-vertices=\"56\" data-faces=\"56\" data-corners=\"224\" data-caps=\"0\" data-offsets=\"0\" ");
  assert_non_null(start);
  assert_non_null(strstr(start, "data-made-with=\"&quot;quoted&quot;\">"));
  at = strstr(start, "\">") + 2;
  bytes = decode(at, &size);
  assert_int_equal(size, n_position + n_starts + 224 * 4);
  /* This machine is little-endian, as all that the tests run on. */
  assert_memory_equal(bytes, net->position, n_position);
  assert_memory_equal(bytes + n_position, net->face_start, n_starts);
  assert_memory_equal(bytes + n_position + n_starts, net->origin, 224 * 4);
  free(bytes);
  free(file.bytes);
  fs_mesh_free(&ctx, net);
}

/* Inner coefficients of caps stand behind the positions, and what they belong to at the end. */
static void test_page_holds_the_caps(void **state) {
  fs_context ctx = test_context();
  fs_mesh *net = test_star(5, 4);
  memory_output file = {0};
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  fs_cap_notes *caps = NULL;
  unsigned char *bytes;
  size_t size, n_position = (size_t)net->n_vertices * 24, n_offset = 101 * 24;
  int32_t cap[4];
  (void)state;
  assert_int_equal(fs_space_create_with(&ctx, net, &(fs_space_options){.caps = FS_CAPS_FULL}, &space), FS_OK);
  for (int32_t d = space->n_vertices; d < space->n_dofs; d++) space->start[d].z = 0.01 * (d % 7 - 3);
  assert_int_equal(fs_space_keep_caps(&ctx, net, space, space->start, &caps), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, space, space->start, &surface), FS_OK);
  fs_model model = {.name = "net", .control = net, .surface = surface};
  assert_int_equal(export_page(&ctx, &model, &file), FS_ERR_UNSUPPORTED); /* without the caps another surface */
  model.caps = caps;
  assert_int_equal(export_page(&ctx, &model, &file), FS_OK);
  assert_non_null(strstr(file.bytes, " data-caps=\"1\" data-offsets=\"101\" "));
  bytes = decode(strstr(strstr(file.bytes, " data-caps="), "\">") + 2, &size);
  assert_int_equal(size, n_position + n_offset + ((size_t)net->n_faces + 1 + (size_t)net->n_halfedges + 4) * 4);
  assert_memory_equal(bytes + n_position, space->start + net->n_vertices, n_offset);
  memcpy(cap, bytes + size - sizeof cap, sizeof cap);
  assert_true(cap[0] == 0 && cap[1] == caps->cap->spoke && cap[2] == 5 && cap[3] == 101);
  free(bytes);
  free(file.bytes);
  fs_cap_notes_free(&ctx, caps);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, net);
  fs_context_clear(&ctx);
}

/* The page knows the net only, so a surface of other dofs must not pass for it. */
static void test_only_surfaces_of_the_net_are_taken(void **state) {
  fs_context ctx = test_context();
  fs_mesh *net = make_net();
  memory_output file = {0};
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  (void)state;
  assert_int_equal(fs_space_create(&ctx, net, &space), FS_OK);
  assert_int_equal(fs_surface_create(&ctx, space, net->position, &surface), FS_OK);
  fs_model model = {.name = "net", .control = net, .surface = surface};
  assert_int_equal(export_page(&ctx, &model, &file), FS_OK);
  free(file.bytes);
  file = (memory_output){0};
  surface->data[17] += 1e-6;
  assert_int_equal(export_page(&ctx, &model, &file), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "not the surface of the model"));
  assert_int_equal(file.n_opened, 0);
  fs_surface_free(&ctx, surface);
  fs_space_free(&ctx, space);
  fs_mesh_free(&ctx, net);
}

static void test_nets_without_a_surface_are_refused(void **state) {
  fs_context ctx = test_context();
  fs_mesh *prism = test_prism(5);
  memory_output file = {0};
  fs_model model = {.name = "prism", .control = prism};
  (void)state;
  assert_int_equal(export_page(&ctx, &model, &file), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "face"));
  assert_int_equal(file.n_opened, 0);
  fs_mesh_free(&ctx, prism);
  model.control = NULL;
  assert_int_equal(export_page(&ctx, &model, &file), FS_ERR_ARGUMENT);
}

static fs_status refuse_write(void *user, const void *bytes, size_t size) {
  int32_t *left = user;
  (void)bytes, (void)size;
  return (*left)-- > 0 ? FS_OK : FS_ERR_IO;
}

static fs_status refuse_open(void *user, const char *extension, fs_sink *sink) {
  (void)extension;
  *sink = (fs_sink){refuse_write, user};
  return FS_OK;
}

static void test_outputs_that_fail_are_reported(void **state) {
  fs_context ctx = test_context();
  fs_mesh *net = make_net();
  fs_model model = {.name = "net", .control = net};
  (void)state;
  for (int32_t allowed = 0; allowed < 3; allowed++) {
    int32_t left = allowed;
    fs_output output = {refuse_open, &left};
    assert_int_equal(fs_export(&ctx, &model, fs_exporter_find("html"), NULL, &output), FS_ERR_IO);
    assert_int_equal(left, -1); /* and nothing more was written */
  }
  fs_mesh_free(&ctx, net);
}

static void test_memory_may_fail_anywhere(void **state) {
  fs_context plain = test_context();
  fs_mesh *net = make_net();
  fs_space *space = NULL;
  fs_surface *surface = NULL;
  int64_t n = 0;
  (void)state;
  assert_int_equal(fs_space_create(&plain, net, &space), FS_OK);
  assert_int_equal(fs_surface_create(&plain, space, net->position, &surface), FS_OK);
  fs_curves *curves = NULL;
  assert_int_equal(
      fs_plot_trace(&plain, fs_plot_find("sections"), surface, (const double[]){2, 0, 0, 0.1}, NULL, &curves), FS_OK);
  fs_model model = {.name = "net", .control = net, .surface = surface, .curves = curves};
  for (fs_status status = FS_ERR_MEMORY; status != FS_OK; n++) {
    struct test_memory memory = {.fail_at = n + 1};
    fs_context ctx = test_memory_context(&memory);
    memory_output file = {0};
    status = export_page(&ctx, &model, &file);
    assert_true(status == FS_OK || status == FS_ERR_MEMORY);
    assert_true(status == FS_OK || file.n_opened == 0);
    fs_context_clear(&ctx);
    assert_int_equal(memory.n_live, 0);
    free(file.bytes);
  }
  assert_true(n > 5);
  fs_curves_free(&plain, curves);
  fs_surface_free(&plain, surface);
  fs_space_free(&plain, space);
  fs_mesh_free(&plain, net);
}

/* One curve of three points beside the net: positions, lines, colours; positions lie a little above the outside. */
static void test_page_holds_curves(void **state) {
  fs_context ctx = test_context();
  fs_mesh *net = make_net();
  fs_curve_point point[3] = {{.position = {1, 2, 3}, .normal = {0, 0, 1}},
                             {.position = {2, 2, 3}, .normal = {0, 0, 1}},
                             {.position = {2, 3, 3}, .normal = {0, 0, 1}}};
  fs_surface_curve curve = {.n_points = 3};
  fs_curves curves = {.n_curves = 1, .n_points = 3, .curve = &curve, .point = point};
  fs_model model = {.name = "net", .control = net, .curves = &curves};
  memory_output file = {0};
  const int32_t line[4] = {0, 1, 1, 2};
  (void)state;
  assert_int_equal(export_page(&ctx, &model, &file), FS_OK);
  const char *start = strstr(file.bytes, "id=\"curves\" data-points=\"3\" data-lines=\"2\">");
  assert_non_null(start);
  size_t size;
  unsigned char *bytes = decode(strchr(start, '>') + 1, &size);
  assert_int_equal(size, 3 * 24 + 2 * 8 + 3 * 3);
  for (int i = 0; i < 3; i++) {
    fs_vec3 p;
    memcpy(&p, bytes + 24 * i, sizeof p);
    assert_true(p.x == point[i].position.x && p.y == point[i].position.y && p.z > 3 && p.z < 3.1);
  }
  assert_memory_equal(bytes + 72, line, sizeof line);
  free(bytes);
  free(file.bytes);
  fs_mesh_free(&ctx, net);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_text_is_escaped_and_valid_utf8),
      cmocka_unit_test(test_base64_has_the_values_of_its_standard),
      cmocka_unit_test(test_page_holds_the_net_bit_by_bit),
      cmocka_unit_test(test_page_holds_the_caps),
      cmocka_unit_test(test_page_holds_curves),
      cmocka_unit_test(test_only_surfaces_of_the_net_are_taken),
      cmocka_unit_test(test_nets_without_a_surface_are_refused),
      cmocka_unit_test(test_outputs_that_fail_are_reported),
      cmocka_unit_test(test_memory_may_fail_anywhere),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
