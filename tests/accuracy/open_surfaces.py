# SPDX-License-Identifier: MIT
"""Open surfaces: the three tubes trojnik3, 4, 5 with marks."""
from tool import add_noise, at_least, at_most, check, fair, measure, read_marks

LIMITS = {3: (3.105, 2.999), 4: (2.841, 2.80), 5: (2.845, 2.81)}
FULL = {3: 2.72, 4: 2.71}


def files(meshes, k):
    return meshes / f"trojnik{k}.obj", meshes / f"trojnik{k}.fixed.txt"


def judge(line, what, path, report, marks, limit, words=()):
    """What is asked of every surface: S, S by 24 nodes, no fold, G2."""
    finer = measure(path, "--fixed", marks, *words)
    S = report["end"]["S"]
    at_most(line, f"{what}: S", limit, S)
    at_most(line, f"{what}: S by 24 nodes / S", 1.002, finer["end"]["S"] / S)
    numbers = check(path, *words)
    at_least(line, f"{what}: least |p_u x p_v| by its mean", 1e-3,
             min(report["quality"]["least_density"], numbers["shape"]["regularity"]["least"]))
    at_most(line, f"{what}: largest relative jump of curvature", 1e-9, numbers["max"]["curvature"])
    at_most(line, f"{what}: CPU s", float("inf"), report["cpu"])


def linear(meshes):
    for k, limits in LIMITS.items():
        mesh, marks = files(meshes, k)
        for words, limit in (((), limits[0]), (("--polish",), limits[1])):
            path, report = fair(mesh, f"trojnik{k}{''.join(words)}", "--fixed", marks, "--caps", "linear", "--nodes", 8, *words)
            judge("4", f"trojnik{k} linear {' '.join(words)}", path, report, marks, limit, ("--caps", "linear"))


def noise(meshes):
    for k in LIMITS:
        mesh, marks = files(meshes, k)
        fixed = read_marks(marks)
        found = []
        for part in (0.05, 0.2):
            for seed in (1, 2, 3):
                start = add_noise(mesh, f"noisy{k}-{part}-{seed}", part, seed, fixed)
                _, report = fair(start, start.stem, "--fixed", marks, "--caps", "linear", "--nodes", 8)
                found.append(report["end"]["S"])
                print(k, part, seed, report["end"]["S"], report["end"]["F"], report["stop"], report["steps"], report["cpu"],
                      flush=True)
        at_most("4", f"trojnik{k} linear, six noisy starts: (largest S - least S) / S", 1e-6, (max(found) - min(found)) / min(found))
        at_most("4", f"trojnik{k} linear, noisy starts: S", LIMITS[k][0], max(found))


def full(meshes):
    for k, limit in FULL.items():
        mesh, marks = files(meshes, k)
        path, report = fair(mesh, f"trojnik{k}-full", "--fixed", marks, "-C", 1e-6)
        judge("5", f"trojnik{k} full caps, C = 1e-6", path, report, marks, limit)
