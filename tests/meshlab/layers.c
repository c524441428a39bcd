/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plugin's C without MeshLab: polygons from triangles with faux edges, sound or not, and back; filters on layers, also where
   they refuse or are stopped; layers in files. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "formats.h"
#include "support.h"

/* ---- faux edges ------------------------------------------------------------------------------------------------------- */

static void expect_faces(const polygon_list *p, int32_t n, const int32_t *size) {
  assert_int_equal(p->n_faces, n);
  for (int32_t f = 0; f < n; f++) assert_int_equal(p->face_start[f + 1] - p->face_start[f], size[f]);
}

static polygon_list join(int32_t n_vertices, int32_t n, const int32_t *triangle, const uint8_t *faux) {
  fs_context ctx = test_context();
  polygon_list p = {.n_vertices = n_vertices};
  assert_int_equal(polygons_join(&ctx, n, triangle, faux, &p), FS_OK);
  return p;
}

/* A quadrilateral and, beside it, a triangle; its corners keep their order. */
static void joins_a_pair(void **state) {
  polygon_list p = join(5, 3, (const int32_t[]){0, 1, 2, 0, 2, 3, 2, 1, 4}, (const uint8_t[]){4, 1, 0});
  (void)state;
  expect_faces(&p, 2, (const int32_t[]){4, 3});
  for (int32_t i = 0; i < 4; i++) assert_int_equal(p.corner[i], i);
  polygons_clear(&p);
}

/* Bits that no sound polygon has: on one side only; on three sides of one edge; running the same way; all around a vertex, so
   that it would lie inside; such that a vertex would be visited twice. All of them stay triangles. */
static void stale_bits_leave_triangles(void **state) {
  static const struct {
    int32_t n_vertices, n;
    int32_t triangle[18];
    uint8_t faux[6];
  } cases[] = {
      {4, 2, {0, 1, 2, 0, 2, 3}, {4, 0}}, {5, 3, {0, 1, 2, 0, 2, 3, 0, 2, 4}, {4, 1, 1}},
      {4, 2, {0, 1, 2, 2, 0, 3}, {4, 1}}, {4, 3, {0, 1, 2, 0, 2, 3, 0, 3, 1}, {5, 5, 5}},
      {4, 2, {0, 1, 2, 2, 1, 0}, {7, 7}}, {5, 4, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1}, {4, 5, 5, 1}},
  };
  (void)state;
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    polygon_list p = join(cases[i].n_vertices, cases[i].n, cases[i].triangle, cases[i].faux);
    expect_faces(&p, cases[i].n, (const int32_t[]){3, 3, 3, 3, 3, 3});
    polygons_clear(&p);
  }
}

/* Random bits on random triangles: whatever comes out has every triangle once, by the count of corners. */
static void any_bits_end(void **state) {
  uint64_t seed = 7;
  (void)state;
  for (int round = 0; round < 300; round++) {
    int32_t n = test_random_integer(&seed, 0, 40), triangle[120], n_vertices = test_random_integer(&seed, 3, 12);
    uint8_t faux[40];
    polygon_list p;
    for (int32_t i = 0; i < 3 * n; i++) triangle[i] = test_random_integer(&seed, 0, n_vertices - 1);
    for (int32_t i = 0; i < n; i++) faux[i] = (uint8_t)test_random_integer(&seed, 0, 255);
    p = join(n_vertices, n, triangle, faux);
    assert_int_equal(p.face_start[p.n_faces] - 2 * p.n_faces, n);
    polygons_clear(&p);
  }
}

static void take_mesh(const fs_mesh *mesh, polygon_list *p) {
  fs_context ctx = test_context();
  outcome o = {0};
  assert_int_equal(outcome_take_mesh(&ctx, mesh, &o), FS_OK);
  *p = o.polygons;
}

/* Polygons of 3 to 24 corners, split and joined again, are the same but for the corner where they begin. */
static void comes_back(void **state) {
  fs_context ctx = test_context();
  (void)state;
  for (int32_t k = 3; k <= 24; k++) {
    fs_mesh *mesh = test_prism(k);
    polygon_list p, q;
    int32_t n, *triangle;
    uint8_t *faux;
    take_mesh(mesh, &p);
    assert_int_equal(polygons_split(&ctx, &p, &n, &triangle, &faux), FS_OK);
    q = join(p.n_vertices, n, triangle, faux);
    assert_int_equal(q.n_faces, p.n_faces);
    for (int32_t f = 0; f < p.n_faces; f++) {
      int32_t size = p.face_start[f + 1] - p.face_start[f], turn = 0;
      const int32_t *a = p.corner + p.face_start[f], *b = q.corner + q.face_start[f];
      assert_int_equal(q.face_start[f + 1] - q.face_start[f], size);
      while (turn < size && b[turn] != a[0]) turn++;
      for (int32_t i = 0; i < size; i++) assert_int_equal(a[i], b[(i + turn) % size]);
    }
    polygons_clear(&p);
    polygons_clear(&q);
    free(triangle);
    free(faux);
    fs_mesh_free(&ctx, mesh);
  }
}

/* ---- filters ---------------------------------------------------------------------------------------------------------- */

static layer layer_of(fs_mesh *mesh, bool is_selected) {
  fs_context ctx = test_context();
  layer l = {0};
  take_mesh(mesh, &l.polygons);
  l.selected = calloc((size_t)mesh->n_vertices, sizeof *l.selected);
  for (int32_t v = 0; v < mesh->n_vertices; v++) l.selected[v] = is_selected;
  l.n_selected = is_selected ? mesh->n_vertices : 0;
  fs_mesh_free(&ctx, mesh);
  return l;
}

/* The value of a filter that has the name, which may stand after others. */
static double value_of(const outcome *o, const char *name) {
  for (int32_t i = 0; i < o->n_values; i++)
    if (strcmp(o->value[i].name, name) == 0) return o->value[i].value;
  fail_msg("no value %s", name);
  return NAN;
}

static void initial_values(const filter *f, double *value) {
  for (int32_t i = 0; f->params[i].name != NULL; i++) value[i] = f->params[i].initial;
}

static double *parameter(const filter *f, double *value, const char *name) {
  for (int32_t i = 0; f->params[i].name != NULL; i++)
    if (strcmp(f->params[i].name, name) == 0) return &value[i];
  fail_msg("no parameter %s", name);
  return value;
}

/* Corners of a cube after one Catmull-Clark step are at 5/9 [Catmull Clark 1978]. */
static void refines_a_cube(void **state) {
  fs_context ctx = test_context();
  layer l = layer_of(test_cube(), false);
  outcome o = {0};
  double value[MAX_FILTER_PARAMS];
  (void)state;
  initial_values(&filter_refine, value);
  *parameter(&filter_refine, value, "scheme") = 1;
  assert_int_equal(filter_run(&ctx, &filter_refine, &l, value, &o), FS_OK);
  assert_int_equal(o.polygons.n_vertices, 26);
  assert_int_equal(o.polygons.n_faces, 24);
  for (int32_t v = 0; v < 8; v++) assert_true(fabs(fabs(o.polygons.position[v].x) - 5.0 / 9) < 1e-15);
  outcome_clear(&o);
  layer_clear(&l);
}

/* All choices are offered and nothing else: the number behind the last is refused, and so is what is no number. */
static void refuses_values(void **state) {
  layer l = layer_of(test_cube(), false);
  (void)state;
  for (int i = 0; filters[i] != NULL; i++)
    for (int32_t k = 0; filters[i]->params[k].name != NULL; k++) {
      static const double bad[] = {-1, 1e9, NAN};
      const filter_param *p = &filters[i]->params[k];
      for (int b = 0; b < 3; b++) {
        fs_context ctx = test_context();
        outcome o = {0};
        double value[MAX_FILTER_PARAMS];
        initial_values(filters[i], value);
        value[k] = bad[b];
        assert_int_equal(filter_run(&ctx, filters[i], &l, value, &o), FS_ERR_ARGUMENT);
        assert_non_null(strstr(ctx.message, p->name));
        assert_null(o.polygons.position);
      }
    }
  layer_clear(&l);
}

static bool stop_at_once(void *user, const char *stage, double fraction) {
  (void)user, (void)stage, (void)fraction;
  return false;
}

static void can_be_stopped(void **state) {
  fs_context ctx = test_context();
  layer l = layer_of(test_star(5, 4), false);
  outcome o = {0};
  double value[MAX_FILTER_PARAMS];
  (void)state;
  ctx.progress = stop_at_once;
  initial_values(&filter_fair, value);
  assert_int_equal(filter_run(&ctx, &filter_fair, &l, value, &o), FS_ERR_CANCELLED);
  assert_null(o.polygons.position);
  fs_context_clear(&ctx);
  layer_clear(&l);
}

/* More fixed rings leave fewer points; all of a star of 5 rings, none. */
static void rings_are_fixed(void **state) {
  double free_points[2];
  (void)state;
  for (int i = 0; i < 2; i++) {
    fs_context ctx = test_context();
    layer l = layer_of(test_star(5, 5), false);
    outcome o = {0};
    double value[MAX_FILTER_PARAMS];
    initial_values(&filter_fair, value);
    *parameter(&filter_fair, value, "rings") = i == 0 ? 3 : 6;
    *parameter(&filter_fair, value, "caps") = 1;
    assert_int_equal(filter_run(&ctx, &filter_fair, &l, value, &o), FS_OK);
    free_points[i] = value_of(&o, "free_points");
    assert_true(o.polygons.n_faces > 0);
    outcome_clear(&o);
    fs_context_clear(&ctx);
    layer_clear(&l);
  }
  assert_true(free_points[0] > 0);
  assert_true(free_points[1] == 0);
}

static void remove_first_face(polygon_list *p) {
  int32_t size = p->face_start[1];
  memmove(p->corner, p->corner + size, (size_t)(p->face_start[p->n_faces] - size) * sizeof *p->corner);
  p->n_faces--;
  for (int32_t f = 0; f <= p->n_faces; f++) p->face_start[f] = p->face_start[f + 1] - size;
}

/* A hole of n edges, filled: one vertex of valence n in a ring of n quadrilaterals. */
static void fills_holes(void **state) {
  (void)state;
  for (int32_t n = 3; n <= 24; n++) {
    fs_context ctx = test_context();
    layer l = layer_of(test_prism(n), true);
    fs_mesh *mesh = NULL;
    outcome o = {0};
    double value[MAX_FILTER_PARAMS];
    int32_t n_special = 0;
    initial_values(&filter_fill_hole, value);
    remove_first_face(&l.polygons);
    assert_int_equal(filter_run(&ctx, &filter_fill_hole, &l, value, &o), FS_OK);
    assert_int_equal((int)value_of(&o, "loops"), 1);
    assert_int_equal(fs_mesh_create(&ctx, o.polygons.n_vertices, o.polygons.position, o.polygons.n_faces,
                                    o.polygons.face_start, o.polygons.corner, &mesh),
                     FS_OK);
    for (int32_t v = 0; v < mesh->n_vertices; v++) {
      assert_false(fs_mesh_is_boundary(mesh, v));
      n_special += fs_mesh_valence(mesh, v) == n;
    }
    assert_true(n_special >= 2);
    fs_mesh_free(&ctx, mesh);
    outcome_clear(&o);
    layer_clear(&l);
  }
}

/* ---- formats ---------------------------------------------------------------------------------------------------------- */

/* Writes the layer into a file of a new folder, whose path goes to path; the caller removes both. */
static void write_layer(const fs_exporter *e, const layer *l, double what, char path[64]) {
  fs_context ctx = test_context();
  filter_param params[MAX_FORMAT_PARAMS];
  double value[MAX_FORMAT_PARAMS] = {0};
  strcpy(path, "fairsurf-layer-XXXXXX");
  assert_non_null(mkdtemp(path));
  sprintf(path + strlen(path), "/part.%s", e->extension);
  format_list_params(e, params);
  for (int32_t i = 0; params[i].name != NULL; i++) value[i] = params[i].initial;
  value[0] = what;
  if (format_write(&ctx, e, l, value, path) != FS_OK) fail_msg("%s: %s", path, ctx.message);
  fs_context_clear(&ctx);
}

static void remove_layer(const char *path) {
  char folder[64], other[80];
  strcpy(folder, path);
  *strrchr(folder, '/') = '\0';
  sprintf(other, "%s/part.inc", folder);
  unlink(other);
  assert_int_equal(unlink(path), 0);
  assert_int_equal(rmdir(folder), 0);
}

/* All formats take a prism with its hexagons, as a control net and as it is; Draco keeps the polygons. */
static void writes_all_formats(void **state) {
  const fs_exporter *e;
  (void)state;
  for (int32_t i = 0; (e = format_exporter(i)) != NULL; i++)
    for (int what = 0; what < 2; what++) {
      layer l = layer_of(test_prism(6), false);
      char path[64];
      write_layer(e, &l, what, path);
      if (what == 1 && strcmp(e->extension, "drc") == 0) {
        fs_context ctx = test_context();
        fs_mesh *mesh = NULL;
        assert_int_equal(fs_mesh_read(&ctx, path, &mesh), FS_OK);
        assert_int_equal(mesh->n_faces, 8);
        assert_int_equal(mesh->n_halfedges, 36);
        fs_mesh_free(&ctx, mesh);
      }
      remove_layer(path);
      layer_clear(&l);
    }
}

/* A cube as it is, written as STEP and read back: six patches with the area and the volume of [-1, 1]^3. */
static void keeps_polygons_as_patches(void **state) {
  fs_context ctx = test_context();
  layer l = layer_of(test_cube(), false);
  fs_surface *surface = NULL;
  fs_shape shape;
  char path[64];
  (void)state;
  write_layer(format_find("STEP"), &l, 1, path);
  assert_int_equal(fs_surface_read(&ctx, path, &surface), FS_OK);
  assert_int_equal(surface->n_patches, 6);
  assert_int_equal(fs_shape_measure(&ctx, surface, 0, &shape), FS_OK);
  assert_true(fabs(shape.area - 24) < 1e-9);
  assert_true(fabs(shape.volume - 8) < 1e-9);
  fs_surface_free(&ctx, surface);
  remove_layer(path);
  layer_clear(&l);
}

static void refuses_options(void **state) {
  fs_context ctx = test_context();
  layer l = layer_of(test_cube(), false);
  double value[MAX_FORMAT_PARAMS] = {0};
  (void)state;
  value[0] = 2;
  assert_int_equal(format_write(&ctx, format_find("scad"), &l, value, "never.scad"), FS_ERR_ARGUMENT);
  assert_int_not_equal(access("never.scad", F_OK), 0);
  assert_null(format_find("xyz"));
  layer_clear(&l);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(joins_a_pair),
      cmocka_unit_test(stale_bits_leave_triangles),
      cmocka_unit_test(any_bits_end),
      cmocka_unit_test(comes_back),
      cmocka_unit_test(refines_a_cube),
      cmocka_unit_test(refuses_values),
      cmocka_unit_test(can_be_stopped),
      cmocka_unit_test(rings_are_fixed),
      cmocka_unit_test(fills_holes),
      cmocka_unit_test(writes_all_formats),
      cmocka_unit_test(keeps_polygons_as_patches),
      cmocka_unit_test(refuses_options),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
