"""Writes values as parameters and Texture directives, and pixels as image files."""
import os

import numpy as np

from . import values
from .pfm import write_pfm
from .values import Constant, Grid

WRAPS = {"REPEAT": "repeat", "EXTEND": "clamp", "CLIP": "black"}


class TextureWriter:
    def __init__(self, text, folder, report):
        self._text = text
        self._folder = folder
        self._report = report
        self._files = {}
        self._textures = {}

    def parameter(self, key, value, uv, thing):
        """The parameter "float NAME" or "spectrum NAME" of a value, as a (key, value) pair.

        `uv` are the coordinates that the mesh has.
        """
        kind, name = key.split(" ", 1)
        if isinstance(value, Constant):
            if kind == "float":
                return key, value.number
            return "rgb " + name, value.color
        return "texture " + name, self._texture(kind, value, uv, thing)

    def image_file(self, grid, kind):
        """File and encoding of the pixels; written unless there is such a file already.

        A number is the luminance, which the program reads from files of one channel only: of others
        it takes the alpha, or the mean of the channels.
        """
        source = grid.source
        if source is not None and (kind == "spectrum" or source.is_grey):
            return source.path, source.encoding
        return self.pixel_file(grid.key, grid.pixels, kind), None

    def color_file(self, grid, read_as):
        """The file of colours, where the program reads bytes as "sRGB" or "linear"."""
        source = grid.source
        if source is not None and source.encoding in (None, read_as):
            return source.path
        return self.pixel_file(grid.key, grid.pixels, "spectrum")

    def pixel_file(self, key, pixels, kind):
        if (key, kind) not in self._files:
            found = pixels()
            if kind == "float":
                found = np.ascontiguousarray(values.luminance(found)[..., 0])
            name = f"images/{len(self._files)}.pfm"
            write_pfm(os.path.join(self._folder, name), found)
            self._files[key, kind] = name
        return self._files[key, kind]

    def _texture(self, kind, grid, uv, thing):
        key = (kind, grid.key, grid.uv, uv, grid.extension, grid.closest)
        if key not in self._textures:
            self._textures[key] = f"texture {len(self._textures)}"
            parameters = self._image_parameters(kind, grid)
            parameters.update(self._mapping(grid, uv, thing))
            self._text.add("Texture", (self._textures[key], kind, "imagemap"), parameters)
        return self._textures[key]

    def _image_parameters(self, kind, grid):
        path, encoding = self.image_file(grid, kind)
        parameters = {"string filename": path}
        if encoding is not None and path.lower().endswith(".png"):  # JPEG is sRGB without it
            parameters["string encoding"] = encoding
        if grid.extension != "REPEAT":
            parameters["string wrap"] = WRAPS.get(grid.extension, "repeat")
        if grid.closest:
            parameters["string filter"] = "point"
        return parameters

    def _mapping(self, grid, uv, thing):
        """Scale and shift from the mesh's coordinates to those of the grid."""
        if grid.uv == uv:
            return {}
        if grid.uv.layer != uv.layer:
            used = f"'{uv.layer}'" if uv.layer else "the active one"
            self._report.warn(thing, f"its textures have two UV maps, {used} is used for all")
        matrix = grid.uv.array() @ np.linalg.pinv(uv.array())
        if abs(matrix[0, 1]) + abs(matrix[1, 0]) > 1e-6 * abs(matrix[:2, :2]).max():
            self._report.warn(thing, "its textures are rotated differently, one rotation is left "
                                     "out")
        return {"float uscale": matrix[0, 0], "float vscale": matrix[1, 1],
                "float udelta": matrix[0, 2], "float vdelta": matrix[1, 2]}


def grids_of(shader):
    """All grids of a shader, the one of its normal map first: that has no mapping in pbrt."""
    own = [v for key, v in shader.parameters.items() if isinstance(v, Grid) and key == "normalmap"]
    own += [v for key, v in shader.parameters.items() if isinstance(v, Grid) and key != "normalmap"]
    own += [v for v in (shader.emission, shader.opacity) if isinstance(v, Grid)]
    for part in shader.mixed:
        own += grids_of(part)
    return own


def mesh_uv(shader):
    """The coordinates to write with a mesh: mapped where a texture directive could not do it."""
    grids = grids_of(shader)
    if not grids:
        return values.Uv()
    if "normalmap" in shader.parameters or isinstance(shader.emission, Grid):
        return (shader.parameters.get("normalmap") or shader.emission).uv
    turned = [g.uv for g in grids if g.uv.matrix[0][1] or g.uv.matrix[1][0]]
    return turned[0] if turned else values.Uv(grids[0].uv.layer)
