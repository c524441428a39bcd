#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the comparer and the crack counter on pictures made here: tools.py COMPARE CRACK."""
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

COMPARE, CRACK = sys.argv[1:3]
SIZE, WHITE, BLUE, GREEN, RED, DARK = 24, (255, 255, 255), (0, 0, 255), (0, 255, 0), (200, 0, 0), (120, 0, 0)


def write_png(path, pixels):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + bytes(channel for pixel in row for channel in pixel) for row in pixels)
    head = struct.pack(">IIBBBBB", len(pixels[0]), len(pixels), 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def square(changes=(), colour=WHITE):
    """A colour from 4 to 19 on blue, some pixels (x, y) changed to another."""
    pixels = [[colour if 4 <= x < 20 and 4 <= y < 20 else BLUE for x in range(SIZE)] for y in range(SIZE)]
    for x, y, other in changes:
        pixels[y][x] = other
    return pixels


def main():
    failures = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        pictures = {
            "same": square(),
            "close": square([(9, 9, (253, 255, 255))]),
            "two": square([(9, 9, (252, 255, 255)), (4, 5, BLUE)]),
            "inner": square([(9, 9, BLUE)]),
            "rim": square([(4, 5, BLUE), (19, 10, BLUE)]),
            "tinted": square([(9, 9, (200, 40, 0))]),
            "empty": [[BLUE] * SIZE for _ in range(SIZE)],
            "small": [[BLUE] * 3 for _ in range(3)],
        }
        path = {key: folder / f"{key}.png" for key in pictures}
        for key, pixels in pictures.items():
            write_png(path[key], pixels)
        path["rubbish"] = folder / "rubbish.png"
        path["rubbish"].write_bytes(b"\x89PNG\r\n\x1a\nrubbish")

        def expect(code, text, *command):
            result = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
            if result.returncode != code or text not in result.stdout + result.stderr:
                failures.append(f"{[str(c) for c in command]}: {result.returncode} {result.stdout}{result.stderr}")

        fine = path["same"]
        expect(0, "0 pixels", COMPARE, fine, path["same"])
        expect(0, "largest difference 2", COMPARE, fine, path["close"])
        expect(1, "1 pixels", COMPARE, fine, path["close"], "--tolerance", 1)
        expect(1, "2 pixels", COMPARE, fine, path["two"], "--pixels", 1, "--difference", folder / "difference.png")
        expect(0, "2 pixels", COMPARE, fine, path["two"], "--pixels", 2)
        # The difference picture has red where the two pixels differ and grey elsewhere.
        grey = square()
        grey = [[(254, 254, 254) if pixel == WHITE else (212, 212, 212) for pixel in row] for row in grey]
        grey[9][9], grey[5][4] = (129, 0, 0), (255, 0, 0)
        write_png(folder / "expected.png", grey)
        expect(0, "0 pixels", COMPARE, folder / "difference.png", folder / "expected.png", "--tolerance", 0)
        expect(1, "sizes differ", COMPARE, fine, path["small"])
        expect(2, "rubbish.png", COMPARE, fine, path["rubbish"])
        expect(2, "absent.png", COMPARE, fine, folder / "absent.png")
        expect(2, "usage", COMPARE, fine)
        expect(2, "usage", COMPARE, fine, fine, "--pixels", "many")
        fold = [(x, y, DARK) for x in range(12, 20) for y in range(4, 20)]
        for key, changes in {
                "red": [], "blue": [(9, 9, BLUE)], "green": [(9, 9, GREEN)], "rim": [(4, 5, BLUE), (19, 10, GREEN)],
                "tinted": [(9, 9, (90, 0, 0))], "fold": fold, "green_fold": fold + [(12, 9, GREEN)],
                "blue_fold": fold + [(12, 9, BLUE)]}.items():
            path[key] = folder / f"{key}.png"
            write_png(path[key], square(changes, RED))
        fine = path["red"]
        expect(0, "0 cracks among 196 pixels", CRACK, fine, fine)
        expect(0, "0 cracks", CRACK, path["rim"], fine)
        expect(0, "0 cracks", CRACK, path["tinted"], fine)
        expect(1, "1 cracks", CRACK, path["blue"], fine, folder / "cracks.png")
        expect(1, "1 cracks", CRACK, path["green"], fine)
        expect(0, "0 cracks among 187 pixels", CRACK, path["blue"], path["blue"])
        expect(0, "0 cracks", CRACK, path["green_fold"], path["fold"])
        expect(1, "1 cracks", CRACK, path["blue_fold"], path["fold"])
        expect(2, "shows no surface", CRACK, fine, path["empty"])
        expect(2, "different sizes", CRACK, fine, path["small"])
        expect(2, "usage", CRACK, fine)
    print("\n".join(failures) if failures else "comparer and crack counter do as they should")
    return 1 if failures else 0


sys.exit(main())
