/* SPDX-License-Identifier: MIT */
/* What the rooms share privately: failing with a sentence, allocation through the context, parallel loops. */
#ifndef FS_BASE_BASE_H
#define FS_BASE_BASE_H

#include <fairsurf/base.h>

/* Evaluates a call; on failure leaves through the label done, with the status in the variable status. */
#define FS_TRY(call)                \
  do {                              \
    status = (call);                \
    if (status != FS_OK) goto done; \
  } while (0)

/* Sets ctx->message (cut at its size) and returns status, so that "return fs_fail(…)" reads well. */
fs_status fs_fail(fs_context *ctx, fs_status status, const char *format, ...) FS_PRINTF(3, 4);

/* Hands a sentence to ctx->note, where there is one. */
void fs_note(fs_context *ctx, const char *format, ...) FS_PRINTF(2, 3);

/* Reports progress; FS_ERR_CANCELLED when the caller asked to stop. */
fs_status fs_progress(fs_context *ctx, const char *stage, double fraction);

/* Zeroed memory for count elements of size bytes, aligned to 64 bytes; count 0 gives a block that may be released.
   NULL and ctx->message on failure or when the product overflows. */
void *fs_allocate(fs_context *ctx, size_t count, size_t size);
void fs_release(fs_context *ctx, void *block); /* NULL is allowed */

/* pointer = zeroed array of count elements of its type, or leaves through done with FS_ERR_MEMORY. */
#define FS_ALLOC(ctx, pointer, count)                                   \
  do {                                                                  \
    (pointer) = fs_allocate((ctx), (size_t)(count), sizeof *(pointer)); \
    if ((pointer) == NULL) {                                            \
      status = FS_ERR_MEMORY;                                           \
      goto done;                                                        \
    }                                                                   \
  } while (0)

/* Calls body(user, begin, end, worker) on ranges that cover 0 .. n - 1, on up to ctx->n_threads threads (serial where
   built without threads). worker is in 0 .. fs_n_workers(ctx) - 1 and never runs two ranges at once. Ranges are cut the
   same way for any number of threads when every body depends on its indices only. The first status other than FS_OK is
   returned; bodies must not touch ctx. */
typedef fs_status (*fs_parallel_body)(void *user, int32_t begin, int32_t end, int32_t worker);
fs_status fs_parallel_for(fs_context *ctx, int32_t n, fs_parallel_body body, void *user);
int32_t fs_n_workers(const fs_context *ctx);

#endif
