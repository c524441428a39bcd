#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Renders cases of cases.txt and compares them with reference/.

Usage: run.py --fairsurf EXE --compare EXE --out FOLDER [--update | --red VERTEX] [NAME...]

With --update the references are written instead. With --red VERTEX this control point of the mesh is moved by 1 % of its
size first, and the comparison must fail: proof that the test sees such a change.
"""
import argparse
import math
import pathlib
import shutil
import subprocess
import sys

import render

HERE = pathlib.Path(__file__).resolve().parent
MESHES = HERE / ".." / ".." / "samples" / "meshes"
# Another compiler or C library changes the last bit of a channel, and a few pixels at silhouettes, hard stripes and lines.
TOLERANCE, PIXELS = 2, 20
WIDTH, HEIGHT = 320, 240
PLOT_WIDTH = 360


def read_cases():
    lines = (line.split("#")[0].split() for line in (HERE / "cases.txt").read_text(encoding="utf-8").splitlines())
    return {words[0]: words[1:] for words in lines if words}


def is_drawing(name):
    return name.startswith("plot-")


def make_scene(arguments, name, case):
    mesh, command, *options = case
    scene = arguments.out / f"{name}{'.svg' if is_drawing(name) else '.pov'}"
    path = MESHES / mesh
    if arguments.red is not None:
        move_point(path, arguments.red, arguments.out / mesh)
        path = arguments.out / mesh
    render.run([arguments.fairsurf, command, path, *options, "-o", scene], arguments.out,
               arguments.out / f"{name}.fairsurf.log")
    return scene


def compare(arguments, name, picture):
    difference = arguments.out / f"{name}.difference.png"
    result = subprocess.run([arguments.compare, picture, HERE / "reference" / f"{name}.png", "--tolerance",
                             str(TOLERANCE), "--pixels", str(PIXELS), "--difference", difference],
                            capture_output=True, text=True, check=False)
    print(f"{name}: {(result.stdout + result.stderr).strip()}")
    if result.returncode > 1:
        raise render.Failure("the comparison did not take place")
    return result.returncode == 0


def move_point(path, vertex, moved):
    """Copies an OBJ file, one vertex (from 0) moved up by 1 % of the diagonal of the mesh."""
    points, _ = render.read_obj(path)
    size = math.dist(*[[end(p[c] for p in points) for c in range(3)] for end in (min, max)])
    lines = path.read_text(encoding="ascii").splitlines()
    at = [k for k, line in enumerate(lines) if line.startswith("v ")][vertex]
    x, y, z = points[vertex]
    lines[at] = f"v {x!r} {y!r} {z + 0.01 * size!r}"
    moved.write_text("\n".join(lines) + "\n", encoding="ascii")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fairsurf", type=pathlib.Path, required=True)
    parser.add_argument("--compare", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--red", type=int, metavar="VERTEX")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    for path in ("fairsurf", "compare", "out"):
        if getattr(arguments, path):
            setattr(arguments, path, getattr(arguments, path).resolve())
    cases = read_cases()
    names = arguments.names or list(cases)
    if any(is_drawing(name) for name in names):
        render.need_rsvg()
    if not all(is_drawing(name) for name in names):
        render.need_povray()
    arguments.out.mkdir(parents=True, exist_ok=True)
    failed = False
    for name in names:
        if name not in cases:
            raise render.Failure(f"cases.txt has no case {name}")
        scene = make_scene(arguments, name, cases[name])
        picture = (render.render_svg(scene, PLOT_WIDTH) if scene.suffix == ".svg" else
                   render.render(scene, WIDTH, HEIGHT, True))
        if arguments.update:
            (HERE / "reference").mkdir(exist_ok=True)
            shutil.copy(picture, HERE / "reference" / f"{name}.png")
            print(f"{name}: reference written")
        else:
            failed |= compare(arguments, name, picture) == (arguments.red is not None)
    if failed and arguments.red is not None:
        print("a control point moved by 1 % of the size was not seen")
    return 1 if failed else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except render.Failure as failure:
        print(failure)
        sys.exit(1)
