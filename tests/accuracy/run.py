#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures how accurate fairing is, and prints a row per figure: run.py FAIRSURF MESHES [PART...].

MESHES holds the third-party meshes of the tests (docs/accuracy.md). Takes minutes on one core. Without parts: all of them.
Exits with 1 where a figure misses its limit.
"""
import pathlib
import shutil
import sys

import closed_surfaces
import constrained
import open_surfaces
import tool

PARTS = {"linear": open_surfaces.linear, "noise": open_surfaces.noise, "full": open_surfaces.full,
         "cube": closed_surfaces.cube, "handles": closed_surfaces.handles, "kept": closed_surfaces.kept,
         "constraints": constrained.all_kinds}


def main():
    tool.Program.path = pathlib.Path(sys.argv[1]).resolve()
    meshes = pathlib.Path(sys.argv[2])
    for name in sys.argv[3:] or PARTS:
        PARTS[name](meshes)
    shutil.rmtree(tool.FOLDER)
    sys.exit(not all(row[-1] for row in tool.ROWS))


main()
