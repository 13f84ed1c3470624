"""Nodes that give volumes, as a homogeneous medium. Coefficients are those of Cycles."""
from dataclasses import dataclass

import numpy as np

ZERO = np.zeros(3)


@dataclass
class Medium:
    absorption: np.ndarray  # 1/m
    scattering: np.ndarray  # 1/m
    g: float = 0.0

    @property
    def is_empty(self):
        return not (self.absorption.any() or self.scattering.any())


def read_volume(reader, socket):
    """The medium that a Volume socket is linked to, or None."""
    source = socket.source() if socket is not None else None
    if source is None:
        return None
    node = source.node
    if node.type in ("ADD_SHADER", "MIX_SHADER"):
        return _sum(reader, node)
    read = VOLUMES.get(node.type)
    if read is None:
        reader.warn(f"node '{node.name}' is not supported as a volume, it is left out")
        return None
    medium = read(reader, node)
    return None if medium.is_empty else medium


def _density(reader, node):
    return reader.constant(node.input("Density"), 1)


def _color(reader, node, name="Color"):
    return np.clip(np.array(reader.constant_color(node.input(name))), 0, None)


def _absorption(reader, node):
    return Medium(_density(reader, node) * np.clip(1 - _color(reader, node), 0, None), ZERO)


def _scatter(reader, node):
    return Medium(ZERO, _density(reader, node) * _color(reader, node),
                  reader.constant(node.input("Anisotropy")))


def _principled(reader, node):
    """Absorption is (1 - colour)(1 - sqrt(absorption colour)) of the density."""
    density, color = _density(reader, node), _color(reader, node)
    tint = np.sqrt(_color(reader, node, "Absorption Color"))
    if reader.constant(node.input("Emission Strength")) > 0 or \
            reader.constant(node.input("Blackbody Intensity")) > 0:
        reader.warn("emission of a volume is not supported, it is left out")
    absorption = density * np.clip(1 - color, 0, None) * np.clip(1 - tint, 0, None)
    return Medium(absorption, density * color, reader.constant(node.input("Anisotropy")))


def _sum(reader, node):
    amounts = (1.0, 1.0)
    if node.type == "MIX_SHADER":
        t = reader.constant(node.input("Fac"), 0.5)
        amounts = (1 - t, t)
    parts = [(a, read_volume(reader, s)) for a, s in
             zip(amounts, (s for s in node.inputs() if s.socket.type == "SHADER"))]
    parts = [(a, m) for a, m in parts if m is not None]
    if not parts:
        return None
    scattering = sum(a * m.scattering for a, m in parts)
    weights = [float((a * m.scattering).sum()) for a, m in parts]
    g = sum(w * m.g for w, (_, m) in zip(weights, parts)) / max(sum(weights), 1e-30)
    return Medium(sum(a * m.absorption for a, m in parts), scattering, g)


VOLUMES = {"VOLUME_ABSORPTION": _absorption, "VOLUME_SCATTER": _scatter,
           "PRINCIPLED_VOLUME": _principled}
