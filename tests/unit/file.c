/* SPDX-License-Identifier: MIT */
/* Single role: tests of reading files and of outputs that appear under their names only when they are complete. */
#include "../support/support.h"

#include <fairsurf/file.h>

#include <stdarg.h>
#include <setjmp.h>
#include <cmocka.h>

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64];

/* A path in the folder of the test, in a static buffer each of four calls. */
static const char *in_folder(const char *name) {
  static char paths[4][512];
  static int32_t next;
  char *path = paths[next++ % 4];
  snprintf(path, sizeof paths[0], "%s/%s", folder, name);
  return path;
}

static int32_t n_entries(void) {
  DIR *directory = opendir(folder);
  int32_t n = 0;
  assert_non_null(directory);
  for (struct dirent *e; (e = readdir(directory)) != NULL;) n += strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..");
  closedir(directory);
  return n;
}

static int make_folder(void **state) {
  (void)state;
  snprintf(folder, sizeof folder, "/tmp/fairsurf-test-XXXXXX");
  return mkdtemp(folder) == NULL;
}

/* Empties the folder and removes it. */
static int remove_folder(void **state) {
  DIR *directory = opendir(folder);
  (void)state;
  for (struct dirent *e; directory != NULL && (e = readdir(directory)) != NULL;)
    if (unlink(in_folder(e->d_name)) != 0) rmdir(in_folder(e->d_name));
  if (directory != NULL) closedir(directory);
  return rmdir(folder);
}

static void put(const char *name, const char *text) {
  FILE *file = fopen(in_folder(name), "wb");
  assert_non_null(file);
  fputs(text, file);
  assert_int_equal(fclose(file), 0);
}

static void check_content(const char *name, const char *expected) {
  size_t size;
  char *text = test_file(in_folder(name), &size);
  assert_non_null(text);
  assert_int_equal(size, strlen(expected));
  assert_string_equal(text, expected);
  free(text);
}

static void check_read_refused(const char *path, const char *word) {
  fs_context ctx = test_context();
  char *bytes = NULL;
  size_t size = 7;
  assert_int_equal(fs_file_read(&ctx, path, &bytes, &size), FS_ERR_IO);
  assert_null(bytes);
  assert_int_equal(size, 7);
  if (strstr(ctx.message, word) == NULL) fail_msg("\"%s\" does not say \"%s\"", ctx.message, word);
}

static void test_read(void **state) {
  fs_context ctx = test_context();
  char *bytes, long_name[300];
  size_t size;
  (void)state;
  put("a.txt", "some text\n");
  assert_int_equal(fs_file_read(&ctx, in_folder("a.txt"), &bytes, &size), FS_OK);
  assert_int_equal(size, 10);
  assert_string_equal(bytes, "some text\n");
  fs_file_free(&ctx, bytes);
  put("empty", "");
  assert_int_equal(fs_file_read(&ctx, in_folder("empty"), &bytes, &size), FS_OK);
  assert_int_equal(size, 0);
  assert_string_equal(bytes, "");
  fs_file_free(&ctx, bytes);
  check_read_refused(in_folder("missing.obj"), "missing.obj: No such file");
  check_read_refused(folder, "directory");
  memset(long_name, 'x', sizeof long_name - 1);
  long_name[sizeof long_name - 1] = '\0';
  check_read_refused(long_name, "too long");
}

/* The size is not known before: the buffer has to grow. */
static void test_read_a_pipe(void **state) {
  enum { SIZE = 300000 };
  fs_context ctx = test_context();
  int ends[2];
  char *sent = malloc(SIZE), *bytes, path[32];
  size_t size;
  (void)state;
  for (int32_t i = 0; i < SIZE; i++) sent[i] = (char)(i * 7 % 251);
  assert_int_equal(pipe(ends), 0);
  if (fcntl(ends[1], F_SETPIPE_SZ, 1 << 20) < SIZE) skip();
  assert_int_equal(write(ends[1], sent, SIZE), SIZE);
  close(ends[1]);
  snprintf(path, sizeof path, "/dev/fd/%d", ends[0]);
  assert_int_equal(fs_file_read(&ctx, path, &bytes, &size), FS_OK);
  assert_int_equal(size, SIZE);
  assert_memory_equal(bytes, sent, SIZE);
  assert_int_equal(bytes[SIZE], 0);
  fs_file_free(&ctx, bytes);
  close(ends[0]);
  free(sent);
}

static void test_read_a_mesh(void **state) {
  static const char quad[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  fs_context ctx = test_context();
  fs_mesh *mesh = NULL;
  (void)state;
  put("Quad.OBJ", quad);
  assert_int_equal(fs_mesh_read(&ctx, in_folder("Quad.OBJ"), &mesh), FS_OK);
  assert_int_equal(mesh->n_faces, 1);
  fs_mesh_free(&ctx, mesh);
  mesh = NULL;
  put("quad.abc", quad);
  assert_int_equal(fs_mesh_read(&ctx, in_folder("quad.abc"), &mesh), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "quad.abc: "));
  assert_non_null(strstr(ctx.message, "ply"));
  put("quad", quad);
  assert_int_equal(fs_mesh_read(&ctx, in_folder("quad"), &mesh), FS_ERR_UNSUPPORTED);
  put("bad.obj", "v 0 0\nf 1 2 3\n");
  assert_int_equal(fs_mesh_read(&ctx, in_folder("bad.obj"), &mesh), FS_ERR_FORMAT);
  if (strstr(ctx.message, "bad.obj: line 1") == NULL) fail_msg("%s", ctx.message);
  assert_int_equal(fs_mesh_read(&ctx, in_folder("missing.obj"), &mesh), FS_ERR_IO);
  assert_null(mesh);
}

static void write_text(fs_context *ctx, const fs_output *output, const char *extension, const char *text) {
  fs_sink sink;
  if (output->open(output->user, extension, &sink) != FS_OK) fail_msg("%s", ctx->message);
  assert_int_equal(sink.write(sink.user, text, strlen(text)), FS_OK);
}

static void test_commit(void **state) {
  fs_context ctx = test_context();
  fs_files *files;
  fs_output output;
  struct stat info;
  mode_t mask = umask(027);
  (void)state;
  put("scene.inc", "old");
  assert_int_equal(fs_files_create(&ctx, in_folder("scene.Pov"), &files, &output), FS_OK);
  write_text(&ctx, &output, "inc", "object");
  write_text(&ctx, &output, "pov", "scene");
  assert_int_equal(access(in_folder("scene.Pov"), F_OK), -1); /* nothing under its name yet */
  check_content("scene.inc", "old");
  assert_int_equal(fs_files_commit(&ctx, files), FS_OK);
  umask(mask);
  check_content("scene.inc", "object");
  check_content("scene.Pov", "scene"); /* spelled as the caller does */
  assert_int_equal(n_entries(), 2);
  assert_int_equal(stat(in_folder("scene.inc"), &info), 0);
  assert_int_equal(info.st_mode & 0777, 0640);
}

/* Pieces around the size of the buffer, and beyond. */
static void test_large_writes(void **state) {
  static const size_t sizes[] = {1, 65535, 1, 65536, 65537, 10, 200000, 3};
  fs_context ctx = test_context();
  fs_files *files;
  fs_output output;
  fs_sink sink;
  char *sent = malloc(500000), *back;
  size_t total = 0, size;
  (void)state;
  for (int32_t i = 0; i < 500000; i++) sent[i] = (char)(i % 253);
  assert_int_equal(fs_files_create(&ctx, in_folder("large.bin"), &files, &output), FS_OK);
  assert_int_equal(output.open(output.user, "bin", &sink), FS_OK);
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    assert_int_equal(sink.write(sink.user, sent + total, sizes[i]), FS_OK);
    total += sizes[i];
  }
  assert_int_equal(fs_files_commit(&ctx, files), FS_OK);
  back = test_file(in_folder("large.bin"), &size);
  assert_int_equal(size, total);
  assert_memory_equal(back, sent, total);
  free(back);
  free(sent);
}

static void test_discard(void **state) {
  fs_context ctx = test_context();
  fs_files *files;
  fs_output output;
  (void)state;
  put("kept.obj", "old");
  assert_int_equal(fs_files_create(&ctx, in_folder("kept.obj"), &files, &output), FS_OK);
  write_text(&ctx, &output, "obj", "new");
  write_text(&ctx, &output, "mtl", "more");
  assert_int_equal(n_entries(), 3);
  fs_files_discard(&ctx, files);
  fs_files_discard(&ctx, NULL);
  assert_int_equal(n_entries(), 1);
  check_content("kept.obj", "old");
}

static void test_places_that_cannot_be_written(void **state) {
  fs_context ctx = test_context();
  fs_files *files = NULL;
  fs_output output;
  fs_sink sink;
  (void)state;
  assert_int_equal(fs_files_create(&ctx, "", &files, &output), FS_ERR_ARGUMENT);
  assert_int_equal(fs_files_create(&ctx, "/tmp/", &files, &output), FS_ERR_ARGUMENT);
  assert_null(files);
  assert_int_equal(fs_files_create(&ctx, in_folder("absent/a.obj"), &files, &output), FS_OK);
  assert_int_equal(output.open(output.user, "obj", &sink), FS_ERR_IO);
  assert_non_null(strstr(ctx.message, "absent/a.obj: No such file"));
  fs_files_discard(&ctx, files);
  assert_int_equal(mkdir(in_folder("taken.obj"), 0777), 0);
  assert_int_equal(fs_files_create(&ctx, in_folder("taken.obj"), &files, &output), FS_OK);
  assert_int_equal(output.open(output.user, "obj", &sink), FS_ERR_IO);
  fs_files_discard(&ctx, files);
  assert_int_equal(n_entries(), 1);
}

/* A folder takes the name after the file was opened. */
static void test_rename_fails(void **state) {
  fs_context ctx = test_context();
  fs_files *files;
  fs_output output;
  (void)state;
  assert_int_equal(fs_files_create(&ctx, in_folder("a.obj"), &files, &output), FS_OK);
  write_text(&ctx, &output, "obj", "text");
  assert_int_equal(mkdir(in_folder("a.obj"), 0777), 0);
  assert_int_equal(fs_files_commit(&ctx, files), FS_ERR_IO);
  assert_non_null(strstr(ctx.message, "a.obj"));
  assert_int_equal(n_entries(), 1);
}

/* A limit on the size of files stands for a full disk; the buffer makes it show at commit or at a later write. */
static void test_disk_is_full(void **state) {
  static char block[100000];
  fs_context ctx = test_context();
  struct rlimit old, tight;
  (void)state;
  signal(SIGXFSZ, SIG_IGN);
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
  put("a.obj", "old");
  for (int32_t late = 0; late < 2; late++) {
    fs_files *files;
    fs_output output;
    fs_sink sink;
    fs_status written, committed;
    assert_int_equal(fs_files_create(&ctx, in_folder("a.obj"), &files, &output), FS_OK);
    assert_int_equal(output.open(output.user, "obj", &sink), FS_OK);
    tight = old;
    tight.rlim_cur = 1000;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &tight), 0);
    written = sink.write(sink.user, block, late ? 5000 : sizeof block);
    committed = late ? fs_files_commit(&ctx, files) : FS_OK;
    if (!late) fs_files_discard(&ctx, files);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
    assert_int_equal(late ? committed : written, FS_ERR_IO);
    assert_non_null(strstr(ctx.message, "a.obj: File too large"));
    assert_int_equal(n_entries(), 1);
    check_content("a.obj", "old");
  }
}

static void test_export_to_a_path(void **state) {
  fs_context ctx = test_context();
  fs_mesh *mesh = test_cube(), *back = NULL;
  fs_model model = {.control = mesh};
  size_t size;
  char *text;
  (void)state;
  assert_int_equal(fs_export_file(&ctx, &model, NULL, in_folder("My.cube.OBJ")), FS_OK);
  assert_int_equal(n_entries(), 1);
  text = test_file(in_folder("My.cube.OBJ"), &size);
  assert_non_null(strstr(text, "\no My.cube\n"));
  free(text);
  assert_int_equal(fs_mesh_read(&ctx, in_folder("My.cube.OBJ"), &back), FS_OK);
  assert_memory_equal(back->position, mesh->position, 8 * sizeof(fs_vec3));
  fs_mesh_free(&ctx, back);
  assert_int_equal(fs_export_file(&ctx, &model, NULL, in_folder("cube.xyz")), FS_ERR_UNSUPPORTED);
  assert_non_null(strstr(ctx.message, "pov, obj, off, ply, stl"));
  assert_int_equal(fs_export_file(&ctx, &model, NULL, in_folder("cube")), FS_ERR_UNSUPPORTED);
  assert_int_equal(fs_export_file(&ctx, &model, NULL, in_folder("cube.stl")), FS_ERR_ARGUMENT);
  assert_int_equal(n_entries(), 1);
  fs_mesh_free(&ctx, mesh);
}

static void test_every_allocation_may_fail(void **state) {
  fs_mesh *mesh = test_cube();
  fs_model model = {.control = mesh};
  (void)state;
  for (int64_t n = 1;; n++) {
    struct test_memory memory = {.fail_at = n};
    fs_context ctx = test_memory_context(&memory);
    fs_mesh *back = NULL;
    fs_status status = fs_export_file(&ctx, &model, NULL, in_folder("cube.ply"));
    if (status == FS_OK) status = fs_mesh_read(&ctx, in_folder("cube.ply"), &back);
    if (status == FS_OK) fs_mesh_free(&ctx, back);
    assert_int_equal(memory.n_live, 0);
    assert_true(n_entries() <= 1); /* no temporary file stays */
    if (status == FS_OK) break;
    assert_int_equal(status, FS_ERR_MEMORY);
  }
  fs_mesh_free(&(fs_context){0}, mesh);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, make_folder, remove_folder)
  const struct CMUnitTest tests[] = {
      TEST(test_read),
      TEST(test_read_a_pipe),
      TEST(test_read_a_mesh),
      TEST(test_commit),
      TEST(test_large_writes),
      TEST(test_discard),
      TEST(test_places_that_cannot_be_written),
      TEST(test_rename_fails),
      TEST(test_disk_is_full),
      TEST(test_export_to_a_path),
      TEST(test_every_allocation_may_fail),
  };
#undef TEST
  return cmocka_run_group_tests(tests, NULL, NULL);
}
