# A ball on a chequered floor under three lights, seen by a camera that can move: synthetic layers
# for the mock server. It must not know of HTTP.
import math

LIGHTS = {"key": ((0.6, 0.7, -0.4), (3.0, 2.7, 2.2)), "rim": ((-0.8, 0.35, 0.5), (0.4, 0.9, 2.0)),
          "sky": (None, (0.25, 0.3, 0.4))}
ROUTES = ("caustic", "rest")
BALL, RADIUS = (0.0, 1.0, 0.0), 1.0
START = {"eye": [-3.2, 2.4, -4.6], "target": [0.0, 0.8, 0.0], "up": [0.0, 1.0, 0.0], "fov": 34.0,
         "lens_radius": 0.0, "focal_distance": 5.8, "shutter": [0.0, 1.0]}


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a):
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length)


class Camera:
    """A pose as LookAt of pbrt reads it: left-handed, fov along the shorter side; mirrored by
    Scale -1 1 1 in camera space, as most scenes are."""

    def __init__(self, pose, width, height):
        self.eye = tuple(pose["eye"])
        self.forward = normalize(subtract(pose["target"], self.eye))
        self.right = normalize(cross(self.forward, pose["up"]))
        self.up = cross(self.right, self.forward)
        self.half = math.tan(math.radians(pose["fov"]) / 2)
        self.width, self.height, self.short = width, height, min(width, height)

    def ray(self, x, y):
        u = (2 * (x + 0.5) - self.width) / self.short * self.half
        v = (self.height - 2 * (y + 0.5)) / self.short * self.half
        f, r, p = self.forward, self.right, self.up
        return normalize((f[0] + u * r[0] + v * p[0], f[1] + u * r[1] + v * p[1],
                          f[2] + u * r[2] + v * p[2]))

    def pixel(self, point):
        """Pixel of a point, or None behind the camera."""
        d = subtract(point, self.eye)
        depth = dot(d, self.forward)
        if depth <= 1e-6:
            return None
        scale = self.short / (2 * self.half * depth)
        return [self.width / 2 + dot(d, self.right) * scale,
                self.height / 2 - dot(d, self.up) * scale]


def hit_ball(origin, direction):
    d = subtract(origin, BALL)
    b = dot(d, direction)
    discriminant = b * b - dot(d, d) + RADIUS * RADIUS
    if discriminant < 0:
        return None
    t = -b - math.sqrt(discriminant)
    return t if t > 1e-4 else None


def hit(origin, direction):
    """(distance, normal, albedo), or None for the sky."""
    t = hit_ball(origin, direction)
    if t is not None:
        point = [origin[i] + t * direction[i] for i in range(3)]
        return t, subtract(point, BALL), (0.75, 0.32, 0.2)
    if direction[1] >= -1e-6:
        return None
    t = -origin[1] / direction[1]
    x, z = origin[0] + t * direction[0], origin[2] + t * direction[2]
    if t <= 0 or abs(x) > 40 or abs(z) > 40:
        return None
    dark = (math.floor(x) + math.floor(z)) & 1
    return t, (0.0, 1.0, 0.0), ((0.3, 0.3, 0.3) if dark else (0.62, 0.6, 0.55))


def caustic_at(point, light):
    """Brightness of a bright curve on the floor, opposite of the light."""
    if point[1] > 1e-3 or light is None:
        return 0.0
    x, z = point[0] + 1.7 * light[0], point[2] + 1.7 * light[2]
    r = math.hypot(x, z)
    edge = 0.55 + 0.25 * math.cos(2 * math.atan2(z, x))
    return 1.6 * math.exp(-((r - edge) / 0.09) ** 2) + (0.25 if r < edge else 0.0)


def trace(camera, x, y):
    """What a pixel sees: {route/light: rgb}, albedo, normal, depth, point."""
    direction = camera.ray(x, y)
    found = hit(camera.eye, direction)
    if found is None:
        sky = 0.3 + 0.5 * max(0.0, direction[1])
        return {("rest", "sky"): (0.5 * sky, 0.6 * sky, 0.8 * sky)}, (0, 0, 0), (0, 0, 0), 0.0, None
    t, normal, albedo = found
    point = tuple(camera.eye[i] + t * direction[i] for i in range(3))
    parts = {}
    for name, (light, color) in LIGHTS.items():
        if light is None:
            amount = 0.5 + 0.5 * normal[1]
            if point[1] < 1e-3:
                amount *= 1 - 0.75 * math.exp(-(point[0] ** 2 + point[2] ** 2))
        else:
            amount = max(0.0, dot(normal, light))
            off = tuple(point[i] + 1e-3 * normal[i] for i in range(3))
            if amount > 0 and hit_ball(off, light) is not None:
                amount = 0.0
            bright = caustic_at(point, light)
            if bright > 1e-4:
                parts["caustic", name] = tuple(a * c * bright for a, c in zip(albedo, color))
        if amount > 0:
            parts["rest", name] = tuple(a * c * amount / math.pi for a, c in zip(albedo, color))
    return parts, albedo, normal, t * dot(direction, camera.forward), point


class Film:
    """Layers of a picture: {name: values, row by row}. Noise is a factor for each pixel."""

    def __init__(self, pose, size, window, is_current):
        camera = Camera(pose, *size)
        names = ["picture", *ROUTES, *LIGHTS, "albedo", "N"]
        self.size, self.window = size, window
        self.values = {name: [] for name in names} | {"Z": []}
        self.complete = False
        for y in range(window[1], window[3]):
            if not is_current():
                return
            for x in range(window[0], window[2]):
                self._add(*trace(camera, x, y)[:4])
        self.noise = [1.0] * len(self.values["Z"])
        self.complete = True

    def _add(self, parts, albedo, normal, depth):
        sums = {name: [0.0, 0.0, 0.0] for name in ("picture", *ROUTES, *LIGHTS)}
        for (route, light), rgb in parts.items():
            for name in ("picture", route, light):
                total = sums[name]
                total[0] += rgb[0]
                total[1] += rgb[1]
                total[2] += rgb[2]
        for name, total in sums.items():
            self.values[name].extend(total)
        self.values["albedo"].extend(albedo)
        self.values["N"].extend(normal)
        self.values["Z"].append(depth)
