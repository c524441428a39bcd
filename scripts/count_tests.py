#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Sums up the JSON logs of "meson test": what failed and what was skipped, and last "N passed, N failed".

With the environment variable CI set to true, a skipped test counts as failed unless a line of the skips file names it.
A log that is missing or empty and every build that broke (--broken N) count as one failure each.
"""
import argparse
import json
import os
import sys


def read_results(path):
    """[(name, result)] of one log: a JSON object per line."""
    with open(path, encoding="utf-8") as file:
        return [(entry["name"], entry["result"]) for entry in map(json.loads, filter(str.strip, file))]


def read_skips(path):
    """{name: reason}: lines "NAME reason"; # begins a comment."""
    if not path or not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        lines = [line.split("#")[0].split(None, 1) for line in file]
    skips = {line[0]: line[1].strip() for line in lines if len(line) == 2}
    unexplained = [line[0] for line in lines if len(line) == 1]
    if unexplained:
        sys.exit(f"{path}: no reason given for {', '.join(unexplained)}")
    return skips


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--broken", type=int, default=0)
    parser.add_argument("--skips")
    parser.add_argument("logs", nargs="*")
    arguments = parser.parse_args()
    skips = read_skips(arguments.skips)
    strict = os.environ.get("CI", "").lower() in ("true", "1")
    passed, failed = 0, arguments.broken
    for log in arguments.logs:
        try:
            results = read_results(log)
        except (OSError, ValueError) as error:
            print(f"no results: {error}")
            results = []
        if not results:
            print(f"FAILED {log}: no test ran")
            failed += 1
        for name, result in results:
            if result in ("OK", "EXPECTEDFAIL"):
                passed += 1
            elif result == "SKIP":
                short = name.split("/")[-1].split(":")[-1].strip()
                reason = skips.get(short) or skips.get(name)
                allowed = reason is not None or not strict
                print(f"{'skipped' if allowed else 'FAILED (skipped)'} {name}{': ' + reason if reason else ''}")
                failed += not allowed
            else:
                print(f"FAILED {name}: {result.lower()}")
                failed += 1
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
