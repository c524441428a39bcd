#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the report of fairing (fairsurf fair --report FILE.json) as a table."""
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    report = json.load(file)
print(f"{report['free']} free vertices, {report['squares']} squares, {report['caps']} caps, c = {report['c']:.6g}")
print(f"{'':8}{'F':>16}{'S':>16}{'S of caps':>16}{'Q':>16}{'gradient':>12}")
for when in ("start", "end"):
    e = report[when]
    print(f"{when:8}{e['F']:16.9g}{e['S']:16.9g}{e['S_caps']:16.9g}{e['Q']:16.9g}{e['gradient']:12.3g}")
quality = report["quality"]
print(f"S {quality['S']:.9g} with {quality['nodes_square']} nodes on squares and {quality['nodes_cap']} in caps; "
      f"least |p_u x p_v| {quality['least_density']:.3g} of its mean")
print(f"{report['steps']} steps, {report['hessians']} Hessians, {report['factorisations']} factorisations; "
      f"stopped by: {report['stop']}")
seconds = ", ".join(f"{name} {value:.2f}" for name, value in report["seconds"].items())
print(f"seconds: {seconds}; peak memory {report['peak_bytes'] / 2**20:.0f} MB")
