// SPDX-License-Identifier: MIT
// Control meshes for fairsurf, made in OpenSCAD: the skin of boxes, as quadrilaterals.
//
//   use <cage.scad>
//   cage([[0, 0, 0], [1, 0, 0], [2, 0, 0], [1, 1, 0]], size = [10, 10, 5]);
//
// cells: whole numbers [x, y, z], one per box; boxes that meet only along an edge or in a corner are refused by fairsurf.
// size: of one box. Export to OFF without any Boolean around it: a Boolean would cut the quadrilaterals into triangles.

// For each direction the four corners of that side of the unit cube, anticlockwise seen from outside.
cage_sides = [
  [[-1, 0, 0], [[0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]]],
  [[1, 0, 0], [[1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]]],
  [[0, -1, 0], [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]],
  [[0, 1, 0], [[0, 1, 0], [0, 1, 1], [1, 1, 1], [1, 1, 0]]],
  [[0, 0, -1], [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]]],
  [[0, 0, 1], [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]]
];

function cage_contains(cells, cell) = len([for (c = cells) if (c == cell) 1]) > 0;

module cage(cells, size = [1, 1, 1]) {
  quads = [for (c = cells) for (s = cage_sides) if (!cage_contains(cells, c + s[0]))
    [for (p = s[1]) [for (k = [0 : 2]) (c[k] + p[k]) * size[k]]]];
  polyhedron(points = [for (q = quads) each q],
             faces = [for (i = [0 : len(quads) - 1]) [4 * i + 3, 4 * i + 2, 4 * i + 1, 4 * i]], convexity = 10);
}
