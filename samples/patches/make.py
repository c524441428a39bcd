#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the files of this folder: triangle meshes, and patches in the text formats of docs/formats: make.py FOLDER."""
import math
import pathlib
import random
import sys

GOLDEN = (1 + math.sqrt(5)) / 2


def rounded(x):
    return f"{x:.6f}".rstrip("0").rstrip(".").replace("-0", "0") if abs(x) < 5e-7 else f"{x:.6f}".rstrip("0").rstrip(".")


def point(p):
    return " ".join(rounded(x) for x in p)


def obj(vertices, triangles, comment):
    lines = [f"# {comment}"] + [f"v {point(p)}" for p in vertices]
    return "\n".join(lines + ["f " + " ".join(str(i + 1) for i in t) for t in triangles]) + "\n"


# ---- triangle meshes ----

ICOSAHEDRON = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
               (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
               (8, 6, 7), (9, 8, 1)]


def blob():
    """An icosahedron, its vertices moved in and out, lengthened along x."""
    g, r = GOLDEN, math.hypot(1, GOLDEN)
    sphere = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g), (g, 0, -1),
              (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    scale = [1.15, 0.9, 1, 1.2, 0.85, 1.1, 0.95, 1.05, 1.2, 0.9, 1, 1.1]
    return obj([(1.4 * s * x / r, s * y / r, s * z / r) for s, (x, y, z) in zip(scale, sphere)], ICOSAHEDRON,
               "a closed triangle mesh for --construction stacho")


def hills():
    """Heights over a jittered triangulation of a rectangle."""
    numbers, n, m = random.Random(7), 7, 5
    vertices, triangles = [], []
    for j in range(m + 1):
        for i in range(n + 1):
            x = i + (numbers.uniform(-0.25, 0.25) if 0 < i < n else 0)
            y = j + (numbers.uniform(-0.25, 0.25) if 0 < j < m else 0)
            vertices.append((x, y, 0.45 * math.sin(0.9 * x) * math.cos(0.8 * y) + 0.1 * x))
    for j in range(m):
        for i in range(n):
            a = i + (n + 1) * j
            b, c, d = a + 1, a + n + 2, a + n + 1
            triangles += [(a, b, c), (a, c, d)] if numbers.random() < 0.5 else [(a, b, d), (b, c, d)]
    return obj(vertices, triangles, "heights over the (x, y) plane for --construction stacho-graph")


def survey():
    """Scattered heights of one hill, without triangles."""
    numbers = random.Random(11)
    points = [(0, 0), (6, 0), (6, 4), (0, 4)] + [(numbers.uniform(0.2, 5.8), numbers.uniform(0.2, 3.8)) for _ in range(36)]
    heights = [(x, y, 1.2 * math.exp(-0.35 * ((x - 2.6) ** 2 + (y - 2.2) ** 2)) + 0.1 * x) for x, y in points]
    return "# scattered heights for --construction stacho-graph\n" + "".join(point(p) + "\n" for p in heights)


def lantern():
    """A prism over a regular pentagon, a pyramid on top: a pentagon, quads and triangles."""
    ring = [(math.cos(2 * math.pi * k / 5), math.sin(2 * math.pi * k / 5)) for k in range(5)]
    vertices = [(x, y, 0) for x, y in ring] + [(1.25 * x, 1.25 * y, 1.3) for x, y in ring] + [(0, 0, 2.3)]
    faces = [(4, 3, 2, 1, 0)] + [(k, (k + 1) % 5, 5 + (k + 1) % 5, 5 + k) for k in range(5)]
    return obj(vertices, faces + [(5 + k, 5 + (k + 1) % 5, 10) for k in range(5)],
               "a closed mesh of faces of three, four and five vertices for --construction gregory")


# ---- splines ----

def spline(kind, name, degrees, knots, coefficients):
    lines = [f"{kind} {name}", "degree " + " ".join(str(d) for d in degrees)]
    lines += ["knots " + " ".join(rounded(x) for x in k) for k in knots]
    lines += ["values " + " ".join(rounded(x) for x in coefficients)] if kind == "function" else \
        ["points"] + [point(p) for p in coefficients]
    return "\n".join(lines) + "\n"


def greville(knots, degree):
    return [sum(knots[i + 1:i + degree + 1]) / degree for i in range(len(knots) - degree - 1)]


def gap():
    """Two sheets with a gap between them; their knots by v differ, and r has a double knot."""
    u, vq, vr = [0, 0, 0, 0, 0.5, 1, 1, 1, 1], [0, 0, 0, 0, 0.3, 0.6, 1, 1, 1, 1], [0, 0, 0, 0, 0.45, 0.7, 0.7, 1, 1, 1, 1]
    q = [(-3.2 + 0.5 * i * (1 + 0.2 * y), 3.2 * y, 0.25 * math.sin(4 * y) + 0.1 * i * (1.2 - y) + 0.02 * i * i)
         for y in greville(vq, 3) for i in range(5)]
    r = [(0.9 + 0.5 * y + 0.55 * i * (1 - 0.2 * y), 3.2 * y + 0.2, 1.1 + 0.3 * y * y - 0.14 * i - 0.02 * i * i)
         for y in greville(vr, 3) for i in range(5)]
    return "fairsurf-splines 1\n# for --construction gap\n\n" + spline("patch", "q", (3, 3), (u, vq), q) + "\n" + \
        spline("patch", "r", (3, 3), (u, vr), r)


def pair():
    """An auxiliary strip over a bent edge, and junction functions of both sides."""
    aux = [(3 * i, 1.5 * j, 0.7 * math.sin(1.1 * i) - 0.2 * j * j + 0.06 * i * j) for j in range(3) for i in range(4)]
    text = "fairsurf-splines 1\n# for --construction junction\n\n" + spline("patch", "aux", (3, 2), (), aux)
    functions = {"beta1-a": (0.05, 0.1, -0.08), "gamma1-a": (1.2, 0.8, 1.1), "beta2-a": (0.1, -0.1),
                 "gamma2-a": (-0.2, 0.1), "beta1-b": (-0.05, 0.1, 0.05), "gamma1-b": (-0.9, -1.2, -0.8),
                 "gamma2-b": (0.1, 0.05)}
    return text + "".join("\n" + spline("function", name, (len(c) - 1,), (), c) for name, c in functions.items())


def sail():
    """Four curves of different degrees and knots that meet in the corners of a sail."""
    corners = {(0, 0): (0, 0, 0), (1, 0): (4, 0.3, 0.4), (0, 1): (0.6, 3.2, 1.6), (1, 1): (3.1, 3.6, 0.2)}
    v0 = [corners[0, 0], (0.9, -0.6, 0.5), (2, -0.7, 0.9), (3.1, -0.2, 0.9), corners[1, 0]]
    v1 = [corners[0, 1], (1.4, 3.9, 1.9), (2.4, 4, 0.9), corners[1, 1]]
    u0 = [corners[0, 0], (-0.5, 1, 1.2), (-0.1, 2.4, 1.9), corners[0, 1]]
    u1 = [corners[1, 0], (4.4, 1.9, 1.4), corners[1, 1]]
    return "fairsurf-splines 1\n# for --construction coons\n\n" + "\n".join(
        [spline("curve", "v0", (3,), ([0, 0, 0, 0, 0.4, 1, 1, 1, 1],), v0), spline("curve", "v1", (3,), (), v1),
         spline("curve", "u0", (3,), (), u0), spline("curve", "u1", (2,), (), u1)])


def pillow():
    """Four cubic curves without inner knots, two arched and two sagging."""
    side = {"v0": [(0, 0, 0), (1, -0.3, 1.1), (2, -0.3, 1.1), (3, 0, 0)],
            "v1": [(0, 3, 0), (1, 3.3, 1.1), (2, 3.3, 1.1), (3, 3, 0)],
            "u0": [(0, 0, 0), (-0.3, 1, -0.7), (-0.3, 2, -0.7), (0, 3, 0)],
            "u1": [(3, 0, 0), (3.3, 1, -0.7), (3.3, 2, -0.7), (3, 3, 0)]}
    return "fairsurf-splines 1\n# for --construction coons, any blend\n\n" + "\n".join(
        spline("curve", name, (3,), (), points) for name, points in side.items())


# ---- BezierView ----

def roof():
    """A bicubic patch, a patch of degree (2, 3) beside it, and a cubic triangle at its end: kinds 4, 5 and 3."""
    def height(x, y):
        return 0.4 * math.sin(1.1 * x) + 0.25 * y * y - 0.1 * x * y
    cubic = [(i, j, height(i, j)) for i in range(4) for j in range(4)]
    beside = [(3 + 1.2 * i, j, height(3 + 1.2 * i, j) if i else height(3, j)) for i in range(3) for j in range(4)]
    triangle = [(3 - i - j / 2, 3 + j, height(3 - i - j / 2, 3 + j)) for j in range(4) for i in range(4 - j)]
    text = "Group 0 roof\n4\n3\n" + "\n".join(point(p) for p in cubic)
    text += "\n5\n2 3\n" + "\n".join(point(p) for p in beside)
    # its first side runs along the end of the bicubic patch the other way
    return text + "\n3\n3\n" + "\n".join(point(p) for p in turn(triangle)) + "\n"


def turn(rows):
    """Rows of a cubic triangle from right to left become rows from left to right."""
    out, start = [], 0
    for length in (4, 3, 2, 1):
        out += rows[start:start + length][::-1]
        start += length
    return out


def main():
    folder = pathlib.Path(sys.argv[1])
    for name, make in (("blob.obj", blob), ("lantern.obj", lantern), ("hills.obj", hills),
                       ("survey.xyz", survey), ("gap.spl", gap), ("pair.spl", pair), ("sail.spl", sail),
                       ("pillow.spl", pillow), ("roof.bv", roof)):
        (folder / name).write_text(make(), encoding="ascii")
        print(name)


if __name__ == "__main__":
    main()
