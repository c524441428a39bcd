#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks for cracks of a rendered sample: cracks.py --fairsurf EXE --crack EXE --out FOLDER [--red] FILE [COMMAND...]

The file is a mesh, or what the command reads; the command, with its options, is export unless given.
Six views, side by side in one picture, without antialiasing: three from around, three that belong to the first special
vertex of the mesh: along its normal, and low along two of its spokes (three fixed ones where the file is no OBJ). The
bicubic form is compared with triangles from
64 x 64 cells per patch; what counts as a crack is said in crack.c. The inside of the surface has a colour of its own, so
that a crack shows even where there is more surface behind it.
With --red one shared edge of a patch is moved by 1e-3 of the size, and a crack must be found.
"""
import argparse
import math
import pathlib
import shutil
import subprocess
import sys

import render

TILE = 320  # pixels per view


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


def unit(a):
    return scale(1 / math.hypot(*a), a)


AROUND = [unit((2.3, -2.9, 2.3)), unit((-2, 1.2, 0.9)), unit((0.3, 0.4, -1))]


def special_vertex(faces):
    """The first interior vertex of valence other than 4, and its neighbours; 0 and its neighbours where there is none."""
    edges = {}
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            edges.setdefault(a, []).append(b)
    inner = [v for v, ends in edges.items() if all(v in edges[w] for w in ends)]
    special = [v for v in sorted(inner) if len(edges[v]) != 4]
    v = (special or sorted(edges))[0]
    return v, edges[v]


def directions(points, faces):
    """Six directions from the surface to the camera."""
    v, neighbours = special_vertex(faces)
    normal = (0, 0, 0)
    for face in faces:
        if v in face:
            at = face.index(v)
            before, after = points[face[at - 1]], points[face[(at + 1) % len(face)]]
            normal = add(normal, unit(cross(subtract(after, points[v]), subtract(before, points[v]))))
    normal = unit(normal)
    low = []
    for w in (neighbours[0], neighbours[len(neighbours) // 2]):
        spoke = unit(subtract(points[v], points[w]))
        low.append(unit(add(spoke, scale(0.5, normal))))
    return [*AROUND, normal, *low]


def rotation_to_view(towards):
    """Rows right, up, back: what turns the surface so that the camera of the picture, on +z, sees it from towards."""
    up = (0, 0, 1) if abs(towards[2]) < 0.9 else (0, 1, 0)
    right = unit(cross(up, towards))
    return right, cross(towards, right), towards


def scene_text(include, name, corners, views):
    """An orthographic picture of 3 x 2 copies; x to the right, y up, the camera on +z looking down."""
    middle, radius = scale(0.5, add(*corners)), math.dist(*corners) / 2
    step = 2.1 * radius
    lines = [
        "#version 3.7;", "global_settings { assumed_gamma 1.0 }", f'#include "{include}"', "background { rgb <0, 0, 1> }",
        f"camera {{ orthographic location <0, 0, {10 * radius}> direction -z right x * {3 * step} up y * {2 * step} }}",
        "#declare Flat = finish { ambient 0 emission 1 diffuse 0 }",
        f"#declare Distance = pigment {{ gradient z color_map {{ [0 srgb <0.25, 0, 0>] [1 srgb <1, 0, 0>] }}"
        f" scale {2.2 * radius} translate {-1.1 * radius} * z }}",
    ]
    for k, towards in enumerate(views):
        right, up, back = rotation_to_view(towards)
        # POV-Ray multiplies a row vector with the matrix.
        values = [row[c] for c in range(3) for row in (right, up, back)]
        x, y = (k % 3 - 1) * step, (0.5 - k // 3) * step
        lines.append(f"object {{ {name}\n  translate <{-middle[0]}, {-middle[1]}, {-middle[2]}>\n"
                     f"  matrix <{', '.join(map(repr, values))}, 0, 0, 0>\n  translate <{x}, {y}, 0>\n"
                     "  texture { pigment { Distance } finish { Flat } }\n"
                     "  interior_texture { pigment { rgb <0, 1, 0> } finish { Flat } }\n}")
    return "\n".join(lines) + "\n"


def open_edge(path, towards):
    """Moves the first row of points of the patch nearest to the first camera by 1e-3 of the size, into the patch."""
    inc = path.read_text(encoding="utf-8")
    size = math.dist(*render.box(inc, "sample"))

    def nearness(match):
        p = render.vectors(match.group(0))[-16:]
        normal = cross(subtract(p[12], p[0]), subtract(p[3], p[0]))
        return dot(p[0], towards) / size + 2 * dot(normal, towards) / (math.hypot(*normal) or 1)

    patch = max(render.PATCH.finditer(inc), key=nearness, default=None)
    if patch is None:
        raise render.Failure("the scene holds no bicubic_patch")
    p = render.vectors(patch.group(0))[-16:]
    shift = scale(1e-3 * size, unit(subtract(p[5], p[1])))
    head = patch.group(0)[:[m.start() for m in render.VECTOR.finditer(patch.group(0))][-16]]
    moved = [add(q, shift) if k < 4 else q for k, q in enumerate(p)]
    text = head + ", ".join(f"<{q[0]!r}, {q[1]!r}, {q[2]!r}>" for q in moved) + " }"
    path.write_text(inc[:patch.start()] + text + inc[patch.end():], encoding="utf-8")


def make_picture(arguments, form, steps, views):
    """Exports the mesh in a form, and renders the six views."""
    folder = arguments.out / form
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    extra = ["--pov-steps", str(steps)] if steps else []
    command, *options = arguments.command or ["export"]
    render.run([arguments.fairsurf, command, arguments.mesh, *options, "--pov", form, *extra, "--name", "sample", "-o",
                folder / "sample.pov"], folder, folder / "fairsurf.log")
    inc = folder / "sample.inc"
    if arguments.red and form == "bicubic":
        open_edge(inc, views[0])
    scene = folder / "views.pov"
    with open(inc, encoding="utf-8") as file:
        head = file.read(20000)
    scene.write_text(scene_text(inc.name, "sample", render.box(head, "sample"), views), encoding="utf-8")
    picture = render.render(scene, 3 * TILE, 2 * TILE, False)
    if form == "mesh2":
        inc.unlink()  # tens of megabytes
    return picture


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fairsurf", type=pathlib.Path, required=True)
    parser.add_argument("--crack", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--steps", type=int, default=6, help="the fine form has 2^steps x 2^steps cells per patch")
    parser.add_argument("--red", action="store_true")
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    for path in ("fairsurf", "crack", "out", "mesh"):
        setattr(arguments, path, getattr(arguments, path).resolve())
    render.need_povray()
    if arguments.mesh.suffix == ".obj":
        views = directions(*render.read_obj(arguments.mesh))
    else:
        views = AROUND + [unit((0, 0, 1)), unit((1, 1, 0.4)), unit((-1, -0.5, 0.5))]
    picture = make_picture(arguments, "bicubic", 0, views)
    fine = make_picture(arguments, "mesh2", arguments.steps, views)
    result = subprocess.run([arguments.crack, picture, fine, arguments.out / "cracks.png"],
                            capture_output=True, text=True, check=False)
    print((result.stdout + result.stderr).strip())
    if result.returncode > 1:
        return 1
    if arguments.red and result.returncode == 0:
        print("an edge moved by 1e-3 of the size was not found")
    return int((result.returncode == 1) != arguments.red)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except render.Failure as failure:
        print(failure)
        sys.exit(1)
