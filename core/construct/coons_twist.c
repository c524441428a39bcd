/* SPDX-License-Identifier: MIT */
/* Single role: derivatives across the sides of a Coons patch where only the sides are known.

   Adini's twist is that of the bilinear patch of the sides c_j (v = j) and d_i (u = i):
     T_ij = c_1'(i) - c_0'(i) + d_1'(j) - d_0'(j) - (P_00 - P_10 - P_01 + P_11).
   Derivatives across are cubics with the derivatives of the neighbouring sides and the twists at their ends: with cubic sides
   this is the bicubic Hermite patch [Farin 2002, 15.5, 22.4]. */
#include "construct/coons.h"
#include "math/vec3.h"

void fs_adini_twists(const fs_curve *at_u, const fs_curve *at_v, fs_vec3 twist[2][2]) {
  fs_vec3 c[2][2][4], d[2][2][4]; /* [side][end][derivative] */
  for (int side = 0; side < 2; side++)
    for (int end = 0; end < 2; end++) {
      at_v[side].evaluate(at_v[side].user, end, c[side][end]);
      at_u[side].evaluate(at_u[side].user, end, d[side][end]);
    }
  fs_vec3 around = fs_vec3_sub(fs_vec3_sub(c[0][0][0], c[0][1][0]), fs_vec3_sub(c[1][0][0], c[1][1][0]));
  for (int i = 0; i < 2; i++)
    for (int j = 0; j < 2; j++) {
      fs_vec3 along_u = fs_vec3_sub(c[1][i][1], c[0][i][1]), along_v = fs_vec3_sub(d[1][j][1], d[0][j][1]);
      twist[i][j] = fs_vec3_sub(fs_vec3_add(along_u, along_v), around);
    }
}

/* The cubic with values a, b and derivatives s, t at its ends. */
static void hermite(fs_vec3 a, fs_vec3 s, fs_vec3 b, fs_vec3 t, fs_vec3 *point) {
  point[0] = a;
  point[1] = fs_vec3_add_scaled(a, s, 1.0 / 3);
  point[2] = fs_vec3_add_scaled(b, t, -1.0 / 3);
  point[3] = b;
}

void fs_coons_cross(const fs_curve *at_u, const fs_curve *at_v, const fs_vec3 twist[2][2], fs_vec3 across_u[2][4],
                    fs_vec3 across_v[2][4]) {
  for (int side = 0; side < 2; side++) {
    fs_vec3 start[4], end[4];
    at_v[0].evaluate(at_v[0].user, side, start);
    at_v[1].evaluate(at_v[1].user, side, end);
    hermite(start[1], twist[side][0], end[1], twist[side][1], across_u[side]);
    at_u[0].evaluate(at_u[0].user, side, start);
    at_u[1].evaluate(at_u[1].user, side, end);
    hermite(start[1], twist[0][side], end[1], twist[1][side], across_v[side]);
  }
}
