#include "input/missing_images.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

namespace nephroid {
namespace {

class MissingImages {
 public:
  explicit MissingImages(const SceneFiles& files) : files_(files) {}

  /// Adds the image that the parameter names, if it is missing.
  void look_for(const ParameterSet& parameters, const char* parameter) {
    const Parameter* const p = parameters.peek(parameter);
    if (p == nullptr || p->strings.size() != 1) return;
    const std::string& name = p->strings[0];
    if (name.empty() || files_.in_memory(name) || !known_.insert(name).second) return;
    std::error_code error;
    if (!std::filesystem::exists(files_.path_of(name), error)) missing_.push_back(p);
  }

  void refuse_several() const {
    if (missing_.size() < 2) return;
    constexpr size_t kMaxNames = 20;
    std::string names;
    for (size_t i = 0; i < std::min(missing_.size(), kMaxNames); ++i) {
      names += (i == 0 ? " \"" : ", \"") + missing_[i]->strings[0] + "\"";
      if (i > 0) names += " (" + missing_[i]->where.to_string() + ")";
    }
    if (missing_.size() > kMaxNames)
      names += " and " + std::to_string(missing_.size() - kMaxNames) + " more";
    throw SceneError(missing_[0]->where, std::to_string(missing_.size()) +
                                             " images are missing, expected files:" + names);
  }

 private:
  const SceneFiles& files_;
  std::set<std::string> known_;
  std::vector<const Parameter*> missing_;
};

}  // namespace

void refuse_missing_images(const SceneDescription& scene) {
  MissingImages images(*scene.files);
  for (const TextureDescription& texture : scene.textures)
    images.look_for(texture.parameters, "filename");
  for (const MaterialDescription& material : scene.materials)
    images.look_for(material.parameters, "normalmap");
  for (const LightDescription& light : scene.lights) images.look_for(light.parameters, "filename");
  for (const ShapeDescription& shape : scene.shapes)
    if (shape.area_light) images.look_for(shape.area_light->parameters, "filename");
  images.refuse_several();
}

}  // namespace nephroid
