"""Materials of Blender as named pbrt materials, with what their shapes need besides."""
from dataclasses import dataclass
from typing import Optional

from . import values
from .nodes import active_output
from .shader import Shader
from .shader_nodes import ShaderReader
from .textures import TextureWriter, mesh_uv
from .values import Constant, Grid
from .volume_nodes import read_volume


@dataclass
class Surface:
    """What a shape of a material says before and in its Shape directive."""
    material: str
    uv: values.Uv
    emission: object = None  # Constant or Grid
    alpha: Optional[tuple] = None  # a parameter, key and value
    inside: str = ""  # name of the medium

    @property
    def emits(self):
        return self.emission is not None


class MaterialWriter:
    """Writes each material once, before its first shape."""

    def __init__(self, text, folder, report):
        self._text = text
        self._report = report
        self.textures = TextureWriter(text, folder, report)
        self._surfaces = {}
        self._names = set()

    def surface(self, material):
        key = material.name_full if material is not None else None
        if key not in self._surfaces:
            self._surfaces[key] = self._made(material)
        return self._surfaces[key]

    def _made(self, material):
        name = self._new_name(material.name if material is not None else "default")
        thing = f"material '{name}'"
        shader, medium = self._read(material, thing)
        uv = mesh_uv(shader)
        surface = Surface(name, uv)
        if medium is not None:
            surface.inside = self._write_medium(name, medium)
        if shader.emission is not None and not values.is_zero(shader.emission):
            surface.emission = shader.emission
        if shader.is_clear:
            self._text.add("MakeNamedMaterial", name, {"string type": "interface"})
            surface.emission = None
            return surface
        if not values.is_one(shader.opacity):
            surface.alpha = self.textures.parameter("float alpha", shader.opacity, uv, thing)
        self._write(name, shader, uv, thing)
        return surface

    def _read(self, material, thing):
        """The shader and the medium of a material."""
        if material is None:
            return Shader("diffuse", {"spectrum reflectance": values.number(0.8)}), None
        if not material.use_nodes or material.node_tree is None:
            color = values.color(material.diffuse_color)
            return Shader("diffuse", {"spectrum reflectance": color}), None
        reader = ShaderReader(self._report, thing)
        output = active_output(material.node_tree, "OUTPUT_MATERIAL")
        if output is None:
            return Shader(), None
        displacement = output.input("Displacement")
        if displacement is not None and displacement.is_linked:
            reader.warn("Displacement is not supported, it is left out")
        medium = read_volume(reader, output.input("Volume"))
        surface = output.input("Surface")
        if medium is not None and not surface.is_linked:
            return Shader(opacity=values.number(0)), medium
        return reader.shader(surface), medium

    def _new_name(self, wanted):
        name, i = wanted, 1
        while name in self._names:
            i += 1
            name = f"{wanted} {i}"
        self._names.add(name)
        return name

    def _write_medium(self, name, medium):
        parameters = {"string type": "homogeneous", "rgb sigma_a": tuple(medium.absorption),
                      "rgb sigma_s": tuple(medium.scattering)}
        if medium.g:
            parameters["float g"] = medium.g
        self._text.add("MakeNamedMedium", name, parameters)
        return name

    def _write(self, name, shader, uv, thing):
        parameters = {"string type": shader.kind or "diffuse"}
        if shader.kind is None:
            parameters["rgb reflectance"] = (0, 0, 0)
        if shader.mixed:
            parts = [self._new_name(f"{name} {letter}") for letter in "ab"]
            for part, inner in zip(parts, shader.mixed):
                self._write(part, inner, uv, thing)
            parameters["string materials"] = parts
        for key, value in shader.parameters.items():
            if key == "normalmap":
                parameters["string normalmap"] = self._normal_map(value, uv, thing)
            elif isinstance(value, (Constant, Grid)):
                key, value = self.textures.parameter(key, value, uv, thing)
                parameters[key] = value
            else:
                parameters[key] = value
        self._text.add("MakeNamedMaterial", name, parameters)

    def _normal_map(self, grid, uv, thing):
        if grid.uv != uv:
            self._report.warn(thing, "its normal maps have different mappings, one mapping is left "
                                     "out")
        return self.textures.color_file(grid, "linear")
