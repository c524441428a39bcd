/* SPDX-License-Identifier: MIT */
/* The time that passes, for reports only: no result depends on it. */
#ifndef FS_BASE_CLOCK_H
#define FS_BASE_CLOCK_H

#include <time.h>

static inline double fs_clock_read(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds of a clock that is never set back. */
static inline double fs_clock_seconds(void) { return fs_clock_read(CLOCK_MONOTONIC); }

/* Seconds that processors spent on this process, those of all threads together. */
static inline double fs_clock_processor_seconds(void) { return fs_clock_read(CLOCK_PROCESS_CPUTIME_ID); }

#endif
