// Meshes as Shape "trianglemesh". In them v is 1 - v of Mitsuba, so that images, whose first row is
// v = 0 in Mitsuba and v = 1 in pbrt-v4, need no mapping. It must not know plug-ins.
#pragma once

#include "input/mesh_data.h"
#include "input/scene_description.h"

namespace nephroid::mitsuba {

/// Normals of vertices, as Mitsuba makes them for meshes without: those of the faces around,
/// weighed by angle (Thuermer & Wuethrich 1998). Vertices without area get none (0).
std::vector<Vec3f> smooth_normals(const MeshData& mesh);

void turn_v_over(MeshData& mesh);

/// True unless each edge, by the positions of its ends, belongs to two triangles.
bool is_open(const MeshData& mesh);

/// Sets type and parameters. Quads become triangles.
void set_mesh(ShapeDescription& shape, const MeshData& mesh);

/// The square from (-1, -1, 0) to (1, 1, 0) that faces +z.
MeshData rectangle_mesh();
/// The cube from (-1, -1, -1) to (1, 1, 1), with the texture on each face.
MeshData cube_mesh();

}  // namespace nephroid::mitsuba
