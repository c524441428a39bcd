// SPDX-License-Identifier: MIT
// The control mesh of a frame: boxes around a hole. smooth frame_cage.scad frame.scad makes the surface of it.
use <cage.scad>

cage([for (x = [0 : 3]) for (y = [0 : 2]) if (!(x == 1 && y == 1)) [x, y, 0]], size = [10, 10, 8]);
