/* SPDX-License-Identifier: MIT */
/* The table of the kinds of patches; each has a file kind_*.c. */
#include "surface/surface.h"

const fs_patch_kind_info fs_patch_kinds[FS_N_PATCH_KINDS] = {
    [FS_PATCH_TENSOR_BEZIER] = {"tensor-bezier", "tensor product Bezier patch of any degree up to 31", 4, 3,
                                fs_tensor_bezier_numbers, fs_tensor_bezier_jet},
    [FS_PATCH_BEZIER_TRIANGLE] = {"bezier-triangle", "Bezier triangle of any degree up to 31", 3, 3,
                                  fs_bezier_triangle_numbers, fs_bezier_triangle_jet},
    [FS_PATCH_GREGORY_QUAD] = {"gregory-quad", "bicubic patch with rational inner points", 4, 1,
                               fs_gregory_quad_numbers, fs_gregory_quad_jet},
    [FS_PATCH_GREGORY_TRIANGLE] = {"gregory-triangle", "triangle of degree 4 with rational inner points", 3, 1,
                                   fs_gregory_triangle_numbers, fs_gregory_triangle_jet},
    [FS_PATCH_STACHO_TRIANGLE] = {"stacho-triangle", "triangle of degree 5 to 7 with rational corrections at its sides",
                                  3, 3, fs_stacho_triangle_numbers, fs_stacho_triangle_jet},
};
