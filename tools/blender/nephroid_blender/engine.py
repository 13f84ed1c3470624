"""The render engine: final renders, and the viewport by viewport.py."""
import math
import tempfile
import time

import bpy

from .export.report import Report
from .export.scene import export_frame
from .passes import extra_passes, fill
from .preferences import program_path, why_no_program
from .process import RenderProcess
from .settings import thread_arguments
from .viewport import Viewport

SECONDS_BETWEEN_LOOKS = 0.05


class NephroidRenderEngine(bpy.types.RenderEngine):
    bl_idname = "NEPHROID"
    bl_label = "Nephroid"
    bl_use_preview = False
    bl_use_shading_nodes_custom = False  # node trees of Cycles
    bl_use_eevee_viewport = True  # material preview by Eevee

    _viewport = None
    _has_failed = False

    def __del__(self):
        if self._viewport is not None:
            self._viewport.close()

    # Final render

    def update_render_passes(self, scene=None, renderlayer=None):
        self.register_pass(scene, renderlayer, "Combined", 4, "RGBA", "COLOR")
        for p in extra_passes(scene, renderlayer):
            self.register_pass(scene, renderlayer, p.name, len(p.channels), p.channels, p.kind)

    def render(self, depsgraph):
        program = program_path()
        if not program:
            self._fail(why_no_program())
            return
        with tempfile.TemporaryDirectory(prefix="nephroid-") as folder:
            self._render_in(folder, program, depsgraph)

    def _render_in(self, folder, program, depsgraph):
        scene, layer = depsgraph.scene, depsgraph.view_layer
        self.update_stats("", "Writing the scene")
        report = Report()
        if scene.camera is None:
            self._fail("the scene has no camera")
            return
        path = export_frame(folder, depsgraph, report, self._set_frame)
        self._report_all(("warning", text) for text in report.warnings)
        if self.test_break():
            return
        passes = extra_passes(scene, layer)
        for p in passes:
            if p.name not in ("Depth", "Normal"):  # Blender adds these by itself
                self.add_pass(p.name, len(p.channels), p.channels, layer=layer.name)
        layers = ",".join(["picture", *dict.fromkeys(p.layer for p in passes)])
        settings = scene.nephroid
        process = RenderProcess(program, [
            path, "--stream", layers, *settings.stop_arguments(), *settings.algorithm_arguments(),
            *thread_arguments(scene), *_crop_arguments(scene)])
        try:
            self._show(process, layer, passes)
        finally:
            process.stop()
        if process.end is not None:
            self._report_lines(process.end["report"].replace(folder + "/", ""))

    def _report_lines(self, text):
        """Each line by itself: Blender cuts long messages."""
        for line in text.strip().splitlines():
            self.report({"INFO"}, line)

    def _show(self, process, view_layer, passes):
        """Shows the picture until it is done or the user cancels."""
        shown = None
        while True:
            is_running = process.is_running
            picture = process.take_picture()
            if picture is not None:
                self._show_picture(picture, view_layer, passes)
            if process.progress is not shown:
                shown = process.progress
                self._show_progress(shown)
            self._report_all(process.take_messages())
            if self.test_break():
                return
            if not is_running:
                break
            time.sleep(SECONDS_BETWEEN_LOOKS)
        failure = process.failure()
        if failure and not self._has_failed:
            self._fail(failure)

    def _show_picture(self, frame, view_layer, passes):
        x0, y0, x1, y1 = frame.header["window"]
        # Blender counts from the corner of the border.
        result = self.begin_result(0, 0, x1 - x0, y1 - y0, layer=view_layer.name)
        fill(result, frame.layers(), passes)
        self.end_result(result)

    def _show_progress(self, progress):
        self.update_progress(progress["fraction"])
        text = f"Pass {progress['passes'] + 1}"
        if "error" in progress:
            text += f" | Error {progress['error']:.3g}"
        self.update_stats("", text)

    def _report_all(self, messages):
        for kind, text in messages:
            if kind == "error":
                self._fail(text)
            else:
                self.report({"WARNING" if kind == "warning" else "INFO"}, text)

    def _fail(self, text):
        self._has_failed = True
        self.report({"ERROR"}, text)
        self.error_set(text)

    def _set_frame(self, frame):
        whole = math.floor(frame)
        self.frame_set(whole, frame - whole)

    # Viewport

    def view_update(self, context, depsgraph):
        if self._viewport is None:
            self._viewport = Viewport(self)
        self._viewport.update(context, depsgraph)

    def view_draw(self, context, depsgraph):
        if self._viewport is None:
            self._viewport = Viewport(self)
        self._viewport.draw(context, depsgraph)


def _crop_arguments(scene):
    render = scene.render
    if not render.use_border:
        return []
    return ["--crop", f"{render.border_min_x:.9g},{render.border_max_x:.9g},"
                      f"{1 - render.border_max_y:.9g},{1 - render.border_min_y:.9g}"]


def register():
    bpy.utils.register_class(NephroidRenderEngine)


def unregister():
    bpy.utils.unregister_class(NephroidRenderEngine)
