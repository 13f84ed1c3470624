"""What a tree of shader nodes means: one pbrt-v4 material, emission and opacity.

It must not know Blender.
"""
from dataclasses import dataclass, field, replace
from typing import Optional

from . import values
from .values import Constant, number


@dataclass(frozen=True)
class Shader:
    """A material with what it emits.

    Parameters map "float roughness", "spectrum reflectance" ... to values, all other types to plain
    Python. `mixed` are the two shaders of a "mix", whose second has the share `amount`.
    """
    kind: Optional[str] = None  # type of the pbrt material; None reflects nothing
    parameters: dict = field(default_factory=dict)
    emission: Optional[values.Constant] = None
    opacity: object = Constant((1.0, 1.0, 1.0))
    mixed: tuple = ()

    @property
    def is_clear(self):
        """True if light passes as if there were no surface."""
        return values.is_zero(self.opacity)


CLEAR = Shader(opacity=number(0))
BLACK = Shader()


def with_opacity(shader, opacity, reader):
    """The shader with a further opacity in front of it."""
    product = reader.combined(shader.opacity, opacity, "multiply", lambda a, b: a * b)
    return replace(shader, opacity=product)


def _emission_of(shader):
    return shader.emission if shader.emission is not None else number(0)


def _without_light(shader):
    return replace(shader, emission=None, opacity=number(1))


def mix(first, second, amount, reader):
    """first (1 - amount) + second amount."""
    if values.is_zero(amount):
        return first
    if values.is_one(amount):
        return second
    rest = values.apply(amount, "invert", lambda t: 1 - t)
    if first.is_clear:
        return with_opacity(second, amount, reader)
    if second.is_clear:
        return with_opacity(first, rest, reader)
    opacity = reader.mixed(first.opacity, second.opacity, amount)
    emission = None
    if first.emission is not None or second.emission is not None:
        emission = reader.mixed(_emission_of(first), _emission_of(second), amount)
    if first.kind is None and second.kind is None:
        return Shader(emission=emission, opacity=opacity)
    if not isinstance(amount, Constant):
        amount = values.apply(amount, "luminance", values.luminance)
    return Shader("mix", {"float amount": amount}, emission, opacity,
                  (_without_light(first), _without_light(second)))


def add(first, second, reader):
    """The sum of two shaders, exact if one of them only emits."""
    if first.is_clear:
        return second
    if second.is_clear:
        return first
    emission = None
    if first.emission is not None or second.emission is not None:
        emission = reader.combined(_emission_of(first), _emission_of(second), "add",
                                   lambda a, b: a + b)
    if first.kind is not None and second.kind is not None:
        reader.warn("Add Shader of two surfaces has no counterpart, half of each is used")
        mixed = mix(_without_light(first), _without_light(second), number(0.5), reader)
        return replace(mixed, emission=emission)
    surface = second if first.kind is None else first
    return replace(surface, emission=emission)
