# SPDX-License-Identifier: MIT
"""What the measurements share: running the program on one core, meshes and their noise, points of what was written."""
import json
import math
import os
import pathlib
import random
import resource
import subprocess
import tempfile

FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="accuracy-"))
ROWS = []  # (line of the table, what, limit, figure, holds)


class Program:
    path = None


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(*words, code=0):
    """The program on one core; returns (what it said, CPU seconds)."""
    before = cpu_seconds()
    result = subprocess.run(["taskset", "-c", os.environ.get("ACCURACY_CORE", "0"), Program.path, *map(str, words)], capture_output=True,
                            check=False, text=True)
    assert result.returncode == code, f"{' '.join(map(str, words))}: exit {result.returncode}\n{result.stderr}"
    return result.stdout + result.stderr, cpu_seconds() - before


def fair(mesh, name, *words):
    """FOLDER/name.ply; its report, with the CPU seconds of the process as "cpu"."""
    path, report = FOLDER / f"{name}.ply", FOLDER / f"{name}.json"
    _, seconds = run("fair", mesh, *words, "-q", "--report", report, "-o", path)
    return path, json.loads(report.read_text(encoding="utf-8")) | {"cpu": seconds}


def measure(path, *words):
    """The report of a written net by 24 nodes everywhere."""
    report = FOLDER / "measure.json"
    run("fair", path, *words, "--nodes", 24, "--max-iterations", 0, "-q", "--report", report)
    return json.loads(report.read_text(encoding="utf-8"))


def check(path, *words):
    return json.loads(run("check", path, "--json", *words)[0])


def row(line, what, limit, figure, holds):
    ROWS.append((line, what, limit, figure, holds))
    print(f"{'holds ' if holds else 'MISSED'} {line:4} {what}: {figure} ({limit})", flush=True)


def at_most(line, what, limit, value):
    row(line, what, f"<= {limit:g}", f"{value:.6g}", value <= limit)


def at_least(line, what, limit, value):
    row(line, what, f">= {limit:g}", f"{value:.6g}", value >= limit)


# ---------------------------------------------------------------- meshes
def read_obj(path):
    points, faces = [], []
    for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return points, faces


def write_obj(path, points, faces):
    lines = ["v %.17g %.17g %.17g" % tuple(p) for p in points]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in faces]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def sides(face):
    return zip(face, face[1:] + face[:1])


def rim(n, faces):
    """Vertices at face distance 2 or less from the boundary, which fairing keeps."""
    directed = {side for face in faces for side in sides(face)}
    found = {v for a, b in directed if (b, a) not in directed for v in (a, b)}
    for _ in range(2):
        found |= {v for face in faces if found & set(face) for v in face}
    assert len(found) <= n
    return found


def read_marks(path):
    """Numbers of the fixed vertices: a line "17", or "17 fixed ..."."""
    lines = [line.split() for line in path.read_text(encoding="utf-8").splitlines() if line[:1] != "#"]
    return {int(words[0]) for words in lines if words and words[1:2] != ["free"]}


def add_noise(source, name, part, seed, marks=()):
    """FOLDER/name.obj: free vertices moved by Gaussian noise of so many parts of the edges around them."""
    points, faces = read_obj(source)
    kept, generator = rim(len(points), faces) | set(marks), random.Random(seed)
    lengths = [[] for _ in points]
    for face in faces:
        for a, b in sides(face):
            lengths[a].append(math.dist(points[a], points[b]))
    moved = [p if v in kept else
             [x + generator.gauss(0, part * sum(lengths[v]) / len(lengths[v])) for x in p]
             for v, p in enumerate(points)]
    return write_obj(FOLDER / f"{name}.obj", moved, faces)


def surface_points(path, name, steps, *words):
    """Points of the surface of a net, steps x steps cells per patch."""
    out = FOLDER / f"{name}.surface.obj"
    run("export", path, *words, "--surface", "-o", out, "--steps", steps)
    return read_obj(out)[0]


def sphere_deviation(points):
    """max |r / R - 1| about the centre and the radius of least squares: |p|^2 = 2 p.m + (R^2 - m^2) is linear in them."""
    matrix, right = [[0.0] * 4 for _ in range(4)], [0.0] * 4
    for p in points:
        line = (*p, 1.0)
        square = sum(x * x for x in p)
        for i in range(4):
            right[i] += line[i] * square
            for j in range(4):
                matrix[i][j] += line[i] * line[j]
    solution = solve(matrix, right)
    centre = [0.5 * x for x in solution[:3]]
    radius = math.sqrt(solution[3] + sum(x * x for x in centre))
    return max(abs(math.dist(p, centre) / radius - 1) for p in points)


def solve(matrix, right):
    """Gauss elimination with pivots."""
    n, rows = len(right), [line + [value] for line, value in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(n):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [x - factor * y for x, y in zip(rows[i], rows[k])]
    return [rows[i][n] / rows[i][i] for i in range(n)]
