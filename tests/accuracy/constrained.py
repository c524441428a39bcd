# SPDX-License-Identifier: MIT
"""Constraints, measured on the surface that was written: its Bezier points (.bv), evaluated here, and points of its triangles."""
import itertools
import math

from tool import FOLDER, at_least, at_most, fair, read_marks, read_obj, row, run

STEPS = 16  # the held points lie at multiples of 1 / STEPS


def bezier_patches(path, name, *words):
    """points[v][u] of every patch."""
    out = FOLDER / f"{name}.bv"
    run("export", path, *words, "-o", out)
    return read_bezier(out)


def read_bezier(out):
    lines = [line for line in out.read_text(encoding="utf-8").splitlines() if not line.startswith("Group")]
    words, patches, at = " ".join(lines).split(), [], 0
    while at < len(words):
        kind, at = int(words[at]), at + 1
        assert kind in (4, 5), kind
        degree = [int(words[at])] * 2 if kind == 4 else [int(words[at]), int(words[at + 1])]
        at += 1 if kind == 4 else 2
        rows = []
        for _ in range(degree[1] + 1):
            rows.append([tuple(map(float, words[at + 3 * i:at + 3 * i + 3])) for i in range(degree[0] + 1)])
            at += 3 * (degree[0] + 1)
        patches.append(rows)
    return patches


def casteljau(points, t):
    """Point and derivative of a Bezier curve."""
    n = len(points) - 1
    while len(points) > 2:
        points = [tuple((1 - t) * a + t * b for a, b in zip(p, q)) for p, q in zip(points, points[1:])]
    p, q = points
    return tuple((1 - t) * a + t * b for a, b in zip(p, q)), tuple(n * (b - a) for a, b in zip(p, q))


def evaluate(patch, u, v):
    """Point and unit normal."""
    along_u = [casteljau(line, u) for line in patch]
    point, p_v = casteljau([p for p, _ in along_u], v)
    p_u = casteljau([d for _, d in along_u], v)[0]
    n = (p_u[1] * p_v[2] - p_u[2] * p_v[1], p_u[2] * p_v[0] - p_u[0] * p_v[2], p_u[0] * p_v[1] - p_u[1] * p_v[0])
    return point, tuple(x / math.hypot(*n) for x in n)


def held_points(meshes):
    """Points lifted off the start, with tangent planes, on a square and in a cap of trojnik3."""
    mesh, marks = meshes / "trojnik3.obj", meshes / "trojnik3.fixed.txt"
    start = bezier_patches(mesh, "start")
    # the points of the start at the middles of patches, moved along their normals
    targets = []
    for patch, lift in ((start[120], 0.05), (start[0], -0.03), (start[200], 0.02)):
        p, n = evaluate(patch, 0.5, 0.5)
        targets.append((p, tuple(a + lift * b for a, b in zip(p, n)), n))
    faces = FOLDER / "points.txt"
    lines = ["%.17g %.17g %.17g normal %.17g %.17g %.17g" % (*to, *n) for _, to, n in targets]
    faces.write_text("\n".join(lines) + "\n", encoding="utf-8")
    path, _ = fair(mesh, "held", "--fixed", marks, "--points", faces)
    result = bezier_patches(path, "held")
    gaps, angles = [], []
    for _, to, n in targets:
        point, normal = follow(result, to)
        gaps.append(math.dist(point, to))
        angles.append(math.asin(min(1.0, math.dist(normal, n))))
    at_most("6", "trojnik3, three lifted points: largest distance of the surface", 1e-10, max(gaps))
    at_most("6", "trojnik3, tangent planes there: largest angle", 1e-9, max(angles))


def follow(patches, target):
    """The point of the surface nearest to the target, by halving a grid around the best one."""
    grid = [k / STEPS for k in range(STEPS + 1)]
    reach = lambda patch: min(math.dist(p, target) for line in patch for p in line)
    best = min(((math.dist(evaluate(patch, u, v)[0], target), u, v, k) for k, patch in
                sorted(enumerate(patches), key=lambda item: reach(item[1]))[:9] for u in grid for v in grid))
    distance, u, v, k = best
    step = 1 / STEPS
    while step > 1e-14:
        around = [(max(0.0, min(1.0, u + a * step)), max(0.0, min(1.0, v + b * step))) for a in (-1, 0, 1) for b in (-1, 0, 1)]
        tried = min((math.dist(evaluate(patches[k], a, b)[0], target), a, b) for a, b in around)
        if tried[0] < distance:
            distance, u, v = tried
        else:
            step /= 2
    return evaluate(patches[k], u, v)


def symmetry(meshes):
    mesh, marks = meshes / "trojnik3.obj", meshes / "trojnik3.fixed.txt"
    for plane, axis in (("y", 1), ("z", 2)):
        file = FOLDER / f"mirror-{plane}.bv"
        path, report = fair(mesh, f"mirror-{plane}", "--fixed", marks, "--symmetry", plane, "-o", file)
        points, _ = read_obj(written(path))
        free = set(points)
        lost = [p for p in points if image(p, axis) not in free]
        points_of_nets = {p for patch in read_bezier(file) for line in patch for p in line}
        unlike = sum(image(p, axis) not in points_of_nets for p in points_of_nets)
        row("6", f"trojnik3, --symmetry {plane}: Bezier points without an image to the last bit", "0",
            f"{unlike} of {len(points_of_nets)}", unlike == 0)
        row("6", f"trojnik3, --symmetry {plane}: vertices without an image to the last bit", "0",
            f"{len(lost)} of {len(points)}; S {report['end']['S']:.6f}", not lost)


def written(path):
    out = path.with_suffix(".obj")
    run("export", path, "--net", "-o", out)
    return out


def image(p, axis):
    return tuple(-x if k == axis else x for k, x in enumerate(p))


def near(meshes):
    """Distances of points of the result from the triangles of a target mesh, which are exact here, and of the start."""
    mesh, marks = meshes / "trojnik3.obj", meshes / "trojnik3.fixed.txt"
    target = FOLDER / "target.obj"
    run("export", mesh, "--surface", "-o", target, "--steps", 6)
    for tolerance in (0.05, 1e-3, 1e-4):
        path, report = fair(mesh, f"near{tolerance:g}", "--fixed", marks, "--caps", "linear", "--stay-within", tolerance)
        at_most("6", f"trojnik3, --stay-within {tolerance:g}: largest distance in the report", tolerance, report["distance"])
        found = largest_distance(path, mesh, 24, tolerance)
        at_most("6", f"trojnik3, --stay-within {tolerance:g}: of 7 x 7 points per patch from triangles of the start "
                "(their sagitta 2e-5 allowed)", tolerance + 2e-5, found)
    path, report = fair(mesh, "near-mesh", "--fixed", marks, "--caps", "linear", "--stay-within", 0.04, "--stay-near", target)
    out = FOLDER / "near-mesh.points.obj"
    run("export", path, "--surface", "-o", out, "--steps", 6)
    found = Triangles(*read_obj(target), 0.04).largest(read_obj(out)[0])
    at_most("6", "trojnik3, --stay-within 0.04 --stay-near MESH: of 7 x 7 points per patch", 0.04, found)
    at_least("6", "the same: what is used of it", 0.036, found)


def largest_distance(path, start, steps, tolerance):
    target, points = FOLDER / "fine.obj", FOLDER / "points.obj"
    run("export", start, "--surface", "-o", target, "--steps", steps)
    run("export", path, "--surface", "-o", points, "--steps", 6)
    return Triangles(*read_obj(target), max(tolerance, 0.02)).largest(read_obj(points)[0])


class Triangles:
    """Triangles in cells, to find the nearest ones within a reach."""

    def __init__(self, points, faces, reach):
        self.cell, self.points = 1.2 * reach, points
        self.cells = {}
        for a, b, c in faces:
            corners = (points[a], points[b], points[c])
            ranges = [range(math.floor((min(x) - reach) / self.cell), math.floor((max(x) + reach) / self.cell) + 1)
                      for x in zip(*corners)]
            for key in itertools.product(*ranges):
                self.cells.setdefault(key, []).append(corners)

    def largest(self, points):
        worst = 0.0
        for p in points:
            key = tuple(math.floor(x / self.cell) for x in p)
            best = math.inf
            for triangle in self.cells.get(key, ()):
                best = min(best, square_distance(p, *triangle))
                if best <= worst * worst:
                    break
            worst = max(worst, math.sqrt(best))
        return worst


def square_distance(p, a, b, c):
    """Of a point from a triangle: its plane where the foot is inside, else the nearest side."""
    ab, ac, ap = minus(b, a), minus(c, a), minus(p, a)
    d11, d12, d22, e1, e2 = dot(ab, ab), dot(ab, ac), dot(ac, ac), dot(ap, ab), dot(ap, ac)
    det = d11 * d22 - d12 * d12
    if det > 0:
        s, t = (d22 * e1 - d12 * e2) / det, (d11 * e2 - d12 * e1) / det
        if s >= 0 and t >= 0 and s + t <= 1:
            q = [x - s * y - t * z for x, y, z in zip(ap, ab, ac)]
            return dot(q, q)
    return min(from_side(p, a, b), from_side(p, b, c), from_side(p, c, a))


def from_side(p, a, b):
    ab, ap = minus(b, a), minus(p, a)
    length = dot(ab, ab)
    t = max(0.0, min(1.0, dot(ap, ab) / length)) if length > 0 else 0.0
    q = [x - t * y for x, y in zip(ap, ab)]
    return dot(q, q)


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def contradictions(meshes):
    mesh, file = meshes / "trojnik3.obj", FOLDER / "bad.txt"
    free = next(v for v in range(359) if v not in read_marks(meshes / "trojnik3.fixed.txt"))
    file.write_text(f"z: {free} = 0.1\nz: 2*{free} = 0.4\n", encoding="utf-8")
    said, _ = run("fair", mesh, "--fixed", meshes / "trojnik3.fixed.txt", "--equations", file, "-o", FOLDER / "no.ply", code=1)
    row("6", "two equations that contradict each other", "named", said.strip().replace(str(FOLDER) + "/", ""),
        "bad.txt, line 2 contradicts" in said and not (FOLDER / "no.ply").exists())


def all_kinds(meshes):
    held_points(meshes)
    symmetry(meshes)
    contradictions(meshes)
    near(meshes)
