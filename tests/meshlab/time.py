#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long a fair surface takes in meshlabserver, beside the command line: not a test, since times depend on the machine.

Usage: time.py --fairsurf PROGRAM --describe PROGRAM --plugin FILE [--runs N]
The mesh is the pipe of the samples, refined once: 1403 vertices. Both make the control net on one thread at a time of the
processor, in turn; the least times of N runs count. Goal: at most 1.2 times, with MeshLab's start and end.
"""
import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time

import run as tests


def measure(action):
    """(wall time, processor time) in seconds."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    action()
    after, wall = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic() - start
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fairsurf", required=True)
    parser.add_argument("--describe", required=True)
    parser.add_argument("--plugin", action="append", required=True)
    parser.add_argument("--runs", type=int, default=5)
    arguments = parser.parse_args()
    if "DISPLAY" not in os.environ:
        return subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 640x480x24", sys.executable, *sys.argv],
                              check=False).returncode
    with tempfile.TemporaryDirectory() as folder:
        arguments.out = folder
        tools = tests.Tools(arguments)
        tests.write_ply(tools.path("pipe.ply"), tests.mesh_of("pipe"))
        start = tools.path("start.ply")
        tools.cli("refine", tools.path("pipe.ply"), "-o", start, "--format", "ascii")
        best = [(1e9, 1e9), (1e9, 1e9)]
        for _ in range(arguments.runs):
            times = (measure(lambda: tools.apply(start, tools.path("a.ply"), "Fair surface", ["result=1", "caps=linear"])),
                     measure(lambda: tools.cli("fair", start, "--caps", "linear", "-q", "-o", tools.path("b.ply"))))
            best = [tuple(map(min, old, new)) for old, new in zip(best, times)]
    for name, (wall, processor) in zip(("meshlabserver", "fairsurf fair"), best):
        print(f"{name}: {wall:.2f} s, {processor:.2f} s of the processor")
    print(f"ratio {best[0][0] / best[1][0]:.2f}, of the processor {best[0][1] / best[1][1]:.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
