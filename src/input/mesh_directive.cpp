#include "input/mesh_directive.h"

#include <algorithm>
#include <utility>

#include "input/parameter_list.h"

namespace nephroid {
namespace {

template <class Vec>
std::vector<double> numbers_of(const std::vector<Vec>& items) {
  std::vector<double> numbers;
  numbers.reserve(items.size() * Vec::dimensions());
  for (const Vec& item : items)
    for (unsigned int i = 0; i < Vec::dimensions(); ++i)
      numbers.push_back(item[static_cast<int>(i)]);
  return numbers;
}

bool are_indices(const std::vector<uint32_t>& indices, size_t count) {
  return std::all_of(indices.begin(), indices.end(), [&](uint32_t index) { return index < count; });
}

/// True if a PLY file can hold all parameters, or "plymesh" has them, too.
bool all_fit_a_file(const ParameterSet& parameters) {
  constexpr const char* kKnown[] = {"P", "N", "uv", "indices", "faceIndices", "alpha"};
  return std::all_of(parameters.list.begin(), parameters.list.end(), [&](const Parameter& p) {
    return std::any_of(std::begin(kKnown), std::end(kKnown),
                       [&](const char* known) { return p.name == known; });
  });
}

bool is_consistent(const MeshData& mesh) {
  const size_t vertices = mesh.positions.size(), faces = mesh.triangles.size() / 3;
  const auto fits = [](size_t size, size_t wanted) { return size == 0 || size == wanted; };
  return mesh.triangles.size() % 3 == 0 && are_indices(mesh.triangles, vertices) &&
         fits(mesh.normals.size(), vertices) && fits(mesh.uvs.size(), vertices) &&
         fits(mesh.face_indices.size(), faces);
}

}  // namespace

DirectiveDescription mesh_directive(const MeshData& mesh, const SourceLocation& where) {
  ParameterList list(where);
  list.add_numbers("integer", "indices", {mesh.triangles.begin(), mesh.triangles.end()});
  list.add_numbers("point3", "P", numbers_of(mesh.positions));
  if (!mesh.normals.empty()) list.add_numbers("normal", "N", numbers_of(mesh.normals));
  if (!mesh.uvs.empty()) list.add_numbers("point2", "uv", numbers_of(mesh.uvs));
  if (!mesh.tangents.empty()) list.add_numbers("vector3", "S", numbers_of(mesh.tangents));
  if (!mesh.face_indices.empty())
    list.add_numbers("integer", "faceIndices",
                     {mesh.face_indices.begin(), mesh.face_indices.end()});
  return std::move(list).directive("trianglemesh");
}

std::optional<MeshData> mesh_for_a_file(const DirectiveDescription& directive) {
  const ParameterSet& p = directive.parameters;
  if (directive.type != "trianglemesh" || !all_fit_a_file(p)) return std::nullopt;
  try {
    MeshData mesh;
    mesh.positions = p.get_point3s("P");
    mesh.normals = p.get_normals("N");
    mesh.uvs = p.get_point2s("uv");
    mesh.face_indices = p.get_ints("faceIndices");
    for (const int index : p.get_ints("indices"))
      mesh.triangles.push_back(static_cast<uint32_t>(index));
    return is_consistent(mesh) ? std::optional(std::move(mesh)) : std::nullopt;
  } catch (const SceneError&) {
    return std::nullopt;  // left to whoever reads the scene
  }
}

}  // namespace nephroid
