// The glTF reader on hostile files; see targets.h.
#include "fuzz/memory_files.h"
#include "fuzz/targets.h"
#include "input/gltf/gltf_reader.h"

namespace nephroid::fuzz {
namespace {

/// Checks the guarantees for users of shapes: indices within the vertices, arrays of one length.
void check(const ShapeDescription& shape) {
  const Parameter* positions = shape.parameters.find("P");
  const Parameter* indices = shape.parameters.find("indices");
  if (!positions || !indices) __builtin_trap();
  const size_t vertices = positions->numbers.size() / 3;
  for (const double i : indices->numbers)
    if (!(i >= 0 && i < static_cast<double>(vertices))) __builtin_trap();
  for (const auto& [name, width] : {std::pair<const char*, size_t>{"N", 3}, {"uv", 2}, {"S", 3}})
    if (const Parameter* p = shape.parameters.find(name);
        p && p->numbers.size() != vertices * width)
      __builtin_trap();
}

}  // namespace

void gltf(const std::string& bytes) {
  const MemoryFiles files({{"scene.gltf", bytes}});
  ImportOptions options;
  options.time = 0.5;
  options.shutter = 0.25;
  Diagnostics diagnostics;
  try {
    const SceneDescription scene = read_gltf("scene.gltf", options, diagnostics);
    for (const ShapeDescription& shape : scene.shapes) check(shape);
    for (const auto& [name, object] : scene.objects)
      for (const ShapeDescription& shape : object.shapes) check(shape);
  } catch (const Error&) {
  }
}

}  // namespace nephroid::fuzz
