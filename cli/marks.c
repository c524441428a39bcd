/* SPDX-License-Identifier: MIT */
/* Single role: files that say which vertices stay. */
#include "cli.h"

#include <stdlib.h>
#include <string.h>

static void complain(fs_context *ctx, const char *path, int line, const char *what) {
  snprintf(ctx->message, sizeof ctx->message, "%s, line %d: %s", path, line, what);
}

fs_status read_marks(fs_context *ctx, const char *path, int32_t n_vertices, bool *marked) {
  char *bytes = NULL, *save = NULL;
  size_t size = 0;
  int line = 0;
  fs_status status = fs_file_read(ctx, path, &bytes, &size);
  if (status != FS_OK) return status;
  for (int32_t v = 0; v < n_vertices; v++) marked[v] = false;
  for (char *text = bytes; text != NULL && status == FS_OK; text = save) {
    char *end, word[16] = "fixed", *newline = strchr(text, '\n'), *hash;
    long vertex;
    line++;
    save = newline != NULL ? newline + 1 : NULL;
    if (newline != NULL) *newline = '\0';
    hash = strchr(text, '#');
    if (hash != NULL) *hash = '\0';
    text += strspn(text, " \t\r");
    if (*text == '\0') continue;
    vertex = strtol(text, &end, 10);
    if (end == text) {
      complain(ctx, path, line, "a vertex number is needed");
      status = FS_ERR_FORMAT;
    } else if (vertex < 0 || vertex >= n_vertices) {
      snprintf(ctx->message, sizeof ctx->message, "%s, line %d: vertex %ld, but the mesh has the vertices 0 to %d",
               path, line, vertex, n_vertices - 1);
      status = FS_ERR_FORMAT;
    } else {
      sscanf(end, "%15s", word);
      if (strcmp(word, "fixed") == 0) {
        marked[vertex] = true;
      } else if (strcmp(word, "free") != 0) {
        complain(ctx, path, line, "\"fixed\" or \"free\" is needed after the vertex");
        status = FS_ERR_FORMAT;
      }
    }
  }
  fs_file_free(ctx, bytes);
  return status;
}
