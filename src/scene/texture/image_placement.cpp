#include "scene/texture/image_placement.h"

#include "core/counted.h"

namespace nephroid {
namespace {

WrapMode read_wrap(const ParameterSet& parameters, const std::string& name, WrapMode fallback) {
  const std::string text = parameters.get_string(name, "");
  if (text.empty()) return fallback;
  const std::optional<WrapMode> mode = parse_wrap_mode(text);
  if (!mode || *mode == WrapMode::kOctahedralSphere)
    throw SceneError(parameters.find(name)->where,
                     "unknown wrap mode \"" + text +
                         "\", expected \"repeat\", \"mirror\", \"black\" or \"clamp\"");
  return *mode;
}

}  // namespace

ImagePlacement::ImagePlacement(const ParameterSet& parameters, const std::string& prefix,
                               WrapModes fallback)
    : wrap_(read_wrap(parameters, prefix + "uwrap", fallback.u),
            read_wrap(parameters, prefix + "vwrap", fallback.v)) {
  const std::vector<float> map = parameters.get_floats(prefix + "uvtransform");
  if (map.empty()) return;
  if (map.size() != map_.size())
    throw SceneError(
        parameters.find(prefix + "uvtransform")->where,
        "\"" + prefix + "uvtransform\" has " + counted(map.size(), "number") + ", expected 6");
  std::copy(map.begin(), map.end(), map_.begin());
}

void ImagePlacement::choose_set(const ParameterSet& parameters, const std::string& prefix) {
  const int set = parameters.get_int(prefix + "uvset", 0);
  if (set != 0 && set != 1)
    throw SceneError(parameters.find(prefix + "uvset")->where,
                     "\"" + prefix + "uvset\" is " + std::to_string(set) + ", expected 0 or 1");
  second_set_ = set == 1;
}

}  // namespace nephroid
