"""Lamps. Powers are Blender's watts, radiances pbrt's L, with no photometric factor between them:
Cycles' radiance 1 is the pixel value 1, as is L 1 here.

Sources of the formulas: intern/cycles/scene/light.cpp and kernel/light/*.h of Blender 3.4. The
tests in tests/blender compare both programs, lamp by lamp.
  point  I = P / 4 pi; with a radius r it shines like a sphere of L = I / (pi r^2)
  spot   I = P / 4 pi along the axis, for any cone. The edge is a smoothstep of the cosine, as in
         pbrt. Before Blender 4.0 the intensity is also multiplied by the cosine.
  area   L = P / 4 A on one side (a Lambertian lamp of flux P would have P / pi A)
  sun    P is the irradiance of a surface that faces it
"""
import math

from .nodes import active_output
from .value_nodes import ValueReader

BLACK = {"string type": "diffuse", "rgb reflectance": (0, 0, 0)}


def placement(matrix):
    """Location and rotation of a matrix, and its scale."""
    from mathutils import Matrix
    location, rotation, scale = matrix.decompose()
    return Matrix.Translation(location) @ rotation.to_matrix().to_4x4(), scale


def has_cosine_in_spots():
    import bpy
    return bpy.app.version < (4, 0, 0)


def mean_cosine(end, start):
    """The mean of the cosine over a spot whose edge runs from the cosine `end` to `start`."""
    steps = 512
    cosines = [end + (1 - end) * (i + 0.5) / steps for i in range(steps)]
    edges = [min((c - end) / max(start - end, 1e-9), 1) for c in cosines]
    weights = [t * t * (3 - 2 * t) for t in edges]
    return sum(w * c for w, c in zip(weights, cosines)) / max(sum(weights), 1e-9)


class LightWriter:
    def __init__(self, text, report):
        self._text = text
        self._report = report
        self._has_material = False

    def write(self, obj, matrix):
        light, thing = obj.data, f"light '{obj.name}'"
        color = [c * factor for c, factor in zip(light.color, self._node_color(light, thing))]
        if light.type == "AREA" and getattr(light.cycles, "is_portal", False):
            return
        self._text.line("AttributeBegin")
        frame, scale = placement(matrix)
        self._text.transform(frame)
        write = {"POINT": self._point, "SPOT": self._spot, "SUN": self._sun, "AREA": self._area}
        write[light.type](light, thing, color, scale, {"string name": obj.name})
        self._text.line("AttributeEnd")

    def _node_color(self, light, thing):
        """Factors of an Emission node."""
        if not light.use_nodes or light.node_tree is None:
            return (1, 1, 1)
        reader = ValueReader(self._report, thing)
        output = active_output(light.node_tree, "OUTPUT_LIGHT")
        source = output.input("Surface").source() if output is not None else None
        if source is None:
            return (0, 0, 0)
        if source.node.type != "EMISSION":
            reader.warn(f"node '{source.node.name}' is not supported, it is left out")
            return (1, 1, 1)
        strength = reader.constant(source.node.input("Strength"), 1)
        return [c * strength for c in reader.constant_color(source.node.input("Color"))]

    def _point(self, light, thing, color, scale, name):
        intensity = light.energy / (4 * math.pi)
        radius = light.shadow_soft_size
        if radius <= 0:
            self._text.add("LightSource", "point",
                           {"rgb I": [c * intensity for c in color], **name})
            return
        radiance = intensity / (math.pi * radius ** 2)
        self._emitter([c * radiance for c in color], name)
        self._text.add("Shape", "sphere", {"float radius": radius})

    def _spot(self, light, thing, color, scale, name):
        if light.shadow_soft_size > 0.01:
            self._report.warn(thing, "the radius of a spot light is not supported, "
                                     "its shadows are sharp")
        end = light.spot_size / 2
        inner = math.cos(end) + (1 - math.cos(end)) * light.spot_blend
        intensity = light.energy / (4 * math.pi)
        if has_cosine_in_spots():
            intensity *= mean_cosine(math.cos(end), inner)
            if end > math.radians(45):
                self._report.warn(thing, "it is evenly bright here, and dimmer at its edge in "
                                         "Blender before 4.0; the flux is the same")
        delta = math.degrees(end - math.acos(min(inner, 1)))
        self._text.add("LightSource", "spot", {
            "rgb I": [c * intensity for c in color], "point3 from": (0, 0, 0),
            "point3 to": (0, 0, -1), "float coneangle": math.degrees(end),
            "float conedeltaangle": delta, **name})

    def _sun(self, light, thing, color, scale, name):
        self._text.add("LightSource", "distant", {
            "rgb L": [c * light.energy for c in color], "point3 from": (0, 0, 0),
            "point3 to": (0, 0, -1), "float angle": math.degrees(light.angle), **name})

    def _area(self, light, thing, color, scale, name):
        if getattr(light, "spread", math.pi) < math.pi - 1e-3:
            self._report.warn(thing, "the spread of an area light is not supported, 180 "
                                     "degrees are used")
        width = light.size * abs(scale.x)
        is_round = light.shape in ("DISK", "ELLIPSE")
        height = (light.size if light.shape in ("SQUARE", "DISK") else light.size_y) * abs(scale.y)
        area = width * height * (math.pi / 4 if is_round else 1)
        if area <= 0:
            self._report.warn(thing, "it has no area, it is left out")
            return
        radiance = light.energy / (4 * area)
        self._emitter([c * radiance for c in color], name)
        x, y = width / 2, height / 2
        if is_round:  # turned about x: a disk emits towards +z, an area light towards -z
            self._text.line(f"Scale {x:.9g} {-y:.9g} -1")
            self._text.add("Shape", "disk", {"float radius": 1})
        else:
            self._text.add("Shape", "bilinearmesh",
                           {"point3 P": (-x, y, 0, x, y, 0, -x, -y, 0, x, -y, 0)})

    def _emitter(self, radiance, name):
        if not self._has_material:
            self._text.add("MakeNamedMaterial", "lamp", BLACK)
            self._has_material = True
        self._text.add("NamedMaterial", "lamp")
        self._text.add("AreaLightSource", "diffuse", {"rgb L": radiance, **name})
