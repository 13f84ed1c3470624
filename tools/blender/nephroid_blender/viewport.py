"""The progressive picture of a 3D viewport in the mode Rendered."""
import tempfile
import weakref

import bpy
import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d

from .export.camera import View
from .export.report import Report
from .export.scene import write_contents, write_head
from .preferences import program_path, why_no_program
from .process import RenderProcess
from .settings import thread_arguments

SECONDS_BETWEEN_LOOKS = 0.1


def view_of_region(region_data):
    """The view of a region: its matrices as the camera of a scene file."""
    projection = region_data.window_matrix
    pose = region_data.view_matrix.inverted()
    if region_data.is_perspective:
        window = [(side + projection[axis][2]) / projection[axis][axis]
                  for axis in (0, 1) for side in (-1, 1)]
        return View(pose, tuple(window))
    window = [(side - projection[axis][3]) / projection[axis][axis]
              for axis in (0, 1) for side in (-1, 1)]
    return View(pose, tuple(window), "orthographic")


class Viewport:
    """The render of one region. A new view or scene starts the program anew."""

    def __init__(self, engine):
        self._engine = weakref.ref(engine)
        self._folder = tempfile.TemporaryDirectory(prefix="nephroid-")
        self._process = None
        self._view_key = None
        self._texture = None
        self._warned = set()

    def close(self):
        self._stop()
        self._folder.cleanup()

    def update(self, context, depsgraph):
        """Writes the scene after a change of it."""
        self._stop()
        self._view_key = None
        report = Report()
        write_contents(self._folder.name, depsgraph, report)
        self._say(("warning", text) for text in report.warnings)

    def draw(self, context, depsgraph):
        region, scale = context.region, int(context.scene.nephroid.viewport_scale)
        size = (max(region.width // scale, 1), max(region.height // scale, 1))
        view = view_of_region(context.region_data)
        key = (size, view.window, tuple(map(tuple, view.matrix)))
        if key != self._view_key:
            self._view_key = key
            self._restart(context.scene, view, size)
        if self._process is not None:
            self._take_picture()
            self._say(self._process.take_messages())
        if self._texture is not None:
            self._draw_texture(depsgraph.scene, region)

    def _restart(self, scene, view, size):
        self._stop()
        program, engine = program_path(), self._engine()
        if not program:
            engine.update_stats("Nephroid", why_no_program())
            return
        path = write_head(self._folder.name, view, *size)
        settings = scene.nephroid
        self._process = RenderProcess(program, [
            path, "--stream", "picture", "--time", f"{settings.viewport_time:.3f}s",
            *settings.algorithm_arguments(), *thread_arguments(scene)])
        bpy.app.timers.register(_redraw_while(self._engine, self._process),
                                first_interval=SECONDS_BETWEEN_LOOKS)

    def _stop(self):
        if self._process is not None:
            self._process.stop()
            self._process = None

    def _take_picture(self):
        frame = self._process.take_picture()
        if frame is None:
            return
        picture = frame.layers()["picture"]
        height, width = picture.shape[:2]
        pixels = np.ones((height, width, 4), dtype=np.float32)
        pixels[..., :3] = picture[::-1]
        buffer = gpu.types.Buffer("FLOAT", pixels.size, pixels.ravel())
        self._texture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=buffer)
        text = f"pass {frame.header['passes']}, {frame.header['seconds']:.1f} s"
        self._engine().update_stats("Nephroid", text)

    def _draw_texture(self, scene, region):
        engine = self._engine()
        gpu.state.blend_set("ALPHA_PREMULT")
        engine.bind_display_space_shader(scene)
        draw_texture_2d(self._texture, (0, 0), region.width, region.height)
        engine.unbind_display_space_shader()
        gpu.state.blend_set("NONE")

    def _say(self, messages):
        """Each text once: the scene is written after every change of it."""
        for kind, text in messages:
            if text not in self._warned and kind != "note":
                self._warned.add(text)
                self._engine().report({"ERROR" if kind == "error" else "WARNING"}, text)


def _redraw_while(engine_reference, process):
    """A timer that asks for a redraw when there is a new picture, until the render has ended."""
    def look():
        engine = engine_reference()
        if engine is None:
            return None
        try:
            if process.has_picture:
                engine.tag_redraw()
        except ReferenceError:  # Blender has freed the engine
            return None
        return SECONDS_BETWEEN_LOOKS if process.is_running or process.has_picture else None
    return look
