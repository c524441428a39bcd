/* SPDX-License-Identifier: MIT */
/* Single role: one file in memory through its reader, with everything checked that holds for any bytes. */
#include "read_one.h"

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

fs_status read_one(const char *extension, const char *bytes, size_t size) {
  struct test_memory memory = {0};
  fs_context ctx = test_memory_context(&memory);
  fs_mesh marker, *mesh = &marker;
  fs_status status = test_parse(&ctx, extension, bytes, size, &mesh);
  size_t most = strcmp(extension, "drc") == 0 ? MOST_PER_COMPRESSED_BYTE : MOST_PER_BYTE;
  require(memory.peak_bytes <= most * size + MOST_BESIDE, "memory is a small multiple of the file", &ctx);
  if (status == FS_OK) {
    require(fs_mesh_validate(&ctx, mesh) == FS_OK, "what is read is a valid mesh", &ctx);
    fs_mesh_free(&ctx, mesh);
  } else {
    require(ctx.message[0] != '\0', "a failure has a sentence", &ctx);
    require(mesh == &marker, "a failure leaves the output alone", &ctx);
    require(status == FS_ERR_FORMAT || status == FS_ERR_TOPOLOGY, "bytes alone cause no other status", &ctx);
  }
  require(memory.n_live == 0, "nothing leaks", &ctx);
  return status;
}
