/* SPDX-License-Identifier: MIT */
/* Single role: the head of a Draco file, read before the library sees it, so that counts which the file cannot hold ask
   for no memory. Layout [Draco bitstream specification 2.2]: "DRACO", version major and minor, geometry type, method
   (one byte each), flags (two bytes), metadata where bit 15 of the flags is set, then the counts as varints: after a byte for
   the kind of traversal, vertices and faces (method 1, Edgebreaker); or faces and points (method 0, sequential). */
#include "mesh/draco_bridge.h"
#include "base/base.h"

#include <string.h>

enum { HEAD_SIZE = 11, MAJOR = 2, MINOR = 2, TYPE_MESH = 1, METHOD_SEQUENTIAL = 0, METHOD_EDGEBREAKER = 1 };
enum { METADATA_FLAG = 0x80, MAX_DEPTH = 8 };

typedef struct head {
  const unsigned char *at, *end;
} head;

static bool skip(head *h, uint64_t size) {
  if (size > (uint64_t)(h->end - h->at)) return false;
  h->at += size;
  return true;
}

/* Seven bits per byte, the lowest first; the eighth says that more follow. */
static bool read_varint(head *h, uint64_t *number) {
  *number = 0;
  for (int shift = 0; shift < 35 && h->at < h->end; shift += 7) {
    unsigned char byte = *h->at++;
    *number |= (uint64_t)(byte & 0x7f) << shift;
    if ((byte & 0x80) == 0) return true;
  }
  return false;
}

static bool skip_name(head *h) { return h->at < h->end && skip(h, (uint64_t)*h->at + 1); }

/* Entries (a name, a size, that many bytes), then further metadata with a name each. */
static bool skip_metadata(head *h, int depth) {
  uint64_t n, size;
  if (depth == MAX_DEPTH || !read_varint(h, &n)) return false;
  for (; n > 0; n--)
    if (!skip_name(h) || !read_varint(h, &size) || !skip(h, size)) return false;
  if (!read_varint(h, &n)) return false;
  for (; n > 0; n--)
    if (!skip_name(h) || !skip_metadata(h, depth + 1)) return false;
  return true;
}

static bool skip_all_metadata(head *h) {
  uint64_t n, id;
  if (!read_varint(h, &n)) return false;
  for (; n > 0; n--)
    if (!read_varint(h, &id) || !skip_metadata(h, 0)) return false;
  return skip_metadata(h, 0);
}

static fs_status fail_cut(fs_context *ctx, size_t size) {
  return fs_fail(ctx, FS_ERR_FORMAT, "the head of the Draco file is cut or damaged (%zu bytes)", size);
}

fs_status fs_draco_check_head(fs_context *ctx, const char *bytes, size_t size) {
  const unsigned char *b = (const unsigned char *)bytes;
  head h = {.at = b + HEAD_SIZE, .end = b + size};
  uint64_t first, second, most = (uint64_t)size * FS_DRACO_MOST_PER_BYTE;
  if (size == 0) return fs_fail(ctx, FS_ERR_FORMAT, "the file is empty");
  if (size < HEAD_SIZE || memcmp(b, "DRACO", 5) != 0)
    return fs_fail(ctx, FS_ERR_FORMAT, "the file does not start with a Draco head");
  if (b[5] != MAJOR || b[6] != MINOR)
    return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file has bitstream version %d.%d, only %d.%d is read", b[5], b[6],
                   MAJOR, MINOR);
  if (b[7] != TYPE_MESH) return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file holds points, no mesh");
  if (b[8] != METHOD_SEQUENTIAL && b[8] != METHOD_EDGEBREAKER)
    return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file is compressed by the unknown method %d", b[8]);
  if ((b[10] & METADATA_FLAG) != 0 && !skip_all_metadata(&h)) return fail_cut(ctx, size);
  if (b[8] == METHOD_EDGEBREAKER && !skip(&h, 1)) return fail_cut(ctx, size);
  if (!read_varint(&h, &first) || !read_varint(&h, &second)) return fail_cut(ctx, size);
  if (most > INT32_MAX / 3) most = INT32_MAX / 3; /* corners are numbered by 32 bits */
  if (first > most || second > most || first == 0 || second == 0)
    return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file claims %llu %s and %llu %s in %zu bytes",
                   (unsigned long long)first, b[8] == METHOD_EDGEBREAKER ? "vertices" : "triangles",
                   (unsigned long long)second, b[8] == METHOD_EDGEBREAKER ? "triangles" : "points", size);
  return FS_OK;
}
