"""Scenes that compare materials: Principled BSDF, normal maps and bump, hair, volumes."""
import os

import bpy
import numpy as np

from scenes import camera, lamp, material, new_scene, primitive, quad, save, world


def link_image(made, image, socket, through=None):
    """Links an image to a socket of the shader, by way of a node of type `through`."""
    tree = made.node_tree
    shader = next(n for n in tree.nodes if socket in n.inputs)
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    if through is None:
        tree.links.new(texture.outputs["Color"], shader.inputs[socket])
        return None
    node = tree.nodes.new(through)
    entry = "Height" if through == "ShaderNodeBump" else "Color"
    tree.links.new(texture.outputs["Color"], node.inputs[entry])
    tree.links.new(node.outputs["Normal"], shader.inputs[socket])
    return node


def saved_image(folder, name, pixels):
    """A Non-Color PNG of height x width x 4 values, loaded from its file."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.new(name, width, height, alpha=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(pixels.astype(np.float32).ravel())
    image.filepath_raw, image.file_format = os.path.join(folder, name + ".png"), "PNG"
    image.save()
    loaded = bpy.data.images.load(image.filepath_raw)
    loaded.colorspace_settings.name = "Non-Color"
    return loaded


def roughness_image(folder):
    """Stripes of roughness in the colours; the alpha is 1/4 and must not count."""
    stripes = np.full((64, 64, 4), 0.25)
    stripes[..., :3] = np.where(np.arange(64) // 8 % 2, 0.7, 0.25)[None, :, None]
    return saved_image(folder, "roughness", stripes)


def shiny(name, **inputs):
    """A Principled BSDF whose rough metal keeps its energy, as here; 3.x has a choice."""
    made = material(name, "BsdfPrincipled", **inputs)
    made.node_tree.nodes["Principled BSDF"].distribution = "MULTI_GGX"
    return made


def table(scene, color=(0.5, 0.5, 0.5)):
    quad(scene, "table", [(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)],
         material("table", "BsdfDiffuse", Color=(*color, 1)))


def principled(folder):
    """Balls of plastic, coated and brushed metal, striped metal, glass and anisotropic metal."""
    scene = new_scene()
    table(scene)
    striped = shiny("striped", Base_Color=(0.9, 0.8, 0.5, 1), Metallic=1.0)
    link_image(striped, roughness_image(folder), "Roughness")
    brushed = shiny("brushed", Base_Color=(0.8, 0.8, 0.8, 1), Metallic=1.0,
                    Roughness=0.4, Anisotropic=0.8)
    tangent = brushed.node_tree.nodes.new("ShaderNodeTangent")
    tangent.direction_type = "UV_MAP"
    brushed.node_tree.links.new(tangent.outputs[0],
                                brushed.node_tree.nodes["Principled BSDF"].inputs["Tangent"])
    kinds = [
        shiny("plastic", Base_Color=(0.1, 0.3, 0.6, 1), Roughness=0.3),
        shiny("coated", Base_Color=(0.6, 0.1, 0.1, 1), Roughness=0.6, Clearcoat=1.0),
        striped,
        shiny("glass", Base_Color=(0.7, 0.9, 0.8, 1), Roughness=0.1,
              Transmission=1.0, IOR=1.5),
        brushed,
        shiny("gold", Base_Color=(1, 0.75, 0.35, 1), Roughness=0.2, Metallic=1.0),
    ]
    for i, kind in enumerate(kinds):
        primitive("uv_sphere", kind, radius=0.55, segments=64, ring_count=32,
                  location=(1.2 * (i % 3 - 1), 1.2 * (i // 3) - 0.5, 0.55))
    lamp(scene, "key", "AREA", (-2, -2, 3.5), 150, (0, 0, 0.3), size=1.5)
    world(scene, (1, 1, 1), 0.3)
    camera(scene, (0, -4.6, 2.6), (0, 0.1, 0.4), 45)
    save(folder, "principled")


def relief(folder):
    """Two waved squares, by a normal map and by a bump. Waves are longer than compared blocks.

    They are gentle and the lamp is high, since Cycles darkens what steep slopes would shade.
    """
    scene = new_scene()
    y, x = np.mgrid[0:256, 0:256] / 256
    phase = 2 * np.pi * 2 * x
    height = np.ones((256, 256, 4))
    height[..., :3] = (0.5 + 0.5 * np.sin(phase) * np.sin(2 * np.pi * 2 * y))[..., None]
    normals = np.zeros((256, 256, 3))
    normals[..., 0], normals[..., 2] = -0.3 * np.cos(phase), 1
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    encoded = np.concatenate([normals / 2 + 0.5, np.ones((256, 256, 1))], axis=-1)
    mapped = material("mapped", "BsdfDiffuse", Color=(0.7, 0.6, 0.5, 1))
    link_image(mapped, saved_image(folder, "normals", encoded), "Normal", "ShaderNodeNormalMap")
    bumped = material("bumped", "BsdfDiffuse", Color=(0.5, 0.6, 0.7, 1))
    bump = link_image(bumped, saved_image(folder, "height", height), "Normal", "ShaderNodeBump")
    bump.inputs["Distance"].default_value = 0.1
    for place, kind in ((-1.05, mapped), (1.05, bumped)):
        primitive("plane", kind, False, size=2, location=(place, 0, 0))
    lamp(scene, "key", "POINT", (-1, -0.7, 3), 200, shadow_soft_size=0.1)
    world(scene, (1, 1, 1), 0.1)
    camera(scene, (0, -2.6, 3.2), (0, 0, 0), 40)
    save(folder, "relief")


def in_volume(name, kind, **inputs):
    """A material without a surface, and a volume inside."""
    made = material(name, kind, **inputs)
    tree = made.node_tree
    output = tree.nodes["Material Output"]
    tree.links.remove(output.inputs["Surface"].links[0])
    tree.links.new(next(n for n in tree.nodes if n != output).outputs[0], output.inputs["Volume"])
    return made


def volumes(folder):
    """A cube of fog, one of ink, and a ball of smoke that scatters forwards."""
    scene = new_scene()
    table(scene)
    fog = in_volume("fog", "VolumeScatter", Color=(0.9, 0.8, 0.6, 1), Density=2.0)
    ink = in_volume("ink", "VolumeAbsorption", Color=(0.2, 0.5, 0.8, 1), Density=1.5)
    smoke = in_volume("smoke", "VolumePrincipled", Color=(0.6, 0.6, 0.7, 1), Density=3.0,
                      Anisotropy=0.5)
    primitive("cube", fog, False, size=1, location=(-1.3, 0, 0.51))
    primitive("cube", ink, False, size=1, location=(1.3, 0, 0.51), rotation=(0, 0, 0.4))
    primitive("uv_sphere", smoke, radius=0.55, segments=64, ring_count=32, location=(0, 0.2, 0.6))
    lamp(scene, "key", "AREA", (-2, 1.5, 3.5), 150, (0, 0, 0.3), size=1.0)
    world(scene, (1, 1, 1), 0.2)
    camera(scene, (0, -4.6, 2.2), (0, 0, 0.4), 45)
    save(folder, "volumes")


def hair(folder):
    """Three tufts from near: dark, red, and of a given colour."""
    scene = new_scene()
    table(scene, (0.3, 0.3, 0.3))
    dark = material("dark", "BsdfHairPrincipled", Melanin=0.8, Melanin_Redness=0.3)
    red = material("red", "BsdfHairPrincipled", Melanin=0.4, Melanin_Redness=0.9)
    dyed = material("dyed", "BsdfHairPrincipled", Color=(0.2, 0.5, 0.6, 1))
    for kind, parametrization in ((dark, "MELANIN"), (red, "MELANIN"), (dyed, "COLOR")):
        kind.node_tree.nodes["Principled Hair BSDF"].parametrization = parametrization
    skin = material("skin", "BsdfDiffuse", Color=(0.4, 0.3, 0.2, 1))
    for i, kind in enumerate((dark, red, dyed)):
        ball = primitive("uv_sphere", skin, radius=0.4, location=(1.1 * (i - 1), 0, 0.6))
        ball.data.materials.append(kind)
        ball.modifiers.new("tuft", "PARTICLE_SYSTEM")
        settings = ball.particle_systems[0].settings
        settings.type, settings.count, settings.hair_length = "HAIR", 2500, 0.35
        settings.material, settings.radius_scale = 2, 0.008
    lamp(scene, "key", "AREA", (-1.5, -2, 3), 120, (0, 0, 0.4), size=1.0)
    world(scene, (1, 1, 1), 0.3)
    camera(scene, (0, -4, 1.6), (0, 0, 0.5), 50)
    save(folder, "hair")


def make_all(folder):
    for make in (principled, relief, volumes, hair):
        make(folder)
