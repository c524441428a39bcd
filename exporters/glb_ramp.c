/* SPDX-License-Identifier: MIT */
/* Single role: the ramp of colours as a PNG picture, one row, compressed by nothing: "stored" deflate [RFC 1950, 1951;
   PNG specification, CRC and Adler sums as there]. */
#include "glb.h"
#include "base/base.h"

#include <string.h>

/* The ends and the quarters; linear between. */
static const double colours[5][3] = {
    {0.10, 0.20, 0.75}, {0.25, 0.75, 0.85}, {0.95, 0.95, 0.90}, {0.95, 0.75, 0.20}, {0.75, 0.10, 0.10}};

enum { ROW = 1 + 3 * FS_GLB_RAMP, DATA = 2 + 5 + ROW + 4, CHUNK_MOST = 4 + DATA };

static void put_big_endian(unsigned char *to, uint32_t number) {
  for (int i = 0; i < 4; i++) to[i] = (unsigned char)(number >> (24 - 8 * i));
}

static uint32_t find_crc(const unsigned char *bytes, size_t size) {
  uint32_t crc = 0xFFFFFFFFu;
  for (size_t i = 0; i < size; i++) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; bit++) crc = (crc & 1) != 0 ? 0xEDB88320u ^ crc >> 1 : crc >> 1;
  }
  return ~crc;
}

static uint32_t find_adler(const unsigned char *bytes, size_t size) {
  uint32_t a = 1, b = 0;
  for (size_t i = 0; i < size; i++) {
    a = (a + bytes[i]) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

/* Length, name, data, sum over name and data. */
static fs_status append_chunk(fs_blob *blob, const char *name, const unsigned char *data, size_t size) {
  unsigned char bytes[CHUNK_MOST], number[4];
  fs_status status = FS_OK;
  memcpy(bytes, name, 4);
  if (size > 0) memcpy(bytes + 4, data, size);
  put_big_endian(number, (uint32_t)size);
  FS_TRY(fs_blob_append(blob, number, 4));
  FS_TRY(fs_blob_append(blob, bytes, 4 + size));
  put_big_endian(number, find_crc(bytes, 4 + size));
  FS_TRY(fs_blob_append(blob, number, 4));
done:
  return status;
}

static void fill_row(unsigned char row[ROW]) {
  row[0] = 0; /* no filter */
  for (int i = 0; i < FS_GLB_RAMP; i++) {
    double s = 4.0 * i / (FS_GLB_RAMP - 1);
    int k = s < 3 ? (int)s : 3;
    for (int c = 0; c < 3; c++) {
      double x = (k + 1 - s) * colours[k][c] + (s - k) * colours[k + 1][c];
      row[1 + 3 * i + c] = (unsigned char)(255 * x + 0.5);
    }
  }
}

fs_status fs_glb_append_ramp(fs_blob *blob) {
  static const unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  unsigned char head[13] = {0}, data[DATA];
  fs_status status = FS_OK;
  put_big_endian(head, FS_GLB_RAMP);
  put_big_endian(head + 4, 1);
  head[8] = 8; /* bits per channel */
  head[9] = 2; /* red, green, blue */
  data[0] = 0x78, data[1] = 0x01;
  data[2] = 1; /* the last block, stored */
  data[3] = ROW & 255, data[4] = ROW >> 8;
  data[5] = (unsigned char)~data[3], data[6] = (unsigned char)~data[4];
  fill_row(data + 7);
  put_big_endian(data + 7 + ROW, find_adler(data + 7, ROW));
  FS_TRY(fs_blob_append(blob, signature, sizeof signature));
  FS_TRY(append_chunk(blob, "IHDR", head, sizeof head));
  FS_TRY(append_chunk(blob, "IDAT", data, sizeof data));
  FS_TRY(append_chunk(blob, "IEND", NULL, 0));
done:
  return status;
}
