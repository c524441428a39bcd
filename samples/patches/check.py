#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Test: make.py still makes the files of this folder, byte for byte."""
import pathlib
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, here / "make.py", folder], check=True, stdout=subprocess.DEVNULL)
    made = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
different = sorted(name for name in made if not (here / name).exists() or (here / name).read_bytes() != made[name])
print("differs from what make.py makes: " + ", ".join(different) if different else f"{len(made)} files are as made")
sys.exit(1 if different else 0)
