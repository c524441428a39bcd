#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Other readers take our 3MF files: run.py --fairsurf EXE --out FOLDER

Python's zip and XML modules read the archives of a closed and of an open surface: parts, types, relationships, unit, points
and triangles as in the .ply of the same surface, and the volume. Where openscad is installed, it imports the closed one
(with lib3mf), cuts it, and the volume must be ours.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
MESHES = HERE / ".." / ".." / "samples" / "meshes"
sys.path.insert(0, str(HERE / ".." / "openscad"))
import solid  # noqa: E402

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
TYPES = "{http://schemas.openxmlformats.org/package/2006/content-types}"
RELATIONSHIPS = "{http://schemas.openxmlformats.org/package/2006/relationships}"
NAME = "a <b> & \"c\" é"


class Failure(Exception):
    """What is wrong, in one sentence."""


def must(command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, timeout=300)
    if result.returncode != 0:
        raise Failure(f"{' '.join(str(word) for word in command)} ends with {result.returncode}:\n{result.stderr}")
    return result


def expect(what, found, expected):
    if found != expected:
        raise Failure(f"{what}: {found!r} instead of {expected!r}")


def read_model(path):
    """The root of the model, found as a reader has to: by the relationships of the package."""
    with zipfile.ZipFile(path) as archive:
        expect("damaged part", archive.testzip(), None)
        expect("first part", archive.namelist()[0], "[Content_Types].xml")
        types = ElementTree.fromstring(archive.read("[Content_Types].xml"))
        by_extension = {node.get("Extension"): node.get("ContentType") for node in types.iter(TYPES + "Default")}
        relations = ElementTree.fromstring(archive.read("_rels/.rels"))
        target = [node.get("Target") for node in relations.iter(RELATIONSHIPS + "Relationship")
                  if node.get("Type") == "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"]
        expect("start parts", len(target), 1)
        expect("type of the model", by_extension.get(target[0].rsplit(".", 1)[1]),
               "application/vnd.ms-package.3dmanufacturing-3dmodel+xml")
        expect("type of the relationships", by_extension.get("rels"),
               "application/vnd.openxmlformats-package.relationships+xml")
        return ElementTree.fromstring(archive.read(target[0].lstrip("/")))


def check(arguments, mesh, kind):
    threemf, ply = arguments.out / f"{mesh}.3mf", arguments.out / f"{mesh}.ply"
    must([arguments.fairsurf, "export", MESHES / f"{mesh}.obj", "-q", "--name", NAME, "--steps", 4, "-o", threemf,
          "--surface", "-o", ply])
    points, _, faces = solid.read_ply(ply)
    model = read_model(threemf)
    expect("root", model.tag, CORE + "model")
    expect("unit", model.get("unit"), "millimeter")
    expect("title", [node.text for node in model.iter(CORE + "metadata") if node.get("name") == "Title"], [NAME])
    objects = list(model.iter(CORE + "object"))
    expect("objects", [(node.get("type"), node.get("name")) for node in objects], [(kind, NAME)])
    expect("items to build", [node.get("objectid") for node in model.iter(CORE + "item")], [objects[0].get("id")])
    theirs = [tuple(float(node.get(axis)) for axis in "xyz") for node in model.iter(CORE + "vertex")]
    triangles = [[int(node.get(corner)) for corner in ("v1", "v2", "v3")] for node in model.iter(CORE + "triangle")]
    expect("triangles", triangles, faces)
    largest = max(abs(a - b) for p, q in zip(points, theirs) for a, b in zip(p, q))
    expect("points", len(theirs), len(points))
    if not largest <= 5e-9 * max(abs(c) for p in points for c in p) + 1e-300:
        raise Failure(f"the points differ by {largest:.1e}")
    expect("closed", solid.count_open_sides(triangles) == 0, kind == "model")
    print(f"{mesh}: {len(theirs)} points, {len(triangles)} triangles, type {kind}, points differ by {largest:.1e}")
    return threemf, points, faces


def check_openscad(arguments, threemf, points, faces):
    source, target = arguments.out / "cut.scad", arguments.out / "cut.stl"
    source.write_text(f'difference() {{ import("{threemf.name}"); translate([-1000, -1000, 0.1]) cube(2000); }}\n',
                      encoding="ascii")
    log = must(["openscad", "-o", target, source]).stderr
    if re.search(r"^(WARNING|ERROR)", log, re.M):
        raise Failure(log)
    ours, theirs = solid.volume_below(points, faces, 0.1), solid.volume_below(*solid.read_stl(target))
    print(f"cut by OpenSCAD: ours {ours:.9g}, OpenSCAD's {theirs:.9g}, relative difference {abs(ours - theirs) / ours:.1e}")
    if not abs(ours - theirs) <= 1e-4 * ours:
        raise Failure("the volumes differ")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fairsurf", required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    try:
        check(arguments, "pipe", "surface")
        closed = check(arguments, "genus2", "model")
        if shutil.which("openscad") is not None:
            check_openscad(arguments, *closed)
        else:
            print("openscad is not installed: its reader was not asked")
    except Failure as failure:
        print(failure)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
