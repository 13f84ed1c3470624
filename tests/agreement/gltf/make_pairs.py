#!/usr/bin/env python3
"""Writes the glTF halves of the pairs in this folder, and the mesh and the picture that both halves share.

Each NAME.gltf shows the same scene as NAME.pbrt, which is written by hand in pbrt's conventions.
"""
import base64
import json
import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).resolve().parent


class File:
    """A glTF file under construction: one buffer, and lists."""

    def __init__(self):
        self.buffer = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "materials": [], "accessors": [], "bufferViews": [], "cameras": []}

    def add(self, kind, item):
        self.json.setdefault(kind, []).append(item)
        return len(self.json[kind]) - 1

    def view(self, data):
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        view = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data)}
        self.buffer += data
        return self.add("bufferViews", view)

    def accessor(self, rows, kind="VEC3", code="f", component=5126):
        flat = [x for row in rows for x in (row if isinstance(row, (list, tuple)) else [row])]
        item = {"bufferView": self.view(struct.pack(f"<{len(flat)}{code}", *flat)), "componentType": component,
                "count": len(rows), "type": kind}
        if kind == "VEC3" and code == "f":
            item["min"] = [min(c) for c in zip(*rows)]
            item["max"] = [max(c) for c in zip(*rows)]
        return self.add("accessors", item)

    def mesh(self, positions, indices, material, normals=None, **attributes):
        where = {"POSITION": self.accessor(positions)}
        if normals:
            where["NORMAL"] = self.accessor(normals)
        where.update(attributes)
        primitive = {"attributes": where, "indices": self.accessor(indices, "SCALAR", "H", 5123), "material": material}
        return self.add("meshes", {"primitives": [primitive]})

    def node(self, root=True, **members):
        index = self.add("nodes", members)
        if root:
            self.json["scenes"][0]["nodes"].append(index)
        return index

    def material(self, color=(0.5, 0.5, 0.5), metallic=0.0, roughness=1.0, extensions=None, **members):
        extensions = dict(extensions or {})
        item = {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": metallic,
                                         "roughnessFactor": roughness}, **members}
        if extensions:
            item["extensions"] = extensions
            used = self.json.setdefault("extensionsUsed", [])
            used += [name for name in extensions if name not in used]
        return self.add("materials", item)

    def lambert(self, color=(0.5, 0.5, 0.5), **members):
        return self.material(color, extensions={"KHR_materials_specular": {"specularFactor": 0.0}}, **members)

    def write(self, name):
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        self.json["buffers"] = [{"byteLength": len(self.buffer), "uri": "data:application/octet-stream;base64,"
                                 + base64.b64encode(self.buffer).decode()}]
        text = json.dumps({k: v for k, v in self.json.items() if v != []}, indent=1)
        (FOLDER / f"{name}.gltf").write_text(text + "\n")


def ball():
    """A unit sphere of 80 triangles with normals."""
    t = (1 + math.sqrt(5)) / 2
    points = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t),
              (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
             (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
             (6, 2, 10), (8, 6, 7), (9, 8, 1)]

    def unit(p):
        length = math.sqrt(sum(x * x for x in p))
        return tuple(x / length for x in p)

    points = [unit(p) for p in points]
    middles = {}

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            points.append(unit(tuple((x + y) / 2 for x, y in zip(points[a], points[b]))))
            middles[key] = len(points) - 1
        return middles[key]

    halves = []
    for a, b, c in faces:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        halves += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    points = [tuple(struct.unpack("<3f", struct.pack("<3f", *p))) for p in points]
    return points, halves


BALL, BALL_FACES = ball()


def write_ball():
    lines = ["ply", "format ascii 1.0", f"element vertex {len(BALL)}"]
    lines += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    lines += [f"element face {len(BALL_FACES)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(repr(x) for x in p + p) for p in BALL]
    lines += ["3 %d %d %d" % face for face in BALL_FACES]
    (FOLDER / "ball.ply").write_text("\n".join(lines) + "\n")


def png(width, height, pixels):
    """The bytes of an 8-bit RGB picture."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(x for p in pixels[y * width:(y + 1) * width] for x in p) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


SQUARES = png(4, 2, [(250, 30, 30), (30, 250, 30), (30, 30, 250), (200, 200, 200),
                     (60, 60, 60), (250, 250, 30), (30, 250, 250), (120, 40, 160)])


def stage(lamp=True):
    """The floor, the lamp and the camera that all pairs have."""
    f = File()
    floor = f.lambert()
    f.node(mesh=f.mesh([(-3, 0, -3), (-3, 0, 3), (3, 0, 3), (3, 0, -3)], [0, 1, 2, 0, 2, 3], floor))
    if lamp:
        light = f.lambert((0, 0, 0), emissiveFactor=[1, 1, 1])
        f.json["materials"][light]["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": 8}
        f.json["extensionsUsed"].append("KHR_materials_emissive_strength")
        f.node(mesh=f.mesh([(-1, 4, -1), (1, 4, -1), (1, 4, 1), (-1, 4, 1)], [0, 1, 2, 0, 2, 3], light))
    camera = f.add("cameras", {"type": "perspective", "perspective": {"yfov": math.radians(40), "aspectRatio": 1,
                                                                      "znear": 0.1}})
    # Turned downwards about x, so that (0, 0.7, 0) is seen from (0, 2.7, 5).
    angle = -math.atan2(2.0, 5.0)
    f.node(camera=camera, translation=[0, 2.7, 5], rotation=[math.sin(angle / 2), 0, 0, math.cos(angle / 2)])
    return f


def with_ball(f, material, **node):
    mesh = f.mesh(BALL, [i for face in BALL_FACES for i in face], material, BALL)
    f.node(mesh=mesh, **(node or {"translation": [0, 1, 0]}))
    return mesh


def glass():
    f = stage()
    with_ball(f, f.material((1, 1, 1), 0, 0, {"KHR_materials_transmission": {"transmissionFactor": 1},
                                              "KHR_materials_volume": {"thicknessFactor": 1},
                                              "KHR_materials_ior": {"ior": 1.5}}))
    f.write("glass")


def thin_glass():
    f = stage()
    with_ball(f, f.material((1, 1, 1), 0, 0, {"KHR_materials_transmission": {"transmissionFactor": 1}}))
    f.write("thin_glass")


def rough_glass():
    f = stage()
    with_ball(f, f.material((1, 1, 1), 0, 0.4, {
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.5},
        "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 2, "attenuationColor": [0.25, 0.5, 0.9]}}))
    f.write("rough_glass")


def metal():
    f = stage()
    with_ball(f, f.material((0.9, 0.6, 0.2), 1, 0.5))
    f.write("metal")


def coat():
    f = stage()
    with_ball(f, f.material((0.6, 0.1, 0.1), 0, 0.7, {"KHR_materials_clearcoat": {
        "clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.3}}))
    f.write("coat")


def textures():
    f = stage()
    image = f.add("images", {"bufferView": f.view(SQUARES), "mimeType": "image/png"})
    sampler = f.add("samplers", {"wrapS": 33648, "wrapT": 10497})
    texture = f.add("textures", {"source": image, "sampler": sampler})
    f.json["extensionsUsed"].append("KHR_texture_transform")
    material = f.lambert((1, 0.5, 1))
    f.json["materials"][material]["pbrMetallicRoughness"]["baseColorTexture"] = {
        "index": texture, "texCoord": 1, "extensions": {"KHR_texture_transform": {
            "offset": [0.25, 0.5], "rotation": math.pi / 2, "scale": [2, 3]}}}
    uv = f.accessor([(0, 0), (0, 1), (1, 1), (1, 0)], "VEC2")
    f.node(mesh=f.mesh([(-1, 1.5, 0), (-1, 0, 1), (1, 0, 1), (1, 1.5, 0)], [0, 1, 2, 0, 2, 3], material,
                       TEXCOORD_0=f.accessor([(0.5, 0.5)] * 4, "VEC2"), TEXCOORD_1=uv))
    f.write("textures")


def emissive():
    f = stage(lamp=False)
    image = f.add("images", {"uri": "data:image/png;base64," + base64.b64encode(SQUARES).decode()})
    texture = f.add("textures", {"source": image, "sampler": f.add("samplers", {"wrapS": 33071, "wrapT": 33071})})
    material = f.lambert((0, 0, 0), emissiveFactor=[1, 0.5, 0.25], emissiveTexture={"index": texture},
                         doubleSided=True)
    f.json["materials"][material]["extensions"]["KHR_materials_emissive_strength"] = {"emissiveStrength": 10}
    f.json["extensionsUsed"].append("KHR_materials_emissive_strength")
    uv = f.accessor([(0, 0), (0, 1), (1, 1), (1, 0)], "VEC2")
    f.node(mesh=f.mesh([(-1, 2, 0), (-1, 0.5, 1), (1, 0.5, 1), (1, 2, 0)], [0, 1, 2, 0, 2, 3], material,
                       TEXCOORD_0=uv))
    f.write("emissive")


def skin():
    """A plate of two squares, whose upper one is bent backwards by a quarter turn from 0 s to 2 s."""
    f = stage()
    plate = [(-1, y, 0) for y in (0, 1, 2)] + [(1, y, 0) for y in (0, 1, 2)]
    faces = [0, 3, 4, 0, 4, 1, 1, 4, 5, 1, 5, 2]
    joints = [(0, 0, 0, 0), (0, 0, 0, 0), (1, 0, 0, 0)] * 2
    weights = [(1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)] * 2
    mesh = f.mesh(plate, faces, f.lambert((0.2, 0.7, 0.3)), JOINTS_0=f.accessor(joints, "VEC4", "B", 5121),
                  WEIGHTS_0=f.accessor(weights, "VEC4"))
    upper = f.node(root=False, translation=[0, 1, 0])
    lower = f.node(children=[upper])
    identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    down = identity[:13] + [-1, 0, 1]
    matrices = f.accessor([identity, down], "MAT4")
    f.add("skins", {"joints": [lower, upper], "inverseBindMatrices": matrices})
    f.node(mesh=mesh, skin=0, translation=[9, 9, 9])
    half = math.sqrt(0.5)
    times = f.accessor([0.0, 2.0], "SCALAR")
    f.json["accessors"][times].update(min=[0], max=[2])
    turns = f.accessor([(0, 0, 0, 1), (-half, 0, 0, half)], "VEC4")
    f.add("animations", {"samplers": [{"input": times, "output": turns}],
                         "channels": [{"sampler": 0, "target": {"node": upper, "path": "rotation"}}]})
    f.write("skin")


def moving():
    """A ball that moves from the left to the right between 0 s and 2 s."""
    f = stage()
    ball = f.node(mesh=f.mesh(BALL, [i for face in BALL_FACES for i in face], f.lambert((0.7, 0.6, 0.2)), BALL),
                  translation=[9, 9, 9], scale=[0.6, 0.6, 0.6])
    times = f.accessor([0.0, 2.0], "SCALAR")
    f.json["accessors"][times].update(min=[0], max=[2])
    places = f.accessor([(-1.6, 1, 0), (1.6, 1, 0)])
    f.add("animations", {"name": "roll", "samplers": [{"input": times, "output": places}],
                         "channels": [{"sampler": 0, "target": {"node": ball, "path": "translation"}}]})
    f.write("moving")


def lights():
    f = stage(lamp=False)
    f.json["extensionsUsed"].append("KHR_lights_punctual")
    f.json["extensions"] = {"KHR_lights_punctual": {"lights": [
        {"type": "point", "color": [1, 0.5, 0.25], "intensity": 6},
        {"type": "spot", "color": [0.25, 0.5, 1], "intensity": 20, "spot": {"innerConeAngle": 0.2,
                                                                            "outerConeAngle": 0.4}},
        {"type": "directional", "intensity": 0.8}]}}
    with_ball(f, f.lambert((0.8, 0.8, 0.8)))
    half = math.sqrt(0.5)
    turn = math.radians(-60)
    for number, node in enumerate([{"translation": [-2, 2, 1]},
                                   {"translation": [1.5, 4, 0], "rotation": [-half, 0, 0, half]},
                                   {"rotation": [math.sin(turn / 2), 0, 0, math.cos(turn / 2)]}]):
        f.node(extensions={"KHR_lights_punctual": {"light": number}}, **node)
    f.write("lights")


def instances():
    f = stage()
    mesh = with_ball(f, f.lambert((0.7, 0.3, 0.2)), translation=[0, 0.5, 0], scale=[0.5, 0.5, 0.5])
    f.node(mesh=mesh, translation=[-1.2, 0.6, 0.5], scale=[-0.5, 0.6, 0.5])
    offsets = f.accessor([(1.2, 0.4, 0), (1.2, 1.2, 0)])
    scales = f.accessor([(0.4, 0.4, 0.4), (0.3, 0.4, 0.3)])
    f.json["extensionsUsed"].append("EXT_mesh_gpu_instancing")
    f.node(mesh=mesh, extensions={"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": offsets,
                                                                             "SCALE": scales}}})
    f.write("instances")


def main():
    write_ball()
    (FOLDER / "squares.png").write_bytes(SQUARES)
    for make in (glass, thin_glass, rough_glass, metal, coat, textures, emissive, skin, moving, lights, instances):
        make()


if __name__ == "__main__":
    main()
