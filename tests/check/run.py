#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""fairsurf check on whole files: samples, meshes from elsewhere, STEP files of ours and of Open CASCADE, and the command line.

Usage: run.py --fairsurf EXE [--occt EXE] [--small] --out FOLDER samples|shared|step|occt|command
"""
import argparse
import json
import math
import os
import pathlib
import struct
import subprocess
import sys

SAMPLES = pathlib.Path(__file__).resolve().parent / ".." / ".." / "samples" / "meshes"
JUMPS = ("position", "normal", "curvature", "gradient_H")
FAILED = 5  # exit code where what is required is missing


class Failure(Exception):
    pass


def need(holds, what):
    if not holds:
        raise Failure(what)


def near(found, expected, tolerance, what):
    need(found is not None and abs(found - expected) <= tolerance, f"{what}: {found} is not {expected}")


def run(arguments, *words, expected=0):
    result = subprocess.run([str(arguments.fairsurf), *map(str, words)], capture_output=True, text=True, check=False)
    command = " ".join(map(str, words))
    need(result.returncode == expected, f"{command}: exit {result.returncode}, not {expected}\n{result.stderr[-1000:]}")
    return result


def check(arguments, *words, expected=0):
    return json.loads(run(arguments, "check", *words, "--json", "-q", expected=expected).stdout)


def show(name, found):
    jumps = ", ".join(f"{key} {found['max'][key]:.2g}" for key in JUMPS if found['max'][key] is not None)
    print(f"{name}: {found['patches']} patches, {found['edges']} edges, {jumps}")


def check_g2(arguments, path):
    """Our surfaces are G2 everywhere, closed or not, and do not cross themselves."""
    found = check(arguments, path, "--require", "g2", "--tolerance", "1e-6")
    show(path.name, found)
    need(found["pass"] and found["max"]["curvature"] <= 1e-6, f"{path.name}: not G2")
    need(found["irregular"] == 0 and found["shape"]["regularity"]["singular_patches"] == 0, f"{path.name}: irregular")
    worst = found["worst"]
    need(worst[0]["by"] == "curvature" and worst[0]["values"]["curvature"] == found["max"]["curvature"],
         f"{path.name}: the first of the worst is not the largest")
    need(all({"edge", "parameter", "point", "values"} <= set(entry) for entry in worst), f"{path.name}: an entry lacks a key")
    return found


def test_samples(arguments):
    for path in sorted(SAMPLES.glob("*.obj")):
        found = check_g2(arguments, path)
        need(found["self_intersections"]["pairs"] == 0, f"{path.name}: crosses itself")


def test_shared(arguments):
    """All meshes from elsewhere that give a surface. The others are refused with a sentence."""
    folder = os.environ.get("FAIRSURF_SHARED", "")
    meshes = sorted(pathlib.Path(folder, "meshes").glob("*.obj")) if folder else []
    if not meshes:
        print("skipped: FAIRSURF_SHARED does not name the folder with meshes")
        return 77
    if arguments.small:
        meshes = [path for path in meshes if path.stat().st_size < 45000]
    n_surfaces = 0
    for path in meshes:
        info = subprocess.run([str(arguments.fairsurf), "info", str(path), "--json"], capture_output=True, text=True,
                              check=False)
        if info.returncode == 0 and json.loads(info.stdout)["space"]["possible"]:
            check_g2(arguments, path)
            n_surfaces += 1
        else:
            message = run(arguments, "check", path, expected=1).stderr
            print(f"{path.name}: {message.strip().splitlines()[-1]}")
    need(n_surfaces >= (15 if arguments.small else 18), f"only {n_surfaces} meshes give a surface")
    return 0


def same(found, expected, what):
    """The same surface from another file: numbers of its shape, and jumps beyond rounding errors."""
    for key in ("area", "volume", "willmore", "diameter", "largest_curvature"):
        near(found["shape"][key], expected["shape"][key], 1e-6 * (abs(expected["shape"][key]) + 1), f"{what}: {key}")
    near(found["max"]["gradient_H"], expected["max"]["gradient_H"], 1e-5 * expected["max"]["gradient_H"], what)
    for key in ("patches", "edges", "borders", "vertices"):
        need(found[key] == expected[key], f"{what}: {found[key]} {key}, not {expected[key]}")


def test_step(arguments):
    for name in ("pipe", "torus", "star5"):
        expected = check(arguments, SAMPLES / f"{name}.obj")
        for merge in ("no", "yes"):
            path = arguments.out / f"{name}-{merge}.step"
            run(arguments, "export", SAMPLES / f"{name}.obj", "-q", f"--step-merge={merge}", "-o", path)
            found = check(arguments, path, "--require", "g2")
            show(path.name, found)
            same(found, expected, path.name)


def occt(arguments, *words):
    # The writer keeps tables until the program ends.
    result = subprocess.run([str(arguments.occt), *map(str, words)], capture_output=True, text=True, check=True,
                            env={**os.environ, "ASAN_OPTIONS": "detect_leaks=0"})
    lines = [line.split() for line in result.stdout.splitlines() if line.startswith("area ")]
    return float(lines[-1][1])


def test_occt(arguments):
    if arguments.occt is None:
        print("skipped: Open CASCADE or a C++ compiler is missing")
        return 77
    for name in ("pipe", "torus"):
        ours, again = arguments.out / f"{name}.step", arguments.out / f"{name}-again.step"
        run(arguments, "export", SAMPLES / f"{name}.obj", "-q", "-o", ours)
        area = occt(arguments, "again", ours, again)
        found = check(arguments, again, "--require", "g2", "--tolerance", "1e-5")
        show(again.name, found)
        near(found["shape"]["area"], area, 1e-7 * area, again.name)
        need(found["edges"] == check(arguments, ours)["edges"], f"{again.name}: other edges")
    path = arguments.out / "bspline.step"
    area = occt(arguments, "bspline", path)
    found = check(arguments, path, "--require", "g2")
    show(path.name, found)
    near(found["shape"]["area"], area, 1e-7 * area, path.name)
    for kind, reason in (("cylinder", "PLANE"), ("rational", "rational"), ("trimmed", "trimmed")):
        path = arguments.out / f"{kind}.step"
        occt(arguments, kind, path)
        message = run(arguments, "check", path, expected=1).stderr
        print(f"{path.name}: {message.strip()}")
        need(reason in message or (kind == "cylinder" and "CYLINDRICAL_SURFACE" in message), f"{path.name}: {message}")
    return 0


def ply_values(path):
    """The values of the last property of the vertices of a binary file."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    n = int(head.split(b"element vertex ")[1].split()[0])
    size = 3 * 8 + 5 * 4  # position, normal, the measure twice
    return [struct.unpack_from("<f", body, size * k + size - 4)[0] for k in range(n)]


def test_command(arguments):
    torus, star = SAMPLES / "torus.obj", SAMPLES / "star5.obj"
    for order, code in (("g0", 0), ("g1", 0), ("g2", 0), ("g3", FAILED)):
        found = check(arguments, star, "--require", order, expected=code)
        need(found["pass"] == (code == 0) and found["require"] == order, f"{order}: pass is {found['pass']}")
        need(found["worst"][0]["by"] == JUMPS[int(order[1])], f"{order}: the list begins with {found['worst'][0]['by']}")
    check(arguments, star)  # nothing is required: nothing fails
    check(arguments, star, "--require", "g3", "--tolerance", "1e9")
    run(arguments, "check", star, "--require", "g4", expected=2)
    run(arguments, "check", star, "--tolerance", "-1", expected=2)
    run(arguments, "check", arguments.out / "absent.step", expected=4)
    lists = check(arguments, star, "--worst", "3")["worst"]
    need(len(lists) == 4 * 3, f"{len(lists)} entries instead of 3 for each jump")
    text = run(arguments, "check", torus, "--require", "g2").stdout
    need("G2 is required: passed" in text and "tool radius" in text, text)

    # two tori through each other
    lines = torus.read_text(encoding="ascii").splitlines()
    points = [[float(x) for x in line.split()[1:]] for line in lines if line.startswith("v ")]
    faces = [[int(corner.split("/")[0]) for corner in line.split()[1:]] for line in lines if line.startswith("f ")]
    both = arguments.out / "both.obj"
    both.write_text("".join(f"v {x + shift} {y} {z}\n" for shift in (0, 1) for x, y, z in points) +
                    "".join("f " + " ".join(str(corner + base) for corner in face) + "\n"
                            for base in (0, len(points)) for face in faces), encoding="ascii")
    found = check(arguments, both, "--require", "g2")["self_intersections"]
    need(found["pairs"] > 0 and len(found["places"]) == min(found["pairs"], 10), f"{found['pairs']} crossings")

    # compared with itself nothing changes; a faired surface has less S, and has moved
    found = check(arguments, star, "--compare", star)["compared"]
    need(found["S"] == 1 and found["largest_distance"] == 0, "a surface differs from itself")
    fair = arguments.out / "fair.off"
    run(arguments, "fair", star, "-q", "--functional", "penalised", "--caps", "linear", "-o", fair)
    found = check(arguments, fair, "--compare", star)["compared"]
    need(found["S"] < 1 and found["largest_distance"] > 0, f"fairing gives S times {found['S']}")

    # the surface that a construction makes, not what a file of patches keeps of it
    for name, words in (("blob.obj", ("stacho",)), ("lantern.obj", ("gregory", "--edge-rule", "pn"))):
        found = check(arguments, SAMPLES / ".." / "patches" / name, "--construction", *words, "--require", "g1",
                      "--tolerance", "1e-10")
        need(found["max"]["position"] <= 1e-12 and found["max"]["curvature"] > 1e-3, f"{name}: {found['max']}")

    # colours: log10 of the jumps at the edges, -16 inside
    ply, glb = arguments.out / "jumps.ply", arguments.out / "jumps.glb"
    found = check(arguments, star, "--require", "g3", "-o", ply, "-o", glb, expected=FAILED)
    values = ply_values(ply)
    near(max(values), math.log10(max(w["values"]["gradient_H"] for w in found["worst"] if w["edge"] is not None)), 1e-5,
         "the largest colour")
    need(min(values) >= -16, f"a colour of {min(values)}")
    need(glb.read_bytes()[:4] == b"glTF", "no GLB file")
    run(arguments, "check", star, "-o", arguments.out / "net.off", expected=0)
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("fairsurf", "occt", "out"):
        parser.add_argument(f"--{name}", type=pathlib.Path)
    parser.add_argument("--small", action="store_true", help="leave large files out: for slow builds")
    parser.add_argument("case", choices=["samples", "shared", "step", "occt", "command"])
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    return globals()[f"test_{arguments.case}"](arguments) or 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failure as failure:
        print(failure)
        sys.exit(1)
