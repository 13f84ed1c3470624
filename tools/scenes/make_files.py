#!/usr/bin/env python3
"""Writes the meshes and pictures beside the scenes red-wine, wedding-rings, pool, cut-gems, billiards and fur-ball.

Run it after a change; it takes some seconds. The files are kept beside the scenes, so rendering does not need it.
z is up in all scenes. It uses only mesh.py.
"""
import math
import pathlib
import random
import struct

from mesh import bezier, brilliant, convex, lathe, tube, write_png

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"


def red_wine():
    """A glass on a stem in centimetres: glass to air, glass to wine (normals into the wine), wine to air."""
    folder, turns, level = SCENES / "red-wine", 112, 8.9
    bowl = bezier([(0.42, 5.5), (4.6, 5.7), (4.7, 10.5), (3.35, 15.5)], 96)
    inner = bezier([(0.0, 6.25), (4.35, 6.25), (4.45, 10.7), (3.2, 15.5)], 128)
    wet = [p for p in inner if p[1] < level]
    dry = [p for p in inner if p[1] > level]
    a, b = wet[-1], dry[0]
    edge = (a[0] + (b[0] - a[0]) * (level - a[1]) / (b[1] - a[1]), level)
    foot = [(0, 0.02), (3.3, 0.02)], [(3.3, 0.02), (3.42, 0.08), (3.42, 0.2), (3.3, 0.26)]
    stem = bezier([(3.3, 0.26), (1.2, 0.45), (0.38, 0.6), (0.36, 2.2)], 20)
    stem += bezier([(0.36, 2.2), (0.34, 3.6), (0.30, 4.9), (0.42, 5.5)], 10)[1:]
    rim = [(3.35, 15.5), (3.33, 15.55), (3.275, 15.58), (3.22, 15.55), (3.2, 15.5)]
    thin = [p for i, p in enumerate(bowl) if i % 3 == 0]
    lathe(folder / "stem.ply", [*foot, stem], 72)
    lathe(folder / "bowl.ply", [thin, rim, [p for i, p in enumerate(reversed(dry)) if i % 6 == 0] + [edge]], turns)
    lathe(folder / "wine_side.ply", [[edge] + [p for i, p in enumerate(reversed(wet)) if i % 2 == 1 or p[0] == 0]],
          turns)
    r = edge[0]
    lathe(folder / "wine_top.ply", [bezier([(r, level), (r - 0.03, level - 0.1), (r - 0.1, level - 0.12),
                                            (r - 0.3, level - 0.12)], 6) + [(0, level - 0.12)]], turns)


def page_height(x):
    return 1.5 * (1 - math.exp(-x / 1.3)) - 0.004 * x * x


def page_slope(x):
    return 1.5 / 1.3 * math.exp(-x / 1.3) - 0.008 * x


def wedding_rings():
    """A wide ring of radius 1.1 cm, a page that curves to the fold of its book, and its print."""
    folder = SCENES / "wedding-rings"

    def section(t):
        c, s = math.cos(t), math.sin(t)
        power = 0.55
        return (1.0 + 0.10 * math.copysign(abs(c) ** power, c), 0.40 * math.copysign(abs(s) ** power, s))
    profile = [section(2 * math.pi * (k + 0.5) / 40) for k in range(40)]
    lathe(folder / "ring.ply", [profile + profile[:1]], 128)

    # The page: from the fold at x = 0 to its edge, with the print from u = 0 to 1.
    columns = 48
    with open(folder / "page.pbrt", "w") as out:
        out.write('# The right page, made by tools/scenes/make_files.py.\nShape "trianglemesh"')
        points, normals, uv = [], [], []
        for j in (0, 1):
            for i in range(columns + 1):
                x = 13 * (i / columns) ** 2
                slope = page_slope(x)
                points.append("%.4f %g %.4f" % (x, -9 + 18 * j, page_height(x)))
                normals.append("%.4f 0 %.4f" % (-slope / math.hypot(1, slope), 1 / math.hypot(1, slope)))
                uv.append("%.4f %d" % (x / 13, j))
        indices = ["%d %d %d %d %d %d" % (a, a + 1, a + columns + 2, a, a + columns + 2, a + columns + 1)
                   for a in range(columns)]
        for name, numbers in (("point3 P", points), ("normal N", normals), ("point2 uv", uv),
                              ("integer indices", indices)):
            rows = ["  ".join(numbers[k:k + 6]) for k in range(0, len(numbers), 6)]
            out.write(f'\n"{name}" [' + "\n ".join(rows) + "]")
        out.write("\n")

    rng = random.Random(1834)
    width, height, line = 360, 480, 16
    ink = [[1.0] * width for _ in range(height)]
    for row in range(2, height // line - 2):
        x, last = 30, width - 30 - (rng.randrange(40, 200) if row % 7 == 0 else 0)
        x += 16 if row % 7 == 1 else 0
        while x < last:
            for _ in range(rng.randrange(2, 9)):
                if x + 6 > last:
                    break
                low, high = rng.choice(((6, 11), (6, 11), (6, 11), (3, 11), (6, 14)))
                kind = rng.randrange(4)
                for y in range(low, high + 1):
                    ink[row * line + y][x] = 0.12
                    if kind == 1:
                        ink[row * line + y][x + 3] = 0.2
                for d in range(4 if kind else 1):
                    if kind != 1:
                        ink[row * line + (6 if kind == 2 else 11)][x + d] = 0.25
                    if kind == 3 or kind == 1:
                        ink[row * line + 6][x + d] = 0.25
                x += 5
            x += 4
    write_png(folder / "print.png", width, height, 1, lambda i, j: (ink[j][i],))


def pool():
    """Rippled water, a little larger than its basin of 8 x 5 m, tiles, a ladder's rail, and a sky with its sun."""
    folder = SCENES / "pool"
    rng = random.Random(7)
    waves = []
    for _ in range(26):
        length, way = rng.uniform(0.35, 1.6), rng.uniform(0, 2 * math.pi)
        waves.append((2 * math.pi / length * math.cos(way), 2 * math.pi / length * math.sin(way),
                      rng.uniform(0, 2 * math.pi), 0.0042 * length))

    def water(u, v):
        x, y = 8.3 * u - 4.15, 5.3 * v - 0.15
        return (x, y, sum(a * math.sin(kx * x + ky * y + p) for kx, ky, p, a in waves))
    # Loop subdivision smooths this net of control points: a small file, and smooth refraction.
    columns, rows = 80, 50
    with open(folder / "water.pbrt", "w") as out:
        out.write('# The surface of the water, made by tools/scenes/make_files.py.\n')
        out.write('Shape "loopsubdiv" "integer levels" 2\n"point3 P" [')
        for j in range(rows + 1):
            out.write("\n" + " ".join("%.3g %.3g %.4f" % water(i / columns, j / rows) for i in range(columns + 1)))
        out.write(']\n"integer indices" [')
        for j in range(rows):
            out.write("\n" + " ".join("%d %d %d %d %d %d" % (a, a + columns + 2, a + 1, a, a + columns + 1,
                                                            a + columns + 2)
                                      for a in (j * (columns + 1) + i for i in range(columns))))
        out.write("]\n")

    tones = [[rng.random() for _ in range(16)] for _ in range(16)]

    def tile(i, j):
        if i % 16 < 2 or j % 16 < 2:
            return (0.80, 0.85, 0.84)
        t = tones[j // 16][i // 16]
        return (0.30 + 0.22 * t, 0.62 + 0.16 * t, 0.70 + 0.14 * t)
    write_png(folder / "tiles.png", 256, 256, 3, tile)

    rail = bezier([(0, 0.62, 0.0), (0, 0.62, 0.95), (0, -0.12, 0.95), (0, -0.14, 0.3)], 24)
    rail += [(0, -0.14, -0.2), (0, -0.14, -1.1)]
    tube(folder / "rail.ply", rail, 0.025, 16)

    # The sky, an equal-area octahedral map (Clarberg 2008) as in pbrt-v4: blue above, pale below, a sun of 2 degrees.
    size = 128
    sun = (-0.52, -0.30, 0.80)
    length = math.sqrt(sum(c * c for c in sun))
    with open(folder / "sky.pfm", "wb") as out:
        out.write(b"PF\n%d %d\n-1\n" % (size, size))
        for j in range(size - 1, -1, -1):
            for i in range(size):
                u, v = 2 * (i + 0.5) / size - 1, 2 * (j + 0.5) / size - 1
                signed = 1 - (abs(u) + abs(v))
                r = 1 - abs(signed)
                phi = ((abs(v) - abs(u)) / r + 1) * math.pi / 4 if r > 0 else math.pi / 4
                z = math.copysign(1 - r * r, signed)
                flat = r * math.sqrt(2 - r * r)
                d = (math.copysign(math.cos(phi), u) * flat, math.copysign(math.sin(phi), v) * flat, z)
                cosine = sum(a * b for a, b in zip(d, sun)) / length
                up = max(z, 0.0)
                colour = [a + (b - a) * math.sqrt(up) for a, b in ((0.75, 0.16), (0.85, 0.38), (0.95, 0.85))]
                if cosine > math.cos(math.radians(1.1)):
                    colour = [c + s for c, s in zip(colour, (5200, 4700, 3900))]
                out.write(struct.pack("<3f", *colour))


def step_cut(path, half_width, half_depth):
    """An emerald cut: an octagon with steps, its girdle at z = 0."""
    planes = [((0, 0, 1), 0.34)]
    corner = (half_width + half_depth - 0.45) / math.sqrt(2)
    outlines = [(0, half_width), (90, half_depth), (180, half_width), (270, half_depth)]
    outlines += [(45 + 90 * k, corner) for k in range(4)]
    for turn, reach in outlines:
        t = math.radians(turn)
        for angle, r, z in ((90, reach, 0), (48, reach, 0.03), (34, reach - 0.12, 0.16), (126, reach, -0.03),
                            (139, reach - 0.2, -0.25), (150, reach - 0.5, -0.55)):
            a = math.radians(angle)
            n = (math.sin(a) * math.cos(t), math.sin(a) * math.sin(t), math.cos(a))
            planes.append((n, math.sin(a) * r + math.cos(a) * z))
    convex(path, planes)


def cut_gems():
    folder = SCENES / "cut-gems"
    brilliant(folder / "brilliant.ply", 34.5, 21, 41, 40.8, 42.2, 0.56, 0.31)
    step_cut(folder / "emerald.ply", 1.15, 0.85)


DIGITS = {1: "00100 01100 00100 00100 00100 00100 01110", 2: "01110 10001 00001 00110 01000 10000 11111",
          3: "01110 10001 00001 00110 00001 10001 01110",
          8: "01110 10001 10001 01110 10001 10001 01110", 9: "01110 10001 10001 01111 00001 10001 01110"}


def billiards():
    """Pictures of the balls, by longitude and latitude: colour or a stripe, and a number in a white disc."""
    folder = SCENES / "billiards"
    colours = {1: (0.80, 0.52, 0.04), 2: (0.04, 0.10, 0.42), 3: (0.62, 0.04, 0.03),
               8: (0.015, 0.015, 0.018), 9: (0.80, 0.52, 0.04)}
    white = (0.86, 0.83, 0.74)
    for number, colour in colours.items():
        digit = DIGITS[number].split()

        def pixel(i, j, number=number, colour=colour, digit=digit):
            x, y = (i % 128) - 63.5, j - 63.5
            if math.hypot(x, y) < 19:
                column, row = math.floor(x / 3.2 + 2.5), math.floor(y / 3.2 + 3.5)
                ink = 0 <= column < 5 and 0 <= row < 7 and digit[row][column] == "1"
                return (0.03,) * 3 if ink else white
            return white if number > 8 and abs(y) > 32 else colour
        write_png(folder / f"ball{number}.png", 256, 128, 3,
                  lambda i, j, p=pixel: tuple(1.055 * c ** (1 / 2.4) - 0.055 for c in p(i, j)))


def fur_ball():
    """A patch of fur around the pole of a unit ball; the scene turns copies of it all over the ball."""
    rng = random.Random(11)
    patch = math.cos(math.radians(19))
    with open(SCENES / "fur-ball" / "fur.pbrt", "w") as out:
        out.write("# A patch of fur, made by tools/scenes/make_files.py.\n")
        for _ in range(150):
            z = rng.uniform(patch, 1)
            turn = rng.uniform(0, 2 * math.pi)
            r = math.sqrt(1 - z * z)
            root = (r * math.cos(turn), r * math.sin(turn), z)
            comb = (0.25 + rng.uniform(-0.22, 0.22), rng.uniform(-0.25, 0.25), -0.06)
            length = rng.uniform(0.26, 0.40)
            points = [tuple(c * (1 + length * t) + length * t * t * k for c, k in zip(root, comb))
                      for t in (-0.05, 0.33, 0.66, 1.0)]
            numbers = "  ".join("%.3f %.3f %.3f" % p for p in points)
            out.write(f'Shape "curve" "string type" "cylinder" "point3 P" [{numbers}] '
                      '"float width0" 0.014 "float width1" 0.002\n')


for make in (red_wine, wedding_rings, pool, cut_gems, billiards, fur_ball):
    (SCENES / make.__name__.replace("_", "-")).mkdir(exist_ok=True)
    make()
