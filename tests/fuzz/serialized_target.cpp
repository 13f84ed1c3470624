// The reader of .serialized files on hostile bytes; see targets.h.
#include <zlib.h>

#include <cmath>

#include "fuzz/targets.h"
#include "input/mitsuba/serialized_mesh.h"

namespace nephroid::fuzz {
namespace {

/// A file of version 4 with one mesh of these contents.
std::string packed(const std::string& contents) {
  std::string bytes("\x1c\x04\x04\x00", 4);
  uLongf size = compressBound(contents.size());
  bytes.resize(4 + size);
  if (compress(reinterpret_cast<Bytef*>(bytes.data() + 4), &size,
               reinterpret_cast<const Bytef*>(contents.data()), contents.size()) != Z_OK)
    return {};
  bytes.resize(4 + size);
  return bytes + std::string(8, '\0') + std::string("\x01\x00\x00\x00", 4);
}

/// Checks the guarantees for users of meshes.
void check_mesh_data(const MeshData& mesh) {
  const size_t vertices = mesh.positions.size();
  bool good = mesh.triangles.size() % 3 == 0;
  good = good && (mesh.normals.empty() || mesh.normals.size() == vertices);
  good = good && (mesh.uvs.empty() || mesh.uvs.size() == vertices);
  good = good && (mesh.colors.empty() || mesh.colors.size() == vertices);
  for (const uint32_t i : mesh.triangles) good = good && i < vertices;
  for (const Vec3f& p : mesh.positions) good = good && is_finite(p);
  for (const Vec2f& uv : mesh.uvs) good = good && std::isfinite(uv.x) && std::isfinite(uv.y);
  if (!good) __builtin_trap();
}

}  // namespace

void serialized(const std::string& bytes) {
  try {
    const bool is_file = bytes.starts_with("\x1c\x04");
    check_mesh_data(
        nephroid::mitsuba::read_serialized(is_file ? bytes : packed(bytes), 0, {}).mesh);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
