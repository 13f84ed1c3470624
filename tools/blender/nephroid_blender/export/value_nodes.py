"""Nodes that give colours and numbers, as values. A row of NODES is one type of node."""
import math
import zlib

import numpy as np

from . import images, values
from .values import Constant, combine, number


FALLBACK = 0.5  # middle grey, of outputs that cannot be read


class ValueReader:
    """Reads sockets as values. What cannot be read becomes a constant, with a warning."""

    def __init__(self, report, thing):
        self.report = report
        self.thing = thing  # what warnings are about: "material 'Glass'"

    def warn(self, message):
        self.report.warn(self.thing, message)

    def color(self, socket, default=(0.8, 0.8, 0.8)):
        """The value of a colour socket (or of None: the default)."""
        if socket is None:
            return values.color(default)
        source = socket.source()
        if source is not None:
            return self._of_output(source)
        value = socket.resolved().default
        return values.color(value) if hasattr(value, "__len__") else number(value)

    def number(self, socket, default=0.0):
        """The value of a number socket; colours give their luminance."""
        if socket is None:
            return number(default)
        value = self.color(socket)
        if isinstance(value, Constant):
            return number(value.number)
        return value

    def constant(self, socket, default=0.0):
        """A number that must be the same everywhere."""
        value = self.number(socket, default)
        if isinstance(value, Constant):
            return value.number
        self.warn(f"'{socket.socket.name}' cannot vary over a surface, its mean is used")
        return float(value.pixels().mean())

    def constant_color(self, socket, default=(1, 1, 1)):
        value = self.color(socket, default)
        if isinstance(value, Constant):
            return value.color
        self.warn(f"'{socket.socket.name}' cannot vary, its mean is used")
        return tuple(float(x) for x in value.pixels().reshape(-1, 3).mean(axis=0))

    def _of_output(self, output):
        read = NODES.get(output.node.type)
        if read is not None:
            return read(self, output)
        self.warn(f"node '{output.node.name}' is not supported, {FALLBACK:g} is used instead")
        return number(FALLBACK)

    def environment(self, output):
        self.warn(f"'{output.node.name}' is for worlds, a constant is used")
        return number(0.5)

    def combined(self, a, b, name, function):
        """values.combine(), or `a` with a warning."""
        result = combine(a, b, name, function)
        if result is None:
            self.warn("two images with different mappings cannot be combined, one is left out")
            return a
        return result

    def mixed(self, a, b, amount):
        result = values.mix(a, b, amount)
        if result is None:
            self.warn("images with different mappings cannot be mixed, the first is used")
            return a
        return result

    def uv(self, socket, scale=1.0):
        """The texture coordinates of a vector socket."""
        source = socket.source() if socket is not None else None
        if source is None:
            return values.Uv()
        node = source.node
        if node.type == "MAPPING":
            inner = self.uv(node.input("Vector"))
            return inner.mapped(self._mapping_matrix(node))
        if node.type == "UVMAP":
            return values.Uv(node.node.uv_map)
        if node.type == "TEX_COORD" and source.name == "UV":
            return values.Uv()
        self.warn(f"texture coordinates of '{node.name}' ({source.name}) are not supported, "
                  "UV is used")
        return values.Uv()

    def _mapping_matrix(self, node):
        """The 3 x 3 matrix of a Mapping node in the plane of u and v."""
        def vector(name, default):
            socket = node.input(name)
            if socket is None:
                return default
            if socket.is_linked:
                self.warn(f"'{name}' of '{node.name}' is linked, its constant is used")
            return tuple(socket.resolved().default)
        location = vector("Location", (0, 0, 0))
        rotation = vector("Rotation", (0, 0, 0))
        size = vector("Scale", (1, 1, 1))
        if rotation[0] or rotation[1]:
            self.warn(f"'{node.name}' rotates out of the plane of the texture, "
                      "only its rotation about z is used")
        c, s = math.cos(rotation[2]), math.sin(rotation[2])
        scaling = np.diag([size[0], size[1], 1.0])
        turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
        move = np.array([[1, 0, location[0]], [0, 1, location[1]], [0, 0, 1.0]])
        kind = node.node.vector_type
        if kind == "POINT":
            return move @ turn @ scaling
        if kind == "TEXTURE":
            return np.linalg.pinv(move @ turn @ scaling)
        return turn @ scaling  # VECTOR, NORMAL


def _image(reader, output):
    node = output.node.node
    if node.projection != "FLAT":
        reader.warn(f"projection of '{output.node.name}' is not supported, UV is used")
    return images.grid(node.image, output.name, reader.uv(output.node.input("Vector")),
                       node.extension, node.interpolation == "Closest", reader.report)


def _checker(reader, output):
    """Two by two pixels: cell (0, 0) has the second colour."""
    node = output.node
    scale = reader.constant(node.input("Scale"), 5) / 2
    if node.input("Vector").source() is None:
        reader.warn(f"'{node.name}' without a vector uses UV in place of generated coordinates")
    uv = reader.uv(node.input("Vector")).mapped(np.diag([scale, scale, 1]))
    first = reader.constant_color(node.input("Color1"))
    second = reader.constant_color(node.input("Color2"))
    if output.name == "Fac":
        first, second = (1, 1, 1), (0, 0, 0)
    pixels = np.array([[first, second], [second, first]], dtype=np.float32)  # the top row first
    return values.Grid(f"checker {first} {second}", lambda: pixels, uv, "REPEAT", True)


def _rgb(reader, output):
    return values.color(output.node.node.outputs[0].default_value)


def _value(reader, output):
    return number(output.node.node.outputs[0].default_value)


BLENDS = {
    "MULTIPLY": lambda a, b: a * b,
    "ADD": lambda a, b: a + b,
    "SUBTRACT": lambda a, b: a - b,
    "SCREEN": lambda a, b: 1 - (1 - a) * (1 - b),
    "DIVIDE": lambda a, b: np.where(b != 0, a / b, a),
    "DIFFERENCE": lambda a, b: np.abs(a - b),
    "DARKEN": np.minimum,
    "LIGHTEN": np.maximum,
    "OVERLAY": lambda a, b: np.where(a < 0.5, 2 * a * b, 1 - 2 * (1 - a) * (1 - b)),
}


def _mix(reader, output):
    node = output.node
    if node.type == "MIX":
        kind = node.node.data_type
        if kind == "RGBA":
            a, b = reader.color(node.input("A_Color")), reader.color(node.input("B_Color"))
        else:
            a, b = reader.color(node.input("A_Float")), reader.color(node.input("B_Float"))
        amount = reader.number(node.input("Factor_Float"))
        blend = node.node.blend_type if kind == "RGBA" else "MIX"
    else:
        a, b = reader.color(node.input("Color1")), reader.color(node.input("Color2"))
        amount, blend = reader.number(node.input("Fac")), node.node.blend_type
    if blend in BLENDS:
        b = reader.combined(a, b, blend, BLENDS[blend])
    elif blend != "MIX":
        reader.warn(f"blend type {blend} of '{node.name}' is not supported, Mix is used")
    return reader.mixed(a, b, amount)


def _gamma(reader, output):
    gamma = reader.constant(output.node.input("Gamma"), 1)
    return values.apply(reader.color(output.node.input("Color")), f"gamma{gamma}",
                        lambda c: np.maximum(c, 0) ** gamma)


def _bright_contrast(reader, output):
    bright = reader.constant(output.node.input("Bright"))
    contrast = reader.constant(output.node.input("Contrast"))
    return values.apply(reader.color(output.node.input("Color")), f"bright{bright},{contrast}",
                        lambda c: np.maximum((1 + contrast) * c + bright - contrast / 2, 0))


def _invert(reader, output):
    color = reader.color(output.node.input("Color"))
    inverse = values.apply(color, "invert", lambda c: 1 - c)
    return reader.mixed(color, inverse, reader.number(output.node.input("Fac"), 1))


def _hue_saturation(reader, output):
    hue = reader.constant(output.node.input("Hue"), 0.5)
    saturation = reader.constant(output.node.input("Saturation"), 1)
    value = reader.constant(output.node.input("Value"), 1)

    def shifted(colors):
        h, s, v = _hsv(colors)
        return _rgb_of_hsv((h + hue + 0.5) % 1, np.clip(s * saturation, 0, 1), v * value)

    color = reader.color(output.node.input("Color"))
    changed = values.apply(color, f"hsv{hue},{saturation},{value}", shifted)
    return reader.mixed(color, changed, reader.number(output.node.input("Fac"), 1))


def _hsv(colors):
    high, low = colors.max(axis=-1), colors.min(axis=-1)
    span = np.where(high > low, high - low, 1)
    r, g, b = (colors[..., i] for i in range(3))
    hue = np.where(high == r, (g - b) / span, np.where(high == g, 2 + (b - r) / span,
                                                      4 + (r - g) / span))
    hue = np.where(high > low, hue / 6 % 1, 0)
    return hue, np.where(high > 0, (high - low) / np.where(high > 0, high, 1), 0), high


def _rgb_of_hsv(hue, saturation, value):
    offsets = np.array([5, 3, 1])
    k = (offsets + hue[..., None] * 6) % 6
    part = np.clip(np.minimum(k, 4 - k), 0, 1)
    return value[..., None] * (1 - saturation[..., None] * part)


def _ramp(reader, output):
    ramp = output.node.node.color_ramp
    places = np.linspace(0, 1, 257)
    colors = np.array([ramp.evaluate(float(x)) for x in places], dtype=np.float32)
    if output.name == "Alpha":
        colors = np.repeat(colors[:, 3:], 4, axis=1)

    def looked_up(c):
        t = c @ values.LUMINANCE
        return np.stack([np.interp(t, places, colors[:, i]) for i in range(3)], axis=-1)

    key = f"ramp{zlib.crc32(colors.tobytes())}"
    return values.apply(reader.color(output.node.input("Fac")), key, looked_up)


def _curves(reader, output):
    mapping = output.node.node.mapping
    mapping.initialize()
    places = np.linspace(0, 1, 257)
    table = np.array([[mapping.evaluate(mapping.curves[i], mapping.evaluate(mapping.curves[3],
                       float(x))) for x in places] for i in range(3)], dtype=np.float32)

    def looked_up(c):
        return np.stack([np.interp(c[..., i], places, table[i]) for i in range(3)], axis=-1)

    color = reader.color(output.node.input("Color"))
    changed = values.apply(color, f"curves{zlib.crc32(table.tobytes())}", looked_up)
    return reader.mixed(color, changed, reader.number(output.node.input("Fac"), 1))


UNARY = {
    "SQRT": lambda a: np.sqrt(np.maximum(a, 0)), "ABSOLUTE": np.abs, "ROUND": np.round,
    "FLOOR": np.floor, "CEIL": np.ceil, "FRACT": lambda a: a - np.floor(a), "SINE": np.sin,
    "COSINE": np.cos, "EXPONENT": np.exp, "INVERSE_SQRT": lambda a: 1 / np.sqrt(a),
}
BINARY = {
    "ADD": lambda a, b: a + b, "SUBTRACT": lambda a, b: a - b, "MULTIPLY": lambda a, b: a * b,
    "DIVIDE": lambda a, b: np.where(b != 0, a / b, 0), "POWER": lambda a, b: a ** b,
    "MINIMUM": np.minimum, "MAXIMUM": np.maximum,
    "LESS_THAN": lambda a, b: (a < b) * 1.0, "GREATER_THAN": lambda a, b: (a > b) * 1.0,
    "MODULO": np.fmod,
}


def _math(reader, output):
    node, operation = output.node, output.node.node.operation
    first, *others = [reader.number(socket) for socket in node.inputs()]
    if not isinstance(first, Constant):
        first = values.apply(first, "luminance", values.luminance)
    if operation in UNARY:
        result = values.apply(first, operation, UNARY[operation])
    elif operation in BINARY:
        result = reader.combined(first, others[0], operation, BINARY[operation])
    elif operation == "MULTIPLY_ADD":
        product = reader.combined(first, others[0], "MULTIPLY", BINARY["MULTIPLY"])
        result = reader.combined(product, others[1], "ADD", BINARY["ADD"])
    else:
        reader.warn(f"operation {operation} of '{node.name}' is not supported, it is left out")
        result = first
    if node.node.use_clamp:
        result = values.apply(result, "clamp", lambda a: np.clip(a, 0, 1))
    return result


def _map_range(reader, output):
    node = output.node
    low, high, to_low, to_high = (reader.constant(node.input(*names), default) for names, default in
                                  ((("From Min",), 0), (("From Max",), 1), (("To Min",), 0),
                                   (("To Max",), 1)))

    def mapped(c):
        t = (c - low) / (high - low if high != low else 1)
        return to_low + (np.clip(t, 0, 1) if node.node.clamp else t) * (to_high - to_low)

    return values.apply(reader.number(node.input("Value")),
                        f"range{low},{high},{to_low},{to_high}", mapped)


def _separate(reader, output):
    channel = {"R": 0, "Red": 0, "G": 1, "Green": 1, "B": 2, "Blue": 2}.get(output.name)
    color = reader.color(output.node.input("Image", "Color"))
    if channel is None or getattr(output.node.node, "mode", "RGB") != "RGB":
        reader.warn(f"'{output.node.name}' is not supported, its colour is used")
        return color
    return values.apply(color, f"channel{channel}",
                        lambda c: np.repeat(c[..., channel:channel + 1], 3, axis=-1))


def _combine(reader, output):
    node = output.node
    parts = [reader.number(node.input(*names)) for names in
             (("R", "Red"), ("G", "Green"), ("B", "Blue"))]
    result = number(0)
    for i, part in enumerate(parts):
        unit = np.eye(3, dtype=np.float32)[i]
        placed = values.apply(part, f"unit{i}", lambda c, unit=unit: c @ values.LUMINANCE[:, None]
                              * unit)
        result = reader.combined(result, placed, "add", BINARY["ADD"])
    return result


def _to_luminance(reader, output):
    return values.apply(reader.color(output.node.input("Color")), "luminance", values.luminance)


def _blackbody(reader, output):
    """Linear Rec. 709 with luminance 1, by the fit of Kim et al. 2002 to the Planckian locus."""
    t = min(max(reader.constant(output.node.input("Temperature"), 6500), 1667), 25000)
    k = 1000 / t
    x = (((-0.2661239 * k - 0.2343589) * k + 0.8776956) * k + 0.179910 if t <= 4000 else
         ((-3.0258469 * k + 2.1070379) * k + 0.2226347) * k + 0.240390)
    if t <= 2222:
        y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
    elif t <= 4000:
        y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
    else:
        y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483
    xyz = np.array([x / y, 1, (1 - x - y) / y])
    rgb = np.array([[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
                    [0.0556434, -0.2040259, 1.0572252]]) @ xyz
    return values.color(np.maximum(rgb, 0))


NODES = {
    "TEX_ENVIRONMENT": lambda reader, output: reader.environment(output),
    "TEX_IMAGE": _image, "TEX_CHECKER": _checker, "RGB": _rgb, "VALUE": _value,
    "MIX_RGB": _mix, "MIX": _mix, "GAMMA": _gamma, "BRIGHTCONTRAST": _bright_contrast,
    "INVERT": _invert, "HUE_SAT": _hue_saturation, "VALTORGB": _ramp, "CURVE_RGB": _curves,
    "MATH": _math, "MAP_RANGE": _map_range, "SEPRGB": _separate, "SEPARATE_COLOR": _separate,
    "COMBRGB": _combine, "COMBINE_COLOR": _combine, "RGBTOBW": _to_luminance,
    "BLACKBODY": _blackbody,
}
