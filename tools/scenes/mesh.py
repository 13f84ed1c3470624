"""Meshes and pictures as small files: binary PLY from parametric surfaces, lathes, tubes and convex solids; PNG.

For the scripts that write the files of scenes/. It must not know any scene. Normals of smooth
surfaces point to the left of d/du x d/dv; facets of solids have none.
"""
import math
import struct
import zlib


def write_ply(path, vertices, faces):
    """Vertices are (x, y, z) or (x, y, z, nx, ny, nz), faces triangles; little-endian binary."""
    properties = ("x", "y", "z", "nx", "ny", "nz")[:len(vertices[0])]
    header = "ply\nformat binary_little_endian 1.0\n" + f"element vertex {len(vertices)}\n"
    header += "".join(f"property float {p}\n" for p in properties)
    header += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    with open(path, "wb") as out:
        out.write(header.encode())
        for v in vertices:
            out.write(struct.pack(f"<{len(v)}f", *v))
        for f in faces:
            out.write(struct.pack("<B3i", 3, *f))


def write_png(path, width, height, channels, pixel):
    """A picture of 1 or 3 channels; pixel(i, j) gives numbers between 0 and 1, row 0 on top."""
    rows = b""
    for j in range(height):
        rows += b"\0" + bytes(int(255 * min(1, max(0, c)) + 0.5) for i in range(width) for c in pixel(i, j))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    kind = 0 if channels == 1 else 2
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, kind, 0, 0, 0))
                  + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def lathe(path, pieces, turns):
    """Turns profiles around z: a piece is a list of (radius, z), normals point to its right.

    A piece is smooth within itself, and at its ends if they meet.
    """
    vertices, faces = [], []
    for piece in pieces:
        normals, last, closed = [], len(piece) - 1, piece[0] == piece[-1]
        for i in range(len(piece)):
            (r0, z0) = piece[last - 1 if closed and i == 0 else max(i - 1, 0)]
            (r1, z1) = piece[1 if closed and i == last else min(i + 1, last)]
            normals.append((*unit((z1 - z0, r0 - r1)),))
        rings = []
        for (r, z), (nr, nz) in zip(piece, normals):
            on_axis = abs(r) < 1e-9
            rings.append((len(vertices), 1 if on_axis else turns))
            for s in range(rings[-1][1]):
                c, d = math.cos(2 * math.pi * s / turns), math.sin(2 * math.pi * s / turns)
                vertices.append((r * c, r * d, z, *((0, 0, math.copysign(1, nz)) if on_axis else (nr * c, nr * d, nz))))
        for (low, low_count), (high, high_count) in zip(rings, rings[1:]):
            for s in range(turns):
                t = (s + 1) % turns
                a, b, e, f = low + s % low_count, low + t % low_count, high + t % high_count, high + s % high_count
                if a != b:
                    faces.append((a, b, e))
                if e != f:
                    faces.append((a, e, f))
    write_ply(path, vertices, faces)


def bezier(p, steps):
    """Points of a cubic Bezier curve, both ends included."""
    points = []
    for i in range(steps + 1):
        t = i / steps
        w = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3)
        points.append(tuple(sum(a * q[k] for a, q in zip(w, p)) for k in range(len(p[0]))))
    return points


def tube(path, way, radius, around):
    """A round tube along points in space, open at its ends; normals point outwards."""
    vertices, faces = [], []
    side = None
    for i, point in enumerate(way):
        along = unit(minus(way[min(i + 1, len(way) - 1)], way[max(i - 1, 0)]))
        if side is None:
            side = cross(along, (1, 0, 0) if abs(along[0]) < 0.9 else (0, 1, 0))
        side = unit(tuple(a - dot(side, along) * b for a, b in zip(side, along)))
        other = cross(along, side)
        for s in range(around):
            c, d = math.cos(2 * math.pi * s / around), math.sin(2 * math.pi * s / around)
            n = tuple(c * a + d * b for a, b in zip(side, other))
            vertices.append((*(p + radius * x for p, x in zip(point, n)), *n))
    for i in range(len(way) - 1):
        for s in range(around):
            a, b = i * around + s, i * around + (s + 1) % around
            faces += [(a, b, b + around), (a, b + around, a + around)]
    write_ply(path, vertices, faces)


def clip(polygon, normal, offset):
    """The part of a polygon with dot(normal, p) <= offset."""
    kept = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        a, b = dot(normal, p) - offset, dot(normal, q) - offset
        if a <= 0:
            kept.append(p)
        if a * b < 0:
            t = a / (a - b)
            kept.append(tuple(x + t * (y - x) for x, y in zip(p, q)))
    return kept


def convex(path, planes):
    """The solid where dot(normal, p) <= offset for all planes (normal, offset); flat facets, no normals."""
    index, vertices, faces = {}, [], []
    for k, (n, d) in enumerate(planes):
        side = unit(cross(n, (0, 0, 1) if abs(n[2]) < 0.9 else (1, 0, 0)))
        other = cross(n, side)
        facet = [tuple(d * n[i] + 50 * (a * side[i] + b * other[i]) for i in range(3))
                 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        for j, (m, e) in enumerate(planes):
            if j != k and facet:
                facet = clip(facet, m, e)
        corners = []
        for p in facet:
            key = tuple(round(x * 1e4) for x in p)
            if key not in index:
                index[key] = len(vertices)
                vertices.append(p)
            if index[key] not in corners:
                corners.append(index[key])
        faces += [(corners[0], a, b) for a, b in zip(corners[1:], corners[2:])]
    write_ply(path, vertices, faces)


def brilliant(path, crown, star, upper, pavilion, lower, table, height):
    """A round brilliant of radius 1 with its girdle at z = 0: angles of the facets in degrees, radius of the table."""
    def facet(angle, turn, r, z):
        a, t = math.radians(angle), math.radians(turn)
        n = (math.sin(a) * math.cos(t), math.sin(a) * math.sin(t), math.cos(a))
        return n, math.sin(a) * r + math.cos(a) * z
    planes = [((0, 0, 1), height)]
    for k in range(8):
        planes.append(facet(crown, 45 * k, 1.0, 0.02))
        planes.append(facet(star, 45 * k + 22.5, table * math.cos(math.radians(22.5)), height))
        planes.append(facet(180 - pavilion, 45 * k, 1.0, -0.02))
        for side in (11.25, 33.75):
            planes.append(facet(upper, 45 * k + side, 0.995, 0.02))
            planes.append(facet(180 - lower, 45 * k + side, 0.995, -0.02))
    for k in range(48):
        planes.append(facet(90, 7.5 * k, 1.0, 0))
    convex(path, planes)
