// SPDX-License-Identifier: MIT
// A part made of the smooth frame: holes for two screws.
use <frame.scad>

difference() {
  frame();
  for (y = [5, 25]) translate([35, y, -10]) cylinder(d = 4, h = 30, $fn = 48);
}
