// A small scene, and all that renders it by passes of path+photons.
#pragma once

#include "integrator/bidirectional/pair_pass.h"
#include "integrator/photons/merge_radius.h"
#include "owned_routes.h"
#include "rendering.h"

namespace nephroid::testing_support {

inline constexpr char kPairView[] = R"(
  LookAt 0 4 -2  0 0 0  0 1 0
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 12 "integer yresolution" 8
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  WorldBegin
  Material "diffuse" "rgb reflectance" [0.6 0.6 0.6]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
)";

struct PairView {
  explicit PairView(const std::string& world)
      : scene(scene_from_text(kPairView + world)),
        set(make_estimators(plan_of({"all=.*:path+photons"}), {}, *scene)),
        owned(owned_routes(*scene, {"all=.*:path+photons"})) {}
  PairPass pass_of(const PairTechniques& techniques, uint32_t number,
                   const IntegratorOptions& options) const {
    return {.key = {3, number},
            .seed = 3,
            .scene = *scene,
            .owned = owned,
            .options = options,
            .techniques = techniques,
            .radius_pixels = radius_of_pass(options, 0, number),
            .light_paths_vary = true};
  }
  Film render(const PairTechniques& techniques, uint32_t number, const SampleMap& map) const {
    Film film = film_for(*scene, set);
    EstimatorStatistics statistics;
    const IntegratorOptions options;
    nephroid::render(pass_of(techniques, number, options),
                     {.film = film, .samples = {map, no_walks}}, statistics);
    return film;
  }
  std::unique_ptr<Scene> scene;
  EstimatorSet set;
  OwnedRoutes owned;
  PixelBounds bounds = film_for(*scene, set).bounds();
  SampleMap one_path{bounds}, no_walks{bounds, 0};
};

inline PairTechniques camera_paths_only() {
  return {.light_paths = 0, .connects = false, .casters = ClassMask::kSpecular};
}

}  // namespace nephroid::testing_support
