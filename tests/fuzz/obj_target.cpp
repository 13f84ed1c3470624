// OBJ and MTL files on hostile text, and the view that such a scene gets; see targets.h.
#include "fuzz/file_list.h"
#include "fuzz/memory_files.h"
#include "fuzz/targets.h"
#include "input/obj/obj_file.h"
#include "input/scene_reader.h"

namespace nephroid::fuzz {
namespace {

/// Checks the guarantees for users of meshes.
void check(const ObjFile& file) {
  bool good = true;
  for (const ObjPart& part : file.parts) {
    const MeshData& mesh = part.mesh;
    const size_t vertices = mesh.positions.size();
    good = good && !mesh.triangles.empty() && mesh.triangles.size() % 3 == 0;
    good = good && (mesh.normals.empty() || mesh.normals.size() == vertices);
    good = good && (mesh.uvs.empty() || mesh.uvs.size() == vertices);
    for (const uint32_t i : mesh.triangles) good = good && i < vertices;
    for (const Vec3f& p : mesh.positions) good = good && is_finite(p);
    for (const Vec3f& n : mesh.normals) good = good && is_finite(n);
  }
  const MeshData joined = joined_mesh(file);
  for (const uint32_t i : joined.triangles) good = good && i < joined.positions.size();
  if (!good) __builtin_trap();
}

}  // namespace

void obj(const std::string& bytes) {
  const MemoryFiles files(files_of(bytes, "m.obj"));
  Diagnostics diagnostics;
  try {
    SceneFiles scene_files;
    check(read_obj(scene_files, "m.obj", {}, diagnostics));
  } catch (const Error&) {
  }
  try {
    ImportOptions options;
    options.floor = true;
    read_scene("m.obj", options, diagnostics);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
