#!/usr/bin/env python3
"""Writes the glTF files of this folder, one tiny scene for each extension of glTF, named after it.

Three extensions compress meshes: their files are written by gltf-transform (tests/unit/input/gltf_files/make.mjs).
EXT_texture_webp needs the program cwebp.
"""
import base64
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/agreement/gltf"))
from make_pairs import BALL, BALL_FACES, SQUARES, File  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parent
SQUARE_INDICES = [0, 1, 2, 0, 2, 3]
SQUARE_UVS = [(0, 0), (0, 1), (1, 1), (1, 0)]
HALF = math.sqrt(0.5)


def png_rgba(side, pixels):
    """The bytes of a square 8-bit picture with alpha."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes(x for p in pixels[y * side:(y + 1) * side] for x in p) for y in range(side))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 8, 6, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


class Scene(File):
    """A floor, a red wall, a wide lamp above and a camera."""

    def __init__(self, lamp=True):
        super().__init__()
        self.quad([(-3, 0, -2), (-3, 0, 4), (3, 0, 4), (3, 0, -2)], self.lambert((0.6, 0.6, 0.6)))
        self.quad([(-3, 0, -2), (3, 0, -2), (3, 3, -2), (-3, 3, -2)], self.lambert((0.7, 0.25, 0.2)))
        if lamp:
            light = self.lambert((0, 0, 0), emissiveFactor=[1, 1, 1])
            self.extend(self.json["materials"][light], "KHR_materials_emissive_strength", emissiveStrength=1.5)
            self.quad([(-2.5, 4, -1), (2.5, 4, -1), (2.5, 4, 3), (-2.5, 4, 3)], light)
        camera = self.add("cameras", {"type": "perspective", "perspective": {
            "yfov": math.radians(36), "aspectRatio": 1, "znear": 0.1}})
        # Turned downwards about x, so that (0, 0.9, 0) is seen from (0, 1.9, 5).
        angle = -math.atan2(1, 5)
        self.node(camera=camera, translation=[0, 1.9, 5], rotation=[math.sin(angle / 2), 0, 0, math.cos(angle / 2)])

    def extend(self, item, name, **members):
        """Adds an extension to an object of the file."""
        item.setdefault("extensions", {})[name] = members
        used = self.json.setdefault("extensionsUsed", [])
        if name not in used:
            used.append(name)

    def quad(self, corners, material, **attributes):
        return self.node(mesh=self.mesh(corners, SQUARE_INDICES, material, **attributes))

    def ball_mesh(self, material):
        return self.mesh(BALL, [i for face in BALL_FACES for i in face], material, BALL)

    def ball(self, material, **node):
        return self.node(mesh=self.ball_mesh(material), **(node or {"translation": [0, 1, 0]}))

    def half_cylinder(self, material):
        """An upright half of a cylinder whose u runs around it."""
        angles = [math.pi * (i / 8 - 0.5) for i in range(9)]
        points = [(math.sin(a), y, math.cos(a)) for a in angles for y in (0, 2)]
        normals = [(math.sin(a), 0, math.cos(a)) for a in angles for _ in (0, 2)]
        uvs = [(i / 8, 1 - y / 2) for i in range(9) for y in (0, 2)]
        faces = [k for i in range(0, 16, 2) for k in (i, i + 2, i + 3, i, i + 3, i + 1)]
        self.node(mesh=self.mesh(points, faces, material, normals, TEXCOORD_0=self.accessor(uvs, "VEC2")))

    def picture_quad(self, texture_info, **material):
        """An upright square with a texture."""
        index = self.lambert((1, 1, 1), **material)
        self.json["materials"][index]["pbrMetallicRoughness"]["baseColorTexture"] = texture_info
        self.quad([(-1.2, 2.2, 0), (-1.2, 0, 0.6), (1.2, 0, 0.6), (1.2, 2.2, 0)], index,
                  TEXCOORD_0=self.accessor(SQUARE_UVS, "VEC2"))

    def image(self, data, kind="image/png"):
        return self.add("images", {"bufferView": self.view(data), "mimeType": kind})

    def save(self, name):
        assert name in self.json["extensionsUsed"], name
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        self.json["buffers"] = [{"byteLength": len(self.buffer), "uri": "data:application/octet-stream;base64,"
                                 + base64.b64encode(self.buffer).decode()}]
        text = json.dumps({k: v for k, v in self.json.items() if v != []}, indent=1)
        (FOLDER / f"{name}.gltf").write_text(text + "\n")


def write_ball(name, color=(1, 1, 1), metallic=0.0, roughness=0.5, more=None, **members):
    """The scene of a ball whose material has the extension `name` with these members, and further extensions."""
    scene = Scene()
    scene.ball(scene.material(color, metallic, roughness, {name: members, **(more or {})}))
    scene.save(name)


def balls():
    glass = {"KHR_materials_transmission": {"transmissionFactor": 1}}
    solid = {**glass, "KHR_materials_volume": {"thicknessFactor": 1}}
    write_ball("KHR_materials_ior", (0.1, 0.1, 0.3), ior=2.2)
    write_ball("KHR_materials_specular", (0.05, 0.1, 0.1), roughness=0.3, specularFactor=0.8,
               specularColorFactor=[1, 0.5, 0.1])
    write_ball("KHR_materials_transmission", (0.4, 0.9, 0.5), roughness=0, transmissionFactor=0.9)
    write_ball("KHR_materials_volume", roughness=0.3, more=glass, thicknessFactor=1, attenuationDistance=1.5,
               attenuationColor=[0.9, 0.5, 0.2])
    write_ball("KHR_materials_dispersion", roughness=0.3, more=solid, dispersion=8)
    write_ball("KHR_materials_clearcoat", (0.1, 0.3, 0.1), roughness=0.9, clearcoatFactor=0.9,
               clearcoatRoughnessFactor=0.2)
    write_ball("KHR_materials_sheen", (0.1, 0.05, 0.05), roughness=1, sheenColorFactor=[0.2, 0.5, 0.9],
               sheenRoughnessFactor=0.4)
    write_ball("KHR_materials_iridescence", (0.2, 0.2, 0.2), 1, 0.3, iridescenceFactor=1, iridescenceIor=1.6,
               iridescenceThicknessMaximum=380)
    write_ball("KHR_materials_unlit", (0.9, 0.5, 0.1))
    write_ball("KHR_materials_pbrSpecularGlossiness", diffuseFactor=[0.2, 0.3, 0.5, 1], specularFactor=[0.3, 0.2, 0.1],
               glossinessFactor=0.6)


def other_materials():
    s = Scene()
    s.half_cylinder(s.material((0.9, 0.7, 0.4), 1, 0.3, {"KHR_materials_anisotropy": {
        "anisotropyStrength": 0.8, "anisotropyRotation": 0.5}}))
    s.save("KHR_materials_anisotropy")

    s = Scene(lamp=False)
    lamp = s.lambert((0, 0, 0), emissiveFactor=[1, 0.8, 0.5])
    s.extend(s.json["materials"][lamp], "KHR_materials_emissive_strength", emissiveStrength=2.5)
    s.ball(lamp)
    s.save("KHR_materials_emissive_strength")

    # The side that is seen turns away from the lamp.
    s = Scene()
    s.quad([(-1.2, 2.2, 1), (-1.2, 0.2, 0), (1.2, 0.2, 0), (1.2, 2.2, 1)], s.material(
        (0.3, 0.3, 0.3), 0, 1, {"KHR_materials_diffuse_transmission": {
            "diffuseTransmissionFactor": 0.7, "diffuseTransmissionColorFactor": [0.4, 0.9, 0.2]}}))
    s.save("KHR_materials_diffuse_transmission")

    s = Scene()
    red, green = s.lambert((0.8, 0.1, 0.1)), s.lambert((0.1, 0.8, 0.1))
    ball = s.json["nodes"][s.ball(red)]["mesh"]
    s.extend(s.json, "KHR_materials_variants", variants=[{"name": "red"}, {"name": "green"}])
    s.extend(s.json["meshes"][ball]["primitives"][0], "KHR_materials_variants",
             mappings=[{"material": green, "variants": [1]}])
    s.save("KHR_materials_variants")


def textures():
    s = Scene()
    texture = s.add("textures", {"source": s.image(SQUARES), "sampler": s.add("samplers", {"wrapS": 33648})})
    info = {"index": texture}
    s.extend(info, "KHR_texture_transform", offset=[0.2, 0.1], rotation=0.6, scale=[1.5, 1.2])
    s.picture_quad(info)
    s.save("KHR_texture_transform")

    s = Scene()
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "a.png").write_bytes(SQUARES)
        subprocess.run(["cwebp", "-quiet", "-lossless", f"{folder}/a.png", "-o", f"{folder}/a.webp"], check=True)
        webp = (pathlib.Path(folder) / "a.webp").read_bytes()
    texture = {}
    s.extend(texture, "EXT_texture_webp", source=s.image(webp, "image/webp"))
    s.picture_quad({"index": s.add("textures", texture)})
    s.save("EXT_texture_webp")

    # The PNG is the fallback of an image that is not read.
    s = Scene()
    texture = {"source": s.image(SQUARES)}
    s.extend(texture, "KHR_texture_basisu", source=s.image(b"\xabKTX 20\xbb\r\n\x1a\n", "image/ktx2"))
    s.picture_quad({"index": s.add("textures", texture)})
    s.save("KHR_texture_basisu")


def nodes():
    s = Scene()
    mesh = s.ball_mesh(s.lambert((0.3, 0.4, 0.8)))
    offsets = s.accessor([(-1.1, 0.6, 0), (0.2, 0.9, 0), (1.3, 0.6, 0)])
    turns = s.accessor([(0, 0, 0, 1), (0, 0, HALF, HALF), (0, 0, 0.38268343, 0.92387953)], "VEC4")
    scales = s.accessor([(0.4, 0.6, 0.4), (0.9, 0.4, 0.5), (0.6, 0.3, 0.3)])
    node = s.node(mesh=mesh)
    s.extend(s.json["nodes"][node], "EXT_mesh_gpu_instancing",
             attributes={"TRANSLATION": offsets, "ROTATION": turns, "SCALE": scales})
    s.save("EXT_mesh_gpu_instancing")

    s = Scene()
    s.ball(s.lambert((0.2, 0.6, 0.6)), translation=[-0.9, 0.8, 0], scale=[0.8, 0.8, 0.8])
    hidden = s.ball(s.lambert((0.9, 0.9, 0.1)), translation=[0.9, 0.8, 0], scale=[0.8, 0.8, 0.8])
    s.extend(s.json["nodes"][hidden], "KHR_node_visibility", visible=False)
    s.save("KHR_node_visibility")


def lights():
    s = Scene(lamp=False)
    s.ball(s.lambert((0.8, 0.8, 0.8)))
    s.extend(s.json, "KHR_lights_punctual", lights=[
        {"type": "point", "color": [1, 0.5, 0.25], "intensity": 5},
        {"type": "spot", "color": [0.25, 0.5, 1], "intensity": 12,
         "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}},
        {"type": "directional", "intensity": 0.6}])
    turn = math.radians(-60)
    for number, node in enumerate([{"translation": [-2, 2, 1]},
                                   {"translation": [1.2, 3.5, 0], "rotation": [-HALF, 0, 0, HALF]},
                                   {"rotation": [math.sin(turn / 2), 0, 0, math.cos(turn / 2)]}]):
        s.extend(s.json["nodes"][s.node(**node)], "KHR_lights_punctual", light=number)
    s.save("KHR_lights_punctual")

    # Faces +x, -x, +y, -y, +z, -z; the divisor in alpha makes the upper halves four times as bright.
    s = Scene(lamp=False)
    s.ball(s.material((0.9, 0.9, 0.9), 1, 0.25))
    colors = [(220, 60, 60), (60, 220, 60), (90, 110, 230), (90, 70, 50), (200, 200, 60), (60, 200, 200)]
    faces = [s.image(png_rgba(4, [(*c, 64)] * 8 + [(*c, 255)] * 8)) for c in colors]
    # The upper half of a face counts 255 / 64 times, and the first coefficient is pi / Y00 times the mean.
    means = [sum((c[k] / 255) ** 2.2 for c in colors) / 6 * (1 + 255 / 64) / 2 for k in range(3)]
    first = [round(mean * math.pi / 0.28209479, 4) for mean in means]
    s.extend(s.json, "EXT_lights_image_based", lights=[{
        "name": "sky", "intensity": 0.3, "rotation": [0, math.sin(0.3), 0, math.cos(0.3)], "specularImageSize": 4,
        "irradianceCoefficients": [first] + [[0, 0, 0]] * 8, "specularImages": [faces]}])
    s.extend(s.json["scenes"][0], "EXT_lights_image_based", light=0)
    s.save("EXT_lights_image_based")


def main():
    balls()
    other_materials()
    textures()
    nodes()
    lights()


if __name__ == "__main__":
    main()
