"""Blender's Principled BSDF, of 3.x and of 4.x, as `Material "principled"` of OpenPBR 1.1."""
import math

import numpy as np

from . import values
from .shader import Shader
from .values import Constant, is_zero, number


def reflectance_at_normal(ior):
    return ((ior - 1) / (ior + 1)) ** 2


def ior_of_specular(specular):
    """The index whose reflection at normal incidence is 0.08 `specular` (Burley 2012)."""
    root = math.sqrt(min(max(0.08 * specular, 0), 0.99))
    return (1 + root) / (1 - root)


def principled(reader, node):
    """The shader without normal and bump, which shader_nodes adds."""
    is_new = node.input("Specular IOR Level") is not None
    parameters = {
        "spectrum base_color": reader.color(node.input("Base Color")),
        "float base_metalness": reader.number(node.input("Metallic")),
        "float specular_roughness": reader.number(node.input("Roughness"), 0.5),
    }
    (_specular_of_4 if is_new else _specular_of_3)(reader, node, parameters)
    _subsurface(reader, node, parameters, is_new)
    _coat(reader, node, parameters, is_new)
    _sheen(reader, node, parameters, is_new)
    _anisotropy(reader, node, parameters)
    strength = reader.number(node.input("Emission Strength"), 0)
    color = reader.color(node.input("Emission Color", "Emission"), (0, 0, 0))
    emission = reader.combined(color, strength, "multiply", lambda a, b: a * b)
    return Shader("principled", parameters, None if is_zero(emission) else emission,
                  reader.number(node.input("Alpha"), 1))


def _specular_of_3(reader, node, p):
    """3.x: "IOR" is that of transmission, "Specular" that of reflection without it."""
    transmission = reader.number(node.input("Transmission"))
    if is_zero(transmission):
        p["float specular_ior"] = number(ior_of_specular(reader.constant(node.input("Specular"))))
        return
    p["float specular_ior"] = number(reader.constant(node.input("IOR"), 1.45))
    p["float transmission_weight"] = transmission
    # Cycles tints each refraction by the whole base colour.
    p["spectrum transmission_color"] = p["spectrum base_color"]
    if reader.constant(node.input("Transmission Roughness")) > 0:
        reader.warn("Transmission Roughness is not supported, Roughness is used")


def _specular_of_4(reader, node, p):
    """4.x: "Specular IOR Level" scales the reflection at normal incidence, 0.5 leaves it."""
    ior = reader.constant(node.input("IOR"), 1.5)
    level = reader.constant(node.input("Specular IOR Level"), 0.5)
    scaled = 2 * level * reflectance_at_normal(ior)
    p["float specular_ior"] = number(ior_of_specular(scaled / 0.08) if level != 0.5 else ior)
    p["spectrum specular_color"] = reader.color(node.input("Specular Tint"), (1, 1, 1))
    p["float base_diffuse_roughness"] = reader.number(node.input("Diffuse Roughness"))
    transmission = reader.number(node.input("Transmission Weight"))
    if not is_zero(transmission):
        p["float transmission_weight"] = transmission
        # Cycles tints each refraction by the root, so that two give the base colour.
        p["spectrum transmission_color"] = values.apply(
            p["spectrum base_color"], "root", lambda c: np.sqrt(np.maximum(c, 0)))
    thickness = reader.constant(node.input("Thin Film Thickness"))  # nanometres
    if thickness > 0:
        p["float thin_film_weight"] = number(1)
        p["float thin_film_thickness"] = number(thickness / 1000)
        p["float thin_film_ior"] = number(reader.constant(node.input("Thin Film IOR"), 1.33))


def _subsurface(reader, node, p, is_new):
    weight = reader.number(node.input("Subsurface Weight", "Subsurface"))
    if is_zero(weight):
        return
    radius = reader.color(node.input("Subsurface Radius"), (1, 0.2, 0.1))
    if not isinstance(radius, Constant):
        reader.warn("'Subsurface Radius' cannot vary over a surface, 1 0.2 0.1 is used")
        radius = values.color((1, 0.2, 0.1))
    longest = max(max(radius.color), 1e-6)
    scale = reader.constant(node.input("Subsurface Scale"), 1)
    p["float subsurface_weight"] = weight
    p["spectrum subsurface_color"] = p["spectrum base_color"] if is_new else \
        reader.color(node.input("Subsurface Color"))
    p["float subsurface_radius"] = number(longest * scale)
    p["spectrum subsurface_radius_scale"] = values.color([c / longest for c in radius.color])
    p["float subsurface_scatter_anisotropy"] = number(
        reader.constant(node.input("Subsurface Anisotropy")))


def _coat(reader, node, p, is_new):
    weight = reader.number(node.input("Coat Weight", "Clearcoat"))
    if is_zero(weight):
        return
    if not is_new:  # a quarter at most, and index 1.5, as in Burley 2012
        weight = values.apply(weight, "quarter", lambda w: w / 4)
    p["float coat_weight"] = weight
    p["float coat_roughness"] = reader.number(node.input("Coat Roughness", "Clearcoat Roughness"))
    p["float coat_ior"] = number(reader.constant(node.input("Coat IOR"), 1.5))
    p["spectrum coat_color"] = reader.color(node.input("Coat Tint"), (1, 1, 1))
    # Cycles' coat neither darkens what is below nor changes its reflectance and roughness.
    p["float coat_darkening"] = number(0)
    p["bool coat_affects_specular"] = False


def _sheen(reader, node, p, is_new):
    weight = reader.number(node.input("Sheen Weight", "Sheen"))
    if is_zero(weight):
        return
    p["float fuzz_weight"] = weight
    if is_new:
        p["spectrum fuzz_color"] = reader.color(node.input("Sheen Tint"), (1, 1, 1))
        p["float fuzz_roughness"] = reader.number(node.input("Sheen Roughness"), 0.5)
    else:
        p["spectrum fuzz_color"] = reader.mixed(number(1), p["spectrum base_color"],
                                                reader.number(node.input("Sheen Tint")))
        p["float fuzz_roughness"] = number(0.5)


def _anisotropy(reader, node, p):
    """Cycles' alphas are r^2 / aspect and r^2 aspect, with aspect^2 = 1 - 0.9 anisotropic.

    OpenPBR's have the mean square r^4, so its roughness is greater.
    """
    anisotropic = reader.number(node.input("Anisotropic"))
    if is_zero(anisotropic):
        return
    reader.check_tangent(node)
    if not is_zero(reader.number(node.input("Anisotropic Rotation"))):
        reader.warn("Anisotropic Rotation is not supported, it is taken as 0")
    p["float specular_roughness_anisotropy"] = values.apply(anisotropic, "aspect",
                                                            lambda a: 0.9 * a)
    p["float specular_roughness"] = reader.combined(p["float specular_roughness"], anisotropic,
                                                    "openpbr", _roughness_of_openpbr)


def _roughness_of_openpbr(roughness, anisotropic):
    across = 1 - 0.9 * values.luminance(anisotropic)
    factor = ((1 + across ** 2) / (2 * across)) ** 0.25
    return np.minimum(values.luminance(roughness) * factor, 1)
