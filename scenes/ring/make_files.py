#!/usr/bin/env python3
"""Writes the meshes beside scene.pbrt, and setting.pbrt, which puts them together to a ring.

Run it after a change; it takes a second. The files are kept beside the scene, so rendering does not need it. The axis of
the ring is z, its head points along +x. Lengths in centimetres.
"""
import math
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1] / "tools" / "scenes"))
from mesh import bezier, brilliant, cross, tube, unit, write_ply  # noqa: E402

INNER = 0.86                   # radius of the finger
HEAD, CENTRE = 0.41, 1.47      # radius of the middle stone, and how far from the axis its girdle is
SIDE, SIDE_AT, SIDE_TURN = 0.215, 1.29, 30.5


def smooth(a, b, x):
    t = min(1, max(0, (x - a) / (b - a)))
    return t * t * (3 - 2 * t)


def band():
    """The band: almost flat inside, which draws a sharp caustic, domed outside, wider and thicker towards the head."""
    turns, around = 224, 48

    def point(turn, t):
        a = abs(math.remainder(turn, 2 * math.pi)) / math.pi  # 0 at the head, 1 opposite
        width = 0.13 + 0.03 * (1 - smooth(0.05, 0.75, a))
        thick = 0.075 + 0.025 * (1 - smooth(0.05, 0.6, a))
        c, s = math.cos(t), math.sin(t)
        r = INNER + thick + thick * math.copysign(abs(c) ** (0.62 if c > 0 else 0.22), c)
        return (r * math.cos(turn), r * math.sin(turn), width * math.copysign(abs(s) ** 0.7, s))
    vertices, faces = [], []
    for i in range(turns):
        u = 2 * math.pi * i / turns
        for j in range(around):
            v, e = 2 * math.pi * (j + 0.5) / around, 1e-3
            du = [p - q for p, q in zip(point(u + e, v), point(u - e, v))]
            dv = [p - q for p, q in zip(point(u, v + e), point(u, v - e))]
            vertices.append((*point(u, v), *unit(cross(du, dv))))
    for i in range(turns):
        for j in range(around):
            a, b = i * around + j, (i + 1) % turns * around + j
            c, d = i * around + (j + 1) % around, (i + 1) % turns * around + (j + 1) % around
            faces += [(a, b, d), (a, d, c)]
    write_ply(FOLDER / "band.ply", vertices, faces)


def claws(path, out, stone, foot, base, count, start, radius, spread=1.0):
    """Claws along +x around a stone whose girdle is at x = stone: from the band at x = base over the girdle."""
    tubes = []
    for k in range(count):
        t = math.radians(start + 360 / count * k)

        def at(x, r, t=t):
            return (x, r * math.cos(t) * spread, r * math.sin(t))
        rise = stone - base
        way = bezier([at(base, foot), at(base + 0.35 * rise, foot + 0.25 * (out - foot)), at(stone - 0.3 * rise, out + 1.2 * radius),
                      at(stone + 0.02, out + 0.75 * radius)], 16)
        way += bezier([way[-1], at(stone + 0.06 * out + 0.03, out + 0.65 * radius), at(stone + 0.15 * out + 0.03, out * 0.985),
                       at(stone + 0.19 * out + 0.03, out * 0.93)], 10)[1:]
        tubes.append(way)
    vertices, faces = [], []
    for way in tubes:
        rows = len(way)
        for i, p in enumerate(way):
            along = unit(tuple(a - b for a, b in zip(way[min(i + 1, rows - 1)], way[max(i - 1, 0)])))
            side = unit(cross(along, (0, -p[2], p[1])))
            other = cross(along, side)
            thin = radius * (1 - 0.15 * i / rows)
            for s in range(14):
                c, d = math.cos(2 * math.pi * s / 14), math.sin(2 * math.pi * s / 14)
                n = tuple(c * a + d * b for a, b in zip(side, other))
                vertices.append((*(q + thin * m for q, m in zip(p, n)), *n))
        first = len(vertices) - rows * 14
        for i in range(rows - 1):
            for s in range(14):
                a, b = first + i * 14 + s, first + i * 14 + (s + 1) % 14
                faces += [(a, b, b + 14), (a, b + 14, a + 14)]
        # A round tip.
        end, along = way[-1], unit(tuple(a - b for a, b in zip(way[-1], way[-2])))
        side = unit(cross(along, (0, -end[2], end[1])))
        other = cross(along, side)
        thin = radius * 0.86
        start_of_cap = len(vertices)
        for ring in range(6):
            lift = math.pi / 2 * ring / 5
            for s in range(14):
                c, d = math.cos(2 * math.pi * s / 14), math.sin(2 * math.pi * s / 14)
                n = tuple(math.cos(lift) * (c * a + d * b) + math.sin(lift) * e for a, b, e in zip(side, other, along))
                vertices.append((*(q + thin * m for q, m in zip(end, n)), *n))
        for ring in range(5):
            for s in range(14):
                a, b = start_of_cap + ring * 14 + s, start_of_cap + ring * 14 + (s + 1) % 14
                faces.append((a, b, b + 14))
                if ring < 4:
                    faces.append((a, b + 14, a + 14))
    write_ply(path, vertices, faces)


def hoop(path, radius, thick):
    """A torus around x."""
    way = [(0, radius * math.cos(2 * math.pi * i / 72), radius * math.sin(2 * math.pi * i / 72)) for i in range(73)]
    tube(path, way, thick, 14)


def setting():
    claws(FOLDER / "claws.ply", HEAD, CENTRE, 0.13, 0.98, 6, 30, 0.042)
    claws(FOLDER / "side_claws.ply", SIDE, SIDE_AT, 0.09, 0.97, 4, 45, 0.028)
    hoop(FOLDER / "hoop.ply", 1, 0.1)
    with open(FOLDER / "setting.pbrt", "w") as out:
        def line(text):
            out.write(text + "\n")

        def stone(turn, at, size, name, medium=None):
            line(f"AttributeBegin\n  Rotate {turn:g} 0 0 1\n  Translate {at:.4f} 0 0\n  Rotate 90 0 1 0\n  Rotate 11.25 0 0 1\n"
                 f"  Scale {size:g} {size:g} {size:g}")
            if medium:
                line(f'  MediumInterface "{medium}" ""')
            line(f'  NamedMaterial "{name}"\n  Shape "plymesh" "string filename" "brilliant.ply"\nAttributeEnd')
        line("# The ring, made by make_files.py.")
        line('NamedMaterial "gold"\nShape "plymesh" "string filename" "band.ply"\nShape "plymesh" "string filename" "claws.ply"')
        for at, r, thick in ((CENTRE - 0.16, HEAD * 0.66, 0.03), (CENTRE - 0.30, HEAD * 0.42, 0.03)):
            line(f'AttributeBegin Translate {at:.3f} 0 0 Scale {thick / 0.1:.3f} {r:.3f} {r:.3f} Shape "plymesh" "string filename" '
                 '"hoop.ply" AttributeEnd')
        for turn in (SIDE_TURN, -SIDE_TURN):
            line(f'AttributeBegin Rotate {turn:g} 0 0 1 Shape "plymesh" "string filename" "side_claws.ply"\n'
                 f'Translate {SIDE_AT - 0.09:.3f} 0 0 Scale 0.25 {SIDE * 0.62:.3f} {SIDE * 0.62:.3f} Shape "plymesh" "string filename" '
                 '"hoop.ply" AttributeEnd')
        stone(0, CENTRE, HEAD, "diamond")
        for turn in (SIDE_TURN, -SIDE_TURN):
            stone(turn, SIDE_AT, SIDE, "sapphire", "sapphire")
        for k in range(6):
            for sign in (1, -1):
                turn = sign * (46 + 9.3 * k)
                a = (46 + 9.3 * k) / 180
                top = INNER + 2 * (0.075 + 0.025 * (1 - smooth(0.05, 0.6, a)))
                stone(turn, top + 0.004, 0.074 - 0.002 * k, "diamond")
                for z in (1, -1):
                    line(f'AttributeBegin NamedMaterial "gold" Rotate {turn + sign * 4.65:g} 0 0 1 Translate {top - 0.008:.4f} 0 {z * 0.062:.4f} '
                         'Shape "sphere" "float radius" 0.024 AttributeEnd')


brilliant(FOLDER / "brilliant.ply", 34.5, 21, 41, 40.8, 42.2, 0.56, 0.31)
band()
setting()
