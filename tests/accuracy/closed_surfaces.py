# SPDX-License-Identifier: MIT
"""Closed surfaces: the cube that becomes a sphere, bodies with handles, area and volume that are kept."""
import pathlib

from tool import FOLDER, add_noise, at_least, at_most, check, fair, measure, row, run, sphere_deviation, surface_points

SAMPLES = pathlib.Path(__file__).resolve().parents[2] / "samples" / "meshes"

# refined: S A with linear and with full caps, distance from a sphere in radii, and C
CUBE = {1: (18.5, 2.75, 1e-3, 1e-6), 2: (15.8, 2.05, 3e-4, 1e-6), 3: (12.5, 0.95, 5e-5, 1e-7)}


def cube(meshes):
    for n, (linear, full, distance, C) in CUBE.items():
        for caps, limit, far, weight in (("linear", linear, 2e-3, 1e-6), ("full", full, distance, C)):
            what = f"cube refined {n}, {caps} caps, C = {weight:g}"
            path, report = fair(meshes / "catmark_cube.obj", f"cube{n}{caps}", "--refine", n, "--caps", caps, "-C", weight,
                                "--max-iterations", 300)
            numbers, finer = check(path), measure(path, "-C", weight)
            at_most("5", f"{what}: S A", limit, numbers["shape"]["S"] * numbers["shape"]["area"])
            at_most("5", f"{what}: S by 24 nodes / S", 1.002, finer["end"]["S"] / report["end"]["S"])
            at_most("5", f"{what}: largest distance from a sphere / R", far, sphere_deviation(surface_points(path, f"cube{n}{caps}", 12)))
            at_most("5", f"{what}: largest relative jump of curvature", 1e-9, numbers["max"]["curvature"])
            at_least("5", f"{what}: least |p_u x p_v| by its mean", 1e-3, report["quality"]["least_density"])
            row("5", f"{what}: stopped by", "gradient", f"{report['stop']} after {report['steps']} steps, {report['cpu']:.1f} CPU s",
                report["stop"] == "gradient")


def handles(meshes):
    for name, folder in (("gismo_bitorus", meshes), ("genus3", SAMPLES)):
        mesh = folder / f"{name}.obj"
        if name == "genus3":
            run("refine", mesh, "-o", FOLDER / "genus3.obj")  # as often as its surface needs
            mesh = FOLDER / "genus3.obj"
        for C in (1e-2, 1e-3):
            path, report = fair(mesh, f"{name}{C:g}", "--caps", "linear", "-C", C)
            row("5", f"{name}, linear caps, C = {C:g}: stopped by", "gradient",
                f"{report['stop']} after {report['steps']} steps, {report['cpu']:.1f} CPU s", report["stop"] == "gradient")
            at_most("5", f"{name}, C = {C:g}: largest relative jump of curvature", 1e-9, check(path)["max"]["curvature"])
            found = [report["end"]["F"]]
            for seed, part in ((1, 0.05), (2, 0.2), (3, 0.2)):
                start = add_noise(mesh, f"{name}-noise{seed}", part, seed)
                found.append(fair(start, start.stem, "--caps", "linear", "-C", C)[1]["end"]["F"])
            at_most("5", f"{name}, C = {C:g}, three noisy starts: (largest F - least F) / F", 1e-9, max(found) / min(found) - 1)



def kept(meshes):
    start = meshes / "gismo_bitorus.obj"
    before = check(start)["shape"]
    for what in ("area", "volume"):
        path, _ = fair(start, f"kept-{what}", "--keep", what, "-C", 1e-2)
        after = check(path)["shape"]
        at_most("5", f"gismo_bitorus, --keep {what}: |change of the {what}|", 1e-10, abs(after[what] / before[what] - 1))
