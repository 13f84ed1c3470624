"""The tests of the Blender add-on. Runs in Blender:

    blender -b --factory-startup --python-exit-code 1 -P tests/blender/run.py -- FOLDER [NAME ...]

FOLDER has the files of scenes.py and gets the pictures, Nephroid's beside Cycles'.
"""
import os
import sys
import time
import unittest

import bpy
import numpy as np

HERE = os.path.dirname(os.path.realpath(__file__))
REPOSITORY = os.path.join(HERE, "..", "..")
sys.path[:0] = [HERE, os.path.join(REPOSITORY, "tools", "blender")]

import nephroid_blender
from nephroid_blender.process import RenderProcess
from nephroid_blender.program import find_program, no_program, route_names
from exported import *  # its tests run with those of this file
from rendering import (block_means, cycles, nephroid, open_scene, render_to, save_side_by_side)

ARGUMENTS = sys.argv[sys.argv.index("--") + 1:]
FOLDER = os.path.abspath(ARGUMENTS[0])
LAMPS = ("point", "ball", "spot", "sun", "soft", "area", "disk", "panel", "world")


def path_of(name):
    return os.path.join(FOLDER, name)


class AgainstCycles(unittest.TestCase):
    """The same .blend in both engines."""

    def compare(self, name, samples, seconds, limit, of_blocks, pixels=100):
        """Expects means within `limit`, and blocks of pixels within `of_blocks` on average."""
        scene = open_scene(path_of(name + ".blend"))
        scene.render.resolution_percentage = pixels
        ours = nephroid(scene, path_of(name + "-nephroid.exr"), seconds)
        theirs = cycles(scene, path_of(name + "-cycles.exr"), samples)
        save_side_by_side(ours, theirs, path_of(name + ".png"))
        ratio = ours.mean(axis=(0, 1)) / theirs.mean(axis=(0, 1))
        a, b = block_means(ours), block_means(theirs)
        difference = np.abs(a - b).mean() / b.mean()
        print(f"{name}: means {np.round(ratio, 4)}, blocks differ by {difference:.3f}", flush=True)
        for channel in ratio:
            self.assertLess(abs(channel - 1), limit, name)
        self.assertLess(difference, of_blocks, name)

    def test_each_lamp(self):
        for lamp in LAMPS:
            with self.subTest(lamp):
                self.compare("diffuse-" + lamp, 64, 2, 0.03, 0.05, 50)

    def test_diffuse_room(self):
        self.compare("diffuse", 128, 8, 0.02, 0.03)

    def test_caustics(self):
        self.compare("caustics", 256, 10, 0.03, 0.05)

    def test_varnish(self):
        self.compare("varnish", 64, 2, 0.05, 0.05, 50)

    def test_instances(self):
        self.compare("instances", 64, 8, 0.02, 0.03)

    def test_principled(self):
        self.compare("principled", 128, 6, 0.04, 0.05)

    def test_relief(self):
        self.compare("relief", 64, 4, 0.02, 0.02)

    def test_volumes(self):
        self.compare("volumes", 128, 6, 0.02, 0.02)

    def test_hair(self):
        self.compare("hair", 64, 6, 0.04, 0.04)


class Passes(unittest.TestCase):
    def test_routes_add_up(self):
        scene = open_scene(path_of("caustics.blend"))
        scene.render.engine = "NEPHROID"
        scene.render.resolution_percentage = 25
        scene.nephroid.time_limit, scene.nephroid.passes = 0, 8
        scene.nephroid.route_passes = True
        combined = render_to(scene, path_of("combined.exr"))
        names = route_names(find_program(), "mixed")
        self.assertEqual(set(names), {"caustic", "diffuse", "emission"})
        total = np.zeros_like(combined)
        for name in names:
            total += self.rendered_pass(scene, name)
        self.assertGreater(self.rendered_pass(scene, "caustic").max(), 0)
        np.testing.assert_allclose(total, combined, rtol=1e-3, atol=1e-5)

    @staticmethod
    def rendered_pass(scene, name):
        """The pass by way of the compositor, which is the only way to its pixels."""
        scene.use_nodes = True
        tree = scene.node_tree
        tree.nodes.clear()
        layers = tree.nodes.new("CompositorNodeRLayers")
        output = tree.nodes.new("CompositorNodeComposite")
        bpy.context.view_layer.update_render_passes()
        tree.links.new(layers.outputs[name], output.inputs["Image"])
        return render_to(scene, path_of(f"pass-{name}.exr"))

    def test_border_is_a_part_of_the_picture(self):
        scene = open_scene(path_of("diffuse.blend"))
        scene.render.engine = "NEPHROID"
        scene.render.resolution_percentage = 25
        scene.nephroid.time_limit, scene.nephroid.passes = 0, 16
        scene.nephroid.integrator = "path"
        whole = render_to(scene, path_of("whole.exr"))
        render = scene.render
        render.use_border = True
        render.border_min_x, render.border_max_x = 0.25, 0.75
        render.border_min_y, render.border_max_y = 0.0, 0.5
        part = render_to(scene, path_of("part.exr"))
        height, width = whole.shape[:2]
        inside = np.s_[0:height // 2, width // 4:width * 3 // 4]
        self.assertLess(abs(part[inside].mean() / whole[inside].mean() - 1), 0.1)
        self.assertEqual(part[height // 2 + 1:].max(), 0)


class Failures(unittest.TestCase):
    def test_error_of_the_program_is_reported(self):
        scene = open_scene(path_of("diffuse.blend"))
        scene.render.engine = "NEPHROID"
        scene.nephroid.time_limit = 1
        aov = scene.nephroid.aovs.add()
        aov.name, aov.expression = "bad", "C.*["
        with self.assertRaisesRegex(RuntimeError, "--aov"):
            bpy.ops.render.render()

    def test_program_ends_soon(self):
        open_scene(path_of("diffuse.blend"))
        scene_path = os.path.join(REPOSITORY, "scenes", "caustic-room", "scene.pbrt")
        process = RenderProcess(find_program(), [scene_path, "--stream", "picture", "--time", "1m"])
        deadline, picture = time.monotonic() + 20, None
        while picture is None and time.monotonic() < deadline:
            time.sleep(0.01)
            picture = process.take_picture()
        self.assertIsNotNone(picture)
        begin = time.monotonic()
        process.stop()
        self.assertLess(time.monotonic() - begin, 0.5)
        self.assertFalse(process.is_running)

    def test_unsupported_is_a_warning(self):
        from nephroid_blender.export.report import Report
        from nephroid_blender.export.scene import write_contents
        open_scene(path_of("diffuse.blend"))
        material = bpy.data.materials["white"]
        tree = material.node_tree
        noise = tree.nodes.new("ShaderNodeTexNoise")
        shader = next(n for n in tree.nodes if n.type == "BSDF_DIFFUSE")
        tree.links.new(noise.outputs["Color"], shader.inputs["Color"])
        report = Report()
        write_contents(FOLDER, bpy.context.evaluated_depsgraph_get(), report)
        self.assertEqual(report.warnings, [
            "material 'white': node 'Noise Texture' is not supported, 0.5 is used instead"])

    def test_a_wrong_path_of_the_program_is_no_other_program(self):
        self.assertEqual(find_program("/nowhere/nephroid"), "")
        self.assertIn("'/nowhere/nephroid'", no_program("/nowhere/nephroid"))


def main():
    nephroid_blender.register()
    program = unittest.main(argv=["run.py", "-v", *ARGUMENTS[1:]], exit=False)
    if not program.result.wasSuccessful():
        raise SystemExit(1)


main()
