"""What the export writes, read as text. Runs in Blender, without a render."""
import io
import json
import os
import re
import struct
import subprocess
import tempfile
import unittest
import zlib

import bpy
import numpy as np

import scenes
from nephroid_blender import frames, settings
from nephroid_blender.export.pbrt_text import quoted
from nephroid_blender.export.report import Report
from nephroid_blender.export.scene import export_frame
from nephroid_blender.program import REPOSITORY, find_program


def write_png(path, pixels):
    """Height x width x channels bytes."""
    height, width, channels = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", width, height, 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data +
                       struct.pack(">I", zlib.crc32(kind + data)))


def read_pfm(path):
    with open(path, "rb") as file:
        channels = {"PF": 3, "Pf": 1}[file.readline().decode().strip()]
        width, height = map(int, file.readline().split())
        file.readline()
        return np.frombuffer(file.read(), dtype="<f4").reshape(height, width, channels)


def parameter(text, name):
    """The numbers, or the string, behind "TYPE name" of the only directive that has it."""
    numbers = r"\[?([-+.\de ]+)\]?"
    found, = re.findall(rf'"\w+ {name}" (?:"([^"]*)"|{numbers})', text)
    return found[0] if found[0] else [float(x) for x in found[1].split()]


class Exported(unittest.TestCase):
    """A scene of one square, exported into a folder."""

    def setUp(self):
        self.scene = scenes.new_scene()
        scenes.camera(self.scene, (0, 0, 3), (0, 0, 0))
        folder = tempfile.TemporaryDirectory(prefix="nephroid-test-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.warnings = []

    def square(self, material):
        bpy.ops.mesh.primitive_plane_add(size=1)
        bpy.context.object.data.materials.append(material)

    def export(self):
        report = Report()
        export_frame(self.folder, bpy.context.evaluated_depsgraph_get(), report, None)
        self.warnings = report.warnings
        with open(os.path.join(self.folder, "world.pbrt"), encoding="utf-8") as file:
            return file.read()

    def info(self):
        """Runs the program on the exported scene."""
        return subprocess.run([find_program(), "info", os.path.join(self.folder, "scene.pbrt")],
                              capture_output=True, text=True, timeout=20, check=False)

    def exported_material(self, kind, **inputs):
        self.square(scenes.material("white", kind, **inputs))
        return self.export()


class Names(Exported):
    def test_escapes(self):
        self.assertEqual(quoted('back\\drop "a"\r\n\t'), r'"back\\drop \"a\"\r\n\t"')

    def test_program_reads_names_with_backslashes_and_quotes(self):
        names = ["back\\drop", 'a "b"', "c\\"]
        for name in names:
            self.square(scenes.material(name, "BsdfDiffuse"))
        scenes.lamp(self.scene, "key\\", "POINT", (0, 0, 2), 10)
        text = self.export()
        for name in names:
            self.assertIn("MakeNamedMaterial " + quoted(name), text)
        asked = self.info()
        self.assertEqual((asked.returncode, asked.stderr), (0, ""))


class Lights(Exported):
    def test_sun_has_its_angle(self):
        scenes.lamp(self.scene, "sun", "SUN", (0, 0, 5), 1.5, angle=np.radians(5))
        text = self.export()
        self.assertAlmostEqual(parameter(text, "angle")[0], 5, 4)
        self.assertEqual(parameter(text, "L"), [1.5, 1.5, 1.5])
        self.assertEqual(self.warnings, [])

    def test_transparent_film_is_a_warning(self):
        self.export()
        self.assertEqual(self.warnings, [])
        self.scene.render.film_transparent = True
        self.export()
        self.assertEqual(self.warnings,
                         ["film: transparency is not supported, the background is opaque"])


class Anisotropy(Exported):
    def add_tangent(self, material):
        tree = material.node_tree
        tangent = tree.nodes.new("ShaderNodeTangent")
        tangent.direction_type = "UV_MAP"
        shader = next(n for n in tree.nodes if n.type.startswith("BSDF"))
        tree.links.new(tangent.outputs[0], shader.inputs["Tangent"])

    def alphas_of_glossy(self, anisotropy):
        text = self.exported_material("BsdfAnisotropic", Roughness=0.5, Anisotropy=anisotropy)
        return parameter(text, "uroughness")[0], parameter(text, "vroughness")[0]

    def test_glossy_as_in_cycles(self):
        np.testing.assert_allclose(self.alphas_of_glossy(0.5), (0.125, 0.5), rtol=1e-6)

    def test_glossy_along_the_other_axis(self):
        np.testing.assert_allclose(self.alphas_of_glossy(-0.6), (0.625, 0.1), rtol=1e-6)

    def test_principled_has_the_alphas_of_cycles(self):
        text = self.exported_material("BsdfPrincipled", Roughness=0.4, Anisotropic=0.7)
        a = parameter(text, "specular_roughness_anisotropy")[0]
        alpha_u = parameter(text, "specular_roughness")[0] ** 2 * (2 / (1 + (1 - a) ** 2)) ** 0.5
        aspect = (1 - 0.9 * 0.7) ** 0.5
        self.assertAlmostEqual(alpha_u, 0.16 / aspect, 5)
        self.assertAlmostEqual(alpha_u * (1 - a), 0.16 * aspect, 5)

    def test_direction_is_that_of_the_uv_map(self):
        material = scenes.material("metal", "BsdfAnisotropic", Anisotropy=0.5)
        self.square(material)
        self.export()
        self.assertEqual(len(self.warnings), 1)
        self.assertIn("expected a Tangent node", self.warnings[0])
        self.add_tangent(material)
        self.export()
        self.assertEqual(self.warnings, [])


class Materials(Exported):
    def test_sheen_is_a_warning(self):
        self.exported_material("BsdfVelvet")
        self.assertEqual(len(self.warnings), 1)
        self.assertIn("fuzz of OpenPBR", self.warnings[0])


    def hair(self, **inputs):
        material = scenes.material("hair", "BsdfHairPrincipled", **inputs)
        material.node_tree.nodes["Principled Hair BSDF"].parametrization = "MELANIN"
        self.square(material)
        return parameter(self.export(), "sigma_a")

    def test_pigments_are_those_of_cycles(self):
        pigment = -np.log(0.5)
        np.testing.assert_allclose(self.hair(Melanin=0.5, Melanin_Redness=0.25),
                                   pigment * np.array([0.46525, 0.814, 1.72075]), rtol=1e-4)
        self.assertEqual(self.warnings, [])

    def test_tint_of_hair_is_a_reflectance(self):
        absorption = self.hair(Melanin=0, Tint=(0.5, 1, 1, 1), Radial_Roughness=0)
        np.testing.assert_allclose(absorption, [(np.log(0.5) / 5.969) ** 2, 0, 0], atol=1e-6)

    def test_random_hair_is_a_warning(self):
        self.hair(Random_Color=0.5)
        self.assertEqual(self.warnings, ["material 'hair': 'Random Color' of 'Principled Hair BSDF'"
                                         " is not supported, it is taken as 0"])


class Images(Exported):
    RGBA = np.array([[[255, 0, 0, 128], [0, 255, 0, 64]]], dtype=np.uint8)

    def image(self, name, pixels, space):
        path = os.path.join(self.folder, name)
        write_png(path, pixels)
        image = bpy.data.images.load(path)
        image.colorspace_settings.name = space
        return image

    def linked(self, image, kind, socket):
        material = scenes.material("textured", kind)
        tree = material.node_tree
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.image = image
        shader = next(n for n in tree.nodes if socket in n.inputs)
        tree.links.new(texture.outputs["Color"], shader.inputs[socket])
        self.square(material)
        return self.export()

    def pixels_of(self, text):
        return read_pfm(os.path.join(self.folder, parameter(text.split("Shape")[0], "filename")))

    def test_number_is_the_luminance_not_the_alpha(self):
        text = self.linked(self.image("rough.png", self.RGBA, "Non-Color"), "BsdfPrincipled",
                           "Roughness")
        self.assertIn('"float" "imagemap"', text)
        np.testing.assert_allclose(self.pixels_of(text)[0, :, 0], (0.2126, 0.7152), rtol=1e-5)

    def test_grey_file_is_read_as_it_is(self):
        image = self.image("grey.png", self.RGBA[..., :1].copy(), "Non-Color")
        text = self.linked(image, "BsdfPrincipled", "Roughness")
        self.assertIn('grey.png" "string encoding" "linear"', text)

    def test_colours_are_read_as_they_are(self):
        text = self.linked(self.image("base.png", self.RGBA, "sRGB"), "BsdfDiffuse", "Color")
        self.assertIn('base.png" "string encoding" "sRGB"', text)

    def test_emission_of_linear_bytes(self):
        image = self.image("light.png", self.RGBA[..., :3].copy() // 2, "Non-Color")
        text = self.linked(image, "Emission", "Color")
        expected = self.RGBA[..., :3] // 2 / 255
        np.testing.assert_allclose(self.pixels_of(text), expected, atol=1e-6)


class Settings(Exported):
    def test_render_without_any_limit_stops(self):
        chosen = self.scene.nephroid
        chosen.time_limit, chosen.noise, chosen.passes = 0, 0, 0
        self.assertEqual(chosen.stop_arguments(), ["--time", f"{settings.DEFAULT_SECONDS}s"])
        chosen.passes = 3
        self.assertEqual(chosen.stop_arguments(), ["--passes", "3"])


class Stream(unittest.TestCase):
    def test_example_of_the_page_reads_frames(self):
        with open(os.path.join(REPOSITORY, "docs", "stream.md"), encoding="utf-8") as file:
            code, = re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)
        example = {}
        exec(code, example)
        header, payload = {"kind": "note", "text": "a"}, np.array([1, 2.5], dtype="<f4").tobytes()
        text = json.dumps(header).encode()
        stream = io.BytesIO(frames.PREFIX.pack(frames.MAGIC, frames.VERSION, len(text),
                                               len(payload)) + text + payload)
        found, values = example["read_frame"](stream)
        self.assertEqual((found, values.tolist()), (header, [1, 2.5]))
        self.assertIsNone(example["read_frame"](stream))
