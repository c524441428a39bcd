#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The command line as a user types it, from file to file, in an empty folder. Usage: run.py --fairsurf EXE caps|film|pair"""
import argparse
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

SAMPLES = pathlib.Path(__file__).resolve().parent / ".." / ".." / "samples" / "meshes"


def need(holds, what):
    if not holds:
        sys.exit(f"failed: {what}")


class Shell:
    def __init__(self, fairsurf, folder):
        self.fairsurf, self.folder = fairsurf, folder

    def run(self, line, expected=0):
        """What it said on standard output and error."""
        result = subprocess.run([self.fairsurf, *line.split()], cwd=self.folder, capture_output=True, text=True)
        need(result.returncode == expected, f"{line}: exit {result.returncode}, not {expected}\n{result.stderr}")
        return result.stdout + result.stderr


def points(path):
    return [tuple(map(float, line.split()[1:])) for line in open(path) if line.startswith("v ")]


def largest_distance(a, b):
    """Of each point of a from the nearest of b: the order of the patches may differ."""
    return max(min(math.dist(p, q) for q in b) for p in a)


def caps(shell):
    """Inner coefficients go with the net, in every format; what is lost is said."""
    folder = shell.folder
    shutil.copy(SAMPLES / "star5.obj", folder / "star.obj")
    net = "-o a.ply -o b.ply --format ascii -o a.obj -o c.off -o a.drc --net-bits 0"
    said = shell.run(f"fair star.obj --max-iterations 20 --report report.json {net} --surface --steps 2 -o skin.obj")
    need("with 101 free inner coefficients" in said, said)
    need(json.load(open(folder / "report.json"))["free_inner"] == 101, "the report does not count them")
    need({"a.caps.json", "c.caps.json"} <= {p.name for p in folder.iterdir()}, "no file of coefficients beside the nets")
    skin = points(folder / "skin.obj")
    for name, tolerance in (("a.ply", 0), ("b.ply", 0), ("a.obj", 0), ("c.off", 0), ("a.drc", 1e-6)):
        need("caps: 1 with 101 inner coefficients" in shell.run(f"info {name}"), f"info {name} does not know them")
        shell.run(f"export {name} --surface --steps 2 -o again.obj")
        again = points(folder / "again.obj")
        found = largest_distance(skin, again)
        print(f"{name}: {found:.1e} from the surface that was written")
        need(len(again) == len(skin) and found <= tolerance, f"{name} makes another surface")
        # fairing starts from them: the functional is that of the end
        shell.run(f"fair {name} --max-iterations 0 --report again.json -o again.ply")
        ends = [json.load(open(folder / file))["end"]["F"] for file in ("report.json", "again.json")]
        need(abs(ends[0] - ends[1]) <= max(tolerance, 1e-12) * 100 * ends[0], f"{name} starts at {ends[1]}, not {ends[0]}")
    need(json.loads(shell.run("info a.ply --json"))["caps"] == {"caps": 1, "inner_coefficients": 101}, "info --json")

    said = shell.run("export a.ply --caps linear --surface --steps 2 -o again.obj")
    need("are left out: --caps linear" in said, said)
    need(largest_distance(skin, points(folder / "again.obj")) > 1e-4, "linear caps make the same surface")
    need("are left out: --caps smooth" in shell.run("export a.ply --caps smooth -o again.ply"), "smooth")
    need("caps: 1 with 21 inner" in shell.run("info again.ply"), "smooth caps have 21")
    need("start at zero" in shell.run("refine a.ply -o again.ply"), "refine")
    need("start at zero" in shell.run("export a.ply --refine 1 -o again.ply"), "export --refine")
    need("caps:" not in shell.run("info again.ply"), "refinement keeps them")
    need("without the inner coefficients of its 1 caps" in shell.run("export a.ply --caps-file no -o lost.obj"), "a note")
    need(not (folder / "lost.caps.json").exists(), "the file is written all the same")

    shell.run("fair star.obj --functional penalised --max-iterations 2 -o linear.ply")
    need("caps:" not in shell.run("info linear.ply"), "penalised has full caps")
    need("choose one of linear, smooth, full" in shell.run("fair star.obj --caps many", 2), "usage")

    # a net that was changed, and a file that was
    text = (folder / "a.caps.json").read_text()
    shutil.copy(folder / "star.obj", folder / "a.obj")
    need("was written for another net than a.obj: left out" in shell.run("info a.obj"), "another net")
    for changed, message in ((text.replace('"valence": 5', '"valence": 6'), "are for valence 6, but it has 5"),
                             (text.replace('"basis": 1', '"basis": 2'), "belong to version 2 of the functions"),
                             (text.replace('"spoke": ', '"spoke": 1'), "to which no edge leads"),
                             (text[:400], "c.caps.json: line ")):
        (folder / "c.caps.json").write_text(changed)
        for command in ("info c.off", "export c.off -o again.ply"):
            said = shell.run(command, 1)
            need(message in said, f"{command}: {said}")


def film(shell):
    """A scene per iterate, and scenes that show them; POV-Ray, where it is installed, draws two pictures."""
    folder = shell.folder / "film"
    shutil.copy(SAMPLES / "star3.obj", shell.folder / "star.obj")
    shell.run("fair star.obj --functional penalised --max-iterations 2 --pov mesh2 --pov-steps 1 --film film -q")
    frames = sorted(path.name for path in folder.glob("iter*.pov"))
    need(frames[:2] == ["iter0000.pov", "iter0001.pov"], f"frames {frames}")
    need(f"Final_Frame={len(frames) - 1}\n" in (folder / "film.ini").read_text(), "the last frame of film.ini")
    need(f'"iter{len(frames) - 1:04}.inc"' in (folder / "before_after.pov").read_text(), "the last frame beside the first")
    need("film_Middle" in (folder / "film.pov").read_text(), "the camera of all frames")
    shell.run("fair star.obj --max-iterations 0 --film absent/film -q", 4)
    if shutil.which("povray") is None:
        return
    for scene in (["film.ini", "+KFI1", "+KFF1"], ["before_after.pov"]):
        result = subprocess.run(["povray", *scene, "+W32", "+H24", "-D", "-GA"], cwd=folder, capture_output=True, text=True)
        need(result.returncode == 0, f"povray {scene}: {result.stderr[-1000:]}")
    need(len(list(folder.glob("*.png"))) == 2, "two pictures")


def pair(shell):
    """The start and the result beside each other, and each alone, with the settings of the exporter."""
    folder = shell.folder / "pair"
    shutil.copy(SAMPLES / "star3.obj", shell.folder / "star.obj")
    line = "fair star.obj --functional penalised --max-iterations 2 --pov mesh2 --pov-steps 1 --before-after"
    shell.run(f"{line} pair -o end.obj -q")
    needed = {"before.inc", "before.pov", "after.inc", "after.pov", "before_after.ini", "before_after.pov"}
    need({path.name for path in folder.iterdir()} == needed, "the files of the pair")
    # triangles of the same surfaces as the nets give
    shell.run("export star.obj --pov mesh2 --pov-steps 1 --name surface -o start.pov")
    for one, other in (("before", "start"), ("after", "end")):
        if other == "end":
            shell.run("export end.obj --pov mesh2 --pov-steps 1 --name surface -o end.pov")
        numbers = [path.read_text().split("mesh2")[1] for path in (folder / f"{one}.inc", shell.folder / f"{other}.inc")]
        need(numbers[0] == numbers[1], f"{one}.inc is another surface than that of {other}.obj")
    shell.run("fair star.obj --max-iterations 0 --before-after absent/pair -q", 4)
    if shutil.which("povray") is None:
        return
    for scene in (["before_after.pov"], ["before_after.ini", "+SF9", "+EF9"], ["after.pov"]):
        result = subprocess.run(["povray", *scene, "+W32", "+H24", "-D", "-GA"], cwd=folder, capture_output=True, text=True)
        need(result.returncode == 0, f"povray {scene}: {result.stderr[-1000:]}")
    need(len(list(folder.glob("*.png"))) == 3, "three pictures")


CASES = {"caps": caps, "film": film, "pair": pair}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fairsurf", required=True, type=pathlib.Path)
    parser.add_argument("case", choices=CASES)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        CASES[arguments.case](Shell(str(arguments.fairsurf.resolve()), pathlib.Path(folder)))
    print("as expected")


if __name__ == "__main__":
    main()
