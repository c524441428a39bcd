# SPDX-License-Identifier: MIT
"""What the image tests share: running fairsurf and POV-Ray, and reading a tiny bit of OBJ and .inc files."""
import pathlib
import re
import shutil
import subprocess
import sys

SKIPPED = 77


class Failure(Exception):
    """A test failed, with a sentence why."""


def need_povray():
    if shutil.which("povray") is None:
        print("skipped: povray is not installed")
        sys.exit(SKIPPED)


def need_rsvg():
    if shutil.which("rsvg-convert") is None:
        print("skipped: rsvg-convert is not installed")
        sys.exit(SKIPPED)


def run(command, folder, log):
    """Runs a command in folder; its output goes to the file log and, on failure, its end into the sentence."""
    with open(log, "w", encoding="utf-8") as file:
        result = subprocess.run([str(part) for part in command], cwd=folder, stdout=file, stderr=subprocess.STDOUT,
                                check=False)
    if result.returncode != 0:
        tail = pathlib.Path(log).read_text(encoding="utf-8", errors="replace").splitlines()[-15:]
        raise Failure(f"{command[0]} ended with {result.returncode}:\n" + "\n".join(tail))


def render(scene, width, height, antialias):
    """Renders folder/NAME.pov to folder/NAME.png; the pixels do not depend on threads, dates or the display."""
    smooth = ["+A0.1", "+AM1", "+R3", "-J"] if antialias else ["-A", "-J"]
    picture = scene.with_suffix(".png")
    picture.unlink(missing_ok=True)
    run(["povray", scene.name, "-D", "-GA", "+Q9", f"+W{width}", f"+H{height}", *smooth, "+WT1", f"+O{picture.name}"],
        scene.parent, scene.with_suffix(".log"))
    return picture


def render_svg(drawing, width):
    """Renders folder/NAME.svg to folder/NAME.png."""
    picture = drawing.with_suffix(".png")
    picture.unlink(missing_ok=True)
    run(["rsvg-convert", "-w", width, drawing.name, "-o", picture.name], drawing.parent, drawing.with_suffix(".log"))
    return picture


def read_obj(path):
    """Vertices, and faces with numbers from 0."""
    points, faces = [], []
    for line in path.read_text(encoding="ascii").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["f"]:
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return points, faces


VECTOR = re.compile(r"<\s*([^,<>]+),\s*([^,<>]+),\s*([^,<>]+)>")
PATCH = re.compile(r"bicubic_patch\s*\{[^}]*\}")


def vectors(text):
    return [tuple(map(float, found)) for found in VECTOR.findall(text)]


def box(inc, name):
    """NAME_Min and NAME_Max of an .inc file."""
    ends = []
    for end in ("Min", "Max"):
        match = re.search(rf"#declare\s+{name}_{end}\s*=\s*(<[^>]*>)", inc)
        if match is None:
            raise Failure(f"the .inc file declares no {name}_{end}")
        ends.append(vectors(match.group(1))[0])
    return ends
