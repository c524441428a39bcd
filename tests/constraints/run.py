#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fairs samples under constraints by the command line and measures what was written: run.py FAIRSURF."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

FAIRSURF = pathlib.Path(sys.argv[1]).resolve()
MESHES = pathlib.Path(os.environ["FAIRSURF_SAMPLES"])
POINTS = MESHES.parent / "constraints"


def run(*words):
    result = subprocess.run([FAIRSURF, *map(str, words)], capture_output=True, check=False, text=True, timeout=250)
    assert result.returncode == 0, f"{words}: {result.stderr}"
    return result.stdout


def check(path, *words):
    return json.loads(run("check", path, "--json", *words))


def vertices(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    return [tuple(map(float, line.split()[1:4])) for line in lines if line.startswith("v ")]


def within(folder):
    """A tolerance to the start, and one to a mesh: the report tells it, and it is not exceeded."""
    for name, words in (("start", []), ("mesh", ["--stay-near", MESHES / "hull.obj"])):
        report = folder / f"{name}.json"
        run("fair", MESHES / "hull.obj", "--functional", "penalised", "--stay-within", 0.03, *words, "--report", report,
            "-q", "-o", folder / "near.obj")
        numbers = json.loads(report.read_text(encoding="utf-8"))
        assert 0.027 < numbers["distance"] <= 0.03, numbers["distance"]


def volume(folder):
    """The same volume of a net that is written and read again."""
    run("refine", MESHES / "cube.obj", "-o", folder / "start.obj")
    for what in ("volume", "area"):
        run("fair", folder / "start.obj", "--keep", what, "--functional", "penalised", "-q", "-o", folder / "kept.obj")
        before, after = (check(folder / name)["shape"][what] for name in ("start.obj", "kept.obj"))
        assert abs(after / before - 1) < 1e-10, (what, before, after)


def symmetry(folder):
    """Vertices are mirror images to the last bit, in the file too."""
    run("fair", MESHES / "pipe.obj", "--symmetry", "y", "--points", POINTS / "pipe_points.txt", "--functional", "penalised",
        "-q", "-o", folder / "mirrored.obj")
    found = set(vertices(folder / "mirrored.obj"))
    moved = [p for p in found if p not in set(vertices(MESHES / "pipe.obj"))]
    assert len(moved) > 100 and all((x, -y, z) in found for x, y, z in moved)


with tempfile.TemporaryDirectory() as name:
    for part in (within, volume, symmetry):
        part(pathlib.Path(name))
        print(part.__name__, "holds")
