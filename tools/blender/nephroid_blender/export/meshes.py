"""Meshes of Blender as PLY files, one for each material, by foreach_get."""
import os
from dataclasses import dataclass

import numpy as np

from .ply import merged_corners, write_ply


@dataclass
class MeshArrays:
    positions: np.ndarray  # vertices x 3
    vertex_of_corner: np.ndarray
    triangles: np.ndarray  # triangles x 3 corners
    materials: np.ndarray  # slot of each triangle
    normals: np.ndarray = None  # corners x 3; None if all faces are flat
    uvs: dict = None  # name: corners x 2
    render_uv: str = ""  # name of the layer for rendering


def _values(collection, name, width, dtype=np.float32):
    array = np.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(name, array)
    return array.reshape(-1, width) if width > 1 else array


def _corner_normals(mesh):
    if hasattr(mesh, "corner_normals"):  # 4.1 and later
        return _values(mesh.corner_normals, "vector", 3)
    mesh.calc_normals_split()
    return _values(mesh.loops, "normal", 3)


def read_mesh(mesh):
    """The arrays of an evaluated mesh; None without faces."""
    if not mesh.polygons:
        return None
    mesh.calc_loop_triangles()
    triangles = mesh.loop_triangles
    arrays = MeshArrays(
        positions=_values(mesh.vertices, "co", 3),
        vertex_of_corner=_values(mesh.loops, "vertex_index", 1, np.int32),
        triangles=_values(triangles, "loops", 3, np.int32),
        materials=_values(triangles, "material_index", 1, np.int32),
        uvs={layer.name: _values(layer.data, "uv", 2) for layer in mesh.uv_layers})
    for layer in mesh.uv_layers:
        if layer.active_render:
            arrays.render_uv = layer.name
    if _values(triangles, "use_smooth", 1, bool).any():
        arrays.normals = _corner_normals(mesh)
    return arrays


def mapped_uvs(arrays, uv):
    """Texture coordinates of all corners, or None without such a layer."""
    found = arrays.uvs.get(uv.layer or arrays.render_uv)
    if found is None:
        return None
    matrix = uv.array()
    return (found @ matrix[:2, :2].T + matrix[:2, 2]).astype(np.float32)


def write_part(path, arrays, slot, uv):
    """Writes the triangles of a material slot. False if there are none."""
    triangles = arrays.triangles[arrays.materials == slot]
    if len(triangles) == 0:
        return False
    corners = triangles.reshape(-1)
    attributes = []
    uvs = mapped_uvs(arrays, uv)
    if arrays.normals is not None:
        attributes.append(arrays.normals[corners])
    if uvs is not None:
        attributes.append(uvs[corners])
    first, merged = merged_corners(arrays.vertex_of_corner[corners], *attributes)
    kept = corners[first]
    write_ply(path, arrays.positions[arrays.vertex_of_corner[kept]], merged.reshape(-1, 3),
              None if arrays.normals is None else arrays.normals[kept],
              None if uvs is None else uvs[kept])
    return True


class MeshWriter:
    """Writes the meshes of objects into the folder of a scene."""

    def __init__(self, folder, materials, report):
        self._folder = folder
        self._materials = materials
        self._report = report
        self._count = 0

    def parts(self, obj):
        """(PLY file, surface) for each material of an evaluated object."""
        mesh = obj.to_mesh()
        if mesh is None:
            return []
        try:
            arrays = read_mesh(mesh)
            return [] if arrays is None else self._write_slots(obj, mesh, arrays)
        finally:
            obj.to_mesh_clear()

    def _write_slots(self, obj, mesh, arrays):
        slots = [slot.material for slot in obj.material_slots] or list(mesh.materials) or [None]
        arrays.materials = np.clip(arrays.materials, 0, len(slots) - 1)
        found = []
        for i in np.unique(arrays.materials):
            surface = self._materials.surface(slots[i])
            path = f"meshes/{self._count}.ply"
            write_part(os.path.join(self._folder, path), arrays, i, surface.uv)
            self._count += 1
            if (surface.uv.layer or surface.uv.matrix != ((1, 0, 0), (0, 1, 0))) and \
                    mapped_uvs(arrays, surface.uv) is None:
                self._report.warn(f"object '{obj.name}'",
                                  "it has no UV map, expected one for its textures")
            found.append((path, surface))
        return found
