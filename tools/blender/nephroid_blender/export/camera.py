"""The camera and the film.

Blender's camera looks along -z with y up, pbrt's along +z; the change of handedness between both
mirrors z. With a fov of 90 degrees, screenwindow is in tangents, which holds sensor fit, shift and
aspect exactly.
"""
from dataclasses import dataclass


@dataclass
class View:
    """What the camera directives need."""
    matrix: object  # camera to world, without scale
    window: tuple  # left, right, bottom, top, in tangents or in metres
    kind: str = "perspective"
    lens_radius: float = 0.0
    focus: float = 1e6
    at_close: object = None  # matrix when the shutter closes


def _pose(matrix):
    from .lights import placement
    return placement(matrix)[0]


def view_of_camera(obj, scene, report):
    camera = obj.data
    corners = camera.view_frame(scene=scene)
    depth = -corners[0].z
    is_flat = camera.type == "ORTHO"
    if camera.type == "PANO":
        report.warn(f"camera '{obj.name}'",
                    "panoramas are not supported, a perspective camera is used")
    unit = 1 if is_flat else depth
    xs = [c.x / unit for c in corners]
    ys = [c.y / unit for c in corners]
    view = View(_pose(obj.matrix_world), (min(xs), max(xs), min(ys), max(ys)),
                "orthographic" if is_flat else "perspective")
    dof = camera.dof
    if dof.use_dof:
        length = 1.0 if is_flat else camera.lens * 1e-3
        view.lens_radius = length / (2 * max(dof.aperture_fstop, 1e-6))
        view.focus = dof.focus_distance
        if dof.focus_object is not None:
            eye = view.matrix.inverted() @ dof.focus_object.matrix_world.translation
            view.focus = max(-eye.z, 1e-6)
        if dof.aperture_blades or dof.aperture_ratio != 1:
            report.warn(f"camera '{obj.name}'", "blades and ratio of the aperture are not "
                                                "supported, a round aperture is used")
    return view


def camera_matrix(obj):
    return _pose(obj.matrix_world)


def _world_to_camera(matrix):
    from mathutils import Matrix
    return Matrix.Diagonal((1, 1, -1, 1)) @ matrix.inverted()


def write_camera(text, view):
    text.transform(_world_to_camera(view.matrix),
                   None if view.at_close is None else _world_to_camera(view.at_close))
    parameters = {"float screenwindow": view.window}
    if view.kind == "perspective":
        parameters["float fov"] = 90.0
    if view.lens_radius > 0:
        parameters["float lensradius"] = view.lens_radius
        parameters["float focaldistance"] = view.focus
    text.add("Camera", view.kind, parameters)


def write_film(text, width, height):
    text.add("Film", "rgb", {"integer xresolution": width, "integer yresolution": height})
