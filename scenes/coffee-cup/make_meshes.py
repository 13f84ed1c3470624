#!/usr/bin/env python3
"""Writes the meshes of the coffee cup scene: binary PLY, with normals where smooth.

Run it in this folder after a change; the meshes are kept beside the scene, so nobody has to run it to
render. A profile is a list of pieces, a piece a list of (radius, z, normal radius, normal z); normals
are smooth within a piece. Lengths in centimetres, z up.
"""
import math
import struct


# Pieces of profiles. Their normals point to the right of the way ------------------------------------

def line(a, b):
    dr, dz = b[0] - a[0], b[1] - a[1]
    length = math.hypot(dr, dz)
    return [(*p, dz / length, -dr / length) for p in (a, b)]


def arc(centre, radius, start, end, steps):
    """Part of a circle, from `start` to `end` degrees."""
    sign = 1 if end > start else -1
    points = []
    for i in range(steps + 1):
        angle = math.radians(start + (end - start) * i / steps)
        c, s = math.cos(angle), math.sin(angle)
        points.append((centre[0] + radius * c, centre[1] + radius * s, sign * c, sign * s))
    return points


def bezier(p, steps):
    """A cubic curve through the first and the last of four control points."""
    points = []
    for i in range(steps + 1):
        t = i / steps
        u = 1 - t
        weights = (u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t)
        slopes = (-u * u, u * (u - 2 * t), t * (2 * u - t), t * t)
        r, z = (sum(w * q[k] for w, q in zip(weights, p)) for k in (0, 1))
        dr, dz = (sum(w * q[k] for w, q in zip(slopes, p)) for k in (0, 1))
        length = math.hypot(dr, dz)
        points.append((r, z, dz / length, -dr / length))
    return points


def end(piece):
    return piece[-1][:2]


# Meshes ---------------------------------------------------------------------------------------------

def write_ply(path, vertices, faces):
    """Vertices are (x, y, z) or (x, y, z, nx, ny, nz), faces triangles."""
    properties = ("x", "y", "z", "nx", "ny", "nz")[:len(vertices[0])]
    with open(path, "wb") as out:
        out.write((
            "ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(vertices)}\n"
            + "".join(f"property float {p}\n" for p in properties)
            + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
        ).encode())
        for v in vertices:
            out.write(struct.pack(f"<{len(v)}f", *v))
        for f in faces:
            out.write(struct.pack("<B3i", 3, *f))


def lathe(path, pieces, segments):
    """Turns the pieces around z. A point on the axis is a single vertex."""
    turns = [(math.cos(2 * math.pi * s / segments), math.sin(2 * math.pi * s / segments))
             for s in range(segments)]
    vertices, faces = [], []
    for piece in pieces:
        rings = []
        for r, z, nr, nz in piece:
            rings.append((len(vertices), 1 if r == 0 else segments))
            for c, s in turns[:rings[-1][1]]:
                vertices.append((r * c, r * s, z, nr * c, nr * s, nz))
        for (low, low_count), (high, high_count) in zip(rings, rings[1:]):
            for s in range(segments):
                t = (s + 1) % segments
                a, b = low + s % low_count, low + t % low_count
                e, f = high + t % high_count, high + s % high_count
                if a != b:
                    faces.append((a, b, e))
                if e != f:
                    faces.append((a, e, f))
    write_ply(path, vertices, faces)


def sweep(path, way, half_width, half_height, segments):
    """A tube of elliptic section along a piece in the plane y = 0, open at its ends."""
    vertices, faces = [], []
    for x, z, ux, uz in way:
        for s in range(segments):
            angle = 2 * math.pi * s / segments
            c, d = math.cos(angle), math.sin(angle)
            across, along = c / half_height, d / half_width
            n = math.hypot(across, along)
            vertices.append((x + half_height * c * ux, half_width * d, z + half_height * c * uz,
                             across / n * ux, along / n, across / n * uz))
    for i in range(len(way) - 1):
        for s in range(segments):
            t = (s + 1) % segments
            a, b = i * segments + s, i * segments + t
            faces += [(a, b, b + segments), (a, b + segments, a + segments)]
    write_ply(path, vertices, faces)


def cut_stone(path, rings):
    """A convex stone of flat facets: hexagons (radius, z), each turned by 30 degrees to the last."""
    vertices, faces = [], []
    for i, (r, z) in enumerate(rings):
        for k in range(6):
            angle = math.radians(60 * k + 30 * (i % 2))
            vertices.append((r * math.cos(angle), r * math.sin(angle), z))
    for i in range(len(rings) - 1):
        for k in range(6):
            low, above = 6 * i + k, 6 * i + 6 + k
            next_low, next_above = 6 * i + (k + 1) % 6, 6 * i + 6 + (k + 1) % 6
            if i % 2 == 0:
                faces += [(low, next_low, above), (next_low, next_above, above)]
            else:
                faces += [(low, next_low, next_above), (low, next_above, above)]
    last = 6 * (len(rings) - 1)
    for k in range(1, 5):
        faces += [(0, k + 1, k), (last, last + k, last + k + 1)]
    write_ply(path, vertices, faces)


# The cup: foot, belly and wall of the outside, over the rim, straight down the inside, round bottom.
# The inside is a plain cylinder as far as light falls on it: what it focuses is a nephroid.
INSIDE, COFFEE = 3.6, 4.0
lathe("cup.ply", [
    line((0, 0.3), (1.95, 0.3)),
    line((1.95, 0.3), (1.95, 0.1)),
    arc((2.05, 0.1), 0.1, 180, 360, 6),
    bezier([(2.15, 0.1), (2.15, 0.55), (3.8, 0.6), (3.8, 2.4)], 20),
    line((3.8, 2.4), (3.8, 5.5)),
    arc((3.7, 5.5), 0.1, 0, 180, 12),
    line((INSIDE, 5.5), (INSIDE, 2.4)),
    bezier([(INSIDE, 2.4), (3.6, 1.0), (2.4, 0.5), (0, 0.5)], 8),
], 240)
sweep("handle.ply", bezier([(3.7, 2.1), (6.9, 2.0), (6.6, 5.6), (3.7, 4.9)], 32), 0.5, 0.15, 28)

# The coffee: it climbs the wall by a millimetre and ends inside the metal.
lathe("coffee.ply", [
    bezier([(INSIDE + 0.02, COFFEE + 0.12), (3.57, COFFEE + 0.03), (3.48, COFFEE), (3.25, COFFEE)], 10)
    + [(0, COFFEE, 0, 1)],
], 240)

# The saucer: a foot, a shallow slope, a round edge, the same slope inside, a flat well for the cup.
slope = bezier([(2.7, 0.2), (4.0, 0.25), (5.2, 0.6), (6.0, 1.0)], 12)
r, z, nr, nz = slope[-1]
edge = math.degrees(math.atan2(nz, nr))
edge = arc((r - 0.12 * nr, z - 0.12 * nz), 0.12, edge, edge + 180, 10)
r, z = end(edge)
lathe("saucer.ply", [
    line((0, 0.15), (2.5, 0.15)),
    line((2.5, 0.15), (2.5, 0.1)),
    arc((2.6, 0.1), 0.1, 180, 360, 6),
    line((2.7, 0.1), (2.7, 0.2)),
    slope,
    edge,
    bezier([(r, z), (r - 0.8, z - 0.4), (3.9, 0.4), (2.6, 0.4)], 12) + [(0, 0.4, 0, 1)],
], 160)

# A tumbler and the water in it are three surfaces: glass to air, glass to water, water to air. They
# meet in one ring of vertices, where the water ends at the wall.
HEIGHT, WATER, THICKNESS, LEAN, TURNS = 7.3, 5.2, 0.18, 2.4, 320
tan_lean, cos_lean = math.tan(math.radians(LEAN)), math.cos(math.radians(LEAN))
foot = arc((1.9, 0.32), 0.3, -90, -LEAN, 8)
top = (end(foot)[0] + (HEIGHT - end(foot)[1]) * tan_lean, HEIGHT)
rim = arc((top[0] - THICKNESS / 2 * cos_lean, top[1] + THICKNESS / 2 * math.sin(math.radians(LEAN))),
          THICKNESS / 2, -LEAN, 180 - LEAN, 10)


def inner(z):
    """The point of the glass's inner wall at height z."""
    return end(rim)[0] + (z - end(rim)[1]) * tan_lean, z


WET, BASE, ROUND = inner(WATER + 0.12), 0.8, 0.5
bottom = arc((inner(BASE + ROUND)[0] - ROUND / cos_lean, BASE + ROUND), ROUND, -LEAN, -90, 8)
lathe("tumbler_outside.ply", [
    line((0, 0.02), (1.9, 0.02)),
    foot,
    line(end(foot), top),
    rim,
    line(end(rim), WET),
], TURNS)
lathe("tumbler_water_side.ply", [
    line(WET, bottom[0][:2]),
    bottom,
    line(end(bottom), (0, BASE)),
], TURNS)
r, z = WET
lathe("water_top.ply", [
    bezier([(r, z), (r - 0.04, WATER + 0.03), (r - 0.13, WATER), (r - 0.36, WATER)], 7)
    + [(0, WATER, 0, 1)],
], TURNS)

# A piece of cut crystal.
cut_stone("crystal.ply", [(0.81, -1.35), (1.5525, -0.3375), (1.485, 0.6075), (0.7425, 1.4175)])
