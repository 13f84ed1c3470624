// A small scene and what it takes to render it by passes of path+photons.
#pragma once

#include "integrator/pair_pass.h"
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
        preset(make_preset(plan_of({"all=.*:path+photons"}), {}, *scene)),
        owned(owned_routes(*scene, {"all=.*:path+photons"})) {}
  Film render(const PairPass& pass, uint32_t number, const IntegratorOptions& options = {}) const {
    Film film = film_for(*scene, preset);
    EstimatorStatistics statistics;
    pass.render({3, number}, *scene, film, owned, options, statistics);
    return film;
  }
  std::unique_ptr<Scene> scene;
  Preset preset;
  OwnedRoutes owned;
};

inline PairPass camera_paths_only() {
  PairPass pass;
  pass.light_paths = 0;
  pass.connects = false;
  pass.caustics_only = true;
  return pass;
}

}  // namespace nephroid::testing_support
