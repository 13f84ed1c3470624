"""Hair of particle systems and of Curves objects, as cubic curves in world space."""
import numpy as np

from .pbrt_text import quoted


def bezier_of_points(points):
    """Control points of the Catmull-Rom spline through `points`, as joined cubic Bezier curves."""
    ends = np.concatenate([2 * points[:1] - points[1:2], points, 2 * points[-1:] - points[-2:-1]])
    tangents = (ends[2:] - ends[:-2]) / 6
    controls = np.empty((3 * len(points) - 2, 3))
    controls[0::3] = points
    controls[1::3] = points[:-1] + tangents[:-1]
    controls[2::3] = points[1:] - tangents[1:]
    return controls


def write_strand(text, points, root_width, tip_width):
    keep = np.ones(len(points), dtype=bool)
    keep[1:] = np.any(points[1:] != points[:-1], axis=1)
    points = points[keep]
    if len(points) < 2 or not max(root_width, tip_width) > 0:
        return
    numbers = " ".join("%.7g" % x for x in bezier_of_points(points).ravel())
    text.line(f'Shape "curve" "string type" "cylinder" "float width0" {root_width:.7g} '
              f'"float width1" {tip_width:.7g} "point3 P" [{numbers}]')


def _begin(text, surface):
    text.line("AttributeBegin")
    text.line("NamedMaterial " + quoted(surface.material))


def write_particle_hair(text, obj, materials, report, for_viewport):
    """All hair systems of an evaluated object; obj.particle_systems match its modifiers."""
    for modifier in obj.modifiers:
        shown = modifier.show_viewport if for_viewport else modifier.show_render
        if modifier.type != "PARTICLE_SYSTEM" or not shown:
            continue
        system = modifier.particle_system
        settings = system.settings
        if settings.render_type != "PATH" or settings.type != "HAIR":
            continue
        slots = obj.material_slots
        index = min(max(settings.material - 1, 0), len(slots) - 1)
        surface = materials.surface(slots[index].material if slots else None)
        if surface.emits:
            report.warn(f"object '{obj.name}'", "its hair cannot emit light")
        root = settings.root_radius * settings.radius_scale
        tip = 0 if settings.use_close_tip else settings.tip_radius * settings.radius_scale
        _begin(text, surface)
        for points in _strands(obj, system, for_viewport):
            write_strand(text, points, root, tip)
        text.line("AttributeEnd")


def _strands(obj, system, for_viewport):
    settings = system.settings
    steps = 2 ** (settings.display_step if for_viewport else settings.render_step)
    parents, children = len(system.particles), len(system.child_particles)
    first = 0 if children == 0 or settings.use_parent_particles else parents
    for i in range(first, parents + children):
        points = [system.co_hair(obj, particle_no=i, step=s) for s in range(steps + 1)]
        array = np.array([tuple(p) for p in points])
        yield array[np.any(array != 0, axis=1)] if not array[-1].any() else array


def write_curves(text, obj, matrix, materials, report):
    """A Curves object: hair curves with a radius at each point."""
    curves = obj.data
    count = len(curves.points)
    if count == 0:
        return
    positions = np.empty(3 * count, dtype=np.float32)
    curves.points.foreach_get("position", positions)
    world = np.array(matrix)
    positions = positions.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    radii = np.empty(count, dtype=np.float32)
    curves.points.foreach_get("radius", radii)
    scale = abs(np.linalg.det(world[:3, :3])) ** (1 / 3)
    slots = obj.material_slots
    _begin(text, materials.surface(slots[0].material if slots else None))
    for curve in curves.curves:
        first, last = curve.first_point_index, curve.first_point_index + curve.points_length
        write_strand(text, positions[first:last], 2 * scale * float(radii[first]),
                     2 * scale * float(radii[last - 1]))
    text.line("AttributeEnd")
