// The PLY reader on hostile files; see targets.h.
#include "fuzz/memory_files.h"
#include "fuzz/targets.h"
#include "input/mesh_data.h"

namespace nephroid::fuzz {
namespace {

/// Checks the guarantees for users of meshes.
void check(const MeshData& mesh) {
  const size_t vertices = mesh.positions.size();
  bool good = mesh.triangles.size() % 3 == 0 && mesh.quads.size() % 4 == 0;
  good = good && (mesh.normals.empty() || mesh.normals.size() == vertices);
  good = good && (mesh.uvs.empty() || mesh.uvs.size() == vertices);
  good = good && (mesh.face_indices.empty() ||
                  mesh.face_indices.size() == mesh.triangles.size() / 3 + mesh.quads.size() / 4);
  for (const uint32_t i : mesh.triangles) good = good && i < vertices;
  for (const uint32_t i : mesh.quads) good = good && i < vertices;
  for (const Vec3f& p : mesh.positions) good = good && is_finite(p);
  if (!good) __builtin_trap();
}

}  // namespace

void ply(const std::string& bytes) {
  const MemoryFiles files({{"mesh.ply", bytes}});
  SceneFiles scene_files;
  try {
    check(read_ply(scene_files, "mesh.ply", {}));
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
