#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads STEP files as text and holds them to what readers silently mend: directions of edges, ends of curves, knots.

Usage: structure.py --fairsurf EXE --out FOLDER [--red]

With --red two uses of edges are turned around in the file, which must be seen.
"""
import argparse
import collections
import pathlib
import re
import subprocess
import sys

MESHES = pathlib.Path(__file__).resolve().parent / ".." / ".." / "samples" / "meshes"
NAMES = ["pipe", "hull", "genus2", "cube", "star3", "star7", "torus", "tube"]


class Failure(Exception):
    pass


def need(is_kept, text):
    if not is_kept:
        raise Failure(text)


def parse(text):
    """Entities by number: (type, parameters); parameters are nested lists of words."""
    data = text.split("DATA;\n", 1)[1].split("ENDSEC;", 1)[0].replace("\n", "")
    entities = {}
    for number, kind, rest in re.findall(r"#(\d+)=([A-Z_0-9]*)(\(.*?\));", data):
        need(int(number) not in entities, f"#{number} is there twice")
        stack = [[]]
        for token in re.findall(r"'(?:[^']|'')*'|[(),]|[^'(),]+", rest):
            if token == "(":
                stack.append([])
            elif token == ")":
                done = stack.pop()
                stack[-1].append(done)
            elif token != ",":
                stack[-1].append(token)
        entities[int(number)] = (kind, stack[0][0])
    need(sorted(entities) == list(range(1, len(entities) + 1)), "numbers of entities have gaps")
    return entities


class File:
    def __init__(self, text):
        self.entity = parse(text)

    def get(self, reference, kind):
        need(reference.startswith("#"), f"{reference} is no reference")
        found, parameters = self.entity[int(reference[1:])]
        need(found == kind, f"{reference} is {found}, not {kind}")
        return parameters

    def point(self, reference):
        words = self.get(reference, "CARTESIAN_POINT")[1]
        need(all("." in word for word in words), f"{reference} has a real without a point")
        return tuple(map(float, words))

    def vertex(self, reference):
        return self.point(self.get(reference, "VERTEX_POINT")[1])

    def all(self, kind):
        return [f"#{number}" for number, (found, _) in self.entity.items() if found == kind]


def check_knots(degree, n_points, multiplicities, knots):
    multiplicities, knots = list(map(int, multiplicities)), list(map(float, knots))
    need(len(multiplicities) == len(knots) and sum(multiplicities) == n_points + degree + 1, "knots do not fit the points")
    need(multiplicities[0] == multiplicities[-1] == degree + 1, "a spline is not clamped")
    need(all(m == 1 for m in multiplicities[1:-1]), "an inner knot is not simple")
    need(all(a < b for a, b in zip(knots, knots[1:])), "knots do not ascend")


def check_edge(file, edge):
    _, start, end, curve, sense = file.get(edge, "EDGE_CURVE")
    need(sense == ".T.", f"{edge} runs against its curve")
    _, degree, points, _, _, _, multiplicities, knots, _ = file.get(curve, "B_SPLINE_CURVE_WITH_KNOTS")
    check_knots(int(degree), len(points), multiplicities, knots)
    need(file.point(points[0]) == file.vertex(start) and file.point(points[-1]) == file.vertex(end), f"{edge} has loose ends")


def check_face(file, face, uses):
    _, bounds, surface, sense = file.get(face, "ADVANCED_FACE")
    need(sense == ".T." and len(bounds) == 1, f"{face} is turned or has several borders")
    _, loop, sense = file.get(bounds[0], "FACE_OUTER_BOUND")
    need(sense == ".T.", f"{bounds[0]} is turned")
    _, degree_u, degree_v, rows, _, _, _, _, mu, mv, ku, kv, _ = file.get(surface, "B_SPLINE_SURFACE_WITH_KNOTS")
    check_knots(int(degree_u), len(rows), mu, ku)
    check_knots(int(degree_v), len(rows[0]), mv, kv)
    need(all(len(row) == len(rows[0]) for row in rows), f"{surface} has rows of several lengths")
    corners = [], []
    for use in file.get(loop, "EDGE_LOOP")[1]:
        _, _, _, edge, direction = file.get(use, "ORIENTED_EDGE")
        uses[edge, direction] += 1
        for k, end in enumerate(file.get(edge, "EDGE_CURVE")[1:3] if direction == ".T." else
                                file.get(edge, "EDGE_CURVE")[2:0:-1]):
            corners[k].append(end)
    need(corners[1] == corners[0][1:] + corners[0][:1], f"the border of {face} does not close")
    need(len(set(corners[0])) == len(corners[0]), f"the border of {face} touches itself")
    # Anticlockwise as u goes up first: the corners of the surface come in this order.
    border = [file.vertex(corner) for corner in corners[0]]
    where = []
    for corner in (rows[0][0], rows[-1][0], rows[-1][-1], rows[0][-1]):
        gap, place = min((max(abs(a - b) for a, b in zip(file.point(corner), p)), k) for k, p in enumerate(border))
        need(gap < 1e-12, f"a corner of {face} is off by {gap}")
        where.append(place)
    need(where == sorted(where), f"the border of {face} runs clockwise: {where}")


def check_file(text):
    file, uses = File(text), collections.Counter()
    edges, faces = file.all("EDGE_CURVE"), file.all("ADVANCED_FACE")
    for edge in edges:
        check_edge(file, edge)
    for face in faces:
        check_face(file, face, uses)
    is_closed = bool(file.all("CLOSED_SHELL"))
    for edge in edges:
        need(uses[edge, ".T."] == 1, f"{edge} runs forwards {uses[edge, '.T.']} times")
        need(uses[edge, ".F."] == 1 or (uses[edge, ".F."] == 0 and not is_closed),
             f"{edge} runs backwards {uses[edge, '.F.']} times")
    shells = file.all("CLOSED_SHELL") + file.all("OPEN_SHELL")
    need(len(shells) == 1, "not one shell")
    need(file.get(shells[0], "CLOSED_SHELL" if is_closed else "OPEN_SHELL")[1] == faces, "the shell has not all faces")
    return is_closed, len(faces), len(edges)


def turn(text, n):
    """Turns around the first n uses of edges."""
    return re.sub(r"(ORIENTED_EDGE\('',\*,\*,#\d+,\.)([TF])",
                  lambda match: match[1] + ("F" if match[2] == "T" else "T"), text, count=n)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fairsurf", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--red", action="store_true")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    n_failed = 0
    for name in NAMES[-2:] if arguments.red else NAMES:
        for merge in ("no", "yes"):
            path = arguments.out / f"{name}-{merge}.step"
            subprocess.run([arguments.fairsurf, "export", MESHES / f"{name}.obj", "-q", f"--step-merge={merge}", "-o", path],
                           check=True)
            text = path.read_text(encoding="ascii")
            for n in (1, text.count("ORIENTED_EDGE")) if arguments.red else (0,):
                try:
                    print(path.name, check_file(turn(text, n) if n else text))
                    n_failed += arguments.red
                except Failure as failure:
                    print(path.name, failure)
                    n_failed += not arguments.red
    return 1 if n_failed else 0


if __name__ == "__main__":
    sys.exit(main())
