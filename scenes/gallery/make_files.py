#!/usr/bin/env python3
"""Writes the files that the scenes of the gallery include: slide.png, diagram.png, sky.pfm, heights.pfm, quad.ply,
smoke.pbrt, colors.pbrt and tuft.pbrt. (puff.nvdb and measured.bsdf are those of tests/regression/features.)
"""
import math
import pathlib
import random
import struct
import zlib

FOLDER = pathlib.Path(__file__).resolve().parent


def write_png(name, size, pixel):
    rows = b""
    for y in range(size):
        rows += b"\0" + bytes(int(255 * min(1, max(0, c))) for x in range(size)
                              for c in pixel((x + 0.5) / size, (y + 0.5) / size))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    (FOLDER / name).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def write_pfm(name, size, channels, value):
    numbers = []
    for y in range(size - 1, -1, -1):
        for x in range(size):
            numbers += value((x + 0.5) / size, (y + 0.5) / size)
    (FOLDER / name).write_bytes(
        f"{'PF' if channels == 3 else 'Pf'}\n{size} {size}\n-1.0\n".encode()
        + struct.pack(f"<{len(numbers)}f", *numbers))


def slide(u, v):
    """A church window: petals around a centre, leaded."""
    x, y = 2 * u - 1, 2 * v - 1
    r, a = math.hypot(x, y), math.atan2(y, x) / math.tau + 0.5
    if r > 0.97:
        return 0, 0, 0
    ring = 0 if r < 0.22 else 1 if r < 0.62 else 2
    parts = (1, 8, 16)[ring]
    along = a * parts % 1
    lead = min(abs(r - 0.22), abs(r - 0.62), 0.97 - r)
    if parts > 1:
        lead = min(lead, min(along, 1 - along) * math.tau * r / parts)
    if lead < 0.025:
        return 0, 0, 0
    colors = ((1, 0.8, 0.2), (0.9, 0.15, 0.1), (0.1, 0.3, 0.9), (0.15, 0.7, 0.3), (0.95, 0.6, 0.1))
    return colors[0 if ring == 0 else 1 + (int(a * parts) * (1 if ring == 1 else 3) + ring) % 4]


def diagram(u, v):
    """A lamp with bright bands around its axis."""
    x, y = 2 * u - 1, 2 * v - 1
    r = abs(x) + abs(y)
    value = 1.0 if 0.35 < r < 0.5 or r > 1.25 else 0.25 if r < 0.2 else 0.06
    return value, value, value


def direction(u, v):
    """The direction that a point of the equal-area square stands for (Clarberg 2008)."""
    u, v = 2 * u - 1, 2 * v - 1
    distance = 1 - (abs(u) + abs(v))
    r = 1 - abs(distance)
    phi = (1 if r == 0 else (abs(v) - abs(u)) / r + 1) * math.pi / 4
    z = math.copysign(1 - r * r, distance)
    side = r * math.sqrt(max(0, 2 - r * r))
    return math.copysign(math.cos(phi), u) * side, math.copysign(math.sin(phi), v) * side, z


def sky(u, v):
    """A blue sky, z up, with a soft sun and a brown ground."""
    x, y, z = direction(u, v)
    if z < 0:
        return [0.16, 0.13, 0.1]
    sun = max(0, (x * 0.66 - y * 0.5 + z * 0.56) / 1.0005)
    glow = 30 * sun ** 200 + 0.6 * sun ** 8
    haze = (1 - z) ** 3
    return [0.15 + 0.5 * haze + glow, 0.3 + 0.4 * haze + 0.85 * glow, 0.75 + 0.2 * haze + 0.6 * glow]


def heights(u, v):
    x, y = 2 * u - 1, 2 * v - 1
    r = math.hypot(x, y)
    return [math.cos(18 * r) * math.exp(-2.5 * r * r)]


def grid(count, value):
    return [value((x + 0.5) / count, (y + 0.5) / count, (z + 0.5) / count)
            for z in range(count) for y in range(count) for x in range(count)]


def smoke(x, y, z):
    """A column that twists and widens."""
    cx, cz = 0.5 + 0.18 * math.sin(7 * y), 0.5 + 0.18 * math.cos(7 * y)
    r = math.hypot(x - cx, z - cz) / (0.14 + 0.12 * y)
    return max(0.0, 1 - r * r)


def write_grid(name, lines):
    (FOLDER / name).write_text("\n".join(lines) + "\n")


def main():
    write_png("slide.png", 256, slide)
    write_png("diagram.png", 128, diagram)
    write_pfm("sky.pfm", 64, 3, sky)
    write_pfm("heights.pfm", 128, 1, heights)
    (FOLDER / "quad.ply").write_text("""ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property float u
property float v
element face 1
property list uchar int vertex_indices
end_header
-1 -1 0 0 0
1 -1 0 1 0
1 1 0 1 1
-1 1 0 0 1
4 0 1 2 3
""")
    n = 16
    write_grid("smoke.pbrt", [
        'MakeNamedMedium "smoke" "string type" "uniformgrid" "point3 p0" [-1 -1 -1] "point3 p1" [1 1 1]',
        '  "rgb sigma_a" [1 1 1] "rgb sigma_s" [5 5 5] "float g" 0.3',
        f'  "integer nx" {n} "integer ny" {n} "integer nz" {n} "float density" [',
        " ".join(f"{d:.2g}" for d in grid(n, smoke)), "  ]"])
    n = 8

    def absorption(x, y, z):
        return (1.6 * (1 - x), 1.6 * (1 - y), 1.6 * z)
    write_grid("colors.pbrt", [
        'MakeNamedMedium "colors" "string type" "rgbgrid" "point3 p0" [-1 -1 -1] "point3 p1" [1 1 1]',
        f'  "integer nx" {n} "integer ny" {n} "integer nz" {n}', '  "rgb sigma_a" [',
        " ".join(f"{c:.3g}" for cell in grid(n, absorption) for c in cell), "  ]",
        '  "rgb sigma_s" [', " ".join(["0.4 0.4 0.4"] * n ** 3), "  ]"])
    # A tuft of hairs that grow up from a patch and bend over.
    random.seed(3)
    lines = []
    for _ in range(220):
        a, r = random.uniform(0, math.tau), 0.16 * math.sqrt(random.random())
        x, z = r * math.cos(a), r * math.sin(a)
        bend, turn = random.uniform(0.25, 0.45), random.uniform(-0.08, 0.08)
        p = [(x, 0, z), (x * 1.2, 0.35, z * 1.2 + turn), (x * 1.5 + bend * 0.4, 0.75, z * 1.5 + turn),
             (x * 1.7 + bend, 0.8 + random.uniform(-0.1, 0.1), z * 1.9 - turn)]
        lines.append('Shape "curve" "float width0" 0.014 "float width1" 0.005 "point3 P" ['
                     + "  ".join("%.3f %.3f %.3f" % q for q in p) + "]")
    write_grid("tuft.pbrt", lines)


main()
