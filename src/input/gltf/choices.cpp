#include "input/gltf/choices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "input/gltf/accessor.h"

namespace nephroid::gltf {
namespace {

void add_variants(const Document& document, SceneDescription& scene) {
  const std::optional<JsonValue> extension = document.root().extension("KHR_materials_variants");
  if (!extension) return;
  for (const JsonValue& variant : extension->get("variants").elements())
    scene.choices.variants.push_back(variant.get_text("name", ""));
}

/// From the first to the last keyframe of an animation, s.
struct TimeRange {
  double first = std::numeric_limits<double>::infinity();
  double last = -std::numeric_limits<double>::infinity();
};

TimeRange range_of(Document& document, const JsonValue& animation) {
  TimeRange range;
  for (const JsonValue& sampler : animation.get("samplers").elements())
    for (const float time : read_accessor(document, sampler.get_index("input"), sampler).values) {
      range.first = std::min(range.first, double{time});
      range.last = std::max(range.last, double{time});
    }
  return range;
}

}  // namespace

void add_choices(Document& document, SceneDescription& scene) {
  add_variants(document, scene);
  double end = -std::numeric_limits<double>::infinity();
  std::vector<std::string>& names = scene.choices.animations;
  for (const JsonValue& animation : document.list("animations")) {
    const TimeRange range = range_of(document, animation);
    const std::string name =
        animation.get_text("name", "animation " + std::to_string(names.size()));
    names.push_back(range.last < range.first
                        ? name + ", empty"
                        : fmt::format("{}, {:g} to {:g} s", name, range.first, range.last));
    end = std::max(end, range.last);
  }
  if (!names.empty() && document.options().time > end)
    document.diagnostics().warn(
        document.root().where(),
        fmt::format("--at: {:g} s is after the end of all animations ({}), their last moments are "
                    "shown",
                    document.options().time, fmt::join(names, "; ")));
}

}  // namespace nephroid::gltf
