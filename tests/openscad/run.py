#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""OpenSCAD takes our files: run.py --fairsurf EXE --out FOLDER [--compare EXE] CASE

Each case writes a surface as .scad, uses it in a difference with a cube, and compares the volume that OpenSCAD has made with
our own, which comes from the points and exact normals of the same surface in .ply. Exits with 77 where openscad is absent.

Cases: pipe (a fair three-way pipe, open), hull (a panel, open; its name is a word of OpenSCAD's), genus2 (closed),
plugin (the way
through plugins/openscad/smooth), picture (the cut pipe against reference/), red (a surface with a hole must be refused: proof that the others would see it).
"""
import argparse
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys

import solid

HERE = pathlib.Path(__file__).resolve().parent
MESHES = HERE / ".." / ".." / "samples" / "meshes"
PLUGIN = HERE / ".." / ".." / "plugins" / "openscad"
SKIPPED = 77
PRECISION = 1e-4
# mesh, command, module, steps, height of the cut
CASES = {"pipe": ("pipe.obj", ["fair", "--functional", "penalised"], "pipe", 3, 0.1),
         "hull": ("hull.obj", ["export"], "hull_surface", 4, 0.1),
         "genus2": ("genus2.obj", ["export"], "genus2", 5, 0.1)}
CUBE = "translate([-1000, -1000, %r]) cube(2000);"


class Failure(Exception):
    """What is wrong, in one sentence."""


def run(command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, timeout=550,
                          **options)


def must(command, **options):
    result = run(command, **options)
    if result.returncode != 0:
        raise Failure(f"{' '.join(str(word) for word in command)} ends with {result.returncode}:\n{result.stderr}")
    return result


def openscad(source, target, *options):
    """Messages of OpenSCAD; any warning or error is a failure."""
    result = must(["openscad", *options, "-o", target, source])
    wrong = [line for line in result.stderr.splitlines() if re.match(r"(WARNING|ERROR|TRACE|DEPRECATED)", line)]
    if wrong:
        raise Failure(f"{source}: {wrong[0]}")
    return result.stderr


def agree(what, ours, theirs):
    difference = abs(theirs - ours) / abs(ours)
    print(f"{what}: ours {ours:.9g}, OpenSCAD's {theirs:.9g}, relative difference {difference:.1e}")
    if not difference <= PRECISION:
        raise Failure(f"{what}: the volumes differ by {difference:.1e}")


def make(arguments, name):
    """The .scad file and the surface as points, normals and triangles."""
    mesh, command, _, steps, _ = CASES[name]
    scad, ply = arguments.out / f"{name}.scad", arguments.out / f"{name}.ply"
    must([arguments.fairsurf, *command, MESHES / mesh, "-q", "--functional", "penalised", "--steps", steps, "-o", scad,
          "--surface", "-o", ply])
    return scad, solid.read_ply(ply)


def cut(arguments, name, call, label):
    """Volume of what OpenSCAD leaves of the module below the height of the cut."""
    source, target = arguments.out / f"{label}.scad", arguments.out / f"{label}.stl"
    source.write_text(f"use <{name}.scad>\ndifference() {{ {call} {CUBE % CASES[name][4]} }}\n", encoding="ascii")
    log = openscad(source, target)
    if not re.search(r"Simple:\s+yes", log):
        raise Failure(f"{label}: what is left is no simple solid:\n{log}")
    return solid.volume_below(*solid.read_stl(target))


def check_solid(arguments, name):
    module, height = CASES[name][2], CASES[name][4]
    scad, (points, normals, faces) = make(arguments, name)
    text = scad.read_text(encoding="ascii")
    wall = re.search(r"^wall = (\S+);", text, re.M)
    is_open = solid.count_open_sides(faces) > 0
    if is_open != (wall is not None):
        raise Failure("open surfaces have a wall, closed ones none")
    if not is_open:
        agree("whole", solid.volume_below(points, faces), plain(arguments, scad, "whole"))
        agree("cut", solid.volume_below(points, faces, height), cut(arguments, name, f"{module}();", f"{name}-cut"))
        return
    wall = float(wall.group(1))
    for side in (-1, 0, 1):
        ours = solid.thicken(points, normals, faces, (1 + side) / 2 * wall, (1 - side) / 2 * wall)
        if solid.count_open_sides(ours[1]) > 0:
            raise Failure("the solid of the test is not closed")
        agree(f"whole, side {side}", solid.volume_below(*ours),
              plain(arguments, scad, f"side{side}", "-D", f"wall={wall!r}", "-D", f"side={side}"))
        if side < 1:
            agree(f"cut, side {side}", solid.volume_below(*ours, height),
                  cut(arguments, name, f"{module}(wall = {wall!r}, side = {side});", f"{name}-cut{side}"))
    check_vnf(arguments, name)
    check_fold(arguments, name)


def plain(arguments, scad, label, *options):
    """Volume of the file itself as OpenSCAD shows it, without a Boolean operation."""
    target = arguments.out / f"{scad.stem}-{label}.stl"
    openscad(scad, target, *options)
    return solid.volume_below(*solid.read_stl(target))


def check_vnf(arguments, name):
    """The function gives the surface alone where wall is 0, and the language's own words still mean what they did."""
    module = CASES[name][2]
    source = arguments.out / f"{name}-vnf.scad"
    source.write_text(f"use <{name}.scad>\n"
                      f"vnf = {module}_vnf(wall = 0);\n"
                      f"echo(sizes = [len(vnf[0]), len(vnf[1])]);\n"
                      f"hull() {{ cube(1); translate([3, 0, 0]) cube(1); }}\n", encoding="ascii")
    target = arguments.out / f"{name}-vnf.stl"
    log = openscad(source, target)
    _, _, faces = solid.read_ply(arguments.out / f"{name}.ply")
    points = 1 + max(max(f) for f in faces)
    if f"sizes = [{points}, {len(faces)}]" not in log:
        raise Failure(f"{module}_vnf(wall = 0) is not the surface alone: {log}")
    agree("hull of two cubes", 4.0, solid.volume_below(*solid.read_stl(target)))


def check_fold(arguments, name):
    """A wall thicker than the radius of curvature is told of in OpenSCAD too."""
    source = arguments.out / f"{name}-fold.scad"
    source.write_text(f"use <{name}.scad>\n{CASES[name][2]}(wall = 1e5, side = 1);\n", encoding="ascii")
    result = must(["openscad", "-o", arguments.out / f"{name}-fold.csg", source])
    if "the wall folds outwards" not in result.stderr:
        raise Failure("no word about a wall that folds")


def check_picture(arguments):
    make(arguments, "pipe")
    source, picture = arguments.out / "picture.scad", arguments.out / "pipe.png"
    source.write_text(f"use <pipe.scad>\ndifference() {{ pipe(); {CUBE % 0.1} }}\n", encoding="ascii")
    must(["xvfb-run", "-a", "openscad", "-o", picture, "--render", "--imgsize=480,360", "--viewall", "--autocenter",
          "--colorscheme=Tomorrow", source])
    result = run([arguments.compare, picture, HERE / "reference" / "pipe.png", "--tolerance", 16, "--pixels", 500,
                  "--difference", arguments.out / "difference.png"])
    print(result.stdout.strip())
    if result.returncode != 0:
        raise Failure(f"the picture differs from the reference: {result.stderr}")


def check_plugin(arguments):
    """A cage made in OpenSCAD, its smooth surface, and a part made of that."""
    scad, net, ply = (arguments.out / f"frame{suffix}" for suffix in (".scad", ".off", ".ply"))
    smooth = [PLUGIN / "smooth", PLUGIN / "frame_cage.scad", scad, "export", "--steps", "4"]
    log = must(smooth, env={**os.environ, "FAIRSURF": arguments.fairsurf}).stderr
    if "inside out" in log:
        raise Failure(log)
    openscad(PLUGIN / "frame_cage.scad", net)
    if not all(line.startswith("4 ") for line in net.read_text(encoding="ascii").splitlines()[-40:]):
        raise Failure("the cage has lost its quadrilaterals")
    must([arguments.fairsurf, "export", net, "-q", "--steps", 4, "--surface", "-o", ply])
    points, _, faces = solid.read_ply(ply)
    ours = solid.volume_below(points, faces)
    agree("frame", ours, plain(arguments, scad, "whole"))
    source, target = arguments.out / "frame_part.scad", arguments.out / "frame_part.stl"
    shutil.copy(PLUGIN / "frame_part.scad", source)
    openscad(source, target)
    holes = ours - solid.volume_below(*solid.read_stl(target))
    # two prisms of 48 sides, 2 round, through a thickness between 6 and 8
    base = 48 * 2**2 * math.sin(2 * math.pi / 48) / 2
    print(f"holes: {holes:.6g}, {holes / base / 2:.4g} deep")
    if not 6 < holes / base / 2 < 8:
        raise Failure("the holes do not have the depth of the frame")


def check_red(arguments):
    """A face left out of the closed surface: OpenSCAD must refuse it, and our own count must see it."""
    scad, (points, _, faces) = make(arguments, "genus2")
    text = scad.read_text(encoding="ascii")
    scad.write_text(re.sub(r"(genus2_faces = \[\n)\[[^\n]*\n", r"\1", text), encoding="ascii")
    if solid.count_open_sides(faces[1:]) != 3:
        raise Failure("the hole is not seen here")
    try:
        cut(arguments, "genus2", "genus2();", "red")
    except Failure as failure:
        print(f"seen: {str(failure).splitlines()[-1]}")
        return
    raise Failure("OpenSCAD took a surface with a hole")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fairsurf", required=True)
    parser.add_argument("--compare")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("case", choices=[*CASES, "plugin", "picture", "red"])
    arguments = parser.parse_args()
    needed = ["openscad"] + (["xvfb-run"] if arguments.case == "picture" else [])
    absent = [program for program in needed if shutil.which(program) is None]
    if absent:
        print(f"skipped: {absent[0]} is not installed")
        return SKIPPED
    arguments.out.mkdir(parents=True, exist_ok=True)
    try:
        if arguments.case == "picture":
            check_picture(arguments)
        elif arguments.case == "plugin":
            check_plugin(arguments)
        elif arguments.case == "red":
            check_red(arguments)
        else:
            check_solid(arguments, arguments.case)
    except Failure as failure:
        print(failure)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
