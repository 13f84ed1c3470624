// A polygon mesh of a file or a scene as plain arrays, and the PLY reader.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/math.h"
#include "input/scene_files.h"

namespace nephroid {

struct MeshData {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;                ///< per vertex, or empty
  std::vector<Vec2f> uvs;                    ///< per vertex, or empty
  std::vector<Vec3f> tangents;               ///< per vertex, or empty
  std::vector<Vec2f> second_uvs;             ///< per vertex, or empty
  std::vector<std::array<float, 4>> colors;  ///< linear rgb and alpha per vertex, or empty
  std::vector<uint32_t> triangles;           ///< three indices each
  std::vector<uint32_t> quads;               ///< four indices each, in ring order as PLY has them
  std::vector<int> face_indices;             ///< per triangle, then per quad; or empty
};

enum class PlyColors {
  kSkipped,
  kRead,  ///< r,g,b, red,green,blue or diffuse_red ..., as stored; integers are parts of 255
};

/// Reads an ascii, binary_little_endian or binary_big_endian PLY file (".gz" is unpacked): vertex
/// x,y,z, optional nx,ny,nz and u,v (also s,t and texture_u, texture_v); faces with 3 or 4 indices.
/// - Faces with 5 to kMaxPolygonCorners corners are cut into triangles, appended to the file's.
/// - Faces with fewer than 3 distinct corners become triangles without area.
/// - Normals need not be finite. Other numbers that are not finite become 0 if no face uses their
///   vertex; else they are an error.
/// - A file shorter than its header claims is an error, found before memory is allocated for it.
/// Throws IoError or SceneError with the file's name.
MeshData read_ply(SceneFiles& files, const std::string& path, const SourceLocation& wanted_by,
                  PlyColors colors = PlyColors::kSkipped);

}  // namespace nephroid
