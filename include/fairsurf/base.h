/* SPDX-License-Identifier: MIT */
/* What every room stands on: statuses, the context of a call, vectors, tunable numbers. */
#ifndef FAIRSURF_BASE_H
#define FAIRSURF_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define FS_API __attribute__((visibility("default")))
#define FS_PRINTF(string, first) __attribute__((format(printf, string, first)))
#else
#define FS_API
#define FS_PRINTF(string, first)
#endif

#define FS_STATUS_LIST(X)                                      \
  X(OK, "success")                                             \
  X(ERR_ARGUMENT, "an argument is outside its domain")         \
  X(ERR_MEMORY, "out of memory")                               \
  X(ERR_IO, "a file could not be read or written")             \
  X(ERR_FORMAT, "a file breaks the rules of its format")       \
  X(ERR_TOPOLOGY, "the mesh is not an oriented manifold")      \
  X(ERR_UNSUPPORTED, "nothing here handles this input")        \
  X(ERR_NUMERIC, "a factorisation or an iteration broke down") \
  X(ERR_CANCELLED, "the caller asked to stop")

/* Every function that can fail returns one of these, and leaves its outputs untouched unless it is FS_OK. */
typedef enum fs_status {
#define X(name, text) FS_##name,
  FS_STATUS_LIST(X)
#undef X
} fs_status;

enum { FS_NONE = -1 }; /* no vertex, no half-edge, no neighbour */

struct fs_caps;

/* What a call needs from its surroundings. All zero means defaults. One thread at a time may use a context. */
typedef struct fs_context {
  void *(*allocate)(void *user, size_t size);                       /* NULL: malloc */
  void (*release)(void *user, void *block);                         /* NULL: free */
  bool (*progress)(void *user, const char *stage, double fraction); /* fraction in [0, 1]; false cancels */
  void (*note)(void *user, const char *text); /* "refined once, because …": the library itself never prints */
  void *user;                                 /* handed to the four functions above */
  int32_t n_threads;                          /* 0: one */
  double max_bytes;                           /* that a factorisation may take; 0: what the system has available */
  struct fs_caps *caps; /* cap matrices by valence, made on demand, freed by fs_context_clear; spaces borrow them */
  char message[256];    /* why the last call failed, in one sentence */
} fs_context;

typedef struct fs_vec3 {
  double x, y, z;
} fs_vec3;

/* A tunable number of a functional, an exporter, …: described once for the command line, plugins and manual pages.
   Lists of them end with a NULL name. Where choices is not NULL the value is an index into it. */
typedef struct fs_param {
  const char *name, *summary;
  double initial, min, max;
  const char *const *choices; /* NULL: a number; {"no", "yes", NULL}: a switch; {"shaded", …, NULL}: one of these */
} fs_param;

FS_API const char *fs_version(void);                 /* "0.1.0" */
FS_API const char *fs_status_text(fs_status status); /* the sentence of FS_STATUS_LIST; never NULL */

/* Frees what calls have stored in the context (cap matrices). Spaces made with it must be gone by then. */
FS_API void fs_context_clear(fs_context *ctx);

#ifdef __cplusplus
}
#endif
#endif
