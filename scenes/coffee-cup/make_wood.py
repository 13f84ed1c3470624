#!/usr/bin/env python3
"""Writes wood.png, the grain of the table: how dark the wood is, one linear grey value a texel.

Run it in this folder after a change; the picture is kept beside the scene. It repeats in both
directions. Four boards lie side by side; u runs along them.
"""
import math
import random
import struct
import zlib

WIDTH, HEIGHT, BOARDS = 512, 1024, 4
rng = random.Random(1638)


def lattice(nu, nv):
    return [[rng.random() for _ in range(nu)] for _ in range(nv)]


def value(grid, u, v):
    """Smooth noise with period 1 in u and v, between 0 and 1."""
    nv, nu = len(grid), len(grid[0])
    x, y = u * nu, v * nv
    i, j = math.floor(x), math.floor(y)
    a, b = x - i, y - j
    a, b = a * a * (3 - 2 * a), b * b * (3 - 2 * b)
    row, above = grid[j % nv], grid[(j + 1) % nv]
    low = row[i % nu] * (1 - a) + row[(i + 1) % nu] * a
    high = above[i % nu] * (1 - a) + above[(i + 1) % nu] * a
    return low * (1 - b) + high * b


def board_texels():
    """One board: cuts through the rings of a trunk, fibres, pores."""
    bend, wave = lattice(2, 2), lattice(5, 5)
    fibre, fine = lattice(12, 60), lattice(24, 170)
    pores = lattice(40, 128)
    tone = rng.uniform(-0.10, 0.10)
    heart = rng.uniform(0.15, 0.85)
    rows = HEIGHT // BOARDS
    texels = []
    for j in range(rows):
        v = j / rows
        for i in range(WIDTH):
            u = i / WIDTH
            across = v - heart + 0.35 * (value(bend, u, v) - 0.5) + 0.08 * (value(wave, u, v) - 0.5)
            distance = math.hypot(across, 0.22 + 0.10 * math.sin(2 * math.pi * u))
            phase = (distance * 13) % 1.0
            ring = phase ** 2.5 if phase < 0.93 else (1 - phase) / 0.07 * 0.83
            x = 0.30 + tone + 0.30 * ring
            x += 0.26 * (value(fibre, u, v) - 0.5) + 0.22 * (value(fine, u, v) - 0.5)
            pore = value(pores, u, v)
            x += 0.9 * max(0.0, pore - 0.80)
            gap = min(j, rows - 1 - j)
            if gap < 2:
                x = max(x, 0.95 if gap == 0 else 0.7)
            texels.append(min(max(x, 0.0), 1.0))
    return texels


def write_png(path, rows):
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    # Each row as differences to its left neighbour: the grain runs along the rows.
    filtered = b"".join(
        b"\x01" + bytes((x - (row[i - 1] if i else 0)) & 255 for i, x in enumerate(row))
        for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                  + chunk(b"IDAT", zlib.compress(filtered, 9)) + chunk(b"IEND", b""))


texels = [x for _ in range(BOARDS) for x in board_texels()]
# Steps of 4 of 255 cannot be seen and compress well.
grey = [int(round(x * 63)) * 4 for x in texels]
write_png("wood.png", [grey[j * WIDTH:(j + 1) * WIDTH] for j in range(HEIGHT)])
