#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Test of check_layering.py: the tree passes, and each forbidden include added to a copy of it is found."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
CHECK = ROOT / "scripts" / "check_layering.py"
FORBIDDEN = [  # file, line added at its end
    ("core/mesh/mesh.c", "#include <fairsurf/fair.h>"),
    ("core/mesh/mesh.c", '#include "fair/fair.h"'),
    ("core/mesh/mesh.c", "#include <fairsurf/fairsurf.h>"),
    ("core/mesh/mesh.c", '#include "../fair/fair.h"'),
    ("core/optimise/levenberg.c", '#include "mesh/mesh.h"'),
    ("core/fair/fair.c", "#include <fairsurf/surface.h>"),
    ("include/fairsurf/mesh.h", "#include <fairsurf/space.h>"),
    ("include/fairsurf/surface_splines.h", "#include <fairsurf/construct_gap.h>"),
    ("exporters/povray.c", "#include <fairsurf/file.h>"),
    ("cli/main.c", '#include "mesh/mesh.h"'),
]


def run(root):
    return subprocess.run([sys.executable, CHECK, root], capture_output=True, text=True, check=False)


result = run(ROOT)
failures = [] if result.returncode == 0 else ["the tree itself:\n" + result.stdout + result.stderr]
for name, line in FORBIDDEN:
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder)
        for part in ("core", "include", "exporters", "cli", "samples"):
            shutil.copytree(ROOT / part, copy / part)
        path = copy / name
        text = path.read_text(encoding="utf-8")
        path.write_text(text + line + "\n", encoding="utf-8")
        place = f"{name}:{len(text.splitlines()) + 1}:"
        result = run(copy)
        if result.returncode != 1 or place not in result.stdout:
            failures.append(f"{line} in {name} was not found")
print("\n".join(failures) if failures else f"{len(FORBIDDEN)} forbidden includes are found")
sys.exit(1 if failures else 0)
