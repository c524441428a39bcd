/* SPDX-License-Identifier: MIT */
/* Every allocation of the constructions and of the readers of patches fails once: the status is that of memory, nothing
   leaks, outputs stay as they were. Random changes of files are refused or read, never more. */
#include <fairsurf/construct.h>
#include <fairsurf/construct_gap.h>
#include <fairsurf/construct_junction.h>
#include <fairsurf/construct_stacho.h>
#include "../support/support.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const char splines[] =
    "fairsurf-splines 1\n"
    "patch q\ndegree 2 3\nknots 0 0 0 1 1 1\nknots 0 0 0 0 0.4 1 1 1 1\npoints\n"
    "0 0 0 1 0 0 2 0 0.1\n0 1 0 1 1 0 2 1 0\n0 2 0 1 2 0 2 2 0\n0 3 0 1 3 0 2 3 0.2\n0 4 0 1 4 0 2 4 0\n"
    "patch r\ndegree 1 3\npoints\n4 0 0 5 0 1\n4 1 0 5 1 0\n4 2 0.5 5 2 0\n4 4 0 5 4 0\n"
    "patch aux\ndegree 3 2\npoints\n0 0 0 1 0 0 2 0 0 3 0 0.5\n0 1 0 1 1 0 2 1 0 3 1 0\n"
    "0 2 0 1 2 0 2 2 0.3 3 2 0\n"
    "function beta1-a\ndegree 1\nvalues 0.1 0.2\n";
static const char bezierview[] =
    "Group 0 all\n4\n1\n0 0 0 0 1 0 1 0 0 1 1 0\n3\n2\n5 0 0 6 0 0 7 0 0 5 1 0 6 1 0 5 2 0\n"
    "1\n3 1\n9 0 0\n10 0 0\n9 1 0\n3 0 1 2\n";
static const char mesh_text[] =
    "v 0 0 0\nv 1 0 0.1\nv 1 1 0\nv 0 1 0.2\nv 0.5 0.4 0.3\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

typedef fs_status (*job)(fs_context *ctx, const char *text, fs_surface **surface);

static fs_status read_bezierview(fs_context *ctx, const char *text, fs_surface **surface) {
  return fs_surface_parse(ctx, "bv", text, strlen(text), surface);
}

static fs_status read_splines(fs_context *ctx, const char *text, fs_surface **surface) {
  return fs_surface_parse(ctx, "spl", text, strlen(text), surface);
}

static fs_status construct(fs_context *ctx, const char *name, const char *text, fs_surface **surface) {
  const fs_construction *construction = fs_construction_find(name);
  fs_construction_input input = {.mesh = NULL};
  fs_splines *list = NULL;
  fs_mesh *mesh = NULL;
  fs_status status = construction->takes == FS_TAKES_MESH ? fs_mesh_parse(ctx, "obj", text, strlen(text), &mesh)
                                                          : fs_splines_parse(ctx, text, strlen(text), &list);
  input.mesh = mesh, input.splines = list;
  if (status == FS_OK) status = fs_construct(ctx, construction, &input, NULL, surface);
  fs_mesh_free(ctx, mesh);
  fs_splines_free(ctx, list);
  return status;
}

static fs_status run_stacho(fs_context *ctx, const char *text, fs_surface **surface) {
  return construct(ctx, "stacho", text, surface);
}
static fs_status run_graph(fs_context *ctx, const char *text, fs_surface **surface) {
  return construct(ctx, "stacho-graph", text, surface);
}
static fs_status run_junction(fs_context *ctx, const char *text, fs_surface **surface) {
  return construct(ctx, "junction", text, surface);
}
static fs_status run_gap(fs_context *ctx, const char *text, fs_surface **surface) {
  return construct(ctx, "gap", text, surface);
}

static const struct {
  const char *name, *text;
  job run;
} jobs[] = {{"bv", bezierview, read_bezierview}, {"spl", splines, read_splines},      {"stacho", mesh_text, run_stacho},
            {"graph", mesh_text, run_graph},     {"junction", splines, run_junction}, {"gap", splines, run_gap}};
enum { N_JOBS = sizeof jobs / sizeof *jobs };

static void test_every_allocation(void **state) {
  (void)state;
  for (int j = 0; j < N_JOBS; j++) {
    fs_status status = FS_ERR_MEMORY;
    int64_t n = 0;
    while (status != FS_OK) {
      struct test_memory memory = {.fail_at = ++n};
      fs_context ctx = test_memory_context(&memory);
      fs_surface marker, *surface = &marker;
      status = jobs[j].run(&ctx, jobs[j].text, &surface);
      if (status == FS_OK)
        fs_surface_free(&ctx, surface);
      else
        assert_ptr_equal(surface, &marker);
      if (status != FS_OK && status != FS_ERR_MEMORY)
        fail_msg("%s, allocation %d: %s", jobs[j].name, (int)n, ctx.message);
      assert_int_equal(memory.n_live, 0);
    }
    print_message("%s: %d allocations\n", jobs[j].name, (int)n - 1);
    assert_true(n > 5);
  }
}

static void test_changed_files(void **state) {
  static const char letters[] = "0123456789.-+e \n#abcpkv";
  uint64_t seed = 1;
  (void)state;
  for (int k = 0; k < 6000; k++) {
    int j = k % N_JOBS, n_changes = test_random_integer(&seed, 1, 4);
    struct test_memory memory = {0};
    fs_context ctx = test_memory_context(&memory);
    fs_surface *surface = NULL;
    char *text = strdup(jobs[j].text);
    for (int i = 0; i < n_changes; i++)
      text[test_random_integer(&seed, 0, (int32_t)strlen(text) - 1)] =
          letters[test_random_integer(&seed, 0, sizeof letters - 2)];
    fs_status status = jobs[j].run(&ctx, text, &surface);
    if (status == FS_OK) {
      assert_int_equal(fs_surface_validate(&ctx, surface), FS_OK);
      fs_surface_free(&ctx, surface);
    } else {
      assert_true(ctx.message[0] != '\0' && status != FS_ERR_MEMORY);
    }
    assert_int_equal(memory.n_live, 0);
    free(text);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_allocation), cmocka_unit_test(test_changed_files)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
