# What the mock server sends of a film: frames, heat maps as PNG, and the paths of a pixel. It must
# not know of HTTP.
import copy
import json
import struct
import zlib

import mock_scene

TILE = 64
SCALES = {"rim": 0.5, "key": 4.0}  # of the half floats of a layer; all others have 1


def tiles_of(film):
    """Rectangles (x, y, width, height) of the tiles of a window, row by row."""
    width, height = film.window[2] - film.window[0], film.window[3] - film.window[1]
    return [(x, y, min(TILE, width - x), min(TILE, height - y))
            for y in range(0, height, TILE) for x in range(0, width, TILE)]


def encode(film, names, tiles, version, preview, passes):
    width = film.window[2] - film.window[0]
    rectangles = tiles_of(film)
    layers, payload = [], []
    for name in names:
        channels = {"N": "XYZ", "Z": "Z"}.get(name, "RGB")
        count, values, scale = len(channels), film.values[name], SCALES.get(name, 1.0)
        noisy = name not in ("albedo", "N", "Z")
        layers.append({"name": name, "channels": channels, "scale": scale})
        for tile in tiles:
            x, y, w, h = rectangles[tile]
            for row in range(y, y + h):
                start = row * width + x
                line = values[start * count:(start + w) * count]
                if noisy:
                    line = [v * film.noise[start + i // count] for i, v in enumerate(line)]
                payload.append(struct.pack(f"<{w * count}e", *[v / scale for v in line]))
    header = json.dumps({
        "generation": film.generation, "version": version, "width": film.size[0],
        "height": film.size[1], "window": film.window, "preview": preview, "tile": TILE,
        "seconds": 1.0, "passes": passes, "layers": layers, "tiles": tiles}).encode()
    header += b" " * (-(12 + len(header)) % 8)
    return b"NPHV" + struct.pack("<II", 1, len(header)) + header + b"".join(payload)


def png(width, height, rgb):
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    rows = b"".join(b"\0" + rgb[3 * width * y:3 * width * (y + 1)] for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def noisy_pixels(film, name="picture"):
    return [v * film.noise[i // 3] for i, v in enumerate(film.values[name])]


def small_png(film):
    """The picture that a page shows first."""
    def code(value):
        encoded = 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055
        return round(255 * min(1, max(0, encoded)))
    width, height = film.window[2] - film.window[0], film.window[3] - film.window[1]
    return png(width, height, bytes(code(v) for v in noisy_pixels(film)))


def mixed(film, mix):
    """The film with the sum of layers as its picture. mix: JSON, or nothing."""
    result = copy.copy(film)
    result.noise, result.values = list(film.noise), dict(film.values)
    if mix:
        total = [0.0] * len(film.values["picture"])
        for name, gain in json.loads(mix).items():
            gains = gain if isinstance(gain, list) else [gain] * 3
            for i, v in enumerate(film.values[name]):
                total[i] += gains[i % 3] * v
        result.values["picture"] = total
    return result


def relative_errors(film, reference):
    """Squared relative error of each pixel; of a picture of another size none."""
    if film.window != reference.window:
        return []
    a, b = noisy_pixels(film), noisy_pixels(reference)
    return [sum((a[i + c] - b[i + c]) ** 2 / (b[i + c] ** 2 + 1e-3) for c in range(3)) / 3
            for i in range(0, len(a), 3)]


def inspection(render, x, y):
    film, width = render.film, render.film.window[2] - render.film.window[0]
    column, row = x - film.window[0], y - film.window[1]
    if not (0 <= column < width and 0 <= row < film.window[3] - film.window[1]):
        raise ValueError(f"pixel {x}, {y}: outside of the picture")
    camera = mock_scene.Camera(render.pose, *film.size)
    parts, _, normal, _, point = mock_scene.trace(camera, x, y)
    noise = film.noise[row * width + column]
    at = 3 * (row * width + column)

    def value(name):
        return [v * noise for v in film.values[name][at:at + 3]]
    total = sum(value("picture"))
    paths = []
    for (route, light), rgb in sorted(parts.items(), key=lambda part: -sum(part[1])):
        far = mock_scene.LIGHTS[light][0] or normal
        points = [camera.eye]
        if point:
            points.append(point)
            if route == "caustic":
                points.append((mock_scene.BALL[0], mock_scene.BALL[1], mock_scene.BALL[2]))
        last = points[-1]
        points.append(tuple(last[i] + 30 * far[i] for i in range(3)))
        paths.append({
            "word": f"C <RD'floor'> {'<TS> <TS> ' if route == 'caustic' else ''}<B.'{light}'>",
            "route": route, "light": light, "value": list(rgb),
            "technique": "photon merge" if route == "caustic" else "next-event estimation",
            "share": sum(rgb) * noise / total if total else 0, "share_error": 0.012,
            "points": points, "pixels": [[x + 0.5, y + 0.5]] + [camera.pixel(p)
                                                                for p in points[1:]]})
    return {"x": x, "y": y, "value": value("picture"), "error": [0.01, 0.01, 0.01],
            "samples": render.passes, "traced": value("picture"),
            "routes": [{"name": n, "value": value(n)} for n in mock_scene.ROUTES], "layers": [],
            "lights": [{"name": n, "value": value(n), "error": 0.004} for n in mock_scene.LIGHTS],
            "techniques": [{"name": "photon merge", "value": value("caustic"), "error": 0.003},
                           {"name": "next-event estimation", "value": value("rest"),
                            "error": 0.002}], "paths": paths}
