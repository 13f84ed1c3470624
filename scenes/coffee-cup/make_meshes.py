#!/usr/bin/env python3
"""Turns profiles on a lathe: writes the meshes of the coffee cup scene (binary PLY with normals).

Run it in this folder after a change; the meshes are kept beside the scene so that nobody has to.
Lengths are centimetres, z is up.
"""
import math
import struct


def lathe(path, profile, segments):
    """A surface of revolution around z through the (radius, z) points of `profile`, smooth normals."""
    n = len(profile)
    normals = []
    for i in range(n):
        (r0, z0), (r1, z1) = profile[max(i - 1, 0)], profile[min(i + 1, n - 1)]
        dr, dz = r1 - r0, z1 - z0
        length = math.hypot(dr, dz)
        normals.append((dz / length, -dr / length))
    vertices, faces = [], []
    for s in range(segments):
        phi = 2 * math.pi * s / segments
        c, d = math.cos(phi), math.sin(phi)
        for (r, z), (nr, nz) in zip(profile, normals):
            vertices.append((r * c, r * d, z, nr * c, nr * d, nz))
    for s in range(segments):
        t = (s + 1) % segments
        for i in range(n - 1):
            a, b, e, f = s * n + i, t * n + i, t * n + i + 1, s * n + i + 1
            if profile[i][0] > 0:
                faces.append((a, b, e))
            if profile[i + 1][0] > 0:
                faces.append((a, e, f))
    with open(path, "wb") as out:
        out.write((
            "ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(vertices)}\n"
            + "".join(f"property float {p}\n" for p in ("x", "y", "z", "nx", "ny", "nz"))
            + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
        ).encode())
        for v in vertices:
            out.write(struct.pack("<6f", *v))
        for f in faces:
            out.write(struct.pack("<B3i", 3, *f))


def arc(cx, cz, radius, start, end, steps):
    """Points of a circle from `start` to `end` degrees."""
    return [(cx + radius * math.cos(math.radians(start + (end - start) * i / steps)),
             cz + radius * math.sin(math.radians(start + (end - start) * i / steps)))
            for i in range(steps + 1)]


def line(a, b, steps):
    return [(a[0] + (b[0] - a[0]) * i / steps, a[1] + (b[1] - a[1]) * i / steps)
            for i in range(steps + 1)]


# The cup: up the outside, over the rim, down the inside, along the bottom.
cup = ([(0.0, 0.3), (2.6, 0.3)] + arc(2.6, 0.9, 0.6, -90, 0, 8) + line((3.2, 0.95), (3.2, 6.0), 24)
       + arc(3.1, 6.0, 0.1, 0, 180, 10) + line((3.0, 5.95), (3.0, 1.0), 24)
       + arc(2.5, 1.0, 0.5, 0, -90, 8) + [(0.0, 0.5)])
lathe("cup.ply", cup, 192)

# The saucer, turned upwards at its edge.
saucer = ([(0.0, 0.0), (3.4, 0.0)] + arc(3.4, 4.0, 4.0, -90, -50, 12)
          + arc(5.971 + 0.0, 0.936 + 0.1, 0.1, -50, 130, 8)
          + [(r - 0.129, z + 0.153) for r, z in reversed(arc(3.4, 4.0, 4.0, -90, -50, 12))]
          + [(3.2, 0.2), (0.0, 0.2)])
lathe("saucer.ply", saucer, 160)

# A tumbler of glass, and the water in it: three interfaces, each its own mesh. The water's side is the
# inner side of the glass below the water line, so it is made once, with glass outside.
H, WATER = 8.0, 5.6
lathe("tumbler_outside.ply", [(0.0, 0.02), (2.2, 0.02)] + arc(2.2, 0.32, 0.3, -90, 0, 6)
      + line((2.5, 0.35), (2.7, H), 24) + arc(2.6, H, 0.1, 0, 180, 8)
      + line((2.5, H - 0.05), (2.4675, WATER), 8), 160)
lathe("tumbler_water_side.ply", line((2.4675, WATER), (2.35, 1.2), 12)
      + arc(2.05, 1.2, 0.3, 0, -90, 6) + [(0.0, 0.9)], 160)
lathe("water_top.ply", [(2.4675, WATER), (0.0, WATER)], 160)
