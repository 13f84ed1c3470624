"""Makes the .blend files of `make test-blender`. Runs in Blender: scenes.py -- FOLDER"""
import math
import os
import sys

import bpy
import numpy as np

WIDTH, HEIGHT = 240, 160


def new_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Standard"
    return scene


def save(folder, name):
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, name + ".blend"))


def camera(scene, location, target, lens=35):
    data = bpy.data.cameras.new("Camera")
    data.lens = lens
    obj = bpy.data.objects.new("Camera", data)
    scene.collection.objects.link(obj)
    obj.location = location
    aim(obj, target)
    scene.camera = obj
    return data


def aim(obj, target):
    from mathutils import Vector
    direction = Vector(target) - Vector(obj.location)
    obj.rotation_euler = direction.to_track_quat("-Z", "Y").to_euler()


def lamp(scene, name, kind, location, energy, target=None, color=(1, 1, 1), **settings):
    data = bpy.data.lights.new(name, kind)
    data.energy, data.color = energy, color
    for key, value in settings.items():
        setattr(data, key, value)
    obj = bpy.data.objects.new(name, data)
    scene.collection.objects.link(obj)
    obj.location = location
    if target is not None:
        aim(obj, target)
    return obj


def world(scene, color, strength=1.0):
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*color, 1)
    background.inputs["Strength"].default_value = strength


def material(name, kind, **inputs):
    """A material of one shader node; inputs by name with _ for a blank."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    node = tree.nodes.new("ShaderNode" + kind)
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return made


def mesh(scene, name, vertices, faces, of_material):
    data = bpy.data.meshes.new(name)
    data.from_pydata(vertices, [], faces)
    data.materials.append(of_material)
    obj = bpy.data.objects.new(name, data)
    scene.collection.objects.link(obj)
    return obj


def quad(scene, name, corners, of_material):
    return mesh(scene, name, corners, [(0, 1, 2, 3)], of_material)


def primitive(kind, of_material, smooth=True, **settings):
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**settings)
    obj = bpy.context.object
    obj.data.materials.append(of_material)
    if smooth:
        obj.data.polygons.foreach_set("use_smooth", [True] * len(obj.data.polygons))
    return obj


def room(scene):
    """A room 4 m wide without a front wall and ceiling, with all kinds of lamps."""
    def diffuse(name, color):
        return material(name, "BsdfDiffuse", Color=(*color, 1))
    white = diffuse("white", (0.7, 0.7, 0.7))
    quad(scene, "floor", [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], white)
    quad(scene, "back", [(-2, 2, 0), (2, 2, 0), (2, 2, 3), (-2, 2, 3)], white)
    quad(scene, "left", [(-2, -2, 0), (-2, 2, 0), (-2, 2, 3), (-2, -2, 3)],
         diffuse("red", (0.6, 0.1, 0.08)))
    quad(scene, "right", [(2, -2, 0), (2, 2, 0), (2, 2, 3), (2, -2, 3)],
         diffuse("green", (0.1, 0.5, 0.12)))
    primitive("cube", diffuse("blue", (0.15, 0.2, 0.6)), False, size=0.8,
              location=(-0.7, 0.5, 0.4), rotation=(0, 0, 0.5))
    primitive("uv_sphere", diffuse("yellow", (0.7, 0.6, 0.1)), radius=0.45, segments=64,
              ring_count=32, location=(0.8, 0.3, 0.45))


LAMPS = {
    "point": lambda s: lamp(s, "point", "POINT", (-1, -0.5, 2.2), 60, color=(1, 0.8, 0.6),
                            shadow_soft_size=0.0),
    "ball": lambda s: lamp(s, "ball", "POINT", (1.2, -1.2, 3.3), 70, shadow_soft_size=0.1),
    "spot": lambda s: lamp(s, "spot", "SPOT", (0, -1.6, 3.2), 400, (0.3, 0.6, 0), (0.6, 0.8, 1),
                           spot_size=math.radians(50), spot_blend=0.3, shadow_soft_size=0),
    "sun": lambda s: lamp(s, "sun", "SUN", (0, 0, 5), 1.5, (1.2, 1.6, 0), (1, 0.95, 0.8), angle=0),
    "soft": lambda s: lamp(s, "soft", "SUN", (0, 0, 5), 1, (-1, 1.8, 0), (0.8, 0.9, 1),
                           angle=math.radians(15)),
    "area": lambda s: lamp(s, "area", "AREA", (-1.2, -1.9, 3.2), 80, (0, 0, 0.5),
                           shape="RECTANGLE", size=0.8, size_y=0.3),
    "disk": lambda s: lamp(s, "disk", "AREA", (1.2, 0.6, 3.9), 70, (0, 0, 0), (1, 0.5, 0.5),
                           shape="DISK", size=0.5),
    "panel": lambda s: quad(s, "panel", [(-0.5, 1.2, 2.6), (0.5, 1.2, 2.6), (0.5, 1.6, 2.5),
                                         (-0.5, 1.6, 2.5)],
                            material("panel", "Emission", Color=(0.5, 1, 0.7, 1), Strength=12)),
    "world": lambda s: world(s, (0.5, 0.7, 1.0), 0.3),
}


def diffuse_room(folder, name="diffuse", lamps=tuple(LAMPS)):
    scene = new_scene()
    room(scene)
    camera(scene, (0, -5.2, 1.5), (0, 0, 1.2))
    for which in lamps:
        LAMPS[which](scene)
    save(folder, name)


def caustics(folder):
    """A glass ball, a gold ring and a solid of coloured glass under a small lamp."""
    scene = new_scene()
    quad(scene, "table", [(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)],
         material("table", "BsdfDiffuse", Color=(0.6, 0.55, 0.5, 1)))
    primitive("uv_sphere", material("glass", "BsdfGlass", IOR=1.5), radius=0.5, segments=128,
              ring_count=64, location=(-0.9, 0, 0.52))
    gold = material("gold", "BsdfGlossy", Color=(1, 0.75, 0.35, 1), Roughness=0.15)
    primitive("cylinder", gold, radius=0.7, depth=0.35, vertices=128, location=(0.8, 0, 0.18),
              end_fill_type="NOTHING")
    tinted = material("tinted", "BsdfGlass", IOR=1.5)
    volume = tinted.node_tree.nodes.new("ShaderNodeVolumeAbsorption")
    volume.inputs["Color"].default_value = (0.2, 0.6, 0.9, 1)
    volume.inputs["Density"].default_value = 2.5
    tinted.node_tree.links.new(volume.outputs[0],
                               tinted.node_tree.nodes["Material Output"].inputs["Volume"])
    primitive("uv_sphere", tinted, radius=0.3, segments=96, ring_count=48,
              location=(-0.2, -0.9, 0.31))
    lamp(scene, "key", "POINT", (-2.2, 1.5, 2.6), 120, shadow_soft_size=0.08)
    world(scene, (1, 1, 1), 0.08)
    camera(scene, (0, -4.2, 2.4), (0, 0, 0.2), 45)
    save(folder, "caustics")


def varnish(folder):
    """A black varnished plate under an even sky: the picture is the reflectance of coat and base."""
    scene = new_scene()
    plate = material("varnish", "BsdfPrincipled", Base_Color=(0, 0, 0, 1), Roughness=0.6)
    inputs = plate.node_tree.nodes["Principled BSDF"].inputs
    inputs["Coat Weight" if "Coat Weight" in inputs else "Clearcoat"].default_value = 1
    quad(scene, "plate", [(-50, -50, 0), (50, -50, 0), (50, 50, 0), (-50, 50, 0)], plate)
    world(scene, (1, 1, 1))
    camera(scene, (0, -3, 3), (0, 0, 0))
    save(folder, "varnish")


def checked_image(folder):
    """A picture with a corner to tell up, down, left and right by."""
    size = 64
    pixels = np.ones((size, size, 4), dtype=np.float32)
    y, x = np.mgrid[0:size, 0:size] / size
    pixels[..., 0], pixels[..., 1], pixels[..., 2] = 0.2 + 0.7 * x, 0.2 + 0.7 * y, 0.3
    pixels[40:60, 4:24, :3] = (0.9, 0.9, 0.1)
    image = bpy.data.images.new("map", size, size)
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = os.path.join(folder, "map.png"), "PNG"
    image.save()
    return bpy.data.images.load(image.filepath_raw)


def textured(kind, color, name, image, scale, roughness):
    """A material of a shader node whose input `color` is a mapped image."""
    made = material(name, kind, Roughness=roughness)
    tree = made.node_tree
    shader = next(n for n in tree.nodes if n.type.startswith("BSDF"))
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    mapping = tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Scale"].default_value = (scale, scale, 1)
    mapping.inputs["Rotation"].default_value = (0, 0, 0.2)
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(coordinates.outputs["UV"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs[0], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], shader.inputs[color])
    return made


def sky_image(folder):
    """A latitude-longitude map with a bright red patch at +x and a green one at +y."""
    height, width = 64, 128
    pixels = np.full((height, width, 4), 0.25, dtype=np.float32)
    pixels[..., 3] = 1
    pixels[: height // 2, :, :3] = 0.1  # below the horizon; rows start at the bottom
    u = (np.arange(width) + 0.5) / width
    azimuth = (0.5 - u) * 2 * math.pi
    for angle, rgb in ((0, (6, 0.5, 0.5)), (math.pi / 2, (0.5, 6, 0.5))):
        near = np.abs((azimuth - angle + math.pi) % (2 * math.pi) - math.pi) < 0.35
        pixels[36:48, near, :3] = rgb
    image = bpy.data.images.new("sky", width, height, float_buffer=True)
    image.pixels.foreach_set(pixels.ravel())
    image.filepath_raw, image.file_format = os.path.join(folder, "sky.exr"), "OPEN_EXR"
    image.save()
    return bpy.data.images.load(image.filepath_raw)


def sky_world(scene, image):
    world(scene, (1, 1, 1))
    tree = scene.world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image
    tree.links.new(texture.outputs[0], tree.nodes["Background"].inputs["Color"])


def instances(folder):
    """A textured ground, instanced and mirrored objects, hair, and depth of field."""
    scene = new_scene()
    image = checked_image(folder)
    bpy.ops.mesh.primitive_plane_add(size=6)
    ground = textured("BsdfDiffuse", "Color", "ground", image, 2, 0)
    bpy.context.object.data.materials.append(ground)
    metal = material("metal", "BsdfGlossy", Color=(0.8, 0.8, 0.85, 1), Roughness=0.05)
    primitive("uv_sphere", metal, radius=0.5, segments=64, ring_count=32, location=(-1.2, 0.6, 0.5))
    bpy.ops.mesh.primitive_monkey_add(size=0.9, location=(0.2, -0.2, 0.5), rotation=(-0.5, 0, 0.4))
    monkey = bpy.context.object
    monkey.modifiers.new("smooth", "SUBSURF").render_levels = 2
    monkey.data.polygons.foreach_set("use_smooth", [True] * len(monkey.data.polygons))
    monkey.data.materials.append(textured("BsdfPrincipled", "Base Color", "skin", image, 1, 0.4))
    for i in range(5):
        copy = bpy.data.objects.new(f"copy {i}", monkey.data)
        scene.collection.objects.link(copy)
        copy.location = (-2 + i, 2.2, 0.3)
        copy.scale = (0.5 if i % 2 else -0.5, 0.5, 0.5)
    hairy = primitive("uv_sphere", material("ball", "BsdfDiffuse", Color=(0.5, 0.2, 0.1, 1)),
                      radius=0.3, location=(1.4, 0.3, 0.3))
    fur = material("fur", "BsdfHairPrincipled")
    hairy.data.materials.append(fur)
    hairy.modifiers.new("fur", "PARTICLE_SYSTEM")
    settings = hairy.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length = "HAIR", 1500, 0.3
    settings.material = 2
    settings.radius_scale = 0.012
    sky_world(scene, sky_image(folder))
    data = camera(scene, (0, -4.6, 2.0), (0, 0.3, 0.4), 40)
    data.dof.use_dof, data.dof.focus_distance, data.dof.aperture_fstop = True, 4.6, 0.6
    save(folder, "instances")


def main():
    sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
    from material_scenes import make_all
    folder = os.path.abspath(sys.argv[sys.argv.index("--") + 1])
    os.makedirs(folder, exist_ok=True)
    make_all(folder)
    diffuse_room(folder)
    for which in LAMPS:
        diffuse_room(folder, "diffuse-" + which, (which,))
    caustics(folder)
    varnish(folder)
    instances(folder)


if __name__ == "__main__":
    main()
