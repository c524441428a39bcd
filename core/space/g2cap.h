/* SPDX-License-Identifier: MIT */
/* G2 caps: the k patches of degree (9, 9) around an interior vertex of valence k, as a constant matrix per k that takes
   the 6 k + 1 vertices of the surrounding net to Bezier points. [Kiciak 2013; docs/g2caps.md] */
#ifndef FS_SPACE_G2CAP_H
#define FS_SPACE_G2CAP_H

#include "base/base.h"

enum { FS_G2CAP_MIN_VALENCE = 3, FS_G2CAP_MAX_VALENCE = 24 };

/* The net of a vertex: V_i(a, b) is reached from it by a edges along spoke i and b edges parallel to spoke i + 1;
   spokes are numbered anticlockwise. Its number is 0 for the centre and 1 + 6 i + 2 b + (a - 1) for a = 1, 2 and
   b = 0, 1, 2. Sector s sees the net turned: centre, block s, block s + 1, .., block s - 1 of six vertices. */
typedef struct fs_g2cap {
  int32_t valence, n_vertices; /* n_vertices = 6 valence + 1 */
  double *matrix; /* [100][n_vertices]: Bezier points of sector 0; point (i, j), i along u, is row i + 10 j.
                                  u runs along spoke 0, v along spoke 1; the centre is u = v = 0 */
  double
      *chart;  /* [100][2] Bezier points of sector 0 of the plane domain, scaled to the area 1; spoke 0 is the x axis */
  double *net; /* [n_vertices][2] net of the plane domain, scaled so that its V_0(3, 0) is (3, 0) */
  double trace_energy; /* trace of the matrix K, x^T K x = energy of the cap over net's domain; the less the better */
} fs_g2cap;

/* All zero: what the library uses. */
typedef struct fs_g2cap_options {
  int32_t n_nodes; /* 4 .. 64 quadrature nodes per direction and sector; 0: 32 */
  bool basic;      /* without the 16 inner functions per sector: G2 as well, but with more energy */
  bool composite;  /* n_nodes / 2 cells of 2 Gauss nodes, for comparison with published numbers; n_nodes is even */
} fs_g2cap_options;

/* The cap of valence 3, 5 .. 24 (FS_ERR_ARGUMENT otherwise); options may be NULL. */
fs_status fs_g2cap_create(fs_context *ctx, int32_t valence, const fs_g2cap_options *options, fs_g2cap **cap);
void fs_g2cap_free(fs_context *ctx, fs_g2cap *cap); /* NULL is allowed */

/* The same with default options, made once and kept in the context until fs_context_clear. */
fs_status fs_g2cap_get(fs_context *ctx, int32_t valence, const fs_g2cap **cap);

/* The inner functions of a cap: they vanish with first and second derivatives at its rim, so that adding them to what
   the matrix gives keeps the contact. Orthonormal in the energy, with the plane domain scaled to one unit of area per
   sector, and orthogonal to the functions of the matrix: coefficients c add the energy |c|^2. */
enum { FS_G2CAP_LOCAL = 16 };
typedef struct fs_g2cap_inner {
  int32_t valence, n_smooth;
  double *smooth; /* [valence][100][n_smooth]: functions of the whole cap; Bezier points in sector s, rows as in the
                     matrix of fs_g2cap */
  double *local;  /* [100][16]: functions of one sector that vanish in all others, the same in every sector */
} fs_g2cap_inner;

/* The inner functions of valence 3, 5 .. 24 (FS_ERR_ARGUMENT otherwise). */
fs_status fs_g2cap_inner_create(fs_context *ctx, int32_t valence, fs_g2cap_inner **inner);
void fs_g2cap_inner_free(fs_context *ctx, fs_g2cap_inner *inner); /* NULL is allowed */

/* The same, made once and kept in the context until fs_context_clear. */
fs_status fs_g2cap_get_inner(fs_context *ctx, int32_t valence, const fs_g2cap_inner **inner);

#endif
