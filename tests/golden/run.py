#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs cases of cases.txt and compares what they print and write with expected/.

Usage: run.py --fairsurf EXE [--update] [NAME...]      --update shows the differences and takes what was found

Numbers may differ by 1e-6 of their size and 1e-7: sums are rounded differently by another compiler or BLAS; text is
compared to the letter. Long files are kept in full: a change that is meant shows in the history of expected/.
"""
import argparse
import difflib
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
SAMPLES = HERE / ".." / ".." / "samples"
RELATIVE, ABSOLUTE = 1e-6, 1e-7
NUMBER = re.compile(r"(?<![\w.])([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)")
SECONDS = re.compile(r"\d+\.\d+ s\b")  # the only output that depends on the machine
VERSION = re.compile(r"\bfairsurf \d+\.\d+\.\d+")


def read_cases():
    lines = (line.split("#")[0].split() for line in (HERE / "cases.txt").read_text(encoding="utf-8").splitlines())
    return {words[0]: words[1:] for words in lines if words}


def section(title, data):
    """Text of a file or stream under its title; bytes that are no text in hexadecimal."""
    try:
        text = data.decode("utf-8")
        if "\0" in text:
            raise ValueError("binary")
    except ValueError:
        text = "\n".join(data[at:at + 25].hex() for at in range(0, len(data), 25)) + "\n"
    text = VERSION.sub("fairsurf VERSION", SECONDS.sub("TIME s", text))
    return f"== {title}\n{text}" + ("" if text.endswith("\n") or not text else "\n(no newline at the end)\n")


def run_case(fairsurf, words):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for sample in [*SAMPLES.glob("meshes/*.obj"), *SAMPLES.glob("constraints/*.txt"), *SAMPLES.glob("patches/*.[obsx][bvpy]*")]:
            shutil.copy(sample, folder)
        before = {path.name for path in folder.iterdir()}
        result = subprocess.run([fairsurf, *words], cwd=folder, capture_output=True, check=False, timeout=300)
        parts = [f"$ fairsurf {' '.join(words)}\nexit {result.returncode}\n"]
        # The name under which the program was started stands in messages about usage.
        own = str(fairsurf).encode()
        parts += [section(title, stream.replace(own, b"fairsurf"))
                  for title, stream in (("stdout", result.stdout), ("stderr", result.stderr)) if stream]
        parts += [section(path.name, path.read_bytes()) for path in sorted(folder.iterdir()) if path.name not in before]
        return "".join(parts)


def is_same_number(found, expected):
    a, b = float(found), float(expected)
    return a == b or abs(a - b) <= ABSOLUTE + RELATIVE * max(abs(a), abs(b))


def is_same_line(found, expected):
    a, b = NUMBER.split(found), NUMBER.split(expected)
    if len(a) != len(b) or a[::2] != b[::2]:
        return False
    return all(is_same_number(x, y) for x, y in zip(a[1::2], b[1::2]))


def differences(found, expected):
    a, b = found.splitlines(), expected.splitlines()
    if len(a) == len(b):
        # Lines that agree within the tolerance are shown as they were expected.
        a = [y if is_same_line(x, y) else x for x, y in zip(a, b)]
    return list(difflib.unified_diff(b, a, "expected", "found", lineterm="", n=1))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fairsurf", type=pathlib.Path, required=True)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    cases = read_cases()
    failed = False
    for name in arguments.names or cases:
        path = HERE / "expected" / f"{name}.txt"
        expected = path.read_text(encoding="utf-8") if path.exists() else ""
        found = run_case(arguments.fairsurf.resolve(), cases[name])
        lines = differences(found, expected)
        if lines:
            print(f"{name}: {len(lines)} lines of difference")
            print("\n".join(lines[:40]))
            failed = True
            if arguments.update:
                path.write_text(found, encoding="utf-8")
    return 1 if failed and not arguments.update else 0


if __name__ == "__main__":
    sys.exit(main())
