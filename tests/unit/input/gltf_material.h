// A glTF file with one material, for tests.
#pragma once

#include "unit/input/gltf_text.h"

namespace nephroid::testing {

/// A triangle with one material and room for textures 0 to 2 with images of their own.
inline ReadScene read_material(const std::string& material, const ImportOptions& options = {},
                               const std::string& extra_attributes = "", GltfText file = {}) {
  TriangleScene t;
  t.file = std::move(file);
  const size_t p = t.file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const size_t uv = t.file.vec2({0, 0, 1, 0, 0, 0.25f});
  const size_t uv1 = t.file.vec2({0, 0, 0.5f, 0, 0, 0.5f});
  return read_gltf_text(
      t.file.text(fmt::format(
          R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{},)"
          R"("TEXCOORD_0":{},"TEXCOORD_1":{}{}}},"material":0}}]}}],"materials":[{{{}}}],)"
          R"("textures":[{{"source":0}},{{"source":1,"sampler":0}},{{"source":2}}],)"
          R"("samplers":[{{"wrapS":33071,"wrapT":33648}}],)"
          R"("images":[{{"uri":"a.png"}},{{"uri":"b.jpg"}},{{"uri":"c.png"}}])",
          p, uv, uv1, extra_attributes, material)),
      options);
}
inline const ParameterSet& parameters_of(const ReadScene& read) {
  return read.scene.materials.at(0).parameters;
}
/// The texture that a parameter names; of no type if there is none.
inline const TextureDescription& texture_of(const ReadScene& read, const ParameterSet& set,
                                            const std::string& parameter) {
  static const TextureDescription kNone;
  const std::string name = string_of(set, parameter);
  for (const TextureDescription& t : read.scene.textures)
    if (t.name == name) return t;
  return kNone;
}

}  // namespace nephroid::testing
