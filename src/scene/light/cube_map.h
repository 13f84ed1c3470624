// The six faces of a cube as one latitude-longitude map (sphere_map.h). Faces are OpenGL's (OpenGL
// 4.6 specification, table 8.19): +x, -x, +y, -y, +z, -z, each with its first row on top. It must
// not know lights.
#pragma once

#include <array>

#include "scene/texture/image_file.h"

namespace nephroid {

using CubeFaces = std::array<ImagePtr, 6>;

/// Reads the face of a cube. An image with alpha is RGBD: its colours are divided by alpha. Throws
/// SceneError at `wanted_by` if it is no square.
ImagePtr read_cube_face(const FileSource& source, const SourceLocation& wanted_by);

/// Resamples faces of one size, four pixels of the map on a face's side.
ImagePtr latitude_longitude_map(const CubeFaces& faces);

}  // namespace nephroid
