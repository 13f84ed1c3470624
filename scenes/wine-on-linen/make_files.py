#!/usr/bin/env python3
"""Writes the meshes and pictures beside scene.pbrt: the glass and its wine, the linen, its weave, and the garden.

Run it after a change; it takes some seconds. The files are kept beside the scene, so rendering does not need it.
Lengths in centimetres, z up.
"""
import math
import pathlib
import random
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1] / "tools" / "scenes"))
from mesh import bezier, lathe, write_ply, write_png  # noqa: E402

GLASS = (-6.0, 0.0)  # where the glass stands
GRAPES = (8.5, 9.5)
CORK = (10.0, -3.0)


def smooth(a, b, x):
    t = min(1, max(0, (x - a) / (b - a)))
    return t * t * (3 - 2 * t)


def glass():
    """A large glass on a stem, by where it touches what: glass to air, glass to wine (normals into the wine), wine to air."""
    turns, level = 144, 6.7
    outer = bezier([(0.40, 2.9), (6.8, 3.6), (5.2, 8.0), (3.7, 14.6)], 120)
    inner = bezier([(0.0, 3.5), (6.5, 3.7), (5.1, 8.0), (3.58, 14.6)], 160)
    wet = [p for p in inner if p[1] < level]
    dry = [p for p in inner if p[1] > level]
    a, b = wet[-1], dry[0]
    edge = (a[0] + (b[0] - a[0]) * (level - a[1]) / (b[1] - a[1]), level)
    foot = [(0, 0.02), (3.5, 0.02)], [(3.5, 0.02), (3.6, 0.07), (3.6, 0.15), (3.5, 0.2)]
    stem = bezier([(3.5, 0.2), (1.3, 0.42), (0.40, 0.5), (0.36, 1.5)], 24)
    stem += bezier([(0.36, 1.5), (0.33, 2.2), (0.30, 2.6), (0.40, 2.9)], 12)[1:]
    rim = [(3.7, 14.6), (3.69, 14.65), (3.64, 14.68), (3.59, 14.65), (3.58, 14.6)]
    lathe(FOLDER / "stem.ply", [*foot, stem], 72)
    lathe(FOLDER / "bowl.ply", [outer[::3], rim, dry[::-1][::4] + [edge]], turns)
    lathe(FOLDER / "wine_side.ply", [[edge] + [p for i, p in enumerate(reversed(wet)) if i % 2 == 1 or p[0] == 0]], turns)
    r = edge[0]
    lathe(FOLDER / "wine_top.ply", [bezier([(r, level), (r - 0.03, level - 0.1), (r - 0.1, level - 0.14),
                                            (r - 0.35, level - 0.14)], 8) + [(0, level - 0.14)]], turns)


def linen():
    """The cloth: creases of its folding, soft waves, a gathered fold, and a fall over the far edge of the table."""
    rng = random.Random(5)
    waves = []
    for _ in range(14):
        length, way = rng.uniform(7, 26), rng.uniform(0, 2 * math.pi)
        k = 2 * math.pi / length
        waves.append((k * math.cos(way), k * math.sin(way), rng.uniform(0, 2 * math.pi), 0.0026 * length))

    def crease(d):
        """A sharp ridge that ironing left: a sunken flank on one side."""
        return 0.16 * math.exp(-abs(d) / 0.55) - 0.10 * math.exp(-((d - 0.3) / 2.6) ** 2)

    def height(x, y):
        h = sum(a * math.sin(p + kx * x + ky * y) for kx, ky, p, a in waves)
        h += crease(x - 3.5 + 0.25 * math.sin(y / 9)) + crease(y + 7.5 + 0.2 * math.sin(x / 7 + 1))
        # Long folds that run in from the front right corner.
        for turn, offset, size, width, reach in ((0.50, -4.0, 1.3, 1.5, 30), (0.30, 0.5, 0.8, 1.1, 22), (0.75, -8.5, 1.0, 1.5, 26)):
            c, s = math.cos(turn), math.sin(turn)
            along, across = (x - 14) * c - (y + 13) * s, (x - 14) * s + (y + 13) * c - offset
            across += 0.7 * math.sin(along / 6 + offset)
            h += size * math.exp(-(across / width) ** 2) * smooth(-reach * 0.45, reach * 0.3, along)
        for (a, b), r in ((GLASS, 3.2), (GRAPES, 4.5), (CORK, 2.5)):
            h *= smooth(r, r + 5, math.hypot(x - a, y - b))
        return h

    far, bend = 24.0, 1.6

    def point(u, s):
        """s is the way along the cloth from front to back, over the edge and down."""
        if s <= far:
            return (u, s, height(u, s))
        t = (s - far) / bend
        sway = 0.0
        if t < math.pi / 2:
            y, z = far + bend * math.sin(t), -bend * (1 - math.cos(t))
        else:
            y, z = far + bend, -bend - (s - far - bend * math.pi / 2)
            sway = smooth(0, 12, -z) * 1.3 * math.sin(u / 3.1 + math.sin(u / 7))
        return (u, y + sway, z + height(u, far) * (1 - smooth(0, 4, s - far)))

    us = [-52 + 104 * i / 200 for i in range(201)]
    ss = [-46 + 70 * j / 150 for j in range(151)] + [far + 0.32 * j for j in range(1, 10)] + [far + 3 + 3 * j for j in range(1, 6)]
    vertices, faces = [], []
    for s in ss:
        for u in us:
            e = 0.05
            p, q, r, t = point(u - e, s), point(u + e, s), point(u, s - e), point(u, s + e)
            a, b = [m - n for m, n in zip(q, p)], [m - n for m, n in zip(t, r)]
            n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
            size = math.sqrt(sum(c * c for c in n))
            vertices.append((*point(u, s), *(c / size for c in n)))
    w = len(us)
    for j in range(len(ss) - 1):
        for i in range(w - 1):
            k = j * w + i
            faces += [(k, k + 1, k + w + 1), (k, k + w + 1, k + w)]
    write_ply(FOLDER / "linen.ply", vertices, faces)


def grapes():
    """A small bunch: balls that sink to the cloth and push each other apart."""
    rng = random.Random(12)
    balls = [[rng.gauss(0, 2.6), rng.gauss(0, 1.5), rng.uniform(1, 5), rng.uniform(0.82, 1.02)] for _ in range(26)]
    for step in range(400):
        for b in balls:
            b[0], b[1], b[2] = b[0] * 0.995, b[1] * 0.99, b[2] - 0.03
        for _ in range(4):
            for i, p in enumerate(balls):
                for q in balls[:i]:
                    d = [m - n for m, n in zip(p[:3], q[:3])]
                    size, apart = math.sqrt(sum(c * c for c in d)), p[3] + q[3]
                    if size < apart:
                        for k in range(3):
                            push = 0.5 * (apart - size) * d[k] / size
                            p[k] += push
                            q[k] -= push
                p[2] = max(p[2], p[3])
    with open(FOLDER / "grapes.pbrt", "w") as out:
        out.write("# A bunch of grapes, made by make_files.py.\n")
        for x, y, z, r in balls:
            out.write(f'AttributeBegin Translate {x:.3f} {y:.3f} {z:.3f} Shape "sphere" "float radius" {r:.3f} AttributeEnd\n')


def cork():
    lathe(FOLDER / "cork.ply", [[(0, -2.2), (1.05, -2.2)], [(1.05, -2.2), (1.15, -2.1), (1.17, -1), (1.17, 1), (1.15, 2.1), (1.05, 2.2)],
                                [(1.05, 2.2), (0, 2.2)]], 64)


def weave():
    """Plain weave with slubs, as heights: 48 x 48 threads, each 8 pixels wide."""
    rng, threads, step = random.Random(3), 48, 8
    size = threads * step

    def strand():
        knots = [rng.random() for _ in range(8)]
        base, slub = rng.uniform(-0.10, 0.10), rng.random() < 0.16
        row = []
        for k in range(size):
            f = k / size * 8
            a, b = knots[int(f)], knots[(int(f) + 1) % 8]
            row.append(base + (0.22 if slub else 0.07) * (a + (b - a) * (f % 1) - 0.5))
        return row
    warp, weft = [strand() for _ in range(threads)], [strand() for _ in range(threads)]

    def pixel(i, j):
        a, b = i // step, j // step
        x, y = (i % step + 0.5) / step * 2 - 1, (j % step + 0.5) / step * 2 - 1
        over = math.cos(math.pi / 2 * x) ** 0.6 * (0.72 + 0.28 * math.cos(math.pi / 2 * y)) + warp[a][j]
        under = math.cos(math.pi / 2 * y) ** 0.6 * (0.72 + 0.28 * math.cos(math.pi / 2 * x)) + weft[b][i]
        top, low = (over, under) if (a + b) % 2 else (under, over)
        return (max(0.05, max(top * 0.9, low * 0.55)),)
    write_png(FOLDER / "weave.png", size, size, 1, pixel)


def garden():
    """The surroundings by longitude and latitude: evening sky, hedges, a meadow, and light out of focus between leaves."""
    rng, width, height = random.Random(19), 1024, 512
    sun = math.atan2(0.86, -0.5)
    picture = [[None] * width for _ in range(height)]
    bumps = [(rng.randrange(3, 40), rng.uniform(0, 6.3)) for _ in range(14)]
    for j in range(height):
        up = 90 - 180 * (j + 0.5) / height
        for i in range(width):
            phi = 2 * math.pi * (i + 0.5) / width
            glow = math.exp(-((math.remainder(phi - sun, 2 * math.pi)) / 0.9) ** 2)
            top = 7 + sum(3.2 / math.sqrt(n) * math.sin(n * phi + p) for n, p in bumps) * 1.3
            sky = [a + (b - a) * smooth(0, 60, up) for a, b in ((0.62, 0.16), (0.52, 0.27), (0.44, 0.46))]
            warm = glow * math.exp(-max(0, up) / 22)
            sky = [c + warm * w for c, w in zip(sky, (0.75, 0.42, 0.12))]
            leaf = 0.5 + 0.5 * math.sin(9 * phi + 3 * math.sin(up / 4) + bumps[3][1])
            hedge = [c * (0.45 + 0.8 * leaf) * (1 + 2.6 * glow) for c in (0.020, 0.026, 0.010)]
            ground = [c * (1 + 1.2 * glow) for c in (0.040, 0.034, 0.014)]
            low = [a + (b - a) * smooth(-9, -30, up) for a, b in zip(hedge, ground)] if up < -9 else hedge
            t = smooth(top - 2.5, top + 2.5, up)
            picture[j][i] = [a + (b - a) * t for a, b in zip(low, sky)]
    # Discs of light, as a lens draws leaves and water in the sun.
    for _ in range(420):
        phi, up, r = rng.uniform(0, 2 * math.pi), rng.uniform(-13, 9), rng.uniform(0.5, 1.3)
        glow = math.exp(-((math.remainder(phi - sun, 2 * math.pi)) / 1.0) ** 2)
        strength = rng.uniform(0.05, 0.3) ** 1.2 * (0.3 + 2.6 * glow)
        tint = rng.choice(((1.0, 0.72, 0.28), (1.0, 0.82, 0.45), (0.62, 0.75, 0.22), (0.9, 0.5, 0.2)))
        ci, cj, pr = phi / (2 * math.pi) * width, (90 - up) / 180 * height, r / 180 * height
        for j in range(int(cj - pr - 2), int(cj + pr + 3)):
            for i in range(int(ci - pr - 2), int(ci + pr + 3)):
                d = math.hypot(i + 0.5 - ci, j + 0.5 - cj)
                cover = 1 - smooth(pr - 0.8, pr + 0.8, d)
                for k in range(3):
                    picture[j][i % width][k] += cover * strength * tint[k] * (0.8 + 0.2 * smooth(0.4, 1, d / pr))

    def pixel(i, j):
        return tuple(1.055 * c ** (1 / 2.4) - 0.055 if c > 0.0031 else 12.92 * c for c in (min(1, c) for c in picture[j][i]))
    write_png(FOLDER / "garden.png", width, height, 3, pixel)


for make in (glass, linen, grapes, cork, weave, garden):
    make()
