"""Binary PLY meshes by NumPy. It must not know Blender."""
import numpy as np


def merged_corners(vertex_of_corner, *attributes):
    """Corners that share a vertex and all attributes, merged.

    Returns the corner that stands for each merged one, and the merged index of each corner.
    """
    rows = [np.ascontiguousarray(vertex_of_corner, dtype=np.uint32)[:, None]]
    rows += [np.ascontiguousarray(a, dtype=np.float32).view(np.uint32) for a in attributes]
    keys = np.concatenate(rows, axis=1)
    hashes = np.zeros(len(keys), dtype=np.uint64)
    for column in keys.T:  # mixes with a constant of splitmix64
        hashes = (hashes ^ column) * np.uint64(0xBF58476D1CE4E5B9)
        hashes ^= hashes >> np.uint64(29)
    _, first, merged = np.unique(hashes, return_index=True, return_inverse=True)
    if not np.array_equal(keys[first][merged], keys):  # two rows with one hash
        every = np.arange(len(keys))
        return every, every
    return first, merged


def write_ply(path, positions, triangles, normals=None, uvs=None):
    """Writes a triangle mesh; normals and uvs have one row for each vertex."""
    columns = [("x", "y", "z")]
    arrays = [positions]
    if normals is not None:
        columns.append(("nx", "ny", "nz"))
        arrays.append(normals)
    if uvs is not None:
        columns.append(("u", "v"))
        arrays.append(uvs)
    names = [name for group in columns for name in group]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(positions)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(triangles)}", "property list uchar int vertex_indices",
               "end_header", ""]
    vertices = np.concatenate(arrays, axis=1).astype("<f4")
    faces = np.empty(len(triangles), dtype=[("count", "u1"), ("vertices", "<i4", 3)])
    faces["count"] = 3
    faces["vertices"] = triangles
    with open(path, "wb") as file:
        file.write("\n".join(header).encode("ascii"))
        file.write(vertices.tobytes())
        file.write(faces.tobytes())
