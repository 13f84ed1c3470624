#include "input/staging/staging.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "input/parameter_list.h"
#include "input/staging/default_view.h"
#include "input/staging/exposure.h"
#include "input/staging/scene_bounds.h"
#include "input/staging/sun_and_sky.h"

namespace nephroid {
namespace {

/// The film of the scene; one is added if there is none.
ParameterSet& film_parameters(SceneDescription* scene) {
  if (!scene->film) scene->film = ParameterList(not_in_a_file("default film")).directive("rgb");
  return scene->film->parameters;
}

void set_iso(SceneDescription* scene, double iso, const char* option) {
  ParameterList list(not_in_a_file(option));
  list.add_float("iso", iso);
  replace_parameter(&film_parameters(scene), list.take().list.front());
}

/// Seconds for which the shutter is open.
double exposure_time(const SceneDescription& scene) {
  if (!scene.camera) return 1;
  const ParameterSet& p = scene.camera->parameters;
  const double seconds = p.get_float("shutterclose", 1) - p.get_float("shutteropen", 0);
  return seconds > 0 ? seconds : 1;  // else an error of the film's maker
}

/// Illuminance of a white surface with the value 1 at iso 100 and a second of exposure.
constexpr double kIlluminanceOfOne = kPiDouble;

/// Gives a white surface that faces the file's lights the value 1, about.
void choose_exposure(SceneDescription* scene, Diagnostics& diagnostics) {
  const double illuminance = typical_illuminance(*scene);
  if (illuminance == 0) return;
  constexpr double kMostStops = 60;
  const double stops =
      std::clamp(std::log2(kIlluminanceOfOne / (illuminance * exposure_time(*scene))), -kMostStops,
                 kMostStops);
  set_iso(scene, 100 * std::exp2(stops), "chosen exposure");
  diagnostics.note({std::make_shared<const std::string>(scene->file), 0, 0},
                   fmt::format("the exposure is chosen for the file's lights: {:.1f} stops "
                               "(--exposure gives another, 0 keeps the file's units)",
                               stops));
}

/// Names the picture after the scene's file, unless the file names it.
void name_picture(SceneDescription* scene) {
  if (film_parameters(scene).peek("filename") != nullptr) return;
  std::filesystem::path name = std::filesystem::path(scene->file).filename();
  if (name.extension() == ".gz") name = name.stem();
  ParameterList list(not_in_a_file("default film"));
  list.add_string("filename", name.replace_extension(".exr").string());
  replace_parameter(&film_parameters(scene), list.take().list.front());
}

/// The extent of the scene's shapes, which is found once, if it is wanted.
class LazyExtent {
 public:
  LazyExtent(const SceneDescription& scene, std::span<const Vec3d> directions)
      : scene_(scene), directions_(directions) {}
  /// Throws SceneError for a scene without shapes; `wanted_for` goes into the message.
  const SceneExtent& get(const char* wanted_for) {
    if (!extent_) extent_ = scene_extent(scene_, directions_);
    if (extent_->bounds.isEmpty())
      throw SceneError({std::make_shared<const std::string>(scene_.file), 0, 0},
                       std::string("the scene has no shapes, expected some: ") + wanted_for);
    return *extent_;
  }

 private:
  const SceneDescription& scene_;
  std::span<const Vec3d> directions_;
  std::optional<SceneExtent> extent_;
};

/// Applies --sun and --environment. A white surface that faces the sun gets the value 1.
void add_wanted_lights(SceneDescription* scene, double glow, const ImportOptions& options,
                       const Surroundings& surroundings) {
  if (options.sun) {
    const double illuminance = set_sun(scene, *options.sun, surroundings);
    set_iso(scene, 100 * kIlluminanceOfOne / (illuminance * exposure_time(*scene)), "--sun");
  }
  if (!options.environment.empty()) set_environment(scene, options.environment, surroundings, glow);
}

/// Applies --exposure.
void add_wanted_exposure(SceneDescription* scene, double stops) {
  if (stops == 0) return;
  const double iso = film_parameters(scene).get_float("iso", 100);
  set_iso(scene, iso * std::exp2(stops), "--exposure");
}

}  // namespace

void stage_scene(SceneDescription* scene, const FormatTraits& format, const ImportOptions& options,
                 Diagnostics& diagnostics) {
  const SourceLocation whole_file{std::make_shared<const std::string>(scene->file), 0, 0};
  const FramedView view(surroundings_of(*scene));
  LazyExtent extent(*scene, view.sides());
  if (!format.is_complete) name_picture(scene);
  if (!format.is_complete && !scene->camera) {
    scene->camera = view.camera(extent.get("the default view is framed around them"));
    diagnostics.note(whole_file, "the file has no camera: the view is from the front right");
  }
  const Surroundings surroundings = surroundings_of(*scene);
  const bool has_own_light = has_light(*scene, format.glow);
  const bool is_lit = has_own_light || !options.environment.empty() || options.sun;
  const Bounds3d bounds =
      options.floor || !(format.is_complete || is_lit)
          ? extent.get("the floor and the default lamp are placed by them").bounds
          : Bounds3d();
  add_wanted_lights(scene, format.glow, options, surroundings);
  if (!format.is_complete && !is_lit) {
    add_studio_light(scene, bounds, surroundings);
    diagnostics.note(whole_file,
                     "the file has no light: a grey sky and a soft lamp light it (--sun and "
                     "--environment give other light)");
  }
  if (!format.has_exposure && has_own_light && !options.sun && !options.exposure)
    choose_exposure(scene, diagnostics);
  if (options.floor) add_floor(scene, bounds, surroundings);
  add_wanted_exposure(scene, options.exposure.value_or(0));
}

}  // namespace nephroid
