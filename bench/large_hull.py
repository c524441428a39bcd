#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a large hull with one vertex of valence 3 and one of valence 5 to fair: large_hull.py FAIRSURF OUT.obj [K [REFINEMENTS]]

The hull of samples/meshes with K x K faces in each of its six blocks, its vertices moved by a twentieth of an edge except
near the rim, which stays smooth, is refined by the program. K = 10 and 4 refinements (the defaults) leave about 120 000 free vertices.
"""
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "samples/meshes"))
import make  # noqa: E402

NOISE = 0.05  # by the mean length of edges
NEAR_RIM = 3  # so many rows of faces stay: what is fixed after refinement depends on them


def main(program, out, k=10, refinements=4):
    points, faces = make.hull(int(k))
    edges = {frozenset(edge) for face in faces for edge in zip(face, face[1:] + face[:1])}
    sides = [frozenset(edge) for face in faces for edge in zip(face, face[1:] + face[:1])]
    near = {v for edge in edges if sides.count(edge) == 1 for v in edge}
    length = sum(sum((a - b) ** 2 for a, b in zip(*(points[v] for v in edge))) ** 0.5 for edge in edges) / len(edges)
    for _ in range(NEAR_RIM):
        near |= {v for face in faces if near & set(face) for v in face}
    random = make.Random(1)
    points = [p if v in near else tuple(x + NOISE * length * random.next() for x in p) for v, p in enumerate(points)]
    with tempfile.NamedTemporaryFile("w", suffix=".obj") as coarse:
        coarse.writelines(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in points)
        coarse.writelines("f " + " ".join(str(v + 1) for v in face) + "\n" for face in faces)
        coarse.flush()
        command = [program, "refine", coarse.name, "--refine", str(refinements), "-o", out]
        subprocess.run(command if int(refinements) else [program, "export", coarse.name, "-o", out], check=True)


main(*sys.argv[1:])
