#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""GLB files in other people's readers: run.py --fairsurf PROGRAM --samples FOLDER --out FOLDER

The validator of the format finds no error and no warning; gltf-transform (with draco3d) and three's loaders (with their own
decoder) see the counts and boxes that the file declares, and as many triangles as the patches make. The readers are npm
packages, fetched once into the folder. Exits with 77 where node, npm or the packages are not to be had.
"""
import argparse
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import zlib

HERE = pathlib.Path(__file__).resolve().parent
STEPS = 8


def skip(why):
    print('skipped: ' + why)
    sys.exit(77)


def prepare(out):
    """Packages of the lock file in out/node_modules, the scripts beside them."""
    if not shutil.which('node') or not shutil.which('npm'):
        skip('node and npm are not installed')
    out.mkdir(parents=True, exist_ok=True)
    lock = HERE / 'package-lock.json'
    if not (out / 'done').exists() or (out / 'done').read_bytes() != lock.read_bytes():
        for name in ('package.json', 'package-lock.json'):
            shutil.copy(HERE / name, out / name)
        npm = subprocess.run(['npm', 'ci', '--ignore-scripts', '--prefer-offline', '--no-audit', '--no-fund', '--loglevel=error'],
                             cwd=out, capture_output=True, text=True)
        if npm.returncode != 0:
            skip('npm ci did not get the packages: ' + npm.stderr.strip()[-300:])
        shutil.copy(lock, out / 'done')
    for name in ('readers.mjs', 'three_reader.mjs'):
        shutil.copy(HERE / name, out / name)


def double(path, out):
    """The mesh twice, side by side."""
    lines = path.read_text().splitlines()
    vertices = [[float(x) for x in line.split()[1:4]] for line in lines if line.startswith('v ')]
    faces = [[int(word.split('/')[0]) for word in line.split()[1:]] for line in lines if line.startswith('f ')]
    width = max(v[0] for v in vertices) - min(v[0] for v in vertices)
    with out.open('w') as file:
        for k in (0, 1):
            file.writelines(f'v {x + 1.5 * k * width} {y} {z}\n' for x, y, z in vertices)
        for k in (0, len(vertices)):
            file.writelines('f ' + ' '.join(str(v + k) for v in face) + '\n' for face in faces)


def open_glb(path):
    """JSON and binary chunk, taken apart here."""
    data = path.read_bytes()
    magic, version, size, json_size, json_type = struct.unpack_from('<4sIII4s', data)
    assert (magic, version, size, json_type) == (b'glTF', 2, len(data), b'JSON'), 'head of ' + path.name
    bin_size, bin_type = struct.unpack_from('<I4s', data, 20 + json_size)
    assert bin_type == b'BIN\0' and 28 + json_size + bin_size == len(data), 'chunks of ' + path.name
    return json.loads(data[20:20 + json_size]), data[28 + json_size:]


def check_picture(gltf, chunk):
    """The ramp is a PNG of one row, 256 wide, without damage."""
    view = gltf['bufferViews'][gltf['images'][0]['bufferView']]
    png = chunk[view['byteOffset']:view['byteOffset'] + view['byteLength']]
    assert png[:8] == b'\x89PNG\r\n\x1a\n'
    at, data = 8, b''
    while at < len(png):
        size, name = struct.unpack_from('>I4s', png, at)
        body = png[at + 8:at + 8 + size]
        assert struct.unpack_from('>I', png, at + 8 + size)[0] == zlib.crc32(name + body), 'sum of ' + name.decode()
        data += body if name == b'IDAT' else b''
        at += 12 + size
    row = zlib.decompress(data)
    assert len(row) == 1 + 3 * 256 and row[0] == 0
    assert row[1:4] == bytes([26, 51, 191]) and row[-3:] == bytes([191, 26, 26]), 'ends of the ramp'


def near(a, b):
    return all(abs(x - y) < 1e-6 for x, y in zip(a, b))


def check(case, said, gltf, chunk):
    issues = said['validator']
    assert issues['numErrors'] == 0 and issues['numWarnings'] == 0, issues
    parts, seen = said['transform']['parts'], said['three']['parts']
    assert len(parts) == len(seen) == case['parts'] == len(gltf['meshes'])
    assert sum(p['triangles'] for p in parts) == case['triangles'], (parts, case)
    if 'vertices' in case:
        assert sum(p['vertices'] for p in parts) == case['vertices'], (parts, case)
    names = {'POSITION', 'NORMAL'} | ({'TEXCOORD_0', '_CURVATURE'} if case['colour'] else set())
    for mesh, part, other in zip(gltf['meshes'], parts, seen):
        primitive = mesh['primitives'][0]
        position = gltf['accessors'][primitive['attributes']['POSITION']]
        corners = gltf['accessors'][primitive['indices']]
        assert part['vertices'] == other['vertices'] == position['count'] == part['largest'] + 1
        assert part['triangles'] == other['triangles'] == corners['count'] / 3
        for box in (part, other):
            assert box['min'] == position['min'] and box['max'] == position['max'], (box, position)
        assert set(part['attributes']) == names
        assert len(other['attributes']) == len(names)
        assert other['hasPicture'] == case['colour']
        assert near(other['up'], [0, 1, 0]), other['up']
    assert said['transform']['extensions'] == (['KHR_draco_mesh_compression'] if case['draco'] else [])
    assert said['transform']['images'] == (1 if case['colour'] else 0)
    if case['colour']:
        check_picture(gltf, chunk)


def make_cases(arguments):
    double(arguments.samples / 'torus.obj', arguments.out / 'two.obj')
    meshes = [('genus2', arguments.samples / 'genus2.obj', 1, -2), ('pipe', arguments.samples / 'pipe.obj', 1, None),
              ('hull', arguments.samples / 'hull.obj', 1, None), ('two', arguments.out / 'two.obj', 2, 0)]
    for name, path, parts, euler in meshes:
        info = json.loads(subprocess.run([arguments.fairsurf, 'info', '--json', path], check=True, capture_output=True).stdout)
        triangles = info['space']['squares'] * STEPS * STEPS * 2
        for draco in (False, True):
            for colour in (False, True):
                file = arguments.out / f'{name}{"-draco" if draco else ""}{"-colour" if colour else ""}.glb'
                command = [arguments.fairsurf, 'export', path, '--draco', 'yes' if draco else 'no', '--steps', str(STEPS)]
                command += (['--colour', 'mean'] if colour else []) + ['-o', file]
                subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
                case = {'file': file, 'parts': parts, 'triangles': triangles, 'draco': draco, 'colour': colour}
                if euler is not None:  # V - E + F, with E = 3 F / 2 on closed triangles
                    case['vertices'] = triangles // 2 + euler
                yield case


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--fairsurf', required=True)
    parser.add_argument('--samples', type=pathlib.Path, required=True)
    parser.add_argument('--out', type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    if '.drc' not in subprocess.run([arguments.fairsurf, '--list'], capture_output=True, text=True).stdout:
        skip('built without Draco')
    prepare(arguments.out)
    cases = list(make_cases(arguments))
    node = subprocess.run(['node', 'readers.mjs'] + [case['file'].resolve() for case in cases], cwd=arguments.out,
                          stdout=subprocess.PIPE, text=True)
    assert node.returncode == 0, 'readers.mjs failed'
    for case, line in zip(cases, node.stdout.splitlines(), strict=True):
        gltf, chunk = open_glb(case['file'])
        check(case, json.loads(line), gltf, chunk)
        print(f"{case['file'].name}: {case['file'].stat().st_size} bytes, {case['triangles']} triangles: 0 errors, 0 warnings")


main()
