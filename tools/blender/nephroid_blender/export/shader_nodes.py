"""Nodes that give shaders. A row of SHADERS is one type of node."""
from dataclasses import replace

import numpy as np

from . import shader as shaders
from . import values
from .principled import principled, reflectance_at_normal
from .shader import BLACK, CLEAR, Shader
from .value_nodes import ValueReader
from .values import Constant, is_zero, number


EUMELANIN = np.array([0.506, 0.841, 1.653])  # Cycles' absorption, greater than pbrt's
PHEOMELANIN = np.array([0.343, 0.733, 1.924])


class ShaderReader(ValueReader):
    """Reads sockets as shaders, and as values where these are colours and numbers."""

    def shader(self, socket):
        """The shader that a socket is linked to; black without a link, as in Cycles."""
        source = socket.source() if socket is not None else None
        if source is None:
            return BLACK
        read = SHADERS.get(source.node.type)
        if read is None:
            self.warn(f"node '{source.node.name}' is not supported, a grey diffuse surface is used")
            return Shader("diffuse", {"spectrum reflectance": number(0.5)})
        found = read(self, source.node)
        return self._with_normal(found, source.node) if found.kind else found

    def _with_normal(self, found, node):
        """Adds the normal map or the bump of a node to its material."""
        socket = node.input("Normal")
        source = socket.source() if socket is not None else None
        if source is None or found.kind in ("mix", "hair", "interface"):
            return found
        parameters = dict(found.parameters)
        if source.node.type == "NORMAL_MAP":
            self._add_normal_map(source.node, parameters)
        elif source.node.type == "BUMP":
            self._add_bump(source.node, parameters)
        else:
            self.warn(f"'{source.node.name}' as a normal is not supported, it is left out")
        return replace(found, parameters=parameters)

    def check_tangent(self, node):
        """Warns where u is not the direction of an anisotropic node.

        Without a Tangent node that direction turns about the z axis of the object in Cycles.
        """
        socket = node.input("Tangent")
        source = socket.source() if socket is not None else None
        if source is None or source.node.type != "TANGENT" or \
                source.node.node.direction_type != "UV_MAP":
            self.warn(f"'{node.name}' is anisotropic along its UV map, expected a Tangent node of "
                      "type UV Map")

    def _add_normal_map(self, node, parameters):
        if node.node.space != "TANGENT":
            self.warn(f"'{node.name}' is not in tangent space, it is left out")
            return
        normals = self.color(node.input("Color"))
        if isinstance(normals, Constant):
            return
        if node.node.uv_map:
            normals = replace(normals, uv=replace(normals.uv, layer=node.node.uv_map))
        strength = self.constant(node.input("Strength"), 1)
        if strength != 1:
            normals = values.apply(normals, f"strength{strength}",
                                   lambda c: _flattened(c, strength))
        parameters["normalmap"] = normals

    def _add_bump(self, node, parameters):
        """Cycles' bump is the height times Distance; a Strength below 1 flattens it."""
        height = self.number(node.input("Height"))
        if isinstance(height, Constant):
            return
        scale = self.constant(node.input("Distance"), 1) * self.constant(node.input("Strength"), 1)
        if node.node.invert:
            scale = -scale
        if node.input("Normal").is_linked:
            self.warn(f"'{node.name}': its Normal is left out, the bump is used")
        parameters["float displacement"] = values.apply(
            height, f"height{scale}", lambda c: values.luminance(c) * scale)


def _flattened(colors, strength):
    normals = 2 * colors - 1
    mixed = np.array([0, 0, 1]) * (1 - strength) + normals * strength
    return mixed / np.linalg.norm(mixed, axis=-1, keepdims=True) / 2 + 0.5


def _alpha(reader, node):
    """The GGX alpha of a roughness, which is its square in Cycles."""
    return values.apply(reader.number(node.input("Roughness")), "square",
                        lambda c: values.luminance(c) ** 2)


def _diffuse(reader, node):
    color = reader.color(node.input("Color"))
    roughness = reader.number(node.input("Roughness"))
    if is_zero(roughness):
        return Shader("diffuse", {"spectrum reflectance": color})
    return Shader("principled", {"spectrum base_color": color, "float specular_weight": number(0),
                                 "float base_diffuse_roughness": roughness})


def _glass(reader, node):
    """Cycles' colour tints both reflection and refraction at each surface."""
    color = reader.color(node.input("Color"), (1, 1, 1))
    ior = reader.constant(node.input("IOR"), 1.45)
    if values.is_one(color):
        return Shader("dielectric", {"float eta": ior, "float roughness": _alpha(reader, node),
                                     "bool remaproughness": False})
    return Shader("principled", {
        "float transmission_weight": number(1), "spectrum transmission_color": color,
        "spectrum specular_color": color, "float specular_ior": number(ior),
        "float specular_roughness": reader.number(node.input("Roughness"))})


def _refraction(reader, node):
    reader.warn("Refraction BSDF is rendered as Glass BSDF, with its reflection")
    return _glass(reader, node)


def _stretch(anisotropy):
    """Cycles' factor of alpha along u; alpha along v is divided by it."""
    a = min(max(anisotropy, -0.99), 0.99)
    return 1 / (1 + a) if a < 0 else 1 - a


def _glossy(reader, node):
    parameters = {"spectrum reflectance": reader.color(node.input("Color")),
                  "bool remaproughness": False}
    alpha = _alpha(reader, node)
    anisotropy = reader.constant(node.input("Anisotropy"))
    if anisotropy == 0:
        parameters["float roughness"] = alpha
    else:
        reader.check_tangent(node)
        if reader.constant(node.input("Rotation")) != 0:
            reader.warn("Rotation of an anisotropic surface is not supported, it is taken as 0")
        along = _stretch(anisotropy)
        parameters["float uroughness"] = values.apply(alpha, f"u{along}", lambda x: x * along)
        parameters["float vroughness"] = values.apply(alpha, f"v{along}", lambda x: x / along)
    return Shader("conductor", parameters)


def _emission(reader, node):
    color = reader.color(node.input("Color"), (1, 1, 1))
    light = reader.combined(color, reader.number(node.input("Strength"), 1), "multiply",
                            lambda a, b: a * b)
    return Shader(emission=light)


def _transparent(reader, node):
    color = reader.color(node.input("Color"), (1, 1, 1))
    if values.is_one(color):
        return CLEAR
    reader.warn("the colour of a Transparent BSDF is not supported, its luminance is used as "
                "transparency")
    opacity = values.apply(color, "opacity", lambda c: 1 - values.luminance(c))
    return Shader(opacity=opacity)


def _translucent(reader, node):
    return Shader("diffusetransmission", {"spectrum reflectance": number(0),
                                          "spectrum transmittance": reader.color(
                                              node.input("Color"))})


def _subsurface(reader, node):
    radius = reader.constant_color(node.input("Radius"), (1, 0.2, 0.1))
    scale = reader.constant(node.input("Scale"), 1)
    return Shader("subsurface", {
        "spectrum reflectance": reader.color(node.input("Color")),
        "spectrum mfp": values.color([max(r * scale, 1e-6) for r in radius]),
        "float eta": reader.constant(node.input("IOR"), 1.4)})


def _sheen(reader, node):
    reader.warn(f"'{node.name}' is rendered as the fuzz of OpenPBR, whose lobe differs from that "
                "of Cycles")
    color = reader.color(node.input("Color"))
    return Shader("principled", {
        "float base_weight": number(0), "float specular_weight": number(0),
        "float fuzz_weight": number(1), "spectrum fuzz_color": color,
        "float fuzz_roughness": reader.number(node.input("Roughness", "Sigma"), 0.5)})


def _pigment_absorption(reader, node):
    """Cycles' absorption of melanin m, which is -log(1 - m) of pigment shared by redness, and tint.

    The tint is a reflectance, as the colour of the hair would be (Chiang et al. 2016).
    """
    pigment = -np.log(max(1 - reader.constant(node.input("Melanin"), 0.8), 1e-4))
    redness = reader.constant(node.input("Melanin Redness"), 1)
    b = reader.constant(node.input("Radial Roughness"), 0.3)
    scale = np.polyval((0.245, 5.574, -10.73, 2.532, -0.215, 5.969), b)
    tint = np.clip(reader.constant_color(node.input("Tint")), 1e-20, 1)
    return (pigment * (1 - redness) * EUMELANIN + pigment * redness * PHEOMELANIN +
            (np.log(tint) / scale) ** 2)


def _hair(reader, node):
    parameters = {"float eta": number(reader.constant(node.input("IOR"), 1.55)),
                  "float beta_m": number(reader.constant(node.input("Roughness"), 0.3)),
                  "float beta_n": number(reader.constant(node.input("Radial Roughness"), 0.3)),
                  "float alpha": number(reader.constant(node.input("Offset"), 0.0349) * 57.29578)}
    for name in ("Coat", "Random Color", "Random Roughness"):
        if not is_zero(reader.number(node.input(name))):
            reader.warn(f"'{name}' of '{node.name}' is not supported, it is taken as 0")
    kind = node.node.parametrization
    if kind == "ABSORPTION":
        sigma = reader.constant_color(node.input("Absorption Coefficient"))
        parameters["spectrum sigma_a"] = values.color(sigma)
    elif kind == "MELANIN":
        parameters["spectrum sigma_a"] = values.color(_pigment_absorption(reader, node))
    else:
        parameters["spectrum reflectance"] = reader.color(node.input("Color"))
    return Shader("hair", parameters)


def _mix(reader, node):
    first, second = (s for s in node.inputs() if s.socket.type == "SHADER")
    factor = node.input("Fac")
    source = factor.source()
    if source is not None and source.node.type == "LIGHT_PATH":
        reader.warn(f"'{source.node.name}' is not supported: '{node.name}' shows its first shader "
                    "to all rays. Glass needs no such switch here")
        return reader.shader(first)
    if source is not None and source.node.type in ("FRESNEL", "LAYER_WEIGHT"):
        return _mix_by_fresnel(reader, node, source.node, reader.shader(first),
                               reader.shader(second))
    return shaders.mix(reader.shader(first), reader.shader(second), reader.number(factor, 0.5),
                       reader)


def _mix_by_fresnel(reader, node, source, base, gloss):
    """Diffuse below a Fresnel-weighted glossy shader is the principled surface of that index."""
    if source.type == "FRESNEL":
        ior = reader.constant(source.input("IOR"), 1.45)
    else:
        ior = 1 / max(1 - reader.constant(source.input("Blend"), 0.5), 1e-3)
    if base.kind == "diffuse" and gloss.kind == "conductor":
        alpha = gloss.parameters.get("float roughness", number(0))
        return replace(base, kind="principled", parameters={
            "spectrum base_color": base.parameters["spectrum reflectance"],
            "spectrum specular_color": gloss.parameters["spectrum reflectance"],
            "float specular_roughness": values.apply(alpha, "root", np.sqrt),
            "float specular_ior": number(ior)})
    reader.warn(f"'{node.name}' mixes by the angle of view: its reflectance at normal incidence "
                "is used for all angles")
    return shaders.mix(base, gloss, number(reflectance_at_normal(ior)), reader)


def _add(reader, node):
    first, second = node.inputs()
    return shaders.add(reader.shader(first), reader.shader(second), reader)


def _background(reader, node):
    return _emission(reader, node)


SHADERS = {
    "BSDF_PRINCIPLED": principled, "BSDF_DIFFUSE": _diffuse, "BSDF_GLASS": _glass,
    "BSDF_REFRACTION": _refraction, "BSDF_GLOSSY": _glossy, "BSDF_ANISOTROPIC": _glossy,
    "EMISSION": _emission, "BACKGROUND": _background, "BSDF_TRANSPARENT": _transparent,
    "BSDF_TRANSLUCENT": _translucent, "SUBSURFACE_SCATTERING": _subsurface,
    "BSDF_VELVET": _sheen, "BSDF_SHEEN": _sheen, "BSDF_HAIR_PRINCIPLED": _hair,
    "MIX_SHADER": _mix, "ADD_SHADER": _add,
}
