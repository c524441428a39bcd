#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes STEP files and has Open CASCADE read them: valid bodies of the right volume that are smooth across every edge.

Usage: run.py --fairsurf EXE --measure EXE --check EXE --out FOLDER CASE

CASE is one of CASES; units; parts: several bodies in one file; or red: files with a point moved must be refused.
"""
import argparse
import os
import pathlib
import subprocess
import sys

MESHES = pathlib.Path(__file__).resolve().parent / ".." / ".." / "samples" / "meshes"
# whether it is made fair, whether it is closed, most faces when merged; caps of fair ones have inner coefficients
CASES = {
    "pipe": (True, False, 30),
    "hull": (True, False, 20),
    "genus2": (False, True, 120),
    "cube": (False, True, 24),
    "star5": (False, False, 15),
    "torus": (False, True, 4),
    "tube": (False, False, 2),
}
FAIR = ["--functional", "penalised", "--caps", "full"]
UNITS = {"mm": 1, "cm": 10, "m": 1000, "in": 25.4}
# What CAD programs take for one point, in mm; relative errors of volume and area; difference of the shape tensors across
# an edge in relation to the largest principal curvature of the model.
TOLERANCE, VOLUME, CURVATURE = 1e-6, 1e-6, 1e-4


class Failure(Exception):
    pass


def run(command, **environment):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                            env={**os.environ, **environment})
    if result.returncode != 0:
        raise Failure(f"{' '.join(map(str, command))}: {result.returncode}\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
    return result.stdout


def read_values(text):
    """Lines "name number", as dictionary; of the others there is talk that Open CASCADE makes."""
    values = {}
    for line in text.splitlines():
        name, _, rest = line.partition(" ")
        try:
            values[name] = float(rest)
        except ValueError:
            values[name] = rest
    return values


def make_net(arguments, case):
    """The control net that is exported and measured."""
    mesh = MESHES / f"{case}.obj"
    if not CASES[case][0]:
        return mesh
    net = arguments.out / f"{case}.ply"
    run([arguments.fairsurf, "fair", mesh, "-q", *FAIR, "-o", net])
    return net


def measure(arguments, net):
    return read_values(run([arguments.measure, net]))


def write(arguments, case, net, merge, unit="mm"):
    path = arguments.out / f"{case}-{merge}-{unit}.step"
    run([arguments.fairsurf, "export", net, "-q", f"--step-merge={merge}", f"--unit={unit}", f"--name=the {case}'s",
         "-o", path])
    return path


def read(arguments, path):
    # The reader keeps tables until the program ends.
    return read_values(run([arguments.check, path], ASAN_OPTIONS="detect_leaks=0"))


def complaints(case, found, ours, scale):
    """What is wrong with a file, given what the reader found in it and what we know of the surface."""
    closed = CASES[case][1]
    volume, area = ours["volume"] * scale**3, ours["area"] * scale**2
    # The volume of an open surface, of what lies between it and the origin, may vanish.
    against = volume if closed else area * ours["size"] * scale
    rules = [
        ("one body", (found["solids"], found["shells"]) == ((1, 0) if closed else (0, 1))),
        ("valid", found["valid"] == 1),
        ("closed", found["closed"] == closed),
        ("tolerance", found["tolerance"] <= TOLERANCE),
        ("volume", abs(found["volume"] - volume) <= VOLUME * abs(against)),
        ("area", abs(found["area"] - area) <= VOLUME * area),
        ("gap", found["gap"] <= TOLERANCE),
        ("curvature", found["curvature"] <= CURVATURE),
        ("name", found["name"] == f"the {case}'s"),
    ]
    return [name for name, is_kept in rules if not is_kept]


def report(title, found, ours, scale):
    volume = ours["volume"] * scale**3
    print(f"{title}: {found['solids']:.0f} solids, {found['shells']:.0f} shells, {found['faces']:.0f} faces, "
          f"{found['edges']:.0f} edges, valid {found['valid']:.0f}, tolerance {found['tolerance']:.1e}, "
          f"volume {found['volume']:.9g} (ours {volume:.9g}, {found['volume'] - volume:.1e}), "
          f"area {found['area']:.9g} (ours {ours['area'] * scale**2:.9g}), normals {found['normal']:.1e}, "
          f"curvature {found['curvature']:.1e}")


def check_case(arguments, case):
    most_faces, net, failures = CASES[case][2], make_net(arguments, case), []
    ours = measure(arguments, net)
    for merge in ("no", "yes"):
        path = write(arguments, case, net, merge)
        found = read(arguments, path)
        report(path.name, found, ours, 1)
        failures += [f"{path.name}: {name}" for name in complaints(case, found, ours, 1)]
        right = found["faces"] <= most_faces if merge == "yes" else found["faces"] == ours["patches"]
        if not right:
            failures.append(f"{path.name}: {found['faces']:.0f} faces of {ours['patches']:.0f} patches")
        before = path.read_bytes()
        if write(arguments, case, net, merge).read_bytes() != before:
            failures.append(f"{path.name}: differs from run to run")
    return failures


def check_parts(arguments):
    """Two tori and a tube in one mesh: two solids and an open shell in one file."""
    mesh, path = arguments.out / "parts.obj", arguments.out / "parts.step"
    lines, n_vertices, area = [], 0, 0
    for k, name in enumerate(["torus", "tube", "torus"]):
        words = [line.split() for line in (MESHES / f"{name}.obj").read_text(encoding="ascii").splitlines()]
        points = [word[1:] for word in words if word[:1] == ["v"]]
        lines += [f"v {float(x) + 20 * k!r} {y} {z}" for x, y, z in points]
        faces = [word[1:] for word in words if word[:1] == ["f"]]
        lines += ["f " + " ".join(str(int(corner.split("/")[0]) + n_vertices) for corner in face) for face in faces]
        n_vertices += len(points)
        ours = measure(arguments, MESHES / f"{name}.obj")
        area += ours["area"]
    mesh.write_text("\n".join(lines) + "\n", encoding="ascii")
    run([arguments.fairsurf, "export", mesh, "-q", "-o", path])
    found = read(arguments, path)
    report(path.name, found, {"volume": 2 * ours["volume"], "area": area}, 1)
    rules = [
        ("bodies", (found["solids"], found["shells"]) == (2, 1)),
        ("valid", found["valid"] == 1),
        ("tolerance", found["tolerance"] <= TOLERANCE),
        ("volume", abs(found["volume"] - 2 * ours["volume"]) <= VOLUME * 2 * ours["volume"]),
        ("area", abs(found["area"] - area) <= VOLUME * area),
    ]
    return [f"{path.name}: {name}" for name, is_kept in rules if not is_kept]


def check_units(arguments):
    ours = measure(arguments, MESHES / "torus.obj")
    failures = []
    for unit, scale in UNITS.items():
        path = write(arguments, "torus", MESHES / "torus.obj", "yes", unit)
        found = read(arguments, path)
        report(path.name, found, ours, scale)
        failures += [f"{path.name}: {name}" for name in complaints("torus", found, ours, scale)]
    return failures


def move_point(path, moved, amount):
    """Copies a file; the coordinates of the point in the middle of its list grow by amount."""
    lines = path.read_text(encoding="ascii").splitlines()
    at = [k for k, line in enumerate(lines) if "CARTESIAN_POINT" in line]
    k = at[len(at) // 2]
    head, rest = lines[k].split(",(", 1)
    coordinates = ",".join(repr(float(word) + amount) for word in rest.split(")")[0].split(","))
    lines[k] = f"{head},({coordinates}));"
    moved.write_text("\n".join(lines) + "\n", encoding="ascii")


def check_red(arguments):
    """One point in the middle of the file is moved: the volume shows it less than the curvature."""
    ours = measure(arguments, MESHES / "torus.obj")
    path, moved = write(arguments, "torus", MESHES / "torus.obj", "no"), arguments.out / "moved.step"
    failures = []
    for amount, needed in ((1e-2, {"curvature", "volume"}), (1e-3, {"curvature"}), (0, set())):
        move_point(path, moved, amount)
        seen = set(complaints("torus", read(arguments, moved), ours, 1))
        print(f"a point moved by {amount}: {sorted(seen)}")
        if not needed <= seen or (not needed and seen):
            failures.append(f"a point moved by {amount} gives {sorted(seen)}")
    return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("fairsurf", "measure", "check", "out"):
        parser.add_argument(f"--{name}", type=pathlib.Path)
    parser.add_argument("case")
    arguments = parser.parse_args()
    if arguments.check is None:
        print("skipped: Open CASCADE's data exchange (libocct-data-exchange-dev) or a C++ compiler is missing")
        return 77
    arguments.out.mkdir(parents=True, exist_ok=True)
    if arguments.case == "units":
        failures = check_units(arguments)
    elif arguments.case == "parts":
        failures = check_parts(arguments)
    elif arguments.case == "red":
        failures = check_red(arguments)
    else:
        failures = check_case(arguments, arguments.case)
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as failure:
        print(failure)
        sys.exit(1)
