// SceneSymbols lists every symbol that can occur in a scene: routes are proved and paths skipped by
// it. Paths that treat everything as useful cross all agreement scenes, from the camera and from
// the lights. Every symbol they meet must be listed.
#include <gtest/gtest.h>

#include <set>

#include "agreement/scene_assets.h"
#include "agreement/scenes.h"
#include "photon/emission.h"
#include "rendering.h"
#include "transport/camera_path.h"
#include "transport/walk_symbols.h"

namespace nephroid {
namespace {

using namespace testing_support;

// All names in the scene, so that no symbol is present because of another one.
std::vector<std::string> all_labels(const Scene& scene) {
  std::set<std::string> labels;
  for (const auto* names : {&scene.material_labels, &scene.medium_labels, &scene.light_labels})
    labels.insert(names->begin(), names->end());
  labels.erase("");
  return {labels.begin(), labels.end()};
}

// Records every symbol that a walk meets.
class BlindVisitor {
 public:
  BlindVisitor(const Scene& scene, const SceneSymbols& symbols, std::set<EventSymbol>& events,
               std::set<LightSymbol>& lights)
      : scene_(scene), symbols_(symbols), events_(events), lights_(lights) {}

  ClassMask useful(const WalkVertex&) const { return ClassMask::kEvery; }
  bool scatters_in(const Medium&) const { return true; }
  bool looks_under_surfaces() const { return true; }
  void escape(const Walk&) {
    for (const int i : scene_.light_sampler->infinite_lights()) lights_.insert(symbols_.light(i));
  }
  void emitter(const Walk&, const SurfaceInteraction& hit, const Light&) {
    lights_.insert(symbols_.light(hit.area_light));
  }
  void medium_emission(const Medium& medium, const SampledSpectrum&) {
    lights_.insert(symbols_.glow(medium.index()));
  }
  // Includes classes that were not sampled: light is connected to all of them, on both sides.
  void vertex(const Walk&, const WalkVertex& v, PathSampler&) {
    for (const EventClass c : kSurfaceClasses)
      if (contains(v.bsdf.classes(), c))
        for (const float side : {1.0f, -1.0f})
          events_.insert(symbol_at(symbols_, v, c, Vec3f(0, 0, side)));
  }
  void medium_vertex(const Walk&, const MediumVertex& v, PathSampler&) {
    events_.insert(symbol_in(symbols_, v.medium));
  }
  bool scatter(const Walk&, const WalkEvent& event) {
    events_.insert(symbol_of(symbols_, event));
    return true;
  }

 private:
  const Scene& scene_;
  const SceneSymbols& symbols_;
  std::set<EventSymbol>& events_;
  std::set<LightSymbol>& lights_;
};

class SymbolsPresent : public ::testing::TestWithParam<AgreementScene> {
 protected:
  static constexpr int kDepth = 10;
  // Pixels along each axis, light paths in all, camera paths per pixel.
  static constexpr int kPixels = 12;
  static constexpr int kLightPaths = 4000, kCameraPaths = 28;

  void walk_from_the_camera(const Scene& scene, float specular_alpha, BlindVisitor& visitor) {
    for (uint32_t i = 0; i < kCameraPaths; ++i) {
      const SobolPoint point(i);
      for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x) {
          PathSampler sampler(point, hash_combine(1, x, y));
          sampler.start_dimension(dimensions::kWavelength);
          const SampledWavelengths lambda =
              SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
          sampler.start_dimension(dimensions::kTime);
          CameraPath path = start_camera_path(scene, x, y, sampler, lambda, sampler.get_1d());
          path.walk.specular_alpha = specular_alpha;
          random_walk(scene, TransportMode::kRadiance, kDepth, path.walk, sampler, visitor);
        }
    }
  }

  // Returns the lights at which walks started.
  std::set<int> walk_from_the_lights(const Scene& scene, float specular_alpha,
                                     BlindVisitor& visitor) {
    std::set<int> lights;
    for (uint32_t i = 0; i < kLightPaths; ++i) {
      const SobolPoint point(i);
      PathSampler sampler(point, 7);
      sampler.start_dimension(kEmissionDimensions);
      Walk walk;
      walk.lambda = SampledWavelengths::sample_visible(wavelength_number(scene, sampler.get_1d()));
      const float u_time = sampler.get_1d();
      sampler.start_dimension(0);
      const auto emission =
          emit(scene, kUnguided, walk.lambda, scene.camera->motion_time(u_time), sampler);
      if (!emission) continue;
      lights.insert(emission->light);
      walk.ray = emission->ray;
      walk.medium = emission->medium;
      walk.specular_alpha = specular_alpha;
      walk.per_wavelength = true;
      walk.first_dimension = kEmissionDimensions + 2;
      walk.second_dimension = walk.first_dimension + dimensions::kPerVertex;
      random_walk(scene, TransportMode::kImportance, kDepth, walk, sampler, visitor);
    }
    return lights;
  }
};

TEST_P(SymbolsPresent, AreAllThatWalksMeet) {
  const SceneAssets files;
  const auto scene = scene_from_text(agreement_scene_text(GetParam(), files.directory()));
  const std::vector<std::string> labels = all_labels(*scene);
  const SceneSymbols symbols(*scene, labels);
  std::set<EventSymbol> events;
  std::set<LightSymbol> lights;
  const SpecularBand band;
  for (const float threshold : {band.low, 0.5f * (band.low + band.high), band.high}) {
    BlindVisitor visitor(*scene, symbols, events, lights);
    walk_from_the_camera(*scene, threshold, visitor);
    for (const int light : walk_from_the_lights(*scene, threshold, visitor))
      lights.insert(symbols.light(light));
  }
  const auto label_text = [&](Label label) {
    return label == 0 ? std::string("no label") : labels[label - 1u];
  };
  EXPECT_FALSE(events.empty());
  EXPECT_FALSE(lights.empty());
  for (const EventSymbol e : events)
    EXPECT_TRUE(symbols.present().events[e])
        << "an event of kind " << static_cast<int>(kind_of(e)) << ", " << label_text(label_of(e));
  for (const LightSymbol l : lights)
    EXPECT_TRUE(symbols.present().lights[l])
        << "a light of kind " << static_cast<int>(kind_of_light(l)) << ", "
        << label_text(label_of_light(l));
}

INSTANTIATE_TEST_SUITE_P(Scenes, SymbolsPresent, ::testing::ValuesIn(kAgreementScenes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace nephroid
