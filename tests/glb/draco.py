#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draco's own tools and our files: draco.py --fairsurf PROGRAM --samples FOLDER --out FOLDER

draco_decoder turns our control nets into OBJ with the same polygons, and what draco_encoder makes of OBJ files, triangles or
kept polygons, is read by fairsurf. Exits with 77 where the tools are not installed.
"""
import argparse
import collections
import itertools
import json
import math
import pathlib
import shutil
import subprocess
import sys


def run(*command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    assert result.returncode == 0, f'{command}: {result.stdout} {result.stderr}'
    return result.stdout


def read_obj(path):
    lines = [line.split() for line in path.read_text().splitlines()]
    vertices = [tuple(float(x) for x in line[1:4]) for line in lines if line[:1] == ['v']]
    return vertices, [[int(word.split('/')[0]) - 1 for word in line[1:]] for line in lines if line[:1] == ['f']]


def cell(point, step=1e-3):
    return tuple(math.floor(x / step) for x in point)


def number_by_place(points, vertices):
    """For every vertex the one of the points that lies within 1e-5 of it."""
    cells = collections.defaultdict(list)
    for i, point in enumerate(points):
        cells[cell(point)].append(i)
    numbers = []
    for vertex in vertices:
        near = [i for shift in itertools.product((-1, 0, 1), repeat=3)
                for i in cells.get(tuple(map(sum, zip(cell(vertex), shift))), []) if math.dist(points[i], vertex) < 1e-5]
        assert len(near) == 1, f'{len(near)} vertices at {vertex}'
        numbers.append(near[0])
    return numbers


def cycles(faces):
    """Faces begun at their least vertex."""
    return collections.Counter(tuple(face[face.index(min(face)):] + face[:face.index(min(face))]) for face in faces)


def check(fairsurf, mesh, out):
    drc, decoded, ours = out / 'net.drc', out / 'decoded.obj', out / 'ours.obj'
    # Single precision without quantisation; the decoder prints six digits behind the point.
    run(fairsurf, 'refine', mesh, '--net-bits', 0, '-o', drc, '-o', ours)
    run('draco_decoder', '-i', drc, '-o', decoded)
    vertices, faces = read_obj(ours)
    their_vertices, their_faces = read_obj(decoded)
    number = number_by_place(vertices, their_vertices)
    own, theirs = cycles(faces), cycles([[number[v] for v in face] for face in their_faces])
    assert theirs == own, f'{mesh.name}: {len(theirs - own)} faces of {sum(own.values())} differ'
    n = sum(own.values())
    for options in ([], ['-preserve_polygons']):
        run('draco_encoder', '-i', ours, '-o', drc, '-qp', 20, *options)
        info = json.loads(run(fairsurf, 'info', '--json', drc))
        sizes = {int(size): count for size, count in info['face_size'].items()}
        if options:
            assert sum(sizes.values()) == n, sizes
        else:
            assert sizes == {3: sum(len(face) - 2 for face in read_obj(ours)[1])}, sizes
        assert info['components'] == json.loads(run(fairsurf, 'info', '--json', ours))['components']
    print(f'{mesh.name}: {n} faces')


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--fairsurf', required=True)
    parser.add_argument('--samples', type=pathlib.Path, required=True)
    parser.add_argument('--out', type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    if not shutil.which('draco_decoder') or not shutil.which('draco_encoder'):
        print('skipped: draco_decoder and draco_encoder are not installed')
        sys.exit(77)
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name in ('pipe', 'star7', 'torus', 'genus2', 'hull'):
        check(arguments.fairsurf, arguments.samples / (name + '.obj'), arguments.out)


main()
