#!/usr/bin/env python3
"""Writes the meshes and pictures beside scene.pbrt: water, mosaic, slabs, palm, cypress, ladder, furniture, and the sky.

Run it after a change; it takes some seconds. The files are kept beside the scene, so rendering does not need it.
Lengths in metres, z up.
"""
import math
import pathlib
import random
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1] / "tools" / "scenes"))
from mesh import bezier, tube, unit, write_ply, write_png  # noqa: E402


def srgb(colour):
    return tuple(1.055 * c ** (1 / 2.4) - 0.055 if c > 0.0031 else 12.92 * c for c in (min(1, max(0, c)) for c in colour))


def water():
    """A calm surface, a little larger than the basin of 9 x 5 m. Its ripples focus some metres above."""
    rng = random.Random(23)
    waves = []
    for _ in range(44):
        length, way = 0.26 * 3.2 ** rng.random(), rng.gauss(0.7, 0.9)
        waves.append((2 * math.pi / length * math.cos(way), 2 * math.pi / length * math.sin(way),
                      rng.uniform(0, 2 * math.pi), 0.0020 * length))
    columns, rows = 200, 113
    vertices, faces = [], []
    for j in range(rows + 1):
        for i in range(columns + 1):
            x, y = -5.1 + 9.2 * i / columns, -0.1 + 5.2 * j / rows
            z = sum(a * math.sin(kx * x + ky * y + p) for kx, ky, p, a in waves)
            sx = sum(a * kx * math.cos(kx * x + ky * y + p) for kx, ky, p, a in waves)
            sy = sum(a * ky * math.cos(kx * x + ky * y + p) for kx, ky, p, a in waves)
            vertices.append((x, y, z, *unit((-sx, -sy, 1))))
    for j in range(rows):
        for i in range(columns):
            k = j * (columns + 1) + i
            faces += [(k, k + 1, k + columns + 2), (k, k + columns + 2, k + columns + 1)]
    write_ply(FOLDER / "water.ply", vertices, faces)


def pictures():
    rng = random.Random(2)
    tones = [[rng.random() for _ in range(20)] for _ in range(20)]

    def tile(i, j):
        if i % 13 < 1 or j % 13 < 1:
            return srgb((0.55, 0.60, 0.60))
        t = tones[j // 13 % 20][i // 13 % 20]
        return srgb((0.36 + 0.24 * t, 0.60 + 0.16 * t, 0.66 + 0.14 * t))
    write_png(FOLDER / "tiles.png", 260, 260, 3, tile)

    shade = [[rng.uniform(0.86, 1) for _ in range(4)] for _ in range(4)]

    def slab(i, j):
        row = j // 64
        x = (i + 32 * (row % 2)) % 256
        if j % 64 < 1 or x % 64 < 1:
            return srgb((0.11, 0.10, 0.09))
        return srgb(tuple(c * shade[row][x // 64] for c in (0.44, 0.40, 0.35)))
    write_png(FOLDER / "slabs.png", 256, 256, 3, slab)

    # The sky after dusk by longitude and latitude: blue above, a last glow low behind the house.
    width, height = 512, 256

    def sky(i, j):
        up = max(0, 1 - 2 * (j + 0.5) / height)
        phi = 2 * math.pi * (i + 0.5) / width
        glow = (0.35 + 0.65 * math.exp(-(math.remainder(phi - 2.2, 2 * math.pi) / 1.1) ** 2)) * math.exp(-up / 0.16)
        colour = [a + glow * b for a, b in zip((0.030, 0.075, 0.22), (0.34, 0.22, 0.20))]
        if j > height // 2:
            colour = (0.01, 0.01, 0.01)
        return srgb(colour)
    write_png(FOLDER / "sky.png", width, height, 3, sky)


def palm():
    rng = random.Random(8)
    trunk = bezier([(0, 0, -0.1), (0.05, 0, 1.6), (0.30, 0.1, 2.9), (0.42, 0.12, 4.3)], 60)
    vertices, faces = [], []
    for i, p in enumerate(trunk):
        r = 0.17 - 0.05 * i / 60 + (0.018 if i % 2 else 0) + 0.10 * max(0, 1 - i / 5)
        for s in range(16):
            c, d = math.cos(math.pi * s / 8), math.sin(math.pi * s / 8)
            vertices.append((p[0] + r * c, p[1] + r * d, p[2]))
    for i in range(60):
        for s in range(16):
            a, b = i * 16 + s, i * 16 + (s + 1) % 16
            faces += [(a, b, b + 16), (a, b + 16, a + 16)]
    write_ply(FOLDER / "palm_trunk.ply", vertices, faces)
    vertices, faces = [], []
    top = trunk[-1]
    for k in range(34):
        turn = k * 2.399963 + rng.uniform(-0.2, 0.2)
        lift = math.radians(78 - 105 * (k / 33) ** 0.9 + rng.uniform(-6, 6))
        length = rng.uniform(1.7, 2.1)
        c, s = math.cos(turn), math.sin(turn)
        angle, r, z = lift, 0.0, 0.0
        rib = []
        steps = 40
        for i in range(steps + 1):
            rib.append((top[0] + r * c, top[1] + r * s, top[2] + z, angle))
            r += length / steps * math.cos(angle)
            z += length / steps * math.sin(angle)
            angle -= (1.25 - 0.3 * math.sin(lift)) / steps * (0.5 + i / steps)
        for i in range(4, steps):
            x, y, z, angle = rib[i]
            t = i / steps
            size = 0.52 * math.sin(math.pi * (0.12 + 0.85 * t)) ** 0.8
            along = (math.cos(angle) * c, math.cos(angle) * s, math.sin(angle))
            for side in (1, -1):
                out = (-s * side, c * side, 0)
                way = unit(tuple(0.75 * o + 0.62 * a + (0, 0, -0.35 - 0.3 * rng.random())[n]
                                 for n, (o, a) in enumerate(zip(out, along))))
                tip = tuple(p + size * w for p, w in zip((x, y, z), way))
                mid = tuple(p + 0.5 * size * w for p, w in zip((x, y, z + 0.03), way))
                w = 0.016
                v = len(vertices)
                vertices += [(x - w * along[0], y - w * along[1], z - w * along[2]), (x + w * along[0], y + w * along[1], z + w * along[2]),
                             (mid[0] + w * along[0], mid[1] + w * along[1], mid[2]), (mid[0] - w * along[0], mid[1] - w * along[1], mid[2]), tip]
                faces += [(v, v + 1, v + 2), (v, v + 2, v + 3), (v + 3, v + 2, v + 4)]
    write_ply(FOLDER / "palm_leaves.ply", vertices, faces)


def cypress():
    """A slender cone of 7000 small leaves that point up and outwards."""
    rng = random.Random(4)
    vertices, faces = [], []
    for _ in range(7000):
        h = rng.random() ** 0.8
        z = 0.15 + 5.2 * h
        turn = rng.uniform(0, 2 * math.pi)
        r = (0.62 * (1 - h) ** 0.6 * min(1, 0.45 + 3 * h)) * (1 + 0.16 * math.sin(3 * turn + 9 * h) + 0.10 * math.sin(7 * turn - 23 * h))
        r *= rng.uniform(0.72, 1.06)
        c, s = math.cos(turn), math.sin(turn)
        way = unit((0.5 * c + rng.gauss(0, 0.3), 0.5 * s + rng.gauss(0, 0.3), 1.0))
        side = unit((-s + rng.gauss(0, 0.5), c + rng.gauss(0, 0.5), rng.gauss(0, 0.3)))
        size = rng.uniform(0.10, 0.22)
        p = (r * c, r * s, z)
        v = len(vertices)
        vertices += [tuple(a - 0.03 * b for a, b in zip(p, side)), tuple(a + 0.03 * b for a, b in zip(p, side)),
                     tuple(a + size * b for a, b in zip(p, way))]
        faces.append((v, v + 1, v + 2))
    write_ply(FOLDER / "cypress.ply", vertices, faces)


def rail():
    way = bezier([(0, 0.55, 0.0), (0, 0.55, 0.95), (0, -0.12, 0.95), (0, -0.14, 0.3)], 24)
    tube(FOLDER / "rail.ply", way + [(0, -0.14, -0.2), (0, -0.14, -1.0)], 0.022, 16)


def box(out, x0, x1, y0, y1, z0, z1):
    p = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
    f = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]
    out.write('Shape "trianglemesh" "point3 P" [' + "  ".join("%g %g %g" % q for q in p) + '] "integer indices" ['
              + "  ".join("%d %d %d" % q for q in f) + "]\n")


def lounger():
    """A deck chair 1.95 m long, its foot towards -y."""
    with open(FOLDER / "lounger.pbrt", "w") as out:
        out.write("# A deck chair, made by make_files.py.\nNamedMaterial \"teak\"\n")
        for x in (-0.31, 0.27):
            box(out, x, x + 0.04, -1.0, 0.95, 0.24, 0.31)
            for y in (-0.9, 0.25, 0.85):
                box(out, x, x + 0.04, y, y + 0.06, 0, 0.24)
        out.write('NamedMaterial "cushion"\n')
        box(out, -0.29, 0.29, -1.0, 0.28, 0.31, 0.39)
        out.write("AttributeBegin Translate 0 0.28 0.33 Rotate 42 1 0 0\n")
        box(out, -0.29, 0.29, 0, 0.75, -0.02, 0.06)
        out.write("AttributeEnd\n")


for make in (water, pictures, palm, cypress, rail, lounger):
    make()
