#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds the sources to the order of the rooms in core/meson.build: check_layering.py [ROOT].

A file of a room includes headers of its own room and of the rooms before it only; its public headers are ROOM.h and
ROOM_part.h of include/fairsurf/. Exporters may use all of core but the files, which only their table exporters.c knows; the
command line, the samples and the benchmarks only include/. Prints every include that breaks this and exits with 1.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])(?:(fairsurf)/)?(?:([\w-]+)/)?([\w.-]+)[>"]')
RELATIVE = re.compile(r'^\s*#\s*include\s*"[^"]*\.\.')
PUBLIC_ONLY = ("cli", "samples", "bench")


def read_rooms(root):
    text = (root / "core" / "meson.build").read_text(encoding="utf-8")
    return re.findall(r"'([^']+)'", re.search(r"^rooms\s*=\s*\[(.*?)\]", text, re.M | re.S).group(1))


def sources(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".c", ".h", ".cc", ".hh"))


def includes(path):
    """(line number, line, room that is included or None, whether by its public header)"""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if RELATIVE.match(line):
            yield number, line.strip(), "..", False
        match = INCLUDE.match(line)
        if match:
            _, public, folder, file = match.groups()
            yield number, line.strip(), pathlib.Path(file).stem.split("_")[0] if public else folder, bool(public)


def check(root):
    rooms = read_rooms(root)
    found = []

    def complain(path, number, line, why):
        found.append(f"{path.relative_to(root)}:{number}: {line}: {why}")

    def check_room(path, room, allowed):
        for number, line, target, is_public in includes(path):
            if target == "..":
                complain(path, number, line, "paths of includes begin at core/")
            elif is_public and target not in rooms + ["export"]:
                complain(path, number, line, "the rooms include single headers")
            elif target in rooms + ["export"] and target not in allowed:
                complain(path, number, line, f"{room} may use {', '.join(allowed)} only")

    # export.h is the border to the exporters: it stands after analyse, and file, the last room, uses it.
    for place, room in enumerate(rooms):
        allowed = rooms[:place + 1] + (["export"] if room == "file" else [])
        if not (root / "core" / room).is_dir():
            found.append(f"core/meson.build: there is no folder core/{room}")
        for path in sources(root / "core" / room):
            check_room(path, room, allowed)
        for header in sources(root / "include" / "fairsurf"):
            if header.stem.split("_")[0] == room:
                check_room(header, header.name, allowed)
    strangers = {path.name for path in (root / "core").iterdir() if path.is_dir()} - set(rooms)
    found += [f"core/{name}: not in the list of rooms" for name in sorted(strangers)]
    check_outside(root, rooms, complain)
    return found


def check_outside(root, rooms, complain):
    before_file = [room for room in rooms if room != "file"]
    for path in sources(root / "exporters"):
        for number, line, target, is_public in includes(path):
            if path.name != "exporters.c" and target in rooms and target not in before_file:
                complain(path, number, line, "exporters write to an output, never to a path")
    for folder in PUBLIC_ONLY:
        for path in sources(root / folder):
            for number, line, target, is_public in includes(path):
                if not is_public and target in rooms + ["exporters", "core", ".."]:
                    complain(path, number, line, f"{folder} may use include/ only")


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent / "..").resolve()
    found = check(root)
    print("\n".join(found) if found else "every include follows the order of the rooms")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
