#include "view/view_requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/errors.h"

namespace nephroid {
namespace {

using ParsedJson = nlohmann::json;

constexpr int kMaxEdge = 32768;  ///< pixels
constexpr LayerChoice kLayerChoices[] = {LayerChoice::kRoutes, LayerChoice::kLights,
                                         LayerChoice::kBoth};

/// The members of an object. Each is read once; what is left over at the end is not known.
class Members {
 public:
  explicit Members(std::string_view body) {
    json_ = ParsedJson::parse(body, nullptr, false);
    if (!json_.is_object()) throw UsageError("the request is no JSON object");
  }

  std::optional<double> number(const char* name, double min, double max) {
    const std::optional<ParsedJson> value = take(name);
    if (!value) return std::nullopt;
    return number_of(*value, name, min, max);
  }

  std::optional<double> number_or_null(const char* name, double min, double max) {
    const std::optional<ParsedJson> value = take(name);
    if (!value) return std::nullopt;
    return value->is_null() ? 0 : number_of(*value, name, min, max);
  }

  template <size_t N>
  std::optional<std::array<double, N>> numbers(const char* name, double min, double max) {
    const std::optional<ParsedJson> value = take(name);
    if (!value) return std::nullopt;
    if (!value->is_array() || value->size() != N)
      throw UsageError(fmt::format("{}: expected {} numbers", name, N));
    std::array<double, N> result;
    for (size_t i = 0; i < N; ++i) result[i] = number_of((*value)[i], name, min, max);
    return result;
  }

  std::optional<Vec3d> point(const char* name) {
    const auto xyz = numbers<3>(name, -1e30, 1e30);
    if (!xyz) return std::nullopt;
    return Vec3d((*xyz)[0], (*xyz)[1], (*xyz)[2]);
  }

  std::optional<int> integer(const char* name, int min, int max) {
    const std::optional<double> value = number(name, min, max);
    if (!value) return std::nullopt;
    if (*value != std::floor(*value))
      throw UsageError(fmt::format("{}: {} is not valid, expected a whole number", name, *value));
    return static_cast<int>(*value);
  }

  std::optional<uint64_t> natural(const char* name) {
    const std::optional<ParsedJson> value = take(name);
    if (!value) return std::nullopt;
    if (!value->is_number_unsigned())
      throw UsageError(fmt::format("{}: expected a whole number from 0", name));
    return value->get<uint64_t>();
  }

  std::optional<std::string> text(const char* name) {
    const std::optional<ParsedJson> value = take(name);
    if (!value) return std::nullopt;
    if (!value->is_string()) throw UsageError(fmt::format("{}: expected a text", name));
    return value->get<std::string>();
  }

  std::optional<bool> flag(const char* name) {
    const std::optional<ParsedJson> value = take(name);
    if (!value) return std::nullopt;
    if (!value->is_boolean()) throw UsageError(fmt::format("{}: expected true or false", name));
    return value->get<bool>();
  }

  /// Throws UsageError if a member was not read.
  void finish() const {
    if (!json_.empty())
      throw UsageError(
          fmt::format("the request has a member '{}' that is not known", json_.begin().key()));
  }

 private:
  std::optional<ParsedJson> take(const char* name) {
    const auto found = json_.find(name);
    if (found == json_.end()) return std::nullopt;
    ParsedJson value = std::move(*found);
    json_.erase(found);
    return value;
  }

  static double number_of(const ParsedJson& value, const char* name, double min, double max) {
    if (!value.is_number()) throw UsageError(fmt::format("{}: expected a number", name));
    const double number = value.get<double>();
    if (!(number >= min && number <= max))
      throw UsageError(
          fmt::format("{}: {} is not valid, expected {} to {}", name, number, min, max));
    return number;
  }

  ParsedJson json_;
};

/// A factor, or one each for red, green and blue, from 0.
Rgb gain_of(const ParsedJson& json, const std::string& layer) {
  const auto factor = [&](const ParsedJson& value) {
    constexpr double kMaxGain = 1e6;
    if (!value.is_number() || !(value.get<double>() >= 0 && value.get<double>() <= kMaxGain))
      throw UsageError(fmt::format("mix: {}: expected numbers from 0 to {}", layer, kMaxGain));
    return value.get<float>();
  };
  if (!json.is_array()) return {factor(json), factor(json), factor(json)};
  if (json.size() != 3)
    throw UsageError(fmt::format("mix: {}: expected one number or three", layer));
  return {factor(json[0]), factor(json[1]), factor(json[2])};
}

RenderAction action_named(const std::string& name) {
  if (name == "pause") return RenderAction::kPause;
  if (name == "resume") return RenderAction::kResume;
  if (name == "restart") return RenderAction::kRestart;
  throw UsageError("action: '" + name + "' is not valid, expected pause, resume or restart");
}

LayerChoice layer_choice_named(const std::string& name) {
  for (const LayerChoice choice : kLayerChoices)
    if (name == layer_choice_name(choice)) return choice;
  throw UsageError("layers: '" + name + "' is not valid, expected routes, lights or both");
}

}  // namespace

CameraPose CameraChange::applied_to(CameraPose pose) const {
  if (eye) pose.eye = *eye;
  if (target) pose.target = *target;
  if (up) pose.up = *up;
  if (fov) pose.fov = fov;
  if (lens_radius) pose.lens_radius = lens_radius;
  if (focal_distance) pose.focal_distance = focal_distance;
  if (shutter) {
    pose.shutter_open = (*shutter)[0];
    pose.shutter_close = (*shutter)[1];
  }
  return pose;
}

bool RenderChange::has_settings() const {
  return integrator || routes || layers || seed || time || noise || resolution || crop;
}

CameraChange parse_camera_change(std::string_view body) {
  Members members(body);
  CameraChange change;
  change.eye = members.point("eye");
  change.target = members.point("target");
  change.up = members.point("up");
  change.fov = members.number("fov", 1e-3, 179.9);
  change.lens_radius = members.number("lens_radius", 0, 1e30);
  change.focal_distance = members.number("focal_distance", 1e-30, 1e30);
  change.shutter = members.numbers<2>("shutter", -1e30, 1e30);
  change.is_moving = members.flag("moving").value_or(false);
  members.finish();
  return change;
}

RenderChange parse_render_change(std::string_view body) {
  Members members(body);
  RenderChange change;
  if (const auto action = members.text("action")) change.action = action_named(*action);
  change.integrator = members.text("integrator");
  change.routes = members.text("routes");
  if (const auto layers = members.text("layers")) change.layers = layer_choice_named(*layers);
  change.seed = members.natural("seed");
  change.time = members.number_or_null("time", 0, 1e9);
  change.noise = members.number_or_null("noise", 0, 1e9);
  if (const auto size = members.numbers<2>("resolution", 1, kMaxEdge))
    change.resolution = {static_cast<int>((*size)[0]), static_cast<int>((*size)[1])};
  change.crop = members.numbers<4>("crop", 0, 1);
  if (change.crop &&
      ((*change.crop)[0] >= (*change.crop)[1] || (*change.crop)[2] >= (*change.crop)[3]))
    throw UsageError("crop: expected x0 < x1 and y0 < y1");
  members.finish();
  return change;
}

PixelRequest parse_pixel_request(std::string_view body) {
  Members members(body);
  const auto x = members.integer("x", 0, kMaxEdge), y = members.integer("y", 0, kMaxEdge);
  members.finish();
  if (!x || !y) throw UsageError("expected the pixel as x and y");
  return {*x, *y};
}

Mix parse_mix(std::string_view text, const MixLayers& layers) {
  const ParsedJson json = ParsedJson::parse(text, nullptr, false);
  if (!json.is_object()) throw UsageError("mix: expected a JSON object with gains of layers");
  Mix mix;
  for (const auto& entry : json.items()) {
    const std::string& layer = entry.key();
    MixGain gain{layer, gain_of(entry.value(), layer)};
    const auto light = std::ranges::find(layers.by_light, layer, &LayerByLight::layer);
    if (light != layers.by_light.end()) {
      gain.name = light->light;
      mix.lights.push_back(std::move(gain));
    } else if (std::ranges::find(layers.routes, layer) != layers.routes.end()) {
      mix.routes.push_back(std::move(gain));
    } else {
      throw UsageError(fmt::format("mix: there is no layer '{}' that can be mixed", layer));
    }
  }
  return mix;
}

const char* layer_choice_name(LayerChoice choice) {
  switch (choice) {
    case LayerChoice::kRoutes:
      return "routes";
    case LayerChoice::kLights:
      return "lights";
    case LayerChoice::kBoth:
      break;
  }
  return "both";
}

}  // namespace nephroid
