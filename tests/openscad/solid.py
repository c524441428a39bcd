# SPDX-License-Identifier: MIT
"""Solids as points and triangles: readers, volumes, and the solid that a wall makes of an open surface."""
import math
import struct


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def read_stl(path):
    """Points and triangles of an ascii STL file, each triangle with points of its own."""
    words = path.read_text(encoding="ascii").split()
    at = [k for k, word in enumerate(words) if word == "vertex"]
    points = [tuple(float(word) for word in words[k + 1:k + 4]) for k in at]
    return points, [[k, k + 1, k + 2] for k in range(0, len(points), 3)]


def read_ply(path):
    """Points, normals and triangles of a binary PLY file as fairsurf writes it."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode("ascii").splitlines()
    counts = {line.split()[1]: int(line.split()[2]) for line in header if line.startswith("element")}
    n_points, n_faces = counts["vertex"], counts["face"]
    rows = [struct.unpack_from("<3d3f", data, end + 36 * k) for k in range(n_points)]
    end += 36 * n_points
    faces = [list(struct.unpack_from("<B3i", data, end + 13 * k)[1:]) for k in range(n_faces)]
    return [row[:3] for row in rows], [row[3:] for row in rows], faces


def thicken(points, normals, faces, outer, inner):
    """Closed solid between the surface moved by outer and by -inner along its normals."""
    n = len(points)
    moved = [tuple(p[c] + d * m[c] for c in range(3)) for d in (outer, -inner) for p, m in zip(points, normals)]
    sides = {(f[k], f[k - 2]) for f in faces for k in range(3)}
    solid = [list(f) for f in faces] + [[n + f[2], n + f[1], n + f[0]] for f in faces]
    for a, b in sides:
        if (b, a) not in sides:
            solid += [[b, a, n + b], [a, n + a, n + b]]  # cut as the module cuts the rim
    return moved, solid


def count_open_sides(faces):
    sides = {(f[k - 1], f[k]) for f in faces for k in range(len(f))}
    return sum((b, a) not in sides for a, b in sides)


def volume_below(points, faces, height=math.inf):
    """Volume of the part z < height of a closed solid. By the divergence theorem for (0, 0, z - height), to which the cut
    itself adds nothing, with the skin clipped exactly."""
    if height == math.inf:
        origin = points[0]
        return sum(dot(subtract(points[f[0]], origin), cross(subtract(points[f[k]], origin),
                                                             subtract(points[f[k + 1]], origin)))
                   for f in faces for k in range(1, len(f) - 1)) / 6
    total = 0.0
    for face in faces:
        polygon = clip([points[v] for v in face], height)
        for k in range(1, len(polygon) - 1):
            a, b, c = polygon[0], polygon[k], polygon[k + 1]
            area = cross(subtract(b, a), subtract(c, a))[2] / 2
            total += area * ((a[2] + b[2] + c[2]) / 3 - height)
    return total


def clip(polygon, height):
    below = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        if a[2] <= height:
            below.append(a)
        if (a[2] < height < b[2]) or (b[2] < height < a[2]):
            t = (height - a[2]) / (b[2] - a[2])
            below.append((a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), height))
    return below
