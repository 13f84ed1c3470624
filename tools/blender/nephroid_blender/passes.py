"""Layers of the program as render passes of Blender."""
from dataclasses import dataclass

import numpy as np

from .preferences import program_path
from .program import route_names


@dataclass(frozen=True)
class Pass:
    name: str  # name in Blender
    layer: str  # name in the program
    channels: str
    kind: str  # type of the socket


def extra_passes(scene, view_layer):
    """All passes but Combined."""
    settings = scene.nephroid
    found = []
    if view_layer.use_pass_z:
        found.append(Pass("Depth", "Z", "Z", "VALUE"))
    if view_layer.use_pass_normal:
        found.append(Pass("Normal", "N", "XYZ", "VECTOR"))
    if settings.albedo_pass:
        found.append(Pass("Albedo", "albedo", "RGB", "COLOR"))
    if settings.route_passes:
        found += [Pass(name, name, "RGB", "COLOR")
                  for name in route_names(program_path(), settings.integrator)]
    found += [Pass(aov.name, aov.name, "RGB", "COLOR") for aov in settings.aovs]
    return found


def with_alpha(rgb):
    """Rows of red, green, blue and 1, the bottom row first, as Blender has them."""
    pixels = np.ones((*rgb.shape[:2], 4), dtype=np.float32)
    pixels[..., :3] = rgb
    return pixels[::-1].reshape(-1, 4)


def fill(result, layers, passes):
    """Copies the layers of a frame into a render result."""
    rendered = result.layers[0].passes
    rendered["Combined"].rect = with_alpha(layers["picture"])
    for wanted in passes:
        if wanted.layer in layers:
            pixels = layers[wanted.layer]
            if wanted.name in rendered:
                rendered[wanted.name].rect = pixels[::-1].reshape(-1, pixels.shape[2])
