/* SPDX-License-Identifier: MIT */
/* Triangulations of points of the plane. */
#ifndef FS_MESH_DELAUNAY_H
#define FS_MESH_DELAUNAY_H

#include "mesh/mesh.h"

/* Triangles over points seen along z, anticlockwise, such that no circumcircle of one holds another point; together they fill
   the convex hull. corner[6 n] takes them, three each; there are fewer than 2 n. Points are compared on a grid of 2^25 cells
   along the longer side of their box: two in one cell, or all on one line, are FS_ERR_FORMAT, with their numbers. */
fs_status fs_delaunay(fs_context *ctx, int32_t n, const fs_vec3 *point, int32_t *corner, int32_t *n_triangles);

#endif
