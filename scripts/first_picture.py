#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the first picture of the README: one control mesh as Catmull-Clark limit surface and as fair surface, both as zebra.

Usage: first_picture.py --fairsurf EXE --out FOLDER      needs povray; leaves catmull-clark.png and fair.png in FOLDER

The limit surface is exact: a face whose corners are interior and have four faces each is a bicubic B-spline patch, whatever
the level; the others are refined by `fairsurf refine --scheme catmull-clark`, and what is left around the special vertex
after the last level is smaller than a pixel. The script also prints how much the curvature jumps: of the fair surface as
`fairsurf check` finds it; of the limit surface the largest difference of two curvature tensors of the innermost ring of
patches, which has no limit 0 as the ring shrinks.
"""
import argparse
import json
import math
import pathlib
import re
import subprocess

LEVELS = 14
VALENCE, RINGS = 8, 3
BEZIER = [[1 / 6, 4 / 6, 1 / 6, 0], [0, 4 / 6, 2 / 6, 0], [0, 2 / 6, 4 / 6, 0], [0, 1 / 6, 4 / 6, 1 / 6]]


# ---------------------------------------------------------------- the mesh
def height(x, y):
    """A saddle whose data are not symmetric about the vertex: symmetric ones would hide the defect."""
    return 0.12 * (x * x - y * y)


def star():
    """A vertex with VALENCE sectors of RINGS x RINGS quadrilaterals."""
    points, faces, number = [(0.0, 0.0, 0.0)], [], {}

    def vertex(s, i, j):
        if i == 0:  # (0, j) of a sector is (j, 0) of the next
            s, i, j = (s + 1) % VALENCE, j, 0
        if i == 0:
            return 0
        if (s, i, j) not in number:
            a, b = (2 * math.pi * t / VALENCE for t in (s, s + 1))
            x, y = (i * f(a) + j * f(b) for f in (math.cos, math.sin))
            number[s, i, j] = len(points)
            points.append((x, y, height(x, y)))
        return number[s, i, j]

    for s in range(VALENCE):
        for i in range(RINGS):
            for j in range(RINGS):
                faces.append([vertex(s, i, j), vertex(s, i + 1, j), vertex(s, i + 1, j + 1), vertex(s, i, j + 1)])
    return points, faces


def write_obj(path, points, faces):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in faces]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def read_obj(path):
    points, faces = [], []
    for line in path.read_text(encoding="ascii").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return points, faces


# ---------------------------------------------------------------- the limit surface
class Net:
    """A mesh of quadrilaterals: what lies across edges, and which vertices are regular."""

    def __init__(self, points, faces):
        self.points, self.faces = points, faces
        self.side = {(face[k], face[(k + 1) % 4]): (f, k) for f, face in enumerate(faces) for k in range(4)}
        ends = {a for (a, b) in self.side if (b, a) not in self.side} | {b for (a, b) in self.side
                                                                       if (b, a) not in self.side}
        self.around = [0] * len(points)
        for face in faces:
            for v in face:
                self.around[v] += 1
        self.interior = [v not in ends for v in range(len(points))]

    def is_regular(self, face):
        return all(self.interior[v] and self.around[v] == 4 for v in face)

    def is_inner(self, face):
        return all(self.interior[v] for v in face)

    def across(self, a, b):
        """The face across side (a, b), its corners from b on: b, a, then the two far ones."""
        f, k = self.side[b, a]
        return [self.faces[f][(k + m) % 4] for m in range(4)]

    def bezier(self, f):
        """b[i][j], i along u, of a regular face: its corners are (1, 1), (2, 1), (2, 2), (1, 2) of the 4 x 4 net."""
        a, b, c, d = self.faces[f]
        _, _, s0, s1 = self.across(a, b)  # below: under a, under b
        _, _, e0, e1 = self.across(b, c)
        _, _, n0, n1 = self.across(c, d)
        _, _, w0, w1 = self.across(d, a)
        corner = [self.across(v, under)[3] for v, under in ((a, s0), (b, e0), (c, n0), (d, w0))]
        net = [[corner[0], w1, w0, corner[3]], [s0, a, d, n1], [s1, b, c, n0], [corner[1], e0, e1, corner[2]]]
        p = [[self.points[v] for v in row] for row in net]
        return [[tuple(sum(BEZIER[i][k] * BEZIER[j][m] * p[k][m][x] for k in range(4) for m in range(4))
                       for x in range(3)) for j in range(4)] for i in range(4)]


def rings_around(net, n):
    """The faces within n rings of the vertices that are interior and have not four faces."""
    near = {v for v in range(len(net.points)) if net.interior[v] and net.around[v] != 4}
    for _ in range(n):
        kept = [f for f, face in enumerate(net.faces) if near & set(face)]
        near = {v for f in kept for v in net.faces[f]}
    return kept


def limit_patches(fairsurf, path, folder):
    """Bezier points of the regular faces, level by level."""
    net, levels = Net(*read_obj(path)), []
    wanted = {f for f, face in enumerate(net.faces) if net.is_inner(face)}
    for level in range(LEVELS):
        done = {f for f in wanted if net.is_regular(net.faces[f])}
        levels.append([net.bezier(f) for f in sorted(done)])
        kept = rings_around(net, 4)
        new, used = {}, []
        for f in kept:
            for v in net.faces[f]:
                new.setdefault(v, len(new))
            used.append([new[v] for v in net.faces[f]])
        coarse, fine = folder / "coarse.obj", folder / "fine.obj"
        write_obj(coarse, [net.points[v] for v in new], used)
        subprocess.run([fairsurf, "refine", coarse, "--scheme", "catmull-clark", "-q", "-o", fine], check=True)
        left = {kept.index(f) for f in wanted - done}
        points, faces = read_obj(fine)
        net = Net(points, faces)
        first = len(points) - len(used)  # the vertices of the faces come last
        wanted = {f for f, face in enumerate(faces) if max(face) - first in left}
    return levels


def write_bezierview(path, patches):
    lines = []
    for patch in patches:
        lines += ["4", "3"] + [" ".join(map(repr, p)) for row in patch for p in row]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


# ---------------------------------------------------------------- curvature of the innermost ring
def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def shape_tensor(b):
    """J G^-1 B G^-1 J^T at (0, 0) of a bicubic patch."""
    def difference(p, q, by):
        return tuple(by * (y - x) for x, y in zip(p, q))
    u, v = difference(b[0][0], b[1][0], 3), difference(b[0][0], b[0][1], 3)
    uu = difference(difference(b[0][0], b[1][0], 1), difference(b[1][0], b[2][0], 1), 6)
    vv = difference(difference(b[0][0], b[0][1], 1), difference(b[0][1], b[0][2], 1), 6)
    uv = difference(difference(b[0][0], b[1][0], 1), difference(b[0][1], b[1][1], 1), 9)
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = math.sqrt(dot(n, n))
    g11, g12, g22 = dot(u, u), dot(u, v), dot(v, v)
    b11, b12, b22 = (dot(x, n) / length for x in (uu, uv, vv))
    det = g11 * g22 - g12 * g12
    dual = [tuple((g22 * x - g12 * y) / det for x, y in zip(u, v)), tuple((g11 * y - g12 * x) / det for x, y in zip(u, v))]
    return [b11 * dual[0][i] * dual[0][j] + b12 * (dual[0][i] * dual[1][j] + dual[1][i] * dual[0][j]) +
            b22 * dual[1][i] * dual[1][j] for i in range(3) for j in range(3)]


def turned(b):
    return [[b[3 - j][i] for j in range(4)] for i in range(4)]


def spread(patches, middle):
    """Largest difference of the tensors at those corners of the patches that are nearest the middle."""
    tensors = []
    for b in patches:
        turns = [b, turned(b), turned(turned(b)), turned(turned(turned(b)))]
        tensors.append(shape_tensor(min(turns, key=lambda t: math.dist(t[0][0], middle))))
    return max(math.dist(a, b) for a in tensors for b in tensors)


# ---------------------------------------------------------------- pictures
def render(folder, name):
    """Renders a scene with the camera near the special vertex."""
    scene = folder / f"{name}.pov"
    text, n = re.subn(r"vnormalize\(<[^>]*>\) \* (\w+_Distance)", r"vnormalize(<0.9, -2.4, 2.6>) * 0.5 * \1",
                      scene.read_text(encoding="utf-8"))
    assert n == 1, "the camera of the scene has another form"
    scene.write_text(text, encoding="utf-8")
    result = subprocess.run(["povray", f"{name}.pov", "-D", "-GA", "+W640", "+H480", "+A0.1", "+AM1", "+R3", "-J",
                             f"+O{name}.png"], cwd=folder, capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise SystemExit(result.stderr[-2000:])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fairsurf", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    fairsurf, out = arguments.fairsurf.resolve(), arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    mesh, limit, net = out / "star.obj", out / "catmull-clark.bv", out / "fair.ply"
    write_obj(mesh, *star())
    levels = limit_patches(fairsurf, mesh, out)
    write_bezierview(limit, [patch for level in levels for patch in level])
    look = ["--scene", "zebra", "--pov", "mesh2", "--pov-steps", "4"]
    subprocess.run([fairsurf, "check", limit, *look, "-q", "-o", out / "catmull-clark.pov"], check=True)
    subprocess.run([fairsurf, "fair", mesh, "-q", "-o", net, *look, "-o", out / "fair.pov"], check=True)
    result = subprocess.run([fairsurf, "check", net, "--json"], check=True, capture_output=True, text=True)
    found = json.loads(result.stdout)
    scale = found["curvature_scale"]
    print(f"fair surface: largest jump of curvature {found['max']['curvature']:.1e} of the largest principal curvature")
    middle = (0, 0, height(0, 0))
    for level in range(2, LEVELS):
        print(f"limit surface: around ring {level} of the vertex curvature differs by {spread(levels[level], middle) / scale:.1f}"
              " of that")
    for name in ("catmull-clark", "fair"):
        render(out, name)


if __name__ == "__main__":
    main()
