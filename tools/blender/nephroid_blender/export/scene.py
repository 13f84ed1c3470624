"""A scene as files: scene.pbrt with camera and film, which includes world.pbrt with all else.

So a new view needs only a new scene.pbrt.
"""
import os

from .camera import write_camera, write_film
from .objects import ObjectWriter, matrices
from .pbrt_text import SceneText
from .world import write_world


def write_head(folder, view, width, height):
    """Writes scene.pbrt and returns its path."""
    text = SceneText()
    write_film(text, width, height)
    write_camera(text, view)
    text.line("WorldBegin")
    text.line('Include "world.pbrt"')
    path = os.path.join(folder, "scene.pbrt")
    text.write(path)
    return path


def write_contents(folder, depsgraph, report, at_open=None, at_close=None):
    """Writes world.pbrt with its meshes and images."""
    for name in ("meshes", "images"):
        os.makedirs(os.path.join(folder, name), exist_ok=True)
    if depsgraph.scene_eval.render.film_transparent:
        report.warn("film", "transparency is not supported, the background is opaque")
    text = SceneText()
    for_viewport = depsgraph.mode == "VIEWPORT"
    objects = ObjectWriter(text, folder, report, for_viewport)
    write_world(text, depsgraph.scene_eval.world, objects.materials, report)
    objects.write(depsgraph, at_open, at_close)
    text.write(os.path.join(folder, "world.pbrt"))


def shutter_times(scene):
    """Frames at which the shutter opens and closes, as in Cycles."""
    render = scene.render
    position = getattr(render, "motion_blur_position", None) or \
        getattr(getattr(scene, "cycles", None), "motion_blur_position", "CENTER")
    shutter, frame = render.motion_blur_shutter, scene.frame_current
    before = {"START": 0.0, "CENTER": 0.5, "END": 1.0}[position] * shutter
    return frame - before, frame - before + shutter


def picture_size(scene):
    percentage = scene.render.resolution_percentage / 100
    return (max(int(scene.render.resolution_x * percentage), 1),
            max(int(scene.render.resolution_y * percentage), 1))


def export_frame(folder, depsgraph, report, set_frame):
    """Writes the frame of a final render. Returns the path of scene.pbrt.

    `set_frame(frame)` evaluates the depsgraph at a frame that need not be whole.
    """
    from .camera import camera_matrix, view_of_camera
    scene = depsgraph.scene
    at_open = at_close = poses = None

    def camera():
        return scene.camera.evaluated_get(depsgraph)

    if scene.render.use_motion_blur:
        begin, end = shutter_times(scene)
        frame = scene.frame_current
        set_frame(begin)
        at_open, poses = matrices(depsgraph), [camera_matrix(camera())]
        set_frame(end)
        at_close = matrices(depsgraph)
        poses.append(camera_matrix(camera()))
        set_frame(frame)
    view = view_of_camera(camera(), depsgraph.scene_eval, report)
    if poses:
        view.matrix, view.at_close = poses
    write_contents(folder, depsgraph, report, at_open, at_close)
    return write_head(folder, view, *picture_size(scene))
