"""Objects and instances of an evaluated depsgraph.

A geometry that occurs once is a shape under its transform, one that occurs more often is an object
with instances. Geometry that emits is repeated, since instances do not emit.
"""
from dataclasses import dataclass, field

from .hair import write_curves, write_particle_hair
from .lights import LightWriter
from .materials import MaterialWriter
from .meshes import MeshWriter
from .pbrt_text import quoted

WITH_MESH = {"MESH", "CURVE", "SURFACE", "META", "FONT"}
WITHOUT_PICTURE = {"EMPTY", "ARMATURE", "LATTICE", "CAMERA", "SPEAKER", "LIGHT_PROBE"}


@dataclass
class Geometry:
    name: str
    parts: list  # of (PLY file, surface)
    places: list = field(default_factory=list)  # of (matrix, matrix at the end or None)

    @property
    def emits(self):
        return any(surface.emits for _, surface in self.parts)


def place_key(instance):
    """Tells the same instance at two times."""
    parent = instance.parent.name_full if instance.parent else ""
    return instance.object.name_full, parent, tuple(instance.persistent_id)


def matrices(depsgraph):
    """The matrix of each instance, to be compared with those at another time."""
    return {place_key(i): i.matrix_world.copy() for i in depsgraph.object_instances
            if i.show_self and i.object.type in WITH_MESH}


class ObjectWriter:
    def __init__(self, text, folder, report, for_viewport):
        self._text = text
        self._report = report
        self._for_viewport = for_viewport
        self.materials = MaterialWriter(text, folder, report)
        self._meshes = MeshWriter(folder, self.materials, report)
        self._lights = LightWriter(text, report)
        self._geometries = {}

    def write(self, depsgraph, at_open=None, at_close=None):
        """Writes all objects. The matrices at both ends of the shutter may be given."""
        for instance in depsgraph.object_instances:
            self._take(instance, at_open or {}, at_close or {})
        for geometry in self._geometries.values():
            self._write_geometry(geometry)

    def _take(self, instance, at_open, at_close):
        obj, kind = instance.object, instance.object.type
        if instance.show_particles and obj.particle_systems:
            write_particle_hair(self._text, obj, self.materials, self._report, self._for_viewport)
        if not instance.show_self or kind in WITHOUT_PICTURE:
            return
        if kind == "LIGHT":
            self._lights.write(obj, instance.matrix_world)
        elif kind == "CURVES":
            write_curves(self._text, obj, instance.matrix_world, self.materials, self._report)
        elif kind in WITH_MESH:
            key = place_key(instance)
            begin = at_open.get(key, instance.matrix_world).copy()
            end = at_close[key].copy() if key in at_close and key in at_open else None
            self._geometry(obj).places.append((begin, end))
        else:
            self._report.warn(f"object '{obj.name}'", f"type {kind} is not supported, it is left "
                                                      "out")

    def _geometry(self, obj):
        """The geometry of an object, shared by all objects with its data and materials."""
        materials = tuple(s.material.name_full if s.material else "" for s in obj.material_slots)
        owner = obj.data if obj.data is not None else obj
        key = (owner.as_pointer(), materials)
        if key not in self._geometries:
            name = f"{obj.name} {len(self._geometries)}"
            self._geometries[key] = Geometry(name, self._meshes.parts(obj))
        return self._geometries[key]

    def _write_geometry(self, geometry):
        if not geometry.parts:
            return
        if len(geometry.places) > 1 and not geometry.emits:
            self._text.add("ObjectBegin", geometry.name)
            self._write_shapes(geometry)
            self._text.line("ObjectEnd")
            for matrix, at_close in geometry.places:
                self._text.line("AttributeBegin")
                self._text.transform(matrix, at_close)
                self._text.add("ObjectInstance", geometry.name)
                self._text.line("AttributeEnd")
            return
        for matrix, at_close in geometry.places:
            self._text.line("AttributeBegin")
            self._text.transform(matrix, at_close)
            self._write_shapes(geometry)
            self._text.line("AttributeEnd")

    def _write_shapes(self, geometry):
        for path, surface in geometry.parts:
            self._text.line("AttributeBegin")
            self._text.line("NamedMaterial " + quoted(surface.material))
            if surface.inside:
                self._text.add("MediumInterface", (surface.inside, ""))
            if surface.emits:
                self._write_emission(surface)
            parameters = {"string filename": path}
            if surface.alpha is not None:
                parameters[surface.alpha[0]] = surface.alpha[1]
            self._text.add("Shape", "plymesh", parameters)
            self._text.line("AttributeEnd")

    def _write_emission(self, surface):
        """Meshes of Cycles emit on both sides."""
        parameters = {"bool twosided": True, "string name": surface.material}
        if hasattr(surface.emission, "color"):
            parameters["rgb L"] = surface.emission.color
        else:
            grid = surface.emission
            if grid.uv != surface.uv:
                self._report.warn(f"material '{surface.material}'", "the mapping of its emission "
                                  "texture is not supported and is left out")
            parameters["string filename"] = self.materials.textures.color_file(grid, "sRGB")
        self._text.add("AreaLightSource", "diffuse", parameters)
