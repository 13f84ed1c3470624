"""The world: a colour, or an image of latitude and longitude.

Blender's image has u = 1/2 - phi / 2 pi, the program's u = phi / 2 pi, with phi from +x. So the
columns are reversed and shifted by half. Both images have +z at the top.
"""

import numpy as np

from . import values
from .nodes import active_output
from .shader_nodes import ShaderReader
from .values import Constant, Uv

DIRECTION = "direction"


class WorldReader(ShaderReader):
    """Reads colours that may depend on the direction; keeps the rotation of their mapping."""

    rotation = None  # 3 x 3, from directions of the world to those of the image

    def environment(self, output):
        from . import images
        node = output.node
        if node.node.projection != "EQUIRECTANGULAR":
            self.warn(f"projection of '{node.name}' is not supported, Equirectangular is used")
        found = images.grid(node.node.image, "Color", Uv(DIRECTION), "REPEAT", False, self.report)
        source = node.input("Vector").source()
        if source is not None and source.node.type == "MAPPING":
            self.rotation = self._rotation(source.node)
        return found

    def _rotation(self, node):
        from mathutils import Euler
        angles = tuple(node.input("Rotation").resolved().default)
        rotation = np.array(Euler(angles).to_matrix())
        size = np.array(node.input("Scale").resolved().default)
        if not np.allclose(np.abs(size), 1):
            self.warn(f"the scale of '{node.name}' is not supported, only its signs are used")
        rotation = rotation @ np.diag(np.sign(size))
        return rotation.T if node.node.vector_type == "TEXTURE" else rotation


def latitude_longitude(pixels):
    """Pixels of Blender's equirectangular image as the program's, twice as wide as high."""
    height, width = pixels.shape[:2]
    if width != 2 * height:
        width = max(2 * height, width + width % 2)
        rows = ((np.arange(width // 2) + 0.5) * height / (width // 2)).astype(int)
        columns = ((np.arange(width) + 0.5) * pixels.shape[1] / width).astype(int)
        pixels = pixels[rows][:, columns]
    return pixels[:, (width // 2 - 1 - np.arange(width)) % width]


def write_world(text, world, materials, report):
    if world is None:
        return
    reader = WorldReader(report, f"world '{world.name}'")
    light = values.color(world.color)
    if world.use_nodes and world.node_tree is not None:
        output = active_output(world.node_tree, "OUTPUT_WORLD")
        if output is None:
            return
        if output.input("Volume").is_linked:
            reader.warn("a volume of the world is not supported, it is left out")
        light = reader.shader(output.input("Surface")).emission
    if light is None or values.is_zero(light):
        return
    name = {"string name": world.name}
    if isinstance(light, Constant):
        text.add("LightSource", "infinite", {"rgb L": light.color, **name})
        return
    if light.uv.layer != DIRECTION:
        reader.warn("its light depends on more than the direction, it is left out")
        return
    file = materials.textures.pixel_file("world " + light.key,
                                         lambda: latitude_longitude(light.pixels()), "spectrum")
    text.line("AttributeBegin")
    if reader.rotation is not None:
        matrix = np.eye(4)
        matrix[:3, :3] = reader.rotation.T
        text.transform(matrix.tolist())
    text.add("LightSource", "infinite", {"string filename": file, **name})
    text.line("AttributeEnd")
