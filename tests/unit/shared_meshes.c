/* SPDX-License-Identifier: MIT */
/* Single role: the counts of meshes from elsewhere against the table in meshes/README.md that lies beside them. */
#include "support.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

/* A line of the table: | file | V | F | faces by size | val in | val bd | comps | bd loops | genus | manifold | … */
enum { FILE_NAME, V, F, SIZES, INTERIOR, BOUNDARY, COMPONENTS, LOOPS, GENUS, MANIFOLD, BREAKS, N_COLUMNS };

static bool split(char *line, char *column[N_COLUMNS]) {
  if (*line != '|') return false;
  for (int i = 0; i < N_COLUMNS; i++) {
    char *bar = strchr(line, '|'), *end;
    if (bar == NULL) return false;
    column[i] = bar + 1 + strspn(bar + 1, " ");
    end = strchr(column[i], '|');
    if (end == NULL) return false;
    line = end;
  }
  for (int i = 0; i < N_COLUMNS; i++) {
    size_t n = strcspn(column[i], "|");
    while (n > 0 && column[i][n - 1] == ' ') n--;
    column[i][n] = '\0';
  }
  return strcmp(column[MANIFOLD], "yes") == 0 || strcmp(column[MANIFOLD], "NO") == 0;
}

/* "3:8 4:14" or "-" against a histogram: these and no others. */
static void assert_histogram(const char *text, const int32_t *histogram) {
  int32_t n[26] = {0}, bin, count, used;
  while (sscanf(text, "%d:%d%n", &bin, &count, &used) == 2) {
    n[bin] = count;
    text += used;
  }
  assert_memory_equal(n, histogram, sizeof n);
}

static void check_counts(char *column[N_COLUMNS]) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_shared_mesh(column[FILE_NAME]);
  fs_mesh_summary s;
  print_message("%s\n", column[FILE_NAME]);
  assert_non_null(mesh);
  assert_int_equal(fs_mesh_validate(&ctx, mesh), FS_OK);
  assert_int_equal(fs_mesh_summarise(&ctx, mesh, &s), FS_OK);
  assert_int_equal(s.n_vertices, atoi(column[V]));
  assert_int_equal(s.n_faces, atoi(column[F]));
  assert_histogram(column[SIZES], s.face_size);
  assert_histogram(column[INTERIOR], s.valence_interior);
  assert_histogram(column[BOUNDARY], s.valence_boundary);
  assert_int_equal(s.n_components, atoi(column[COMPONENTS]));
  assert_int_equal(s.n_boundary_loops, atoi(column[LOOPS]));
  assert_int_equal(s.genus, atoi(column[GENUS]));
  fs_mesh_free(&ctx, mesh);
}

/* One sentence that names a vertex or a face. */
static void check_refusal(char *column[N_COLUMNS]) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_mesh *mesh = NULL;
  char relative[256], *bytes;
  size_t size;
  int32_t number;
  const char *element;
  snprintf(relative, sizeof relative, "meshes/%s.obj", column[FILE_NAME]);
  bytes = test_file(test_shared(relative), &size);
  assert_int_equal(fs_mesh_parse(&ctx, "obj", bytes, size, &mesh), FS_ERR_TOPOLOGY);
  free(bytes);
  print_message("%s: %s\n", column[FILE_NAME], ctx.message);
  assert_null(mesh);
  assert_int_equal(memory.n_live, 0);
  element = strpbrk(ctx.message, "0123456789");
  assert_true(element != NULL && sscanf(element, "%d", &number) == 1);
}

static void test_table(void **state) {
  char *text = *state, *line, *rest = text;
  int32_t n_manifold = 0, n_refused = 0;
  while ((line = strsep(&rest, "\n")) != NULL) {
    char *column[N_COLUMNS];
    if (!split(line, column)) continue;
    if (strcmp(column[MANIFOLD], "NO") == 0 || strstr(column[BREAKS], "isolated") != NULL) {
      check_refusal(column);
      n_refused++;
    } else {
      check_counts(column);
      n_manifold++;
    }
  }
  assert_true(n_manifold >= 20 && n_refused >= 5);
}

int main(void) {
  const char *path = test_shared("meshes/README.md");
  char *text;
  size_t size;
  int failed;
  if (path == NULL) return TEST_SKIPPED;
  text = test_file(path, &size);
  {
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_table, text)};
    failed = cmocka_run_group_tests(tests, NULL, NULL);
  }
  free(text);
  return failed;
}
