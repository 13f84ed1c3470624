// A polygon mesh as a file or a scene said it: plain arrays. Filled by the PLY reader and by the
// "trianglemesh", "plymesh", "bilinearmesh" and "loopsubdiv" shapes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/math.h"
#include "input/scene_files.h"

namespace nephroid {

struct MeshData {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;       ///< per vertex, or empty
  std::vector<Vec2f> uvs;           ///< per vertex, or empty
  std::vector<Vec3f> tangents;      ///< per vertex, or empty
  std::vector<uint32_t> triangles;  ///< three indices each
  std::vector<uint32_t> quads;      ///< four indices each, in ring order as PLY has them
  std::vector<int> face_indices;    ///< of all triangles, then of all quads; or empty
};

/// Reads an ascii, binary_little_endian or binary_big_endian PLY file (".gz" is unpacked): vertex
/// x,y,z, optional nx,ny,nz and u,v (also s,t and texture_u, texture_v); faces with 3 or 4 indices.
/// Faces with 5 to kMaxPolygonCorners are cut into triangles, behind the triangles of the file;
/// those with fewer than 3 distinct ones become triangles without area. Normals may be other than
/// finite; positions and texture coordinates are finite: those of vertices that no face uses become
/// 0, others are an error. Throws IoError or SceneError naming the file; a file shorter than its
/// header says is an error and nothing is allocated on the header's word alone.
MeshData read_ply(SceneFiles& files, const std::string& path, const SourceLocation& wanted_by);

}  // namespace nephroid
