#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The plugin in MeshLab's own meshlabserver: numbers against those of the command line, refusals, exported files.

Usage: run.py --fairsurf PROGRAM --describe PROGRAM --out FOLDER --plugin FILE... TEST...
Exit status 77 (skipped) where MeshLab or a virtual screen is not installed. MeshLab keeps single precision and its ascii PLY
has 7 digits: numbers are equal within 1e-6 of the largest coordinate, and measures, written with 9 digits, within 1e-8.
"""
import argparse
import json
import math
import os
import re
import struct
import subprocess
import sys

from prefix import SKIP, make_prefix, missing

SAMPLES = os.environ.get("FAIRSURF_SAMPLES", os.path.join(os.path.dirname(__file__), "../../samples/meshes"))
SELECTED = 32  # MeshLab's bit of selected vertices in the flags of a PLY file


class Failure(Exception):
    pass


def single(value):
    return struct.unpack("f", struct.pack("f", value))[0]


# ---- meshes ----

def read_obj(name):
    vertices, faces = [], []
    with open(os.path.join(SAMPLES, name + ".obj"), encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                vertices.append([single(float(w)) for w in words[1:4]])
            elif words and words[0] == "f":
                faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return vertices, faces


def prism(n):
    ring = [(single(math.cos(2 * math.pi * i / n)), single(math.sin(2 * math.pi * i / n))) for i in range(n)]
    vertices = [[x, y, float(z)] for z in (0, 1) for x, y in ring]
    sides = [[i, (i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
    return vertices, [list(range(n - 1, -1, -1)), list(range(n, 2 * n))] + sides


def mesh_of(name):
    return prism(6) if name == "prism" else read_obj(name)


def write_ply(path, mesh, selected=()):
    vertices, faces = mesh
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
                   "property float z\nproperty int flags\n")
        if faces:
            file.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\n")
        file.write("end_header\n")
        for i, v in enumerate(vertices):
            file.write("%.17g %.17g %.17g %d\n" % (*v, SELECTED if i in selected else 0))
        for face in faces:
            file.write(" ".join(map(str, [len(face)] + face)) + "\n")


def read_ply(path):
    """({property: [value of each vertex]}, [faces], [flags of each face]) of an ascii file."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    counts, properties, element = {}, {}, None
    for at, line in enumerate(lines):
        words = line.split()
        if words[:1] == ["element"]:
            element = words[1]
            counts[element], properties[element] = int(words[2]), []
        elif words[:1] == ["property"]:
            properties[element].append(words[-1])
        elif words == ["end_header"]:
            break
    rows = [[float(w) for w in line.split()] for line in lines[at + 1:]]
    vertices = dict(zip(properties["vertex"], zip(*rows[:counts["vertex"]])))
    faces, flags = [], []
    for row in rows[counts["vertex"]:counts["vertex"] + counts["face"]]:
        if properties["face"][0] == "flags":
            flags.append(int(row[0]))
            row = row[1:]
        n = int(row[0])
        faces.append([int(x) for x in row[1:1 + n]])
        if properties["face"][-1] == "flags":
            flags.append(int(row[1 + n]))
    return vertices, faces, flags


def count_polygons(faces, flags):
    """Of triangles with faux edges: each edge that is marked from both sides joins two."""
    marked = sum(bin(f >> 18 & 7).count("1") for f in flags)
    return len(faces) - marked // 2


# ---- programs ----

class Tools:
    def __init__(self, arguments):
        self.fairsurf, self.describe, self.out = arguments.fairsurf, arguments.describe, arguments.out
        os.makedirs(self.out, exist_ok=True)
        self.prefix = make_prefix(os.path.join(self.out, "prefix"), arguments.plugin)

    def path(self, name):
        return os.path.join(self.out, name)

    def cli(self, *words):
        done = subprocess.run([self.fairsurf, *words], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Failure(f"fairsurf {' '.join(words)}: {done.stderr}")
        return done.stdout

    def server(self, mesh, output, filter_name=None, parameters=(), mask=("sa",)):
        """(exit status, what it printed) of meshlabserver with one filter."""
        command = [os.path.join(self.prefix, "bin", "meshlabserver"), "-i", mesh]
        command += ["-o", output, "-m", *mask] if output else []
        if filter_name:
            script = self.path("script.mlx")
            made = subprocess.run([self.describe, "script", filter_name, *parameters], capture_output=True, text=True,
                                  check=True)
            with open(script, "w", encoding="utf-8") as file:
                file.write(made.stdout)
            command += ["-s", script]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              errors="replace", timeout=300)
        return done.returncode, done.stdout

    def apply(self, mesh, output, filter_name, parameters, mask=("sa",)):
        status, text = self.server(mesh, output, filter_name, parameters, mask)
        if status != 0:
            raise Failure(f"{filter_name} on {mesh}: exit status {status}\n{text}")
        return text


def same_positions(found, expected, what):
    n = len(expected["x"])
    if len(found["x"]) != n:
        raise Failure(f"{what}: {len(found['x'])} vertices instead of {n}")
    size = max(abs(v) for axis in "xyz" for v in expected[axis])
    worst = max(abs(found[axis][i] - expected[axis][i]) for axis in "xyz" for i in range(n))
    if worst > 1e-6 * size:
        raise Failure(f"{what}: a coordinate differs by {worst:g}, size {size:g}")
    print(f"{what}: {n} vertices, largest difference {worst / size:.2g} of the size")


def same_number(found, expected, tolerance, what):
    if not abs(found - expected) <= tolerance * max(abs(expected), 1e-300):
        raise Failure(f"{what}: {found!r} instead of {expected!r}")
    print(f"{what}: {found:.9g}")


# ---- tests ----

def refine(tools):
    for name in ("pipe", "cube", "prism"):
        start = tools.path(name + ".ply")
        write_ply(start, mesh_of(name))
        for scheme, levels in (("averaging", 1), ("catmull-clark", 2)):
            tools.apply(start, tools.path("found.ply"), "Refine", [f"scheme={scheme}", f"levels={levels}"],
                        ("ff", "sa"))
            tools.cli("refine", start, "--scheme", scheme, "--refine", str(levels), "-o", tools.path("expected.ply"),
                      "--format", "ascii")
            found, faces, flags = read_ply(tools.path("found.ply"))
            expected, polygons, _ = read_ply(tools.path("expected.ply"))
            same_positions(found, expected, f"{name} refined by {scheme}")
            if count_polygons(faces, flags) != len(polygons):
                raise Failure(f"{name}, {scheme}: {count_polygons(faces, flags)} polygons instead of {len(polygons)}")


def fair_case(tools, name, filter_parameters, options, selected=()):
    start, found, expected = (tools.path(f) for f in (name + ".ply", "found.ply", "expected.ply"))
    write_ply(start, mesh_of(name), selected)
    text = tools.apply(start, found, "Fair surface", filter_parameters, ("ff", "vq", "vn", "sa"))
    cells = re.search(r"cut into (\d+) x", text)
    surface = ["--surface", "--steps", cells.group(1)] if cells else []
    report = tools.path("report.json")
    tools.cli("fair", start, *options, "--report", report, *surface, "-o", expected, "--format", "ascii", "-q")
    found_mesh, expected_mesh = read_ply(found), read_ply(expected)
    what = f"{name} faired{' as a surface' if cells else ''}"
    same_positions(found_mesh[0], expected_mesh[0], what)
    if "quality" in expected_mesh[0]:
        size = max(abs(v) for v in expected_mesh[0]["quality"])
        worst = max(abs(a - b) for a, b in zip(found_mesh[0]["quality"], expected_mesh[0]["quality"]))
        if worst > 2e-6 * size:
            raise Failure(f"{what}: a measure differs by {worst:g}, largest {size:g}")
    if cells:
        worst = max(abs(found_mesh[0][a][i] - expected_mesh[0][a][i]) for a in ("nx", "ny", "nz")
                    for i in range(len(found_mesh[0]["x"])))
        if worst > 2e-6:
            raise Failure(f"{what}: a normal differs by {worst:g}")
    with open(report, encoding="utf-8") as file:
        numbers = json.load(file)
    before, after = re.search(r"variation S: (\S+) -> (\S+)", text).groups()
    same_number(float(before), numbers["start"]["S"], 1e-8, what + ": S before")
    same_number(float(after), numbers["quality"]["S"], 1e-6, what + ": S after")


def fair(tools):
    fair_case(tools, "pipe", ["result=1", "caps=linear"], ["--caps", "linear"])
    fair_case(tools, "cube", ["result=0", "colour=mean", "tolerance=0.2"], ["--colour", "mean"])
    fair_case(tools, "prism", ["result=1", "caps=linear", "C=0.01", "functional=penalised", "new_layer=0"],
              ["--caps", "linear", "--functional", "penalised", "-C", "0.01"])


def selection(tools):
    """Selected vertices that stay are the marks of --fixed, and so are those that are not selected where only they move."""
    vertices, _ = mesh_of("pipe")
    chosen = {i for i, v in enumerate(vertices) if v[2] > 0.5}
    for meaning, fixed in ((1, chosen), (2, set(range(len(vertices))) - chosen)):
        marks = tools.path("marks.txt")
        with open(marks, "w", encoding="utf-8") as file:
            file.writelines(f"{i}\n" for i in sorted(fixed))
        fair_case(tools, "pipe", ["result=1", f"selection={meaning}", "functional=penalised"],
                  ["--fixed", marks, "--functional", "penalised"], chosen)


def patches(tools):
    for name in ("pipe", "cube", "prism"):
        start, found, expected = (tools.path(f) for f in (name + ".ply", "found.ply", "expected.ply"))
        write_ply(start, mesh_of(name))
        text = tools.apply(start, found, "Smooth patches", ["tolerance=0.5"])
        steps = re.search(r"cut into (\d+) x", text).group(1)
        tools.cli("patch", start, "--surface", "--steps", steps, "-o", expected, "--format", "ascii")
        same_positions(read_ply(found)[0], read_ply(expected)[0], f"patches over {name}")


def curvature(tools):
    for name in ("pipe", "cube", "prism"):
        start, found, expected = (tools.path(f) for f in (name + ".ply", "found.ply", "expected.ply"))
        write_ply(start, mesh_of(name))
        text = tools.apply(start, found, "Curvature", ["measure=mean"], ("vq", "sa"))
        numbers = json.loads(tools.cli("check", start, "--json"))
        area, energy = map(float, re.search(r"area (\S+), curvature variation S (\S+)", text).groups())
        low, high = map(float, re.search(r"H: (\S+) \.\. (\S+)", text).groups())
        same_number(area, numbers["shape"]["area"], 1e-8, name + ": area")
        same_number(energy, numbers["shape"]["S"], 1e-8, name + ": S")
        same_number(low, numbers["shape"]["H"]["min"], 1e-8, name + ": least H")
        same_number(high, numbers["shape"]["H"]["max"], 1e-8, name + ": largest H")
        # the values at the corners of patches, which one step per patch makes vertices, are among those of the layer
        tools.cli("export", start, "--colour", "mean", "--surface", "--steps", "1", "-o", expected, "--format", "ascii")
        at_corners = sorted(read_ply(expected)[0]["quality"])
        at_vertices = sorted(read_ply(found)[0]["quality"])
        few, many = sorted((at_corners, at_vertices), key=len)
        size = max(map(abs, many))
        for value in few:
            if min(abs(value - other) for other in many) > 2e-6 * size:
                raise Failure(f"{name}: mean curvature {value} at a vertex is none of a corner of a patch")
        print(f"{name}: mean curvature at {len(few)} vertices")
    tools.apply(start, found, "Curvature", ["measure=G2 deviation"], ("vq", "sa"))
    worst = max(read_ply(found)[0]["quality"])
    same_number(worst, 0, 1e300, "prism: largest jump of curvature")
    if not 0 <= worst < 1e-6:
        raise Failure(f"the surface of a control net has continuous curvature, but a jump of {worst} is shown")


def boundary_loops(faces):
    """[[vertices]] against the direction of the faces around them."""
    sides = {(f[i], f[(i + 1) % len(f)]) for f in faces for i in range(len(f))}
    follow = {b: a for a, b in sides if (b, a) not in sides}
    loops = []
    while follow:
        loop = [next(iter(follow))]
        while follow[loop[-1]] != loop[0]:
            loop.append(follow[loop[-1]])
        for v in loop:
            del follow[v]
        loops.append(loop)
    return loops


def fill_hole(tools):
    for name in ("pipe", "cube", "prism"):
        vertices, faces = mesh_of(name)
        if not boundary_loops(faces):
            faces = faces[1:]
        loops = boundary_loops(faces)
        start, found, closed, expected = (tools.path(f) for f in (name + "_open.ply", "found.ply", "closed.ply",
                                                                  "expected.ply"))
        write_ply(start, (vertices, faces), {v for loop in loops for v in loop})
        text = tools.apply(start, found, "Fill hole", [])
        sizes = sorted(map(int, re.findall(r"a loop of (\d+) edges is closed", text[text.index("no additional"):])))
        if sorted(set(sizes)) != sorted({len(loop) for loop in loops}):
            raise Failure(f"{name}: loops of {sizes} edges were closed instead of {list(map(len, loops))}")
        write_ply(closed, (vertices, faces + loops))
        tools.cli("refine", closed, "--scheme", "catmull-clark", "-o", expected, "--format", "ascii")
        # the order of the faces that were added may differ, and so may that of the vertices in them
        a, b = ([sorted(zip(*(read_ply(f)[0][axis] for axis in "xyz")),
                        key=lambda p: [round(x, 4) + 0.0 for x in p])] for f in (found, expected))
        same_positions({axis: [p[k] for p in a[0]] for k, axis in enumerate("xyz")},
                       {axis: [p[k] for p in b[0]] for k, axis in enumerate("xyz")}, f"{name} filled")


def refused(tools, mesh, filter_name, parameters, sentence):
    result = tools.path("refused.ply")
    if os.path.exists(result):
        os.remove(result)
    status, text = tools.server(mesh, result, filter_name, parameters)
    if status != 255 or not re.search(sentence, text):
        raise Failure(f"{filter_name} on {mesh}: exit status {status} instead of 255, or no /{sentence}/ in\n{text}")
    if os.path.exists(result):
        raise Failure(f"{filter_name} on {mesh}: {result} was written")
    print(f"{filter_name} on {os.path.basename(mesh)}: refused: {re.search(sentence, text).group(0)}")


ALL = ("Refine", "Fair surface", "Smooth patches", "Curvature", "Fill hole")


def refusals(tools):
    cube, points, book, soup, large, dart = (tools.path(f + ".ply") for f in
                                             ("cube", "points", "book", "soup", "triangles", "bow_tie"))
    vertices, faces = mesh_of("cube")
    write_ply(cube, (vertices, faces))
    write_ply(points, (vertices, []))
    write_ply(book, ([[0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 0, 1], [-1, 0, 0], [-1, 0, 1], [0, 1, 0], [0, 1, 1]],
                     [[0, 1, 3, 2], [0, 1, 5, 4], [0, 1, 7, 6]]))
    write_ply(dart, ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0]], [[0, 1, 2], [0, 3, 4]]))
    write_ply(soup, ([[3 * i + x, y, 0] for i in range(40) for x, y in ((0, 0), (1, 0), (0, 1))],
                     [[3 * i, 3 * i + 1, 3 * i + 2] for i in range(40)]))
    n = 60
    write_ply(large, ([[x, y, 0] for y in range(n) for x in range(n)],
                      [[a, b, c] for y in range(n - 1) for x in range(n - 1) for i in [y * n + x]
                       for a, b, c in ((i, i + 1, i + n + 1), (i, i + n + 1, i + n))]))
    for name in ALL:
        refused(tools, points, name, [], r"a mesh of 8 vertices and 0 faces is none: it needs at least one face")
    for name in ALL:
        refused(tools, book, name, [], r"(non-manifold edge between vertices 0 and 1|faces 0 and 1 lie on the same side).*")
    refused(tools, dart, "Fair surface", [], r"vertex 0 is a bow-tie: 2 fans of faces meet there")
    refused(tools, soup, "Fair surface", [], r"no face.*")
    refused(tools, soup, "Curvature", [], r"no face.*")
    refused(tools, large, "Fair surface", [], r"triangles.*quad.*")
    refused(tools, cube, "Fair surface", ["selection=1"], r"nothing is selected: select vertices or faces.*")
    refused(tools, cube, "Fair surface", ["selection=2"], r"nothing is selected: select vertices or faces.*")
    refused(tools, cube, "Fill hole", [], r"no boundary loop is selected as a whole: select all its vertices")
    refused(tools, cube, "Refine", ["levels=99"], r"levels is 99, but it must lie between 1 and 6")


FORMATS = {"pov": ("pov", "inc"), "scad": ("scad",), "drc": ("drc",), "glb": ("glb",), "step": ("step",)}


def formats(tools):
    """What File > Export writes is what the command export writes, byte for byte."""
    start = tools.path("pipe.ply")
    write_ply(start, mesh_of("pipe"))
    for extension, files in FORMATS.items():
        for folder in ("found", "expected"):
            os.makedirs(tools.path(folder), exist_ok=True)
        status, text = tools.server(start, tools.path(f"found/part.{extension}"), mask=("sa",))
        if status != 0:
            raise Failure(f".{extension}: exit status {status}\n{text}")
        surface = ["--surface"] if extension == "drc" else []
        tools.cli("export", start, *surface, "-o", tools.path(f"expected/part.{extension}"))
        for file in files:
            found, expected = (open(tools.path(f"{folder}/part.{file}"), "rb").read() for folder in ("found", "expected"))
            if found != expected:
                raise Failure(f".{file}: {len(found)} bytes differ from the {len(expected)} of the command line")
            print(f".{file}: {len(found)} bytes")


def gui(tools):
    """The windows of MeshLab, and the programs for which File > Export writes."""
    start, folder = tools.path("pipe.ply"), tools.path("screen")
    write_ply(start, mesh_of("pipe"))
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "gui.sh")
    readers = (["povray", "+Ipart.pov", "+Opart.png", "+W160", "+H120", "-D"],
               ["openscad", "-o", "part.stl", "part.scad"])
    done = subprocess.run([script, os.path.join(tools.prefix, "bin", "meshlab"), start, folder], check=False)
    if done.returncode != 0:
        raise Failure("the windows of MeshLab: see above")
    for command in readers:
        done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=False, errors="replace")
        if done.returncode != 0 or re.search(r"WARNING|ERROR", done.stdout):
            raise Failure(f"{' '.join(command)}: {done.stdout[-2000:]}")
        print(f"{command[0]} takes what was exported")


TESTS = {"refine": refine, "fair": fair, "selection": selection, "patches": patches, "curvature": curvature,
         "fill_hole": fill_hole, "refusals": refusals, "formats": formats, "gui": gui}
NEEDED = ("meshlabserver", "xvfb-run")
NEEDED_BY_GUI = ("meshlab", "Xvfb", "openbox", "xdotool", "import", "xdpyinfo", "povray", "openscad")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fairsurf", required=True)
    parser.add_argument("--describe", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--plugin", action="append", default=[])
    parser.add_argument("tests", nargs="+", choices=TESTS)
    arguments = parser.parse_args()
    needed = missing(*NEEDED, *(NEEDED_BY_GUI if "gui" in arguments.tests else ()))
    if needed or not arguments.plugin:
        print(f"skipped: {needed or 'what the plugin is built with'} is not installed: scripts/deps --meshlab")
        return SKIP
    if "FAIRSURF_IN_XVFB" not in os.environ:  # one virtual screen for all runs
        return subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 640x480x24", sys.executable, *sys.argv],
                              env={**os.environ, "FAIRSURF_IN_XVFB": "1"}, check=False).returncode
    tools = Tools(arguments)
    try:
        for name in arguments.tests:
            TESTS[name](tools)
    except Failure as failure:
        print(f"FAILED: {failure}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
