// The guarantees of imported meshes for whoever loads them: indices within the vertices, arrays of
// one length.
#pragma once

#include <utility>

#include "input/scene_description.h"

namespace nephroid::fuzz {

inline void check_mesh(const ShapeDescription& shape) {
  const Parameter* positions = shape.parameters.find("P");
  const Parameter* indices = shape.parameters.find("indices");
  if (!positions || !indices) __builtin_trap();
  const size_t vertices = positions->numbers.size() / 3;
  for (const double i : indices->numbers)
    if (!(i >= 0 && i < static_cast<double>(vertices))) __builtin_trap();
  constexpr std::pair<const char*, size_t> kAttributes[] = {
      {"N", 3}, {"uv", 2}, {"uv2", 2}, {"S", 3}, {"vertexcolors", 4}};
  for (const auto& attribute : kAttributes)
    if (const Parameter* p = shape.parameters.find(attribute.first);
        p && p->numbers.size() != vertices * attribute.second)
      __builtin_trap();
}

/// Checks all triangle meshes of the scene.
inline void check_meshes(const SceneDescription& scene) {
  const auto check = [](const std::vector<ShapeDescription>& shapes) {
    for (const ShapeDescription& shape : shapes)
      if (shape.type == "trianglemesh") check_mesh(shape);
  };
  check(scene.shapes);
  for (const auto& entry : scene.objects) check(entry.second.shapes);
}

}  // namespace nephroid::fuzz
