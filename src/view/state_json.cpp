#include "view/state_json.h"

#include <nlohmann/json.hpp>

#include "integrator/presets/integrator_table.h"
#include "integrator/presets/route_presets.h"
#include "view/json_text.h"
#include "view/view_requests.h"

namespace nephroid {
namespace {

const char* status_name(LiveStatus status) {
  switch (status) {
    case LiveStatus::kLoading:
      return "loading";
    case LiveStatus::kRendering:
      return "rendering";
    case LiveStatus::kPaused:
      return "paused";
    case LiveStatus::kDone:
      return "done";
    case LiveStatus::kFailed:
      break;
  }
  return "failed";
}

const char* kind_name(LayerKind kind) {
  switch (kind) {
    case LayerKind::kPicture:
      return "picture";
    case LayerKind::kRoute:
      return "route";
    case LayerKind::kLight:
      return "light";
    case LayerKind::kAov:
      return "aov";
    case LayerKind::kFeature:
      break;
  }
  return "feature";
}

template <class T>
Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json limit(double value) {
  return value > 0 ? Json(value) : Json(nullptr);
}

Json progress_json(const RenderProgress& progress) {
  const double seconds = progress.seconds;
  Json json{{"seconds", seconds},
            {"passes", progress.passes_done},
            {"passes_wanted", nullptr},
            {"seconds_left", nullptr},
            {"fraction", nullptr},
            {"error", json_or_null(progress.error)},
            {"rays_per_second", seconds > 0 ? static_cast<double>(progress.rays) / seconds : 0.0},
            {"photons", progress.photons_stored}};
  if (progress.fraction > 0) json["fraction"] = progress.fraction;
  // Endless renders have no end to wait for.
  constexpr double kLongestWait = 30.0 * 24 * 3600;
  if (progress.seconds_left && *progress.seconds_left < kLongestWait) {
    json["passes_wanted"] = json_or_null(progress.passes_wanted);
    json["seconds_left"] = *progress.seconds_left;
  }
  return json;
}

Json settings_json(const LiveSettings& settings) {
  Json presets = Json::array();
  for (const RoutePreset& preset : route_presets()) presets.push_back(preset.name);
  return {{"integrator", settings.integrator},
          {"integrators", integrator_names()},
          {"routes", settings.routes},
          {"presets", presets},
          {"layers", layer_choice_name(settings.layers)},
          {"seed", settings.seed},
          {"time", limit(settings.time_limit)},
          {"noise", limit(settings.noise_target)},
          {"resolution", {settings.width, settings.height}},
          {"crop", settings.crop}};
}

Json camera_json(const LiveState& state) {
  const CameraPose& pose = state.camera;
  Json json{{"eye", json_of(pose.eye)},
            {"target", json_of(pose.target)},
            {"up", json_of(pose.up)},
            {"fov", json_or_null(pose.fov)},
            {"lens_radius", json_or_null(pose.lens_radius)},
            {"focal_distance", json_or_null(pose.focal_distance)},
            {"shutter", nullptr},
            {"type", state.camera_type},
            {"mirrored", state.is_mirrored},
            {"can_move", state.is_scene}};
  if (pose.shutter_open && pose.shutter_close)
    json["shutter"] = {*pose.shutter_open, *pose.shutter_close};
  return json;
}

}  // namespace

std::string state_json(const LiveState& state, const std::vector<ListedComparison>& comparisons,
                       const std::string& save_directory) {
  Json json{
      {"scene", state.name},
      {"kind", state.is_scene ? "scene" : "picture"},
      {"status", status_name(state.status)},
      {"message", state.message},
      {"warnings", state.warnings},
      {"notes", state.notes},
      {"report", state.report},
      {"generation", state.generation},
      {"version", state.version},
      {"width", state.width},
      {"height", state.height},
      {"window", json_of(state.window)},
      {"preview", state.is_preview},
      {"progress", progress_json(state.progress)},
      {"settings", settings_json(state.settings)},
      {"layers", Json::array()},
      {"mix", {{"exact", state.why_mix_is_inexact.empty()}, {"why", state.why_mix_is_inexact}}},
      {"camera", state.is_scene ? camera_json(state) : Json(nullptr)},
      {"comparisons", Json::array()},
      {"save_directory", save_directory.empty() ? Json(nullptr) : Json(save_directory)}};
  for (const LiveLayer& layer : state.layers)
    json["layers"].push_back(
        {{"name", layer.name}, {"kind", kind_name(layer.kind)}, {"channels", layer.channels}});
  for (const ListedComparison& comparison : comparisons)
    json["comparisons"].push_back({{"id", comparison.id}, {"name", comparison.name}});
  return text_of(json);
}

}  // namespace nephroid
