/* SPDX-License-Identifier: MIT */
/* Single role: one file in memory through its reader, with everything checked that holds for any bytes. */
#include "read_one.h"
#include "fairsurf/space.h"
#include "mesh/cap_json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A face of three 1-byte indices is the dearest: some 100 bytes of mesh and work space for 4 bytes of file. */
enum { MOST_PER_BYTE = 32, MOST_BESIDE = 8192 };
/* A byte of a compressed file may stand for as many as 64 triangles of 256 bytes, and no more. */
enum { MOST_PER_COMPRESSED_BYTE = 64 * 256 };

static void require(bool holds, const char *promise, const fs_context *ctx) {
  if (holds) return;
  fprintf(stderr, "broken: %s (message: %s)\n", promise, ctx->message);
  abort();
}

/* The mesh and what the file says besides, from a copy of just that size. Coefficients may fit the mesh or not. */
static fs_status read_mesh(fs_context *ctx, const char *extension, const char *bytes, size_t size, fs_mesh **mesh) {
  fs_mesh_notes notes = {0};
  char *copy = malloc(size > 0 ? size : 1);
  if (size > 0) memcpy(copy, bytes, size);
  fs_status status = fs_mesh_parse_notes(ctx, extension, copy, size, mesh, &notes);
  free(copy);
  if (status != FS_OK) return status;
  if (notes.caps != NULL) {
    fs_status fits = fs_space_check_caps(ctx, *mesh, notes.caps);
    require(fits == FS_OK || fits == FS_ERR_FORMAT, "coefficients fit or not", ctx);
  }
  fs_mesh_notes_clear(ctx, &notes);
  return FS_OK;
}

static fs_status read_caps_file(fs_context *ctx, const char *bytes, size_t size) {
  fs_caps_file file = {0};
  char *copy = malloc(size > 0 ? size : 1);
  if (size > 0) memcpy(copy, bytes, size);
  fs_status status = fs_caps_file_parse(ctx, copy, size, &file);
  free(copy);
  fs_cap_notes_free(ctx, file.notes);
  return status;
}

fs_status read_one(const char *extension, const char *bytes, size_t size) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_mesh marker, *mesh = &marker;
  bool is_caps_file = strcmp(extension, CAPS_FILE) == 0;
  fs_status status = is_caps_file ? read_caps_file(&ctx, bytes, size) : read_mesh(&ctx, extension, bytes, size, &mesh);
  size_t most = strcmp(extension, "drc") == 0 ? MOST_PER_COMPRESSED_BYTE : MOST_PER_BYTE;
  require(memory.peak_bytes <= most * size + MOST_BESIDE, "memory is a small multiple of the file", &ctx);
  if (status == FS_OK && !is_caps_file) {
    require(fs_mesh_validate(&ctx, mesh) == FS_OK, "what is read is a valid mesh", &ctx);
    fs_mesh_free(&ctx, mesh);
  } else if (status != FS_OK) {
    require(ctx.message[0] != '\0', "a failure has a sentence", &ctx);
    require(mesh == &marker, "a failure leaves the output alone", &ctx);
    require(status == FS_ERR_FORMAT || status == FS_ERR_TOPOLOGY, "bytes alone cause no other status", &ctx);
  }
  require(memory.n_live == 0, "nothing leaks", &ctx);
  return status;
}
