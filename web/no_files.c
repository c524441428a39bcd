/* SPDX-License-Identifier: MIT */
/* Single role: the three calls of the system interface that the text formatting of the C library links, answered "bad file
   descriptor" here, so that the module imports nothing and reaches nothing outside itself. The names are those under
   which wasi-libc declares the imports. */
#include <stdint.h>

enum { BAD_FILE = 8 }; /* __WASI_ERRNO_BADF */

int32_t __imported_wasi_snapshot_preview1_fd_close(int32_t file);
int32_t __imported_wasi_snapshot_preview1_fd_seek(int32_t file, int64_t offset, int32_t whence, int32_t size);
int32_t __imported_wasi_snapshot_preview1_fd_write(int32_t file, int32_t buffers, int32_t count, int32_t size);

int32_t __imported_wasi_snapshot_preview1_fd_close(int32_t file) {
  (void)file;
  return BAD_FILE;
}

int32_t __imported_wasi_snapshot_preview1_fd_seek(int32_t file, int64_t offset, int32_t whence, int32_t size) {
  (void)file, (void)offset, (void)whence, (void)size;
  return BAD_FILE;
}

int32_t __imported_wasi_snapshot_preview1_fd_write(int32_t file, int32_t buffers, int32_t count, int32_t size) {
  (void)file, (void)buffers, (void)count, (void)size;
  return BAD_FILE;
}
