"""What a socket of a node tree can be: a constant, or a grid of pixels over texture coordinates.

Operations on values are NumPy functions of colours, so any chain of nodes over images becomes one
image. It must not know Blender.
"""
from dataclasses import dataclass, field, replace
from typing import Callable, Optional

import numpy as np

LUMINANCE = np.array([0.2126, 0.7152, 0.0722], dtype=np.float32)
NO_MAPPING = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def luminance(colors):
    """Rec. 709 luminance of the last axis, kept as an axis of length 3."""
    return np.repeat((colors @ LUMINANCE)[..., None], 3, axis=-1)


@dataclass(frozen=True)
class Uv:
    """Texture coordinates: a layer of the mesh ("" is the one for rendering), mapped."""
    layer: str = ""
    matrix: tuple = NO_MAPPING  # two rows of (a, b, translation)

    def array(self):
        return np.array([*self.matrix, (0, 0, 1)], dtype=np.float64)

    def mapped(self, matrix):
        """These coordinates with a further 3 x 3 matrix applied to them."""
        product = np.asarray(matrix, dtype=np.float64) @ self.array()
        return replace(self, matrix=tuple(tuple(float(x) for x in row) for row in product[:2]))


@dataclass(frozen=True)
class Constant:
    color: tuple

    @property
    def number(self):
        return float(np.dot(np.asarray(self.color, dtype=np.float64), LUMINANCE)) \
            if len(set(self.color)) > 1 else float(self.color[0])


@dataclass(frozen=True)
class Source:
    """A file that holds the pixels of a grid."""
    path: str
    encoding: Optional[str]  # "sRGB" or "linear" of bytes; None of floats
    is_grey: bool  # True if it is known to have one channel


@dataclass(frozen=True)
class Grid:
    """An image over the unit square of `uv`. `pixels()` gives height x width x 3, linear."""
    key: str  # equal for equal pixels
    pixels: Callable = field(compare=False)
    uv: Uv = Uv()
    extension: str = "REPEAT"
    closest: bool = False
    source: Optional[Source] = None


def number(value):
    return Constant((float(value),) * 3)


def color(rgb):
    return Constant(tuple(float(x) for x in rgb[:3]))


def is_zero(value):
    return isinstance(value, Constant) and not any(value.color)


def is_one(value):
    return isinstance(value, Constant) and all(x == 1 for x in value.color)


def _in_float(function, *arrays):
    with np.errstate(all="ignore"):
        result = np.asarray(function(*arrays), dtype=np.float32)
    return np.nan_to_num(result, posinf=0, neginf=0)


def apply(value, name, function):
    """`function` of a value's colours; `name` tells it from other functions."""
    if isinstance(value, Constant):
        out = _in_float(function, np.array([[value.color]], dtype=np.float32))
        return Constant(tuple(float(x) for x in np.broadcast_to(out, (1, 1, 3))[0, 0]))
    return replace(value, key=f"{name}({value.key})", source=None,
                   pixels=lambda: np.broadcast_to(_in_float(function, value.pixels()),
                                                  value.pixels().shape))


def _resized(pixels, shape):
    """The nearest pixels in a grid of another size."""
    rows = (np.arange(shape[0]) + 0.5) * pixels.shape[0] / shape[0]
    columns = (np.arange(shape[1]) + 0.5) * pixels.shape[1] / shape[1]
    return pixels[rows.astype(int)][:, columns.astype(int)]


def combine(a, b, name, function):
    """`function` of two values; None if their texture coordinates differ."""
    if isinstance(a, Constant) and isinstance(b, Constant):
        out = _in_float(function, *(np.array([[v.color]], dtype=np.float32) for v in (a, b)))
        return Constant(tuple(float(x) for x in np.broadcast_to(out, (1, 1, 3))[0, 0]))
    if isinstance(b, Constant):
        other = np.array([[b.color]], dtype=np.float32)
        return apply(a, f"{name}[.,{b.color}]", lambda x: function(x, other))
    if isinstance(a, Constant):
        other = np.array([[a.color]], dtype=np.float32)
        return apply(b, f"{name}[{a.color},.]", lambda x: function(other, x))
    if a.uv != b.uv:
        return None

    def pixels():
        first, second = a.pixels(), b.pixels()
        shape = max(first.shape, second.shape)
        return _in_float(function, _resized(first, shape), _resized(second, shape))

    return replace(a, key=f"{name}({a.key},{b.key})", pixels=pixels, source=None)


def mix(a, b, amount, name="mix"):
    """a (1 - amount) + b amount; None if texture coordinates differ."""
    if is_zero(amount):
        return a
    if is_one(amount):
        return b
    if isinstance(amount, Constant):
        t = np.float32(amount.number)
        return combine(a, b, f"{name}{t}", lambda x, y: x * (1 - t) + y * t)
    kept = combine(a, amount, name + "0", lambda x, t: x * (1 - luminance(t)))
    added = combine(b, amount, name + "1", lambda y, t: y * luminance(t))
    if kept is None or added is None:
        return None
    return combine(kept, added, "add", lambda x, y: x + y)


def multiply(a, b):
    return combine(a, b, "multiply", lambda x, y: x * y)
