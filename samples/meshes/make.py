#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the control meshes of this folder, checks them and writes them as OBJ: ./make.py [FOLDER].

Every mesh is a list of vertices and a list of faces, corners anticlockwise seen from outside. The output is the same on
every machine: the disturbances come from a generator of our own, and coordinates are rounded to nine decimals.
"""
import math
import os
import sys


# ---------------------------------------------------------------- small vectors
def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scale(s, a):
    return tuple(s * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def mean(points):
    return scale(1 / len(points), tuple(map(sum, zip(*points))))


class Random:
    """Numbers in [-1, 1]: a linear congruential generator (Knuth's MMIX constants), upper bits."""

    def __init__(self, seed):
        self.state = seed

    def next(self):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 33) / 2**30 - 1


class Builder:
    """Collects vertices by key, so that pieces which meet share them."""

    def __init__(self):
        self.points, self.faces, self.number = [], [], {}

    def vertex(self, key, position):
        if key not in self.number:
            self.number[key] = len(self.points)
            self.points.append(position)
        return self.number[key]

    def mesh(self):
        return self.points, self.faces


# ---------------------------------------------------------------- the meshes
def cube():
    corners = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [tuple(map(float, p)) for p in corners], faces


def torus(n_around=12, n_across=8, big=3.0, small=1.0):
    points, faces = [], []
    for i in range(n_around):
        a = 2 * math.pi * i / n_around
        for j in range(n_across):
            b = 2 * math.pi * j / n_across
            r = big + small * math.cos(b)
            points.append((r * math.cos(a), r * math.sin(a), small * math.sin(b)))
    at = lambda i, j: i % n_around * n_across + j % n_across
    for i in range(n_around):
        for j in range(n_across):
            faces.append((at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return points, faces


def genus2():
    """The outside of 5 x 3 x 1 unit cubes without two of them, which leaves two handles."""
    solid = {(x, y) for x in range(5) for y in range(3)} - {(1, 1), (3, 1)}
    xs, ys, zs = (-2.6, -1.8, -0.6, 0.6, 1.8, 2.6), (-1.4, -0.6, 0.6, 1.4), (-0.4, 0.4)
    b = Builder()
    at = lambda x, y, z: b.vertex((x, y, z), (xs[x], ys[y], zs[z]))
    for x, y in sorted(solid):
        b.faces.append((at(x, y, 1), at(x + 1, y, 1), at(x + 1, y + 1, 1), at(x, y + 1, 1)))
        b.faces.append((at(x, y, 0), at(x, y + 1, 0), at(x + 1, y + 1, 0), at(x + 1, y, 0)))
        sides = {(0, -1): ((x, y), (x + 1, y)), (1, 0): ((x + 1, y), (x + 1, y + 1)),
                 (0, 1): ((x + 1, y + 1), (x, y + 1)), (-1, 0): ((x, y + 1), (x, y))}
        for (dx, dy), (p, q) in sides.items():
            if (x + dx, y + dy) not in solid:
                b.faces.append((at(*p, 0), at(*q, 0), at(*q, 1), at(*p, 1)))
    return b.mesh()


def genus3():
    """The outside of two plates of 3 x 3 cubes, one over the other, on four legs between their corners: three handles."""
    solid = {(x, y, z) for x in range(3) for y in range(3) for z in range(3) if z != 1 or (x != 1 and y != 1)}
    xs, zs = (-1.5, -0.6, 0.6, 1.5), (-1.3, -0.6, 0.6, 1.3)
    b = Builder()
    for cell in sorted(solid):
        for axis in range(3):
            for end in (0, 1):
                beyond = tuple(c + (2 * end - 1) * (k == axis) for k, c in enumerate(cell))
                if beyond in solid:
                    continue
                corners = []
                for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))[::2 * end - 1]:
                    step = [0, 0, 0]
                    step[axis], step[(axis + 1) % 3], step[(axis + 2) % 3] = end, i, j
                    x, y, z = add(cell, step)
                    corners.append(b.vertex((x, y, z), (xs[x], xs[y], zs[z])))
                b.faces.append(tuple(corners))
    return b.mesh()


def pipe(n=6, n_long=10, length=3.6):
    """Three tubes of 2 n sides, mitred: neighbours meet in a half plane, and the three seams in two vertices of valence 6.

    Around its axis a tube has the angle phi from the top; sin phi is the offset to its side, cos phi the height. The mitre
    with the neighbour 120 degrees away lies where offset = distance along the axis * tan 60 degrees.
    """
    b = Builder()
    n_around = 2 * n
    for tube in range(3):
        axis = 2 * math.pi * tube / 3
        along, side = (math.cos(axis), math.sin(axis), 0.0), (-math.sin(axis), math.cos(axis), 0.0)

        def at(i, j):
            i %= n_around
            phi = 2 * math.pi * i / n_around
            start = abs(math.sin(phi)) / math.sqrt(3)
            fraction = j / n_long
            distance = start + (length - start) * fraction
            # The dents of the middle are what fairing is to remove; the last three rings are a straight tube.
            dent = 1 - 0.22 * max(0.0, math.sin(math.pi * min(1.0, fraction / 0.7))) ** 2
            position = add(scale(distance, along), add(scale(dent * math.sin(phi), side), (0, 0, dent * math.cos(phi))))
            if j > 0:
                key = (tube, i, j)
            elif i in (0, n):
                key = "top" if i == 0 else "bottom"
            else:  # the seam with the next tube (i < n) or the one before, from top to bottom
                key = ("seam", tube if i < n else (tube + 2) % 3, min(i, n_around - i))
            return b.vertex(key, position)

        for j in range(n_long):
            for i in range(n_around):
                b.faces.append((at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)))
    return b.mesh()


def hull(k=6):
    """Half a ship: six blocks of k x k faces around a vertex A of valence 3 and a vertex B of valence 5.

    The blocks are laid out in a rectangle, x from stern to bow and t from keel to deck, and evened out by averaging.
    """
    corner = {"L": (0, 0), "a2": (2, 0), "b4": (4, 0), "c3": (6, 0), "b3": (6, 1), "c2": (6, 2), "b2": (3.3, 2),
              "c1": (0, 2), "b1": (0, 1.33), "a1": (0, 0.67), "A": (1.6, 0.7), "B": (3.1, 1.1)}
    blocks = ["A B b1 a1", "B A a2 b4", "A a1 L a2", "B b2 c1 b1", "B b3 c2 b2", "B b4 c3 b3"]
    b = Builder()
    for block in blocks:
        names = block.split()
        p = [corner[name] for name in names]

        def at(i, j):
            # Bilinear weights of the four corners; those that are not zero name the vertex for all blocks that hold it.
            weight = ((k - i) * (k - j), i * (k - j), i * j, (k - i) * j)
            key = tuple(sorted((name, w) for name, w in zip(names, weight) if w))
            return b.vertex(key, tuple(sum(w * q[c] for w, q in zip(weight, p)) / k**2 for c in (0, 1)))

        for j in range(k):
            for i in range(k):
                b.faces.append((at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    plane = even_out(b.points, b.faces, 12)
    return [hull_point(x / 6, t / 2) for x, t in plane], b.faces


def even_out(points, faces, n_times):
    """Moves every inner vertex to the mean of its neighbours, n_times."""
    neighbours = {v: set() for v in range(len(points))}
    count = {}
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            neighbours[a].add(b)
            neighbours[b].add(a)
            count[frozenset((a, b))] = count.get(frozenset((a, b)), 0) + 1
    rim = set().union(*(edge for edge, n in count.items() if n == 1))
    for _ in range(n_times):
        points = [p if v in rim else mean([points[w] for w in sorted(neighbours[v])]) for v, p in enumerate(points)]
    return points


def hull_point(x, t):
    """Starboard: breadth grows from the keel (t = 0) to the deck (t = 1) and vanishes towards the bow (x = 1)."""
    plan = (1 - 0.35 * (1 - x) ** 2) * (1 - x**4 * (1 - 0.25 * t))
    frame = math.sin(0.5 * math.pi * t ** (0.75 + 0.9 * x))
    keel = -1.1 + 0.5 * x**6 + 0.25 * (1 - x) ** 3
    return (6 * x, -(0.05 + 1.6 * plan * frame), 1.5 * keel + (0.75 - 1.5 * keel + 0.3 * x * x) * t**1.4)


def sphere_cap(n=12, degrees=35, disturbance=0.1, seed=1):
    """A grid of n x n faces whose B-spline surface follows the unit sphere, the inside moved along the radius.

    Points of the sphere at the knots (stereographic projection of a square grid, extra rows around it) give the control
    points by the inverse of the mask (1, 4, 1) / 6 = 1 + D / 6, D the second difference, as a series: 1 - D / 6 + D^2 / 36 …
    """
    extra = 8
    size = math.tan(math.radians(degrees) / 2) / (n / 2)
    grid = [[on_sphere(size * (i - n / 2), size * (j - n / 2)) for i in range(-extra, n + extra + 1)]
            for j in range(-extra, n + extra + 1)]
    grid = [interpolating(row, extra) for row in grid]
    columns = [interpolating(list(column), extra) for column in zip(*grid)]
    random = Random(seed)
    points = []
    for j in range(n + 1):
        for i in range(n + 1):
            inner = min(i, j, n - i, n - j) >= 3
            points.append(scale(1 + (disturbance * random.next() if inner else 0), columns[i][j]))
    faces = [(v, v + 1, v + n + 2, v + n + 1) for j in range(n) for v in range(j * (n + 1), j * (n + 1) + n)]
    return points, faces


def on_sphere(x, y):
    q = x * x + y * y
    return (2 * x / (1 + q), 2 * y / (1 + q), (1 - q) / (1 + q))


def interpolating(values, n_terms):
    """Each term of the series costs one value at either end; what is left has 2 n_terms values less."""
    total = values[n_terms:-n_terms]
    difference = values
    for term in range(1, n_terms + 1):
        difference = [add(add(p, r), scale(-2, q)) for p, q, r in zip(difference, difference[1:], difference[2:])]
        cut = difference[n_terms - term:len(difference) - (n_terms - term)]
        total = [add(t, scale((-1 / 6) ** term, d)) for t, d in zip(total, cut)]
    return total


def tube(n_around=24, n_long=11, disturbance=0.1, seed=1):
    """Rings of control points whose B-spline surface follows the unit cylinder, the inside moved along the radius."""
    step = 2 * math.pi / n_around
    radius = 6 / (4 + 2 * math.cos(step))
    random = Random(seed)
    points = []
    for j in range(n_long + 1):
        for i in range(n_around):
            r = radius + (disturbance * random.next() if min(j, n_long - j) >= 3 else 0)
            points.append((r * math.cos(i * step), r * math.sin(i * step), (j - n_long / 2) * step))
    at = lambda i, j: j * n_around + i % n_around
    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(n_long) for i in range(n_around)]
    return points, faces


def star(valence, n=5):
    """valence sectors of n x n faces around one vertex, over a saddle."""
    b = Builder()
    spoke = [(math.cos(2 * math.pi * s / valence), math.sin(2 * math.pi * s / valence)) for s in range(valence)]
    for s in range(valence):
        e, f = spoke[s], spoke[(s + 1) % valence]

        def at(i, j):
            key = (s, i, j) if j else (s, i, 0)
            if i == 0:
                key = ((s + 1) % valence, j, 0) if j else "centre"
            # Diagonals are stretched or shortened so that the sectors stay near a disc of radius n.
            ring = max(i, j)
            x, y = add(scale(i, e), scale(j, f))
            length = math.hypot(x, y)
            if length:
                x, y = x * (0.5 + 0.5 * ring / length), y * (0.5 + 0.5 * ring / length)
            return b.vertex(key, (x, y, 0.06 * (x * x - y * y)))

        for j in range(n):
            for i in range(n):
                b.faces.append((at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    return b.mesh()


# ---------------------------------------------------------------- what is promised of each
def from_axis_of_pipe(p):
    axes = [(math.cos(2 * math.pi * t / 3), math.sin(2 * math.pi * t / 3), 0.0) for t in range(3)]
    nearest = max(axes, key=lambda a: dot(a, p))
    return subtract(p, scale(max(0.0, dot(nearest, p)), nearest))


UP = lambda p: (0, 0, 1)
# name: (mesh, what it is, special interior valences {valence: count}, boundary loops, genus, outward direction at a point;
# None: closed, judged by the signed volume)
MESHES = {
    "cube": (cube, "cube: all corners of valence 3", {3: 8}, 0, 0, None),
    "torus": (torus, "torus: regular and closed", {}, 0, 1, None),
    "genus2": (genus2, "block with two holes through it", {3: 8, 5: 16}, 0, 2, None),
    "genus3": (genus3, "two plates on four legs", {3: 8, 5: 24}, 0, 3, None),
    "pipe": (pipe, "three mitred tubes, two vertices of valence 6", {6: 2}, 3, 0, from_axis_of_pipe),
    "hull": (hull, "half a ship, a vertex of valence 3 and one of valence 5", {3: 1, 5: 1}, 1, 0,
             lambda p: (0, -1, -0.3)),
    "sphere_cap": (sphere_cap, "cap of the unit sphere, disturbed inside", {}, 1, 0, lambda p: p),
    "tube": (tube, "unit cylinder, disturbed inside", {}, 2, 0, lambda p: (p[0], p[1], 0)),
    **{f"star{k}": (lambda k=k: star(k), f"saddle, {k} sectors around a vertex", {k: 1}, 1, 0, UP) for k in (3, 5, 7, 12)},
}


def check(name, points, faces, specials, n_loops, genus, outward):
    """Raises ValueError unless the mesh is an oriented manifold of the promised kind, seen from outside."""

    def need(condition, what):
        if not condition:
            raise ValueError(f"{name}: {what}")

    following = {}
    leaving = {v: [] for v in range(len(points))}
    for f, face in enumerate(faces):
        need(len(face) == 4 and len(set(face)) == 4, f"face {f} is no quadrilateral")
        for a, b in zip(face, face[1:] + face[:1]):
            need((a, b) not in following, f"edge {a}-{b} has two faces on one side")
            following[a, b] = f
            leaving[a].append(b)
    rim = {a: b for (b, a) in following if (a, b) not in following}  # along the boundary, the surface at the right
    need(len(rim) == sum((b, a) not in following for a, b in following), "a vertex lies on two boundaries")
    found = {}
    for v, ends in leaving.items():
        need(ends, f"vertex {v} has no face")
        need(len(fan(v, faces, following, leaving, rim)) == len(ends), f"the faces at vertex {v} are not one fan")
        if v not in rim and len(ends) != 4:
            found[len(ends)] = found.get(len(ends), 0) + 1
    need(found == specials, f"valences {found}, promised {specials}")
    loops, left = 0, set(rim)
    while left:
        loops += 1
        start = v = next(iter(left))
        while v in left:
            left.remove(v)
            v = rim[v]
        need(v == start, "a boundary does not close")
    need(loops == n_loops, f"{loops} boundary loops, promised {n_loops}")
    n_edges = len({frozenset(edge) for edge in following})
    need(len(points) - n_edges + len(faces) == 2 - 2 * genus - loops, "wrong Euler characteristic")
    need(all(math.isfinite(x) for p in points for x in p), "a coordinate is not finite")
    if outward is None:
        volume = sum(dot(points[f[0]], cross(points[f[i]], points[f[i + 1]])) / 6 for f in faces for i in (1, 2))
        need(volume > 0, "faces are clockwise seen from outside")
    else:
        for f, face in enumerate(faces):
            p = [points[v] for v in face]
            normal = cross(subtract(p[2], p[0]), subtract(p[3], p[1]))
            need(dot(normal, outward(mean(p))) > 0, f"face {f} is clockwise seen from outside")


def fan(v, faces, following, leaving, rim):
    """The faces around v, anticlockwise from the boundary (or from anywhere)."""
    b = next((w for w in leaving[v] if (w, v) not in following), leaving[v][0]) if v in rim else leaving[v][0]
    seen = []
    while (v, b) in following and following[v, b] not in seen:
        f = following[v, b]
        seen.append(f)
        face = faces[f]
        b = face[face.index(v) - 1]
    return seen


def number(x):
    text = f"{x:.9f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    for name, (make, what, *promise) in MESHES.items():
        points, faces = make()
        check(name, points, faces, *promise)
        with open(os.path.join(folder, name + ".obj"), "w", encoding="ascii") as file:
            file.write(f"# fairsurf sample: {what}; {len(points)} vertices, {len(faces)} faces; made by make.py\n")
            for p in points:
                file.write("v " + " ".join(map(number, p)) + "\n")
            for face in faces:
                file.write("f " + " ".join(str(v + 1) for v in face) + "\n")
        print(f"{name}: {len(points)} vertices, {len(faces)} faces")


if __name__ == "__main__":
    main()
